// Diagnostics as text for people:
//
//     scene.yaml:4:12: error: message [E203]
//       4 |   colour: red
//         |   ^~~~~~
//         = help: did you mean 'color'?
//
// Columns below the line are a terminal's: tabs are shown as spaces, wide characters take two. Control
// characters and bytes that are not UTF-8, in source lines, paths and messages alike, are shown as '?'.
// Thread safety: pure except for the line maps of the sources.
#ifndef GLINT_DIAG_DIAG_TEXT_H
#define GLINT_DIAG_DIAG_TEXT_H

#include "core/strbuf.h"
#include "diag/diag.h"

struct diag_text_options {
    bool color;    // ANSI colours
    bool notes;    // show diagnostics of severity "note" too
    uint32_t most; // messages shown, and 500 bytes of text for each; 0 is all
};

// Writes all diagnostics of a sorted sink, errors, warnings and notes in their order, and a closing line that
// says how many more there were. The first error is shown even if `most` is reached before it.
void diag_text(struct strbuf *out, const struct diag_sink *sink, struct source_set *sources,
               struct diag_text_options options);
// Text that may quote a scene, on one line, with what a terminal might obey shown as '?'.
void diag_text_plain(struct strbuf *out, str text);
// "error", "warning", "note".
const char *diag_severity_name(enum diag_severity severity);

#endif
