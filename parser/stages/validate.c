// The rules that a table cannot say, on the merged scene. Each one looks only at rows that are not poisoned.
#include "diag/codes/binding.h"
#include "diag/codes/rule.h"
#include "parser/bind/bind.h"
#include "parser/bind/say.h"
#include "parser/stages/loader.h"

#include "core/number.h"
#include "core/ranges.h"
#include "grammar/ir.h"
#include "grammar/ir_walk.h"

#include <math.h>
#include <string.h>

// Below this sine two directions count as parallel (docs/language.md, "Camera").
static const double PARALLEL_SINE = 1e-9;
static const double COORDINATE_MAX = 1e18;
static const double LENGTH_MIN = 1e-18;

enum {
    SEEN_LIGHTS_MOST = 256,
};

struct rules {
    struct diag_sink *sink;
    const struct ir_origin *origin;
    struct arena *scratch;
};

static uint64_t bit(const struct schema_element *schema, const char *row) {
    return bind_bit((uint32_t)schema_find_row(schema, str_from(row)));
}

static bool is_written(const struct schema_element *schema, const void *memory, const char *row) {
    return (((const struct ir_head *)memory)->written & bit(schema, row)) != 0;
}

static bool is_poisoned(const struct schema_element *schema, const void *memory, const char *row) {
    return (((const struct ir_head *)memory)->poisoned & bit(schema, row)) != 0;
}

static span value_place(const struct rules *rules, const struct schema_element *schema, const void *memory,
                        const char *row) {
    return ir_place_value(rules->origin, memory, schema, row);
}

static str owner(const struct rules *rules, const struct schema_element *schema, str name) {
    if (name.len)
        return arena_format(rules->scratch, "%s '%.*s'", schema->name,
                            STR_ARG(say_text(rules->scratch, name)));
    return arena_format(rules->scratch, "this %s", schema->name);
}

// Directions.

static bool is_parallel(vec3 a, vec3 b) {
    return vec3_length(vec3_cross(vec3_unit(a), vec3_unit(b))) < PARALLEL_SINE;
}

// true: the direction exists and is not zero.
static bool check_direction(const struct rules *rules, const struct schema_element *schema,
                            const void *memory, str name, const char *row, vec3 value) {
    if (is_poisoned(schema, memory, row))
        return false;
    if (!is_written(schema, memory, row) || !vec3_is_zero(value))
        return true;
    diag_add(rules->sink, DIAG_ZERO_DIRECTION, value_place(rules, schema, memory, row),
             "'%s' of %.*s is 0 0 0, which points nowhere", row, STR_ARG(owner(rules, schema, name)));
    return false;
}

// Cameras.

// The direction of view; false if it is unknown.
static bool view_direction(const struct rules *rules, const struct ir_camera *camera, vec3 *view,
                           const char **row) {
    const struct schema_element *schema = &SCHEMA_CAMERA;
    *view = camera->direction;
    *row = "direction";
    if (camera->view != IR_VIEW_LOOK_AT)
        return check_direction(rules, schema, camera, camera->name, "direction", camera->direction);
    *row = "look_at";
    *view = vec3_sub(camera->look_at, camera->position);
    if (is_poisoned(schema, camera, "look_at") || is_poisoned(schema, camera, "position"))
        return false;
    if (!vec3_is_zero(*view))
        return true;
    diag_add(rules->sink, DIAG_LOOK_AT_POSITION, value_place(rules, schema, camera, "look_at"),
             "%.*s looks at its own position", STR_ARG(owner(rules, schema, camera->name)));
    if (is_written(schema, camera, "position"))
        diag_note(rules->sink, value_place(rules, schema, camera, "position"), "'position' is here");
    else
        diag_note(rules->sink, SPAN_NONE, "'position' is not written; it is 0 0 0");
    return false;
}

