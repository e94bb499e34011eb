// What a picture says of how it was made: words of a command there and back, and texts in files of any
// content.
#include "picture/read/texts.h"
#include "picture/write/image.h"
#include "render/record/record.h"
#include "render/record/words.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void words_come_back(void **state) {
    static const char *const words[] = {"plain",         "it's",  "two words", "",     "a\nb", "\xff\xfe",
                                        "W\xc3\xbcrfel", "$HOME", "'",         "a\\b", "\"",   "-",
                                        "x=1:2,3"};
    const uint32_t count = sizeof words / sizeof *words;
    struct arena arena;
    struct strbuf line;
    str rest, word;
    (void)state;
    arena_init(&arena, SIZE_MAX / 2);
    strbuf_init(&line);
    for (uint32_t i = 0; i < count; i++)
        words_add(&line, str_from(words[i]));
    for (size_t i = 0; i < line.len; i++)
        assert_true((unsigned char)line.data[i] >= 0x20);
    assert_true(utf8_first_error(strbuf_view(&line)) == line.len);
    rest = strbuf_view(&line);
    for (uint32_t i = 0; i < count; i++) {
        assert_true(words_take(&rest, &arena, &word));
        assert_true(str_equal_cstr(word, words[i]));
    }
    assert_false(words_take(&rest, &arena, &word));
    strbuf_finish(&line);
    arena_finish(&arena);
}

static void wrong_commands_are_refused(void **state) {
    static const char *const wrong[] = {"",
                                        "glint",
                                        "glint render",
                                        "glint check a.yaml --size 1x1 --samples 1",
                                        "glint render a.yaml",
                                        "glint render a.yaml --size 1x1",
                                        "glint render a.yaml --size 1 --samples 1",
                                        "glint render a.yaml --size 0x1 --samples 1",
                                        "glint render a.yaml --size 1x1 --samples 0",
                                        "glint render a.yaml --size 1x1 --samples 1 -o b.png",
                                        "glint render 'a.yaml --size 1x1 --samples 1",
                                        "glint render $'\\x4 --size 1x1 --samples 1",
                                        "glint render a.yaml --size 1x1 --samples 1 --device llvmpipe",
                                        "glint render a.yaml --size 1x1 --samples 1 --quality 101",
                                        "glint render a;b --size 1x1 --samples 1",
                                        "glint render a.yaml --size 1x1 --samples 1 --set",
                                        "glint render '' --size 1x1 --samples 1"};
    struct record_command command;
    struct arena arena;
    (void)state;
    arena_init(&arena, SIZE_MAX / 2);
    for (uint32_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        if (record_read_command(str_from(wrong[i]), &arena, &command))
            fail_msg("accepted: %s", wrong[i]);
    assert_true(record_read_command(
        STR("glint render a.yaml --size 2x3 --samples 4 --set 'a b=c' --set d=1 --audit"), &arena, &command));
    assert_int_equal(command.width, 2);
    assert_int_equal(command.height, 3);
    assert_int_equal(command.samples, 4);
    assert_int_equal(command.set_count, 2);
    assert_true(str_equal_cstr(command.sets[0], "a b=c"));
    assert_true(command.audit && !command.is_reference && command.max_off < 0);
    arena_finish(&arena);
}

// Every prefix of a file of each format gives texts of the whole, or the last one cut.
static void files_carry_texts(void **state) {
    static const enum image_format formats[] = {IMAGE_PNG, IMAGE_JPEG, IMAGE_EXR, IMAGE_HDR};
    static const struct image_text items[] = {{"Software", "glint 1"}, {"Scene hash", "W\xc3\xbcrfel"}};
    (void)state;
    for (uint32_t f = 0; f < sizeof formats / sizeof *formats; f++) {
        struct image image;
        struct strbuf file;
        struct picture_text found[8];
        if (image_format_missing(formats[f]))
            continue;
        strbuf_init(&file);
        assert_true(image_init(&image, 3, 2));
        image.note = "none";
        image.texts = (struct image_texts){items, 2};
        image_encode(&image, formats[f], (struct image_display){0}, &file);
        uint32_t most = 0;
        for (size_t length = 0; length <= file.len; length++) {
            char *part = malloc(length + 1); // so that a read beyond its end is seen
            memcpy(part, file.data, length);
            char *whole = realloc(part, length ? length : 1);
            const uint32_t count = picture_texts((str){whole, length}, found, 8);
            most = count > most ? count : most;
            free(whole);
        }
        assert_int_equal(most, picture_texts(strbuf_view(&file), found, 8));
        struct record_read read;
        record_find(strbuf_view(&file), &read);
        assert_true(str_equal_cstr(read.fields[RECORD_SOFTWARE], "glint 1"));
        assert_true(str_equal_cstr(read.fields[RECORD_SCENE], "W\xc3\xbcrfel"));
        assert_true(str_equal_cstr(read.note, "none"));
        assert_false(read.is_there); // no command
        assert_int_equal(picture_texts(strbuf_view(&file), found, 1), 1);
        strbuf_finish(&file);
        image_finish(&image);
    }
}

// Two records are of one picture, wherever the scene was; each other difference counts.
static void the_same_picture(void **state) {
    static const char line[] = "Software: glint 1\tScene hash: 12ab\tDevice: a: b\tSettings: 2 x 3 pixels\t"
                               "Command: glint render a.yaml --size 2x3 --samples 4";
    static const char *const others[][2] = {
        {"glint 1", "glint 2"},
        {"12ab", "12ac"},
        {"a: b", "a: c"},
        {"2 x 3", "2 x 4"},
        {"samples 4", "samples 4 --device reference"},
        {"samples 4", "samples 4 --depth 16"},
        {"samples 4", "samples 4 --noise 0.1"},
        {"samples 4", "samples 4 --quality 7"},
        {"samples 4", "samples four"},
        {"Command: ", "Order: "},
        {"samples 4", "samples 4\tScaled: 4x6"},
    };
    struct arena arena;
    struct record_read a, b;
    (void)state;
    arena_init(&arena, SIZE_MAX);
    record_of_line(str_from(line), &a);
    assert_true(a.is_there);
    assert_true(str_equal_cstr(a.fields[RECORD_DEVICE], "a: b"));
    record_of_line(STR("Software: glint 1\tScene hash: 12ab\tDevice: a: b\tSettings: 2 x 3 pixels\tCommand: "
                       "glint render 'other place/b.xml' --size 2x3 --samples 4 --asset-path x --audit"),
                   &b);
    assert_true(record_same(&a, &b, &arena));
    for (uint32_t i = 0; i < sizeof others / sizeof *others; i++) {
        const char *at = strstr(line, others[i][0]);
        const str text =
            arena_format(&arena, "%.*s%s%s", (int)(at - line), line, others[i][1], at + strlen(others[i][0]));
        record_of_line(text, &b);
        if (record_same(&a, &b, &arena) || record_same(&b, &a, &arena))
            fail_msg("the same: %s", text.ptr);
    }
    record_of_line(STR(""), &b);
    assert_false(b.is_there || record_same(&a, &b, &arena) || record_same(&b, &b, &arena));
    arena_finish(&arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_come_back),
        cmocka_unit_test(wrong_commands_are_refused),
        cmocka_unit_test(files_carry_texts),
        cmocka_unit_test(the_same_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
