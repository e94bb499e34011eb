// JSON Schema (draft 7) of the files that have tables of keys, for editors. Ownership: the caller's buffer,
// whose `failed` flag is set when memory runs out. Thread safety: pure.
#ifndef GLINT_LOAD_SETTINGS_KEY_SCHEMA_H
#define GLINT_LOAD_SETTINGS_KEY_SCHEMA_H

#include "core/strbuf.h"

// docs/schema/glintrc.schema.json
void key_schema_settings(struct strbuf *out);
// docs/schema/bounds.schema.json
void key_schema_bounds(struct strbuf *out);
// docs/schema/test.schema.json
void key_schema_tests(struct strbuf *out);

#endif
