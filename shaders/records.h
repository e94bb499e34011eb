/* The fields of the records of gpu_scene.h, word by word: one list expands to the C struct and its asserts
   (tracer/gpu_records.h) and to the GLSL struct and its loader (records.glsl). VECTOR(name, word) takes
   x, y, z of a word; FLOAT and UINT(name, word, component) one component. In the order of memory.
   Lists with 64 in their names are of scenes in double precision, and they alone have doubles: REAL3(name,
   word) takes a word and half of the next, REAL(name, word, half) the xy or zw of a word. */
#ifndef GLINT_SHADERS_RECORDS_H
#define GLINT_SHADERS_RECORDS_H

#define NODE_FIELDS(REAL3, REAL, VECTOR, FLOAT, UINT)                                                        \
    VECTOR(corner, 0)                                                                                        \
    UINT(exponents, 0, w) /* and the mask of inner children */                                               \
    UINT(first_node, 1, x)                                                                                   \
    UINT(first_item, 1, y)                                                                                   \
    UINT(meta_a, 1, z) /* _a: children 0..3, _b: children 4..7 */                                            \
    UINT(meta_b, 1, w)                                                                                       \
    UINT(low_x_a, 2, x)                                                                                      \
    UINT(low_x_b, 2, y)                                                                                      \
    UINT(low_y_a, 2, z)                                                                                      \
    UINT(low_y_b, 2, w)                                                                                      \
    UINT(low_z_a, 3, x)                                                                                      \
    UINT(low_z_b, 3, y)                                                                                      \
    UINT(high_x_a, 3, z)                                                                                     \
    UINT(high_x_b, 3, w)                                                                                     \
    UINT(high_y_a, 4, x)                                                                                     \
    UINT(high_y_b, 4, y)                                                                                     \
    UINT(high_z_a, 4, z)                                                                                     \
    UINT(high_z_b, 4, w)

#define TRIANGLE_FIELDS(REAL3, REAL, VECTOR, FLOAT, UINT)                                                    \
    VECTOR(v0, 0)                                                                                            \
    UINT(number, 0, w)                                                                                       \
    VECTOR(v1, 1)                                                                                            \
    UINT(body, 1, w)                                                                                         \
    VECTOR(v2, 2)                                                                                            \
    UINT(shade, 2, w) /* material and flags */

#define SPHERE_FIELDS(REAL3, REAL, VECTOR, FLOAT, UINT)                                                      \
    VECTOR(center, 0)                                                                                        \
    FLOAT(radius, 0, w)                                                                                      \
    UINT(body, 1, x)                                                                                         \
    UINT(shade, 1, y)                                                                                        \
    UINT(spare_z, 1, z)                                                                                      \
    UINT(spare_w, 1, w)

#define BODY_FIELDS(REAL3, REAL, VECTOR, FLOAT, UINT)                                                        \
    UINT(first_triangle, 0, x)                                                                               \
    UINT(normal_base, 0, y)                                                                                  \
    UINT(spare_z, 0, z)                                                                                      \
    UINT(spare_w, 0, w)                                                                                      \
    VECTOR(row_x, 1) /* of a rectangle: |edge_u|, |edge_v| */                                                \
    FLOAT(offset_x, 1, w)                                                                                    \
    VECTOR(row_y, 2)                                                                                         \
    FLOAT(offset_y, 2, w)                                                                                    \
    VECTOR(row_z, 3)                                                                                         \
    FLOAT(offset_z, 3, w)

#define MATERIAL_FIELDS(REAL3, REAL, VECTOR, FLOAT, UINT)                                                    \
    FLOAT(weight_diffuse, 0, x)                                                                              \
    FLOAT(weight_specular, 0, y)                                                                             \
    FLOAT(weight_reflection, 0, z)                                                                           \
    FLOAT(weight_refraction, 0, w)                                                                           \
    VECTOR(diffuse, 1)                                                                                       \
    FLOAT(exponent, 1, w)                                                                                    \
    VECTOR(specular, 2)                                                                                      \
    FLOAT(index, 2, w)                                                                                       \
    VECTOR(second, 3) /* colour of the checker */                                                            \
    FLOAT(cell, 3, w)

#define LIGHT_FIELDS(REAL3, REAL, VECTOR, FLOAT, UINT)                                                       \
    VECTOR(place, 0)                                                                                         \
    UINT(flags, 0, w)                                                                                        \
    VECTOR(emission, 1)                                                                                      \
    UINT(spare, 1, w)

#define TRIANGLE64_FIELDS(REAL3, REAL, VECTOR, FLOAT, UINT)                                                  \
    REAL3(v0, 0)                                                                                             \
    UINT(number, 1, z)                                                                                       \
    UINT(body, 1, w)                                                                                         \
    REAL3(v1, 2)                                                                                             \
    UINT(shade, 3, z)                                                                                        \
    UINT(spare_3w, 3, w)                                                                                     \
    REAL3(v2, 4)                                                                                             \
    UINT(spare_5z, 5, z)                                                                                     \
    UINT(spare_5w, 5, w)

#define SPHERE64_FIELDS(REAL3, REAL, VECTOR, FLOAT, UINT)                                                    \
    REAL3(center, 0)                                                                                         \
    REAL(radius, 1, zw)                                                                                      \
    UINT(body, 2, x)                                                                                         \
    UINT(shade, 2, y)                                                                                        \
    UINT(spare_z, 2, z)                                                                                      \
    UINT(spare_w, 2, w)

#define NORMAL64_FIELDS(REAL3, REAL, VECTOR, FLOAT, UINT)                                                    \
    REAL3(unit, 0)                                                                                           \
    UINT(spare_z, 1, z)                                                                                      \
    UINT(spare_w, 1, w)

#define BODY64_FIELDS(REAL3, REAL, VECTOR, FLOAT, UINT)                                                      \
    UINT(first_triangle, 0, x)                                                                               \
    UINT(normal_base, 0, y)                                                                                  \
    UINT(spare_z, 0, z)                                                                                      \
    UINT(spare_w, 0, w)                                                                                      \
    REAL3(row_x, 1)                                                                                          \
    REAL(offset_x, 2, zw)                                                                                    \
    REAL3(row_y, 3)                                                                                          \
    REAL(offset_y, 4, zw)                                                                                    \
    REAL3(row_z, 5)                                                                                          \
    REAL(offset_z, 6, zw)

#define MATERIAL64_FIELDS(REAL3, REAL, VECTOR, FLOAT, UINT)                                                  \
    FLOAT(weight_diffuse, 0, x)                                                                              \
    FLOAT(weight_specular, 0, y)                                                                             \
    FLOAT(weight_reflection, 0, z)                                                                           \
    FLOAT(weight_refraction, 0, w)                                                                           \
    VECTOR(diffuse, 1)                                                                                       \
    FLOAT(exponent, 1, w)                                                                                    \
    VECTOR(specular, 2)                                                                                      \
    UINT(spare_2w, 2, w)                                                                                     \
    VECTOR(second, 3)                                                                                        \
    UINT(spare_3w, 3, w)                                                                                     \
    REAL(index, 4, xy)                                                                                       \
    REAL(cell, 4, zw)

#define LIGHT64_FIELDS(REAL3, REAL, VECTOR, FLOAT, UINT)                                                     \
    REAL3(place, 0)                                                                                          \
    UINT(flags, 1, z)                                                                                        \
    UINT(spare_1w, 1, w)                                                                                     \
    VECTOR(emission, 2)                                                                                      \
    UINT(spare_2w, 2, w)

#endif
