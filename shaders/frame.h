/* What the host passes to the kernel about one frame (uniform buffer) and one dispatch (push constants), and
   the layout of what the kernel keeps between dispatches; compiled by C and by GLSL. */
#ifndef GLINT_SHADERS_FRAME_H
#define GLINT_SHADERS_FRAME_H

/* Uniform buffer of BINDING_FRAME. A vector and the scalar after it fill 16 bytes. Lengths are flat. */
#define FRAME_FIELDS(VECTOR, FLOAT, UINT)                                                                    \
    VECTOR(camera_position)                                                                                  \
    UINT(light_count)                                                                                        \
    VECTOR(camera_forward)                                                                                   \
    FLOAT(min_weight)                                                                                        \
    VECTOR(camera_right) /* times tan(fov/2) and W/H */                                                      \
    UINT(max_depth)                                                                                          \
    VECTOR(camera_up)           /* times tan(fov/2) */                                                       \
    UINT(path_segments)         /* most rays of a sample */                                                  \
    VECTOR(background)          /* colour times intensity */                                                 \
    FLOAT(background_intensity) /* of the image */                                                           \
    VECTOR(ambient)             /* colour times intensity */                                                 \
    FLOAT(occlusion)            /* of ambient light: how near things must be to block it; flat */            \
    UINT(background_width)                                                                                   \
    UINT(background_height)                                                                                  \
    FLOAT(background_cos) /* of the background's rotation */                                                 \
    FLOAT(background_sin)                                                                                    \
    UINT(width) /* of what is drawn, in pixels */                                                            \
    UINT(height)                                                                                             \
    UINT(tiles_x)                                                                                            \
    UINT(run_tiles) /* tiles in a run of adjacent ones */                                                    \
    UINT(runs)                                                                                               \
    UINT(run_step) /* run k is the picture's run k * run_step mod runs */                                    \
    UINT(sphere_count)                                                                                       \
    UINT(slice_iterations) /* past these a path is saved at the next ray boundary */                         \
    UINT(features)         /* of the scene: they decide among what the mask makes possible */                \
    UINT(top_nodes)        /* of instances: gpu_scene.h */                                                   \
    UINT(instance_table)                                                                                     \
    UINT(instance_shift)                                                                                     \
    UINT(point_bits) /* bits of a pixel's sample numbers; 0: its one sample is the middle */                 \
    UINT(inside_0)   /* what the camera is inside, last entered first (media.glsl) */                        \
    UINT(inside_1)                                                                                           \
    UINT(inside_2)                                                                                           \
    UINT(inside_3)                                                                                           \
    UINT(inside_4)                                                                                           \
    UINT(inside_5)                                                                                           \
    UINT(inside_6)                                                                                           \
    UINT(inside_7)                                                                                           \
    UINT(coordinates_table) /* gpu_scene.h */                                                                \
    FLOAT(footprint)        /* how much wider a pixel gets for each length along the camera's view; of       \
                               parallel rays its width, of other projections its angle */                    \
    UINT(projection)        /* PROJECTION_: what camera_right and camera_up are multiplied by */             \
    FLOAT(lens_radius)      /* 0: a pinhole */                                                               \
    FLOAT(focus)                                                                                             \
    UINT(sky_table)   /* gpu_scene.h */                                                                      \
    UINT(sky_width)   /* cells of a row */                                                                   \
    UINT(sky_rows)    /* 0: the background does not light */                                                 \
    UINT(sky_stride)  /* from one row's words to the next */                                                 \
    UINT(whole_width) /* of the picture that the camera sees: of what is drawn, or of what that is a part */ \
    UINT(whole_height)                                                                                       \
    UINT(first_x) /* with CONSTANT_PART: the pixel of the whole that is drawn first */                       \
    UINT(first_y)                                                                                            \
    UINT(seen_table) /* of lights that rays see: records.h */                                                \
    UINT(seen_count)

/* The camera and the background's rotation again, after those fields, for kernels in double precision. */
#define FRAME_DOUBLE_FIELDS(DOUBLE)                                                                          \
    DOUBLE(double_position_x)                                                                                \
    DOUBLE(double_position_y)                                                                                \
    DOUBLE(double_position_z)                                                                                \
    DOUBLE(double_forward_x)                                                                                 \
    DOUBLE(double_forward_y)                                                                                 \
    DOUBLE(double_forward_z)                                                                                 \
    DOUBLE(double_right_x)                                                                                   \
    DOUBLE(double_right_y)                                                                                   \
    DOUBLE(double_right_z)                                                                                   \
    DOUBLE(double_up_x)                                                                                      \
    DOUBLE(double_up_y)                                                                                      \
    DOUBLE(double_up_z)                                                                                      \
    DOUBLE(double_background_cos)                                                                            \
    DOUBLE(double_background_sin)

