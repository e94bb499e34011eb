// Where a picture shows a point, for each projection: the inverse of view_ray_at.
#include "core/angle.h"
#include "scene/view.h"

#include "grammar/ir.h"

// For a point at the centre of an all-round view, or right behind it, sine and angle are taken as this.
static const double SINE_LEAST = 1e-9;

static void see_ahead(const struct view_camera *c, double aspect, vec3 way, struct view_sight *out) {
    const bool is_parallel = c->projection == IR_PROJECTION_ORTHOGRAPHIC;
    const double depth = vec3_dot(way, c->forward);
    const double half = is_parallel ? c->half_height : c->tan_half_fov * depth;
    out->direction = is_parallel ? c->forward : vec3_unit(way);
    out->x = vec3_dot(way, c->right) / (half * aspect);
    out->y = vec3_dot(way, c->up) / half;
    out->height = depth > 0 ? 2 * half : 0;
    out->density = (is_parallel ? 1 : vec3_length(way) / depth) / (4 * half * half);
}

static void see_fisheye(const struct view_camera *c, double aspect, vec3 way, struct view_sight *out) {
    const double far = vec3_length(way), right = vec3_dot(way, c->right), up = vec3_dot(way, c->up);
    const double across = hypot(right, up), angle = atan2(across, vec3_dot(way, c->forward));
    const double part = across > 0 ? angle / (c->half_field * across) : 0;
    const double sine = fmax(across / far, SINE_LEAST);
    out->x = right * part / aspect;
    out->y = up * part;
    out->height = 2 * c->half_field * far;
    out->density = fmax(angle, SINE_LEAST) / sine / (out->height * out->height);
}

static void see_all_round(const struct view_camera *c, double aspect, vec3 way, struct view_sight *out) {
    const double far = vec3_length(way), up = fmin(1, fmax(-1, vec3_dot(way, c->up) / far));
    out->x = atan2(vec3_dot(way, c->right), vec3_dot(way, c->forward)) / PI;
    out->y = asin(up) / (PI / 2);
    out->height = PI * far;
    out->density = aspect / (2 * fmax(sqrt(1 - up * up), SINE_LEAST) * out->height * out->height);
}

bool view_sight_of(const struct view_camera *camera, double aspect, vec3 point, struct view_sight *out) {
    const vec3 way = vec3_sub(point, camera->position);
    *out = (struct view_sight){0};
    if (vec3_is_zero(way))
        return false;
    if (camera->projection == IR_PROJECTION_FISHEYE)
        see_fisheye(camera, aspect, way, out);
    else if (camera->projection == IR_PROJECTION_PANORAMA)
        see_all_round(camera, aspect, way, out);
    else
        see_ahead(camera, aspect, way, out);
    if (camera->projection != IR_PROJECTION_ORTHOGRAPHIC)
        out->direction = vec3_unit(way);
    return out->height > 0 && fabs(out->x) <= 1 && fabs(out->y) <= 1;
}
