/* What the shaders of the vendor's pipeline read; compiled by C and by GLSL. Places are relative to glint's
   origin, in scene units. */
#ifndef GLINT_BENCH_PIPELINE_LAYOUT_H
#define GLINT_BENCH_PIPELINE_LAYOUT_H

#define PIPELINE_SCENE  0 /* the acceleration structure */
#define PIPELINE_OUTPUT 1 /* four floats a pixel, rows from the top */
#define PIPELINE_FRAME  2 /* uniform: below */
#define PIPELINE_LIGHTS                                                                                      \
    3 /* two words of four floats: place, 1 where it is a direction; emission, 1 where it falls off */
#define PIPELINE_VERTICES  4 /* three floats each */
#define PIPELINE_INDICES   5 /* three a triangle */
#define PIPELINE_MATERIALS 6 /* of each triangle */
#define PIPELINE_COLORS    7 /* of each material: four floats, the diffuse colour times its weight */
#define PIPELINE_BINDINGS  8

/* Words of four floats in the uniform buffer. */
#define FRAME_POSITION   0
#define FRAME_FORWARD    1
#define FRAME_RIGHT      2 /* times tan(fov/2) and W/H */
#define FRAME_UP         3 /* times tan(fov/2) */
#define FRAME_BACKGROUND 4
#define FRAME_COUNTS     5 /* lights; 1 where they cast shadows */
#define FRAME_WORDS      6

#endif
