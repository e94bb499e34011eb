// The feature mask: what each part of a scene switches on, and why.
#include "grammar/ir.h"
#include "grammar/ir_features.h"
#include "grammar/schema.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

struct kit {
    struct arena arena;
    struct ir_scene scene;
};

static int set_up(void **state) {
    static struct kit kit;
    memset(&kit, 0, sizeof kit);
    arena_init(&kit.arena, 1 << 24);
    schema_init(&SCHEMA_SCENE, &kit.scene);
    *state = &kit;
    return 0;
}

static int tear_down(void **state) {
    arena_finish(&((struct kit *)*state)->arena);
    return 0;
}

static struct ir_material *add_material(struct kit *kit, str name, struct ir_weights albedo) {
    struct ir_material *material = ARENA_PUSH(&kit->arena, &kit->scene.materials);
    schema_init(&SCHEMA_MATERIAL, material);
    material->name = name;
    material->albedo = albedo;
    return material;
}

static struct ir_sphere *add_sphere(struct kit *kit, uint32_t material) {
    struct ir_sphere *sphere = ARENA_PUSH(&kit->arena, &kit->scene.spheres);
    schema_init(&SCHEMA_SPHERE, sphere);
    sphere->material.index = material;
    return sphere;
}

static struct ir_light *add_light(struct kit *kit) {
    struct ir_light *light = ARENA_PUSH(&kit->arena, &kit->scene.lights);
    schema_init(&SCHEMA_LIGHT, light);
    return light;
}

static const uint64_t ALWAYS = FEATURE_SHADOWS | FEATURE_POINT_LIGHT;

static void test_an_empty_scene(void **state) {
    struct kit *kit = *state;
    assert_int_equal(ir_features(&kit->scene), ALWAYS);
    kit->scene.trace.shadows = false;
    assert_int_equal(ir_features(&kit->scene), FEATURE_POINT_LIGHT);
}

static void test_default_material(void **state) {
    struct kit *kit = *state;
    add_sphere(kit, IR_NO_INDEX);
    assert_int_equal(ir_features(&kit->scene), ALWAYS | FEATURE_SPHERES | FEATURE_DIFFUSE);
    assert_int_equal(ir_material_features(NULL), FEATURE_DIFFUSE);
}

// Only what a body or a material_map uses counts.
static void test_materials_count_where_used(void **state) {
    struct kit *kit = *state;
    add_material(kit, STR("unused"), (struct ir_weights){0, 0, 0, 1});
    add_material(kit, STR("mirror"), (struct ir_weights){0, 0.5, 0.8, 0});
    add_material(kit, STR("mapped"), (struct ir_weights){0, 0, 0, 0.1});
    add_sphere(kit, 1);
    assert_int_equal(ir_features(&kit->scene),
                     ALWAYS | FEATURE_SPHERES | FEATURE_SPECULAR | FEATURE_REFLECTION);
    struct ir_model *model = ARENA_PUSH(&kit->arena, &kit->scene.models);
    schema_init(&SCHEMA_MODEL, model);
    model->material.index = 1;
    struct ir_map_entry *entry = ARENA_PUSH(&kit->arena, &model->material_map);
    schema_init(&SCHEMA_MAP_ENTRY, entry);
    entry->to.index = 2;
    assert_int_equal(ir_features(&kit->scene), ALWAYS | FEATURE_SPHERES | FEATURE_TRIANGLES |
                                                   FEATURE_SPECULAR | FEATURE_REFLECTION |
                                                   FEATURE_REFRACTION);
    model->smooth = true;
    assert_true(ir_features(&kit->scene) & FEATURE_SMOOTH);
}

// An alternative that is not taken switches nothing on, whatever it holds.
static void test_alternatives(void **state) {
    struct kit *kit = *state;
    struct ir_material *material = add_material(kit, STR("floor"), (struct ir_weights){1, 0, 0, 0});
    add_sphere(kit, 0);
    kit->scene.background.image = STR("sky.png");
    assert_int_equal(ir_features(&kit->scene), ALWAYS | FEATURE_SPHERES | FEATURE_DIFFUSE);
    material->diffuse_color.kind = IR_PAINT_CHECKER;
    kit->scene.background.kind = IR_BACKDROP_IMAGE;
    assert_int_equal(ir_features(&kit->scene),
                     ALWAYS | FEATURE_SPHERES | FEATURE_DIFFUSE | FEATURE_CHECKER | FEATURE_BACKGROUND_IMAGE);
}

