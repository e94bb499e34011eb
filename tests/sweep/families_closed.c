// Closed rooms, seen from inside: whatever shows the background has slipped through an edge.
#include "tests/sweep/sweep_internal.h"

// How bright a light outside is: what of it comes through a wall shows as the background does.
static const double OUTSIDE = 1e6;

// Along z from 0 to the length, seen from near its beginning.
static void look_along(struct sweep_writer *w, double reach, double length) {
    const double r = 0.7 * reach, z = fmin(0.2 * length, sweep_magnitude(w, 0.1, 10) * reach);
    const vec3 from = sweep_box(w, -r, r, -r, r, z, z);
    const double most = sweep_chance(w, 0.5) ? 0.02 : 0.6;
    const vec3 aside = vec3_mul(sweep_direction(w), most);
    sweep_camera(w, from, vec3_add(from, vec3_add((vec3){0, 0, 1}, aside)), sweep_from(w, 30, 100));
}

static void light_along(struct sweep_writer *w, double reach, double length) {
    const uint32_t count = sweep_count(w, 1, 4);
    const double r = 0.8 * reach;
    for (uint32_t i = 0; i < count; i++) {
        const double z = fmin(0.9 * length, sweep_magnitude(w, 0.5, 100) * reach);
        sweep_light(w, sweep_box(w, -r, r, -r, r, z, z), 1.5 / count);
    }
}

static void make_corridor(struct sweep_writer *w, bool is_mesh) {
    const double x = sweep_from(w, 0.5, 3), y = sweep_from(w, 0.5, 3);
    const double length = sweep_magnitude(w, 10, 1e6) * fmin(x, y);
    const struct sweep_paint paint = sweep_chance(w, 0.2) ? sweep_mirror(w) : sweep_matt(w);
    const vec3 lower = {-x, -y, 0}, upper = {x, y, length};
    sweep_close(w);
    if (is_mesh)
        sweep_box_mesh(w, lower, upper, &paint);
    else
        sweep_box_rectangles(w, lower, upper, &paint);
    look_along(w, fmin(x, y), length);
    light_along(w, fmin(x, y), length);
}

void sweep_make_corridor(struct sweep_writer *w) {
    make_corridor(w, false);
}

void sweep_make_shaft(struct sweep_writer *w) {
    make_corridor(w, true);
}

void sweep_make_pipe(struct sweep_writer *w) {
    const uint32_t sides = (uint32_t)sweep_magnitude(w, 3, 257);
    const double radius = sweep_from(w, 0.5, 2), length = sweep_magnitude(w, 10, 1e5) * radius;
    const struct sweep_paint paint = sweep_chance(w, 0.2) ? sweep_mirror(w) : sweep_matt(w);
    sweep_close(w);
    sweep_prism(w, sides, radius, length, &paint);
    look_along(w, 0.4 * radius, length);
    light_along(w, 0.4 * radius, length);
}

// A closed shape about 0 in which a ball of radius 0.5 fits.
static void any_room(struct sweep_writer *w, const struct sweep_paint *paint) {
    const vec3 upper = sweep_box(w, 1, 4, 1, 3, 1, 4);
    uint32_t parallels;
    switch (sweep_count(w, 0, 5)) {
    case 0:
        sweep_tetrahedron(w, 2, paint);
        break;
    case 1:
        sweep_octahedron(w, (vec3){0, 0, 0}, 2, paint);
        break;
    case 2:
        parallels = sweep_count(w, 3, 14);
        sweep_globe(w, (vec3){0, 0, 0}, 2, parallels, sweep_count(w, 3, 21), false, paint);
        break;
    case 3:
        sweep_gem(w, (vec3){0, 0.2, 0}, 2.5, sweep_count(w, 4, 12), paint);
        break;
    case 4:
        sweep_box_mesh(w, vec3_neg(upper), upper, paint);
        break;
    default:
        sweep_box_rectangles(w, vec3_neg(upper), upper, paint);
    }
}

static void look_around(struct sweep_writer *w) {
    const vec3 from = sweep_around(w, 0, 0.5), at = vec3_add(from, sweep_direction(w));
    sweep_camera(w, from, at, sweep_from(w, 40, 110));
}

static void any_size(struct sweep_writer *w) {
    w->scale = sweep_chance(w, 0.5) ? sweep_magnitude(w, 1e-6, 1e6) : 1;
}

void sweep_make_dark_room(struct sweep_writer *w) {
    const struct sweep_paint paint = sweep_matt(w);
    any_size(w);
    sweep_close(w);
    any_room(w, &paint);
    look_around(w);
    const uint32_t count = sweep_count(w, 1, 4);
    for (uint32_t i = 0; i < count; i++)
        sweep_light(w, sweep_around(w, 10, 100), OUTSIDE);
}

void sweep_make_mirror_room(struct sweep_writer *w) {
    struct sweep_paint paint = sweep_mirror(w);
    paint.diffuse = 0.05;
    paint.reflection = sweep_from(w, 0.8, 1);
    any_size(w);
    sweep_close(w);
    w->depth = sweep_count(w, 4, 24);
    any_room(w, &paint);
    look_around(w);
    if (sweep_chance(w, 0.5))
        sweep_light(w, vec3_mul(sweep_direction(w), 0.4), 1);
    else
        sweep_light(w, vec3_mul(sweep_direction(w), 30), OUTSIDE);
}

void sweep_make_full_room(struct sweep_writer *w) {
    const vec3 upper = sweep_inside(w, (vec3){3, 2, 3}, (vec3){6, 4, 6});
    const struct sweep_paint walls = sweep_matt(w);
    sweep_close(w);
    if (sweep_chance(w, 0.5))
        sweep_box_mesh(w, vec3_neg(upper), upper, &walls);
    else
        sweep_box_rectangles(w, vec3_neg(upper), upper, &walls);
    const uint32_t count = sweep_count(w, 1, 4);
    for (uint32_t i = 0; i < count; i++) {
        const struct sweep_paint paint =
            sweep_chance(w, 0.5) ? sweep_mirror(w) : sweep_glass(w, sweep_from(w, 1.1, 2.4));
        const double radius = sweep_from(w, 0.2, 0.7);
        const vec3 room = vec3_sub(upper, (vec3){radius, radius, radius});
        sweep_sphere(w, sweep_inside(w, vec3_neg(room), (vec3){room.x, room.y, 0}), radius, &paint);
    }
    w->depth = sweep_count(w, 3, 8);
    sweep_camera(w, (vec3){0.1, 0.2, 0.9 * upper.z}, (vec3){0, -0.2, 0}, sweep_from(w, 50, 90));
    sweep_light(w, vec3_mul(upper, 0.8), 0.7);
    sweep_light(w, (vec3){-0.7 * upper.x, 0.8 * upper.y, 0.1}, 0.5);
}