static void report_projection(const struct rules *rules, const struct ir_camera *camera, const char *row,
                              const char *help) {
    const struct schema_element *schema = &SCHEMA_CAMERA;
    const struct schema_row *projection = &schema->rows[schema_find_row(schema, STR("projection"))];
    diag_add(rules->sink, DIAG_OTHER_PROJECTION, ir_place_key(rules->origin, &camera->head, schema, row),
             "%.*s has '%s', which its projection '%s' does not use",
             STR_ARG(owner(rules, schema, camera->name)), row, projection->words[camera->projection]);
    if (is_written(schema, camera, "projection"))
        diag_note(rules->sink, value_place(rules, schema, camera, "projection"), "'projection' is here");
    diag_help(rules->sink, "%s", help);
}

static void check_projection(const struct rules *rules, const struct ir_camera *camera) {
    const struct schema_element *schema = &SCHEMA_CAMERA;
    const bool perspective = camera->projection == IR_PROJECTION_PERSPECTIVE;
    if (is_poisoned(schema, camera, "projection"))
        return;
    if (is_written(schema, camera, "size") && camera->projection != IR_PROJECTION_ORTHOGRAPHIC)
        report_projection(rules, camera, "size",
                          perspective || camera->projection == IR_PROJECTION_FISHEYE
                              ? "remove 'size', or write projection: orthographic; 'fov' is how much is seen"
                              : "remove 'size': a panorama shows all directions");
    if (is_written(schema, camera, "fov") && !perspective && camera->projection != IR_PROJECTION_FISHEYE)
        report_projection(rules, camera, "fov",
                          camera->projection == IR_PROJECTION_ORTHOGRAPHIC
                              ? "remove 'fov'; 'size' is the height of what is seen"
                              : "remove 'fov': a panorama shows all directions");
    if (!perspective || camera->fov < 180 || is_poisoned(schema, camera, "fov"))
        return;
    diag_add(rules->sink, DIAG_OUT_OF_RANGE, value_place(rules, schema, camera, "fov"),
             "'fov' of %.*s is %.6g; in perspective it must be less than 180 degrees",
             STR_ARG(owner(rules, schema, camera->name)), camera->fov);
    diag_help(rules->sink, "write a smaller 'fov', or projection: fisheye, which shows up to 360 degrees");
}

// A cosine: nearer than this to a right angle with the view, rounding decides which side a point is on.
#define FOCUS_LEAST 1e-12

// Checks what a lens is focused on, once the view is known.
static void check_focus(const struct rules *rules, const struct ir_camera *camera, vec3 view) {
    const struct schema_element *schema = &SCHEMA_CAMERA;
    const bool by_point = camera->focusing == IR_FOCUS_POINT;
    const bool looks = camera->view == IR_VIEW_LOOK_AT;
    const bool all_round =
        camera->projection == IR_PROJECTION_FISHEYE || camera->projection == IR_PROJECTION_PANORAMA;
    // The positions of bodies are not known yet: check finds those that are not before the camera (W427).
    if (!(camera->aperture > 0) || camera->focusing == IR_FOCUS_BODY ||
        is_poisoned(schema, camera, "focus") || is_poisoned(schema, camera, "focus_on") ||
        is_poisoned(schema, camera, "focus_at") || is_poisoned(schema, camera, "position"))
        return;
    const vec3 way = vec3_sub(camera->focus_at, camera->position);
    if (by_point && (all_round ? !vec3_is_zero(way) : vec3_dot(way, view) > FOCUS_LEAST * vec3_length(way)))
        return;
    if (by_point) {
        diag_add(rules->sink, DIAG_NO_FOCUS, value_place(rules, schema, camera, "focus_at"),
                 "'focus_at' of %.*s is not before the camera", STR_ARG(owner(rules, schema, camera->name)));
        diag_help(rules->sink, "choose a point in view, or write 'focus', a distance");
    } else if (!(camera->focus > 0) && !looks) {
        diag_add(rules->sink, DIAG_NO_FOCUS, ir_place_key(rules->origin, &camera->head, schema, "aperture"),
                 "%.*s has an aperture, but nothing says what it is focused on",
                 STR_ARG(owner(rules, schema, camera->name)));
        diag_help(rules->sink,
                  "write 'focus', a distance along the view, or 'focus_at', a point, or 'focus_on', a body");
    }
}

