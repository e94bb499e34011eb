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
    bool color;     // ANSI colours
    bool notes;     // show diagnostics of severity "note" too
    uint32_t most;  // messages shown; up to the default limit also 500 bytes of text each; 0: all
    uint32_t alike; // at most so many of one code in one file (diag/diag_share.h); 0: no such bound
};

// The `alike` to use if the user did not say how many messages to show.
enum {
    DIAG_TEXT_ALIKE = 50
};

// Writes the diagnostics of a sorted sink in their order, as far as there is room (diag/diag_share.h), and a
// line that says how many more there are, of which codes, and how to see them. The first error is always
// shown.
void diag_text(struct strbuf *out, const struct diag_sink *sink, struct source_set *sources,
               struct diag_text_options options);
// Writes text that may quote a scene on one line; characters that a terminal might obey become '?'.
void diag_text_plain(struct strbuf *out, str text);
// "error", "warning", "note".
const char *diag_severity_name(enum diag_severity severity);

#endif
