// Generated scenes mean the same after any way through both spellings.
#include "grammar/ir.h"
#include "grammar/ir_expand.h"
#include "grammar/ir_hash.h"
#include "tests/equal/equal_kit.h"
#include "tests/generate/generate.h"

#include <jansson.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

enum {
    SCENE_COUNT = 1000
};

#define LITERAL(text)                                                                                        \
    { text, sizeof(text) - 1 }
static const str meshes[] = {LITERAL("meshes/ball.obj"), LITERAL("1.0"), LITERAL("a b/\xC3\xA9 #1: [x].obj"),
                             LITERAL("~/x.obj"), LITERAL("NO.ply")};
static const str fonts[] = {LITERAL("fonts/Aa.ttf"), LITERAL("0x1.0")};
static const str images[] = {LITERAL("sky.jpg"), LITERAL("1.0")};
static const str includes[] = {LITERAL("base.yaml"), LITERAL("../other folder/more.xml")};
static const str mesh_materials[] = {LITERAL("Gold")};

#define PATHS(list)                                                                                          \
    { list, sizeof(list) / sizeof((list)[0]) }

static struct ir_scene *generate(uint64_t seed, struct arena *arena) {
    const struct generate_options options = {
        .seed = seed,
        .renderable = seed % 5 == 0,
        .meshes = PATHS(meshes),
        .images = PATHS(images),
        .fonts = PATHS(fonts),
        .includes = PATHS(includes),
        .mesh_materials = PATHS(mesh_materials),
    };
    return generate_scene(&options, arena);
}

static void check_text(const char *what, bool xml, const struct strbuf *text, const struct strbuf *dump,
                       struct loaded *loaded) {
    struct strbuf again;
    strbuf_init(&again);
    load_text(loaded, xml ? "scene.xml" : "scene.yaml", strbuf_view(text));
    if (loaded->sink.errors)
        print_error("%s", text->data);
    assert_no_errors(loaded, what);
    ir_dump(loaded->output.scene, &again);
    assert_same_text(what, dump, &again);
    strbuf_finish(&again);
}

static void hash_scene(const struct ir_scene *scene, uint64_t out[2]) {
    struct hash128 hash;
    hash128_begin(&hash);
    ir_hash(&hash, &SCHEMA_SCENE, scene);
    hash128_end(&hash, out);
}

// scene -> YAML -> XML -> YAML, each read back and compared.
static void check_scene(uint64_t seed) {
    struct arena arena;
    struct loaded from_yaml, from_xml;
    struct strbuf dump, yaml, xml, direct, back;
    char what[64];
    arena_init(&arena, (size_t)1 << 26);
    strbuf_init(&dump), strbuf_init(&yaml), strbuf_init(&xml), strbuf_init(&direct), strbuf_init(&back);
    struct ir_scene *scene = generate(seed, &arena);
    ir_dump(scene, &dump);
    ir_write_yaml(scene, NULL, NULL, (struct ir_write_options){0}, &yaml);
    ir_write_xml(scene, NULL, NULL, (struct ir_write_options){0}, &direct);
    snprintf(what, sizeof what, "seed %llu in YAML", (unsigned long long)seed);
    check_text(what, false, &yaml, &dump, &from_yaml);
    write_loaded(&from_yaml, true, &xml);
    snprintf(what, sizeof what, "seed %llu, XML by way of YAML", (unsigned long long)seed);
    assert_same_text(what, &direct, &xml);
    snprintf(what, sizeof what, "seed %llu in XML", (unsigned long long)seed);
    check_text(what, true, &xml, &dump, &from_xml);
    write_loaded(&from_xml, false, &back);
    snprintf(what, sizeof what, "seed %llu, YAML by way of XML", (unsigned long long)seed);
    assert_same_text(what, &yaml, &back);
    loaded_finish(&from_yaml), loaded_finish(&from_xml);
    strbuf_finish(&dump), strbuf_finish(&yaml), strbuf_finish(&xml), strbuf_finish(&direct),
        strbuf_finish(&back);
    arena_finish(&arena);
}

static void test_generated_scenes(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < SCENE_COUNT; seed++)
        check_scene(seed);
}

static void load_evaluated(struct loaded *loaded, const char *path, const char *what,
                           const struct strbuf *text, uint64_t hash[2]) {
    load_whole_text(loaded, path, strbuf_view(text));
    if (loaded->sink.errors)
        print_error("%s", text->data);
    assert_no_errors(loaded, what);
    hash_scene(loaded->output.scene, hash);
}

static void assert_same_scenes(const char *what, const struct ir_scene *scene,
                               const struct ir_scene *expanded) {
    struct strbuf a, b;
    strbuf_init(&a), strbuf_init(&b);
    ir_dump(scene, &a);
    ir_dump(expanded, &b);
    assert_same_text(what, &a, &b);
    strbuf_finish(&a), strbuf_finish(&b);
}

static uint32_t count_entries(const struct ir_scene *scene) {
    return scene->lights.count + scene->spheres.count + scene->rectangles.count + scene->boxes.count +
           scene->cylinders.count + scene->cones.count + scene->models.count;
}