static void check_rotated(const struct rules *rules, const struct ir_camera *camera) {
    const struct schema_element *schema = &SCHEMA_CAMERA;
    check_focus(rules, camera, vec3_neg(mat3_column(mat3_rotation(camera->rotation), 2)));
    if (!is_written(schema, camera, "up"))
        return;
    diag_add(rules->sink, DIAG_UP_WITH_ROTATION, ir_place_key(rules->origin, &camera->head, schema, "up"),
             "%.*s has both 'up' and 'rotation', which turns the up direction too",
             STR_ARG(owner(rules, schema, camera->name)));
    diag_note(rules->sink, ir_place_key(rules->origin, &camera->head, schema, "rotation"),
              "'rotation' is here");
    diag_help(rules->sink, "remove 'up'; a rotation about z tilts the camera");
}

static void check_camera(const struct rules *rules, const struct ir_camera *camera) {
    const struct schema_element *schema = &SCHEMA_CAMERA;
    str name = owner(rules, schema, camera->name);
    check_projection(rules, camera);
    if (camera->view == IR_VIEW_ROTATION) {
        check_rotated(rules, camera);
        return;
    }
    vec3 view;
    const char *row;
    bool has_view = view_direction(rules, camera, &view, &row);
    bool has_up = is_written(schema, camera, "up") &&
                  check_direction(rules, schema, camera, camera->name, "up", camera->up);
    if (has_view)
        check_focus(rules, camera, view);
    if (!has_view || !has_up || !is_parallel(view, camera->up))
        return;
    diag_add(rules->sink, DIAG_UP_PARALLEL, value_place(rules, schema, camera, "up"),
             "'up' of %.*s points along the direction of view", STR_ARG(name));
    if (is_written(schema, camera, row))
        diag_note(rules->sink, value_place(rules, schema, camera, row),
                  "the direction of view comes from '%s'", row);
    else
        diag_note(rules->sink, SPAN_NONE, "without 'look_at' and 'direction' the camera looks along 0 0 -1");
    diag_help(rules->sink, "choose another 'up', or leave it out: the default one adapts");
}

// Lights.

static bool leaves_world(vec3 v) {
    return !(vec3_max_abs(v) <= COORDINATE_MAX);
}

// Whether two edges span an area; they belong to the `whole` of this name.
static bool check_edges(const struct rules *rules, const struct schema_element *schema, const void *memory,
                        const struct schema_element *whole, str name, vec3 edge_u, vec3 edge_v) {
    const char *const rows[2] = {"edge_u", "edge_v"};
    const vec3 edges[2] = {edge_u, edge_v};
    bool known[2] = {false, false};
    for (int i = 0; i < 2; i++) {
        if (is_poisoned(schema, memory, rows[i]))
            continue;
        known[i] = !vec3_is_zero(edges[i]);
        if (!known[i])
            diag_add(rules->sink, DIAG_DEGENERATE_RECTANGLE, value_place(rules, schema, memory, rows[i]),
                     "'%s' of %.*s is 0 0 0, which leaves no area", rows[i],
                     STR_ARG(owner(rules, whole, name)));
    }
    if (!known[0] || !known[1] || !is_parallel(edge_u, edge_v))
        return known[0] && known[1];
    diag_add(rules->sink, DIAG_DEGENERATE_RECTANGLE, value_place(rules, schema, memory, "edge_v"),
             "the edges of %.*s are parallel, which leaves no area", STR_ARG(owner(rules, whole, name)));
    diag_note(rules->sink, value_place(rules, schema, memory, "edge_u"), "'edge_u' is here");
    return false;
}

