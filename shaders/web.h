/* Of kernels for WebGPU, in place of what Vulkan has and it has not; compiled by C and by GLSL. It allows
   eight storage buffers: all read-only words lie in one, where each array begins at a word that the dispatch
   names, and push constants are a uniform buffer. Scalars follow each other in it as in Vulkan's push
   constants. */
#ifndef GLINT_SHADERS_WEB_H
#define GLINT_SHADERS_WEB_H

#define BINDING_WORDS    0
#define BINDING_DISPATCH 19

/* After DISPATCH_FIELDS. The words of bindings 0 to 8 in their order: then of the one after them. */
#define WEB_FIELDS(UINT)                                                                                     \
    UINT(begin_triangle_nodes)                                                                               \
    UINT(begin_triangles)                                                                                    \
    UINT(begin_normals)                                                                                      \
    UINT(begin_sphere_nodes)                                                                                 \
    UINT(begin_spheres)                                                                                      \
    UINT(begin_bodies)                                                                                       \
    UINT(begin_materials)                                                                                    \
    UINT(begin_lights)                                                                                       \
    UINT(begin_background)                                                                                   \
    UINT(begin_paints)                                                                                       \
    UINT(background_is_float)

#endif