// Without parameters, expressions, `for` and `if` a scene means the same; so does its twin in the other
// spelling.
static void test_expanded_scenes(void **state) {
    uint32_t computed = 0, copied = 0;
    (void)state;
    for (uint64_t seed = 0; seed < SCENE_COUNT; seed++) {
        const struct generate_options options = {.seed = seed, .renderable = true};
        struct arena arena;
        struct loaded first, second, twin;
        struct strbuf text;
        uint64_t before[2], after[2], other[2];
        char what[40];
        snprintf(what, sizeof what, "seed %llu", (unsigned long long)seed);
        arena_init(&arena, (size_t)1 << 26);
        strbuf_init(&text);
        struct ir_scene *scene = generate_scene(&options, &arena);
        computed += scene->parameters.count > 0;
        ir_write_yaml(scene, NULL, NULL, (struct ir_write_options){0}, &text);
        load_evaluated(&first, "scene.yaml", what, &text, before);
        copied += count_entries(scene) != count_entries(first.output.scene);
        strbuf_clear(&text);
        ir_write_xml(scene, NULL, NULL, (struct ir_write_options){0}, &text);
        load_evaluated(&twin, "scene.xml", what, &text, other);
        if (memcmp(before, other, sizeof before) != 0)
            fail_msg("%s means something else in XML: %s", what, text.data);
        ir_expand(first.output.scene, &first.arena);
        strbuf_clear(&text);
        ir_write_yaml(first.output.scene, NULL, NULL, (struct ir_write_options){0}, &text);
        load_evaluated(&second, "scene.yaml", what, &text, after);
        ir_expand(second.output.scene, &second.arena);
        assert_same_scenes(what, first.output.scene, second.output.scene);
        if ((!ir_moves(first.output.scene) && strstr(text.data, "\nparameters:")) ||
            strstr(text.data, "for: {"))
            fail_msg("%s is not written out: %s", what, text.data);
        loaded_finish(&first), loaded_finish(&second), loaded_finish(&twin);
        strbuf_finish(&text);
        arena_finish(&arena);
    }
    assert_in_range(computed, SCENE_COUNT / 4, SCENE_COUNT);
    assert_in_range(copied, SCENE_COUNT / 4, SCENE_COUNT);
}

// What the generator never writes is not tested by it.
static void test_generator_reaches_every_row(void **state) {
    (void)state;
    uint64_t used[ELEMENTS_MAX] = {0};
    for (uint64_t seed = 0; seed < 100; seed++) {
        struct arena arena;
        arena_init(&arena, (size_t)1 << 26);
        note_written(&SCHEMA_SCENE, generate(seed, &arena), used);
        arena_finish(&arena);
    }
    // A scene that takes a frame has no animation once it is loaded, so that none is generated: tests/batch.
    for (int e = 0; schema_elements[e]; e++)
        if (schema_elements[e] == &SCHEMA_ANIMATION)
            used[e] |= UINT64_C(1) << schema_find_row(&SCHEMA_ANIMATION, STR("frame"));
    assert_all_written(used, "no generated scene writes");
}

// JSON is read as YAML, and by every reader of JSON.
static void test_json(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 200; seed++) {
        struct arena arena;
        struct loaded loaded;
        struct strbuf dump, json;
        json_error_t error;
        arena_init(&arena, (size_t)1 << 26);
        strbuf_init(&dump), strbuf_init(&json);
        const struct ir_scene *scene = generate(seed, &arena);
        ir_dump(scene, &dump);
        ir_write_json(scene, &json);
        check_text("JSON", false, &json, &dump, &loaded);
        json_t *value = json_loadb(json.data, json.len, JSON_REJECT_DUPLICATES | JSON_ALLOW_NUL, &error);
        if (!value)
            fail_msg("seed %d: line %d: %s\n%s", (int)seed, error.line, error.text, json.data);
        json_decref(value);
        loaded_finish(&loaded);
        strbuf_finish(&dump), strbuf_finish(&json);
        arena_finish(&arena);
    }
}

// A dump is a scene too, and means what it was made from.
static void test_dumps_are_scenes(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 50; seed++) {
        struct arena arena;
        struct loaded loaded;
        struct strbuf dump;
        arena_init(&arena, (size_t)1 << 26);
        strbuf_init(&dump);
        ir_dump(generate(seed, &arena), &dump);
        check_text("a dump", false, &dump, &dump, &loaded);
        loaded_finish(&loaded);
        strbuf_finish(&dump);
        arena_finish(&arena);
    }
}

static void test_seeds_repeat(void **state) {
    (void)state;
    struct arena arena;
    struct strbuf first, second, other;
    arena_init(&arena, (size_t)1 << 26);
    strbuf_init(&first), strbuf_init(&second), strbuf_init(&other);
    ir_dump(generate(7, &arena), &first);
    ir_dump(generate(7, &arena), &second);
    ir_dump(generate(8, &arena), &other);
    assert_same_text("the same seed", &first, &second);
    assert_false(str_equal(strbuf_view(&first), strbuf_view(&other)));
    strbuf_finish(&first), strbuf_finish(&second), strbuf_finish(&other);
    arena_finish(&arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_generated_scenes),
        cmocka_unit_test(test_expanded_scenes),
        cmocka_unit_test(test_generator_reaches_every_row),
        cmocka_unit_test(test_json),
        cmocka_unit_test(test_dumps_are_scenes),
        cmocka_unit_test(test_seeds_repeat),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
