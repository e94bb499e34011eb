// A picture's own error: which pixels are traced again, what counts as off, and what is said of all of them.
#include "core/limits.h"
#include "grammar/ir.h"
#include "measure/share.h"
#include "reference/reference.h"
#include "render/audit.h"

#include <math.h>
#include <stdlib.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static const char scene[] =
    "glint: 1\nbackground: {color: [0.2, 0.4, 0.6]}\n"
    "camera: {position: [0.1, 0.2, 4]}\nlights: [{position: [3, 4, 5]}]\n"
    "spheres: [{center: [0.1, 0, 0], radius: 1, material: {albedo: [0.5, 0, 0.4, 0]}}]\n";

// The scene, and a picture of it that is right everywhere.
struct fixture {
    struct session session;
    struct asset_store *store;
    struct view view;
    struct image image;
};

static void open_picture(struct fixture *f, int32_t width, int32_t height, int32_t samples) {
    const struct file_overlay overlay = {STR("/scene.glint.yaml"), str_from(scene)};
    const struct session_options options = {.path = overlay.path,
                                            .overlays = &overlay,
                                            .overlay_count = 1,
                                            .limits = limits_default(),
                                            .width = width,
                                            .height = height,
                                            .samples = samples};
    f->store = asset_store_create();
    assert_int_equal(session_load(&f->session, &options, f->store), SESSION_LOADED);
    assert_true(session_view(&f->session, 0, &f->view));
    assert_true(image_init(&f->image, (uint32_t)width, (uint32_t)height));
    const struct reference_input input = {.scene = &f->session.resolved, .view = &f->view};
    const struct reference_settings settings =
        reference_settings_of(f->session.scene, f->session.image, &f->session.options.limits, true);
    struct reference *reference = reference_create(&input);
    const size_t count = (size_t)3 * f->image.width * f->image.height;
    double *exact = malloc(count * sizeof *exact);
    assert_int_equal(reference_render(reference, &settings, exact, NULL, NULL), REFERENCE_DONE);
    for (size_t i = 0; i < count; i++)
        f->image.rgb[i] = (float)exact[i];
    free(exact);
    reference_destroy(reference);
}

static void close_picture(struct fixture *f) {
    image_finish(&f->image);
    session_finish(&f->session);
    asset_store_destroy(f->store);
}

static struct audit take_for(struct fixture *f, struct audit_wish wish) {
    struct audit audit;
    assert_int_equal(audit_take(&f->session, &f->view, &f->image, &wish, NULL, &audit), SHOT_OK);
    return audit;
}

static struct audit take(struct fixture *f) {
    return take_for(f, (struct audit_wish){.share = AUDIT_SHARE});
}

static void spoil(struct image *image, uint32_t x, uint32_t y, float by) {
    image->rgb[3 * ((size_t)y * image->width + x) + 1] += by;
}

// ---- the bound

static void test_bound(void **state) {
    (void)state;
    for (uint32_t n = 1; n < 100000; n *= 7) {
        assert_true(fabs(share_bound(0, n, 0.025) - (1 - pow(0.025, 1.0 / n))) < 1e-12);
        assert_true(share_bound(n, n, 0.025) == 1);
        assert_true(fabs(share_floor(n, n, 0.01) - pow(0.01, 1.0 / n)) < 1e-12);
        assert_true(share_floor(0, n, 0.01) == 0);
    }
    assert_true(fabs(share_bound(9, 10, 0.025) - pow(0.975, 0.1)) < 1e-12);
    assert_true(fabs(share_floor(1, 10, 0.025) - (1 - pow(0.975, 0.1))) < 1e-12);
    // One of n: (1 - p)^n + n p (1 - p)^(n - 1) is 0.025.
    const double p = share_bound(1, 3000, 0.025);
    assert_true(fabs(pow(1 - p, 3000) + 3000 * p * pow(1 - p, 2999) - 0.025) < 1e-9);
    assert_true(share_bound(0, 3700, 0.025) < 0.001 && share_bound(1, 3700, 0.025) > 0.001);
    for (uint32_t k = 1; k < 3000; k += k) {
        assert_true(share_bound(k, 3000, 0.025) > share_bound(k - 1, 3000, 0.025));
        assert_true(share_floor(k, 3000, 0.025) > share_floor(k - 1, 3000, 0.025));
        assert_true(share_bound(k, 3000, 0.025) > k / 3000.0 && share_floor(k, 3000, 0.025) < k / 3000.0);
        assert_true(share_bound(k, 3000, 0.01) > share_bound(k, 3000, 0.025));
        assert_true(fabs(share_floor(3000 - k, 3000, 0.01) - (1 - share_bound(k, 3000, 0.01))) < 1e-12);
    }
    // Of many: the normal distribution's 1.96 standard deviations, nearly.
    assert_true(fabs(share_bound(500000, 1000000, 0.025) - 0.50098) < 1e-5);
    assert_true(fabs(share_floor(500000, 1000000, 0.025) - 0.49902) < 1e-5);
}

