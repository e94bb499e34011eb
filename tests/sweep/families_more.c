// What magnifies, repeats, stretches and touches.
#include "core/angle.h"
#include "tests/sweep/sweep_internal.h"

void sweep_make_blinds(struct sweep_writer *w) {
    const uint32_t count = sweep_count(w, 20, 80);
    const double step = sweep_magnitude(w, 1e-3, 0.3), wide = step * sweep_from(w, 0.2, 1.5);
    const struct sweep_paint paint = sweep_matt(w), behind = sweep_matt(w);
    const double lean = sweep_from(w, -1.2, 1.2);
    for (uint32_t i = 0; i < count; i++)
        sweep_rectangle(w, (vec3){-2, i * step, 0}, (vec3){4, 0, 0},
                        (vec3){0, wide * sin(lean), wide * cos(lean)}, &paint);
    sweep_rectangle(w, (vec3){-5, -2, -2}, (vec3){10, 0, 0}, (vec3){0, 2 * step * count + 4, 0}, &behind);
    const double middle = 0.5 * step * count, away = fmax(2, 3 * middle);
    const vec3 from = sweep_box(w, -away, away, -middle, 3 * middle, away, 2 * away);
    sweep_camera(w, from, (vec3){0, middle, 0}, sweep_from(w, 20, 50));
    sweep_light(w, (vec3){3, 3 + 2 * middle, 8}, 1);
}

void sweep_make_long_shadow(struct sweep_writer *w) {
    const struct sweep_paint ground = sweep_matt(w), wall = sweep_matt(w);
    const double near = sweep_magnitude(w, 1e-5, 0.3), far = sweep_magnitude(w, 3, 300);
    sweep_floor(w, far, &ground);
    sweep_rectangle(w, (vec3){-far, 0, -far}, (vec3){2 * far, 0, 0}, (vec3){0, far, 0}, &wall);
    const struct sweep_paint paint = sweep_matt(w);
    const vec3 at = {0, 1, 0};
    if (sweep_chance(w, 0.5))
        sweep_octahedron(w, at, 0.5 * near, &paint);
    else
        sweep_globe(w, at, 0.5 * near, 7, 9, false, &paint);
    sweep_light(w, vec3_add(at, vec3_mul(sweep_direction(w), near)), 1);
    const vec3 from = sweep_box(w, -0.5 * far, 0.5 * far, 0.2 * far, 0.5 * far, 0.5 * far, far);
    sweep_camera(w, from, (vec3){0, 0.2 * far, -far}, sweep_from(w, 40, 70));
}

void sweep_make_mirror_hall(struct sweep_writer *w) {
    struct sweep_paint mirror = sweep_mirror(w);
    mirror.diffuse = 0.02;
    mirror.reflection = sweep_from(w, 0.8, 0.99);
    const double tilt = sweep_magnitude(w, 1e-6, 0.1), wide = sweep_from(w, 3, 30);
    sweep_rectangle(w, (vec3){-wide, -wide, -2}, (vec3){2 * wide, 0, tilt}, (vec3){0, 2 * wide, 0}, &mirror);
    sweep_rectangle(w, (vec3){-wide, -wide, 2}, (vec3){2 * wide, 0, 0}, (vec3){0, 2 * wide, tilt}, &mirror);
    const uint32_t count = sweep_count(w, 1, 3);
    for (uint32_t i = 0; i < count; i++) {
        const struct sweep_paint paint = sweep_checkered(w, sweep_from(w, 0.05, 0.3));
        const vec3 at = sweep_box(w, -1, 1, -1, 1, -1.4, 0.5);
        sweep_sphere(w, at, sweep_from(w, 0.1, 0.5), &paint);
    }
    const vec3 from = sweep_box(w, -1, 1, -0.5, 0.5, 1.2, 1.8);
    sweep_camera(w, from, sweep_box(w, -1, 1, -0.5, 0.5, -2, -2), sweep_from(w, 30, 70));
    sweep_light(w, (vec3){0.3, 2.5, 0.4}, 1);
    w->depth = sweep_count(w, 5, 40);
}

void sweep_make_kaleidoscope(struct sweep_writer *w) {
    struct sweep_paint mirror = sweep_mirror(w);
    mirror.diffuse = 0.02;
    mirror.reflection = sweep_from(w, 0.8, 0.98);
    const uint32_t sides = sweep_count(w, 3, 6);
    const double length = sweep_magnitude(w, 3, 100);
    for (uint32_t i = 0; i < sides; i++) {
        const double a = 2 * PI * (i + 0.2) / sides, b = 2 * PI * (i + 1.2) / sides;
        const vec3 from = {cos(a), sin(a), 0}, to = {cos(b), sin(b), 0};
        sweep_rectangle(w, from, vec3_sub(to, from), (vec3){0, 0, -length}, &mirror);
    }
    const struct sweep_paint end = sweep_checkered(w, sweep_from(w, 0.1, 0.6));
    sweep_rectangle(w, (vec3){-3, -3, -length - 1}, (vec3){6, 0.2, 0}, (vec3){-0.3, 6, 0}, &end);
    const vec3 from = sweep_box(w, -0.2, 0.2, -0.2, 0.2, -1, -0.1),
               at = sweep_box(w, -0.3, 0.3, -0.3, 0.3, -2, -2);
    sweep_camera(w, from, at, sweep_from(w, 30, 80));
    sweep_light(w, (vec3){0.5, 0.7, -length + 1}, 1);
    w->depth = sweep_count(w, 5, 40);
}

