// What needs more than one sample: a lens, ambient light that is blocked, rough surfaces, lights that have an
// extent; images; and one mesh in many sizes.
#include "tests/sweep/sweep_internal.h"

// Of a scene whose pixels need several.
static uint32_t some_samples(struct sweep_writer *w) {
    static const uint32_t counts[] = {4, 4, 4, 9, 16};
    return counts[sweep_count(w, 0, 4)];
}

void sweep_make_sampled(struct sweep_writer *w) {
    static sweep_maker *const makers[] = {
        sweep_make_checker_plane, sweep_make_checker_ball, sweep_make_mirror_balls, sweep_make_concave,
        sweep_make_ball_chain,    sweep_make_gem,          sweep_make_magnifier,    sweep_make_kaleidoscope,
        sweep_make_mirror_hall,   sweep_make_slivers,      sweep_make_far_away,     sweep_make_telescope,
        sweep_make_touching,      sweep_make_terrain,      sweep_make_nested_glass, sweep_make_panes,
    };
    makers[sweep_count(w, 0, sizeof makers / sizeof *makers - 1)](w);
    if (sweep_chance(w, 0.5))
        sweep_aperture(w, sweep_magnitude(w, 1e-4, 0.1), sweep_magnitude(w, 1, 30));
    w->samples = some_samples(w);
}

void sweep_make_lens(struct sweep_writer *w) {
    sweep_still_life(w);
    const double focus = sweep_magnitude(w, 2, 30);
    sweep_aperture(w, focus * sweep_magnitude(w, 1e-3, 0.2), focus);
    w->samples = some_samples(w);
}

void sweep_make_occluded(struct sweep_writer *w) {
    const struct sweep_paint wall = sweep_matt(w);
    sweep_still_life(w);
    sweep_rectangle(w, (vec3){-12, 0, -4}, (vec3){24, 0, 0}, (vec3){0, 9, 0}, &wall);
    sweep_ambient(w, sweep_from(w, 0.2, 1), sweep_magnitude(w, 0.1, 30));
    w->samples = some_samples(w);
}

void sweep_make_rough(struct sweep_writer *w) {
    sweep_still_life(w);
    const uint32_t count = sweep_count(w, 1, 3);
    for (uint32_t i = 0; i < count; i++) {
        struct sweep_paint paint =
            sweep_chance(w, 0.5) ? sweep_mirror(w) : sweep_glass(w, sweep_from(w, 1.1, 2.4));
        paint.roughness = sweep_magnitude(w, 0.01, 1);
        const double radius = sweep_from(w, 0.3, 1.2);
        const vec3 at = sweep_box(w, -2, 2, radius, radius, 0, 3);
        if (sweep_chance(w, 0.5))
            sweep_sphere(w, at, radius, &paint);
        else
            sweep_globe(w, at, radius, 9, 14, sweep_chance(w, 0.5), &paint);
    }
    w->samples = some_samples(w);
}

void sweep_make_lamps(struct sweep_writer *w) {
    sweep_still_life(w);
    const uint32_t count = sweep_count(w, 1, 3);
    for (uint32_t i = 0; i < count; i++) {
        const vec3 at = sweep_box(w, -6, 6, 2, 9, -4, 9);
        if (sweep_chance(w, 0.5))
            sweep_ball_light(w, at, sweep_magnitude(w, 0.05, 2), 1.0 / count);
        else
            sweep_panel_light(w, at, sweep_magnitude(w, 0.2, 4), 1.0 / count);
    }
    w->samples = some_samples(w);
}

void sweep_make_images(struct sweep_writer *w) {
    struct sweep_paint ground = sweep_matt(w);
    ground.image = true;
    ground.repeat = sweep_magnitude(w, 0.5, 300);
    sweep_floor(w, sweep_magnitude(w, 6, 300), &ground);
    const uint32_t count = sweep_count(w, 1, 3);
    for (uint32_t i = 0; i < count; i++) {
        struct sweep_paint paint = sweep_any_paint(w);
        paint.image = paint.cell == 0;
        paint.repeat = sweep_magnitude(w, 0.5, 30);
        const double radius = sweep_from(w, 0.3, 1.2);
        sweep_sphere(w, sweep_box(w, -3, 3, radius, radius, -3, 3), radius, &paint);
    }
    sweep_lights(w);
    sweep_look(w);
    w->samples = sweep_chance(w, 0.5) ? 1 : some_samples(w);
}

// Each as far away as it is large, so that all are seen.
void sweep_make_sizes(struct sweep_writer *w) {
    const uint32_t count = sweep_count(w, 2, 5);
    const bool smooth = sweep_chance(w, 0.5);
    for (uint32_t i = 0; i < count; i++) {
        const struct sweep_paint paint = sweep_any_paint(w);
        const double size = sweep_magnitude(w, 1e-6, 1e6);
        const vec3 to = vec3_unit(sweep_box(w, -0.45, 0.45, -0.3, 0.3, -1, -1));
        sweep_globe(w, vec3_mul(to, size * sweep_from(w, 4, 9)), size, 9, 14, smooth, &paint);
    }
    sweep_sun(w, sweep_box(w, -1, 1, -1, -0.2, -1, -0.3), 0.9);
    sweep_camera(w, (vec3){0, 0, 0}, (vec3){0, 0, -1}, 50);
    w->samples = sweep_chance(w, 0.5) ? 1 : some_samples(w);
}

void sweep_make_sparks(struct sweep_writer *w) {
    sweep_still_life(w);
    const uint32_t count = sweep_count(w, 3, 12);
    for (uint32_t i = 0; i < count; i++) {
        struct sweep_paint paint = sweep_chance(w, 0.4) ? sweep_mirror(w) : sweep_matt(w);
        paint.specular = sweep_magnitude(w, 0.5, 50);
        paint.exponent = sweep_magnitude(w, 30, 1e5);
        const double radius = sweep_magnitude(w, 0.03, 1);
        sweep_sphere(w, sweep_box(w, -3, 3, radius, 2, -3, 4), radius, &paint);
    }
    w->samples = some_samples(w);
}

// The whole scene, and its mesh, a millionth or a million times as large as others.
void sweep_make_scaled(struct sweep_writer *w) {
    const struct sweep_paint paint = sweep_any_paint(w);
    w->scale = sweep_chance(w, 0.5) ? 1e-6 : 1e6;
    w->offset = vec3_mul(w->offset, w->scale);
    const struct sweep_paint ground = sweep_checkered(w, 1);
    sweep_floor(w, 12, &ground);
    sweep_globe(w, (vec3){0, 1.2, 0}, 1.2, sweep_count(w, 5, 24), sweep_count(w, 5, 40), sweep_chance(w, 0.5),
                &paint);
    sweep_lights(w);
    sweep_look(w);
    w->samples = sweep_chance(w, 0.3) ? 1 : some_samples(w);
}
