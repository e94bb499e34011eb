// Checkers, and cameras and lights close to surfaces.
#include "tests/sweep/sweep_internal.h"

void sweep_make_checker_ball(struct sweep_writer *w) {
    const double radius = sweep_magnitude(w, 0.3, 300);
    const uint32_t count = sweep_count(w, 1, 3);
    for (uint32_t i = 0; i < count; i++) {
        const struct sweep_paint paint = sweep_checkered(w, radius * sweep_magnitude(w, 1e-9, 1));
        sweep_sphere(w, (vec3){radius * (2.2 * i - 1.1 * (count - 1)), radius, 0}, radius, &paint);
    }
    const double away = radius * sweep_from(w, 3, 6);
    const vec3 from = sweep_box(w, -0.5 * away, 0.5 * away, 0.2 * away, 0.6 * away, away, away);
    sweep_camera(w, from, (vec3){0, radius, 0}, sweep_from(w, 20, 50));
    sweep_light(w, vec3_mul((vec3){-3, 6, 7}, radius), 1.2);
}

void sweep_make_checker_plane(struct sweep_writer *w) {
    const double extent = sweep_magnitude(w, 10, 1e6), cell = sweep_magnitude(w, 1e-7, 1e3);
    const struct sweep_paint paint = sweep_checkered(w, cell);
    sweep_floor(w, extent, &paint);
    sweep_bodies(w, sweep_count(w, 0, 2), 3);
    sweep_lights(w);
    sweep_look(w);
}

void sweep_make_checker_mesh(struct sweep_writer *w) {
    const struct sweep_paint paint = sweep_checkered(w, sweep_magnitude(w, 1e-7, 1));
    if (sweep_chance(w, 0.5))
        sweep_globe(w, (vec3){0, 1.5, 0}, 1.5, 12, 20, sweep_chance(w, 0.5), &paint);
    else
        sweep_hills(w, 8, 1, 12, sweep_chance(w, 0.5), &paint);
    sweep_lights(w);
    sweep_look(w);
}

// Looks from a height above (0, 0, 0) towards the horizon, down or in between.
static void look_low(struct sweep_writer *w, double height) {
    const double down = height * sweep_magnitude(w, 1e-3, 3);
    const vec3 from = {0, height, 0};
    const double angle = sweep_from(w, 0, 6.28);
    sweep_camera(w, from, vec3_add(from, (vec3){height * cos(angle), -down, height * sin(angle)}),
                 sweep_from(w, 20, 80));
}

void sweep_make_low_ball(struct sweep_writer *w) {
    const double radius = sweep_magnitude(w, 1, 1e5), height = radius * sweep_magnitude(w, 1e-8, 0.1);
    const struct sweep_paint paint =
        sweep_chance(w, 0.5) ? sweep_checkered(w, height * sweep_magnitude(w, 0.3, 30)) : sweep_any_paint(w);
    sweep_sphere(w, (vec3){0, -radius, 0}, radius, &paint);
    if (sweep_chance(w, 0.5)) {
        const struct sweep_paint other = sweep_matt(w);
        sweep_sphere(w, vec3_mul((vec3){1, 0.7, 2}, height), 0.5 * height, &other);
    }
    look_low(w, height);
    sweep_sun(w, sweep_box(w, -1, 1, -0.5, -0.5, -1, 1), 1);
}

void sweep_make_low_plane(struct sweep_writer *w) {
    const double extent = sweep_magnitude(w, 1, 1e6), height = extent * sweep_magnitude(w, 1e-8, 0.1);
    const struct sweep_paint paint =
        sweep_chance(w, 0.5) ? sweep_checkered(w, height * sweep_magnitude(w, 0.3, 30)) : sweep_any_paint(w);
    sweep_rectangle(w, (vec3){-0.7 * extent, 0, extent}, (vec3){2 * extent, 0, 0.1 * extent},
                    (vec3){0.3 * extent, 0, -2 * extent}, &paint);
    if (sweep_chance(w, 0.5)) {
        const struct sweep_paint other = sweep_matt(w);
        sweep_sphere(w, vec3_mul((vec3){1, 0.7, 2}, height), 0.5 * height, &other);
    }
    look_low(w, height);
    if (sweep_chance(w, 0.5))
        sweep_sun(w, sweep_box(w, -1, 1, -0.5, -0.5, -1, 1), 1);
    else
        sweep_light(w, vec3_mul((vec3){0.3, 0.2, 0.5}, extent), 1);
}

void sweep_make_low_mesh(struct sweep_writer *w) {
    const double height = sweep_magnitude(w, 1e-7, 0.3);
    const struct sweep_paint paint = sweep_chance(w, 0.5) ? sweep_matt(w) : sweep_checkered(w, 0.5);
    sweep_mesh_begin(w);
    // A roof whose ridge is at 0.
    const double x = sweep_from(w, 1, 50), down = sweep_from(w, 0, 0.4) * x;
    sweep_vertex(w, (vec3){0, 0, -x});
    sweep_vertex(w, (vec3){0, 0, x});
    sweep_vertex(w, (vec3){-x, -down, -x});
    sweep_vertex(w, (vec3){-x, -down, x});
    sweep_vertex(w, (vec3){x, -down, -x});
    sweep_vertex(w, (vec3){x, -down, x});
    sweep_face(w, 1, 3, 4);
    sweep_face(w, 1, 4, 2);
    sweep_face(w, 1, 2, 6);
    sweep_face(w, 1, 6, 5);
    sweep_mesh_end(w, false, &paint);
    look_low(w, height);
    sweep_lights(w);
}

void sweep_make_low_light(struct sweep_writer *w) {
    const struct sweep_paint ground = sweep_matt(w);
    sweep_floor(w, sweep_magnitude(w, 10, 1e4), &ground);
    sweep_bodies(w, sweep_count(w, 1, 4), 3);
    const double height = sweep_magnitude(w, 1e-6, 0.1);
    if (sweep_chance(w, 0.5))
        sweep_light(w, sweep_box(w, -4, 4, height, height, 1, 5), 1);
    else
        sweep_sun(w, (vec3){1, -height, sweep_from(w, -1, 1)}, 1);
    sweep_light(w, (vec3){3, 9, 5}, 0.4);
    sweep_look(w);
}
