// What a table cannot say: the scene rules (E4xx) as repairs on the typed IR, and what a picture needs.
#include "grammar/ir.h"
#include "grammar/schema.h"
#include "tests/generate/generate_values.h"

#include <math.h>

static const double FARTHEST = 1e17; // bodies keep this far from the ends of the coordinates

static void forget_row(const struct schema_element *schema, void *element, const char *name) {
    int row = schema_find_row(schema, str_from(name));
    if (row >= 0)
        ((struct ir_head *)element)->written &= ~(UINT64_C(1) << row);
}

static vec3 shrink(vec3 v) {
    double largest = vec3_max_abs(v);
    return largest > FARTHEST ? vec3_mul(v, FARTHEST / 2 / largest) : v;
}

// The axis that is least along v.
static vec3 across(vec3 v) {
    double x = fabs(v.x), y = fabs(v.y), z = fabs(v.z);
    if (x <= y && x <= z)
        return (vec3){1, 0, 0};
    return y <= z ? (vec3){0, 1, 0} : (vec3){0, 0, 1};
}

static bool is_parallel(vec3 a, vec3 b) {
    return vec3_length(vec3_cross(vec3_unit(a), vec3_unit(b))) < 1e-3;
}

static void mend_image(struct ir_image *image) {
    if ((int64_t)image->width * image->height > 67108864) {
        image->height = 67108864 / image->width;
        image->head.written |= UINT64_C(1) << schema_find_row(&SCHEMA_IMAGE, STR("height"));
    }
}

static void mend_projection(struct ir_camera *camera) {
    const bool perspective = camera->projection == IR_PROJECTION_PERSPECTIVE;
    if (camera->projection != IR_PROJECTION_ORTHOGRAPHIC)
        forget_row(&SCHEMA_CAMERA, camera, "size");
    if (!perspective && camera->projection != IR_PROJECTION_FISHEYE)
        forget_row(&SCHEMA_CAMERA, camera, "fov");
    if (camera->projection != IR_PROJECTION_ORTHOGRAPHIC)
        camera->size = 10;
    if (perspective ? camera->fov >= 180 : camera->projection != IR_PROJECTION_FISHEYE)
        camera->fov = 60;
}

static void focus_by_distance(struct ir_camera *camera) {
    if (camera->focusing == IR_FOCUS_BODY && camera->focus_on.len)
        return; // name_focus has found one
    if (camera->focusing == IR_FOCUS_POINT)
        forget_row(&SCHEMA_CAMERA, camera, "focus_at");
    if (camera->focusing == IR_FOCUS_BODY)
        forget_row(&SCHEMA_CAMERA, camera, "focus_on");
    camera->focusing = IR_FOCUS_DISTANCE;
    camera->focus_at = (vec3){0, 0, 0};
    if (!(camera->aperture > 0) || camera->focus > 0)
        return;
    camera->focus = 5;
    camera->head.written |= UINT64_C(1) << schema_find_row(&SCHEMA_CAMERA, STR("focus"));
}

// A camera that is focused on a body needs its name.
static void name_focus(const struct ir_scene *scene, struct ir_camera *camera) {
    if (camera->focusing != IR_FOCUS_BODY)
        return;
    camera->focus_on = (str){0};
    for (uint32_t i = 0; i < scene->spheres.count && !camera->focus_on.len; i++)
        camera->focus_on = scene->spheres.items[i].name;
}

static void mend_focus(struct ir_camera *camera, vec3 forward) {
    if (camera->focusing != IR_FOCUS_POINT)
        focus_by_distance(camera);
    else if (!(vec3_dot(vec3_sub(camera->focus_at, camera->position), vec3_unit(forward)) > 0))
        camera->focus_at = vec3_add(camera->position, vec3_mul(vec3_unit(forward), 5));
}

static void mend_camera(struct ir_camera *camera) {
    mend_projection(camera);
    vec3 forward = camera->direction;
    if (camera->view == IR_VIEW_DIRECTION && vec3_is_zero(forward))
        forward = camera->direction = (vec3){0, 0, -1};
    if (camera->view == IR_VIEW_LOOK_AT) {
        forward = vec3_sub(camera->look_at, camera->position);
        if (vec3_is_zero(forward)) {
            camera->look_at = vec3_is_zero(camera->position) ? (vec3){0, 0, -1} : (vec3){0, 0, 0};
            forward = vec3_sub(camera->look_at, camera->position);
        }
    }
    if (camera->view == IR_VIEW_ROTATION) {
        focus_by_distance(camera);
        camera->up = (vec3){0, 1, 0};
        forget_row(&SCHEMA_CAMERA, camera, "up");
        return;
    }
    mend_focus(camera, forward);
    bool is_written = camera->head.written >> schema_find_row(&SCHEMA_CAMERA, STR("up")) & 1;
    if (is_written && (vec3_is_zero(camera->up) || is_parallel(camera->up, forward)))
        camera->up = across(forward);
}

