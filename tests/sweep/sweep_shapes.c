// Shapes and groups of bodies that families share.
#include "core/angle.h"
#include "tests/sweep/sweep_internal.h"

static void quad(struct sweep_writer *w, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    sweep_face(w, a, b, c);
    sweep_face(w, a, c, d);
}

void sweep_box_mesh(struct sweep_writer *w, vec3 lower, vec3 upper, const struct sweep_paint *paint) {
    sweep_mesh_begin(w);
    for (int i = 0; i < 8; i++)
        sweep_vertex(w,
                     (vec3){i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z});
    quad(w, 1, 3, 4, 2);
    quad(w, 5, 6, 8, 7);
    quad(w, 1, 2, 6, 5);
    quad(w, 3, 7, 8, 4);
    quad(w, 1, 5, 7, 3);
    quad(w, 2, 4, 8, 6);
    sweep_mesh_end(w, false, paint);
}

void sweep_box_rectangles(struct sweep_writer *w, vec3 lower, vec3 upper, const struct sweep_paint *paint) {
    const vec3 size = vec3_sub(upper, lower);
    const vec3 x = {size.x, 0, 0}, y = {0, size.y, 0}, z = {0, 0, size.z};
    sweep_rectangle(w, lower, x, y, paint);
    sweep_rectangle(w, lower, y, z, paint);
    sweep_rectangle(w, lower, z, x, paint);
    sweep_rectangle(w, vec3_add(lower, z), x, y, paint);
    sweep_rectangle(w, vec3_add(lower, x), y, z, paint);
    sweep_rectangle(w, vec3_add(lower, y), z, x, paint);
}

void sweep_prism(struct sweep_writer *w, uint32_t sides, double radius, double length,
                 const struct sweep_paint *paint) {
    sweep_mesh_begin(w);
    for (uint32_t i = 0; i < sides; i++) {
        const double angle = 2 * PI * (i + 0.137) / sides;
        const double x = radius * cos(angle), y = radius * sin(angle);
        sweep_vertex(w, (vec3){x, y, 0});
        sweep_vertex(w, (vec3){x, y, length});
    }
    for (uint32_t i = 0; i < sides; i++) {
        const uint32_t a = 2 * i + 1, b = 2 * ((i + 1) % sides) + 1;
        quad(w, a, b, b + 1, a + 1);
    }
    for (uint32_t i = 1; i + 1 < sides; i++) {
        sweep_face(w, 1, 2 * i + 3, 2 * i + 1);
        sweep_face(w, 2, 2 * i + 2, 2 * i + 4);
    }
    sweep_mesh_end(w, false, paint);
}

void sweep_tetrahedron(struct sweep_writer *w, double radius, const struct sweep_paint *paint) {
    sweep_mesh_begin(w);
    for (int i = 0; i < 4; i++)
        sweep_vertex(w,
                     vec3_mul((vec3){i & 1 ? 1 : -1, i & 2 ? 1 : -1, (i & 1) ^ (i >> 1) ? -1 : 1}, radius));
    sweep_face(w, 1, 2, 3);
    sweep_face(w, 1, 4, 2);
    sweep_face(w, 1, 3, 4);
    sweep_face(w, 2, 4, 3);
    sweep_mesh_end(w, false, paint);
}

