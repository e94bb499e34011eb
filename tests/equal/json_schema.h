// As much of JSON Schema draft-07 as glint's own schema uses, and YAML as JSON, for the tests.
#ifndef GLINT_TESTS_JSON_SCHEMA_H
#define GLINT_TESTS_JSON_SCHEMA_H

#include "core/str.h"

#include <jansson.h>

// Whether `value` is valid. A keyword that is not known makes it invalid, so that none goes unchecked.
bool json_schema_accepts(const json_t *root, const json_t *schema, const json_t *value);
// A YAML document as JSON, as a reader without the grammar sees it; NULL where it holds nothing.
json_t *json_from_yaml(str text);

#endif