static void test_lights(void **state) {
    struct kit *kit = *state;
    struct ir_light *light = add_light(kit);
    light->kind = IR_LIGHT_DIRECTION;
    assert_int_equal(ir_features(&kit->scene), FEATURE_SHADOWS | FEATURE_DIRECTION_LIGHT);
    add_light(kit)->falloff = IR_FALLOFF_INVERSE_SQUARE;
    assert_int_equal(ir_features(&kit->scene), ALWAYS | FEATURE_DIRECTION_LIGHT | FEATURE_INVERSE_SQUARE);
    kit->scene.trace.depth_limit = IR_DEPTH_BLACK;
    assert_true(ir_features(&kit->scene) & FEATURE_DEPTH_BLACK);
}

static const struct ir_feature_reason *reason_for(const struct ir_feature_reasons *reasons, uint64_t bit) {
    for (uint32_t i = 0; i < reasons->count; i++)
        if (reasons->items[i].bit == bit)
            return &reasons->items[i];
    fail_msg("no reason for %s", feature_name(bit));
    return NULL;
}

static void test_reasons(void **state) {
    struct kit *kit = *state;
    struct ir_feature_reasons reasons;
    struct ir_origin origin;
    ir_origin_init(&origin, &kit->arena);
    struct ir_material *glass = add_material(kit, STR("glass"), (struct ir_weights){0, 0, 0, 0.8});
    int albedo = schema_find_row(&SCHEMA_MATERIAL, STR("albedo"));
    glass->head.written = UINT64_C(1) << albedo;
    glass->head.origin = ir_origin_add(&origin, (struct ir_element_origin){.label = {1, 10, 15}});
    ir_origin_add_row(&origin, glass->head.origin,
                      (struct ir_row_origin){.row = (uint32_t)albedo, .value = {1, 20, 30}});
    struct ir_sphere *sphere = add_sphere(kit, 0);
    sphere->head.origin = ir_origin_add(&origin, (struct ir_element_origin){.label = {1, 40, 44}});
    add_sphere(kit, 0);
    ir_features_explain(&kit->scene, &origin, &reasons);
    assert_int_equal(reasons.mask, ir_features(&kit->scene));
    const struct ir_feature_reason *reason = reason_for(&reasons, FEATURE_REFRACTION);
    assert_string_equal(reason->words, "material 'glass': albedo: refraction is 0.8");
    assert_int_equal(reason->at.begin, 20);
    reason = reason_for(&reasons, FEATURE_SPHERES);
    assert_string_equal(reason->words, "2 spheres");
    assert_int_equal(reason->at.begin, 40);
    reason = reason_for(&reasons, FEATURE_SHADOWS);
    assert_string_equal(reason->words, "trace: shadows is true by default");
    assert_true(span_is_none(reason->at));
    assert_string_equal(reason_for(&reasons, FEATURE_POINT_LIGHT)->words,
                        "no light is written, so one is placed at the camera");
    uint64_t mask = 0;
    for (uint32_t i = 0; i < reasons.count; i++) {
        assert_true(reasons.items[i].bit > mask); // each once, in order
        mask |= reasons.items[i].bit;
    }
    assert_int_equal(mask, reasons.mask);
    add_light(kit)->kind = IR_LIGHT_RECTANGLE;
    ir_features_explain(&kit->scene, &origin, &reasons);
    assert_string_equal(reason_for(&reasons, FEATURE_POINT_LIGHT)->words,
                        "each light is a panel, which shines from its points");
}

static void test_names(void **state) {
    (void)state;
    for (uint32_t i = 0; i < FEATURE_COUNT; i++) {
        assert_string_not_equal(feature_name(UINT64_C(1) << i), "unknown");
        for (uint32_t k = 0; k < i; k++)
            assert_string_not_equal(feature_name(UINT64_C(1) << i), feature_name(UINT64_C(1) << k));
    }
    assert_string_equal(feature_name(3), "unknown");
    assert_string_equal(feature_name(UINT64_C(1) << FEATURE_COUNT), "unknown");
}

// Every bit that only a file can set is in the table.
static void test_every_feature_has_a_row(void **state) {
    (void)state;
    uint64_t mask = 0;
    for (const struct schema_element *const *e = schema_elements; *e; e++)
        for (uint32_t i = 0; i < (*e)->row_count; i++) {
            mask |= (*e)->rows[i].feature;
            for (int k = 0; k < 4; k++)
                mask |= (*e)->rows[i].weight_features[k];
        }
    // Whether rays must know what they are inside follows from where bodies are.
    assert_int_equal(mask, FEATURE_SCENE_MASK & ~FEATURE_MEDIA);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        TEST(test_an_empty_scene),
        TEST(test_default_material),
        TEST(test_materials_count_where_used),
        TEST(test_alternatives),
        TEST(test_lights),
        TEST(test_reasons),
        TEST(test_names),
        TEST(test_every_feature_has_a_row),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
