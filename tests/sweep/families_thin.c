// Long triangles, thin gaps, and surfaces in the same plane.
#include "core/angle.h"
#include "tests/sweep/sweep_internal.h"

void sweep_make_rails(struct sweep_writer *w) {
    const double length = sweep_magnitude(w, 10, 5e4), width = 0.05;
    const struct sweep_paint ground = sweep_matt(w), iron = sweep_matt(w);
    const uint32_t count = sweep_count(w, 2, 4);
    const bool is_mesh = sweep_chance(w, 0.5);
    if (sweep_chance(w, 0.7))
        sweep_rectangle(w, (vec3){-50, 0, 5}, (vec3){100, 0, 0}, (vec3){0, 0, -length - 5}, &ground);
    for (uint32_t i = 0; i < count; i++) {
        const double x = 1.435 * (i - 0.5 * (count - 1));
        if (is_mesh)
            sweep_box_mesh(w, (vec3){x, 0.05, -length}, (vec3){x + width, 0.2, 0}, &iron);
        else
            sweep_box_rectangles(w, (vec3){x, 0.05, -length}, (vec3){x + width, 0.2, 0}, &iron);
    }
    const double height = sweep_magnitude(w, 0.3, 10);
    const vec3 from = sweep_box(w, -2, 2, height, height, 2, 2),
               at = sweep_box(w, 0, 0, 0, 0, -20 * height, -2 * height);
    sweep_camera(w, from, at, sweep_from(w, 20, 70));
    sweep_sun(w, sweep_box(w, -1, 1, -1, -1, -0.5, 0.5), 1);
    if (sweep_chance(w, 0.5))
        sweep_light(w, (vec3){3, 6, -5}, 0.6);
}

void sweep_make_slivers(struct sweep_writer *w) {
    const double aspect = sweep_magnitude(w, 10, 1e6);
    const uint32_t count = (uint32_t)fmin(2 * PI * aspect, 700);
    const double wide = fmax(1 / aspect, 2 * PI / count / 64);
    const struct sweep_paint paint = sweep_matt(w), behind = sweep_matt(w);
    sweep_mesh_begin(w);
    const uint32_t middle = sweep_vertex(w, (vec3){0, 0, 0});
    for (uint32_t i = 0; i < count; i++) {
        const double from = 2 * PI * i / count, to = from + fmin(wide, 2 * PI / count);
        const uint32_t a = sweep_vertex(w, (vec3){2 * cos(from), 2 * sin(from), 0});
        const uint32_t b = sweep_vertex(w, (vec3){2 * cos(to), 2 * sin(to), 0.01});
        sweep_face(w, middle, a, b);
    }
    sweep_mesh_end(w, false, &paint);
    sweep_rectangle(w, (vec3){-6, -6, -1}, (vec3){12, 0, 0}, (vec3){0, 12, 0}, &behind);
    const vec3 from = sweep_box(w, -2, 2, -2, 2, 3, 6);
    sweep_camera(w, from, (vec3){0, 0, 0}, sweep_from(w, 30, 60));
    sweep_light(w, (vec3){sweep_from(w, -4, 4), 5, 6}, 1);
}

void sweep_make_fan(struct sweep_writer *w) {
    const double reach = sweep_magnitude(w, 10, 1e6);
    const uint32_t count = sweep_count(w, 5, 300);
    const double y = -0.137; // not where a checker's cells meet: there, any rounding is right
    const struct sweep_paint paint = sweep_chance(w, 0.5) ? sweep_matt(w) : sweep_checkered(w, 1);
    sweep_mesh_begin(w);
    const uint32_t middle = sweep_vertex(w, (vec3){0.3, y, -0.4});
    for (uint32_t i = 0; i < count; i++) {
        const double angle = 2 * PI * i / count;
        sweep_vertex(w, (vec3){reach * cos(angle), y, reach * sin(angle)});
    }
    for (uint32_t i = 0; i < count; i++)
        sweep_face(w, middle, i + 2, (i + 1) % count + 2);
    sweep_mesh_end(w, false, &paint);
    sweep_bodies(w, sweep_count(w, 0, 2), 3);
    sweep_look(w);
    sweep_lights(w);
}

void sweep_make_gap(struct sweep_writer *w) {
    const double gap = sweep_magnitude(w, 1e-8, 0.1);
    const struct sweep_paint paint = sweep_matt(w);
    const bool is_mesh = sweep_chance(w, 0.3);
    for (int i = 0; i < 2; i++) {
        const double y = (i ? 0.5 : -0.5) * gap;
        if (is_mesh)
            sweep_box_mesh(w, (vec3){-1, i ? y : y - 0.3, -1}, (vec3){1, i ? y + 0.3 : y, 1}, &paint);
        else
            sweep_rectangle(w, (vec3){-1, y, -1}, (vec3){2, 0, 0}, (vec3){0, 0, 2}, &paint);
    }
    const double angle = sweep_from(w, 0, 2 * PI);
    const vec3 along = {cos(angle), 0, sin(angle)};
    const vec3 from = {0, gap * sweep_from(w, -0.3, 0.3), 0};
    sweep_camera(w, from, along, sweep_from(w, 30, 70));
    sweep_light(w, vec3_add(vec3_mul(along, 0.4), (vec3){0, gap * sweep_from(w, -0.3, 0.3), 0}), 1);
    sweep_light(w, (vec3){0.2, 3, 0.3}, 1);
}

void sweep_make_stack(struct sweep_writer *w) {
    const double gap = sweep_magnitude(w, 1e-9, 0.03);
    const struct sweep_paint ground = sweep_matt(w);
    sweep_floor(w, 10, &ground);
    const uint32_t plates = sweep_count(w, 1, 3);
    for (uint32_t i = 0; i < plates; i++) {
        const struct sweep_paint paint = sweep_matt(w);
        const vec3 corner = sweep_box(w, -3, 1, (i + 1) * gap, (i + 1) * gap, -3, 1);
        const vec3 u = {sweep_from(w, 1, 3), 0, 0.2}, v = {0.1, 0, sweep_from(w, 1, 3)};
        sweep_rectangle(w, corner, u, v, &paint);
    }
    const uint32_t balls = sweep_count(w, 0, 3);
    for (uint32_t i = 0; i < balls; i++) {
        const struct sweep_paint paint = sweep_any_paint(w);
        const double radius = sweep_from(w, 0.3, 0.8), y = radius + (plates + 1) * gap;
        sweep_sphere(w, sweep_box(w, -3, 3, y, y, -3, 3), radius, &paint);
    }
    sweep_lights(w);
    sweep_look(w);
}

void sweep_make_coplanar(struct sweep_writer *w) {
    const uint32_t count = sweep_count(w, 2, 4);
    for (uint32_t i = 0; i < count; i++) {
        const struct sweep_paint paint = sweep_matt(w);
        const vec3 corner = sweep_box(w, -3, 0, 0, 0, -3, 0);
        const vec3 u = {sweep_from(w, 2, 4), 0, 0}, v = {0, 0, sweep_from(w, 2, 4)};
        sweep_rectangle(w, corner, u, v, &paint);
    }
    sweep_lights(w);
    sweep_look(w);
}
