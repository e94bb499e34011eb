// What a scene means: IR and loaded files together, once, in double precision and scene units.
//
// The one list of bodies, the materials in linear colours, and the background. Flattening, the choice of
// precision, the reference and its cache, the rules about light, measuring and reports all read these;
// nothing else looks into the IR's lists of bodies for their meaning. A new kind of body is a row here and an
// element of the table. Ownership: the arena given to scene_build; IR, assets and what they point to must
// outlive the scene. Errors: where the arena ends, its guard is jumped to. Thread safety: immutable once
// made.
#ifndef GLINT_SCENE_SCENE_H
#define GLINT_SCENE_SCENE_H

#include "assets/assets.h"
#include "core/arena.h"
#include "core/vec3.h"
#include "scene/material_fields.h"

struct ir_color;
struct ir_head;
struct schema_element;

enum {
    SCENE_LEVELS_MAX = 24
};

// A face in the plane between two layers of a checker's cells shows those inside the body: a checker looks by
// this share of the body's size below the faces of a box, the discs of a cone (CONE_INSET of the device) and
// the faces that bound a mesh of the scene.
#define SCENE_CELLS_WITHIN 0x1p-16

// How a body is intersected.
enum scene_shape {
    SCENE_SPHERE,
    SCENE_PARALLELOGRAM, // two triangles: corner, corner + u, corner + u + v; corner, corner + u + v, corner
                         // + v
    SCENE_MESH,
    SCENE_CONE, // whole or cut off, also with equal radii: a cylinder
};

// Where a checker counts its cells, from object space: of a box by the lengths of its edges, nearly. Most
// bodies have SCENE_CELLS_OWN: 1 and 0.
struct scene_cells {
    vec3 scale, offset;
};
extern const struct scene_cells SCENE_CELLS_OWN;

// In IR order (ir.h). Models whose mesh could not be loaded are bodies without triangles. What the tracer's
// geometry depends on is compared by tracer/flatten/flatten_keep.c.
struct scene_body {
    // From the language: its name is what users call the body. NULL: the program made the body, and no file
    // holds it.
    const struct schema_element *element;
    uint32_t index; // among the bodies of this element
    const struct ir_head *head;
    str name; // empty: none
    enum scene_shape shape;
    // A sphere: its centre. A parallelogram: columns u, v and 0, and the corner as offset, so that its object
    // space is the unit square. A mesh: T·R·S. A cone: its frame (scene_cone_frame), and 'from' as offset.
    affine3 object_to_world;
    double radius;            // of a sphere; of a cone that at 'from'
    double radius_to, height; // of a cone
    const struct scene_cells *cells;
    const struct mesh *mesh;   // NULL: another shape, or not loaded
    const uint32_t *materials; // by group: indices into scene.materials
    uint32_t group_count;      // 1 except for meshes
    uint32_t triangle_count;
    bool closed;         // it has an inside: refraction enters and leaves, else it is a thin pane
    bool mirrored;       // the determinant is negative: the mesh is turned inside out
    bool smooth;         // normals are interpolated
    double crease_angle; // degrees; of smooth ones, else 180
    vec3 lower, upper;   // a box around it; for a mesh, around its transformed box; lower > upper: no mesh
};

// Black after any distance other than 0, and finite.
#define SCENE_ABSORPTION_MAX 1e30

// What a level's pixels are.
enum scene_texels {
    SCENE_TEXELS_BYTES,  // level 0 of an 8-bit image: three bytes, as the file has them
    SCENE_TEXELS_PACKED, // its other levels: three linear values of 21 bits in 64, r in the lowest
                         // (scene/textures.c)
    SCENE_TEXELS_FLOATS, // levels of other images: three linear floats; level 0: as the picture has them
};

// An image on surfaces, with levels of half its size each, down to one pixel. The image's file defines the
// pixels; levels are made here, once, for all tracers.
struct scene_texture {
    struct scene_texture *next;    // of the scene, in no order that matters
    uint32_t number;               // among them, from 0
    const struct picture *picture; // level 0
    bool is_srgb;                  // stored values are sRGB; else used as they are
    uint32_t level_count;
    struct scene_level {
        uint32_t width, height;
        const void *pixels; // rows from the top; level 0: NULL, the picture's pixels are used
        enum scene_texels texels;
    } levels[SCENE_LEVELS_MAX];
};

// How a material shows a texture.
struct scene_image {
    const struct picture *picture;       // NULL: it shows none
    const struct scene_texture *texture; // the same; NULL also where its pixels are not there
    // From a surface's coordinates (u, v) to the image's (0..1, v upwards): rows u, v of a matrix, and the
    // offset.
    double u[3], v[3];
    unsigned filter, wrap; // ir_filter, ir_wrap
};

// A material as the tracers see it. Colours are linear and not yet multiplied by their weights.
#define SCENE_DECLARE_NUMBER(name)           double name;
#define SCENE_DECLARE_FLAG(name)             bool name;
#define SCENE_DECLARE_WHOLE(name)            int32_t name;
#define SCENE_DECLARE_BITS(name)             uint64_t name;
#define SCENE_DECLARE_COLOR(name)            vec3 name;
#define SCENE_DECLARE_COLORS(name)           vec3 name[2];
#define SCENE_DECLARE_IMAGES(name)           struct scene_image name[ASSETS_IMAGES];
#define SCENE_DECLARE_FIELD(kind, name, ...) SCENE_DECLARE_##kind(name)
struct scene_material {
    SCENE_MATERIAL_FIELDS(SCENE_DECLARE_FIELD)
};