// ---- pictures

static void test_right(void **state) {
    (void)state;
    static const int32_t sizes[][3] = {{64, 48, 1}, {160, 120, 2}, {4000, 3, 1}, {3, 4500, 1}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        struct fixture f;
        open_picture(&f, sizes[i][0], sizes[i][1], sizes[i][2]);
        const struct audit audit = take(&f);
        assert_int_equal(audit.off, 0);
        assert_int_equal(audit.whole, sizes[i][0] * sizes[i][1] <= 7400);
        assert_in_range(audit.pixels, audit.whole ? 3072 : 3700, audit.whole ? 3072 : 4500);
        assert_true(audit.whole ? audit.bound == 0 : audit.bound > 0 && audit.bound < 0.001);
        close_picture(&f);
    }
}

static void test_small(void **state) {
    (void)state;
    struct fixture f;
    open_picture(&f, 40, 30, 1);
    spoil(&f.image, 17, 23, 0.005f);
    spoil(&f.image, 5, 29, 0.003f); // less than 1/255
    spoil(&f.image, 9, 24, -0.005f);
    struct audit audit = take(&f);
    assert_int_equal(audit.off, 2);
    assert_true(audit.bound == 2 / 1200.0);
    assert_int_equal(audit.x, 17);
    assert_int_equal(audit.y, 23);
    f.image.rgb[3 * 77] = NAN;
    audit = take(&f);
    assert_int_equal(audit.off, 3);
    assert_int_equal(audit.x + 40 * audit.y, 77);
    close_picture(&f);
}

// The pixels are spread: of each sixteenth of the picture as many are traced again.
static void test_spread(void **state) {
    (void)state;
    struct fixture f;
    open_picture(&f, 160, 120, 1);
    for (uint32_t part = 0; part < 16; part++) {
        const uint32_t left = part % 4 * 40, top = part / 4 * 30;
        for (uint32_t i = 0; i < 40 * 30; i++)
            spoil(&f.image, left + i % 40, top + i / 40, 1);
        const struct audit audit = take(&f);
        assert_in_range(audit.off, 200, 270); // 3700 / 16 is 231
        assert_in_range(audit.x, left, left + 39);
        assert_in_range(audit.y, top, top + 29);
        assert_true(audit.bound > 0.0625 && audit.bound < 0.09);
        for (uint32_t i = 0; i < 40 * 30; i++)
            spoil(&f.image, left + i % 40, top + i / 40, -1);
    }
    close_picture(&f);
}

// Within a cell no place is preferred: no column of pixels is never looked at.
static void test_jitter(void **state) {
    (void)state;
    struct fixture f;
    open_picture(&f, 160, 120, 1);
    for (uint32_t line = 0; line < 8; line++) {
        for (uint32_t i = 0; i < 160 * 120; i++)
            if (i % 160 % 8 == line)
                spoil(&f.image, i % 160, i / 160, 1);
        assert_in_range(take(&f).off, 390, 540); // an eighth of 3700 is 463
        for (uint32_t i = 0; i < 160 * 120; i++)
            if (i % 160 % 8 == line)
                spoil(&f.image, i % 160, i / 160, -1);
    }
    close_picture(&f);
}

// Where a few pixels are off more are taken; of a picture that is not large, all.
static void test_second_look(void **state) {
    (void)state;
    struct fixture f;
    open_picture(&f, 120, 100, 1);
    for (uint32_t i = 0; i < 120 * 100; i += 500)
        spoil(&f.image, i % 120, i / 120, 1);
    struct audit audit = take(&f);
    assert_true(audit.whole);
    assert_int_equal(audit.pixels, 120 * 100);
    assert_int_equal(audit.off, 24);
    assert_true(audit.bound == 24 / 12000.0);
    close_picture(&f);
    open_picture(&f, 240, 180, 1);
    for (uint32_t i = 0; i < 240 * 180; i += 1000)
        spoil(&f.image, i % 240, i / 240, 1);
    audit = take(&f);
    assert_false(audit.whole);
    assert_in_range(audit.pixels, 8700, 9200);
    assert_in_range(audit.off, 3, 25); // a thousandth of 8700 is 9
    assert_true(audit.bound > 0.0005 && audit.bound < 0.004);
    close_picture(&f);
}