void sweep_octahedron(struct sweep_writer *w, vec3 center, double radius, const struct sweep_paint *paint) {
    static const vec3 corners[6] = {{1, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {0, -1, 0}};
    sweep_mesh_begin(w);
    for (int i = 0; i < 6; i++)
        sweep_vertex(w, vec3_add(center, vec3_mul(corners[i], radius)));
    for (uint32_t i = 0; i < 4; i++) {
        sweep_face(w, i + 1, (i + 1) % 4 + 1, 5);
        sweep_face(w, (i + 1) % 4 + 1, i + 1, 6);
    }
    sweep_mesh_end(w, false, paint);
}

void sweep_globe(struct sweep_writer *w, vec3 center, double radius, uint32_t parallels, uint32_t meridians,
                 bool smooth, const struct sweep_paint *paint) {
    sweep_mesh_begin(w);
    const uint32_t top = sweep_vertex(w, vec3_add(center, (vec3){0, radius, 0}));
    const uint32_t bottom = sweep_vertex(w, vec3_sub(center, (vec3){0, radius, 0}));
    for (uint32_t i = 1; i < parallels; i++)
        for (uint32_t k = 0; k < meridians; k++) {
            const double down = PI * i / parallels, around = 2 * PI * (k + 0.31) / meridians;
            const vec3 p = {sin(down) * cos(around), cos(down), sin(down) * sin(around)};
            sweep_vertex(w, vec3_add(center, vec3_mul(p, radius)));
        }
    for (uint32_t k = 0; k < meridians; k++) {
        const uint32_t next = (k + 1) % meridians, last = 3 + (parallels - 2) * meridians;
        sweep_face(w, top, 3 + next, 3 + k);
        sweep_face(w, bottom, last + k, last + next);
        for (uint32_t i = 0; i + 2 < parallels; i++) {
            const uint32_t row = 3 + i * meridians, below = row + meridians;
            quad(w, row + k, row + next, below + next, below + k);
        }
    }
    sweep_mesh_end(w, smooth, paint);
}

void sweep_gem(struct sweep_writer *w, vec3 center, double radius, uint32_t sides,
               const struct sweep_paint *paint) {
    sweep_mesh_begin(w);
    for (uint32_t i = 0; i < sides; i++) {
        const double angle = 2 * PI * i / sides + 0.1, half = PI / sides;
        const vec3 girdle = {cos(angle), 0, sin(angle)};
        const vec3 table = {0.55 * cos(angle + half), 0.35, 0.55 * sin(angle + half)};
        sweep_vertex(w, vec3_add(center, vec3_mul(girdle, radius)));
        sweep_vertex(w, vec3_add(center, vec3_mul(table, radius)));
    }
    const uint32_t tip = sweep_vertex(w, vec3_add(center, (vec3){0, -0.85 * radius, 0}));
    for (uint32_t i = 0; i < sides; i++) {
        const uint32_t a = 2 * i + 1, b = 2 * ((i + 1) % sides) + 1;
        sweep_face(w, a, b, tip);
        sweep_face(w, a, a + 1, b);
        sweep_face(w, a + 1, b + 1, b);
        if (i > 0 && i + 1 < sides)
            sweep_face(w, 2, b + 1, a + 1);
    }
    sweep_mesh_end(w, false, paint);
}

void sweep_hills(struct sweep_writer *w, double extent, double height, uint32_t cells, bool smooth,
                 const struct sweep_paint *paint) {
    const double a = sweep_from(w, 1, 3), b = sweep_from(w, 3, 9), rough = sweep_from(w, 0, 0.1);
    sweep_mesh_begin(w);
    for (uint32_t i = 0; i <= cells; i++)
        for (uint32_t k = 0; k <= cells; k++) {
            const double x = 2.0 * i / cells - 1, z = 2.0 * k / cells - 1;
            const double y = 0.6 * sin(a * x + 1) * cos(a * z) + 0.3 * sin(b * z) * cos(b * x) +
                             rough * sweep_from(w, -1, 1);
            sweep_vertex(w, (vec3){extent * x, height * y, extent * z});
        }
    for (uint32_t i = 0; i < cells; i++)
        for (uint32_t k = 0; k < cells; k++) {
            const uint32_t at = i * (cells + 1) + k + 1;
            quad(w, at, at + 1, at + cells + 2, at + cells + 1);
        }
    sweep_mesh_end(w, smooth, paint);
}

// ---- groups

void sweep_floor(struct sweep_writer *w, double extent, const struct sweep_paint *paint) {
    sweep_rectangle(w, (vec3){-extent, 0, extent}, (vec3){2 * extent, 0, 0}, (vec3){0, 0, -2 * extent},
                    paint);
}

static void one_body(struct sweep_writer *w, double reach) {
    const struct sweep_paint paint = sweep_any_paint(w);
    const double size = sweep_from(w, 0.3, 1.1);
    vec3 at = sweep_inside(w, (vec3){-reach, 0, -reach}, (vec3){reach, 0, reach});
    at.y = 1.05 * size;
    switch (sweep_count(w, 0, 5)) {
    case 0:
        sweep_octahedron(w, at, size, &paint);
        break;
    case 1:
        sweep_globe(w, at, size, 8, 13, sweep_chance(w, 0.5), &paint);
        break;
    case 2:
        sweep_box_mesh(w, vec3_sub(at, vec3_mul((vec3){1, 1, 1}, 0.6 * size)),
                       vec3_add(at, (vec3){0.5 * size, 0.8 * size, 0.7 * size}), &paint);
        break;
    default:
        sweep_sphere(w, at, size, &paint);
    }
}

void sweep_bodies(struct sweep_writer *w, uint32_t count, double reach) {
    for (uint32_t i = 0; i < count; i++)
        one_body(w, reach);
}

void sweep_lights(struct sweep_writer *w) {
    const uint32_t count = sweep_count(w, 1, 3);
    for (uint32_t i = 0; i < count; i++)
        sweep_light(w, sweep_inside(w, (vec3){-9, 5, -9}, (vec3){9, 14, 12}), 1.2 / count);
    if (sweep_chance(w, 0.4))
        sweep_sun(w, sweep_box(w, -1, 1, -1.3, -1.3, -1, 1), 0.4);
}

void sweep_look(struct sweep_writer *w) {
    const vec3 from = sweep_box(w, -5, 5, 1, 5, 6, 12);
    const vec3 at = sweep_inside(w, (vec3){-0.5, 0.3, -0.5}, (vec3){0.5, 1.1, 0.5});
    sweep_camera(w, from, at, sweep_from(w, 25, 60));
}

void sweep_still_life(struct sweep_writer *w) {
    const struct sweep_paint ground = sweep_chance(w, 0.5) ? sweep_checkered(w, 1) : sweep_matt(w);
    sweep_floor(w, 12, &ground);
    sweep_bodies(w, sweep_count(w, 2, 6), 3);
    sweep_lights(w);
    sweep_look(w);
}