// Whether its colours need more than a checker's two cell colours: for code that shows scenes otherwise, and
// must refuse.
static inline bool scene_material_is_painted(const struct scene_material *m) {
    return m->soft || m->images[ASSETS_DIFFUSE].texture || m->images[ASSETS_SPECULAR].texture;
}

struct scene_background {
    vec3 color;                    // linear, times intensity: without an image
    const struct picture *picture; // NULL: none, or not loaded
    double intensity;
    double sine, cosine; // of the image's rotation about +y
    bool lights;         // surfaces; never where it is black for certain
};

struct scene {
    const struct ir_scene *ir;
    const struct assets *assets;
    const affine3
        *places; // by instance (ir_scene.instances): from its object to the world; NULL: there are none
    struct scene_body *bodies;
    uint32_t body_count;
    struct scene_material *materials; // in the order of assets.materials
    uint32_t material_count;
    struct scene_background background;
    struct scene_texture *textures; // one for each image file that materials show; NULL: none
    uint32_t texture_count;
    vec3 ambient;     // linear, times intensity
    double occlusion; // scene units; 0: bodies do not block it
};

void scene_build(const struct ir_scene *ir, const struct assets *assets, struct arena *arena,
                 struct scene *out);

// Whether the table's element is a kind of body.
bool scene_is_body(const struct schema_element *element);
// From the object of the instance that an entry of the scene is in to the world; NULL: it is in none.
const affine3 *scene_place(const struct scene *scene, const struct schema_element *element, uint32_t index);
// The least box around all bodies of an instance, by its whole name; false: there is none, or it holds none.
bool scene_instance_bounds(const struct scene *scene, str name, vec3 *lower, vec3 *upper);
// Adds an error for each instance that leaves its object no room (E417), and for each round thing that one
// would stretch (E416).
void scene_check_places(const struct scene *scene, struct diag_sink *sink);
// The material of a body's triangle (0 of a sphere): an index into scene.materials.
uint32_t scene_body_material(const struct scene_body *body, uint32_t triangle);
// The object_to_world of a parallelogram.
affine3 scene_parallelogram(vec3 corner, vec3 edge_u, vec3 edge_v);
// The own axes of a cone as columns: y along its axis; x as near to the scene's x as a right angle allows,
// or, where the axis runs most along x, to the scene's y. So an axis along y leaves them as the scene's.
mat3 scene_cone_frame(vec3 axis);
// Moves a body: object_to_world and, of a sphere or a cone, the radius; its box follows.
void scene_body_place(struct scene_body *body, affine3 object_to_world, double radius);
// The corners of a triangle in file order, through a map used in place of object_to_world: often
// object_to_world relative to an origin (transform_relative), so the origin is subtracted before anything is
// rounded.
void scene_corners(const struct scene_body *body, const affine3 *map, uint32_t triangle, vec3 corners[3]);
// The least box around a body, through such a map; false: it is empty.
bool scene_body_bounds(const struct scene_body *body, const affine3 *map, vec3 *lower, vec3 *upper);
// The least box around all bodies in scene units; false: there are none.
bool scene_bounds(const struct scene *scene, vec3 *lower, vec3 *upper);
// Adds an error (E409) for each model whose box reaches beyond the coordinates that the language allows.
void scene_check_reach(const struct scene *scene, struct diag_sink *sink);
// Where the scene file names a body; SPAN_NONE for a scene without places.
span scene_body_label(const struct scene *scene, const struct scene_body *body);
// The most triangles and spheres that bodies may show together: an item's number shares a word with the kind
// of fault.
#define SCENE_ITEMS_MAX 0x3ffffffdu
// Whether all bodies together have no more triangles than the limit, those of a mesh counted once, and show
// no more items than can be numbered; else adds an error (E501).
bool scene_check_triangles(const struct scene *scene, const struct limits *limits, struct diag_sink *sink);

// ---- textures

// The linear value of a pixel of a level, its row counted from the top.
vec3 scene_texel(const struct scene_texture *texture, uint32_t level, uint32_t x, uint32_t y);
// The texture coordinates of a mesh's triangle at its corners, as the file has them: 0, 0 where it has none.
void scene_coordinates(const struct scene_body *body, uint32_t triangle, struct ir_pair corners[3]);
// Whether any material that a body has shows an image.
bool scene_body_has_image(const struct scene *scene, const struct scene_body *body);

// ---- what surfaces send on

// How much light a material passes on at most, as a share of what it receives: Fresnel's shares add up to 1.
double scene_gain(const struct ir_material *material);
// Whether light can come back to the same surfaces with more than it had: each further bounce then adds to
// the picture, so the sum over all paths does not exist.
bool scene_amplifies(const struct scene *scene);

// ---- colours

// #rrggbb is a displayed colour: /255 with transfer none, decoded from sRGB with srgb (IEC 61966-2-1).
vec3 scene_linear_color(struct ir_color color, unsigned transfer);

#endif
