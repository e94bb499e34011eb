// In which order a GPU begins tiles: all of them once, and first those that show bodies which send on rays.
#include "flat_kit.h"
#include "tracer/render/render_private.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    WIDTH = 200, // 25 x 20 tiles
    HEIGHT = 160,
    TILES_X = 25,
    TILES = 500,
};

struct stage {
    struct kit kit;
    struct flat_scene flat;
    struct renderer renderer;
    struct view_camera camera; // at the origin, along -z: 1 up at distance 1 is the upper edge
};

static void add_sphere(struct kit *kit, vec3 center, double radius, double reflection, double refraction) {
    struct ir_material *material = kit_material(kit);
    material->albedo.reflection = reflection;
    material->albedo.refraction = refraction;
    struct ir_sphere *sphere = kit_sphere(kit);
    sphere->center = center;
    sphere->radius = radius;
    kit_use_material(&sphere->material, kit->scene.materials.count - 1);
}

static void open_stage(struct stage *s) {
    assert_true(kit_flatten(&s->kit, &s->flat));
    s->camera =
        (struct view_camera){.right = {1, 0, 0}, .up = {0, 1, 0}, .forward = {0, 0, -1}, .tan_half_fov = 1};
    s->renderer = (struct renderer){.flat = &s->flat,
                                    .settings = {.width = WIDTH, .height = HEIGHT},
                                    .tiles_x = TILES_X,
                                    .tiles = TILES,
                                    .order = calloc(TILES, sizeof(uint32_t))};
    assert_non_null(s->renderer.order);
}

static void close_stage(struct stage *s) {
    free(s->renderer.order);
    flat_finish(&s->flat);
    kit_finish(&s->kit);
}

// Each tile once, and within a rank by rows.
static void assert_whole(const struct renderer *renderer) {
    bool seen[TILES] = {false};
    for (int rank = 0; rank < RENDERER_RANKS; rank++)
        for (uint32_t i = renderer->rank_begins[rank], last = 0; i < renderer->rank_begins[rank + 1]; i++) {
            const uint32_t tile = (renderer->order[i] >> 16) * TILES_X + (renderer->order[i] & 0xffff);
            assert_true(tile < TILES && !seen[tile]);
            assert_true(i == renderer->rank_begins[rank] || tile > last);
            seen[tile] = true;
            last = tile;
        }
    assert_int_equal(renderer->rank_begins[0], 0);
    assert_int_equal(renderer->rank_begins[RENDERER_RANKS], TILES);
}

// Of the picture, in pixels.
static void assert_within(const struct renderer *renderer, int rank, uint32_t x0, uint32_t y0, uint32_t x1,
                          uint32_t y1) {
    for (uint32_t i = renderer->rank_begins[rank]; i < renderer->rank_begins[rank + 1]; i++) {
        const uint32_t x = (renderer->order[i] & 0xffff) * TILE_SIDE,
                       y = (renderer->order[i] >> 16) * TILE_SIDE;
        assert_true(x + TILE_SIDE > x0 && x < x1 && y + TILE_SIDE > y0 && y < y1);
    }
}

static void test_ranks(void **state) {
    (void)state;
    struct stage s = {0};
    kit_init(&s.kit);
    add_sphere(&s.kit, (vec3){0, 0, -20}, 1, 0, 0);
    add_sphere(&s.kit, (vec3){0, -5, -10}, 1, 0.1, 0.8); // a box around 80 +- of 160 lines, a quarter down
    add_sphere(&s.kit, (vec3){0, 5, -10}, 1, 0.5, 0);
    open_stage(&s);
    assert_int_equal(s.flat.bounce_count, 2);
    assert_true(renderer_sort_tiles(&s.renderer, &s.camera));
    assert_whole(&s.renderer);
    // The nearest face of the box is at 9: from 4/9 to 6/9 of half the height, and 1/9 to both sides.
    assert_within(&s.renderer, RENDERER_RANK_REFRACTS, 91, 109, 109, 134);
    assert_within(&s.renderer, RENDERER_RANK_REFLECTS, 91, 26, 109, 51);
    assert_int_equal(s.renderer.rank_begins[1], 3 * 4);
    assert_int_equal(s.renderer.rank_begins[2] - s.renderer.rank_begins[1], 3 * 4);
    close_stage(&s);
}

// A box that reaches behind the camera may be anywhere; one that is all behind it is nowhere.
static void test_behind(void **state) {
    (void)state;
    struct stage s = {0};
    kit_init(&s.kit);
    add_sphere(&s.kit, (vec3){0, 0, 5}, 1, 0, 1);
    open_stage(&s);
    assert_true(renderer_sort_tiles(&s.renderer, &s.camera));
    assert_int_equal(s.renderer.rank_begins[RENDERER_RANK_ENDS], 0);
    s.camera.position.z = 5;
    assert_true(renderer_sort_tiles(&s.renderer, &s.camera));
    assert_int_equal(s.renderer.rank_begins[1], TILES);
    assert_whole(&s.renderer);
    close_stage(&s);
}

// A portion holds a part of each rank.
static void test_portions(void **state) {
    (void)state;
    struct renderer renderer = {.rank_begins = {0, 30, 50, TILES}};
    const struct dispatch_block all = {.tile_count = TILES, .samples = 2};
    const struct dispatch_block part = {.tile_begin = 20, .tile_count = 25};
    assert_int_equal(renderer_rank_begin(&renderer, &all, 1), 30 * TILE_PIXELS * 2);
    assert_int_equal(renderer_rank_begin(&renderer, &all, RENDERER_RANKS), TILES * TILE_PIXELS * 2);
    assert_int_equal(renderer_rank_begin(&renderer, &part, 0), 0);
    assert_int_equal(renderer_rank_begin(&renderer, &part, 1), 10 * TILE_PIXELS);
    assert_int_equal(renderer_rank_begin(&renderer, &part, 2), 25 * TILE_PIXELS);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ranks),
        cmocka_unit_test(test_behind),
        cmocka_unit_test(test_portions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
