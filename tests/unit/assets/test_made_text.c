// Text: closed for every letter of every font that is installed, aligned, and refused with its place.
#include "made_kit.h"

#include <dirent.h>

static struct made_kit kit;

#define FONTS "/usr/share/fonts/truetype"

static char *read_file(const char *path, size_t *size) {
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    fseek(file, 0, SEEK_END);
    *size = (size_t)ftell(file);
    rewind(file);
    char *bytes = malloc(*size + 1);
    if (!bytes || fread(bytes, 1, *size, file) != *size)
        *size = 0;
    fclose(file);
    return bytes;
}

static struct made_text text_of(str font, const char *text) {
    return (struct made_text){
        .text = str_from(text), .font = font, .height = 1, .depth = 0.25, .tolerance = MADE_TOLERANCE};
}

static bool build(struct made_text text) {
    const struct made_to to = made_kit_to(&kit);
    return made_build_text(&text, &to, &kit.made);
}

static void encode(uint32_t c, char out[5]) {
    if (c < 0x80) {
        snprintf(out, 5, "%c", (int)c);
    } else if (c < 0x800) {
        snprintf(out, 5, "%c%c", (int)(0xC0 | c >> 6), (int)(0x80 | (c & 0x3F)));
    } else {
        snprintf(out, 5, "%c%c%c", (int)(0xE0 | c >> 12), (int)(0x80 | (c >> 6 & 0x3F)),
                 (int)(0x80 | (c & 0x3F)));
    }
}

struct counts {
    uint32_t fonts, glyphs, missing, empty, bevelled;
};

static void try_letter(str font, uint32_t c, struct counts *counts) {
    char bytes[5];
    encode(c, bytes);
    struct made_text text = text_of(font, bytes);
    if (build(text)) {
        made_kit_closed(&kit, true);
        assert_true(kit.mesh.volume > 0);
        counts->glyphs++;
        text.bevel = 0.005;
        if (build(text)) {
            counts->bevelled++;
            made_kit_closed(&kit, true);
        } else {
            assert_int_equal(kit.made.fault.code, MADE_BEVEL);
        }
    } else if (kit.made.fault.code == MADE_GLYPH) {
        counts->missing++;
    } else if (kit.made.fault.code == MADE_TEXT_EMPTY) {
        counts->empty++;
    } else {
        fail_msg("U+%04X: %s", (unsigned)c, kit.made.fault.text);
    }
}

static void try_font(const char *path, struct counts *counts) {
    static const uint32_t ranges[][2] = {{0x20, 0x7E}, {0xA0, 0xFF}, {0x370, 0x3FF}, {0x400, 0x45F}};
    size_t size;
    char *bytes = read_file(path, &size);
    if (!bytes)
        return;
    counts->fonts++;
    for (int r = 0; r < 4; r++)
        for (uint32_t c = ranges[r][0]; c <= ranges[r][1]; c++)
            try_letter((str){bytes, size}, c, counts);
    free(bytes);
}

static bool few;

static void walk(const char *folder, struct counts *counts) {
    DIR *directory = opendir(folder);
    struct dirent *entry;
    while (directory && (entry = readdir(directory)) != NULL) {
        char path[1024];
        if (entry->d_name[0] == '.' || (few && counts->fonts > 0))
            continue;
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (strstr(entry->d_name, ".ttf") || strstr(entry->d_name, ".otf"))
            try_font(path, counts);
        else
            walk(path, counts);
    }
    if (directory)
        closedir(directory);
}

static void test_all_fonts(void **state) {
    (void)state;
    struct counts counts = {0};
    if (!made_has_fonts())
        skip();
    walk(FONTS, &counts);
    printf("%u fonts: %u glyphs closed, %u not in the font, %u empty; %u of them closed with a bevel\n",
           counts.fonts, counts.glyphs, counts.missing, counts.empty, counts.bevelled);
    if (counts.fonts == 0)
        skip();
}

