// The table's rows for what is computed: parameters, and the variables of copies.
#include "grammar/schema_field.h"

// A row reads as a unit, its columns in lines of text.
// clang-format off
static const struct schema_row parameter_rows[] = {
    {.name = "name", FIELD(ir_parameter, name), .example = "height", .text = SCHEMA_TEXT_NAME, .key = true, .required = true,
     .also = "id", .doc = "Name in expressions: letters, digits and '_'."},
    {.name = "value", FIELD(ir_parameter, value), .example = "3", .text = SCHEMA_TEXT_VALUES, .short_form = true, .required = true,
     .also = "default expression formula",
     .doc = "A number, true or false, a vector [x, y, z], a colour #rrggbb, or an expression of other parameters."},
    {.name = "min", FIELD(ir_parameter, min), .example = "1", .example_alone = true, .range = SCHEMA_RANGE_COORDINATE, .plain = true,
     .also = "minimum least from", .doc = "The least value that a number may have."},
    {.name = "max", FIELD(ir_parameter, max), .example = "8", .example_alone = true, .range = SCHEMA_RANGE_COORDINATE, .plain = true,
     .also = "maximum most greatest to", .doc = "The greatest value that a number may have."},
    {.name = "description", FIELD(ir_parameter, description), .example = "of a shaft", .example_alone = true, .text = SCHEMA_TEXT_FREE,
     .also = "title comment note label help", .doc = "What it is, for people."},
};
const struct schema_element SCHEMA_PARAMETER = {
    ELEMENT("parameter", "Parameter", ir_parameter, parameter_rows, "A value with a name, which expressions of the scene use.")};

static const struct schema_row variable_rows[] = {
    {.name = "name", FIELD(ir_variable, name), .example = "i", .text = SCHEMA_TEXT_NAME, .key = true, .required = true,
     .also = "id variable var", .doc = "Name in the expressions of the entry: letters, digits and '_'."},
    {.name = "count", FIELD(ir_variable, count), .example = "5", .range = SCHEMA_RANGE_COPIES, .short_form = true,
     .choice = 1, .alternative = IR_VARIABLE_COUNT, .also = "times number n range to end",
     .doc = "How many values it has: 0, 1, 2 and so on, up to one less than this."},
    {.name = "values", FIELD(ir_variable, values), .example = "-4, 3", .text = SCHEMA_TEXT_LIST, .short_form = true,
     .choice = 1, .alternative = IR_VARIABLE_VALUES, .also = "in list each items elements",
     .doc = "Its values, one after the other: numbers, vectors [x, y, z] or colours #rrggbb, or expressions."},
};
const struct schema_element SCHEMA_VARIABLE = {
    ELEMENT("variable", "For", ir_variable, variable_rows, "A variable that has one value after the other, with a copy for each."),
    .choices = {{SCHEMA_CHOICE_EXACTLY_ONE, offsetof(struct ir_variable, kind)}}};
// clang-format on
