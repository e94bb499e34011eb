// The memory of a JPEG's coefficients, through libjpeg-turbo's own calls.
#include "core/arena.h"
#include "picture/read/jpeg_blocks.h"

#include <limits.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <jerror.h>

#include "tests/unit/huge_pages.h"

struct fixture {
    struct jpeg_blocks blocks; // first, as the header says
    struct jpeg_decompress_struct decoder;
    struct jpeg_error_mgr errors;
    struct arena arena; // whose guard ends what a library's error ends
    jvirt_barray_ptr of;
};

_Noreturn static void on_error(j_common_ptr decoder) {
    arena_raise(&((struct fixture *)decoder->client_data)->arena, ARENA_FAULT_CAP);
}

static void begin(struct fixture *f) {
    *f = (struct fixture){0};
    f->decoder.err = jpeg_std_error(&f->errors);
    f->errors.error_exit = on_error;
    jpeg_create_decompress(&f->decoder);
    jpeg_blocks_use(&f->decoder, &f->blocks);
    f->decoder.mem->max_memory_to_use = LONG_MAX;
}

static void end(struct fixture *f) {
    jpeg_destroy_decompress(&f->decoder);
    jpeg_blocks_finish(&f->blocks);
}

static jvirt_barray_ptr plane(struct fixture *f, JDIMENSION width, JDIMENSION height) {
    return f->decoder.mem->request_virt_barray((j_common_ptr)&f->decoder, JPOOL_IMAGE, TRUE, width, height,
                                               1);
}

static JBLOCKARRAY rows(struct fixture *f, jvirt_barray_ptr of, JDIMENSION first, JDIMENSION count) {
    return f->decoder.mem->access_virt_barray((j_common_ptr)&f->decoder, of, first, count, TRUE);
}

static void planes_lie_apart_and_are_zero(void **state) {
    (void)state;
    struct fixture f;
    begin(&f);
    jvirt_barray_ptr planes[] = {plane(&f, 512, 256), plane(&f, 256, 128), plane(&f, 3, 1)};
    f.decoder.mem->realize_virt_arrays((j_common_ptr)&f.decoder);
    for (unsigned p = 0; p < 3; p++)
        for (JDIMENSION y = 0; y < planes[p]->height; y++)
            for (JDIMENSION x = 0; x < planes[p]->width; x++) {
                JCOEFPTR block = rows(&f, planes[p], y, 1)[0][x];
                assert_int_equal((uintptr_t)block % 64, 0);
                assert_int_equal(block[0], 0);
                assert_int_equal(block[63], 0);
                block[0] = block[63] = (JCOEF)(p + 1);
            }
    assert_ptr_equal(rows(&f, planes[0], 254, 2)[1], rows(&f, planes[0], 255, 1)[0]);
    if (huge_pages_exist())
        assert_true(huge_pages_asked(rows(&f, planes[0], 128, 1)[0]));
    end(&f);
}

// The library's error that the work ends with.
static int error_of(struct fixture *f, arena_work *work) {
    assert_int_equal(arena_guarded(&f->arena, work, f), ARENA_FAULT_CAP);
    return f->errors.msg_code;
}

static void make(void *context) {
    struct fixture *f = context;
    f->decoder.mem->realize_virt_arrays((j_common_ptr)&f->decoder);
}

static void take_first(void *context) {
    struct fixture *f = context;
    rows(f, f->of, 0, 1);
}

static void take_beyond(void *context) {
    struct fixture *f = context;
    rows(f, f->of, 3, 2);
}

static void ask_for_one(void *context) {
    plane(context, 1, 1);
}

static void what_is_not_there_is_an_error(void **state) {
    (void)state;
    struct fixture f;
    begin(&f);
    f.of = plane(&f, 4, 4);
    assert_int_equal(error_of(&f, take_first), JERR_BAD_VIRTUAL_ACCESS);
    make(&f);
    assert_non_null(rows(&f, f.of, 0, 1));
    assert_int_equal(error_of(&f, take_beyond), JERR_BAD_VIRTUAL_ACCESS);
    end(&f);
}

static void the_budget_is_kept(void **state) {
    (void)state;
    const long needed = 2 * 16 * (long)sizeof(JBLOCK);
    for (long budget = needed; budget > needed - 2; budget--) {
        struct fixture f;
        begin(&f);
        f.decoder.mem->max_memory_to_use = budget;
        plane(&f, 4, 4);
        plane(&f, 4, 4);
        if (budget < needed)
            assert_int_equal(error_of(&f, make), JERR_NO_BACKING_STORE);
        else
            make(&f);
        assert_int_equal(f.blocks.memory != NULL, budget >= needed);
        end(&f);
    }
}

static void a_fifth_component_is_an_error(void **state) {
    (void)state;
    struct fixture f;
    begin(&f);
    for (unsigned i = 0; i < JPEG_BLOCKS_PLANES; i++)
        plane(&f, 1, 1);
    assert_int_equal(error_of(&f, ask_for_one), JERR_COMPONENT_COUNT);
    end(&f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_lie_apart_and_are_zero),
        cmocka_unit_test(what_is_not_there_is_an_error),
        cmocka_unit_test(the_budget_is_kept),
        cmocka_unit_test(a_fifth_component_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