static void spoil_each(struct image *image, uint32_t step) {
    const uint32_t pixels = image->width * image->height;
    for (uint32_t i = step / 2; i < pixels; i += step)
        spoil(image, i % image->width, i / image->width, 1);
}

// Whether more than a share is off is decided however near it is, with no more pixels than that takes.
static void test_decided(void **state) {
    (void)state;
    static const struct {
        uint32_t step; // every so many pixels of 120 000 one is off; 0: none
        double share;
        bool is_more;
        uint32_t least, most; // pixels that are traced again
    } cases[] = {
        {0, 0.001, false, 3700, 4000},    {0, 0.0005, false, 17400, 18000},
        {0, 0, false, 120000, 120000},    {20, 0.001, true, 3700, 4000},
        {60000, 0, true, 3700, 120000},   {1100, 0.001, false, 11000, 120000},
        {900, 0.001, true, 3700, 120000}, {90, 0.01, true, 3700, 120000},
        {110, 0.01, false, 3700, 120000},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct fixture f;
        open_picture(&f, 400, 300, 1);
        if (cases[i].step)
            spoil_each(&f.image, cases[i].step);
        const struct audit audit =
            take_for(&f, (struct audit_wish){.share = cases[i].share, .decides = true});
        assert_true((audit.bound > cases[i].share) == cases[i].is_more);
        assert_true((audit.floor > cases[i].share) == cases[i].is_more);
        assert_in_range(audit.pixels, cases[i].least, cases[i].most);
        assert_int_equal(audit.whole, audit.pixels == 120000);
        close_picture(&f);
    }
}

// With the reference of a trial: nothing but the time differs.
static void test_given_reference(void **state) {
    (void)state;
    struct fixture f;
    open_picture(&f, 160, 120, 1);
    spoil_each(&f.image, 300);
    struct view aside = f.view;
    view_turn_aside(&aside.camera);
    const struct reference_input input = {.scene = &f.session.resolved, .view = &aside};
    struct reference *reference = reference_create(&input);
    assert_non_null(reference);
    const struct audit own = take(&f);
    const struct audit turned =
        take_for(&f, (struct audit_wish){.reference = reference, .share = AUDIT_SHARE});
    assert_true(turned.off > own.off); // it looks elsewhere
    reference_look(reference, &f.view);
    const struct audit given =
        take_for(&f, (struct audit_wish){.reference = reference, .share = AUDIT_SHARE});
    assert_int_equal(own.off, given.off);
    assert_int_equal(own.pixels, given.pixels);
    assert_true(own.bound == given.bound && own.x == given.x && own.y == given.y);
    reference_destroy(reference);
    close_picture(&f);
}

static bool stop(void *context, double fraction) {
    (void)fraction;
    return --*(int *)context > 0;
}

static void test_cancelled(void **state) {
    (void)state;
    struct fixture f;
    int left = 2;
    struct audit audit;
    const struct render_progress progress = {stop, &left};
    const struct audit_wish wish = {.share = AUDIT_SHARE};
    open_picture(&f, 160, 120, 1);
    assert_int_equal(audit_take(&f.session, &f.view, &f.image, &wish, &progress, &audit), SHOT_CANCELLED);
    assert_int_equal(left, 0);
    close_picture(&f);
}

static void test_words(void **state) {
    (void)state;
    struct strbuf text;
    strbuf_init(&text);
    audit_words(&(struct audit){.pixels = 3003, .off = 2, .bound = 0.0020955}, &text);
    assert_string_equal(text.data,
                        "at most 0.21 % of the pixels are off by more than 1/255 (95 % sure): 2 of "
                        "3003 traced again in double precision");
    strbuf_clear(&text);
    audit_words(&(struct audit){.pixels = 1200, .off = 3, .whole = true, .bound = 0.0025}, &text);
    assert_string_equal(text.data,
                        "0.25 % of the pixels are off by more than 1/255: 3 of all 1200, traced again "
                        "in double precision");
    strbuf_finish(&text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bound),   cmocka_unit_test(test_right),
        cmocka_unit_test(test_small),   cmocka_unit_test(test_spread),
        cmocka_unit_test(test_jitter),  cmocka_unit_test(test_cancelled),
        cmocka_unit_test(test_words),   cmocka_unit_test(test_second_look),
        cmocka_unit_test(test_decided), cmocka_unit_test(test_given_reference),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
