// Glass and mirrors: what bends a ray several times magnifies each error.
#include "tests/sweep/sweep_internal.h"

static void any_target(struct sweep_writer *w, double far) {
    const struct sweep_paint paint = sweep_checkered(w, far * sweep_magnitude(w, 1e-3, 0.3));
    sweep_rectangle(w, (vec3){-4 * far, -4 * far, -far}, (vec3){8 * far, 0, 0}, (vec3){0, 8 * far, 0.1 * far},
                    &paint);
    sweep_sun(w, (vec3){0.2, -0.4, -1}, 1);
}

void sweep_make_magnifier(struct sweep_writer *w) {
    const double far = sweep_magnitude(w, 3, 3e4);
    any_target(w, far);
    const double index = sweep_from(w, 1.2, 2.4);
    const struct sweep_paint glass = sweep_glass(w, index);
    sweep_sphere(w, (vec3){0.05, 0.03, 0}, 1, &glass);
    // A ball's focus is at index / (2 (index - 1)) of its radius.
    const double focus = index / (2 * (index - 1));
    const double away = fmax(1.05, focus * sweep_from(w, 0.8, 1.5));
    sweep_camera(w, (vec3){0, 0, away}, (vec3){0.02, 0.05, 0}, sweep_from(w, 20, 80));
    w->depth = sweep_count(w, 3, 8);
}

void sweep_make_concave(struct sweep_writer *w) {
    const struct sweep_paint mirror = sweep_mirror(w);
    const double far = sweep_magnitude(w, 2, 1e4);
    const double radius = sweep_magnitude(w, 1, 100);
    sweep_sphere(w, (vec3){0, 0, -radius}, radius, &mirror);
    const struct sweep_paint ground = sweep_checkered(w, sweep_magnitude(w, 0.01, 10));
    sweep_rectangle(w, (vec3){-4 * far, -1.5, -4 * far}, (vec3){8 * far, 0, 0}, (vec3){0, 0, 8 * far},
                    &ground);
    for (int i = 0; i < 3; i++) {
        const struct sweep_paint paint = sweep_any_paint(w);
        const vec3 at = sweep_box(w, -far, far, 0, 1, 0.5 * far, far);
        sweep_sphere(w, at, sweep_magnitude(w, 0.1, 1) * far * 0.3, &paint);
    }
    const vec3 from = sweep_box(w, -0.5, 0.5, 0, 0.6, 1.5, 1.5);
    sweep_camera(w, from, (vec3){0, 0, 0}, sweep_from(w, 20, 60));
    sweep_sun(w, (vec3){0.4, -1, -0.7}, 1);
}

void sweep_make_ball_chain(struct sweep_writer *w) {
    const uint32_t count = sweep_count(w, 2, 6);
    double z = 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct sweep_paint paint =
            sweep_chance(w, 0.8) ? sweep_glass(w, sweep_from(w, 1.1, 2.4)) : sweep_mirror(w);
        const double radius = sweep_from(w, 0.5, 1.5);
        z -= radius * 1.1;
        sweep_sphere(w, sweep_box(w, -0.5, 0.5, -0.4, 0.4, z, z), radius, &paint);
        z -= radius * 1.1;
    }
    any_target(w, -z + 5);
    const vec3 from = sweep_box(w, 0.2, 0.2, 0.1, 0.1, 1, 5);
    sweep_camera(w, from, (vec3){0, 0, -1}, sweep_from(w, 20, 60));
    sweep_light(w, (vec3){3, 4, 5}, 0.7);
    w->depth = sweep_count(w, 4, 12);
}

