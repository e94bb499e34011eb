// Text of one to four values, SCHEMA_TEXT_VALUES: "30", "0, 1, 6", "#c08050", "4*cos(90*time), 1, 0"; or of a
// list of any length, SCHEMA_TEXT_LIST: "-4, 3", "[0, 0, 1], [2, 0, 1]". Commas inside parentheses belong to
// an expression, those inside brackets to a vector.
//
// Thread safety: pure except for `out`.
#ifndef GLINT_GRAMMAR_IR_VALUES_H
#define GLINT_GRAMMAR_IR_VALUES_H

#include "core/strbuf.h"

#include <stdbool.h>
#include <stdint.h>

enum {
    IR_VALUES_MOST = 4
};

// Takes the first value off *rest, without the spaces around it. false: nothing is left. An empty value
// between commas counts as a value.
bool ir_values_next(str *rest, str *value);
uint32_t ir_values_count(str text);
// Appends the text in its stored form: numbers in their shortest form, ", " between values.
void ir_values_normal(struct strbuf *out, str text);
// What is between the brackets of a vector. false: the value has none.
bool ir_values_open(str value, str *inside);
// One value as it is, several and each list in brackets, for YAML's flow style and for JSON.
void ir_values_yaml(struct strbuf *out, str text, bool is_list);
void ir_values_json(struct strbuf *out, str text, bool is_list);

#endif
