// Each field of the list of a material reaches the device: the flat scene differs where the field does, in
// both precisions. What the reference traces with is the scene's material itself.
#include "flat_kit.h"
#include "reference/reference_internal.h"
#include "shaders/features.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void change_number(double *field) {
    *field += 0.25;
}
static void change_flag(bool *field) {
    *field = !*field;
}
static void change_whole(int32_t *field) {
    *field += 1;
}
static void change_color(vec3 *field) {
    field->y += 0.25;
}
static void change_colors(vec3 (*field)[2]) {
    (*field)[1].y += 0.25;
}
static void change_images(struct scene_image (*field)[ASSETS_IMAGES]) {
    (*field)[ASSETS_SPECULAR].u[1] += 0.25;
}
static void change_bits(uint64_t *field) {
    *field ^= FEATURE_FRESNEL;
}

#define CHANGE_NUMBER(name) change_number(&m->name)
#define CHANGE_FLAG(name)   change_flag(&m->name)
#define CHANGE_WHOLE(name)  change_whole(&m->name)
#define CHANGE_COLOR(name)  change_color(&m->name)
#define CHANGE_COLORS(name) change_colors(&m->name)
#define CHANGE_IMAGES(name) change_images(&m->name)
#define CHANGE_BITS(name)   change_bits(&m->name)
#define CHANGE_FIELD(kind, name, ...)                                                                        \
    static void alter_##name(struct scene_material *m) {                                                     \
        CHANGE_##kind(name);                                                                                 \
    }
SCENE_MATERIAL_FIELDS(CHANGE_FIELD)

static const struct {
    const char *name;
    void (*change)(struct scene_material *m);
} fields[] = {
#define FIELD_ROW(kind, name, ...) {#name, alter_##name},
    SCENE_MATERIAL_FIELDS(FIELD_ROW)};

enum {
    FIELDS = sizeof fields / sizeof *fields
};

// Two spheres of a material that uses all there is, which overlap.
static void fill(struct kit *kit) {
    static uint8_t pixels[3] = {200, 100, 50};
    static const struct picture picture = {
        .width = 1, .height = 1, .depth = PICTURE_8, .pixels = pixels, .size_bytes = sizeof pixels};
    static const struct picture *images[2][ASSETS_IMAGES] = {{&picture, &picture}};
    kit_init(kit);
    struct ir_material *m = kit_material(kit);
    m->albedo = (struct ir_weights){0.5, 0.5, 0.5, 0.5};
    m->diffuse_color.kind = IR_PAINT_CHECKER;
    m->refractive_index = 1.5;
    m->attenuation_color = (struct ir_color){.r = 0.5, .g = 0.5, .b = 0.5};
    kit->assets.images = images;
    for (int i = 0; i < 2; i++)
        kit_use_material(&kit_sphere(kit)->material, 0);
    kit_resolve(kit);
}

static bool is_same_array(const struct flat_array *a, const struct flat_array *b) {
    return a->count == b->count && memcmp(a->words, b->words, a->count * sizeof *a->words) == 0;
}

static bool is_same(const struct flat_scene *a, const struct flat_scene *b) {
    return a->features == b->features && is_same_array(&a->materials, &b->materials) &&
           is_same_array(&a->paints, &b->paints) && is_same_array(&a->bodies, &b->bodies) &&
           is_same_array(&a->spheres, &b->spheres);
}

static void each_field_is_flattened(void **state) {
    (void)state;
    for (int i = 0; i < 2 * FIELDS; i++) {
        struct kit kit;
        struct flat_scene before, after, again;
        fill(&kit);
        kit.is_double = i >= FIELDS;
        assert_true(kit_flatten_resolved(&kit, &before));
        assert_true(kit_flatten_resolved(&kit, &again));
        assert_true(is_same(&before, &again));
        fields[i % FIELDS].change(&kit.resolved.materials[0]);
        assert_true(kit_flatten_resolved(&kit, &after));
        if (is_same(&before, &after))
            fail_msg("the flat scene does not change with '%s'", fields[i % FIELDS].name);
        flat_finish(&before);
        flat_finish(&again);
        flat_finish(&after);
        kit_finish(&kit);
    }
}

static void the_reference_has_the_material_itself(void **state) {
    (void)state;
    struct kit kit;
    fill(&kit);
    const struct reference_input input = {.scene = &kit.resolved, .view = &kit.view};
    struct reference *reference = reference_create(&input);
    assert_non_null(reference);
    for (uint32_t i = 0; i < kit.resolved.material_count; i++)
        assert_ptr_equal(reference->materials[i].is, &kit.resolved.materials[i]);
    reference_destroy(reference);
    kit_finish(&kit);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_field_is_flattened),
        cmocka_unit_test(the_reference_has_the_material_itself),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
