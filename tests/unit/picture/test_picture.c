// Images: every kind that is read, what is ignored, and files that lie about themselves.
#include "diag/codes/limit.h"
#include "picture/read/picture_read.h"

#include "assets_scene.h"
#include "png_kit.h"

#include <math.h>
#include <stdio.h>

// ---- scenes with a background

static const struct picture *load(struct assets_scene *s, const char *name, const struct strbuf *file) {
    assets_scene_bytes(s, name, file->data, file->len);
    assets_scene_background(s, name);
    assets_scene_load(s);
    return s->assets.background;
}

static void expect_fault(const struct strbuf *file, const char *message) {
    struct assets_scene *s = assets_scene_begin();
    assert_null(load(s, "sky.png", file));
    assert_says(s, message);
    assert_int_equal(s->sink.count, 1);
    assets_scene_end(s);
}

static void assert_pixel(const struct picture *picture, uint32_t x, uint32_t y, int r, int g, int b,
                         int tolerance) {
    const uint8_t *p = (const uint8_t *)picture->pixels + 3 * ((size_t)y * picture->width + x);
    if (abs(p[0] - r) > tolerance || abs(p[1] - g) > tolerance || abs(p[2] - b) > tolerance)
        fail_msg("pixel %u %u is %d %d %d, not %d %d %d", x, y, p[0], p[1], p[2], r, g, b);
}

static void png_of_8_bits(void **state) {
    (void)state;
    struct strbuf file;
    strbuf_init(&file);
    png_put_header(&file, 2, 2, 8, 2, 0);
    png_put_rows(&file, "\0\1\2\3\4\5\6\0\xFF\xFE\xFD\0\0\x80", 14);
    struct assets_scene *s = assets_scene_begin();
    const struct picture *picture = load(s, "sky.anything", &file);
    assert_silent(s);
    assert_int_equal(picture->width, 2);
    assert_int_equal(picture->height, 2);
    assert_int_equal(picture->depth, PICTURE_8);
    assert_int_equal(picture->size_bytes, 12);
    assert_memory_equal(picture->pixels, "\1\2\3\4\5\6\xFF\xFE\xFD\0\0\x80", 12);
    assets_scene_end(s);
    strbuf_finish(&file);
}

static void png_of_16_bits(void **state) {
    (void)state;
    struct strbuf file;
    strbuf_init(&file);
    png_put_header(&file, 1, 2, 16, 0, 0);
    png_put_rows(&file, "\0\x12\x34\0\xFF\xFF", 6);
    struct assets_scene *s = assets_scene_begin();
    const struct picture *picture = load(s, "sky.png", &file);
    assert_silent(s);
    assert_int_equal(picture->depth, PICTURE_16);
    const uint16_t expected[] = {0x1234, 0x1234, 0x1234, 0xFFFF, 0xFFFF, 0xFFFF};
    assert_memory_equal(picture->pixels, expected, sizeof expected);
    assets_scene_end(s);
    strbuf_finish(&file);
}