static void check_panel(const struct rules *rules, const struct ir_light *light) {
    const struct schema_element *schema = &SCHEMA_PANEL;
    const struct ir_panel *panel = &light->rectangle;
    if (is_poisoned(&SCHEMA_LIGHT, light, "rectangle"))
        return;
    if (!check_edges(rules, schema, panel, &SCHEMA_LIGHT, light->name, panel->edge_u, panel->edge_v) ||
        is_poisoned(schema, panel, "corner"))
        return;
    const vec3 u = vec3_add(panel->corner, panel->edge_u);
    if (leaves_world(u) || leaves_world(vec3_add(panel->corner, panel->edge_v)) ||
        leaves_world(vec3_add(u, panel->edge_v)))
        diag_add(rules->sink, DIAG_TRANSFORM_OVERFLOW, value_place(rules, schema, panel, "edge_u"),
                 "%.*s has a coordinate beyond 1e18", STR_ARG(owner(rules, &SCHEMA_LIGHT, light->name)));
}

// Rays test each of them: more would be a mistake, or take forever.
static void check_seen(const struct rules *rules, const struct ir_lights *lights) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < lights->count; i++) {
        if (!lights->items[i].visible || ++count <= SEEN_LIGHTS_MOST)
            continue;
        diag_add(rules->sink, DIAG_MANY_SEEN,
                 ir_place_key(rules->origin, &lights->items[i].head, &SCHEMA_LIGHT, "visible"),
                 "more than %d lights are visible", SEEN_LIGHTS_MOST);
        diag_help(rules->sink, "let bodies with emission show further ones");
        return;
    }
}

// Reports a row that would give extent to another kind of light than its own.
static void check_extent(const struct rules *rules, const struct ir_light *light) {
    static const struct {
        const char *row, *means;
        enum ir_light_kind kind;
    } extents[] = {{"radius", "the radius of a light with a position", IR_LIGHT_POSITION},
                   {"angle", "what a light with a direction measures across", IR_LIGHT_DIRECTION}};
    static const char *const kinds[] = {"position", "direction", "rectangle"};
    const struct schema_element *schema = &SCHEMA_LIGHT;
    const double sizes[] = {light->radius, light->angle};
    for (size_t i = 0; i < sizeof extents / sizeof *extents; i++) {
        if (sizes[i] == 0 || light->kind == extents[i].kind || !is_written(schema, light, extents[i].row) ||
            is_poisoned(schema, light, extents[i].row))
            continue;
        diag_add(rules->sink, DIAG_EXTENT_KIND,
                 ir_place_key(rules->origin, &light->head, schema, extents[i].row),
                 "'%s' is %s; %.*s has a '%s'", extents[i].row, extents[i].means,
                 STR_ARG(owner(rules, schema, light->name)), kinds[light->kind]);
        diag_note(rules->sink, ir_place_key(rules->origin, &light->head, schema, kinds[light->kind]),
                  "'%s' is here", kinds[light->kind]);
        if (light->kind == IR_LIGHT_RECTANGLE)
            diag_help(rules->sink, "remove '%s': the edges say how large the light is", extents[i].row);
        else if (light->kind == IR_LIGHT_POSITION)
            diag_help(
                rules->sink,
                "for a cone of light write spot: {look_at: ..., angle: ...}; for a sphere write 'radius'");
        else
            diag_help(rules->sink, "write '%s', or remove '%s'", extents[1 - i].row, extents[i].row);
    }
}

