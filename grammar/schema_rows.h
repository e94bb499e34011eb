// Rows that several elements of the table have: what bodies and lights share, and the lists of them. Private
// to grammar/schema*.c.
#ifndef GLINT_GRAMMAR_SCHEMA_ROWS_H
#define GLINT_GRAMMAR_SCHEMA_ROWS_H

#include "grammar/schema_field.h"
#include "shaders/features.h"

// clang-format off
#define BODY_NAME(type, sample) \
    { \
        .name = "name", FIELD(type, name), .example = sample, .text = SCHEMA_TEXT_NAME, .also = "id", \
        .counted = true, \
        .doc = "Name for messages and --set." \
    }
#define COPIES(type) \
    {.name = "for", \
     .element = "For", \
     FIELD(type, copies), \
     .example_alone = true, \
     .many = SCHEMA_NAMED_MAP, \
     .child = &SCHEMA_VARIABLE, \
     .also = "repeat copies array loop foreach for_each times instances", \
     .doc = "Makes copies: one for each value of a variable, which expressions of this entry can use."}, \
        {.name = "if", \
         FIELD(type, condition), \
         .example = "i != 3", \
         .example_alone = true, \
         .standard = "true", \
         .also = "when where unless enabled condition", \
         .doc = "Where it is false there is no such copy, or without 'for' no such entry."}

#define BODY_MATERIAL(type) \
    { \
        .name = "material", .element = "Material", FIELD(type, material), .example = "glass", \
        .also = "color colour diffuse_color shader", \
        .child = &SCHEMA_MATERIAL, \
        .doc = "Name of a material, or a material of its own; if left out, the default material." \
    }

#define LIGHTS(type) \
    {.name = "light", .element = "Light", .plural = "lights", FIELD(type, lights), \
     .also = "lamp lamps point_light point_lights", \
     .many = SCHEMA_SEQUENCE, .child = &SCHEMA_LIGHT, .doc = "Lights."}

#define BODIES(type) \
    {.name = "sphere", .element = "Sphere", .plural = "spheres", FIELD(type, spheres), \
     .also = "ball balls", \
     .many = SCHEMA_SEQUENCE, .child = &SCHEMA_SPHERE, .feature = FEATURE_SPHERES, .doc = "Spheres."}, \
    {.name = "rectangle", .element = "Rectangle", .plural = "rectangles", FIELD(type, rectangles), \
     .also = "rect rects quad quads", \
     .many = SCHEMA_SEQUENCE, .child = &SCHEMA_RECTANGLE, .feature = FEATURE_TRIANGLES, .doc = "Rectangles."}, \
    {.name = "box", .element = "Box", .plural = "boxes", FIELD(type, boxes), \
     .also = "cube cubes cuboid cuboids block blocks", \
     .many = SCHEMA_SEQUENCE, .child = &SCHEMA_BOX, .feature = FEATURE_TRIANGLES, .doc = "Boxes."}, \
    {.name = "cylinder", .element = "Cylinder", .plural = "cylinders", FIELD(type, cylinders), \
     .also = "tube tubes column columns pillar pillars rod rods", \
     .many = SCHEMA_SEQUENCE, .child = &SCHEMA_CYLINDER, .feature = FEATURE_CONES, .doc = "Cylinders."}, \
    {.name = "cone", .element = "Cone", .plural = "cones", FIELD(type, cones), \
     .also = "truncated_cone truncated_cones frustum frustums", \
     .many = SCHEMA_SEQUENCE, .child = &SCHEMA_CONE, .feature = FEATURE_CONES, .doc = "Cones, whole or cut off."}, \
    {.name = "model", .element = "Model", .plural = "models", FIELD(type, models), \
     .also = "shape shapes obj", \
     .many = SCHEMA_SEQUENCE, .child = &SCHEMA_MODEL, .feature = FEATURE_TRIANGLES, .doc = "Meshes placed in the scene."}

#define INSTANCES(type) \
    {.name = "instance", .element = "Instance", .plural = "instances", FIELD(type, instances), .example_alone = true, \
     .also = "use uses placement placements", \
     .many = SCHEMA_SEQUENCE, .child = &SCHEMA_INSTANCE, .doc = "Objects placed in the scene."}

// clang-format on

#endif
