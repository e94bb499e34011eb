/* What a scene requires of the tracer, one bit each; compiled by C and by GLSL (so only macros).
   The set is an OR over what the scene uses (grammar/ir_features.h) and the meshes' own materials; it becomes
   specialization constants, so that a scene pays only for what it requires.

   FEATURE_TABLE has a row for each, in the order of the bits: whatever lists features walks it. C has one set
   of 64 bits (uint64_t). GLSL, where not every device has integers as long, has two words: the first is
   tested as a number, the second as the y of a vector, so that no bit is looked for in the wrong word. */
#ifndef GLINT_SHADERS_FEATURES_H
#define GLINT_SHADERS_FEATURES_H

/* ROW(its macro without FEATURE_, its name for users) */
#define FEATURE_TABLE(ROW)                                                                                   \
    ROW(TRIANGLES, triangles)                                                                                \
    ROW(SPHERES, spheres)                                                                                    \
    ROW(DIFFUSE, diffuse)                                                                                    \
    ROW(SPECULAR, specular)                                                                                  \
    ROW(REFLECTION, reflection)                                                                              \
    ROW(REFRACTION, refraction)                                                                              \
    ROW(SHADOWS, shadows)                                                                                    \
    ROW(SMOOTH, smooth)                                                                                      \
    ROW(CHECKER, checker)                                                                                    \
    ROW(POINT_LIGHT, point_light)                                                                            \
    ROW(DIRECTION_LIGHT, direction_light)                                                                    \
    ROW(INVERSE_SQUARE, inverse_square)                                                                      \
    ROW(BACKGROUND_IMAGE, background_image)                                                                  \
    ROW(DEPTH_BLACK, depth_black)                                                                            \
    ROW(SLICES, slices)                                                                                      \
    ROW(COUNTERS, counters)                                                                                  \
    ROW(LONG_RAYS, long_rays)                                                                                \
    ROW(MANY_LIGHTS, many_lights)                                                                            \
    ROW(MEDIA, media)                                                                                        \
    ROW(ATTENUATION, attenuation)                                                                            \
    ROW(FRESNEL, fresnel)                                                                                    \
    ROW(CLEAR_SHADOWS, clear_shadows)                                                                        \
    ROW(BEGINS, begins)                                                                                      \
    ROW(SOFT_LIGHT, soft_light)                                                                              \
    ROW(AMBIENT, ambient)                                                                                    \
    ROW(OCCLUSION, occlusion)                                                                                \
    ROW(FOOTPRINT, footprint)                                                                                \
    ROW(EMISSION, emission)                                                                                  \
    ROW(ROUGHNESS, roughness)                                                                                \
    ROW(CAMERA, camera)                                                                                      \
    ROW(TEXTURES, textures)                                                                                  \
    ROW(SKY_LIGHT, sky_light)                                                                                \
    ROW(SEEN_LIGHT, seen_light)                                                                              \
    ROW(CONES, cones)                                                                                        \
    ROW(TURNED, turned)                                                                                      \
    ROW(REFLECTION_COLOR, reflection_color)                                                                  \
    ROW(SPOT, spot)
#define FEATURE_COUNT 37

#ifdef __STDC_VERSION__
#include <stdint.h>
#define FEATURE_FIRST(n)  (UINT64_C(1) << (n))
#define FEATURE_SECOND(n) (UINT64_C(1) << (32 + (n)))
#else
#define FEATURE_FIRST(n)  (1u << n)
#define FEATURE_SECOND(n) uvec2(0u, 1u << n)
#endif