static void check_spot(const struct rules *rules, const struct ir_light *light) {
    const struct schema_element *schema = &SCHEMA_LIGHT;
    const struct ir_spot *spot = &light->spot;
    if (!is_written(schema, light, "spot") || is_poisoned(schema, light, "spot"))
        return;
    if (light->kind != IR_LIGHT_POSITION) {
        const char *kind = light->kind == IR_LIGHT_DIRECTION ? "direction" : "rectangle";
        diag_add(rules->sink, DIAG_EXTENT_KIND, ir_place_key(rules->origin, &light->head, schema, "spot"),
                 "'spot' is the cone of a light with a position; %.*s has a '%s'",
                 STR_ARG(owner(rules, schema, light->name)), kind);
        diag_note(rules->sink, ir_place_key(rules->origin, &light->head, schema, kind), "'%s' is here", kind);
        diag_help(rules->sink, "write 'position', or remove 'spot'");
    } else if (spot->aim == IR_AIM_DIRECTION) {
        check_direction(rules, &SCHEMA_SPOT, spot, light->name, "direction", spot->direction);
    } else if (!is_poisoned(&SCHEMA_SPOT, spot, "look_at") && !is_poisoned(schema, light, "position") &&
               is_written(&SCHEMA_SPOT, spot, "look_at") &&
               vec3_is_zero(vec3_sub(spot->look_at, light->position))) {
        diag_add(rules->sink, DIAG_ZERO_DIRECTION, value_place(rules, &SCHEMA_SPOT, spot, "look_at"),
                 "%.*s looks at its own position, which points nowhere",
                 STR_ARG(owner(rules, schema, light->name)));
        diag_note(rules->sink, value_place(rules, schema, light, "position"), "'position' is here");
    }
}

static void check_light(const struct rules *rules, const struct ir_light *light) {
    const struct schema_element *schema = &SCHEMA_LIGHT;
    check_extent(rules, light);
    check_spot(rules, light);
    if (light->kind == IR_LIGHT_RECTANGLE)
        check_panel(rules, light);
    if (light->kind != IR_LIGHT_DIRECTION)
        return;
    check_direction(rules, schema, light, light->name, "direction", light->direction);
    if (light->falloff == IR_FALLOFF_NONE || is_poisoned(schema, light, "falloff"))
        return;
    diag_add(rules->sink, DIAG_FALLOFF_DIRECTIONAL, value_place(rules, schema, light, "falloff"),
             "%.*s has a direction, so its light cannot fall off with distance",
             STR_ARG(owner(rules, schema, light->name)));
    diag_note(rules->sink, ir_place_key(rules->origin, &light->head, schema, "direction"),
              "'direction' is here");
    diag_help(rules->sink, "give the light a 'position', or remove 'falloff'");
}

// Bodies.

static void report_leaving(const struct rules *rules, const struct schema_element *schema, const void *memory,
                           str name, const char *row) {
    diag_add(rules->sink, DIAG_TRANSFORM_OVERFLOW, value_place(rules, schema, memory, row),
             "%.*s has a coordinate beyond 1e18", STR_ARG(owner(rules, schema, name)));
}

static void check_sphere(const struct rules *rules, const struct ir_sphere *sphere) {
    const struct schema_element *schema = &SCHEMA_SPHERE;
    if (is_poisoned(schema, sphere, "center") || is_poisoned(schema, sphere, "radius"))
        return;
    if (!(vec3_max_abs(sphere->center) + sphere->radius <= COORDINATE_MAX))
        report_leaving(rules, schema, sphere, sphere->name, "radius");
}

static void check_rectangle(const struct rules *rules, const struct ir_rectangle *rectangle) {
    const struct schema_element *schema = &SCHEMA_RECTANGLE;
    if (!check_edges(rules, schema, rectangle, schema, rectangle->name, rectangle->edge_u,
                     rectangle->edge_v) ||
        is_poisoned(schema, rectangle, "corner"))
        return;
    vec3 u = vec3_add(rectangle->corner, rectangle->edge_u);
    vec3 v = vec3_add(rectangle->corner, rectangle->edge_v);
    bool by_u = leaves_world(u);
    bool by_v = leaves_world(v) || leaves_world(vec3_add(u, rectangle->edge_v));
    if (by_u || by_v)
        report_leaving(rules, schema, rectangle, rectangle->name, by_u ? "edge_u" : "edge_v");
}

// A corner, which rotation may turn into any direction, is at most the sum of the edges from the middle.
static void check_box(const struct rules *rules, const struct ir_box *box) {
    const struct schema_element *schema = &SCHEMA_BOX;
    if (is_poisoned(schema, box, "center") || is_poisoned(schema, box, "size"))
        return;
    if (!(vec3_max_abs(box->center) + box->size.x + box->size.y + box->size.z <= COORDINATE_MAX))
        report_leaving(rules, schema, box, box->name, "size");
}

