// The typed IR: what a scene file means, in double precision and in scene units. Read this first.
//
// Each element begins with `struct ir_head`: which rows of its schema element the file wrote, which of
// these failed ("poisoned": they hold their default and later stages stay silent about them), and the id
// under which grammar/ir_origin.h keeps its places. Rows that were not written hold the schema's default.
// References are indices. Tagged structs have no C unions: members of alternatives not taken are zero or
// at their default. Text and lists live in the arena of the scene; a loaded scene is immutable.
// What each attribute means is in grammar/schema.c (and docs/reference.md, made from it).
#ifndef GLINT_GRAMMAR_IR_H
#define GLINT_GRAMMAR_IR_H

#include "core/str.h"
#include "core/vec3.h"
#include "grammar/ir_value.h"

struct ir_formulas; // grammar/ir_formula.h
struct ir_copies;   // grammar/ir_copies.h

#define IR_LIST(name, item)                                                                                  \
    struct name {                                                                                            \
        struct item *items;                                                                                  \
        uint32_t count, capacity;                                                                            \
    }

// The fields of an enum are `unsigned` in the structs, so that the schema can derive their kind.
enum ir_depth_limit {
    IR_DEPTH_BACKGROUND,
    IR_DEPTH_BLACK
};
enum ir_precision {
    IR_PRECISION_AUTO,
    IR_PRECISION_SINGLE,
    IR_PRECISION_DOUBLE
};
enum ir_falloff {
    IR_FALLOFF_NONE,
    IR_FALLOFF_INVERSE_SQUARE
};
enum ir_projection {
    IR_PROJECTION_PERSPECTIVE,
    IR_PROJECTION_ORTHOGRAPHIC,
    IR_PROJECTION_FISHEYE,
    IR_PROJECTION_PANORAMA
};
// Tags set by a choice between rows.
enum ir_view {
    IR_VIEW_DIRECTION,
    IR_VIEW_LOOK_AT,
    IR_VIEW_ROTATION
};
enum ir_focus {
    IR_FOCUS_DISTANCE,
    IR_FOCUS_POINT,
    IR_FOCUS_BODY
};
enum ir_backdrop {
    IR_BACKDROP_COLOR,
    IR_BACKDROP_IMAGE
};
enum ir_aim {
    IR_AIM_LOOK_AT,
    IR_AIM_DIRECTION
};
enum ir_light_kind {
    IR_LIGHT_POSITION,
    IR_LIGHT_DIRECTION,
    IR_LIGHT_RECTANGLE
};
enum ir_variable_kind {
    IR_VARIABLE_COUNT,
    IR_VARIABLE_VALUES
};
enum ir_paint_kind {
    IR_PAINT_COLOR,
    IR_PAINT_CHECKER,
    IR_PAINT_IMAGE
};
enum ir_filter {
    IR_FILTER_AUTO,
    IR_FILTER_NEAREST,
    IR_FILTER_BILINEAR
};
enum ir_wrap {
    IR_WRAP_REPEAT,
    IR_WRAP_CLAMP,
    IR_WRAP_MIRROR
};
enum ir_mesh_kind {
    IR_MESH_LATHE,
    IR_MESH_TORUS,
    IR_MESH_EXTRUDE,
    IR_MESH_FACES,
    IR_MESH_TEXT
};
enum ir_curve {
    IR_CURVE_LINEAR,
    IR_CURVE_SMOOTH
};
enum ir_align {
    IR_ALIGN_LEFT,
    IR_ALIGN_CENTER,
    IR_ALIGN_RIGHT
};
enum ir_interpolation {
    IR_INTERPOLATION_LINEAR,
    IR_INTERPOLATION_SMOOTH,
    IR_INTERPOLATION_EASE,
    IR_INTERPOLATION_STEP
};
enum ir_loop {
    IR_LOOP_NONE,
    IR_LOOP_REPEAT,
    IR_LOOP_MIRROR
};

struct ir_image {
    struct ir_head head;
    int32_t width, height; // pixels
    int32_t samples;       // per pixel; at most, with `error`
    double error;          // standard error of a displayed colour at which a pixel ends; 0: none
    int32_t min_samples;   // before it may end
    double exposure;       // stops
    unsigned tone;         // ir_tone
    unsigned transfer;     // ir_transfer
};

