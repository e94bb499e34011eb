// Lenses and rough surfaces that cannot show their effect, and rays that begin inside bodies.
#include "diag/codes/rule.h"
#include "lint/lint_internal.h"

#include "grammar/ir.h"

#include <stdlib.h>

enum {
    STARTS_A_SIDE = 5, // per side of the grid of places looked at where rays begin
};

static const struct ir_camera *camera_of(const struct lint *lint, uint32_t view) {
    return &lint->ir->cameras.items[view];
}

static span camera_place(const struct lint *lint, const struct ir_camera *camera, const char *row) {
    return ir_place_value(lint->origin, &camera->head, &SCHEMA_CAMERA, row);
}

// ---- one sample

static bool is_rough(const struct ir_material *material) {
    return material->roughness > 0 && (material->albedo.reflection > 0 || material->albedo.refraction > 0);
}

// The first material in use that spreads what it reflects or refracts, and a body that has it.
static const struct ir_material *find_rough(const struct lint *lint, const struct lint_body **user) {
    for (uint32_t i = 0; i < lint->body_count; i++)
        for (uint32_t k = 0; k < lint->bodies[i].is->group_count; k++) {
            const struct ir_material *material = lint_material(lint, &lint->bodies[i], k);
            *user = &lint->bodies[i];
            if (is_rough(material))
                return material;
        }
    return NULL;
}

void lint_one_sample(struct lint *lint) {
    const char *const help = "write more samples: image: {samples: 64}";
    if (lint->input->image->samples > 1)
        return;
    for (uint32_t i = 0; i < lint->ir->cameras.count; i++) {
        const struct ir_camera *camera = camera_of(lint, i);
        if (!(camera->aperture > 0))
            continue;
        diag_add(lint->sink, DIAG_ONE_SAMPLE, camera_place(lint, camera, "aperture"),
                 "camera '%.*s' has a lens, but the picture has one sample per pixel: nothing is blurred",
                 STR_ARG(camera->name));
        diag_help(lint->sink, "%s", help);
        return;
    }
    const struct lint_body *user;
    const struct ir_material *rough = find_rough(lint, &user);
    if (!rough)
        return;
    diag_add(lint->sink, DIAG_ONE_SAMPLE,
             rough->head.origin == 0
                 ? lint_place(lint, user)
                 : ir_place_value(lint->origin, &rough->head, &SCHEMA_MATERIAL, "roughness"),
             "%.*s is rough, but the picture has one sample per pixel: it mirrors as if it were smooth",
             STR_ARG(lint_words(lint, user)));
    diag_help(lint->sink, "%s", help);
}

// ---- focus

// How near and how far bodies are, by their boxes: along the view, or from the camera if it looks all round.
static bool reach_of_bodies(const struct lint *lint, const struct view_camera *camera, double *near,
                            double *far) {
    const bool ahead = camera->projection <= IR_PROJECTION_ORTHOGRAPHIC;
    *near = INFINITY;
    *far = 0;
    for (uint32_t i = 0; i < lint->body_count; i++) {
        const struct lint_box *box = &lint->bodies[i].box;
        if (!lint_is_there(&lint->bodies[i]))
            continue;
        const vec3 p = camera->position;
        const vec3 nearest = vec3_max(box->lower, vec3_min(box->upper, p));
        double least = ahead ? INFINITY : vec3_length(vec3_sub(nearest, p));
        for (int k = 0; k < 8; k++) {
            const vec3 corner = {k & 1 ? box->upper.x : box->lower.x, k & 2 ? box->upper.y : box->lower.y,
                                 k & 4 ? box->upper.z : box->lower.z};
            const vec3 way = vec3_sub(corner, p);
            const double at = ahead ? vec3_dot(way, camera->forward) : vec3_length(way);
            least = fmin(least, at);
            *far = fmax(*far, at);
        }
        *near = fmin(*near, least);
    }
    return *far > 0;
}

static void report_focus(struct lint *lint, const struct ir_camera *camera, const struct view_camera *view,
                         double near, double far) {
    const char *const rows[] = {
        [IR_FOCUS_DISTANCE] = "focus", [IR_FOCUS_POINT] = "focus_at", [IR_FOCUS_BODY] = "focus_on"};
    const char *row = rows[camera->focusing];
    span at = camera_place(lint, camera, row);
    diag_add(lint->sink, DIAG_NOTHING_SHARP, span_is_none(at) ? camera_place(lint, camera, "aperture") : at,
             "camera '%.*s' is focused on a distance of %.6g, but all bodies are %s", STR_ARG(camera->name),
             view->focus, view->focus > far ? "nearer" : "farther away");
    diag_help(lint->sink, "bodies are from %.6g to %.6g away", fmax(near, 0), far);
}

// Whether the body that a camera focuses on is certainly not in front of it.
static bool is_behind(const struct lint *lint, const struct ir_camera *camera,
                      const struct view_camera *view) {
    const bool ahead = view->projection <= IR_PROJECTION_ORTHOGRAPHIC;
    for (uint32_t i = 0; ahead && camera->focusing == IR_FOCUS_BODY && i < lint->body_count; i++) {
        const struct lint_body *body = &lint->bodies[i];
        const vec3 middle = vec3_mul(vec3_add(body->box.lower, body->box.upper), 0.5);
        if (lint_is_there(body) && str_equal(body->is->name, camera->focus_on))
            return !(vec3_dot(vec3_sub(middle, view->position), view->forward) > 0);
    }
    return false;
}

