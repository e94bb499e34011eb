// A picture enlarged pixel by pixel, text dot by dot, and nothing outside the canvas.
#include "window/canvas.h"
#include "window/font.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const uint8_t *pixel(const struct canvas *canvas, uint32_t x, uint32_t y) {
    return canvas->pixels + 4 * ((size_t)y * canvas->width + x);
}

static void test_picture(void **state) {
    (void)state;
    static const uint8_t rgb[2 * 2 * 3] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    struct canvas canvas = {0};
    assert_true(canvas_resize(&canvas, 5, 4));
    canvas_put_picture(&canvas, rgb, 2, 2);
    for (uint32_t y = 0; y < 4; y++)
        for (uint32_t x = 0; x < 5; x++) {
            const uint8_t *from = rgb + 3 * (2 * (y / 2) + (2 * x / 5)), *to = pixel(&canvas, x, y);
            assert_true(to[0] == from[2] && to[1] == from[1] && to[2] == from[0] && to[3] == 255);
        }
    canvas_finish(&canvas);
    assert_null(canvas.pixels);
}

static void test_text(void **state) {
    (void)state;
    struct canvas canvas = {0};
    assert_true(canvas_resize(&canvas, 40, 30));
    canvas_put_text(&canvas, 3, 2, 2, 0x102030, STR("A"));
    for (uint32_t y = 0; y < 30; y++)
        for (uint32_t x = 0; x < 40; x++) {
            const bool inside = x >= 3 && y >= 2 && x < 3 + 2 * FONT_WIDTH && y < 2 + 2 * FONT_HEIGHT;
            const bool dot =
                inside && font_dots['A' - FONT_FIRST][(y - 2) / 2 * FONT_WIDTH + (x - 3) / 2] == '#';
            assert_memory_equal(pixel(&canvas, x, y), dot ? "\x30\x20\x10" : "\0\0\0", 3);
        }
    canvas_finish(&canvas);
}

// Text and boxes that do not fit; characters that the font lacks.
static void test_outside(void **state) {
    (void)state;
    const str lines[] = {STR("a line that is far longer than the canvas is wide"), STR("\xC3\xA9\x01")};
    struct canvas canvas = {0};
    assert_true(canvas_resize(&canvas, 17, 11));
    for (int below = 0; below < 2; below++)
        for (uint32_t scale = 1; scale < 4; scale++)
            canvas_put_lines(&canvas, lines, 2, scale, 0xffffff, below);
    canvas_put_text(&canvas, 16, 10, 3, 0xffffff, STR("#"));
    canvas_darken(&canvas, 10, 5, 100, 100);
    canvas_finish(&canvas);
}

static void test_font(void **state) {
    (void)state;
    for (int i = 0; i < FONT_COUNT; i++) {
        assert_int_equal(FONT_WIDTH * FONT_HEIGHT, strlen(font_dots[i]));
        assert_int_equal(FONT_WIDTH * FONT_HEIGHT, strspn(font_dots[i], "#."));
        for (int k = 0; k < i; k++)
            assert_string_not_equal(font_dots[i], font_dots[k]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_picture),
        cmocka_unit_test(test_text),
        cmocka_unit_test(test_outside),
        cmocka_unit_test(test_font),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