static void mend_extent(struct ir_light *light) {
    struct ir_panel *panel = &light->rectangle;
    if (light->kind != IR_LIGHT_POSITION) {
        light->radius = 0;
        forget_row(&SCHEMA_LIGHT, light, "radius");
        forget_row(&SCHEMA_LIGHT, light, "spot");
    }
    if (vec3_is_zero(light->spot.direction))
        light->spot.direction = (vec3){0, -1, 0};
    if (vec3_is_zero(vec3_sub(light->spot.look_at, light->position)))
        light->spot.look_at.y -= 1;
    if (light->kind != IR_LIGHT_DIRECTION) {
        light->angle = 0;
        forget_row(&SCHEMA_LIGHT, light, "angle");
    }
    if (light->kind != IR_LIGHT_RECTANGLE)
        return;
    panel->corner = shrink(panel->corner);
    panel->edge_u = shrink(panel->edge_u);
    panel->edge_v = shrink(panel->edge_v);
    if (vec3_is_zero(panel->edge_u))
        panel->edge_u = (vec3){1, 0, 0};
    if (vec3_is_zero(panel->edge_v) || is_parallel(panel->edge_u, panel->edge_v))
        panel->edge_v = across(panel->edge_u);
}

static void mend_light(struct ir_light *light) {
    mend_extent(light);
    if (light->kind != IR_LIGHT_DIRECTION)
        return;
    if (vec3_is_zero(light->direction))
        light->direction = (vec3){0, -1, 0};
    light->falloff = IR_FALLOFF_NONE;
    forget_row(&SCHEMA_LIGHT, light, "falloff");
}

static void mend_rectangle(struct ir_rectangle *rectangle) {
    rectangle->corner = shrink(rectangle->corner);
    rectangle->edge_u = shrink(rectangle->edge_u);
    rectangle->edge_v = shrink(rectangle->edge_v);
    if (vec3_is_zero(rectangle->edge_u))
        rectangle->edge_u = (vec3){1, 0, 0};
    if (vec3_is_zero(rectangle->edge_v) || is_parallel(rectangle->edge_u, rectangle->edge_v))
        rectangle->edge_v = across(rectangle->edge_u);
}

static void mend_box(struct ir_box *box) {
    box->center = shrink(box->center);
    box->size = (vec3){fmin(box->size.x, FARTHEST), fmin(box->size.y, FARTHEST), fmin(box->size.z, FARTHEST)};
}

// Meshes may be of any size up to a million units.
static void mend_model(struct ir_model *model, bool renderable) {
    if (renderable && model->mesh.index != IR_NO_INDEX) { // a mesh of the scene: it names no materials
        model->material_map.count = 0;
        model->head.written &= ~(UINT64_C(1) << schema_find_row(&SCHEMA_MODEL, STR("material_map")));
    }
    double largest = vec3_max_abs(model->scale);
    if (largest > 1e6) {
        model->scale.x = copysign(fmin(fabs(model->scale.x), 1e6), model->scale.x);
        model->scale.y = copysign(fmin(fabs(model->scale.y), 1e6), model->scale.y);
        model->scale.z = copysign(fmin(fabs(model->scale.z), 1e6), model->scale.z);
    }
    model->translation = shrink(model->translation);
}

static double hundredths(double value) {
    return round(value * 100) / 100;
}

static vec3 rounded(vec3 v) {
    return (vec3){hundredths(v.x), hundredths(v.y), hundredths(v.z)};
}

static vec3 between(struct generator *g, vec3 least, vec3 greatest) {
    double x = generate_between(g, least.x, greatest.x);
    double y = generate_between(g, least.y, greatest.y);
    double z = generate_between(g, least.z, greatest.z);
    return rounded((vec3){x, y, z});
}

