// Extremes of distance, size and number.
#include "tests/sweep/sweep_internal.h"

void sweep_make_telescope(struct sweep_writer *w) {
    const double far = sweep_magnitude(w, 10, 1e6);
    const struct sweep_paint ground = sweep_chance(w, 0.5) ? sweep_checkered(w, 1) : sweep_matt(w);
    sweep_floor(w, 12, &ground);
    sweep_bodies(w, sweep_count(w, 2, 5), 2);
    sweep_lights(w);
    const vec3 along = vec3_unit(sweep_box(w, -1, 1, 0.1, 0.8, 1.5, 1.5));
    sweep_camera(w, vec3_mul(along, far), (vec3){0, 0.7, 0}, 2 * atan(2.5 / far) * 57.29577951308232);
}

void sweep_make_far_away(struct sweep_writer *w) {
    w->offset = sweep_around(w, 100, 1e10);
    sweep_still_life(w);
}

void sweep_make_tiny(struct sweep_writer *w) {
    w->scale = sweep_magnitude(w, 1e-12, 1e-2);
    if (sweep_chance(w, 0.8))
        w->offset = vec3_mul(w->offset, w->scale * sweep_magnitude(w, 1, 1e4));
    sweep_still_life(w);
}

void sweep_make_huge(struct sweep_writer *w) {
    w->scale = sweep_magnitude(w, 1e2, 1e12);
    sweep_still_life(w);
}

void sweep_make_deep(struct sweep_writer *w) {
    const double step = sweep_magnitude(w, 2, 100);
    double size = sweep_magnitude(w, 1e-4, 0.1), z = 0;
    const uint32_t count = sweep_count(w, 3, 6);
    for (uint32_t i = 0; i < count; i++, size *= step) {
        const struct sweep_paint paint = sweep_any_paint(w);
        z -= 4 * size;
        const vec3 at = sweep_box(w, -1.5 * size, 1.5 * size, -1.2 * size, 1.2 * size, z, z);
        if (sweep_chance(w, 0.6))
            sweep_sphere(w, at, 0.6 * size, &paint);
        else if (sweep_chance(w, 0.5))
            sweep_octahedron(w, at, 0.6 * size, &paint);
        else
            sweep_rectangle(w, at, vec3_mul((vec3){0.9, 0.2, 0.1}, size),
                            vec3_mul((vec3){-0.1, 0.8, 0.3}, size), &paint);
    }
    sweep_camera(w, (vec3){0, 0, 0}, (vec3){0, 0, -1}, 50);
    sweep_sun(w, (vec3){0.5, -1, -0.8}, 1);
    sweep_light(w, (vec3){-z, -z, 0}, 0.4);
}

void sweep_make_many_lights(struct sweep_writer *w) {
    const struct sweep_paint ground = sweep_matt(w);
    sweep_floor(w, 12, &ground);
    sweep_bodies(w, sweep_count(w, 1, 3), 3);
    const uint32_t count = (uint32_t)sweep_magnitude(w, 4, 120);
    for (uint32_t i = 0; i < count; i++)
        sweep_light(w, sweep_inside(w, (vec3){-9, 0.1, -9}, (vec3){9, 9, 9}), 2.0 / count);
    sweep_look(w);
}

void sweep_make_highlights(struct sweep_writer *w) {
    const struct sweep_paint ground = sweep_matt(w);
    sweep_floor(w, 12, &ground);
    for (int i = 0; i < 3; i++) {
        struct sweep_paint paint = sweep_matt(w);
        paint.specular = sweep_from(w, 0.3, 1);
        paint.exponent = sweep_magnitude(w, 0.1, 1e6);
        const vec3 at = {2.1 * (i - 1), 1, sweep_from(w, -1, 1)};
        if (sweep_chance(w, 0.3))
            sweep_globe(w, at, 1, 16, 24, true, &paint);
        else
            sweep_sphere(w, at, 1, &paint);
    }
    sweep_lights(w);
    sweep_look(w);
}

void sweep_make_smooth(struct sweep_writer *w) {
    const struct sweep_paint ground = sweep_matt(w);
    const struct sweep_paint paint = sweep_any_paint(w), other = sweep_any_paint(w);
    sweep_floor(w, 12, &ground);
    const uint32_t fine = sweep_count(w, 3, 20), coarse = sweep_count(w, 3, 9);
    sweep_globe(w, (vec3){-1.2, 1.1, 0}, 1, fine, sweep_count(w, 3, 30), true, &paint);
    sweep_globe(w, (vec3){1.2, 1.1, 0.3}, 1, coarse, sweep_count(w, 3, 9), true, &other);
    sweep_lights(w);
    sweep_look(w);
}

void sweep_make_terrain(struct sweep_writer *w) {
    const double extent = sweep_magnitude(w, 5, 1e4);
    const struct sweep_paint paint = sweep_chance(w, 0.3) ? sweep_mirror(w) : sweep_matt(w);
    const uint32_t cells = sweep_count(w, 8, 40);
    const bool smooth = sweep_chance(w, 0.5);
    sweep_hills(w, extent, extent * sweep_magnitude(w, 1e-4, 0.2), cells, smooth, &paint);
    sweep_camera(w, (vec3){0, 0.25 * extent, 0.9 * extent}, (vec3){0, 0, 0}, sweep_from(w, 20, 60));
    const double low = -sweep_magnitude(w, 0.01, 1);
    sweep_sun(w, sweep_box(w, -1, 1, low, low, -1, 1), 1);
}

void sweep_make_still(struct sweep_writer *w) {
    sweep_still_life(w);
    w->depth = sweep_count(w, 0, 8);
}

void sweep_make_mix(struct sweep_writer *w) {
    if (sweep_chance(w, 0.4))
        w->scale = sweep_magnitude(w, 1e-5, 1e5);
    if (sweep_chance(w, 0.4))
        w->offset = sweep_around(w, w->scale, 1e5 * w->scale);
    const struct sweep_paint ground = sweep_checkered(w, sweep_magnitude(w, 0.01, 10));
    const double extent = sweep_magnitude(w, 5, 1e4);
    sweep_floor(w, extent, &ground);
    sweep_bodies(w, sweep_count(w, 1, 3), 3);
    const struct sweep_paint glass = sweep_glass(w, 1 + sweep_magnitude(w, 1e-4, 1));
    const double above = sweep_magnitude(w, 1e-7, 0.1);
    sweep_sphere(w, sweep_box(w, -2, 2, 1 + above, 1 + above, 2, 2), 1, &glass);
    const struct sweep_paint tiles = sweep_checkered(w, sweep_magnitude(w, 1e-5, 1));
    sweep_sphere(w, (vec3){sweep_from(w, -2, 2), 1.4, -2}, 1.4, &tiles);
    sweep_lights(w);
    const double far = sweep_chance(w, 0.5) ? sweep_magnitude(w, 1, 1e3) : 1;
    const vec3 from = sweep_box(w, -4, 4, 1, 5, 6, 12);
    sweep_camera(w, vec3_mul(from, far), (vec3){0, 0.8, 0}, 45 / far);
    w->depth = sweep_count(w, 2, 8);
}
