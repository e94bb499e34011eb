// One file in canonical layout: for `glint format`, and for editors, whose text need not be saved.
//
// Ownership: layout_finish frees everything; `text` and the result's view are valid until then. Errors: a
// status, and diagnostics in `sink`, errors only, sorted. Thread safety: one layout belongs to one thread.
#ifndef GLINT_EDIT_LAYOUT_H
#define GLINT_EDIT_LAYOUT_H

#include "core/limits.h"
#include "core/strbuf.h"
#include "diag/diag.h"
#include "files/files.h"

enum layout_status {
    LAYOUT_SAME,       // the text is in canonical layout
    LAYOUT_CHANGED,    // `result` holds the text as it should be
    LAYOUT_REFUSED,    // the text cannot be read to its end
    LAYOUT_UNREADABLE, // the file cannot be read
    LAYOUT_FAILED,     // the layout would have changed the meaning, or memory ran out
};

struct layout {
    struct arena arena;
    struct source_set sources;
    struct files files;
    struct diag_sink sink;
    str text;             // as it is
    struct strbuf result; // LAYOUT_CHANGED
    enum layout_status status;
};

// `found_in`: as in struct session_options. The ending of `path` decides the spelling or, for other endings,
// the text. `text` must outlive the layout.
enum layout_status layout_text(struct layout *layout, str path, str text, const struct limits *limits,
                               bool upgrade);
enum layout_status layout_file(struct layout *layout, str path, str found_in, const struct limits *limits,
                               bool upgrade);
void layout_finish(struct layout *layout);

#endif
