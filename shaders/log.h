/* What log.comp reads and writes for each ray that it is given; compiled by C and by GLSL. Numbers of the
   kernel's precision take two components (bits.glsl); three of them take two words, with two to spare. */
#ifndef GLINT_SHADERS_LOG_H
#define GLINT_SHADERS_LOG_H

/* STATE, a ray: its origin, LOG_BLIND or 0, item of the triangle that it leaves; its direction, unit, bound
   of the origin's error; b1, b2 of the place on that triangle (ray_start); its cone; what it is
   inside (media.glsl); key of the ray from whose hit it leaves, and how (points.h). */
#define LOG_RAY_WORDS 9
#define LOG_CONE      5
#define LOG_INSIDE    6
#define LOG_KEY       8
#define LOG_BLIND     1u /* it is not traced, and sees the background */

/* OUTPUT, a ray:
   0: t, b1 of its hit
   1: its b2; leaf item (LOG_NOTHING: none); number as in FAULT_NUMBER
   2: lights below 32 that would add something; those that do; LOG_ flags, or of a ray that hits nothing which
   light it sees, from 1 on; rays that did not end
   3: sum over the lights, the light that is seen, or the background, as bits of floats; material
   4: point; weights of the mirrored and of the refracted ray as bits of floats
   6: geometric normal   8: shading normal; in what they leave of 7 and 9, what rounding dropped of the sum
   10: the mirrored ray as in STATE, without what it is inside
   16: the refracted ray
   22: what is left of light on the way to the surface, as bits of floats; key of the ray   23: what the
   refracted ray is inside   25: what the mirrored ray keeps of each channel, as bits of floats */
#define LOG_REFLECTED 10
#define LOG_REFRACTED 16
#define LOG_LEFT      22
#define LOG_AFTER     23
#define LOG_COLOR     25
#define LOG_WORDS     26
#define LOG_NOTHING   0xffffffffu
#define LOG_ENTERS    1u
#define LOG_TOTAL     2u /* the ray would be refracted, and is turned back */
#define LOG_PASSES    4u /* it goes straight on, unseen */
#define LOG_NESTED    8u /* it would be inside too many media */

/* What log.comp reads of `dispatch`: first_sample, the sample; read_list and pending_base, x and y of its
   pixel; tile_count, the number of rays; and resume, which says what to do. */
#define LOG_CAMERA 0 /* write the camera's ray as the first ray */
#define LOG_FOLLOW 1 /* trace the rays and make the surfaces that they hit */
#define LOG_LIGHTS 2 /* plus the number of a light: send a shadow ray to it from each surface */

#endif
