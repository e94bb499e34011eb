// Bodies that assets/made builds, as meshes, with what can be measured of them.
#ifndef GLINT_TESTS_UNIT_MADE_KIT_H
#define GLINT_TESTS_UNIT_MADE_KIT_H

#include "assets/made/made.h"
#include "assets/mesh_build.h"
#include "random.h"

#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

struct made_kit {
    struct arena arena; // emptied by each build
    struct mesh mesh;   // of the last build
    struct made made;
};

static inline struct made_to made_kit_to(struct made_kit *kit) {
    arena_finish(&kit->arena);
    arena_finish(&kit->mesh.arena);
    kit->mesh = (struct mesh){0};
    arena_init(&kit->arena, SIZE_MAX / 4);
    arena_init(&kit->mesh.arena, SIZE_MAX / 4);
    return (struct made_to){&kit->arena, UINT32_MAX};
}

static inline void made_kit_finish(struct made_kit *kit) {
    arena_finish(&kit->arena);
    arena_finish(&kit->mesh.arena);
}

static inline void made_kit_check_lists(const struct made *made) {
    const struct polygons *p = &made->polygons;
    assert_int_equal(p->triangle_count, made->triangle_count);
    assert_true(p->corners.count == p->corners.capacity && p->faces.count == p->faces.capacity);
    for (uint32_t i = 0; i < p->vertices.count; i++) {
        const vec3 v = p->vertices.items[i];
        assert_true(isfinite(v.x) && isfinite(v.y) && isfinite(v.z));
        assert_false((v.x == 0 && signbit(v.x)) || (v.y == 0 && signbit(v.y)) || (v.z == 0 && signbit(v.z)));
    }
    for (uint32_t i = 0; i < p->normals.count; i++)
        assert_true(fabs(vec3_length(p->normals.items[i]) - 1) < 1e-12);
    for (uint32_t i = 0; i < p->corners.count; i++)
        assert_true(p->corners.items[i].vertex < p->vertices.count);
    assert_int_equal(made->textured.corners.count, p->corners.count);
    assert_int_equal(made->textured.faces.count, p->faces.count);
    for (uint32_t i = 0; i < made->textured.corners.count; i++) {
        const uint32_t coordinate = made->textured.corners.items[i].coordinate;
        assert_true(coordinate == IR_NO_INDEX || coordinate < made->textured.coordinates.count);
        assert_int_equal(made->textured.corners.items[i].vertex, p->corners.items[i].vertex);
    }
}

// The mesh of what was built.
static inline void made_kit_mesh(struct made_kit *kit, bool done) {
    if (!done)
        fail_msg("refused: %s", kit->made.fault.text);
    made_kit_check_lists(&kit->made);
    const uint64_t triangles = kit->made.triangle_count;
    mesh_build(&kit->made.polygons, STR("made"), &kit->arena, &kit->mesh);
    assert_int_equal(kit->mesh.triangle_count, triangles);
    assert_int_equal(kit->mesh.losses[MESH_LOSS_BENT].count, 0);
}

static inline void made_kit_closed(struct made_kit *kit, bool done) {
    made_kit_mesh(kit, done);
    if (!kit->mesh.closed || kit->mesh.turned)
        fail_msg("closed %d, turned %d, %u open edges of %u triangles", kit->mesh.closed, kit->mesh.turned,
                 kit->mesh.open_edges, kit->mesh.triangle_count);
}

static inline bool made_kit_lathe(struct made_kit *kit, struct made_lathe lathe) {
    const struct made_to to = made_kit_to(kit);
    return made_build_lathe(&lathe, &to, &kit->made);
}
static inline bool made_kit_torus(struct made_kit *kit, struct made_torus torus) {
    const struct made_to to = made_kit_to(kit);
    return made_build_torus(&torus, &to, &kit->made);
}
static inline bool made_kit_extrude(struct made_kit *kit, struct made_extrude extrude) {
    const struct made_to to = made_kit_to(kit);
    return made_build_extrude(&extrude, &to, &kit->made);
}

static inline vec3 made_kit_corner(const struct mesh *mesh, uint32_t triangle, int k) {
    return mesh->positions[mesh->triangles[triangle].corners[k]];
}

// Twice the area, outward.
static inline vec3 made_kit_area(const struct mesh *mesh, uint32_t t) {
    const vec3 a = made_kit_corner(mesh, t, 0);
    return vec3_cross(vec3_sub(made_kit_corner(mesh, t, 1), a), vec3_sub(made_kit_corner(mesh, t, 2), a));
}

// The least cosine between a triangle and the normals of its corners.
static inline double made_kit_worst_normal(const struct mesh *mesh) {
    double worst = 1;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        if (!mesh_has_area(mesh, t))
            continue;
        const vec3 face = vec3_unit(made_kit_area(mesh, t));
        for (int k = 0; k < 3; k++)
            if (mesh->triangles[t].normals[k] != IR_NO_INDEX)
                worst = fmin(worst, vec3_dot(face, mesh->normals[mesh->triangles[t].normals[k]]));
    }
    return worst;
}

static inline double made_kit_surface(const struct mesh *mesh) {
    double sum = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        sum += vec3_length(made_kit_area(mesh, t)) / 2;
    return sum;
}

static inline double made_kit_ms(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec / 1e6;
}

static inline void made_kit_refused(const struct made_kit *kit, bool done, enum made_code code) {
    if (done || kit->made.fault.code != code)
        fail_msg("expected fault %d, got %d: %s", (int)code, done ? 0 : (int)kit->made.fault.code,
                 done ? "built" : kit->made.fault.text);
    assert_true(kit->made.fault.text[0]);
}

#endif