// Its ends, and whether they are apart. The corners of a box around it are at most this far from its ends.
static void check_ends(const struct rules *rules, const struct schema_element *schema, const void *memory,
                       str name, vec3 from, vec3 to, double reach) {
    if (is_poisoned(schema, memory, "from") || is_poisoned(schema, memory, "to"))
        return;
    if (!(vec3_max_abs(vec3_sub(to, from)) >= LENGTH_MIN)) {
        diag_add(rules->sink, DIAG_DEGENERATE_CONE, value_place(rules, schema, memory, "to"),
                 "'to' of %.*s is where 'from' is, which leaves no length",
                 STR_ARG(owner(rules, schema, name)));
        diag_note(rules->sink, value_place(rules, schema, memory, "from"), "'from' is here");
    } else if (!(vec3_max_abs(from) + reach <= COORDINATE_MAX)) {
        report_leaving(rules, schema, memory, name, "from");
    } else if (!(vec3_max_abs(to) + reach <= COORDINATE_MAX)) {
        report_leaving(rules, schema, memory, name, "to");
    }
}

static void check_cylinder(const struct rules *rules, const struct ir_cylinder *cylinder) {
    const struct schema_element *schema = &SCHEMA_CYLINDER;
    const double reach = is_poisoned(schema, cylinder, "radius") ? 0 : cylinder->radius;
    check_ends(rules, schema, cylinder, cylinder->name, cylinder->from, cylinder->to, reach);
}

static void check_cone(const struct rules *rules, const struct ir_cone *cone) {
    const struct schema_element *schema = &SCHEMA_CONE;
    const bool known = !is_poisoned(schema, cone, "radius_from") && !is_poisoned(schema, cone, "radius_to");
    const double reach = known ? fmax(cone->radius_from, cone->radius_to) : 0;
    check_ends(rules, schema, cone, cone->name, cone->from, cone->to, reach);
    if (!known || reach >= LENGTH_MIN)
        return;
    diag_add(rules->sink, DIAG_DEGENERATE_CONE, value_place(rules, schema, cone, "radius_to"),
             "both radii of %.*s are 0, which leaves nothing of it",
             STR_ARG(owner(rules, schema, cone->name)));
    diag_note(rules->sink, value_place(rules, schema, cone, "radius_from"), "'radius_from' is here");
    diag_help(rules->sink, "one of them may be 0: there it ends in a tip");
}

static void check_scale(const struct rules *rules, const struct schema_element *schema, const void *memory,
                        str name, vec3 scale) {
    bool zero = scale.x == 0 || scale.y == 0 || scale.z == 0;
    if (!zero || is_poisoned(schema, memory, "scale"))
        return;
    diag_add(rules->sink, DIAG_ZERO_SCALE, value_place(rules, schema, memory, "scale"),
             "'scale' of %.*s is 0, which leaves nothing of it", STR_ARG(owner(rules, schema, name)));
    diag_help(rules->sink, "1 keeps the size; a negative value mirrors");
}

static void check_model(const struct rules *rules, const struct ir_model *model) {
    check_scale(rules, &SCHEMA_MODEL, model, model->name, model->scale);
}

static void help_four_rows(const struct rules *rules, const struct ir_quad *fourth) {
    const bool is_last = fourth->x == 0 && fourth->y == 0 && fourth->z == 0 && fourth->t == 1;
    diag_help(rules->sink,
              is_last ? "leave out the fourth, 0, 0, 0, 1"
                      : "where the object is belongs in the last column: if it is in the fourth row, "
                        "exchange rows and columns, and leave out the fourth row, then 0, 0, 0, 1");
}

