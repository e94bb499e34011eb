/* The records of gpu_scene.h, each field once: its type, and its place in single and in double precision. One
   list expands to the C struct that flattening fills and its packing (tracer/gpu_records.h), and to the GLSL
   struct and its loader (records.glsl). A field added here alone is 0 in every kernel.

   REAL3(name, word, word64): a point, direction or row: floats in x, y, z of a word; in double precision
       doubles in word64 and in half of the next.
   REAL(name, word, component, word64, half): one number; in double precision in xy or zw of word64.
   FLOAT3(name, word, word64), FLOAT(name, word, component, word64, component64): floats in both.
   UINT(name, word, component, word64, component64): a whole number. */
#ifndef GLINT_SHADERS_RECORDS_H
#define GLINT_SHADERS_RECORDS_H

#define NODE_WORDS   5
#define NODE64_WORDS 5
#define NODE_FIELDS(REAL3, REAL, FLOAT3, FLOAT, UINT)                                                        \
    FLOAT3(corner, 0, 0)                                                                                     \
    UINT(exponents, 0, w, 0, w) /* and the mask of inner children */                                         \
    UINT(first_node, 1, x, 1, x)                                                                             \
    UINT(first_item, 1, y, 1, y)                                                                             \
    UINT(meta_a, 1, z, 1, z) /* _a: children 0..3, _b: children 4..7 */                                      \
    UINT(meta_b, 1, w, 1, w)                                                                                 \
    UINT(low_x_a, 2, x, 2, x)                                                                                \
    UINT(low_x_b, 2, y, 2, y)                                                                                \
    UINT(low_y_a, 2, z, 2, z)                                                                                \
    UINT(low_y_b, 2, w, 2, w)                                                                                \
    UINT(low_z_a, 3, x, 3, x)                                                                                \
    UINT(low_z_b, 3, y, 3, y)                                                                                \
    UINT(high_x_a, 3, z, 3, z)                                                                               \
    UINT(high_x_b, 3, w, 3, w)                                                                               \
    UINT(high_y_a, 4, x, 4, x)                                                                               \
    UINT(high_y_b, 4, y, 4, y)                                                                               \
    UINT(high_z_a, 4, z, 4, z)                                                                               \
    UINT(high_z_b, 4, w, 4, w)

#define TRIANGLE_WORDS   3
#define TRIANGLE64_WORDS 6
#define TRIANGLE_FIELDS(REAL3, REAL, FLOAT3, FLOAT, UINT)                                                    \
    REAL3(v0, 0, 0)                                                                                          \
    REAL3(v1, 1, 1)                                                                                          \
    REAL3(v2, 2, 2)                                                                                          \
    UINT(number, 0, w, 0, w)                                                                                 \
    UINT(body, 1, w, 1, w)                                                                                   \
    UINT(shade, 2, w, 2, w) /* material and flags */

/* REAL3 of a triangle in double precision, and of no other record: in x, y, z of word64 the floats that the
   numbers begin with, cut off, and in those of word64 + TRIANGLE_REST the SPLIT_BITS last bits of each. So a
   kernel sees by the first three words that a ray passes a triangle by, and seldom reads the others. For
   numbers that are 0 or lie among the normal floats. OUTLINE are those floats alone. */
#define TRIANGLE_REST 3
#define SPLIT_BITS    29
#define OUTLINE_FIELDS(REAL3, REAL, FLOAT3, FLOAT, UINT)                                                     \
    FLOAT3(v0, 0, 0)                                                                                         \
    FLOAT3(v1, 1, 1)                                                                                         \
    FLOAT3(v2, 2, 2)

/* A triangle where the scene has instances, in place of the one above: in the space of its mesh. Doubles in
   both precisions: DOUBLE(name, word, half), UINT(name, word, component). */
#define PLACED_WORDS 6
#define PLACED_FIELDS(DOUBLE, UINT)                                                                          \
    DOUBLE(v0_x, 0, xy)                                                                                      \
    DOUBLE(v0_y, 0, zw)                                                                                      \
    DOUBLE(v0_z, 1, xy)                                                                                      \
    DOUBLE(v1_x, 1, zw)                                                                                      \
    DOUBLE(v1_y, 2, xy)                                                                                      \
    DOUBLE(v1_z, 2, zw)                                                                                      \
    DOUBLE(v2_x, 3, xy)                                                                                      \
    DOUBLE(v2_y, 3, zw)                                                                                      \
    DOUBLE(v2_z, 4, xy)                                                                                      \
    UINT(number, 4, z) /* within its body */                                                                 \
    UINT(shade, 4, w)  /* for a shared mesh: the group */                                                    \
    UINT(body, 5, x)

