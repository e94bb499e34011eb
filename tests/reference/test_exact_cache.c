// The cache of the reference: found again, not mistaken, and replaced where it is damaged.
#include "reference/cache.h"
#include "reference_kit.h"
#include "tests/unit/kit/scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum {
    WIDTH = 20,
    HEIGHT = 10,
    VALUES = WIDTH * HEIGHT * 3,
};

static struct scratch scratch;

static int make_folder(void **state) {
    (void)state;
    return scratch_make(&scratch) ? 0 : -1;
}

static int remove_folder(void **state) {
    (void)state;
    scratch_finish(&scratch);
    return 0;
}

static void scene(struct kit *kit) {
    kit_init(kit);
    reference_kit_camera(kit, (vec3){0, 0, 4});
    struct ir_material *material = kit_material(kit);
    material->albedo = (struct ir_weights){0.5, 0, 0.5, 0};
    kit_use_material(&kit_sphere(kit)->material, 0);
    kit_model(kit, kit_icosphere(kit, 1, 0))->translation = (vec3){1.5, 0, 0};
    kit_light(kit, (vec3){3, 4, 5});
    reference_destroy(reference_kit_make(kit, REFERENCE_WATERTIGHT, false)); // fills the materials
}

static struct reference_settings settings_of(uint32_t samples) {
    return (struct reference_settings){.width = WIDTH,
                                       .height = HEIGHT,
                                       .samples = samples,
                                       .max_depth = 5,
                                       .min_weight = 1e-6,
                                       .segments = 1000};
}

// Whether the answer came from the cache.
static bool ask(struct kit *kit, const struct reference_settings *settings, double rgb[VALUES], char *name) {
    struct reference_source source;
    struct reference_statistics statistics;
    scene_build(&kit->scene, &kit->assets, &kit->arena, &kit->resolved); // as changed
    struct reference_input input = {.scene = &kit->resolved, .view = &kit->view};
    reference_source_init(&source, &input, (struct folder_store){scratch.folder, 1000000});
    assert_int_equal(reference_source_render(&source, settings, rgb, NULL, &statistics), REFERENCE_DONE);
    assert_int_equal(statistics.primary, (uint64_t)WIDTH * HEIGHT * settings->samples);
    assert_int_equal(source.found + source.computed, 1);
    assert_int_equal(source.reference != NULL, source.computed);
    if (name)
        reference_source_name(&source, settings, REFERENCE_ENTRY_PICTURE, name);
    bool found = source.found;
    reference_source_finish(&source);
    return found;
}

static void test_found_again(void **state) {
    (void)state;
    struct kit kit;
    double first[VALUES], second[VALUES];
    struct reference_settings settings = settings_of(1);
    scene(&kit);
    assert_false(ask(&kit, &settings, first, NULL));
    assert_true(ask(&kit, &settings, second, NULL));
    assert_memory_equal(first, second, sizeof first);
    settings.samples = 2;
    assert_false(ask(&kit, &settings, second, NULL));
    settings.min_weight = 1e-3;
    assert_false(ask(&kit, &settings, second, NULL));
    settings.first_sample = 2;
    assert_false(ask(&kit, &settings, second, NULL));
    uint32_t *const spread[] = {&settings.points_of, &settings.footprint_of, &settings.planned};
    for (size_t i = 0; i < sizeof spread / sizeof *spread; i++) {
        *spread[i] = 16;
        assert_false(ask(&kit, &settings, second, NULL));
    }
    kit_finish(&kit);
}

static void test_hits_are_kept_too(void **state) {
    (void)state;
    struct kit kit;
    struct hit_pixel hits[2][WIDTH * HEIGHT];
    struct reference_source source;
    struct reference_settings settings = settings_of(1);
    scene(&kit);
    struct reference_input input = {.scene = &kit.resolved, .view = &kit.view};
    for (int i = 0; i < 2; i++) {
        reference_source_init(&source, &input, (struct folder_store){scratch.folder, 1000000});
        assert_int_equal(reference_source_hits(&source, &settings, hits[i], NULL), REFERENCE_DONE);
        assert_int_equal(source.found, i);
        reference_source_finish(&source);
    }
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_int_equal(hits[0][i].body, hits[1][i].body);
        assert_true(hits[0][i].distance == hits[1][i].distance);
    }
    kit_finish(&kit);
}

