#include "reference_kit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

void reference_kit_camera(struct kit *kit, vec3 position) {
    kit->view.camera = (struct view_camera){
        .position = position, .right = {1, 0, 0}, .up = {0, 1, 0}, .forward = {0, 0, -1}, .tan_half_fov = 1};
}

static struct reference *make(struct kit *kit, struct reference_input input) {
    kit_resolve(kit);
    input.scene = &kit->resolved;
    input.view = &kit->view;
    struct reference *reference = reference_create(&input);
    assert_non_null(reference);
    return reference;
}

struct reference *reference_kit_make(struct kit *kit, enum reference_test test, bool no_tree) {
    return make(kit, (struct reference_input){.test = test, .no_tree = no_tree});
}

struct reference *reference_kit_make_quickly(struct kit *kit) {
    return make(kit, (struct reference_input){.few_rays = true, .no_bound = true});
}

uint32_t random_below(uint64_t *random, uint32_t end) {
    return (uint32_t)(random_unit(random) * end);
}

vec3 random_in_cube(uint64_t *random) {
    double x = 2 * random_unit(random) - 1;
    double y = 2 * random_unit(random) - 1;
    return (vec3){x, y, 2 * random_unit(random) - 1};
}

struct mesh *reference_kit_soup(struct kit *kit, uint32_t triangles, uint64_t seed) {
    uint64_t random = seed;
    vec3 *positions = ARENA_ARRAY(&kit->arena, vec3, 3 * triangles);
    uint32_t(*faces)[3] = arena_alloc_array(&kit->arena, triangles, sizeof *faces);
    for (uint32_t i = 0; i < triangles; i++) {
        vec3 center = random_in_cube(&random);
        double size = exp2(-8 * random_unit(&random));
        for (uint32_t k = 0; k < 3; k++) {
            positions[3 * i + k] = vec3_add(center, vec3_mul(random_direction(&random), size));
            faces[i][k] = 3 * i + k;
        }
    }
    return kit_mesh(kit, positions, 3 * triangles, (const uint32_t(*)[3])faces, triangles, false);
}
