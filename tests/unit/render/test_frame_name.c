// Names of files with a frame's number.
#include "render/frames/frame_name.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static void names(void **state) {
    static const struct {
        const char *pattern, *name; // NULL: refused
    } rows[] = {{"a.png", "a.png"},
                {"a.%d.png", "a.7.png"},
                {"%04d", "0007"},
                {"%%%2d%%", "%07%"},
                {"%d/%03d.%d", "7/007.7"},
                {"", ""},
                {"100%", NULL},
                {"%s", NULL},
                {"%-4d", NULL},
                {"%+d", NULL},
                {"% d", NULL},
                {"%10d", NULL},
                {"%99999999999999d", NULL},
                {"%04", NULL},
                {"%4294967300d", NULL}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct strbuf out;
        strbuf_init(&out);
        const bool good = frame_name(rows[i].pattern, 7, &out);
        if (good != (rows[i].name != NULL) || (good && !str_equal_cstr(strbuf_view(&out), rows[i].name)))
            fail_msg("%s", rows[i].pattern);
        strbuf_finish(&out);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(names)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
