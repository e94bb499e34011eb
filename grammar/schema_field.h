// How a file of the table writes rows and elements: the kind of a row follows from the C type of its field.
// Private to grammar/schema*.c.
#ifndef GLINT_GRAMMAR_SCHEMA_FIELD_H
#define GLINT_GRAMMAR_SCHEMA_FIELD_H

#include "grammar/ir.h"
#include "grammar/schema.h"

#include <stddef.h>

// clang-format off
#define KIND_OF(field)                                                                                       \
    _Generic((field),                                                                                        \
        bool: SCHEMA_BOOLEAN,                                                                                \
        int32_t: SCHEMA_INTEGER,                                                                             \
        double: SCHEMA_NUMBER,                                                                               \
        unsigned: SCHEMA_WORD,                                                                               \
        str: SCHEMA_TEXT,                                                                                    \
        vec3: SCHEMA_VECTOR,                                                                                 \
        struct ir_pair: SCHEMA_PAIR,                                                                         \
        struct ir_point: SCHEMA_POINT,                                                                       \
        struct ir_quad: SCHEMA_QUAD,                                                                         \
        struct ir_color: SCHEMA_COLOR,                                                                       \
        struct ir_weights: SCHEMA_WEIGHTS,                                                                   \
        struct ir_reference: SCHEMA_REFERENCE,                                                            \
        struct ir_image: SCHEMA_ELEMENT,                                                                     \
        struct ir_trace: SCHEMA_ELEMENT,                                                                     \
        struct ir_background: SCHEMA_ELEMENT,                                                                \
        struct ir_ambient: SCHEMA_ELEMENT,                                                                   \
        struct ir_panel: SCHEMA_ELEMENT,                                                                     \
        struct ir_spot: SCHEMA_ELEMENT,                                                                      \
        struct ir_paint: SCHEMA_ELEMENT,                                                                     \
        struct ir_checker: SCHEMA_ELEMENT,                                                                   \
        struct ir_texture: SCHEMA_ELEMENT,                                                                   \
        struct ir_highlight: SCHEMA_ELEMENT,                                                                 \
        struct ir_lathe: SCHEMA_ELEMENT,                                                                     \
        struct ir_torus: SCHEMA_ELEMENT,                                                                     \
        struct ir_extrude: SCHEMA_ELEMENT,                                                                   \
        struct ir_faces: SCHEMA_ELEMENT,                                                                     \
        struct ir_text: SCHEMA_ELEMENT,                                                                      \
        struct ir_animation: SCHEMA_ELEMENT,                                                                 \
        struct ir_matrix: SCHEMA_ELEMENT,                                                                    \
        struct ir_includes: SCHEMA_LIST,                                                                     \
        struct ir_parameters: SCHEMA_LIST,                                                                   \
        struct ir_cameras: SCHEMA_LIST,                                                                      \
        struct ir_lights: SCHEMA_LIST,                                                                       \
        struct ir_variables: SCHEMA_LIST,                                                                    \
        struct ir_materials: SCHEMA_LIST,                                                                    \
        struct ir_meshes: SCHEMA_LIST,                                                                       \
        struct ir_outline: SCHEMA_LIST,                                                                      \
        struct ir_holes: SCHEMA_LIST,                                                                        \
        struct ir_vertices: SCHEMA_LIST,                                                                     \
        struct ir_coordinates: SCHEMA_LIST,                                                                  \
        struct ir_corners: SCHEMA_LIST,                                                                      \
        struct ir_faces_list: SCHEMA_LIST,                                                                   \
        struct ir_spheres: SCHEMA_LIST,                                                                      \
        struct ir_rectangles: SCHEMA_LIST,                                                                   \
        struct ir_boxes: SCHEMA_LIST,                                                                        \
        struct ir_cylinders: SCHEMA_LIST,                                                                    \
        struct ir_cones: SCHEMA_LIST,                                                                        \
        struct ir_models: SCHEMA_LIST,                                                                       \
        struct ir_matrix_rows: SCHEMA_LIST,                                                                  \
        struct ir_withs: SCHEMA_LIST,                                                                        \
        struct ir_objects: SCHEMA_LIST,                                                                      \
        struct ir_instances: SCHEMA_LIST,                                                                    \
        struct ir_map_entries: SCHEMA_LIST,                                                                  \
        struct ir_tracks: SCHEMA_LIST,                                                                       \
        struct ir_keyframes: SCHEMA_LIST)
// clang-format on

#define FIELD(type, member)                                                                                  \
    .kind = KIND_OF(((struct type *)0)->member), .offset = offsetof(struct type, member),                    \
    .size = sizeof(((struct type *)0)->member)

#define FIELD_PAIR(type, member)                                                                             \
    .kind = KIND_OF(((struct type *)0)->member[0]), .offset = offsetof(struct type, member),                 \
    .size = sizeof(((struct type *)0)->member[0]), .many = SCHEMA_FIXED, .fixed_count = 2

#define ELEMENT(snake, pascal, type, table, sentence)                                                        \
    .name = snake, .element = pascal, .doc = sentence, .rows = table,                                        \
    .row_count = sizeof(table) / sizeof((table)[0]), .size = sizeof(struct type)

#endif
