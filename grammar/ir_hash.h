// A hash of everything that an element of the IR means: every row of the table, children, lists and choices
// included.
//
// It ignores where something is in a file, and whether it was written or is a default. Thread safety: pure.
#ifndef GLINT_GRAMMAR_IR_HASH_H
#define GLINT_GRAMMAR_IR_HASH_H

#include "core/hash128.h"
#include "grammar/schema.h"

void ir_hash(struct hash128 *hash, const struct schema_element *schema, const void *element);

#endif
