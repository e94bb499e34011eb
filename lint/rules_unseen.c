// Bodies that no camera sees: reported only where that is certain.
//
// A body counts as unseen where its box lies wholly outside the field of each camera, nothing mirrors or
// refracts, and it can cast no shadow into a field either.
#include "diag/codes/rule.h"
#include "lint/lint_internal.h"

#include "grammar/ir.h"

enum {
    PLANES = 5,
    WORK_MAX = 20000000, // boxes against cameras and lights
};

// Inside: dot(normal, p - at) >= 0. The plane of the camera and the four sides of its field.
struct field {
    int planes; // 0: everything may be in view
    vec3 at[PLANES];
    vec3 normals[PLANES];
};

static void put_plane(struct field *field, vec3 at, vec3 normal) {
    field->at[field->planes] = at;
    field->normals[field->planes++] = normal;
}

// The field of rays through a lens: all that start up to `reach` to the right and up of the position, and
// leave within the slopes.
static struct field field_with(const struct view_camera *camera, double right, double up,
                               const double reach[2]) {
    const vec3 p = camera->position, f = camera->forward, s = camera->right, u = camera->up;
    struct field field = {0};
    put_plane(&field, p, f);
    put_plane(&field, vec3_sub(p, vec3_mul(s, reach[0])), vec3_add(vec3_mul(f, right), s));
    put_plane(&field, vec3_add(p, vec3_mul(s, reach[0])), vec3_sub(vec3_mul(f, right), s));
    put_plane(&field, vec3_sub(p, vec3_mul(u, reach[1])), vec3_add(vec3_mul(f, up), u));
    put_plane(&field, vec3_add(p, vec3_mul(u, reach[1])), vec3_sub(vec3_mul(f, up), u));
    return field;
}

static struct field field_of(const struct lint *lint, const struct view_camera *camera) {
    const struct ir_image *image = lint->input->image;
    const double aspect = (double)image->width / image->height;
    const double lens = camera->lens_radius, wider = lens > 0 ? lens / camera->focus : 0;
    const double height = camera->half_height, slope = camera->tan_half_fov;
    switch (camera->projection) {
    case IR_PROJECTION_PERSPECTIVE:
        return field_with(camera, slope * aspect + wider, slope + wider, (double[2]){lens, lens});
    case IR_PROJECTION_ORTHOGRAPHIC:
        return field_with(camera, wider, wider, (double[2]){height * aspect + lens, height + lens});
    default:
        return (struct field){0};
    }
}

static double greatest(const struct lint_box *box, vec3 normal, vec3 from) {
    vec3 corner = {normal.x > 0 ? box->upper.x : box->lower.x, normal.y > 0 ? box->upper.y : box->lower.y,
                   normal.z > 0 ? box->upper.z : box->lower.z};
    return vec3_dot(normal, vec3_sub(corner, from));
}

// Whether the shadow of a box stays outside a plane that the box is outside of: each ray of light through the
// box goes on away from the plane, or along it.
static bool shadow_stays(const struct lint_box *box, vec3 normal, const struct view_light *light) {
    const double size = vec3_length(normal);
    if (light->directional)
        return vec3_dot(normal, light->to_light) >= size * sin(light->half_angle);
    const double nearer = size * light->radius + 0.5 * (fabs(vec3_dot(normal, light->edge_u)) +
                                                        fabs(vec3_dot(normal, light->edge_v)));
    return greatest(box, normal, light->position) + nearer <= 0;
}

static bool is_outside(const struct lint *lint, const struct lint_box *box, const struct field *field,
                       const struct view *view) {
    for (int k = 0; k < field->planes; k++) {
        vec3 normal = field->normals[k];
        if (!(greatest(box, normal, field->at[k]) < 0))
            continue;
        bool stays = true;
        for (uint32_t i = 0; lint->ir->trace.shadows && stays && i < view->light_count; i++)
            stays = shadow_stays(box, normal, &view->lights[i]);
        if (stays)
            return true;
    }
    return false;
}

// If cameras see nothing at all, the cameras are wrong, not the bodies.
static void report_cameras(struct lint *lint) {
    const struct ir_camera *camera = &lint->ir->cameras.items[0];
    span at = ir_place_value(lint->origin, &camera->head, &SCHEMA_CAMERA, "position");
    if (lint->view_count == 1)
        diag_add(lint->sink, DIAG_UNSEEN, at,
                 "camera '%.*s' sees none of the %u bodies, and no shadow of them falls into view",
                 STR_ARG(camera->name), lint->body_count);
    else
        diag_add(lint->sink, DIAG_UNSEEN, at,
                 "the cameras see none of the %u bodies, and no shadow of them falls into view",
                 lint->body_count);
    struct lint_box all = lint_box_empty();
    for (uint32_t k = 0; k < lint->body_count; k++)
        all = lint_box_join(all, lint->bodies[k].box);
    vec3 middle = vec3_mul(vec3_add(all.lower, all.upper), 0.5);
    diag_help(lint->sink, "turn it towards them: their centre is at %.3g %.3g %.3g", middle.x, middle.y,
              middle.z);
}

static void report_body(struct lint *lint, const struct lint_body *body) {
    diag_add(lint->sink, DIAG_UNSEEN, lint_place(lint, body),
             "%.*s is outside the view of %s, nothing mirrors it, and no shadow of it falls into view",
             STR_ARG(lint_words(lint, body)), lint->view_count == 1 ? "the camera" : "all cameras");
    diag_help(lint->sink, "turn a camera towards it, or remove it");
}

void lint_unseen(struct lint *lint) {
    if (lint->ir->cameras.count == 0 || lint_sends_rays_on(lint))
        return;
    if ((uint64_t)lint->body_count * lint->view_count * (lint->ir->lights.count + 1) > WORK_MAX)
        return;
    struct field *fields = ARENA_ARRAY(lint->arena, struct field, lint->view_count);
    uint32_t *unseen = ARENA_ARRAY(lint->arena, uint32_t, lint->body_count);
    uint32_t count = 0;
    for (uint32_t i = 0; i < lint->view_count; i++)
        fields[i] = field_of(lint, &lint->views[i].camera);
    for (uint32_t k = 0; k < lint->body_count; k++) {
        const struct lint_body *body = &lint->bodies[k];
        bool outside = lint_is_there(body);
        for (uint32_t i = 0; outside && i < lint->view_count; i++)
            outside = is_outside(lint, &body->box, &fields[i], &lint->views[i]);
        if (outside)
            unseen[count++] = k;
    }
    if (count > 1 && count == lint->body_count)
        report_cameras(lint);
    else
        for (uint32_t k = 0; k < count; k++)
            report_body(lint, &lint->bodies[unseen[k]]);
}