struct ir_trace {
    struct ir_head head;
    int32_t max_depth;
    double min_weight;
    unsigned depth_limit; // ir_depth_limit
    unsigned precision;   // ir_precision
    bool shadows;
    bool transparent_shadows;
};

struct ir_camera {
    struct ir_head head;
    str name; // "main" for the unnamed one
    vec3 position;
    unsigned view; // ir_view
    vec3 look_at, direction, rotation;
    vec3 up;             // written or the default 0 1 0
    double fov;          // vertical, degrees
    unsigned projection; // ir_projection
    double size;         // of the orthographic view: its height in scene units
    double aperture;     // lens diameter; 0: a pinhole
    unsigned focusing;   // ir_focus
    double focus;        // 0: not written
    vec3 focus_at;
    str focus_on; // name of a body
};

struct ir_background {
    struct ir_head head;
    unsigned kind; // ir_backdrop
    struct ir_color color;
    str image; // path as written
    double intensity;
    double rotation; // degrees about +y
    bool lights;     // surfaces
};

// Light from everywhere.
struct ir_ambient {
    struct ir_head head;
    struct ir_color color;
    double intensity;
    double occlusion; // scene units; 0: bodies do not block it
};

// A variable of copies: its values are 0, 1, ... before a count, or a list.
struct ir_variable {
    struct ir_head head;
    str name;
    unsigned kind; // ir_variable_kind
    int32_t count;
    str values; // SCHEMA_TEXT_LIST
};
IR_LIST(ir_variables, ir_variable);

// A light that is a rectangle.
struct ir_panel {
    struct ir_head head;
    vec3 corner, edge_u, edge_v;
};

// The cone that a light shines into.
struct ir_spot {
    struct ir_head head;
    unsigned aim; // ir_aim
    vec3 direction, look_at;
    double angle;    // across, degrees
    double softness; // share of the way from the axis to the edge on which the light fades
};

struct ir_light {
    struct ir_head head;
    str name;
    struct ir_variables copies; // one for each of their values; none: the entry itself
    bool condition;             // whether there is one
    unsigned kind;              // ir_light_kind
    vec3 position, direction;
    struct ir_panel rectangle;
    double radius; // for one with a position; 0: a point
    double angle;  // for one with a direction: diameter of its disc in degrees; 0: a point
    double intensity;
    struct ir_color color;
    unsigned falloff;    // ir_falloff
    struct ir_spot spot; // where the light has one written
    bool visible;        // for a light with extent: whether camera, mirrors and glass see it
};

struct ir_checker {
    struct ir_head head;
    struct ir_color colors[2];
    double size;
    bool antialias;
};

struct ir_texture {
    struct ir_head head;
    str file; // path as written
    struct ir_pair repeat, offset;
    double rotation; // degrees
    unsigned filter; // ir_filter
    unsigned wrap;   // ir_wrap
};

struct ir_paint {
    struct ir_head head;
    unsigned kind; // ir_paint_kind
    struct ir_color color;
    struct ir_checker checker;
    struct ir_texture image;
};

struct ir_highlight {
    struct ir_head head;
    unsigned kind; // ir_paint_kind, without checkers
    struct ir_color color;
    struct ir_texture image;
};

struct ir_material {
    struct ir_head head;
    str name;        // empty: anonymous, written inline where it is used
    unsigned preset; // 0: none; else the row of presets.def that it takes its values from, counted from 1
    struct ir_weights albedo;
    struct ir_paint diffuse_color;
    struct ir_highlight specular_color;
    struct ir_color reflection_color;
    bool metal;
    struct ir_color emission;
    double specular_exponent;
    double refractive_index;
    bool fresnel;
    double roughness;
    int32_t priority;
    struct ir_color attenuation_color;
    double attenuation_distance; // scene units
};

struct ir_sphere {
    struct ir_head head;
    str name;
    struct ir_variables copies; // one for each of their values; none: the entry itself
    bool condition;             // whether there is one
    vec3 center;
    double radius;
    vec3 rotation; // degrees, as a model's
    struct ir_reference material;
};

