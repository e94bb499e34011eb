/* What a scene requires of the tracer, one bit each; compiled by C and by GLSL (so only macros).
   The mask is an OR over what the scene uses (grammar/ir_features.h) and the meshes' own materials;
   it becomes a specialization constant, so that a scene pays only for what it requires. */
#ifndef GLINT_SHADERS_FEATURES_H
#define GLINT_SHADERS_FEATURES_H

#define FEATURE_TRIANGLES        (1u << 0)
#define FEATURE_SPHERES          (1u << 1)
#define FEATURE_DIFFUSE          (1u << 2) /* a diffuse weight that is not 0 */
#define FEATURE_SPECULAR         (1u << 3) /* a specular weight that is not 0 */
#define FEATURE_REFLECTION       (1u << 4)
#define FEATURE_REFRACTION       (1u << 5)
#define FEATURE_SHADOWS          (1u << 6)
#define FEATURE_SMOOTH           (1u << 7) /* interpolated vertex normals */
#define FEATURE_CHECKER          (1u << 8)
#define FEATURE_POINT_LIGHT      (1u << 9)
#define FEATURE_DIRECTION_LIGHT  (1u << 10)
#define FEATURE_INVERSE_SQUARE   (1u << 11)
#define FEATURE_BACKGROUND_IMAGE (1u << 12)
#define FEATURE_DEPTH_BLACK      (1u << 13) /* rays cut at max_depth see 0, not the background */
#define FEATURE_SLICES           (1u << 14) /* paths may be saved and resumed in a later dispatch */
#define FEATURE_COUNTERS         (1u << 15) /* count rays for --stats */
#define FEATURE_LONG_RAYS        (1u << 16) /* a ray may be saved and resumed in the middle of a tree */
#define FEATURE_MANY_LIGHTS      (1u << 17) /* the sum over the lights keeps what rounding drops */
#define FEATURE_MEDIA            (1u << 18) /* rays know the bodies that they are inside */
#define FEATURE_ATTENUATION      (1u << 19) /* of light on its way inside */
#define FEATURE_FRESNEL          (1u << 20)
#define FEATURE_CLEAR_SHADOWS    (1u << 21) /* light shines through what refracts */
#define FEATURE_BEGINS           (1u << 22) /* paths begin; they are saved where a ray is open */
#define FEATURE_SOFT_LIGHT       (1u << 23) /* a light with extent */
#define FEATURE_AMBIENT          (1u << 24)
#define FEATURE_OCCLUSION        (1u << 25) /* of ambient light */
#define FEATURE_FOOTPRINT        (1u << 26) /* paths carry how wide a pixel is where their rays are */
#define FEATURE_EMISSION         (1u << 27)
#define FEATURE_ROUGHNESS        (1u << 28)
#define FEATURE_CAMERA           (1u << 29) /* other than a pinhole in perspective */
#define FEATURE_TEXTURES         (1u << 30) /* images on surfaces */
#define FEATURE_COUNT            31
/* With any of them something is sampled that has extent: rays have keys (light/points.h). */
#define FEATURE_POINTS (FEATURE_SOFT_LIGHT | FEATURE_OCCLUSION | FEATURE_ROUGHNESS | FEATURE_CAMERA)
/* What only a scene can switch on; the others are the renderer's. */
#define FEATURE_SCENE_MASK                                                                                   \
    (((1u << 14) - 1u) | FEATURE_MEDIA | FEATURE_ATTENUATION | FEATURE_FRESNEL | FEATURE_CLEAR_SHADOWS |     \
     FEATURE_POINTS | FEATURE_AMBIENT | FEATURE_EMISSION | FEATURE_TEXTURES | FEATURE_FOOTPRINT)

#endif
