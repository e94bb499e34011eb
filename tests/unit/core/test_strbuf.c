#include "core/strbuf.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static void appends_in_every_way(void **state) {
    (void)state;
    struct strbuf buffer;
    strbuf_init(&buffer);
    assert_int_equal(strbuf_view(&buffer).len, 0);
    assert_string_equal(strbuf_view(&buffer).ptr, "");
    strbuf_add(&buffer, "ab\0", 3);
    strbuf_str(&buffer, STR("cd"));
    strbuf_cstr(&buffer, "ef");
    strbuf_char(&buffer, 'g');
    strbuf_repeat(&buffer, '.', 3);
    strbuf_format(&buffer, "%d%%", 7);
    strbuf_add(&buffer, NULL, 0);
    strbuf_repeat(&buffer, '!', 0);
    assert_int_equal(buffer.len, 13);
    assert_memory_equal(buffer.data, "ab\0cdefg...7%", 14);
    assert_false(buffer.failed);
    strbuf_finish(&buffer);
    strbuf_finish(NULL);
}

static void escapes_markup_alone(void **state) {
    (void)state;
    struct strbuf buffer;
    strbuf_init(&buffer);
    strbuf_markup(&buffer, STR(""));
    strbuf_markup(&buffer, STR("a<b>&\"c\"'\n;\xC3\xA4&amp;"));
    assert_string_equal(buffer.data, "a&lt;b&gt;&amp;&quot;c&quot;'\n;\xC3\xA4&amp;amp;");
    strbuf_finish(&buffer);
}

// The vectors of RFC 4648, section 10.
static void codes_bytes_as_text(void **state) {
    (void)state;
    static const char *const texts[] = {
        "",     "",     "f",        "Zg==",  "fo",       "Zm8=",   "foo",
        "Zm9v", "foob", "Zm9vYg==", "fooba", "Zm9vYmE=", "foobar", "Zm9vYmFy"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i += 2) {
        struct strbuf buffer;
        strbuf_init(&buffer);
        strbuf_base64(&buffer, str_from(texts[i]));
        assert_string_equal(strbuf_view(&buffer).ptr, texts[i + 1]);
        strbuf_finish(&buffer);
    }
}

static void grows_far(void **state) {
    (void)state;
    struct strbuf buffer;
    strbuf_init(&buffer);
    for (int i = 0; i < 100000; i++)
        strbuf_char(&buffer, (char)('a' + i % 26));
    assert_int_equal(buffer.len, 100000);
    for (int i = 0; i < 100000; i++)
        assert_int_equal(buffer.data[i], 'a' + i % 26);
    strbuf_format(&buffer, "%*s", 50000, "");
    assert_int_equal(buffer.len, 150000);
    assert_int_equal(buffer.data[150000], '\0');
    strbuf_finish(&buffer);
}

static void clear_keeps_memory(void **state) {
    (void)state;
    struct strbuf buffer;
    strbuf_init(&buffer);
    strbuf_clear(&buffer);
    strbuf_cstr(&buffer, "text");
    char *data = buffer.data;
    strbuf_clear(&buffer);
    assert_int_equal(buffer.len, 0);
    assert_string_equal(buffer.data, "");
    strbuf_cstr(&buffer, "x");
    assert_ptr_equal(buffer.data, data);
    strbuf_finish(&buffer);
    assert_null(buffer.data);
}

static void cap_stops_whole_appends(void **state) {
    (void)state;
    struct strbuf buffer;
    strbuf_init(&buffer);
    buffer.cap_bytes = 10;
    strbuf_cstr(&buffer, "12345");
    strbuf_cstr(&buffer, "6789");
    assert_false(buffer.failed);
    assert_true(buffer.capacity <= 10);
    strbuf_char(&buffer, 'x');
    assert_true(buffer.failed);
    assert_string_equal(buffer.data, "123456789");
    // Nothing is appended after a gap.
    strbuf_clear(&buffer);
    strbuf_char(&buffer, 'y');
    strbuf_format(&buffer, "%d", 1);
    strbuf_repeat(&buffer, 'z', 1);
    assert_string_equal(buffer.data, "");
    assert_true(buffer.failed);
    strbuf_finish(&buffer);
}

static void sizes_that_overflow_fail(void **state) {
    (void)state;
    struct strbuf buffer;
    strbuf_init(&buffer);
    strbuf_char(&buffer, 'a');
    strbuf_repeat(&buffer, 'b', SIZE_MAX);
    assert_true(buffer.failed);
    assert_string_equal(buffer.data, "a");
    strbuf_finish(&buffer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(appends_in_every_way),     cmocka_unit_test(escapes_markup_alone),
        cmocka_unit_test(codes_bytes_as_text),      cmocka_unit_test(grows_far),
        cmocka_unit_test(clear_keeps_memory),       cmocka_unit_test(cap_stops_whole_appends),
        cmocka_unit_test(sizes_that_overflow_fail),
    };
    return cmocka_run_group_tests_name("strbuf", tests, NULL, NULL);
}
