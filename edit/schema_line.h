// The line that names the schema of a scene file for editors: `# yaml-language-server: $schema=ADDRESS` in
// YAML, `<?xml-model href="ADDRESS" ...?>` in XML.
//
// Thread safety: the session's thread.
#ifndef GLINT_EDIT_SCHEMA_LINE_H
#define GLINT_EDIT_SCHEMA_LINE_H

#include "core/strbuf.h"
#include "load/session.h"

// Puts the line with this address into the text of the session's main file, or changes the existing line; no
// other byte changes, and the line end is the file's. `session` is from session_load_text. false: the text
// has that line already, and `out` is unchanged.
bool schema_line_put(struct session *session, str address, struct strbuf *out);

#endif
