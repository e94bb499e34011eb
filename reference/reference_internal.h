// The parts of the reference. Private to reference/.
//
// All positions here are relative to the reference's origin (the position of the camera that it was made
// with), in scene units.
#ifndef GLINT_REFERENCE_INTERNAL_H
#define GLINT_REFERENCE_INTERNAL_H

#include "core/arena.h"
#include "reference/reference.h"
#include "scene/media.h"
#include "scene/points.h"
#include "scene/sky.h"

// gamma(n) = n u / (1 - n u), u = 2^-53: bounds the relative error of n roundings (Higham 2002, section 3.1).
#define REFERENCE_UNIT     0x1p-53
#define REFERENCE_SINGLE   0x1p-24
#define REFERENCE_GAMMA(n) ((n)*REFERENCE_UNIT / (1 - (n)*REFERENCE_UNIT))

#define NO_PRIMITIVE UINT32_MAX

// For places where NaN cannot occur, or does no harm: fmin and fmax are function calls.
static inline double reference_smaller(double a, double b) {
    return a < b ? a : b;
}
static inline double reference_larger(double a, double b) {
    return a > b ? a : b;
}
static inline double reference_brightest(vec3 color) {
    return fmax(color.x, fmax(color.y, color.z));
}

// A triangle; or a sphere: then its centre is v[0] and its radius v[1][0]; or a cone: then v[0] is where it
// begins, v[1] its unit axis, and v[2] its radii and its height. In a tree also an instance, which is a body:
// `triangle` is its number.
struct primitive {
    double v[3][3];
    uint32_t body, triangle;
    bool is_sphere, is_cone, is_instance;
};

#define NO_INSTANCE UINT32_MAX

struct body {
    const struct scene_body *is;
    affine3 object_to_world;  // relative to the reference's origin
    mat3 normal_map;          // of a mesh
    const vec3 *normals;      // mesh_smooth_normals; NULL: flat
    uint32_t first_primitive; // numbered in IR order, before the tree sorts them
    uint32_t primitive_count; // of an instance 1
    uint32_t instance;        // NO_INSTANCE: its triangles lie in the scene's tree
    bool is_medium;
    uint32_t filling; // of a medium: the material that fills it
};

struct material {
    const struct scene_material *is;
    vec3 diffuse[2], specular; // times their weights
};

// The media that a ray is inside, in the order in which it entered them.
struct inside {
    uint32_t bodies[SCENE_MEDIA_MOST];
    uint32_t count;
};

// A node's first child is the next node. `count` is 0 for inner nodes.
struct tree_node {
    double lower[3], upper[3];
    uint32_t second; // inner: the other child; leaf: the first primitive
    uint32_t count;
};

enum {
    TREE_STACK = 160
};

// A mesh that several bodies show, with a tree in its own space.
struct shared_mesh {
    const struct mesh *mesh;
    struct tree_node *nodes;
    uint32_t *order; // triangles, as leaves name them
};

// A body that shows a shared mesh. Its triangles are made when a ray comes near them, with the same numbers
// that they would have in the scene's tree.
struct instance {
    uint32_t body, mesh; // `mesh` indexes shared_meshes
    uint32_t first;      // its triangles are primitives from this number on
    mat3 to_mesh;        // of directions
    vec3 shift;          // by how much to_mesh may be wrong, in mesh space
    vec3 reach;          // largest numbers from which its vertices are computed
    double lower[3], upper[3];
};

// The data of a ray that the boxes of one tree are tested against.
struct tree_ray {
    const struct instance *instance; // the instance whose mesh's tree it is; NULL: the scene's
    const struct tree_node *nodes;
    // Its origin, moved either way by its possible rounding error, for lower and upper planes.
    double at_lower[3], at_upper[3];
    double inverse[3]; // 1 / direction
};

struct reference {
    struct reference_input input;
    vec3 origin;
    struct arena arena; // bodies, materials, lights, normals
    struct body *bodies;
    struct material *materials;
    bool media; // rays know what they are inside
    struct inside around_camera;
    double *decoded; // a background channel's decoded value by stored value; NULL for floats
    double background_brightest;
    struct sky_size sky; // rows 0: the background does not light
    uint32_t *sky_numbers;
    struct primitive *primitives; // in the tree's order
    uint32_t primitive_count;
    struct tree_node *nodes;
    struct shared_mesh *shared_meshes;
    uint32_t shared_mesh_count;
    struct instance *instances; // grouped by mesh
    uint32_t instance_count;
    uint32_t first_shared; // primitives from here on are triangles of instances
};

// The unit of the numbers that places have.
static inline double reference_unit(const struct reference *r) {
    return r->input.as_single ? REFERENCE_SINGLE : REFERENCE_UNIT;
}
static inline double reference_gamma(const struct reference *r, int n) {
    return n * reference_unit(r) / (1 - n * reference_unit(r));
}

// ---- rounding.c

