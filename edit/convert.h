// A loaded file in another spelling: written, read again, and compared with what was read.
//
// Input: a session that session_load_text made, without errors. Output: the text, only if it means the same.
// Errors: a status, and a diagnostic E808 in the session's sink that says what differs. Ownership: the text
// is appended to the caller's strbuf. Thread safety: one call belongs to one thread.
#ifndef GLINT_EDIT_CONVERT_H
#define GLINT_EDIT_CONVERT_H

#include "core/strbuf.h"
#include "load/session.h"

enum convert_spelling {
    CONVERT_YAML,
    CONVERT_XML,
    CONVERT_JSON,
};

enum convert_status {
    CONVERT_DONE,
    CONVERT_NO_MEMORY,
    CONVERT_UNSAFE, // the text would mean something else, or cannot be read: `out` is as it was
};

// The spelling that a path's ending names; false: it names none.
bool convert_spelling_of(str path, enum convert_spelling *spelling);
enum convert_status convert_write(struct session *session, enum convert_spelling spelling,
                                  struct strbuf *out);
// The second half of it: whether `text`, in that spelling, reads back as the session's scene.
enum convert_status convert_check(struct session *session, enum convert_spelling spelling, str text);

#endif