/* camera_right and camera_up times, besides W/H in right: */
#define PROJECTION_PERSPECTIVE  0u /* tan(fov/2) */
#define PROJECTION_ORTHOGRAPHIC 1u /* half the height of the view */
#define PROJECTION_FISHEYE      2u /* quarter turns of the vertical field's half */
#define PROJECTION_PANORAMA     3u /* nothing, and without W/H */

/* Push constants. */
#define DISPATCH_FIELDS(FLOAT, UINT)                                                                         \
    UINT(tile_begin)   /* first tile of the portion */                                                       \
    UINT(tile_count)   /* of the portion; 64 slots each */                                                   \
    UINT(grid_width)   /* workgroups in x */                                                                 \
    UINT(sample_index) /* samples whose sum lies in the output */                                            \
    FLOAT(offset_x)    /* of the sample inside the pixel */                                                  \
    FLOAT(offset_y)                                                                                          \
    UINT(path_begin) /* slots of this dispatch, or places in the list to read */                             \
    UINT(path_end)                                                                                           \
    UINT(resume)       /* 0: paths begin; else the number of saved ones that go on, or RESUME_COUNTED */     \
    UINT(read_list)    /* which of the two lists of saved slots to read; the other is written */             \
    UINT(pending_base) /* of the list written: its counter when the list was begun */                        \
    UINT(places)       /* for saved paths; one per slot unless samples are traced at once */                 \
    UINT(samples)      /* traced at once: path k * slots + s is sample k of slot s */                        \
    UINT(restarts)     /* 1: starts the listed paths that found no place before */                           \
    UINT(place_base)   /* value of COUNTER_PLACES when all places were free */                               \
    UINT(restart_base) /* value of COUNTER_RESTARTS when that list was begun */                              \
    UINT(shows)        /* 1: a path is its pixel's only one, and writes the pixel */                         \
    UINT(spread)       /* one in this many invocations has a path; 0: each */                                \
    UINT(read_base)    /* with RESUME_COUNTED: as pending_base, of the list read */                          \
    UINT(first_sample) /* number of the dispatch's first sample */                                           \
    UINT(listed) /* with CONSTANT_LISTED: number of paths that begin, by the list after the two others */

/* Saved paths go on, path_end at most: only their counter knows how many, because the previous dispatch of
   the same submission saved them. `spread` is then an upper bound. */
#define RESUME_COUNTED 0xffffffffu

/* A tile has 8 x 8 pixels, a workgroup has one tile. */
#define TILE_SIDE   8
#define TILE_PIXELS 64

/* Output: one word per path: the sum of the samples' r g b, and a fault. Fault: the kind in the two top bits,
   below it the number of what was hit last: spheres by body, then triangles and cones from sphere_count on;
   all ones if nothing was hit. Samples traced at once have one word each; resolve.comp adds them up. */
#define FAULT_NUMBER 0x3fffffffu
#define FAULT_NESTED                                                                                         \
    0x3ffffffeu /* with FAULT_NOT_FINITE: a ray would be inside more than MEDIA_MOST media                   \
                 */
#define FAULT_KIND_SHIFT 30
#define FAULT_NONE       0u
#define FAULT_NOT_FINITE 1u /* a value on the way was infinite or NaN; the sample counts as 0 */
#define FAULT_SEGMENTS   2u /* the sample exceeded path_segments */
#define FAULT_ITERATIONS 3u /* one ray alone exceeded ITERATION_LIMIT; with FEATURE_LONG_RAYS none does */

/* State of a path, word k of slot s at k * slots + s: ray origin, throughput; direction, depth; radiance,
   segments; sum over lights, light; hit t, b1, b2, item; number of hit, stack size, kind of ray, spare; what
   the ray leaves: error of its start, b1, b2, item: kept between dispatches; then three words for each
   waiting refracted ray: origin, throughput; direction, depth; what it leaves. For paths traced at once,
   which have places instead of slots, the spare word is the path's number. In double precision places,
   directions, t, b1 and b2 take two numbers each: path_words.glsl has the order. With FEATURE_FOOTPRINT a
   path and each waiting refracted ray have one more word, for the ray's cone. With FEATURE_LONG_RAYS the
   words of long_rays.glsl lie between the two. */
#define STATE_WORDS         7
#define STACK_ENTRY_WORDS   3
#define STATE64_WORDS       10
#define LONG_RAY_WORDS      4 /* then two entries of a tree's stack per word */
#define STACK64_ENTRY_WORDS 6
/* With FEATURE_MEDIA, for a path and for each waiting ray: what it is inside, and what is left of each
   channel of its light; with FEATURE_REFLECTION_COLOR alone only that; with FEATURE_CLEAR_SHADOWS then, for a
   path, a shadow ray on its way (path_words.glsl). */
