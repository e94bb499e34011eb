// Which materials are one medium: a change of any field of the list tells two apart, but of those beside it.
#include "scene/media.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#define COUNT_FIELD(...) +1
enum {
    FIELDS = SCENE_MATERIAL_FIELDS(COUNT_FIELD)
};

static const struct {
    size_t offset, size;
    const char *share;
} fields[] = {
#define FIELD_ROW(kind, name, share, ...)                                                                    \
    {offsetof(struct scene_material, name), sizeof((struct scene_material *)0)->name, #share},
    SCENE_MATERIAL_FIELDS(FIELD_ROW)};

static void each_field_of_a_medium_counts(void **state) {
    (void)state;
    for (int i = 0; i < FIELDS; i++) {
        struct scene_material a = {.refraction = 1}, b = a;
        assert_int_equal(scene_compare_media(&a, &b), 0);
        // The last byte but one of it, of a number its exponent.
        unsigned char *byte = (unsigned char *)&b + fields[i].offset;
        byte[fields[i].size > 1 ? fields[i].size - 2 : 0] ^= 1;
        const int order = scene_compare_media(&a, &b);
        assert_int_equal(order != 0, strcmp(fields[i].share, "MEDIUM") == 0);
        assert_int_equal(scene_compare_media(&b, &a), -order);
    }
}

// Images: the file, each number of where it is, and how it is shown.
static void images_are_known_by_all_that_they_show(void **state) {
    (void)state;
    static const struct picture picture = {.width = 1};
    const struct scene_image images[] = {{.picture = &picture}, {.u = {1}},    {.u = {0, 1}},
                                         {.u = {0, 0, 1}},      {.v = {1}},    {.v = {0, 1}},
                                         {.v = {0, 0, 1}},      {.filter = 1}, {.wrap = 1}};
    for (size_t i = 0; i < sizeof images / sizeof *images; i++)
        for (int k = 0; k < ASSETS_IMAGES; k++) {
            struct scene_material a = {.refraction = 1}, b = a;
            b.images[k] = images[i];
            assert_true(scene_compare_media(&a, &b) != 0);
            a.images[k] = images[i];
            assert_int_equal(scene_compare_media(&a, &b), 0);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_field_of_a_medium_counts),
        cmocka_unit_test(images_are_known_by_all_that_they_show),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