static void report_behind(struct lint *lint, const struct ir_camera *camera) {
    diag_add(lint->sink, DIAG_NOTHING_SHARP, camera_place(lint, camera, "focus_on"),
             "camera '%.*s' is focused on '%.*s', whose middle is not before it", STR_ARG(camera->name),
             STR_ARG(camera->focus_on));
    diag_help(lint->sink, "choose a body in view, or write 'focus', a distance");
}

void lint_nothing_sharp(struct lint *lint) {
    for (uint32_t i = 0; i < lint->ir->cameras.count; i++) {
        const struct ir_camera *camera = camera_of(lint, i);
        const struct view_camera *view = &lint->views[i].camera;
        double near, far;
        if (!(view->lens_radius > 0))
            continue;
        if (is_behind(lint, camera, view)) {
            report_behind(lint, camera);
            continue;
        }
        if (reach_of_bodies(lint, view, &near, &far) && (view->focus > far || view->focus < near))
            report_focus(lint, camera, view, near, far);
        if (camera->aperture <= view->focus)
            continue;
        diag_add(lint->sink, DIAG_NOTHING_SHARP, camera_place(lint, camera, "aperture"),
                 "the aperture of camera '%.*s' is %.6g, wider than its focus is far, %.6g",
                 STR_ARG(camera->name), camera->aperture, view->focus);
        diag_help(lint->sink, "an aperture of %.3g blurs visibly", view->focus / 20);
    }
}

// ---- where rays begin

// A place where a ray begins: x and y from -1 to 1.
static vec3 start_at(const struct lint *lint, const struct view_camera *camera, double x, double y) {
    const struct ir_image *image = lint->input->image;
    const double height = camera->projection == IR_PROJECTION_ORTHOGRAPHIC ? camera->half_height : 0;
    const double width = height * image->width / image->height;
    return vec3_add(camera->position, vec3_add(vec3_mul(camera->right, x * (width + camera->lens_radius)),
                                               vec3_mul(camera->up, y * (height + camera->lens_radius))));
}

// A body for which some rays begin on the other side of its surface than the camera.
static const struct lint_body *between_starts(struct lint *lint, const struct view_camera *camera) {
    const double step = 2.0 / (STARTS_A_SIDE - 1);
    for (uint32_t k = 0; k < lint->body_count; k++) {
        const struct lint_body *body = &lint->bodies[k];
        if (body->is_opaque || !body->is->closed || !lint_is_there(body))
            continue;
        const bool inside = lint_is_inside(lint, body, camera->position);
        for (int i = 0; i < STARTS_A_SIDE * STARTS_A_SIDE; i++) {
            const vec3 at =
                start_at(lint, camera, step * (i % STARTS_A_SIDE) - 1, step * (i / STARTS_A_SIDE) - 1);
            if (lint_is_inside(lint, body, at) != inside)
                return body;
        }
    }
    return NULL;
}

void lint_lens_inside(struct lint *lint) {
    for (uint32_t i = 0; i < lint->ir->cameras.count; i++) {
        const struct ir_camera *camera = camera_of(lint, i);
        const struct view_camera *view = &lint->views[i].camera;
        const struct lint_body *body = view_from_one_place(view) ? NULL : between_starts(lint, view);
        if (!body)
            continue;
        span at = camera_place(lint, camera, "position");
        diag_add(lint->sink, DIAG_LENS_INSIDE, at,
                 "some rays of camera '%.*s' begin %s %.*s, where its position is not", STR_ARG(camera->name),
                 lint_is_inside(lint, body, view->position) ? "outside of" : "inside",
                 STR_ARG(lint_words_other(lint, body)));
        diag_note(lint->sink, lint_place(lint, body), "the body is here");
        diag_help(lint->sink, "move the camera away from it, or make its %s smaller",
                  view->projection == IR_PROJECTION_ORTHOGRAPHIC ? "size" : "aperture");
    }
}

// ---- the whole sphere in a picture

static bool fits_panorama(const struct ir_image *image) {
    return abs(image->width - 2 * image->height) <= 2;
}

// For a single camera: several share one size, whatever their projections.
void lint_panorama(struct lint *lint) {
    const struct ir_image *image = &lint->ir->image, *rendered = lint->input->image;
    const struct ir_camera *camera = lint->ir->cameras.count == 1 ? camera_of(lint, 0) : NULL;
    if (!camera || camera->projection != IR_PROJECTION_PANORAMA || fits_panorama(image) ||
        fits_panorama(rendered))
        return;
    diag_add(lint->sink, DIAG_STRETCHED, camera_place(lint, camera, "projection"),
             "camera '%.*s' shows 360 by 180 degrees, but the picture has %d x %d pixels: all is stretched",
             STR_ARG(camera->name), rendered->width, rendered->height);
    diag_help(lint->sink, "write a picture twice as wide as high: image: {width: %d, height: %d}",
              2 * rendered->height, rendered->height);
}
