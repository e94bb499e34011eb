// Lights that rays see (docs/language.md, "Lights that are seen").
#include "reference/reference_internal.h"

#include "grammar/ir.h"

// Where a ray enters a sphere from outside; NaN: nowhere.
static double on_sphere(vec3 way, vec3 direction, double radius) {
    const double dd = vec3_dot(direction, direction), middle = vec3_dot(way, direction) / dd;
    const vec3 beside = vec3_sub(way, vec3_mul(direction, middle));
    const double deep = radius * radius - vec3_dot(beside, beside);
    if (vec3_dot(way, way) <= radius * radius || !(deep >= 0))
        return (double)NAN;
    return middle - sqrt(deep / dd);
}

// The same for a panel, on the side that it shines on: Cramer's rule.
static double on_panel(vec3 way, vec3 direction, const struct view_light *light) {
    const vec3 u = light->edge_u, v = light->edge_v, across = vec3_cross(u, v);
    const double below = -vec3_dot(direction, across);
    if (!(below > 0))
        return (double)NAN;
    const vec3 moment = vec3_cross(direction, way);
    const double a = vec3_dot(v, moment) / below, b = -vec3_dot(u, moment) / below;
    const bool hits = fabs(a) <= 0.5 && fabs(b) <= 0.5;
    return hits ? -vec3_dot(way, across) / below : (double)NAN;
}

uint32_t reference_seen_light(const struct reference *r, vec3 start, vec3 direction, double t_max,
                              double *t) {
    const struct view *view = r->input.view;
    uint32_t found = IR_NO_INDEX;
    for (uint32_t i = 0; i < view->light_count; i++) {
        const struct view_light *light = &view->lights[i];
        if (!view_light_is_seen(light) || light->extent == VIEW_DISC)
            continue;
        const vec3 middle = reference_stored3(r, vec3_sub(light->position, r->origin));
        const vec3 way = vec3_sub(middle, start);
        const double at = light->extent == VIEW_SPHERE ? on_sphere(way, direction, light->radius)
                                                       : on_panel(way, direction, light);
        if (at > 0 && at < t_max) {
            t_max = *t = at;
            found = i;
        }
    }
    return found;
}

vec3 reference_seen_discs(const struct reference *r, vec3 direction) {
    const struct view *view = r->input.view;
    vec3 sum = {0, 0, 0};
    for (uint32_t i = 0; i < view->light_count; i++) {
        const struct view_light *light = &view->lights[i];
        if (!view_light_is_seen(light) || light->extent != VIEW_DISC ||
            !(vec3_dot(direction, light->to_light) > 0))
            continue;
        const double sine = vec3_length(vec3_cross(direction, light->to_light)) / vec3_length(direction);
        if (sine <= sin(light->half_angle))
            sum = vec3_add(sum, light->radiance);
    }
    return sum;
}