static void real_files(void **state) {
    (void)state;
    static const struct {
        const char *path;
        uint32_t width, height;
        struct {
            uint32_t x, y;
            int r, g, b, tolerance;
        } pixels[2];
    } cases[] = {
        {"tests/data/image/interlaced.png", 9, 5, {{3, 0, 255, 0, 0, 0}, {8, 4, 0, 0, 255, 0}}},
        {"tests/data/image/palette.png", 4, 3, {{0, 0, 0x33, 0x66, 0xCC, 0}, {3, 2, 0x33, 0x66, 0xCC, 0}}},
        {"tests/data/image/gray.jpg", 16, 8, {{0, 0, 128, 128, 128, 0}, {15, 7, 128, 128, 128, 0}}},
        {"tests/data/image/progressive.jpg", 8, 16, {{0, 0, 254, 0, 0, 2}, {7, 15, 0, 0, 254, 2}}},
        {"tests/fuzz/seeds/image/cmyk.jpg", 8, 8, {{0, 0, 250, 217, 250, 2}, {3, 6, 2, 25, 62, 2}}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct assets_scene *s = assets_scene_begin();
        assets_scene_background(s, cases[i].path);
        assets_scene_load(s);
        const struct picture *picture = s->assets.background;
        assert_silent(s);
        assert_int_equal(picture->width, cases[i].width);
        assert_int_equal(picture->height, cases[i].height);
        for (int k = 0; k < 2; k++)
            assert_pixel(picture, cases[i].pixels[k].x, cases[i].pixels[k].y, cases[i].pixels[k].r,
                         cases[i].pixels[k].g, cases[i].pixels[k].b, cases[i].pixels[k].tolerance);
        assets_scene_end(s);
    }
}

static void what_is_ignored_is_one_note(void **state) {
    (void)state;
    static const struct {
        const char *chunk;
        char color;
        const char *note;
    } cases[] = {{NULL, 6, "the image's alpha is ignored [N601]"},
                 {"gAMA", 2, "the image's colour profile is ignored [N601]"},
                 {"iCCP", 6, "the image's alpha and colour profile are ignored [N601]"},
                 {"tRNS", 2, "the image's alpha is ignored [N601]"},
                 {"sRGB", 2, NULL}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct strbuf file;
        strbuf_init(&file);
        png_put_header(&file, 1, 1, 8, cases[i].color, 0);
        if (cases[i].chunk)
            png_put_chunk(&file, cases[i].chunk, "\0\0\0\0\0\0", 6);
        png_put_rows(&file, "\0\1\2\3\xFF", cases[i].color == 6 ? 5 : 4);
        struct assets_scene *s = assets_scene_begin();
        assert_non_null(load(s, "sky.png", &file));
        if (cases[i].note) {
            assert_int_equal(s->sink.count, 1);
            assert_says(s, "sky.png:1:1: note: ");
            assert_says(s, cases[i].note);
            assert_says(s, "scene.yaml:1:8: note: the image is named here");
        } else {
            assert_silent(s);
        }
        assets_scene_end(s);
        strbuf_finish(&file);
    }
}

static void broken_png_files(void **state) {
    (void)state;
    struct strbuf file;
    strbuf_init(&file);
    png_put_header(&file, 2, 2, 8, 2, 0);
    png_put_rows(&file, "\0\1\2\3\4\5\6\0\xFF\xFE\xFD\0\0\x80", 14);
    size_t whole = file.len;
    file.len = whole - 3;
    expect_fault(
        &file, "sky.png:1:1: error: the image cannot be decoded: the file ends before its end chunk [E620]");
    file.len = whole - 20;
    expect_fault(&file, "the file ends within a chunk [E620]");
    file.len = 12;
    expect_fault(&file, "the file ends before the first chunk [E620]");
    file.len = whole;
    file.data[whole - 25] ^= 1;
    expect_fault(&file, "a chunk's checksum is wrong: the file is damaged [E620]");
    expect_fault(&file, "scene.yaml:1:8: note: the image is named here");
    strbuf_finish(&file);

    strbuf_init(&file);
    png_put_header(&file, 2, 2, 8, 2, 0);
    png_put_rows(&file, "\0\1\2\3\4\5\6", 7);
    expect_fault(&file, "the image cannot be decoded: ");
    strbuf_finish(&file);

    strbuf_init(&file);
    png_put_header(&file, 0, 2, 8, 2, 0);
    png_put_rows(&file, "", 0);
    expect_fault(&file, "its width or height is 0");
    strbuf_finish(&file);
}

// Three bytes a pixel, four for the device; four rows of four channels and a megabyte for the decoder.
static void too_many_bytes_are_refused_before_decoding(void **state) {
    (void)state;
    static const struct {
        uint32_t width, height;
        const char *bytes, *help;
    } cases[] = {
        {65535, 65535, "30065950711", "--limit image-memory=30065950711"},
        {20000, 20000, "2801368576", "--limit image-memory=2801368576"},
        {INT32_MAX, INT32_MAX, "18446744073709551615", "no limit allows more than 1099511627776 bytes"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct strbuf file;
        strbuf_init(&file);
        png_put_header(&file, cases[i].width, cases[i].height, 8, 2, 0);
        png_put_rows(&file, "\0\1\2\3", 4);
        char message[256];
        snprintf(message, sizeof message,
                 "scene.yaml:1:8: error: the image 'sky.png' claims %u x %u pixels, which take %s bytes of "
                 "memory; the limit image-memory is 2147483648 [E501]",
                 cases[i].width, cases[i].height, cases[i].bytes);
        expect_fault(&file, message);
        expect_fault(&file, cases[i].help);
        strbuf_finish(&file);
    }
}

// What a small file may take is said before anything is decoded; 16 bits take as many bytes as they have, and
// sixteen for the device.
static void small_files_take_little_memory(void **state) {
    (void)state;
    static const struct {
        uint32_t side;
        int bits;
        const char *bytes; // NULL: fits
    } cases[] = {{8192, 8, "470941696"}, {8192, 16, "1477705728"}, {5920, 8, NULL}, {3372, 16, NULL}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct strbuf file;
        char message[256];
        strbuf_init(&file);
        png_put_header(&file, cases[i].side, cases[i].side, cases[i].bits, 2, 0);
        png_put_rows(&file, "\0\1\2\3", 4);
        snprintf(
            message, sizeof message,
            "with the image 'sky.png' the images take %s bytes of memory, and their files have %zu bytes; "
            "the limit image-growth is 251658240, or 200 for each byte of the files [E501]",
            cases[i].bytes ? cases[i].bytes : "", file.len);
        expect_fault(&file, cases[i].bytes ? message : "the image cannot be decoded");
        strbuf_finish(&file);
    }
}

// What is known of a file does not depend on the limit that it was read under.
static void a_limit_holds_for_what_is_known(void **state) {
    (void)state;
    struct asset_store *store = asset_store_create();
    struct strbuf file;
    strbuf_init(&file);
    png_put_header(&file, 1, 1, 8, 2, 0);
    png_put_rows(&file, "\0\1\2\3", 4);
    for (int lowered = 0; lowered < 2; lowered++) {
        struct assets_scene *s = assets_scene_begin_in(store);
        s->limits.value[LIMIT_IMAGE_MEMORY] = lowered ? 1000 : 2000000;
        assert_true((load(s, "sky.png", &file) == NULL) == lowered);
        assert_int_equal(assets_scene_count(s, DIAG_LIMIT), lowered);
        assets_scene_end(s);
    }
    asset_store_destroy(store);
    strbuf_finish(&file);
}

// Puts bits, lowest first; a Huffman code comes with its bits turned round.
struct bits {
    struct strbuf *out;
    uint32_t held;
    int count;
};

static void put_bits(struct bits *b, uint32_t value, int count) {
    b->held |= value << b->count;
    b->count += count;
    for (; b->count >= 8; b->count -= 8, b->held >>= 8)
        strbuf_char(b->out, (char)(b->held & 0xFF));
}

// One pixel, whose data inflate to 256 MB of zeros.
static void a_small_file_does_not_become_large(void **state) {
    (void)state;
    struct strbuf file, data;
    strbuf_init(&file);
    strbuf_init(&data);
    strbuf_add(&data, "\x78\x01", 2);
    struct bits b = {.out = &data};
    put_bits(&b, 3, 3);    // last block, fixed codes
    put_bits(&b, 0x0C, 8); // literal 0: 00110000
    for (int i = 0; i < 1040000; i++)
        put_bits(&b, 0xA3, 13); // length 258: 11000101, distance 1: 00000
    put_bits(&b, 0, 7 + 8);
    strbuf_add(&data, "\0\0\0\0", 4);
    png_put_header(&file, 1, 1, 8, 2, 0);
    png_put_chunk(&file, "IDAT", data.data, data.len);
    png_put_chunk(&file, "IEND", NULL, 0);
    expect_fault(&file, "sky.png:1:1: error: the image cannot be decoded: it has more data than a picture "
                        "of its size needs [E620]");
    strbuf_finish(&data);
    strbuf_finish(&file);
}

static void read_file(struct strbuf *out, const char *path) {
    FILE *stream = fopen(path, "rb");
    assert_non_null(stream);
    char bytes[4096];
    size_t size = fread(bytes, 1, sizeof bytes, stream);
    fclose(stream);
    strbuf_add(out, bytes, size);
}

static void broken_jpeg_files(void **state) {
    (void)state;
    struct strbuf file;
    strbuf_init(&file);
    read_file(&file, "tests/data/image/gray.jpg");
    size_t whole = file.len;
    file.len = whole - 2;
    expect_fault(&file, "the file ends within the picture [E620]");
    file.len = 30;
    expect_fault(&file, "the file ends within a segment [E620]");
    file.len = 3;
    expect_fault(&file, "the file ends before the picture [E620]");
    file.len = whole;
    file.data[0x80] = 0x11; // number and kind of the second Huffman table
    expect_fault(&file, "a scan uses a table that the file does not have [E620]");
    file.data[0x80] = 0x10;
    file.data[0x5F] = 64; // rows, of which the data hold eight
    file.data[0x9C] = 0;
    expect_fault(&file, "the data of a scan end too early [E620]");
    file.data[2] = 'x';
    expect_fault(&file,
                 "scene.yaml:1:8: error: 'sky.png' is not a PNG, JPEG, OpenEXR or Radiance HDR image [E621]");
    strbuf_finish(&file);
}

static void a_jpeg_of_many_scans_is_refused(void **state) {
    (void)state;
    struct strbuf file;
    strbuf_init(&file);
    read_file(&file, "tests/data/image/gray.jpg");
    file.len -= 10 + 1 + 2; // the scan's header, its data and the end marker
    for (int i = 0; i < 501; i++)
        strbuf_add(&file, "\xFF\xDA\0\x08\1\1\0\0\x3F\0", 10);
    strbuf_add(&file, "\xFF\xD9", 2);
    expect_fault(&file, "it has more than 500 scans [E620]");
    strbuf_finish(&file);
}

static void other_files_are_no_images(void **state) {
    (void)state;
    static const char *const texts[] = {"", "GIF89a", "BM", "glint: 1\n", "\x89PNG\r\n\x1A"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct strbuf file;
        strbuf_init(&file);
        strbuf_cstr(&file, texts[i]);
        expect_fault(
            &file,
            "scene.yaml:1:8: error: 'sky.png' is not a PNG, JPEG, OpenEXR or Radiance HDR image [E621]");
        strbuf_finish(&file);
    }
    struct assets_scene *s = assets_scene_begin();
    assets_scene_background(s, "no-such.png");
    assets_scene_load(s);
    assert_says(s, "scene.yaml:1:8: error: the image 'no-such.png' does not exist [E601]");
    assets_scene_end(s);
}

// ---- Radiance HDR

#define HDR_HEAD "#?RADIANCE\n# made by hand\nFORMAT=32-bit_rle_rgbe\n\n"

static const struct picture *load_hdr(struct assets_scene *s, const char *head, const void *pixels,
                                      size_t size) {
    struct strbuf file;
    strbuf_init(&file);
    strbuf_cstr(&file, head);
    strbuf_add(&file, pixels, size);
    str copy = arena_copy(&s->arena, strbuf_view(&file));
    strbuf_finish(&file);
    struct strbuf view = {.data = (char *)copy.ptr, .len = copy.len};
    const struct picture *picture = load(s, "sky.hdr", &view);
    if (picture)
        assert_int_equal(picture->depth, PICTURE_RGBE);
    return picture;
}

static void hdr_pixels_are_floats(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    // 128 is 1/2 of the exponent's power; exponents count from 128.
    const struct picture *p =
        load_hdr(s, HDR_HEAD "-Y 2 +X 2\n", "\x80\x40\x20\x81\xFF\0\0\x80\1\2\3\0\xFF\xFF\xFF\xFF", 16);
    assert_silent(s);
    const float expected[] = {1, 0.5f, 0.25f, 255.0f / 256, 0, 0, 0, 0, 0, 255 * 0x1p119f};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        assert_true(picture_linear(p, i / 3, i % 3) == expected[i]);
    for (int exponent = 0; exponent < 256; exponent++)
        assert_true(picture_rgbe_scale((uint8_t)exponent) == (exponent ? ldexpf(1, exponent - 136) : 0));
    assets_scene_end(s);
}

static void hdr_runs_are_read(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    // Width 8, by channel: a run of 8; then 3 different ones and a run of 5; a run of 8; the exponents.
    const struct picture *p =
        load_hdr(s, HDR_HEAD "-Y 1 +X 8\n", "\2\2\0\x08\x88\x80\3\x10\x20\x40\x85\x80\x88\0\x88\x81", 16);
    assert_silent(s);
    for (size_t x = 0; x < 8; x++) {
        static const float green[] = {0.125f, 0.25f, 0.5f, 1, 1, 1, 1, 1};
        assert_true(picture_linear(p, x, 0) == 1 && picture_linear(p, x, 1) == green[x] &&
                    picture_linear(p, x, 2) == 0);
    }
    assets_scene_end(s);
    s = assets_scene_begin();
    // The older form: a pixel, and that it comes 4 times more, over the end of no row.
    p = load_hdr(s, HDR_HEAD "-Y 1 +X 5\n", "\x80\x40\x20\x81\1\1\1\4", 8);
    assert_silent(s);
    assert_memory_equal((const uint8_t *)p->pixels + 16, "\x80\x40\x20\x81", 4);
    assets_scene_end(s);
}

static void hdr_lines_that_are_ignored(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    assert_non_null(load_hdr(s, "#?RGBE\r\nEXPOSURE=2\r\n\r\n-Y 1 +X 1\n", "\1\2\3\4", 4));
    assert_says(s, "sky.hdr:1:1: note: the image's exposure or colour lines are ignored [N601]");
    assets_scene_end(s);
}

static void broken_hdr_files(void **state) {
    (void)state;
    static const struct {
        const char *head;
        const char *pixels;
        size_t size;
        const char *message;
    } cases[] = {
        {"#?RADIANCE", "", 0, "the file ends within its header"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n", "", 0, "the file ends within its header"},
        {"#?RADIANCE\n\n", "", 0, "the file ends within its header"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", "\1\2\3\4", 4,
         "its format is not 32-bit_rle_rgbe"},
        {HDR_HEAD "+X 1 -Y 1\n", "\1\2\3\4", 4, "its size line is not of the form"},
        {HDR_HEAD "-Y 0 +X 1\n", "\1\2\3\4", 4, "its size line is not of the form"},
        {HDR_HEAD "-Y -1 +X 1\n", "\1\2\3\4", 4, "its size line is not of the form"},
        {HDR_HEAD "-Y 1 +X 12345678901\n", "\1\2\3\4", 4, "its size line is not of the form"},
        {HDR_HEAD "-Y 2 +X 1\n", "\2\2\3\4\5\6", 6, "its pixels are damaged"},
        {HDR_HEAD "-Y 1 +X 5\n", "\x80\x40\x20\x81\1\1\1\5", 8, "its pixels are damaged"},
        {HDR_HEAD "-Y 1 +X 5\n", "\1\1\1\5", 4, "its pixels are damaged"},
        {HDR_HEAD "-Y 1 +X 8\n", "\2\2\0\x09\x88\x80", 6, "its pixels are damaged"},
        {HDR_HEAD "-Y 1 +X 8\n", "\2\2\0\x08\x89\x80", 6, "its pixels are damaged"},
        {HDR_HEAD "-Y 1 +X 8\n", "\2\2\0\x08\0\0\0\0\0\0", 10, "its pixels are damaged"},
        {HDR_HEAD "-Y 1 +X 8\n", "\2\2\0\x08\x05\1\2", 7, "its pixels are damaged"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct assets_scene *s = assets_scene_begin();
        assert_null(load_hdr(s, cases[i].head, cases[i].pixels, cases[i].size));
        assert_says(s, cases[i].message);
        assert_int_equal(s->sink.errors, 1);
        assets_scene_end(s);
    }
    struct assets_scene *s = assets_scene_begin();
    assert_null(load_hdr(s, HDR_HEAD "-Y 999999999 +X 999999999\n", "", 0));
    assert_says(s, "claims 999999999 x 999999999 pixels");
    assets_scene_end(s);
}

// Every prefix, and every byte changed, of each kind: an error or a picture, never a crash, and the same
// error whether pixels are kept or not.
static void damaged_files_never_crash(void **state) {
    (void)state;
    static const char *const paths[] = {"tests/data/image/interlaced.png", "tests/data/image/palette.png",
                                        "tests/data/image/gray.jpg", "tests/data/image/progressive.jpg"};
    for (size_t i = 0; i < sizeof paths / sizeof paths[0]; i++) {
        struct strbuf file;
        strbuf_init(&file);
        read_file(&file, paths[i]);
        size_t whole = file.len;
        for (size_t at = 0; at < 9 * whole; at++) {
            // An own block of the exact size, so that reading beyond it is seen.
            size_t size = at < whole ? at : whole;
            char *bytes = malloc(size ? size : 1);
            memcpy(bytes, file.data, size);
            if (at >= whole)
                bytes[at % whole] = (char)(bytes[at % whole] ^ (1 << (at / whole - 1)));
            struct picture_header header;
            struct picture picture = {0};
            const char *fault = picture_read_header((str){bytes, size}, &header);
            if (!fault && header.kind != IMAGE_NONE && (uint64_t)header.width * header.height < 1000000) {
                const char *checked = picture_check((str){bytes, size}, &header);
                fault = picture_decode((str){bytes, size}, &header, &picture);
                assert_true(checked == fault || strcmp(checked, fault) == 0);
                assert_true(!fault == (picture.pixels != NULL));
            }
            picture_finish(&picture);
            free(bytes);
        }
        strbuf_finish(&file);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(png_of_8_bits),
        cmocka_unit_test(png_of_16_bits),
        cmocka_unit_test(real_files),
        cmocka_unit_test(what_is_ignored_is_one_note),
        cmocka_unit_test(broken_png_files),
        cmocka_unit_test(too_many_bytes_are_refused_before_decoding),
        cmocka_unit_test(small_files_take_little_memory),
        cmocka_unit_test(a_limit_holds_for_what_is_known),
        cmocka_unit_test(a_small_file_does_not_become_large),
        cmocka_unit_test(broken_jpeg_files),
        cmocka_unit_test(a_jpeg_of_many_scans_is_refused),
        cmocka_unit_test(other_files_are_no_images),
        cmocka_unit_test(hdr_pixels_are_floats),
        cmocka_unit_test(hdr_runs_are_read),
        cmocka_unit_test(hdr_lines_that_are_ignored),
        cmocka_unit_test(broken_hdr_files),
        cmocka_unit_test(damaged_files_never_crash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
