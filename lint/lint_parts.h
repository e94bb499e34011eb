// What the rules share: bodies with their bounds and materials, meshes with their trees, cameras, places.
//
// Ownership: the arena of the run. Thread safety: the thread of the run; lint_tree_of builds on first use and
// is not for parallel work.
#ifndef GLINT_LINT_LINT_PARTS_H
#define GLINT_LINT_LINT_PARTS_H

#include "grammar/schema.h"
#include "lint/lint.h"
#include "lint/tree.h"
#include "scene/view.h"

// 2^-20: a vertex in a file of six digits, and a coordinate after a few operations in single precision, are
// known no better than this part of their size.
#define LINT_RESOLUTION 0x1p-20

enum lint_body_kind {
    LINT_SPHERE,
    LINT_RECTANGLE,
    LINT_MODEL,
};

// Triangles of one mesh that get in each other's way, in file order.
struct lint_pairs {
    uint32_t count;         // triangles that another one meets
    uint32_t first, second; // the first of them, and the first that it meets
};

// A mesh that models of the scene name, once.
struct lint_mesh {
    const struct mesh *mesh;
    uint32_t model_count;
    uint32_t first_model;      // in the scene
    uint32_t first_smooth;     // IR_NO_INDEX: none
    uint32_t first_refracting; // IR_NO_INDEX: none
    uint32_t source;           // of its text; SOURCE_DEFAULT until a note needed it
    double tolerance;          // LINT_RESOLUTION of its largest coordinate
    bool has_tree;
    struct lint_tree tree; // lint_tree_of
    bool has_pairs;
    struct lint_pairs crossings, overlaps; // lint_find_pairs
};

// In IR order. Scenes may have a million of them: what is rarely needed is computed when it is.
struct lint_body {
    enum lint_body_kind kind;
    uint32_t index; // in the scene's list of its kind
    const struct ir_head *head;
    str name;
    struct lint_box box;    // around it, in scene units
    struct lint_mesh *mesh; // models; NULL: a sphere, a rectangle, or not loaded
    // The largest of its materials' weights.
    double reflection, refraction, gain; // gain: reflection and refraction of one material together
    bool is_mirrored;                    // a model whose scale turns the mesh inside out
    bool is_opaque;                      // no material of it refracts
    bool is_solid;                       // a sphere or a closed mesh: it has an inside
};

struct lint {
    const struct lint_input *input;
    const struct ir_scene *scene;
    const struct ir_origin *origin;
    const struct assets *assets;
    struct diag_sink *sink;
    struct arena *arena;
    struct lint_body *bodies;
    uint32_t body_count;
    struct {
        struct lint_mesh **items;
        uint32_t count, capacity;
    } meshes;
    struct view *views; // one per camera, or the automatic one
    uint32_t view_count;
};

// Bodies, meshes and views. In lint_bodies.c.
void lint_collect(struct lint *lint);
const struct lint_tree *lint_tree_of(struct lint *lint, struct lint_mesh *mesh);
// Crossings (of a mesh that refracts) and overlaps in one plane, once for each mesh. In self_pairs.c.
void lint_find_pairs(struct lint *lint, struct lint_mesh *mesh);
// How often a solid surrounds the point (negative where its faces point inwards); 0: outside.
int lint_winding(struct lint *lint, const struct lint_body *body, vec3 point);
static inline bool lint_is_inside(struct lint *lint, const struct lint_body *body, vec3 point) {
    return body->is_solid && lint_box_holds(&body->box, point) && lint_winding(lint, body, point) != 0;
}
// The material of a sphere, a rectangle, or of one group of a model.
const struct ir_material *lint_material(const struct lint *lint, const struct lint_body *body,
                                        uint32_t group);
uint32_t lint_group_count(const struct lint_body *body);
// Of a model with a mesh: from mesh space to scene units, and back.
affine3 lint_placing(const struct lint *lint, const struct lint_body *body);
affine3 lint_inverse(affine3 placing);
// The two triangles of a rectangle.
void lint_rectangle(const struct lint_body *body, const struct lint *lint, struct lint_triangle out[2]);

// Places and words. In lint_places.c.
// "sphere 'ball'", or "this sphere".
str lint_words(struct lint *lint, const struct lint_body *body);
// "sphere 'ball'", or "a sphere".
str lint_words_other(struct lint *lint, const struct lint_body *body);
span lint_place(const struct lint *lint, const struct lint_body *body);
span lint_place_mesh(const struct lint *lint, uint32_t model);
// A note at a line of a mesh file.
void lint_note_mesh(struct lint *lint, struct lint_mesh *mesh, uint32_t line, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

struct lint_rule {
    enum diag_code code;
    void (*run)(struct lint *lint);
    enum lint_level level; // the least one that runs it
};
// In lint.c, in the order of their codes; one without `run` ends them.
extern const struct lint_rule lint_rules[];

// The rules, a family a file.
void lint_camera_inside(struct lint *lint); // rules_inside.c
void lint_light_inside(struct lint *lint);
void lint_index_one(struct lint *lint); // rules_material.c
void lint_amplifying(struct lint *lint);
void lint_depth_short(struct lint *lint);     // rules_depth.c
void lint_unseen(struct lint *lint);          // rules_unseen.c
void lint_unused_material(struct lint *lint); // rules_unused.c
void lint_unused_include(struct lint *lint);
void lint_coincident(struct lint *lint); // rules_coincident.c
void lint_zero_area(struct lint *lint);  // rules_triangles.c
void lint_duplicates(struct lint *lint);
void lint_opposing_normals(struct lint *lint);
void lint_self_overlap(struct lint *lint); // rules_shells.c
void lint_inside_out(struct lint *lint);
void lint_oversized_image(struct lint *lint); // rules_image.c

#endif