#define FEATURE_TRIANGLES        FEATURE_FIRST(0)
#define FEATURE_SPHERES          FEATURE_FIRST(1)
#define FEATURE_DIFFUSE          FEATURE_FIRST(2) /* a diffuse weight that is not 0 */
#define FEATURE_SPECULAR         FEATURE_FIRST(3) /* a specular weight that is not 0 */
#define FEATURE_REFLECTION       FEATURE_FIRST(4)
#define FEATURE_REFRACTION       FEATURE_FIRST(5)
#define FEATURE_SHADOWS          FEATURE_FIRST(6)
#define FEATURE_SMOOTH           FEATURE_FIRST(7) /* interpolated vertex normals */
#define FEATURE_CHECKER          FEATURE_FIRST(8)
#define FEATURE_POINT_LIGHT      FEATURE_FIRST(9)
#define FEATURE_DIRECTION_LIGHT  FEATURE_FIRST(10)
#define FEATURE_INVERSE_SQUARE   FEATURE_FIRST(11)
#define FEATURE_BACKGROUND_IMAGE FEATURE_FIRST(12)
#define FEATURE_DEPTH_BLACK      FEATURE_FIRST(13) /* rays cut at max_depth see 0, not the background */
#define FEATURE_SLICES           FEATURE_FIRST(14) /* paths may be saved and resumed in a later dispatch */
#define FEATURE_COUNTERS         FEATURE_FIRST(15) /* count rays for --stats */
#define FEATURE_LONG_RAYS        FEATURE_FIRST(16) /* a ray may be saved and resumed in the middle of a tree */
#define FEATURE_MANY_LIGHTS      FEATURE_FIRST(17) /* the sum over lights keeps what rounding drops */
#define FEATURE_MEDIA            FEATURE_FIRST(18) /* rays know the bodies that they are inside */
#define FEATURE_ATTENUATION      FEATURE_FIRST(19) /* of light on its way inside */
#define FEATURE_FRESNEL          FEATURE_FIRST(20)
#define FEATURE_CLEAR_SHADOWS    FEATURE_FIRST(21) /* light shines through what refracts */
#define FEATURE_BEGINS           FEATURE_FIRST(22) /* paths begin; they are saved where a ray is open */
#define FEATURE_SOFT_LIGHT       FEATURE_FIRST(23) /* a light with extent */
#define FEATURE_AMBIENT          FEATURE_FIRST(24)
#define FEATURE_OCCLUSION        FEATURE_FIRST(25) /* of ambient light */
#define FEATURE_FOOTPRINT        FEATURE_FIRST(26) /* paths carry how wide a pixel is where their rays are */
#define FEATURE_EMISSION         FEATURE_FIRST(27)
#define FEATURE_ROUGHNESS        FEATURE_FIRST(28)
#define FEATURE_CAMERA           FEATURE_FIRST(29) /* other than a pinhole in perspective */
#define FEATURE_TEXTURES         FEATURE_FIRST(30) /* images on surfaces */
#define FEATURE_SKY_LIGHT        FEATURE_FIRST(31) /* the background lights */
#define FEATURE_SEEN_LIGHT       FEATURE_SECOND(0) /* lights that rays see */
#define FEATURE_CONES            FEATURE_SECOND(1) /* cylinders and cones */
#define FEATURE_TURNED           FEATURE_SECOND(2) /* spheres whose images are turned */
#define FEATURE_REFLECTION_COLOR FEATURE_SECOND(3) /* mirrors with a colour of their own, and metals */
#define FEATURE_SPOT             FEATURE_SECOND(4) /* a light that shines into a cone */
/* With any of them something with extent is sampled: rays have keys (light/points.h). */
#define FEATURE_POINTS                                                                                       \
    (FEATURE_SOFT_LIGHT | FEATURE_OCCLUSION | FEATURE_ROUGHNESS | FEATURE_CAMERA | FEATURE_SKY_LIGHT)
#ifdef __STDC_VERSION__
#define FEATURE_ALL (UINT64_MAX >> (64 - FEATURE_COUNT))
/* Features that only a scene can switch on; the renderer sets the others. */
#define FEATURE_SCENE_MASK                                                                                   \
    (FEATURE_ALL &                                                                                           \
     ~(FEATURE_SLICES | FEATURE_COUNTERS | FEATURE_LONG_RAYS | FEATURE_MANY_LIGHTS | FEATURE_BEGINS))
/* Of those, what a kernel may have whether the scene asks for it or not; with cones the records of spheres
   have another layout, and only of turned spheres the axes are known. */
#define FEATURE_GENERAL (FEATURE_SCENE_MASK & ~(FEATURE_CONES | FEATURE_TURNED))
#endif

#endif