void sweep_make_ball_field(struct sweep_writer *w) {
    const double step = sweep_magnitude(w, 1, 30), part = sweep_magnitude(w, 0.01, 0.5);
    const struct sweep_paint ground = sweep_checkered(w, step);
    sweep_floor(w, 20 * step, &ground);
    const struct sweep_paint paints[2] = {sweep_any_paint(w), sweep_matt(w)};
    for (int i = 0; i < 120; i++) {
        const vec3 at = {step * (i % 10 - 4.7), part * step, step * (2 - i / 10)};
        sweep_sphere(w, vec3_add(at, (vec3){0, sweep_magnitude(w, 1e-4, 1) * step, 0}), part * step,
                     &paints[i % 2]);
    }
    sweep_camera(w, (vec3){0.3, sweep_magnitude(w, 0.1, 2) * step, 3.5 * step}, (vec3){0, 0, -3 * step},
                 sweep_from(w, 20, 70));
    sweep_sun(w, sweep_box(w, -1, 1, -1, -1, -1, 1), 1);
}

void sweep_make_wide(struct sweep_writer *w) {
    const struct sweep_paint ground = sweep_checkered(w, 1);
    sweep_floor(w, 12, &ground);
    sweep_bodies(w, sweep_count(w, 2, 6), 3);
    sweep_lights(w);
    const vec3 from = sweep_box(w, -3, 3, 1, 4, 3, 5);
    sweep_camera(w, from, (vec3){0, 0.5, 0}, 180 - sweep_magnitude(w, 1e-3, 60));
}

void sweep_make_inside_glass(struct sweep_writer *w) {
    const struct sweep_paint glass = sweep_glass(w, sweep_from(w, 1.05, 2.2));
    const vec3 from = {0, 1.5, 5};
    const double size = sweep_magnitude(w, 0.01, 3);
    const vec3 aside = vec3_mul(sweep_direction(w), 0.5 * size);
    if (sweep_chance(w, 0.5))
        sweep_sphere(w, vec3_add(from, aside), size, &glass);
    else
        sweep_octahedron(w, vec3_add(from, vec3_mul(aside, 0.5)), size, &glass);
    const struct sweep_paint ground = sweep_checkered(w, 0.8);
    sweep_floor(w, 12, &ground);
    sweep_bodies(w, sweep_count(w, 1, 4), 2);
    sweep_lights(w);
    sweep_camera(w, from, (vec3){0, 0.8, 0}, sweep_from(w, 30, 90));
    w->depth = sweep_count(w, 3, 8);
}

void sweep_make_stretched(struct sweep_writer *w) {
    const uint32_t count = sweep_count(w, 1, 4);
    const struct sweep_paint ground = sweep_matt(w);
    sweep_floor(w, 12, &ground);
    for (uint32_t i = 0; i < count; i++) {
        const struct sweep_paint paint = sweep_any_paint(w);
        const double thin = sweep_magnitude(w, 1e-5, 0.1), z = 1.0 * i - 2;
        const vec3 size = sweep_chance(w, 0.5) ? (vec3){3, thin, thin} : (vec3){3, 1.5, thin};
        sweep_box_mesh(w, (vec3){-size.x, 0.1, z}, (vec3){size.x, 0.1 + size.y, z + size.z}, &paint);
    }
    sweep_lights(w);
    sweep_look(w);
}

void sweep_make_touching(struct sweep_writer *w) {
    const struct sweep_paint ground = sweep_matt(w), below = sweep_any_paint(w);
    sweep_floor(w, 12, &ground);
    sweep_sphere(w, (vec3){-1.1, 1, 0}, 1, &below);
    const struct sweep_paint above = sweep_any_paint(w), beside = sweep_any_paint(w);
    sweep_sphere(w, (vec3){-1.1, 2.5, 0}, 0.5, &above);
    sweep_sphere(w, (vec3){0.9, 1, 0}, 1, &beside);
    const struct sweep_paint box = sweep_any_paint(w);
    sweep_box_mesh(w, (vec3){1.9, 0, -0.5}, (vec3){2.9, 1, 0.5}, &box);
    sweep_box_mesh(w, (vec3){2.1, 1, -0.3}, (vec3){2.7, 1.6, 0.3}, &above);
    sweep_lights(w);
    sweep_look(w);
}

static void cone(struct sweep_writer *w, vec3 at, double radius, double height) {
    const struct sweep_paint paint = sweep_any_paint(w);
    const uint32_t sides = sweep_count(w, 3, 24);
    sweep_mesh_begin(w);
    const uint32_t tip = sweep_vertex(w, vec3_add(at, (vec3){0.1 * radius, height, 0}));
    for (uint32_t i = 0; i < sides; i++) {
        const double angle = 2 * PI * i / sides + 0.4;
        sweep_vertex(w, vec3_add(at, (vec3){radius * cos(angle), 0, radius * sin(angle)}));
    }
    for (uint32_t i = 0; i < sides; i++)
        sweep_face(w, tip, (i + 1) % sides + 2, i + 2);
    for (uint32_t i = 1; i + 1 < sides; i++)
        sweep_face(w, 2, i + 2, i + 3);
    sweep_mesh_end(w, sweep_chance(w, 0.3), &paint);
}

void sweep_make_needles(struct sweep_writer *w) {
    const struct sweep_paint ground = sweep_matt(w);
    sweep_floor(w, 12, &ground);
    const uint32_t count = sweep_count(w, 2, 6);
    const double height = sweep_magnitude(w, 1, 1000);
    for (uint32_t i = 0; i < count; i++) {
        const vec3 at = sweep_box(w, -3, 3, 0.02, 0.02, -3, 2);
        cone(w, at, height * sweep_magnitude(w, 1e-5, 0.3), height);
    }
    const vec3 from = sweep_box(w, -3, 3, 0.5, 5, 6, 9);
    sweep_camera(w, from, (vec3){0, sweep_from(w, 0.5, 5), 0}, sweep_from(w, 30, 70));
    sweep_lights(w);
}
