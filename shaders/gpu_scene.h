/* The layout of the buffers that host and kernels share; compiled by C and by GLSL.

   Every array consists of 16-byte words (C: struct gpu_word, GLSL: uvec4). A record is a fixed number of
   words; records.h lists its fields: the C side fills structs, the GLSL side reads words through one FETCH
   macro (texel fetch on CPU devices, storage buffer on GPUs). Floats are stored by their bits.
   All lengths are in flat units: scene units, minus the origin, times the flat scene's scale. */
#ifndef GLINT_SHADERS_GPU_SCENE_H
#define GLINT_SHADERS_GPU_SCENE_H

/* Descriptor bindings of set 0; unused ones get a dummy. */
#define BINDING_TRIANGLE_NODES 0
#define BINDING_TRIANGLES      1
#define BINDING_NORMALS        2
#define BINDING_SPHERE_NODES   3
#define BINDING_SPHERES        4
#define BINDING_BODIES         5
#define BINDING_MATERIALS      6
#define BINDING_LIGHTS         7
#define BINDING_BACKGROUND     8 /* uniform texel buffer, RGBA8 or RGBA32F, row 0 on top */
#define BINDING_OUTPUT         9
#define BINDING_STATE          10
#define BINDING_COUNTERS       11
#define BINDING_FRAME          12 /* uniform buffer: camera and frame parameters */
#define BINDING_INSTANCES      13 /* where the scene has any */
/* For samples traced at once. */
#define BINDING_SAMPLES 14 /* uniform buffer: their offsets in a pixel */
#define BINDING_PICTURE 15 /* three floats per pixel, by rows: sums of its samples, or NaN */
#define BINDING_SUMS    16 /* as OUTPUT, a word per slot: of the samples before */
#define BINDING_ORDER   17 /* tiles in the order of their slots: x + (y << 16) */
/* If materials have images or filtered checkers. */
#define BINDING_PAINTS 18

/* Node of the 8-wide compressed tree (Ylitie, Karras, Laine 2017, section 4.1):
   word 0: x,y,z the corner p of the node's box (float); w: byte 0..2 exponents ex,ey,ez (biased by 127),
           byte 3 the mask of children that are inner nodes
   word 1: x index of the first child node; y index of the first leaf item; z,w eight bytes `meta`:
           0 empty; inner node: 001ccccc with ccccc = 24 + slot; leaf: the top three bits hold the unary
           count of items (001, 011, 111), the low five bits the offset of the first from y
   word 2: qlo_x of children 0..3, 4..7; qlo_y
   word 3: qlo_z; qhi_x
   word 4: qhi_y; qhi_z
   Leaf items follow each other in slot order. An empty slot has qlo 255 and qhi 0. Node 0 is the root.
   A slot's number is the octant of the node that its child lies in: bits 4, 2, 1 are set for the upper side
   in x, y, z. A ray's `octant` has the bits of the axes in which its direction is negative: in ascending
   order of slot ^ octant, children follow each other roughly from front to back. Child boxes are decoded
   conservatively as t = (p - o)/d + q * (2^e/d), and the far distance is multiplied by BOX_FAR_SCALE. Of
   that, 2 gamma(4) are for the rounding of the near and far distance (Ize 2013), and as much again for that
   of a watertight hit, whose vertices are rounded after the origin is subtracted. The unit is u = 2^-24. */
#define BOX_FAR_SCALE 1.00000095367431640625 /* 1 + 16 u */

/* Leaf items of the triangle tree. `number` counts triangles: bodies in order, triangles in file order; a
   cone counts as one, spheres are not counted. `shade` holds the material in its low 24 bits, and flags. The
   leaf items of the sphere tree, spheres and cones, always have TRIANGLE_SOLID. */
#define TRIANGLE_SMOOTH       0x01000000u
#define TRIANGLE_SOLID        0x02000000u /* body is closed: refraction enters and leaves; else a thin pane */
#define TRIANGLE_HALF         0x04000000u /* half of a parallelogram */
#define TRIANGLE_SECOND_HALF  0x08000000u /* the second half: corner, corner + u + v, corner + v */
#define TRIANGLE_CHECKER      0x10000000u
#define TRIANGLE_TURNED       0x20000000u /* v1 and v2 are exchanged against the file's order */
#define TRIANGLE_CORNER_SHIFT 30          /* the corner, 0..2, whose edges give the best normal */
#define TRIANGLE_MATERIAL     0x00ffffffu
/* Flags of cones, in place of others. */
#define FRUSTUM_SHADE  0x08000000u /* it is one; else a sphere */
#define FRUSTUM_TURNED 0x01000000u /* its base is the end that the scene calls 'to' */
/* The checker on an end of a cone is looked up this far inside, as a fraction of the cone's height. */
#define CONE_INSET 1.52587890625e-5 /* 2^-16 */
/* How much wider a triangle's box is, as a fraction of its largest coordinate; in double precision 2^-47. */
#define TRIANGLE_BOX_PAD 3.814697265625e-6 /* 2^-18 */
/* Normals are made from the first corner's edges, unless the product of their lengths is more than this many
   times that of another corner. */
