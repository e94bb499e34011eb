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
   Slots are octants: bits 4, 2, 1 of the slot are set where the child lies on the upper side in x, y, z. A
   ray whose direction is negative in an axis has that axis' bit in `octant`; slot ^ octant counts upwards
   about front to back.
   Child boxes are decoded conservatively as t = (p - o)/d + q * (2^e/d), and the far distance is multiplied
   by BOX_FAR_SCALE: 2 gamma(4) for the rounding of the near and far distance (Ize 2013) and as much again
   for that of a watertight hit, whose vertices are rounded after the origin is subtracted, u = 2^-24. */
#define BOX_FAR_SCALE 1.00000095367431640625 /* 1 + 16 u */

/* Leaf items of the triangle tree: `number` counts triangles (bodies in order, triangles in file order;
   spheres come before and are not counted; a cone counts as one); `shade` holds the material in its low 24
   bits, and flags. Leaf items of the sphere tree, which are spheres and, if the scene has any, cones, have
   TRIANGLE_SOLID always. */
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
/* How far below a disc its checker's cells are looked up, as a fraction of the height. */
#define CONE_INSET 1.52587890625e-5 /* 2^-16 */
/* How much wider a triangle's box is, as a fraction of its largest coordinate; in double precision 2^-47. */
#define TRIANGLE_BOX_PAD 3.814697265625e-6 /* 2^-18 */
/* How much shorter the edges of another corner than the first must be, as a product of both, to be preferred.
 */
#define TRIANGLE_CORNER_FACTOR 8.0

/* Normals of smooth triangles: 3 records each, in object order of v0 v1 v2 as stored in the leaf, from
   3 * (triangle number - body.first_triangle) + body.normal_base on.
   Rows of a body are those of the affine map from flat space to the coordinates of its checker; of a
   parallelogram the first one alone, with the lengths of its edges in scene units. Zero where unused. */

/* If models share a mesh (kernels compiled with INSTANCES), the triangle tree has two levels. Nodes below
   frame.top_nodes are the upper level, in flat space. Its leaves are nodes too, one per instance, with 0 in
   byte 0 of the exponents, as in no other node; the first child is the root of the instance's tree and the
   first item the instance; kernels read only these two. The other nodes of the upper tree have no items:
   their first item is a mask of the slots whose children are leaves. Below a root everything is in the space
   of that tree, which keeps its coordinates below 2. TRIANGLES holds PLACED records, NORMALS doubles. All
   triangles that are not shared are instance 0, which changes nothing. A hit item is the place of its record
   plus first_item of its instance: such numbers rise with the instances, and each instance begins a new block
   of 2^frame.instance_shift numbers. INSTANCES holds a record for each, ENTRY and INSTANCE one after the
   other; from frame.instance_table on, the instance of each block, four to a word; then the shades (material
   and flags) of groups. */
#define INSTANCE_MIRRORED 1u /* the second and third corner are exchanged */
#define INSTANCE_COPIED   2u /* instance 0: records have bodies and shades of their own */

/* Images: PAINTS begins with two records for each material, for its diffuse and its specular colour. After
   them lie, in any order, the data to which records refer by word number: for each image one word per level,
   with its first texel (counted in texels from the array's begin), width, height and the kind of its texels,
   row 0 on top, from the finest level on; for sRGB images of bytes one word for each of 256 values, decoded;
   for each mesh with coordinates COORDINATE_WORDS per triangle (u, v of each corner, in the order of the
   mesh, as floats, or as doubles in COORDINATE64_WORDS); and, from frame.coordinates_table on, four to a
   word, the first of those words for each body: it is even, plus 1 if the body's second and third corners are
   exchanged relative to the mesh's; 0: it has none. Word numbers have 32 bits: 64 GiB, of which a quarter can
   be texels of bytes. */
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

/* A medium (scene/media.h): its priority, above 0, and below it the number, from 1 on, of a material that
   fills it; the same one for all that are alike. What a path is inside (media.glsl) is kept with the number
   of the body, from 1 on, in place of the material's. */
#define MEDIUM_BITS     21
#define MEDIUM_MASK     ((1u << MEDIUM_BITS) - 1u)
#define MEDIUM_PRIORITY 1001 /* added to priorities */
#define MEDIA_MOST      8

/* The place of a light is its position, or a unit vector to it; emission over inverse square is already times
   scale squared. */
#define LIGHT_DIRECTIONAL    1u
#define LIGHT_INVERSE_SQUARE 2u
#define LIGHT_EXTENT         4u /* a sphere; with LIGHT_DIRECTIONAL a disc, with LIGHT_PANEL a panel */
#define LIGHT_PANEL          8u

/* A background that lights: where a sample looks (scene/sky.h), four numbers to a word of LIGHTS, from the
   frame's sky_table on. */

/* A scene in double precision: nodes as above; the other records are laid out as records.h says. Boxes hold
   the doubles, rounded outward. A kernel subtracts in double precision the t at which a ray enters a node
   from every t in it; the difference is rounded to single precision, with errors below 2^-13 of a cell of the
   node, and child boxes are widened by 2^-12 (bvh/encode.c). BOX_SLACK times the subtracted t covers the
   rounding of t itself and of a watertight hit, 64 units of 2^-53. */
#define BOX_SLACK 7.105427357601002e-15 /* 2^-47 */

#endif