/* How a ray is transformed to the space of an instance's tree, and how much wider boxes are there. */
#define ENTRY_WORDS   4
#define ENTRY64_WORDS 8
#define ENTRY_FIELDS(REAL3, REAL, FLOAT3, FLOAT, UINT)                                                       \
    REAL3(row_x, 0, 0)                                                                                       \
    REAL(offset_x, 0, w, 1, zw)                                                                              \
    REAL3(row_y, 1, 2)                                                                                       \
    REAL(offset_y, 1, w, 3, zw)                                                                              \
    REAL3(row_z, 2, 4)                                                                                       \
    REAL(offset_z, 2, w, 5, zw)                                                                              \
    REAL(reach, 3, x, 6, xy)  /* flat: how much wider the boxes of flattened triangles are */                \
    REAL(unit, 3, y, 6, zw)   /* error of the map, as a fraction of the ray's largest coordinate */          \
    REAL(margin, 3, z, 7, xy) /* for any ray, in the tree's space */                                         \
    REAL(edge, 3, w, 7, zw)   /* flat: no edge of the mesh is longer */

/* How the triangles of a mesh and their normals become those of a body: as PLACED, after the words of ENTRY.
 */
#define INSTANCE_WORDS 12
#define INSTANCE_FIELDS(DOUBLE, UINT)                                                                        \
    DOUBLE(x_x, 0, xy)                                                                                       \
    DOUBLE(x_y, 0, zw)                                                                                       \
    DOUBLE(x_z, 1, xy)                                                                                       \
    DOUBLE(x_offset, 1, zw)                                                                                  \
    DOUBLE(y_x, 2, xy)                                                                                       \
    DOUBLE(y_y, 2, zw)                                                                                       \
    DOUBLE(y_z, 3, xy)                                                                                       \
    DOUBLE(y_offset, 3, zw)                                                                                  \
    DOUBLE(z_x, 4, xy)                                                                                       \
    DOUBLE(z_y, 4, zw)                                                                                       \
    DOUBLE(z_z, 5, xy)                                                                                       \
    DOUBLE(z_offset, 5, zw)                                                                                  \
    UINT(first_item, 6, x) /* added to a place in TRIANGLES to get an item, modulo 2^32 */                   \
    UINT(first_number, 6, y)                                                                                 \
    UINT(flags, 6, z)                                                                                        \
    UINT(body, 6, w)                                                                                         \
    DOUBLE(turn_x_x, 7, xy)                                                                                  \
    DOUBLE(turn_x_y, 7, zw)                                                                                  \
    DOUBLE(turn_x_z, 8, xy)                                                                                  \
    DOUBLE(turn_y_x, 8, zw)                                                                                  \
    DOUBLE(turn_y_y, 9, xy)                                                                                  \
    DOUBLE(turn_y_z, 9, zw)                                                                                  \
    DOUBLE(turn_z_x, 10, xy)                                                                                 \
    DOUBLE(turn_z_y, 10, zw)                                                                                 \
    DOUBLE(turn_z_z, 11, xy)                                                                                 \
    UINT(shades, 11, z) /* where its groups' shades begin, counted in components */

#define SPHERE_WORDS   2
#define SPHERE64_WORDS 3
#define SPHERE_FIELDS(REAL3, REAL, FLOAT3, FLOAT, UINT)                                                      \
    REAL3(center, 0, 0)                                                                                      \
    REAL(radius, 0, w, 1, zw)                                                                                \
    UINT(body, 1, x, 2, x)                                                                                   \
    UINT(shade, 1, y, 2, y) /* material and flags */

/* A cylinder or cone, and, in scenes that have one, also a sphere, whose record this begins with. The base is
   the narrower of its two ends: so no number in its radius cancels another. */
#define FRUSTUM_WORDS   3
#define FRUSTUM64_WORDS 6
#define FRUSTUM_FIELDS(REAL3, REAL, FLOAT3, FLOAT, UINT)                                                     \
    REAL3(base, 0, 0)                                                                                        \
    REAL(radius, 0, w, 1, zw) /* at the base */                                                              \
    UINT(body, 1, x, 2, x)                                                                                   \
    UINT(shade, 1, y, 2, y)  /* material and flags */                                                        \
    UINT(number, 1, z, 2, z) /* as of a triangle: which of two at the same distance is seen */               \
    REAL(slope, 1, w, 5, xy) /* by how much the radius grows along the axis; not negative */                 \
    REAL3(axis, 2, 3)        /* unit, away from the base */                                                  \
    REAL(height, 2, w, 4, zw)

#define NORMAL_WORDS                                    1
#define NORMAL64_WORDS                                  2
#define NORMAL_FIELDS(REAL3, REAL, FLOAT3, FLOAT, UINT) REAL3(unit, 0, 0)

#define BODY_WORDS   4
#define BODY64_WORDS 7
#define BODY_FIELDS(REAL3, REAL, FLOAT3, FLOAT, UINT)                                                        \
    UINT(first_triangle, 0, x, 0, x)                                                                         \
    UINT(normal_base, 0, y, 0, y)                                                                            \
    UINT(instance, 0, z, 0, z) /* whose mesh has the normals; 0: they are the body's own */                  \
    UINT(medium, 0, w, 0, w)   /* as MEDIUM_BITS says; 0: it is none */                                      \
    REAL3(row_x, 1, 1)         /* for a parallelogram: the lengths of its edges */                           \
    REAL(offset_x, 1, w, 2, zw)                                                                              \
    REAL3(row_y, 2, 3)                                                                                       \
    REAL(offset_y, 2, w, 4, zw)                                                                              \
    REAL3(row_z, 3, 5)                                                                                       \
    REAL(offset_z, 3, w, 6, zw)