// A view of the box in which moderate bodies lie, from a few units away.
static void frame_camera(struct generator *g, struct ir_camera *camera) {
    camera->position = between(g, (vec3){-4, 0, 7}, (vec3){4, 4, 11});
    camera->head.written |= UINT64_C(1) << schema_find_row(&SCHEMA_CAMERA, STR("position"));
    vec3 middle = between(g, (vec3){-0.5, -0.5, 0}, (vec3){0.5, 0.5, 0});
    if (camera->view == IR_VIEW_LOOK_AT) {
        camera->look_at = middle;
    } else if (camera->view == IR_VIEW_ROTATION) {
        camera->position = (vec3){0, 1, 10};
        camera->rotation = between(g, (vec3){-12, -8, -30}, (vec3){2, 8, 30});
    } else {
        camera->direction = rounded(vec3_sub(middle, camera->position));
        camera->head.written |= UINT64_C(1) << schema_find_row(&SCHEMA_CAMERA, STR("direction"));
    }
}

static void frame_light(struct ir_light *light) {
    if (light->kind == IR_LIGHT_POSITION)
        light->position = vec3_add(vec3_mul(light->position, 4), (vec3){0, 12, 8});
    light->position = rounded(light->position);
    light->spot.look_at = (vec3){0, 0.5, 0}; // at the bodies, from above them
    light->spot.direction = (vec3){-light->position.x, -light->position.y, -light->position.z};
    // A panel above the bodies, which shines down.
    if (light->kind == IR_LIGHT_RECTANGLE)
        light->rectangle = (struct ir_panel){.head = light->rectangle.head,
                                             .corner = {-4, 8, 4},
                                             .edge_u = {3, 0.5, 0},
                                             .edge_v = {0, 0.25, 4}};
    if (light->kind == IR_LIGHT_DIRECTION)
        light->direction.y = -fabs(light->direction.y) - 1;
    if (light->falloff == IR_FALLOFF_INVERSE_SQUARE) {
        light->intensity = hundredths(150 + 100 * light->intensity);
        light->head.written |= UINT64_C(1) << schema_find_row(&SCHEMA_LIGHT, STR("intensity"));
    }
}

// A track has keys, one after the other, or a value.
static void mend_track(struct ir_track *track) {
    const uint64_t value = UINT64_C(1) << schema_find_row(&SCHEMA_TRACK, STR("value"));
    int32_t frame = 0;
    for (uint32_t i = 0; i < track->keys.count; i++) {
        frame += 1 + (track->keys.items[i].frame < 0 ? 0 : track->keys.items[i].frame % 5);
        track->keys.items[i].frame = frame;
    }
    if (track->keys.count) {
        track->value = (str){0};
        track->head.written &= ~value;
    } else {
        track->value = track->value.len ? track->value : STR("0.5");
        track->head.written |= value;
    }
}

void generate_mend(struct generator *g, struct ir_scene *scene) {
    bool framed = g->options->renderable;
    mend_image(&scene->image);
    if (framed) {
        scene->image.width = generate_integer(g, SCHEMA_RANGE_EXTENT);
        scene->image.height = generate_integer(g, SCHEMA_RANGE_EXTENT);
        scene->image.head.written |= UINT64_C(1) << schema_find_row(&SCHEMA_IMAGE, STR("width"));
        scene->image.head.written |= UINT64_C(1) << schema_find_row(&SCHEMA_IMAGE, STR("height"));
        scene->head.written |= UINT64_C(1) << schema_find_row(&SCHEMA_SCENE, STR("image"));
    }
    for (uint32_t i = 0; i < scene->animation.tracks.count; i++)
        mend_track(&scene->animation.tracks.items[i]);
    for (uint32_t i = 0; i < scene->cameras.count; i++) {
        if (framed)
            frame_camera(g, &scene->cameras.items[i]);
        name_focus(scene, &scene->cameras.items[i]);
        mend_camera(&scene->cameras.items[i]);
    }
    for (uint32_t i = 0; i < scene->lights.count; i++) {
        if (framed)
            frame_light(&scene->lights.items[i]);
        mend_light(&scene->lights.items[i]);
    }
    for (uint32_t i = 0; i < scene->spheres.count; i++) {
        scene->spheres.items[i].center = shrink(scene->spheres.items[i].center);
        scene->spheres.items[i].radius = fmin(scene->spheres.items[i].radius, FARTHEST);
    }
    for (uint32_t i = 0; i < scene->rectangles.count; i++)
        mend_rectangle(&scene->rectangles.items[i]);
    for (uint32_t i = 0; i < scene->boxes.count; i++)
        mend_box(&scene->boxes.items[i]);
    for (uint32_t i = 0; i < scene->meshes.count; i++)
        generate_mend_mesh(g, &scene->meshes.items[i]);
    for (uint32_t i = 0; i < scene->models.count; i++)
        mend_model(&scene->models.items[i], framed);
}