// The font of the scenes: whatever is written in it is closed, with bevels too.
static void test_scenes_font(void **state) {
    (void)state;
    if (!made_has_fonts())
        skip();
    struct counts counts = {0};
    try_font("scenes/meshes/round.ttf", &counts);
    assert_int_equal(counts.fonts, 1);
    assert_true(counts.glyphs > 70 && counts.bevelled == counts.glyphs);
}

// ---- one font

static str one_font(void) {
    static const char *const names[] = {FONTS "/dejavu/DejaVuSans.ttf",
                                        FONTS "/liberation/LiberationSans-Regular.ttf"};
    size_t size = 0;
    char *bytes = NULL;
    for (int i = 0; i < 2 && !bytes; i++)
        bytes = read_file(names[i], &size);
    if (!bytes || !made_has_fonts())
        skip();
    return (str){bytes, size};
}

static void test_layout(void **state) {
    (void)state;
    const str font = one_font();
    made_kit_closed(&kit, build(text_of(font, "H")));
    assert_true(kit.mesh.upper.y == 1 && kit.mesh.lower.y == 0 && kit.mesh.lower.x > 0);
    assert_true(kit.mesh.lower.z == 0 && kit.mesh.upper.z == 0.25);
    const double left = kit.mesh.lower.x, right = kit.mesh.upper.x;
    struct made_text text = text_of(font, "H\nHH");
    made_kit_closed(&kit, build(text));
    assert_true(kit.mesh.upper.y == 1 && kit.mesh.lower.y < -0.3 && kit.mesh.lower.x == left);
    text.text = STR("H");
    text.align = MADE_ALIGN_RIGHT;
    made_kit_closed(&kit, build(text));
    assert_true(fabs(kit.mesh.upper.x + left) < 0.05 && kit.mesh.lower.x < 0);
    text.align = MADE_ALIGN_CENTER;
    made_kit_closed(&kit, build(text));
    assert_true(fabs(kit.mesh.upper.x + kit.mesh.lower.x) < 0.05);
    assert_true(fabs(kit.mesh.upper.x - kit.mesh.lower.x - (right - left)) < 1e-12);
    // Kerning moves letters together.
    made_kit_closed(&kit, build(text_of(font, "A")));
    const double first = kit.mesh.upper.x;
    made_kit_closed(&kit, build(text_of(font, "AV")));
    const double pair = kit.mesh.upper.x;
    made_kit_closed(&kit, build(text_of(font, "V")));
    assert_true(pair < first + kit.mesh.upper.x);
    free((char *)font.ptr);
}

static void test_faults(void **state) {
    (void)state;
    const str font = one_font();
    made_kit_refused(&kit, build(text_of(font, "ab\xF0\x9F\x82\xFF")), MADE_TEXT);
    assert_int_equal(kit.made.fault.points[0], 2);
    made_kit_refused(&kit, build(text_of(font, "a\xC3\xA4 \xE4\xB8\x80")), MADE_GLYPH);
    assert_int_equal(kit.made.fault.points[0], 4);
    printf("%s\n", kit.made.fault.text);
    made_kit_refused(&kit, build(text_of(font, " \n ")), MADE_TEXT_EMPTY);
    made_kit_refused(&kit, build(text_of(font, "")), MADE_TEXT_EMPTY);
    made_kit_refused(&kit, build(text_of(STR("no font"), "a")), MADE_FONT);
    struct made_text text = text_of(font, "a");
    text.bevel = 0.12;
    made_kit_refused(&kit, build(text), MADE_BEVEL);
    printf("%s\n", kit.made.fault.text);
    text.depth = 0;
    made_kit_refused(&kit, build(text), MADE_RANGE);
    free((char *)font.ptr);
}

