#include "shape_kit.h"

#include "random.h"
#include "scene/transform.h"

#include <math.h>
#include <string.h>

static const vec3 LONG_ROTATION = {13, 29, 41};

void shape_init(struct kit *kit, struct shape *shape, const vec3 *corners, uint32_t corner_count,
                uint32_t most_faces) {
    *shape = (struct shape){.corners = ARENA_ARRAY(&kit->arena, vec3, corner_count),
                            .faces = arena_alloc_array(&kit->arena, most_faces, sizeof *shape->faces),
                            .corner_count = corner_count};
    memcpy(shape->corners, corners, corner_count * sizeof *corners);
}

void shape_add(struct shape *s, uint32_t a, uint32_t b, uint32_t c) {
    const vec3 p = s->corners[a], q = s->corners[b], r = s->corners[c];
    const bool out = vec3_dot(vec3_cross(vec3_sub(q, p), vec3_sub(r, p)), vec3_add(p, vec3_add(q, r))) > 0;
    const uint32_t face[3] = {a, out ? b : c, out ? c : b};
    memcpy(s->faces[s->face_count++], face, sizeof face);
}

void shape_add_quad(struct shape *shape, const uint32_t corners[4]) {
    shape_add(shape, corners[0], corners[1], corners[2]);
    shape_add(shape, corners[0], corners[2], corners[3]);
}

void shape_box(struct kit *kit, struct shape *shape, vec3 half) {
    static const uint32_t sides[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    vec3 corners[8];
    for (int i = 0; i < 8; i++)
        corners[i] = (vec3){i & 4 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 1 ? half.z : -half.z};
    shape_init(kit, shape, corners, 8, 12);
    for (int i = 0; i < 6; i++)
        shape_add_quad(shape, sides[i]);
}

void shape_drum(struct kit *kit, struct shape *shape, const struct drum *drum) {
    const uint32_t n = drum->sides;
    vec3 *corners = ARENA_ARRAY(&kit->arena, vec3, 2 * n);
    for (uint32_t i = 0; i < 2 * n; i++) {
        const double angle = 6.283185307179586 * (i % n) / n + 0.1, radius = drum->radius[i / n];
        corners[i] = (vec3){radius * cos(angle), drum->height[i / n], radius * sin(angle)};
    }
    shape_init(kit, shape, corners, 2 * n, 4 * n);
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t j = (i + 1) % n;
        shape_add_quad(shape, (uint32_t[4]){i, j, n + j, n + i});
    }
    for (uint32_t i = 1; i + 1 < n; i++) {
        shape_add(shape, 0, i, i + 1);
        shape_add(shape, n, n + i, n + i + 1);
    }
}

struct mesh *shape_mesh(struct kit *kit, const struct shape *shape) {
    return kit_mesh(kit, shape->corners, shape->corner_count, (const uint32_t(*)[3])shape->faces,
                    shape->face_count, true);
}

// ---- long bodies

static vec3 turned(vec3 v) {
    return mat3_apply(mat3_rotation(LONG_ROTATION), v);
}

// Across y, from below the camera to above it; the camera is at 0.
static void make_rails(struct kit *kit, double length) {
    for (int i = -1; i <= 1; i += 2) {
        struct ir_rectangle *rail = kit_rectangle(kit);
        rail->corner = turned((vec3){0.7 * i - LONG_RAIL_WIDTH / 2, 3, -1.6});
        rail->edge_u = turned((vec3){LONG_RAIL_WIDTH, 0, 0});
        rail->edge_v = turned((vec3){0, length, 0});
    }
}

void long_make(struct kit *kit, const struct long_body *body) {
    const double half = 0.5 * body->length;
    struct shape shape;
    kit->origin = (vec3){0, 0, 0};
    if (body->sides == 0) {
        make_rails(kit, body->length);
        return;
    }
    if (body->sides == 4)
        shape_box(kit, &shape, (vec3){1, half, 1});
    else
        shape_drum(kit, &shape, &(struct drum){body->sides, {1, 1}, {-half, half}});
    kit_model(kit, shape_mesh(kit, &shape))->rotation = LONG_ROTATION;
}

void long_ray(const struct long_body *body, uint64_t seed, vec3 *start, vec3 *direction) {
    if (body->sides == 0) {
        const double side = random_bits(&seed) % 2 ? 0.7 : -0.7;
        const double across = LONG_RAIL_WIDTH * 0.25 * (2 * random_unit(&seed) - 1);
        // At every magnitude of the distance.
        const double along = 3 + 0.98 * pow(body->length, random_unit(&seed));
        *start = (vec3){0, 0, 0};
        *direction = turned((vec3){side + across, along, -1.6});
        return;
    }
    // Half of them nearly along the body, at angles of every magnitude down to its own.
    const vec3 within = vec3_mul(random_direction(&seed), 0.5);
    *start = turned((vec3){within.x, body->length * 0.49 * (2 * random_unit(&seed) - 1), within.z});
    vec3 aim = random_direction(&seed);
    if (random_bits(&seed) % 2) {
        const double narrow = pow(body->length, -random_unit(&seed));
        aim = vec3_unit((vec3){aim.x * narrow, aim.y < 0 ? -1 : 1, aim.z * narrow});
    }
    *direction = turned(aim);
}