struct ir_rectangle {
    struct ir_head head;
    str name;
    struct ir_variables copies; // one for each of their values; none: the entry itself
    bool condition;             // whether there is one
    vec3 corner, edge_u, edge_v;
    struct ir_reference material;
};

struct ir_box {
    struct ir_head head;
    str name;
    struct ir_variables copies;  // one for each of their values; none: the entry itself
    bool condition;              // whether there is one
    vec3 center, size, rotation; // degrees, as a model's
    struct ir_reference material;
};

struct ir_cylinder {
    struct ir_head head;
    str name;
    struct ir_variables copies; // one for each of their values; none: the entry itself
    bool condition;             // whether there is one
    vec3 from, to;              // middles of its ends
    double radius;
    struct ir_reference material;
};

struct ir_cone {
    struct ir_head head;
    str name;
    struct ir_variables copies; // one for each of their values; none: the entry itself
    bool condition;             // whether there is one
    vec3 from, to;              // middles of its ends
    double radius_from, radius_to;
    struct ir_reference material;
};

struct ir_map_entry {
    struct ir_head head;
    str from; // name of a material in the mesh
    struct ir_reference to;
};
IR_LIST(ir_map_entries, ir_map_entry);

// ---- meshes that the file describes

struct ir_outline_point {
    struct ir_head head;
    struct ir_point at;
};
IR_LIST(ir_outline, ir_outline_point);
struct ir_hole {
    struct ir_head head;
    struct ir_outline points;
};
IR_LIST(ir_holes, ir_hole);

struct ir_lathe {
    struct ir_head head;
    struct ir_outline profile; // x: distance from the axis
    unsigned curve;            // ir_curve
    double angle;              // degrees
};

struct ir_torus {
    struct ir_head head;
    double radius, tube;
};

struct ir_extrude {
    struct ir_head head;
    struct ir_outline outline;
    struct ir_holes holes;
    unsigned curve; // ir_curve
    double height, bevel;
};

struct ir_vertex {
    struct ir_head head;
    vec3 at;
};
IR_LIST(ir_vertices, ir_vertex);
struct ir_coordinate {
    struct ir_head head;
    struct ir_pair at;
};
IR_LIST(ir_coordinates, ir_coordinate);
struct ir_corner {
    struct ir_head head;
    int32_t vertex;
};
IR_LIST(ir_corners, ir_corner);
struct ir_face {
    struct ir_head head;
    struct ir_corners corners;
};
IR_LIST(ir_faces_list, ir_face);
struct ir_faces {
    struct ir_head head;
    struct ir_vertices vertices;
    struct ir_coordinates uv; // none, or one of each vertex
    struct ir_faces_list faces;
};

struct ir_text {
    struct ir_head head;
    str string;
    str font; // path as written
    double height, depth, bevel;
    unsigned align; // ir_align
};

struct ir_mesh {
    struct ir_head head;
    str name;      // empty: anonymous, written inline where it is used
    unsigned kind; // ir_mesh_kind
    struct ir_lathe lathe;
    struct ir_torus torus;
    struct ir_extrude extrude;
    struct ir_faces faces;
    struct ir_text text;
    double tolerance; // share of the size
};
IR_LIST(ir_meshes, ir_mesh);

struct ir_model {
    struct ir_head head;
    str name;
    struct ir_variables copies; // one for each of their values; none: the entry itself
    bool condition;             // whether there is one
    struct ir_reference mesh;   // without an index the path of a file
    str part;                   // of a mesh file that has several; empty: all of it
    struct ir_reference material;
    struct ir_map_entries material_map;
    bool smooth;
    double crease_angle;               // degrees
    vec3 scale, rotation, translation; // degrees; T·Rz·Ry·Rx·S
};

// A row of a matrix: what x, y, z and 1 are multiplied by.
struct ir_matrix_row {
    struct ir_head head;
    struct ir_quad numbers;
};
IR_LIST(ir_matrix_rows, ir_matrix_row);
struct ir_matrix {
    struct ir_head head;
    struct ir_matrix_rows rows; // three, for x, y and z
};

// The value of an object's parameter in an instance.
struct ir_with {
    struct ir_head head;
    str name;
    str value; // SCHEMA_TEXT_VALUES
};
IR_LIST(ir_withs, ir_with);

