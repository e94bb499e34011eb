// What the formats of a report share. Thread safety: pure.
#ifndef GLINT_DIAG_DIAG_REPORT_TEXT_H
#define GLINT_DIAG_DIAG_REPORT_TEXT_H

#include "core/json_write.h"
#include "diag/diag_report.h"

// "scene.yaml:4:12: error: message [E203]", with control characters shown as '?'; no line end.
void report_line(struct strbuf *out, const struct report_finding *finding);
// "50 more findings of scene.yaml are not listed (E206: 50); --max-messages 150 lists all", with a line end.
void report_left_out(struct strbuf *out, const struct report_scene *scene);
// "2 errors, 1 warning"
void report_counts(struct strbuf *out, uint32_t errors, uint32_t warnings, uint32_t notes);
// Text for XML 1.0, which allows no control character, escaped or not, and neither U+FFFE nor U+FFFF, which
// are valid in UTF-8: each becomes '?'.
void report_markup(struct strbuf *out, str s);
// "with": {"i": 3}, "copies": 2, of a finding about copies.
void report_copies(struct json_writer *writer, const struct report_finding *finding);
// "error", "warning", "note".
const char *report_severity(const struct report_finding *finding);

#endif
