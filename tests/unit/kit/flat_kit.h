// Scenes made in memory for tests of flattening: no files, no parser.
//
// kit_init gives an empty scene with the schema's defaults; tests fill scene lists and meshes, then call
// kit_flatten. What the kit allocates lives in its arena.
#ifndef GLINT_TESTS_UNIT_FLAT_KIT_H
#define GLINT_TESTS_UNIT_FLAT_KIT_H

#include "grammar/ir.h"
#include "tracer/flatten/flatten.h"

enum {
    KIT_MAX = 8, // elements of a list
    KIT_LIGHTS = 128
};

struct kit {
    struct arena arena;
    struct ir_scene scene;
    struct assets assets;
    struct scene resolved; // of both, by kit_resolve
    struct view view;
    struct limits limits;
    struct diag_sink sink;
    vec3 origin;
    bool is_double; // flatten for the kernels in double precision
};

void kit_init(struct kit *kit);
void kit_finish(struct kit *kit);
// Each adds one element with its defaults; bodies have the default material.
struct ir_material *kit_material(struct kit *kit);
struct ir_sphere *kit_sphere(struct kit *kit);
struct ir_rectangle *kit_rectangle(struct kit *kit);
struct ir_box *kit_box(struct kit *kit);
struct ir_cylinder *kit_cylinder(struct kit *kit);
struct ir_cone *kit_cone(struct kit *kit);
struct ir_model *kit_model(struct kit *kit, struct mesh *mesh);
struct view_light *kit_light(struct kit *kit, vec3 position);
// The materials in use: the scene's, then the default one.
void kit_use_material(struct ir_reference *ref, uint32_t index);
void kit_model_material(struct kit *kit, uint32_t model, uint32_t index);

// A mesh of one group, from triples of indices, each position used.
struct mesh *kit_mesh(struct kit *kit, const vec3 *positions, uint32_t position_count,
                      const uint32_t (*faces)[3], uint32_t face_count, bool closed);
// A unit icosahedron, each face cut into four `levels` times; vertices on the unit sphere, rounded to
// multiples of `grid`; closed, outward.
struct mesh *kit_icosphere(struct kit *kit, int levels, double grid);

// The materials of the assets, as loading the scene as it now is would leave them, and the resolved scene.
void kit_resolve(struct kit *kit);
bool kit_flatten(struct kit *kit, struct flat_scene *flat);
// The scene as kit_resolve left it.
bool kit_flatten_resolved(struct kit *kit, struct flat_scene *flat);

// Fields of the buffers.
float kit_float(uint32_t bits);
vec3 kit_vertex(const struct flat_scene *flat, uint32_t item, int corner);
// The number of the triangle of a leaf item.
uint32_t kit_number(const struct flat_scene *flat, uint32_t item);
// The leaf item that holds a triangle number; UINT32_MAX: none.
uint32_t kit_find_triangle(const struct flat_scene *flat, uint32_t number);

#endif
