/* What hits.comp writes for each pixel (scene/hits.h), and which of a pixel's rays a dispatch traces;
   compiled by C and by GLSL. */
#ifndef GLINT_SHADERS_HITS_H
#define GLINT_SHADERS_HITS_H

/* Words of a slot in OUTPUT. A number of the kernel's precision takes two components: a double's halves, the
   lower first, or a float's bits and 0.
   0: t, b1 of the first ray's hit
   1: its b2; leaf item; number as in FAULT_NUMBER (HITS_NOTHING: none)
   2: lights that would add something; those that do; numbers of what the mirrored and the refracted ray hit
      (HITS_NOTHING: not sent, or nothing)
   3: shading normal as bits of floats; rays that did not end
   4: diffuse colour times its weight as bits of floats; HITS_REFLECTS, HITS_REFRACTS: those rays are sent */
#define HITS_WORDS    5
#define HITS_REFLECTS 1u
#define HITS_REFRACTS 2u
#define HITS_NOTHING  0xffffffffu

/* dispatch.resume: the camera's ray, which must come first; the mirrored one; the refracted one; the shadow
   ray to light i. One kind a dispatch, so that each ray has all of ITERATION_LIMIT to itself. */
#define HITS_FIRST      0
#define HITS_MIRRORED   1
#define HITS_REFRACTED  2
#define HITS_LIGHTS     3
#define HITS_LIGHTS_MAX 32

#endif