// A font of this repository: letters of overlapping boxes and of curves, with kerning.
static void test_overlaps(void **state) {
    (void)state;
    size_t size;
    char *bytes = read_file("tests/fuzz/seeds/font/letters.ttf", &size);
    if (!bytes || !made_has_fonts()) {
        free(bytes);
        skip();
    }
    const str font = {bytes, size};
    made_kit_closed(&kit, build(text_of(font, "H")));
    // Two boxes of 100 by 400 and one of 100 by 100 between them, at 400 units for a height of 1.
    assert_true(fabs(kit.mesh.volume - 0.25 * 90000 / 160000) < 1e-12);
    assert_true(fabs(made_kit_surface(&kit.mesh) - (2 * 90000 / 160000.0 + 0.25 * 2000 / 400)) < 1e-12);
    made_kit_closed(&kit, build(text_of(font, "AH")));
    assert_true(kit.mesh.upper.x == (420 - 40 + 300) / 400.0);
    struct made_text text = text_of(font, "HAH\nA A");
    text.bevel = 0.05;
    made_kit_closed(&kit, build(text));
    free(bytes);
}

// Where memory ends, the font is closed, and the fault goes on to the caller.
struct small {
    struct arena *arena;
    str font;
};

static void run_small(void *context) {
    const struct small *small = context;
    const struct made_to to = {small->arena, UINT32_MAX};
    const struct made_text text = text_of(small->font, "Gauge");
    made_build_text(&text, &to, &kit.made);
}

static void test_small_memory(void **state) {
    (void)state;
    struct small small = {NULL, one_font()};
    uint32_t ended = 0;
    for (size_t cap = 0; cap < (1 << 20); cap += 9973) {
        struct arena arena;
        arena_init(&arena, cap);
        small.arena = &arena;
        ended += arena_guarded(&arena, run_small, &small) == ARENA_FAULT_CAP;
        arena_finish(&arena);
    }
    assert_true(ended > 10);
    free((char *)small.font.ptr);
}

// Damaged fonts: any answer, and no harm.
static void test_damaged(void **state) {
    (void)state;
    const str font = one_font();
    uint64_t random = 5;
    char *bytes = malloc(font.len);
    uint32_t built = 0;
    const int trials = few ? 60 : 600;
    for (int i = 0; i < trials; i++) {
        memcpy(bytes, font.ptr, font.len);
        for (int k = 0; k < 1 << i % 12; k++)
            bytes[random_bits(&random) % font.len] = (char)random_bits(&random);
        for (int k = 0; k < 3; k++) // and in the tables at its beginning
            bytes[random_bits(&random) % (i % 2 ? 400 : font.len)] = (char)random_bits(&random);
        const str damaged = {bytes, i % 7 ? font.len : font.len / 2};
        if (!build(text_of(damaged, "Glint: 0.5 &@")))
            continue;
        made_kit_closed(&kit, true);
        built++;
    }
    printf("damaged fonts: %u of %d still give a text\n", built, trials);
    free(bytes);
    free((char *)font.ptr);
}

static void test_speed(void **state) {
    (void)state;
    const str font = one_font();
    char letters[1026];
    uint32_t at = 0;
    for (uint32_t i = 0; at < 1020; i++) {
        letters[at++] = (char)('!' + i * 7 % 94);
        if (i % 40 == 39)
            letters[at++] = '\n';
    }
    letters[at] = 0;
    const double begin = made_kit_ms();
    const bool done = build(text_of(font, letters));
    const double took = made_kit_ms() - begin;
    made_kit_closed(&kit, done);
    printf("text: 1000 letters, %u triangles in %.1f ms\n", kit.mesh.triangle_count, took);
    assert_true(took < 20000);
    struct made_text text = text_of(font, letters);
    text.tolerance = 1e-4;
    made_kit_closed(&kit, build(text));
    free((char *)font.ptr);
}

static int finish(void **state) {
    (void)state;
    made_kit_finish(&kit);
    return 0;
}

int main(int argc, char **argv) {
    few = argc > 1 && strcmp(argv[1], "few") == 0;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_layout),       cmocka_unit_test(test_faults),
        cmocka_unit_test(test_all_fonts),    cmocka_unit_test(test_scenes_font),
        cmocka_unit_test(test_small_memory), cmocka_unit_test(test_overlaps),
        cmocka_unit_test(test_damaged),      cmocka_unit_test(test_speed),
    };
    return cmocka_run_group_tests(tests, NULL, finish);
}