static void check_instance(const struct rules *rules, const struct ir_instance *instance) {
    const struct schema_element *schema = &SCHEMA_INSTANCE;
    const uint32_t rows = instance->matrix.rows.count;
    check_scale(rules, schema, instance, instance->name, instance->scale);
    if (!is_written(schema, instance, "matrix") || is_poisoned(schema, instance, "matrix"))
        return;
    const span at = value_place(rules, schema, instance, "matrix");
    if (rows != 3 && !instance->matrix.head.poisoned) {
        diag_add(rules->sink, DIAG_MATRIX, at, "the matrix has %u row%s; it needs 3, for x, y and z", rows,
                 rows == 1 ? "" : "s");
        if (rows == 4)
            help_four_rows(rules, &instance->matrix.rows.items[3].numbers);
    }
    static const char *const others[] = {"scale", "rotation", "translation"};
    for (int i = 0; i < 3; i++) {
        if (!is_written(schema, instance, others[i]))
            continue;
        diag_add(rules->sink, DIAG_MATRIX, value_place(rules, schema, instance, others[i]),
                 "an instance with a matrix has no '%s': the matrix says where the object is", others[i]);
        diag_note(rules->sink, at, "the matrix is here");
        diag_help(rules->sink, "remove one of the two, or put one instance into another");
    }
}

// The picture.

static void check_image(const struct rules *rules, const struct ir_image *image) {
    const struct schema_element *schema = &SCHEMA_IMAGE;
    int64_t pixels = (int64_t)image->width * image->height;
    // Other pictures are rendered in bands.
    if (pixels <= RANGE_PIXELS_MOST || !(image->error > 0) || is_poisoned(schema, image, "width") ||
        is_poisoned(schema, image, "height"))
        return;
    const char *later = is_written(schema, image, "height") ? "height" : "width";
    const char *other = strcmp(later, "height") == 0 ? "width" : "height";
    diag_add(rules->sink, DIAG_TOO_MANY_PIXELS, value_place(rules, schema, image, later),
             "the image has %d x %d, that is %lld pixels; at most %lld are allowed where 'error' ends them",
             image->width, image->height, (long long)pixels, (long long)RANGE_PIXELS_MOST);
    if (is_written(schema, image, other))
        diag_note(rules->sink, value_place(rules, schema, image, other), "'%s' is here", other);
    diag_note(rules->sink, value_place(rules, schema, image, "error"), "'error' is here");
    diag_help(rules->sink,
              "leave 'error' out: all pixels then have the same samples, and are rendered in bands");
}

void validate_element(struct loader *loader, const struct schema_element *schema, const void *memory) {
    struct rules rules = {loader->input->sink, &loader->output->origin, &loader->scratch};
    if (schema == &SCHEMA_IMAGE)
        check_image(&rules, memory);
    else if (schema == &SCHEMA_CAMERA)
        check_camera(&rules, memory);
    else if (schema == &SCHEMA_LIGHT)
        check_light(&rules, memory);
    else if (schema == &SCHEMA_SPHERE)
        check_sphere(&rules, memory);
    else if (schema == &SCHEMA_RECTANGLE)
        check_rectangle(&rules, memory);
    else if (schema == &SCHEMA_BOX)
        check_box(&rules, memory);
    else if (schema == &SCHEMA_CYLINDER)
        check_cylinder(&rules, memory);
    else if (schema == &SCHEMA_CONE)
        check_cone(&rules, memory);
    else if (schema == &SCHEMA_MODEL)
        check_model(&rules, memory);
    else if (schema == &SCHEMA_INSTANCE)
        check_instance(&rules, memory);
}

void validate_scene(struct loader *loader, const struct ir_scene *scene) {
    struct rules rules = {loader->input->sink, &loader->output->origin, &loader->scratch};
    validate_element(loader, &SCHEMA_IMAGE, &scene->image);
    check_seen(&rules, &scene->lights);
    for (uint32_t row = 0; row < SCHEMA_SCENE.row_count; row++) {
        const struct schema_row *r = &SCHEMA_SCENE.rows[row];
        const struct ir_any_list list = ir_walk_list(r, scene);
        for (uint32_t i = 0; i < list.count; i++)
            validate_element(loader, r->child, ir_walk_item(r, list, i));
    }
    arena_finish(&loader->scratch);
}
