// Models that share a mesh show as many triangles as copies would, whatever rounding leaves of them.
#include "flat_kit.h"
#include "random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

enum {
    ROUNDS = 400,
    POSITIONS = 240,
    FACES = 320,
    MODELS = KIT_MAX,
};

// Most faces are of usual size; one of `every` has corners so close together, or so nearly in a line, that
// rounding may leave it without area.
static struct mesh *build_mesh(struct kit *kit, uint64_t *state, uint32_t every) {
    vec3 positions[POSITIONS];
    uint32_t faces[FACES][3];
    for (uint32_t i = 0; i < POSITIONS; i++) {
        positions[i] = (vec3){random_unit(state), random_unit(state), random_unit(state)};
        if (i % 3 == 2 && i % 2) {
            const double share = random_unit(state), off = pow(10, -18 * random_unit(state));
            positions[i] = vec3_add(vec3_mul(positions[i - 1], share), vec3_mul(positions[i - 2], 1 - share));
            positions[i].x += off * (random_unit(state) - 0.5);
        }
        if (i % 3 == 2 && i % 5 == 0)
            positions[i] = vec3_add(positions[i - 1], (vec3){pow(10, -20 * random_unit(state)), 0, 0});
    }
    for (uint32_t i = 0; i < FACES; i++) {
        const uint32_t corner = i % every ? 0 : 3 * (uint32_t)(random_unit(state) * (POSITIONS / 3));
        for (uint32_t k = 0; k < 3; k++)
            faces[i][k] = i % every ? (i * 7 + k * 83 + 3 * (uint32_t)(random_unit(state) * 20)) % POSITIONS
                                    : corner + k;
    }
    return kit_mesh(kit, positions, POSITIONS, (const uint32_t(*)[3])faces, FACES, false);
}

static void place_models(struct kit *kit, struct mesh *mesh, uint64_t *state) {
    for (uint32_t i = 0; i < MODELS; i++) {
        struct ir_model *model = kit_model(kit, mesh);
        const double size = pow(10, -3 * random_unit(state)), far = pow(10, 3 * random_unit(state));
        model->scale = (vec3){size, size * (0.5 + random_unit(state)), i % 4 ? size : -size};
        model->rotation =
            (vec3){360 * random_unit(state), i % 3 ? 0 : 90 * (double)(i % 2), 360 * random_unit(state)};
        model->translation =
            (vec3){far * random_unit(state), far * random_unit(state), -far * random_unit(state)};
    }
}

static void flatten_as(struct kit *kit, enum flat_sharing sharing, struct flat_scene *flat) {
    const struct flat_input input = {.scene = &kit->resolved,
                                     .view = &kit->view,
                                     .is_double = kit->is_double,
                                     .sharing = sharing,
                                     .limits = &kit->limits,
                                     .sink = &kit->sink};
    assert_true(flatten(&input, flat));
}

// How many models were instances of a mesh of which some triangles are copied, and of which some are left
// out.
struct seen {
    uint32_t instances, copied, left_out, thin;
};

static void check_round(uint64_t seed, bool is_double, struct seen *seen) {
    struct kit kit;
    struct flat_scene copies, shared;
    uint64_t state = seed;
    kit_init(&kit);
    kit.is_double = is_double;
    place_models(&kit, build_mesh(&kit, &state, seed % 2 ? 40 : 3), &state);
    kit_resolve(&kit);
    flatten_as(&kit, FLAT_COPIES, &copies);
    flatten_as(&kit, FLAT_SHARED, &shared);
    if (shared.dropped_triangles != copies.dropped_triangles ||
        shared.shown_triangles != copies.shown_triangles)
        fail_msg("seed %d, %s: copies drop %u, instances %u", (int)seed, is_double ? "double" : "single",
                 copies.dropped_triangles, shared.dropped_triangles);
    assert_int_equal(shared.use_count, 1);
    const struct flat_use *use = &shared.uses[0];
    seen->instances += use->instances;
    seen->copied += use->instances && use->copied;
    seen->left_out += use->instances && use->left_out;
    seen->thin += use->reason == FLAT_REASON_THIN;
    flat_finish(&copies);
    flat_finish(&shared);
    kit_finish(&kit);
}

static void test_as_copies(void **state) {
    (void)state;
    for (int is_double = 0; is_double < 2; is_double++) {
        struct seen seen = {0};
        for (uint64_t seed = 1; seed <= ROUNDS; seed++)
            check_round(seed, is_double, &seen);
        // All ways were taken.
        if (!(seen.instances && seen.left_out && (is_double || (seen.copied && seen.thin))))
            fail_msg("%s: %u instances, %u with copied triangles, %u with triangles left out, %u thin",
                     is_double ? "double" : "single", seen.instances, seen.copied, seen.left_out, seen.thin);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_as_copies)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
