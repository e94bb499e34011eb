// Generated valid scenes, written in both spellings: their pictures are the same, byte for byte.
//
// Usage: test_generated FOLDER_WITH_MESHES WORK_FOLDER FIRST_SEED SCENES
#include "picture_kit.h"

#include "files/output.h"
#include "grammar/print/ir_print.h"
#include "tests/generate/generate.h"

#include <stdio.h>
#include <stdlib.h>

enum {
    PATH_BYTES = 1024,
};

static bool write_twins(uint64_t seed, struct arena *arena, const char *yaml, const char *xml) {
    static const str meshes[] = {{"octahedron.obj", sizeof "octahedron.obj" - 1}};
    struct generate_options options = {.seed = seed, .renderable = true, .meshes = {meshes, 1}};
    const struct ir_scene *scene = generate_scene(&options, arena);
    struct strbuf text;
    strbuf_init(&text);
    ir_write_yaml(scene, NULL, NULL, (struct ir_write_options){0}, &text);
    int error = output_whole(yaml, text.data, text.len);
    strbuf_clear(&text);
    ir_write_xml(scene, NULL, NULL, (struct ir_write_options){0}, &text);
    error = error ? error : output_whole(xml, text.data, text.len);
    strbuf_finish(&text);
    return error == 0;
}

static bool check_seed(struct picture_kit *kit, uint64_t seed, const char *meshes, const char *work,
                       bool *shows) {
    char yaml[PATH_BYTES];
    char xml[PATH_BYTES];
    struct arena arena;
    struct image a = {0};
    struct image b = {0};
    struct picture_options options = {.width = 48, .height = 32, .samples = 1, .asset_path = meshes};
    snprintf(yaml, sizeof yaml, "%s/generated.yaml", work);
    snprintf(xml, sizeof xml, "%s/generated.xml", work);
    arena_init(&arena, (size_t)1 << 30);
    bool good = write_twins(seed, &arena, yaml, xml) && picture_take(kit, yaml, &options, &a) &&
                picture_take(kit, xml, &options, &b) && picture_differences(&a, &b, "the twin") == 0;
    *shows = good && picture_variety(&a) > 10;
    image_finish(&a);
    image_finish(&b);
    arena_finish(&arena);
    if (!good)
        printf("FAIL seed %llu\n", (unsigned long long)seed);
    return good;
}

int main(int argc, char **argv) {
    struct picture_kit kit;
    if (argc != 5)
        return 2;
    if (!picture_kit_open(&kit))
        return 77;
    const uint64_t first = strtoull(argv[3], NULL, 10), scenes = strtoull(argv[4], NULL, 10);
    uint64_t failed = 0, showing = 0;
    for (uint64_t seed = first; seed < first + scenes; seed++) {
        bool shows;
        failed += !check_seed(&kit, seed, argv[1], argv[2], &shows);
        showing += shows;
    }
    uint32_t messages = picture_kit_close(&kit);
    printf("%llu scenes, %llu failed, %llu of the pictures show something\n", (unsigned long long)scenes,
           (unsigned long long)failed, (unsigned long long)showing);
    return failed || messages || 2 * showing < scenes;
}
