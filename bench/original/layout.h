/* What the baseline's kernel reads beside shaders/gpu_scene.h; compiled by C and by GLSL. */
#ifndef GLINT_BENCH_ORIGINAL_LAYOUT_H
#define GLINT_BENCH_ORIGINAL_LAYOUT_H

/* Bindings that the traced scene leaves free. BINDING_TRIANGLES holds the same records, but in file order. */
#define BINDING_BOXES      13
#define BINDING_RECTANGLES 14

/* Box, 2 words: lower x,y,z and the first of its triangles; upper x,y,z and how many there are. */
#define BOX_WORDS     2
#define BOX_TRIANGLES 64

/* Rectangle, 3 words: corner and material; edge_u and its length in scene units; edge_v likewise. */
#define RECTANGLE_WORDS 3

/* The word behind a pixel's colour: whether the device ended its loops too early. */
#define PIXEL_WHOLE 0u
#define PIXEL_CUT   1u

/* Specialization constants behind those of shaders/frame.h. */
#define CONSTANT_BOXES      (CONSTANT_COUNT + 0)
#define CONSTANT_RECTANGLES (CONSTANT_COUNT + 1)
#define CONSTANT_DEPTH      (CONSTANT_COUNT + 2) /* rays beyond this level see the background */
#define CONSTANT_EPSILON    (CONSTANT_COUNT + 3) /* a float: how far from a surface its rays start */
#define ORIGINAL_CONSTANTS  (CONSTANT_COUNT + 4)

#endif
