// The table's rows for what is computed: parameters.
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
// clang-format on