// With as_single: rounded as on a device in single precision, computed from numbers as large as `size`; else
// unchanged.
double reference_rounded(const struct reference *r, double value, double size);
vec3 reference_rounded3(const struct reference *r, vec3 v, double size);
// With as_single: rounded to a float; else unchanged.
double reference_stored(const struct reference *r, double value);
struct surface;
vec3 reference_stored3(const struct reference *r, vec3 v);
// Where the checker's cells are counted, in scene units: from a sphere's centre (`arm` is the way from
// there), along the edges of a parallelogram, and in a mesh's own coordinates. `b`: the hit's barycentrics.
vec3 reference_checker_place(const struct scene_body *body, const struct surface *s, const double b[3],
                             vec3 arm);

// ---- bodies.c

// Fills bodies, instances and materials; jumps to the arena's guard where memory ends. false: there are more
// triangles than can be numbered.
bool reference_make_bodies(struct reference *r);
// The primitive of a number in IR order; false: a triangle without area, which no ray can hit.
bool reference_make_primitive(const struct reference *r, const struct body *body, uint32_t triangle,
                              struct primitive *out);
// The primitive that was hit; one of an instance is made in `room`.
const struct primitive *reference_primitive(const struct reference *r, uint32_t index,
                                            struct primitive *room);
static inline bool reference_is_sphere(const struct reference *r, uint32_t index) {
    return index < r->first_shared && r->primitives[index].is_sphere;
}
static inline bool reference_is_cone(const struct reference *r, uint32_t index) {
    return index < r->first_shared && r->primitives[index].is_cone;
}
static inline bool reference_is_round(const struct reference *r, uint32_t index) {
    return reference_is_sphere(r, index) || reference_is_cone(r, index);
}
// A primitive that is a cone.
struct shape_cone;
struct shape_cone reference_cone_of(const struct primitive *p);

// ---- instances.c

// Chooses which bodies are instances, and fills shared_meshes and instances, except for what needs the trees.
// Jumps to the arena's guard.
void reference_share(struct reference *r);
// The box of an instance, once its mesh's tree is built.
void reference_place(const struct reference *r, struct instance *instance);
// The instance that has this triangle.
const struct instance *reference_instance(const struct reference *r, uint32_t index);
// A ray in the space of an instance's mesh, with the same t.
void reference_to_mesh(const struct reference *r, const struct instance *instance, const double origin[3],
                       const double direction[3], struct tree_ray *out);

// ---- tree.c

// Fills primitives and nodes, those of shared meshes too. false: no memory.
bool reference_make_tree(struct reference *r);

// ---- intersect.c

// Where a ray starts.
struct start {
    vec3 at;
    uint32_t
        left; // the triangle that the ray leaves, which it cannot hit; NO_PRIMITIVE: none, and `at` is exact
    double b1, b2; // the exact place on that triangle
    uint32_t cone; // the cone that the ray leaves; NO_PRIMITIVE: none
    bool inward;   // into it
};

static inline struct start reference_start(vec3 at) {
    return (struct start){.at = at, .left = NO_PRIMITIVE, .cone = NO_PRIMITIVE};
}

// How wide a pixel is along a ray: its width at the start and its growth per length. Where the width is
// negative, rays have crossed.
struct cone {
    double width, spread;
};

struct ray {
    struct start start;
    vec3 direction; // any length
    double t_max;
    struct cone cone;
};

struct intersection {
    double t;
    double b1, b2;
    double t_error;
    uint32_t primitive; // NO_PRIMITIVE: nothing
};

// The nearest light with a place that the ray sees before `t_max`: its number; IR_NO_INDEX: none. *t: how far
// away it is, in lengths of the direction.
uint32_t reference_seen_light(const struct reference *r, vec3 start, vec3 direction, double t_max, double *t);
// What the discs in the sky add to the background, seen along a unit vector.
vec3 reference_seen_discs(const struct reference *r, vec3 direction);

void reference_intersect(const struct reference *r, const struct ray *ray, struct intersection *out);
// Whether anything lies strictly between the ray's start and t_max.
bool reference_blocks(const struct reference *r, const struct ray *ray);

// ---- surface.c

struct surface {
    uint32_t primitive, body, triangle, material;
    double distance; // in lengths of the ray's direction
    double b1, b2;
    vec3 point, error;
    vec3 geometric, shading;
    bool enters, solid;
    const struct scene_material *is;
    vec3 diffuse, specular; // times their weights
    double index;
    double bend;  // how fast the normal turns along the surface: positive where it bulges to the ray's side
    double width; // of the ray's cone
    struct reference_texel texel;
    double alpha; // of its facets; 0: smooth
    vec3 facet;   // the normal that reflects and refracts: the shading normal, or that of reference_roughen
    // For a ray that comes from a place inside certain media: reference_cross.
    double index_before, index_after;
    struct inside after; // once the ray is through
    bool passes;         // it goes on unseen: nothing changes here
    bool is_over;        // it would be inside more media than there may be
};

// The face of a cone that was hit: b1, which as_single has rounded.
enum reference_face {
    REFERENCE_SIDE,
    REFERENCE_FROM,
    REFERENCE_TO,
};
static inline enum reference_face reference_face(const struct surface *s) {
    return (enum reference_face)(s->b1 + 0.5);
}