typedef void change(struct kit *kit);
static void move_sphere(struct kit *kit) {
    kit->scene.spheres.items[0].center.x += 0x1p-40;
}
static void turn_model(struct kit *kit) {
    kit->scene.models.items[0].rotation.y = 1;
}
static void smooth_model(struct kit *kit) {
    kit->scene.models.items[0].smooth = true;
}
static void move_vertex(struct kit *kit) {
    kit->assets.models[0].mesh->positions[3].y += 0x1p-40;
}
static void turn_face(struct kit *kit) {
    struct mesh_triangle *t = &kit->assets.models[0].mesh->triangles[7];
    uint32_t corner = t->corners[1];
    t->corners[1] = t->corners[2];
    t->corners[2] = corner;
}
static void paint(struct kit *kit) {
    kit->assets.materials[0].diffuse_color.color.g = 0.125;
}
static void shine(struct kit *kit) {
    kit->view.lights[0].emission.z = 2;
}
static void step(struct kit *kit) {
    kit->view.camera.position.x = 0x1p-40;
}
static void see(struct kit *kit) {
    kit->scene.background.color.b = 0.5;
}
static void dim_sky(struct kit *kit) {
    kit->scene.background.intensity = 0.5;
}
static void turn_sky(struct kit *kit) {
    kit->scene.background.rotation = 1;
}
static void grow_sphere(struct kit *kit) {
    kit->scene.spheres.items[0].radius *= 1 + 0x1p-40;
}
static void bend(struct kit *kit) {
    kit->assets.materials[0].refractive_index += 0x1p-40;
}
static void sharpen(struct kit *kit) {
    kit->assets.materials[0].specular_exponent += 1;
}
static void no_shadows(struct kit *kit) {
    kit->scene.trace.shadows = false;
}

static void test_no_change_is_missed(void **state) {
    (void)state;
    static change *const changes[] = {move_sphere, turn_model, smooth_model, move_vertex, turn_face,
                                      paint,       shine,      step,         see,         no_shadows,
                                      dim_sky,     turn_sky,   grow_sphere,  bend,        sharpen};
    struct reference_settings settings = settings_of(1);
    double rgb[VALUES];
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        struct kit kit;
        scene(&kit);
        ask(&kit, &settings, rgb, NULL);
        assert_true(ask(&kit, &settings, rgb, NULL));
        changes[i](&kit);
        assert_false(ask(&kit, &settings, rgb, NULL));
        kit_finish(&kit);
    }
}

static void damage(const char *name, long at, bool shorter) {
    FILE *file = fopen(scratch_path(&scratch, name), "r+b");
    assert_non_null(file);
    assert_int_equal(fseek(file, at, at < 0 ? SEEK_END : SEEK_SET), 0);
    if (shorter) {
        assert_int_equal(ftruncate(fileno(file), ftell(file)), 0);
    } else {
        int byte = getc(file);
        assert_int_equal(fseek(file, -1, SEEK_CUR), 0);
        putc(byte ^ 1, file);
    }
    fclose(file);
}

static void test_damage_is_replaced(void **state) {
    (void)state;
    // In the magic, the version, the key, the last number; and cut at both ends.
    static const struct {
        long at;
        bool shorter;
    } faults[] = {{0, false}, {8, false}, {24, false}, {-1, false}, {-1, true}, {3, true}, {0, true}};
    struct kit kit;
    struct reference_settings settings = settings_of(1);
    double first[VALUES], again[VALUES];
    char name[REFERENCE_NAME_BYTES];
    scene(&kit);
    ask(&kit, &settings, first, name);
    for (size_t i = 0; i < sizeof faults / sizeof faults[0]; i++) {
        assert_true(ask(&kit, &settings, again, NULL));
        damage(name, faults[i].at, faults[i].shorter);
        memset(again, 0, sizeof again);
        assert_false(ask(&kit, &settings, again, NULL));
        assert_memory_equal(first, again, sizeof first);
    }
    kit_finish(&kit);
}

static void test_no_store(void **state) {
    (void)state;
    struct kit kit;
    struct reference_source source;
    double rgb[VALUES];
    struct reference_settings settings = settings_of(1);
    scene(&kit);
    struct reference_input input = {.scene = &kit.resolved, .view = &kit.view};
    reference_source_init(&source, &input, (struct folder_store){0});
    for (uint32_t i = 1; i <= 2; i++) {
        assert_int_equal(reference_source_render(&source, &settings, rgb, NULL, NULL), REFERENCE_DONE);
        assert_int_equal(source.computed, i);
    }
    reference_source_finish(&source);
    kit_finish(&kit);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_found_again),
        cmocka_unit_test(test_hits_are_kept_too),
        cmocka_unit_test(test_no_change_is_missed),
        cmocka_unit_test(test_damage_is_replaced),
        cmocka_unit_test(test_no_store),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