#define MEDIA_WORDS 3
#define TINT_WORDS  1
#define SHINE_WORDS 7
/* With FEATURE_POINTS, for both: the key, after a path's words and before those of a waiting ray. */
#define KEY_WORDS 1

/* Counters, 32-bit each: those shared by all invocations, then banks of those of FEATURE_COUNTERS, then two
   lists of slots. A workgroup counts in one bank, so workgroups rarely wait for each other. The host reads
   them after each dispatch, and sums what was added. */
#define COUNTER_LONG_RAYS 1 /* samples with FAULT_ITERATIONS */
/* For samples traced at once: places taken, and paths that found none, in lists after the two others. */
#define COUNTER_PLACES   2
#define COUNTER_RESTARTS 3
/* Entries written so far to each of the two lists of saved paths. */
#define COUNTER_PENDING 16
/* By kind of fault: its pixels; the complement of the first one's number, which is y * width + x; and its
 * word. */
#define COUNTER_FAULT_PIXELS 4
#define COUNTER_FAULT_FIRST  8
#define COUNTER_FAULT_WORD   12
#define FAULT_KINDS          4
#define COUNTER_SHARED       32
#define COUNTER_BANKS        32
#define COUNTER_BANK         32 /* words of one bank */
#define COUNTER_COUNT        (COUNTER_SHARED + COUNTER_BANKS * COUNTER_BANK)
/* In a bank. */
#define COUNTER_REFLECTED     0
#define COUNTER_REFRACTED     1
#define COUNTER_SHADOW        2
#define COUNTER_CUT_DEPTH     3  /* rays not sent at max_depth */
#define COUNTER_CUT_WEIGHT    4  /* rays not sent below min_weight */
#define COUNTER_TOTAL_REFLECT 5  /* total reflections */
#define COUNTER_NODES         6  /* nodes tested, in both trees */
#define COUNTER_ITEMS         7  /* triangles and spheres tested */
#define COUNTER_UNSEEN        8  /* crossings between equal media */
#define COUNTER_SUMS          9  /* counters before are sums, from here on they are maxima */
#define COUNTER_DEEPEST       9  /* deepest level of a ray that was traced */
#define COUNTER_LOST_DEPTH    10 /* largest weight cut at max_depth, as bits of a float */
#define COUNTER_LOST_WEIGHT   11 /* largest weight cut below min_weight, as bits of a float */
#define COUNTER_KINDS         12

/* lavapipe silently stops all loops of a vector of 8 invocations after 65535 iterations summed over the 8: an
   invocation ends its slice before its share of 8191. */
#define ITERATION_LIMIT  8000
#define SLICE_ITERATIONS 6000
#define EXACT_ITERATIONS 1500 /* of them, at most, for a ray's second search */
/* The most paths in a dispatch that counts: no sum over its invocations' counts exceeds 32 bits. */
#define COUNTED_PATHS (1 << 19)

/* Specialization constants. */
#define CONSTANT_FEATURES       0 /* the first word, and of the second: */
#define CONSTANT_MORE_FEATURES  12
#define CONSTANT_TRIANGLE_STACK 1 /* the most groups of nodes that wait */
#define CONSTANT_SPHERE_STACK   2
#define CONSTANT_PACKED_GROUPS  3 /* 1: both trees have at most 65536 nodes */
#define CONSTANT_WORKGROUP      7 /* invocations of a workgroup */
/* Of alternative kernels alone, floats: alternatives.glsl. */
#define CONSTANT_ALTERNATIVE_OFFSET   4
#define CONSTANT_ALTERNATIVE_DISTANCE 5
#define CONSTANT_ALTERNATIVE_CUT      6
#define CONSTANT_ALTERNATIVE_START    8 /* a whole number */
/* Samples are traced at once; at most this many refracted rays wait, in private memory. */
#define CONSTANT_AT_ONCE  9
#define CONSTANT_BRANCHES 10
#define CONSTANT_LISTED   11 /* paths begin by a list: render_adaptive.c */
#define CONSTANT_PART     13 /* what is drawn is a part of a larger picture */
#define CONSTANT_COUNT    14

/* Most samples of a pixel that are traced at once. */
#define SAMPLES_AT_ONCE 64

/* resolve.comp, in dispatch.read_list: adds the samples to the sums of earlier ones; or shows them all in the
   picture, and counts its faults; or finds the words of the first faults. */
#define RESOLVE_ADD  0
#define RESOLVE_SHOW 1
#define RESOLVE_FIND 2

#endif