void reference_surface(const struct reference *r, const struct ray *ray, const struct intersection *hit,
                       struct surface *out);
// For a rough surface the facet that a ray with key `key` hits.
void reference_roughen(const struct reference *r, struct surface *s, vec3 direction,
                       const struct points *points, uint32_t key);
vec3 reference_mirrored(const struct reference *r, const struct surface *s, vec3 direction);
// How light that meets a surface is divided.
struct split {
    vec3 bent;
    bool through;     // false: total reflection
    double reflected; // with fresnel: the share of the light that the surface reflects
};
void reference_split(const struct reference *r, const struct surface *s, vec3 direction, struct split *out);
// The weights of the rays that leave.
double reference_reflection(const struct surface *s, const struct split *split);
// What the mirrored ray keeps of each channel.
vec3 reference_mirror_color(const struct surface *s, vec3 direction, const struct split *split);
double reference_refraction(const struct surface *s, const struct split *split);
// The share that passes straight through a surface, as for shadow rays.
double reference_shine(const struct surface *s, vec3 direction);

// ---- media.c

// What the camera is inside, and whether rays must know their media. Call it after the tree is made. false:
// no memory.
bool reference_make_media(struct reference *r);
// Finds the media on both sides of a surface.
void reference_cross(const struct reference *r, const struct inside *before, struct surface *s);
// The body that fills the place; HIT_NONE: air.
uint32_t reference_filling(const struct reference *r, const struct inside *inside);
// The share of light left after travelling through the medium that fills a place.
vec3 reference_left(const struct reference *r, const struct inside *inside, double way);

// ---- paint.c

// Replaces the colours that come from an image or a filtered checker; `arm`: from a sphere's centre.
void reference_paint(const struct reference *r, const struct ray *ray, const double b[3], vec3 arm,
                     struct surface *s);
// The cone of the camera's ray, and of rays that leave a surface.
struct cone reference_camera_cone(const struct reference *r, const struct reference_settings *settings,
                                  vec3 direction);
struct cone reference_mirrored_cone(const struct surface *s, struct cone cone);
struct cone reference_bent_cone(const struct surface *s, struct cone cone, vec3 from, vec3 to);

// ---- ray_offset.c

// The start of rays that leave on the side of `side`, a unit vector along the geometric normal.
struct start reference_leave(const struct reference *r, const struct surface *s, vec3 side);

// ---- light.c

// Decodes what a background image needs. Jumps to the arena's guard.
void reference_make_background(struct reference *r);
vec3 reference_background(const struct reference *r, vec3 direction);

struct lighting {
    vec3 sum;
    uint32_t considered, lit;     // bits of lights 0..31
    uint32_t shadow_rays, unseen; // `unseen`: crossings between equal media on the way of shadow rays
};
void reference_light(const struct reference *r, const struct surface *s, vec3 direction,
                     const struct inside *inside, const struct points *points, uint32_t key,
                     struct lighting *out);

// ---- round.c

// A point of the unit square as one of the unit disc; areas keep their ratios, and the middle is the middle
// (Shirley and Chiu 1997, "A Low Distortion Map Between Disk and Square").
void reference_disc(double across, double down, double *x, double *y);
// Unit vectors across `n` and each other.
void reference_frame(vec3 n, vec3 *a, vec3 *b);
// x and y along the frame's vectors and `along` along n.
vec3 reference_turned(vec3 n, double x, double y, double along);

// ---- lens.c

struct camera_ray {
    vec3 start, direction; // unit
};

// The ray of a sample.
struct camera_ray reference_lens_ray(const struct reference *r, const struct reference_settings *settings,
                                     const struct points *points);

// ---- path.c

struct branch {
    struct start start;
    vec3 direction;
    struct cone cone;
    double throughput;
    vec3 tint; // what attenuation and coloured mirrors have left of each channel
    struct inside inside;
    uint32_t key; // of its points
    uint32_t depth;
    uint32_t parent; // in a log
    enum reference_kind kind;
};

// Rays that wait to be followed.
struct queue {
    struct branch *items;
    uint32_t count, capacity;
    bool heaviest_first; // the ray with the most throughput first; else last in, first out
    bool failed;         // no memory
    // Called now and then while a sample is followed: false ends it. May be NULL.
    bool (*goes_on)(void *context);
    void *context;
    uint64_t rays; // followed since the caller last set it to 0
};
void reference_queue_finish(struct queue *queue);

// The result of one sample.
struct sample {
    vec3 radiance;
    uint64_t rays[3]; // by kind
    uint64_t shadow, unseen, total_reflections, cut_by_depth, cut_by_weight, cut_by_segments;
    uint32_t deepest;
    double left_weight, brightest;
    bool over_segments;
    bool is_nested; // a ray would have been inside too many media
    bool cancelled;
    uint32_t body, triangle; // last hit
};

struct log {
    struct reference_segment *segments;
    uint32_t capacity, count;
};

// Follows a sample's paths to their ends, from the camera's ray on. `log` may be NULL.
void reference_follow(const struct reference *r, const struct reference_settings *settings,
                      const struct points *points, struct queue *queue, struct log *log, struct sample *out);

#endif