void sweep_make_mirror_balls(struct sweep_writer *w) {
    const uint32_t count = sweep_count(w, 2, 9);
    for (uint32_t i = 0; i < count; i++) {
        const struct sweep_paint paint = sweep_mirror(w);
        const vec3 at = sweep_inside(w, (vec3){-2.5, 0.2, -2.5}, (vec3){2.5, 2.5, 2.5});
        sweep_sphere(w, at, sweep_from(w, 0.3, 1), &paint);
    }
    const struct sweep_paint ground = sweep_checkered(w, sweep_magnitude(w, 0.1, 2));
    sweep_floor(w, 20, &ground);
    sweep_lights(w);
    sweep_look(w);
    w->depth = sweep_count(w, 2, 10);
}

void sweep_make_nested_glass(struct sweep_writer *w) {
    const uint32_t count = sweep_count(w, 2, 7);
    double radius = 1.5;
    for (uint32_t i = 0; i < count && radius > 1e-3; i++) {
        const struct sweep_paint glass = sweep_glass(w, sweep_from(w, 1, 1.7));
        sweep_sphere(w, (vec3){0, 1.6, 0}, radius, &glass);
        radius *= 1 - sweep_magnitude(w, 1e-6, 0.5);
    }
    const struct sweep_paint ground = sweep_checkered(w, 0.7);
    sweep_floor(w, 15, &ground);
    sweep_lights(w);
    sweep_look(w);
    w->depth = sweep_count(w, 4, 14);
}

void sweep_make_panes(struct sweep_writer *w) {
    const uint32_t count = sweep_count(w, 2, 6);
    for (uint32_t i = 0; i < count; i++) {
        const struct sweep_paint glass = sweep_glass(w, sweep_from(w, 1.1, 1.9));
        const double z = 1.5 - 0.6 * i, lean = sweep_from(w, -0.2, 0.2);
        if (sweep_chance(w, 0.5))
            sweep_rectangle(w, (vec3){-2, 0.01, z}, (vec3){4, 0, lean}, (vec3){0, 3, lean}, &glass);
        else if (w->scene->mesh_count + 1 < SWEEP_MESHES)
            sweep_box_mesh(w, (vec3){-2, 0.02, z}, (vec3){2, 3, z + sweep_magnitude(w, 1e-5, 0.3)}, &glass);
    }
    const struct sweep_paint ground = sweep_checkered(w, 1), behind = sweep_matt(w);
    sweep_floor(w, 15, &ground);
    sweep_sphere(w, (vec3){0, 1, -3.5}, 1, &behind);
    sweep_lights(w);
    sweep_look(w);
    w->depth = sweep_count(w, 4, 14);
}

void sweep_make_gem(struct sweep_writer *w) {
    const struct sweep_paint ground = sweep_checkered(w, sweep_magnitude(w, 0.1, 2));
    struct sweep_paint glass = sweep_glass(w, sweep_from(w, 1.3, 2.6));
    glass.reflection = 0.1;
    sweep_gem(w, (vec3){0, 1.6, 0}, 1.5, sweep_count(w, 4, 24), &glass);
    sweep_floor(w, 15, &ground);
    sweep_lights(w);
    sweep_look(w);
    w->depth = sweep_count(w, 3, 8);
}

void sweep_make_index(struct sweep_writer *w) {
    const struct sweep_paint ground = sweep_checkered(w, 0.6);
    sweep_floor(w, 15, &ground);
    for (int i = 0; i < 3; i++) {
        const double index = sweep_chance(w, 0.5)   ? 1 + sweep_magnitude(w, 1e-9, 0.1)
                             : sweep_chance(w, 0.5) ? 1 - sweep_magnitude(w, 1e-9, 0.5)
                                                    : sweep_magnitude(w, 0.1, 10);
        const struct sweep_paint glass = sweep_glass(w, index);
        const vec3 at = {2.1 * (i - 1), 1.1, sweep_from(w, -1, 1)};
        if (sweep_chance(w, 0.3))
            sweep_octahedron(w, at, 1, &glass);
        else
            sweep_sphere(w, at, 1, &glass);
    }
    sweep_lights(w);
    sweep_look(w);
    w->depth = sweep_count(w, 3, 9);
}