// An object, placed. In a scene that was expanded (ir_copies.h) each copy, at any depth, is one of the
// scene's instances.
struct ir_instance {
    struct ir_head head;
    str name;
    struct ir_variables copies; // one for each of their values; none: the entry itself
    bool condition;             // whether there is one
    struct ir_reference object;
    struct ir_withs with;
    struct ir_reference material;
    vec3 scale, rotation, translation; // degrees; T·Rz·Ry·Rx·S
    struct ir_matrix matrix;           // in their place, if it is written
};

struct ir_include {
    struct ir_head head;
    str file; // path as written
};

// A value of a track at a frame.
struct ir_keyframe {
    struct ir_head head;
    int32_t frame;
    str value; // SCHEMA_TEXT_VALUES
};
IR_LIST(ir_keyframes, ir_keyframe);

// How one value of the scene moves: through `keys`, or as `value` says.
struct ir_track {
    struct ir_head head;
    str target;             // the way to the value, as written
    str value;              // SCHEMA_TEXT_VALUES; empty: keys
    unsigned interpolation; // ir_interpolation
    unsigned loop;          // ir_loop
    struct ir_keyframes keys;
};
IR_LIST(ir_tracks, ir_track);

struct ir_animation {
    struct ir_head head;
    int32_t frames;
    double rate;   // frames per second
    int32_t frame; // the frame that the scene shows, if written; else it shows its values as they are
    struct ir_tracks tracks;
};

// A number, truth, vector or colour with a name.
struct ir_parameter {
    struct ir_head head;
    str name;
    str value; // SCHEMA_TEXT_VALUES
    double min, max;
    str description;
};
IR_LIST(ir_parameters, ir_parameter);

IR_LIST(ir_includes, ir_include);
IR_LIST(ir_cameras, ir_camera);
IR_LIST(ir_lights, ir_light);
IR_LIST(ir_materials, ir_material);
IR_LIST(ir_spheres, ir_sphere);
IR_LIST(ir_rectangles, ir_rectangle);
IR_LIST(ir_boxes, ir_box);
IR_LIST(ir_cylinders, ir_cylinder);
IR_LIST(ir_cones, ir_cone);
IR_LIST(ir_models, ir_model);

IR_LIST(ir_instances, ir_instance);

// Bodies and lights that instances show, around a zero of its own.
struct ir_object {
    struct ir_head head;
    str name; // empty: anonymous, written in place in an instance
    struct ir_parameters parameters;
    struct ir_lights lights;
    struct ir_spheres spheres;
    struct ir_rectangles rectangles;
    struct ir_boxes boxes;
    struct ir_cylinders cylinders;
    struct ir_cones cones;
    struct ir_models models;
    struct ir_instances instances;
};
IR_LIST(ir_objects, ir_object);

// One file, or the whole scene after its includes were merged (then `includes` is empty).
struct ir_scene {
    struct ir_head head;
    int32_t version;
    str description;
    struct ir_includes includes;
    struct ir_parameters parameters;
    struct ir_image image;
    struct ir_trace trace;
    struct ir_background background;
    struct ir_ambient ambient;
    struct ir_cameras cameras;
    struct ir_lights lights;
    struct ir_materials materials; // named and anonymous ones
    struct ir_meshes meshes;       // the same
    struct ir_spheres spheres;
    struct ir_rectangles rectangles;
    struct ir_boxes boxes;
    struct ir_cylinders cylinders;
    struct ir_cones cones;
    struct ir_models models;
    struct ir_objects objects; // named and anonymous ones; none once they were expanded
    struct ir_instances instances;
    struct ir_animation animation; // at its defaults once a frame was taken: ir_origin.motion
    struct ir_formulas *formulas;  // of the scene and its files; NULL: none
    const struct ir_copies
        *copies; // of a scene that was expanded: what its bodies and lights are copies of; NULL: of none
};

// Bodies are numbered spheres, rectangles, boxes, cylinders, cones, models, each in file order.
static inline uint32_t ir_body_count(const struct ir_scene *scene) {
    return scene->spheres.count + scene->rectangles.count + scene->boxes.count + scene->cylinders.count +
           scene->cones.count + scene->models.count;
}

#endif
