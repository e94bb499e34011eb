// The table's rows for objects and their instances.
#include "grammar/schema_field.h"
#include "grammar/schema_rows.h"

// A row reads as a unit, its columns in lines of text.
// clang-format off
static const struct schema_row object_rows[] = {
    {.name = "name", FIELD(ir_object, name), .example = "chair", .text = SCHEMA_TEXT_NAME, .key = true, .also = "id",
     .doc = "Name that instances use."},
    {.name = "parameter", .element = "Parameter", .plural = "parameters", FIELD(ir_object, parameters), .many = SCHEMA_NAMED_MAP,
     .also = "argument arguments", .aside = true,
     .example_alone = true, .child = &SCHEMA_PARAMETER, .doc = "Values of the object that each instance may choose, with 'with'."},
    LIGHTS(ir_object),
    BODIES(ir_object),
    INSTANCES(ir_object),
};
const struct schema_element SCHEMA_OBJECT = {
    ELEMENT("object", "Object", ir_object, object_rows,
            "A thing made of bodies and lights around a zero of its own. It shows nothing by itself: instances show it.")};

static const struct schema_row with_rows[] = {
    {.name = "name", FIELD(ir_with, name), .example = "height", .text = SCHEMA_TEXT_NAME, .key = true, .required = true,
     .also = "id parameter", .doc = "Name of a parameter of the object."},
    {.name = "value", FIELD(ir_with, value), .example = "4", .text = SCHEMA_TEXT_VALUES, .short_form = true, .required = true,
     .doc = "Its value in this instance: as of a parameter; expressions see what the instance sees."},
};
const struct schema_element SCHEMA_WITH = {
    ELEMENT("with", "With", ir_with, with_rows, "The value that a parameter of the object has in an instance.")};

static const struct schema_row matrix_row_rows[] = {
    {.name = "numbers", .element = "Numbers", FIELD(ir_matrix_row, numbers), .example = "1 0 0 2", .range = SCHEMA_RANGE_COORDINATE,
     .required = true, .short_form = true, .doc = "What x, y, z and 1 are multiplied by; the sum is a coordinate."},
};
const struct schema_element SCHEMA_MATRIX_ROW = {
    ELEMENT("row", "Row", ir_matrix_row, matrix_row_rows, "A row of a matrix.")};

static const struct schema_row matrix_rows[] = {
    {.name = "row", .element = "Row", .plural = "rows", FIELD(ir_matrix, rows), .example = "1 0 0 2, 0 1 0 0, 0 0 1 -3", .short_form = true,
     .many = SCHEMA_SEQUENCE, .child = &SCHEMA_MATRIX_ROW, .required = true,
     .doc = "The rows for x, y and z: three of four numbers."},
};
const struct schema_element SCHEMA_MATRIX = {
    ELEMENT("matrix", "Matrix", ir_matrix, matrix_rows, "Where an object is, as three rows of a matrix.")};

static const struct schema_row instance_rows[] = {
    BODY_NAME(ir_instance, "left_chair"),
    COPIES(ir_instance),
    {.name = "object", .element = "Object", FIELD(ir_instance, object), .example = "chair", .child = &SCHEMA_OBJECT,
     .also = "of ref prototype symbol component template group shape", .required = true,
     .doc = "Name of an object, or an object of its own: a group."},
    {.name = "with", .element = "With", FIELD(ir_instance, with), .example_alone = true, .many = SCHEMA_NAMED_MAP, .child = &SCHEMA_WITH,
     .also = "parameters params arguments args set", .doc = "Values of the object's parameters in this instance."},
    {.name = "material", .element = "Material", FIELD(ir_instance, material), .example = "wood", .example_alone = true,
     .also = "color colour diffuse_color shader", .child = &SCHEMA_MATERIAL,
     .doc = "Material of those bodies of the object that have none: a name, or a material of its own."},
    {.name = "scale", .element = "Scale", FIELD(ir_instance, scale), .example = "2 2 2", .also = "size scaling",
     .range = SCHEMA_RANGE_SCALE, .standard = "1 1 1", .fill = true,
     .doc = "Scales the object, before it is turned and moved; negative values mirror it."},
    {.name = "rotation", .element = "Rotation", FIELD(ir_instance, rotation), .example = "0 90 0", .also = "orientation angles rotate",
     .unit = SCHEMA_UNIT_DEGREES, .range = SCHEMA_RANGE_ANGLE, .standard = "0 0 0",
     .doc = "Turns the scaled object about x, then y, then z."},
    {.name = "translation", .element = "Translation", FIELD(ir_instance, translation), .example = "3 0 -2",
     .also = "pos position location offset center origin move translate at",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .standard = "0 0 0",
     .doc = "Moves the scaled and turned object."},
    {.name = "matrix", .element = "Matrix", FIELD(ir_instance, matrix), .example_alone = true, .child = &SCHEMA_MATRIX,
     .also = "transform transformation to_world", .doc = "In place of scale, rotation and translation: where the object is, as numbers."},
};
const struct schema_element SCHEMA_INSTANCE = {
    ELEMENT("instance", "Instance", ir_instance, instance_rows, "An object, placed: as it is, or with other values of its parameters.")};
// clang-format on
