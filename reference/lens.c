// The camera's rays (docs/language.md, "Camera", "Projections" and "Lens").
#include "reference/reference_internal.h"

#include "grammar/ir.h"

static const double QUARTER_TURN = 1.57079632679489661923;

struct place {
    double x, y; // -1..1, up and to the right
    double aspect;
};

static vec3 combined(const struct view_camera *c, double forward, double right, double up) {
    const vec3 across = vec3_add(vec3_mul(c->right, right), vec3_mul(c->up, up));
    return forward == 0 ? across : vec3_add(vec3_mul(c->forward, forward), across);
}

// The direction of a pinhole's ray; for a view ahead its component along the view is 1.
static vec3 pinhole_direction(const struct view_camera *c, struct place at) {
    const double x = at.x * at.aspect;
    switch (c->projection) {
    case IR_PROJECTION_ORTHOGRAPHIC:
        return c->forward;
    case IR_PROJECTION_FISHEYE: {
        const double far = hypot(x, at.y), angle = far * c->half_field;
        const double part = far > 0 ? sin(angle) / far : 0;
        return combined(c, cos(angle), x * part, at.y * part);
    }
    case IR_PROJECTION_PANORAMA: {
        const double longitude = 2 * QUARTER_TURN * at.x, latitude = QUARTER_TURN * at.y;
        const double level = cos(latitude);
        return combined(c, cos(longitude) * level, sin(longitude) * level, sin(latitude));
    }
    default:
        return vec3_add(c->forward, vec3_mul(combined(c, 0, x, at.y), c->tan_half_fov));
    }
}

struct camera_ray reference_lens_ray(const struct reference *r, const struct reference_settings *settings,
                                     const struct points *points) {
    const struct view_camera *c = &r->input.view->camera;
    double a, b;
    if (settings->points_of)
        points_at(points, point_key(point_root(points->x, points->y), POINT_PIXEL), &a, &b);
    else
        view_sample_offset(points->sample, &a, &b);
    if (settings->apart > 1) {
        a = 0.5 + (a - 0.5) / settings->apart;
        b = 0.5 + (b - 0.5) / settings->apart;
    }
    const struct place at = {2 * (points->x + a) / settings->width - 1,
                             1 - 2 * (points->y + b) / settings->height,
                             (double)settings->width / settings->height};
    const vec3 direction = pinhole_direction(c, at);
    struct camera_ray ray = {vec3_sub(c->position, r->origin), vec3_unit(direction)};
    const bool is_parallel = c->projection == IR_PROJECTION_ORTHOGRAPHIC;
    if (is_parallel)
        ray.start =
            vec3_add(ray.start, combined(c, 0, at.x * at.aspect * c->half_height, at.y * c->half_height));
    if (c->lens_radius > 0 && points->bits > 0) {
        vec3 right = c->right, up = c->up;
        double u, v;
        if (!is_parallel && c->projection != IR_PROJECTION_PERSPECTIVE)
            reference_frame(ray.direction, &right, &up);
        points_at(points, point_key(point_root(points->x, points->y), POINT_LENS), &u, &v);
        reference_disc(u, v, &u, &v);
        const vec3 aside = vec3_add(vec3_mul(right, u * c->lens_radius), vec3_mul(up, v * c->lens_radius));
        ray.start = vec3_add(ray.start, aside);
        ray.direction = vec3_unit(vec3_sub(vec3_mul(direction, c->focus), aside));
    }
    ray.direction = reference_rounded3(r, ray.direction, 1);
    ray.start = reference_rounded3(r, ray.start, vec3_max_abs(ray.start));
    return ray;
}