#define TRIANGLE_CORNER_FACTOR 8.0

/* Normals of smooth triangles: 3 records each, in the order of v0 v1 v2 as stored in the leaf, from
   3 * (triangle number - body.first_triangle) + body.normal_base on.
   The rows of a body's record are the affine map from flat space to the coordinates of its checker. Of a
   parallelogram, only the first row is used: it holds the lengths of the edges in scene units. Unused rows
   are 0. */

/* If models share a mesh (kernels compiled with INSTANCES), the triangle tree has two levels.

   The upper tree, of nodes below frame.top_nodes, is in flat space. Its leaves are nodes too, one per
   instance. Only they have 0 in byte 0 of the exponents, and kernels read only two of their fields: the first
   child is the root of the instance's tree, the first item is the instance. The other nodes of the upper tree
   have no items: their first item is a mask of the slots whose children are leaves. Below the root of an
   instance's tree everything is in the space of that tree, which keeps its coordinates below 2.

   TRIANGLES holds PLACED records, NORMALS doubles. All triangles that are not shared belong to instance 0,
   whose map changes nothing. The item that a ray hits is the place of its record plus first_item of its
   instance. Each instance has a block, or several, of 2^frame.instance_shift such numbers of its own, in
   ascending order. INSTANCES holds ENTRY and INSTANCE of each instance; from frame.instance_table on, the
   instance of each block, four to a word; then the shades (material and flags) of groups, likewise. */
#define INSTANCE_MIRRORED 1u /* the second and third corner are exchanged */
#define INSTANCE_COPIED   2u /* instance 0: records have bodies and shades of their own */

/* Images: PAINTS begins with two records for each material, for its diffuse and its specular colour. After
   them come, in any order, the data that records refer to by the number of a word:
   - of each image, a word per level, the finest first: its first texel, counted in texels from the beginning
     of the array, its width, height and kind of texels; row 0 is on top
   - of an sRGB image of bytes, the decoded values of the 256 bytes, a word each
   - of each mesh with coordinates, u and v of each corner, in the order of the mesh: per triangle
     COORDINATE_WORDS of floats, or COORDINATE64_WORDS of doubles
   - from frame.coordinates_table on, four to a word, the first of those words for each body. It is even; 1 is
     added if the second and third corners of the body are exchanged against the mesh's; 0: it has none.
   The texels are last. Their numbers have 32 bits, and a word may hold four of them: so the array has at most
   2^30 words, which are 16 GiB. */
#define COORDINATE_WORDS   2
#define COORDINATE64_WORDS 3
/* Kinds of texels: a word holds 2^kind texels. */
#define TEXELS_FLOATS 0u /* three floats */
#define TEXELS_PACKED 1u /* three values of 21 bits, r in the lowest bits: scene/textures.c */
#define TEXELS_BYTES  2u /* three bytes, r in the lowest */
#define PAINT_NEAREST 1u
#define PAINT_AUTO    2u /* neither: bilinear */
#define PAINT_CLAMP   4u
#define PAINT_MIRROR  8u  /* neither: repeat */
#define PAINT_SOFT    16u /* the material's checker is filtered */

/* A medium (scene/media.h): in the high bits its priority, above 0; in the low ones the number, from 1 on, of
   a material that fills it, the same one for all materials that are alike. What a path is inside (media.glsl)
   is kept with the number of the body, from 1 on, in the low bits. */
#define MEDIUM_BITS     21
#define MEDIUM_MASK     ((1u << MEDIUM_BITS) - 1u)
#define MEDIUM_PRIORITY 1001 /* added to priorities */
#define MEDIA_MOST      8

/* The place of a light is its position, or with LIGHT_DIRECTIONAL a unit vector to it. With
   LIGHT_INVERSE_SQUARE the emission is already multiplied by the square of the scale. */
#define LIGHT_DIRECTIONAL    1u
#define LIGHT_INVERSE_SQUARE 2u
#define LIGHT_EXTENT         4u /* a sphere; with LIGHT_DIRECTIONAL a disc, with LIGHT_PANEL a panel */
#define LIGHT_PANEL          8u
#define LIGHT_SPOT           16u /* it shines into a cone */

/* A background that lights: where a sample looks (scene/sky.h), four numbers to a word of LIGHTS, from the
   frame's sky_table on. */

/* A scene in double precision: nodes as above; the other records are laid out as records.h says. Boxes
   contain the doubles: they are rounded outward. A kernel subtracts the t at which a ray enters a node from
   every t in it. It subtracts in double precision and rounds the difference to single, with errors below
   2^-13 of a cell of the node; so child boxes are widened by 2^-12 of a cell (bvh/encode.c). BOX_SLACK times
   the subtracted t covers the rounding of t itself and of a watertight hit, 64 units of 2^-53. */
#define BOX_SLACK 7.105427357601002e-15 /* 2^-47 */

#endif