#define MATERIAL_WORDS   7
#define MATERIAL64_WORDS 8
#define MATERIAL_FIELDS(REAL3, REAL, FLOAT3, FLOAT, UINT)                                                    \
    FLOAT(diffuse_weight, 0, x, 0, x)                                                                        \
    FLOAT(specular_weight, 0, y, 0, y)                                                                       \
    FLOAT(reflection, 0, z, 0, z)                                                                            \
    FLOAT(refraction, 0, w, 0, w)                                                                            \
    FLOAT3(diffuse, 1, 1)                                                                                    \
    FLOAT(specular_exponent, 1, w, 1, w)                                                                     \
    FLOAT3(specular, 2, 2)                                                                                   \
    REAL(refractive_index, 2, w, 4, xy)                                                                      \
    FLOAT3(diffuse_odd, 3, 3) /* colour of the checker's odd cells */                                        \
    REAL(cell, 3, w, 4, zw)   /* 1: no checker */                                                            \
    FLOAT3(absorption, 4, 5)  /* per flat unit: exp(-absorption * way) of light is left */                   \
    UINT(fresnel, 4, w, 5, w)                                                                                \
    FLOAT3(emission, 5, 6)                                                                                   \
    FLOAT(alpha, 5, w, 6, w) /* of a rough surface */                                                        \
    FLOAT3(mirror, 6, 7)     /* times the mirrored light; of a metal straight on */                          \
    UINT(metal, 6, w, 7, w)

/* How a material shows an image; the rows map a surface's coordinates (u, v, 1) to the image's. */
#define PAINT_WORDS   3
#define PAINT64_WORDS 5
#define PAINT_FIELDS(REAL3, REAL, FLOAT3, FLOAT, UINT)                                                       \
    UINT(levels, 0, x, 0, x) /* the word of the first; 0: no image */                                        \
    UINT(level_count, 0, y, 0, y)                                                                            \
    UINT(flags, 0, z, 0, z)                                                                                  \
    UINT(table, 0, w, 0, w) /* of decoded values; 0: values are used as they are */                          \
    REAL3(row_u, 1, 1)                                                                                       \
    REAL3(row_v, 2, 3)

/* A spot light gives full light where `open` - (1 - cosine to its axis) times `rate` is 1 or more, and none
   from 0 down. */
#define LIGHT_WORDS   3
#define LIGHT64_WORDS 5
#define LIGHT_FIELDS(REAL3, REAL, FLOAT3, FLOAT, UINT)                                                       \
    REAL3(place, 0, 0)                                                                                       \
    UINT(flags, 0, w, 1, z)                                                                                  \
    FLOAT3(emission, 1, 2)                                                                                   \
    FLOAT(rate, 1, w, 2, w)                                                                                  \
    REAL3(axis, 2, 3) /* unit, the way its light goes */                                                     \
    REAL(open, 2, w, 4, zw)

/* Of a light with extent, each light having one after all the words of LIGHT; in scenes that have such a
 * light. */
#define EXTENT_WORDS   3
#define EXTENT64_WORDS 6
#define EXTENT_FIELDS(REAL3, REAL, FLOAT3, FLOAT, UINT)                                                      \
    REAL3(edge_u, 0, 0)       /* of a panel, whose middle is the light's place */                            \
    REAL(radius, 0, w, 1, zw) /* of a sphere */                                                              \
    REAL3(edge_v, 1, 2)                                                                                      \
    REAL(gap, 1, w, 3, zw)         /* of a disc: 1 - cosine of its half angle */                             \
    REAL3(outward, 2, 4)           /* of a panel: unit */                                                    \
    REAL(before_body, 2, w, 5, zw) /* for a sphere that is also a body's: how far from it shadow rays end */

/* A light that rays see, from the frame's seen_table on. */
#define SEEN_WORDS   5
#define SEEN64_WORDS 9
#define SEEN_FIELDS(REAL3, REAL, FLOAT3, FLOAT, UINT)                                                        \
    REAL3(place, 0, 0)      /* its middle; of a disc the unit vector to it */                                \
    REAL(size, 0, w, 1, zw) /* of a sphere the radius; of a disc the sine of its half angle */               \
    REAL3(outward, 1, 2)    /* of a panel: unit */                                                           \
    UINT(flags, 1, w, 3, z) /* as of LIGHT */                                                                \
    REAL3(along_u, 2, 4)    /* of a panel: from its middle, times these, a place is half an edge away */     \
    UINT(light, 2, w, 3, w) /* which of the scene's it is */                                                 \
    REAL3(along_v, 3, 6)                                                                                     \
    FLOAT3(radiance, 4, 8)

#endif
