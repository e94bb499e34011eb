// What the rules share: bodies with their bounds and materials, meshes with their trees, cameras, places.
//
// Ownership: the arena of the run. Thread safety: the thread of the run; lint_tree_of builds on first use and
// is not for parallel work.
#ifndef GLINT_LINT_LINT_INTERNAL_H
#define GLINT_LINT_LINT_INTERNAL_H

#include "grammar/schema.h"
#include "lint/lint.h"
#include "lint/tree.h"
#include "scene/shape.h"
#include "scene/transform.h"
#include "scene/view.h"

// 2^-20: a vertex in a file of six digits, and a coordinate after a few operations in single precision, are
// known only to within this fraction of their size.
#define LINT_RESOLUTION 0x1p-20

// Triangles of one mesh that cross or overlap each other, in file order.
struct lint_pairs {
    uint32_t count;         // triangles that another one touches
    uint32_t first, second; // the first of them, and the first that it touches
};

// A mesh that models of the scene name, once.
struct lint_mesh {
    const struct mesh *mesh;
    uint32_t model_count;
    const struct lint_body *first;            // that shows this mesh
    const struct lint_body *first_smooth;     // NULL: none
    const struct lint_body *first_refracting; // NULL: none
    uint32_t source;                          // of its text; SOURCE_DEFAULT until a note needs it
    double tolerance;                         // LINT_RESOLUTION of its largest coordinate
    bool has_tree;
    struct lint_tree tree; // lint_tree_of
    double facets_of;      // the crease angle for which lint_coarse_glass has looked at it; -1: for none
    bool has_pairs;
    struct lint_pairs crossings, overlaps; // lint_find_pairs
};

// In IR order. Scenes may have a million of them: rarely needed values are computed on demand.
struct lint_body {
    const struct scene_body *is;
    struct lint_box box;    // around it, in scene units
    struct lint_mesh *mesh; // NULL: another shape, or not loaded
    // The largest of its materials' weights.
    double reflection, refraction, gain; // gain: reflection and refraction of one material together
    bool is_opaque;                      // no material of it refracts
};

struct lint {
    const struct lint_input *input;
    const struct scene *scene;
    const struct ir_scene *ir; // of the scene
    const struct ir_origin *origin;
    struct diag_sink *sink;
    struct arena *arena;
    struct lint_body *bodies;
    uint32_t body_count;
    struct {
        struct lint_mesh **items;
        uint32_t count, capacity;
    } meshes;
    uint64_t pairs_spent; // by lint_find_pairs: an upper bound, in box tests
    struct view *views;   // one per camera, or the automatic one
    uint32_t view_count;
};

// Bodies, meshes and views. In lint_bodies.c.
void lint_collect(struct lint *lint);
const struct lint_tree *lint_tree_of(struct lint *lint, struct lint_mesh *mesh);
// Crossings (of a mesh that refracts) and overlaps in the same plane, once for each mesh. In self_pairs.c.
void lint_find_pairs(struct lint *lint, struct lint_mesh *mesh);
// How often a solid surrounds the point (negative where its faces point inwards); 0: outside.
int lint_winding(struct lint *lint, const struct lint_body *body, vec3 point);
static inline bool lint_is_inside(struct lint *lint, const struct lint_body *body, vec3 point) {
    return body->is->closed && lint_box_holds(&body->box, point) && lint_winding(lint, body, point) != 0;
}
// The material of one of a body's groups.
const struct ir_material *lint_material(const struct lint *lint, const struct lint_body *body,
                                        uint32_t group);
// Whether any body sends rays on: mirrors, or glass.
bool lint_sends_rays_on(const struct lint *lint);
// The triangles of a body that has some without a mesh, and their number; 0 for other bodies.
enum {
    LINT_FLAT_TRIANGLES = 2
};
uint32_t lint_flat_triangles(const struct lint_body *body, struct lint_triangle out[LINT_FLAT_TRIANGLES]);
// Whether there is anything of the body: false where its mesh could not be loaded.
static inline bool lint_is_there(const struct lint_body *body) {
    return shape_is_there(body->is);
}

// Places and words. In lint_places.c.
// "sphere 'ball'", or "this sphere".
str lint_words(struct lint *lint, const struct lint_body *body);
// "sphere 'ball'", or "a sphere".
str lint_words_other(struct lint *lint, const struct lint_body *body);
// Whether it was made by 'for' or by an instance.
bool lint_is_copy(const struct lint *lint, const struct lint_body *body);
// "material 'glass'", or "this material".
str lint_material_words(struct lint *lint, const struct ir_material *material);
// Whether the file has the row of an element.
bool lint_is_written(const struct ir_head *head, const struct schema_element *schema, const char *row);
span lint_place(const struct lint *lint, const struct lint_body *body);
span lint_place_mesh(const struct lint *lint, const struct lint_body *body);
// The faces of a mesh that the scene describes by them; NULL: another mesh.
const struct ir_faces *lint_faces(const struct lint *lint, const struct lint_mesh *mesh);
// A note at a line of a mesh file, or at the face of that number where the scene has it.
void lint_note_mesh(struct lint *lint, struct lint_mesh *mesh, uint32_t line, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
// Adds a fix, not a safe one, to the last finding: another value for an element's row. A row that the file
// lacks is written after `beside`, on its own line if `beside` has one; if both are missing there is no fix.
void lint_fix_row(struct lint *lint, const struct ir_head *head, const struct schema_element *schema,
                  const char *row, const char *beside, const char *value);

struct lint_rule {
    diag_code code;
    void (*run)(struct lint *lint);
    enum lint_level level; // the lowest level that runs it
};
// In lint.c, in the order of their codes; ends with one without `run`.
extern const struct lint_rule lint_rules[];

// The rules, one family per file.
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
void lint_coarse_glass(struct lint *lint); // rules_facets.c
void lint_self_overlap(struct lint *lint); // rules_shells.c
void lint_inside_out(struct lint *lint);
void lint_oversized_image(struct lint *lint); // rules_image.c
void lint_media(struct lint *lint);           // rules_media.c
void lint_attenuation(struct lint *lint);     // rules_material.c
void lint_black_medium(struct lint *lint);
void lint_too_fine(struct lint *lint);    // rules_paint.c
void lint_few_samples(struct lint *lint); // rules_light.c
void lint_light_around(struct lint *lint);
void lint_ambient(struct lint *lint);
void lint_emission(struct lint *lint);
void lint_one_sample(struct lint *lint); // rules_lens.c
void lint_nothing_sharp(struct lint *lint);
void lint_lens_inside(struct lint *lint);
void lint_panorama(struct lint *lint);
void lint_never_ends(struct lint *lint); // rules_samples.c
void lint_sky_samples(struct lint *lint);
void lint_sky_dark(struct lint *lint);
void lint_panel_away(struct lint *lint); // rules_panel.c
void lint_panel_in_plane(struct lint *lint);
void lint_unused_value(struct lint *lint); // rules_effect.c
void lint_scaled(struct lint *lint);       // rules_scaled.c

#endif
