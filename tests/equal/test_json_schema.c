// The JSON Schema accepts what glint writes and the examples of the table, and refuses what glint refuses.
#include "grammar/emit/emit.h"
#include "grammar/emit/emit_words.h"
#include "grammar/print/ir_print.h"
#include "tests/equal/json_schema.h"
#include "tests/generate/generate.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

static int load_schema(void **state) {
    struct strbuf text;
    strbuf_init(&text);
    emit_json_schema(&text);
    *state = json_loadb(text.data, text.len, 0, NULL);
    strbuf_finish(&text);
    return *state ? 0 : -1;
}

static int free_schema(void **state) {
    json_decref(*state);
    return 0;
}

static bool accepts(const json_t *schema, str yaml) {
    json_t *value = json_from_yaml(yaml);
    bool good = value && json_schema_accepts(schema, schema, value);
    json_decref(value);
    return good;
}

static void test_generated_scenes(void **state) {
    static const str meshes[] = {{"a.obj", 5}, {"1.0", 3}};
    for (uint64_t seed = 0; seed < 200; seed++) {
        struct arena arena;
        struct strbuf text;
        arena_init(&arena, (size_t)1 << 26);
        strbuf_init(&text);
        const struct generate_options options = {
            .seed = seed, .meshes = {meshes, 2}, .images = {meshes + 1, 1}};
        ir_write_yaml(generate_scene(&options, &arena), NULL, NULL, (struct ir_write_options){0}, &text);
        if (!accepts(*state, strbuf_view(&text)))
            fail_msg("seed %d is refused:\n%s", (int)seed, text.data);
        strbuf_finish(&text);
        arena_finish(&arena);
    }
}

static void test_examples(void **state) {
    for (const struct schema_element *const *e = schema_elements; *e; e++) {
        struct strbuf text;
        strbuf_init(&text);
        if (*e != &SCHEMA_SCENE)
            strbuf_cstr(&text, "glint: 1\n");
        emit_yaml_example(*e, &text);
        if (!accepts(*state, strbuf_view(&text)))
            fail_msg("the example of %s is refused:\n%s", (*e)->name, text.data);
        strbuf_finish(&text);
    }
}

static void test_other_spellings(void **state) {
    static const char *const good[] = {
        "glint: 1",
        "{glint: 1, lights: null, materials: {}, spheres: []}",
        "{glint: 1, x-anchors: [1, {a: b}]}",
        "{glint: 1, camera: {position: {x: 1, y: 2, z: 3}, fov: 179.9}}",
        "{glint: 1, cameras: {main: {}, side: {rotation: [0, 90, 0]}}}",
        "{glint: 1, materials: {m: {albedo: {specular: 1}, diffuse_color: \"#aAbBcC\", specular_color: 1}}}",
        "{glint: 1, materials: {m: {diffuse_color: {checker: {colors: [0, \"#ffffff\"]}}}}}",
        "{glint: 1, materials: {m: {diffuse_color: {color: {r: 1, g: 1, b: 1}}}}}",
        "{glint: 1, spheres: [{center: [0, 0, 0], radius: 1, material: {refractive_index: 1.5}}]}",
        "{glint: 1, models: [{mesh: a.obj, scale: [1, -1, 1e-18], material_map: {\"a b\": m, c: {to: m}}}]}",
        "{glint: 1, include: [a.yaml, {file: b.yaml}]}",
    };
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++)
        if (!accepts(*state, str_from(good[i])))
            fail_msg("refused: %s", good[i]);
}

static void test_mistakes(void **state) {
    static const char *const bad[] = {
        "{}",
        "[]",
        "{glint: 2}",
        "{glint: 1, colour: red}",
        "{glint: 1, image: null}",
        "{glint: 1, image: {width: 0}}",
        "{glint: 1, image: {width: 1.5}}",
        "{glint: 1, image: {width: \"10\"}}",
        "{glint: 1, image: {tone: Clip}}",
        "{glint: 1, trace: {shadows: yes}}",
        "{glint: 1, trace: {min_weight: 1.1}}",
        "{glint: 1, camera: {fov: 361}}",
        "{glint: 1, camera: {name: main}}",
        "{glint: 1, camera: {position: [0, 0]}}",
        "{glint: 1, camera: {position: {x: 0, y: 0}}}",
        "{glint: 1, camera: {position: 0}}",
        "{glint: 1, camera: {look_at: [0, 0, 1], direction: [0, 0, 1]}}",
        "{glint: 1, camera: {}, cameras: {}}",
        "{glint: 1, lights: [{}]}",
        "{glint: 1, lights: [{position: [0, 0, 0], direction: [0, 0, 1]}]}",
        "{glint: 1, lights: {position: [0, 0, 0]}}",
        "{glint: 1, materials: {m: {albedo: [1, 0, 0]}}}",
        "{glint: 1, materials: {m: {diffuse_color: 1 2}}}",
        "{glint: 1, materials: {m: {diffuse_color: \"#12345\"}}}",
        "{glint: 1, materials: {m: {diffuse_color: {checker: {colors: [0]}}}}}",
        "{glint: 1, materials: {m: {refractive_index: 0}}}",
        "{glint: 1, spheres: [{center: [0, 0, 0]}]}",
        "{glint: 1, spheres: [{center: [0, 0, 0], radius: -1}]}",
        "{glint: 1, models: [{mesh: \"\"}]}",
        "{glint: 1, models: [{mesh: a.obj, scale: 0}]}",
        "{glint: 1, models: [{mesh: a.obj, material_map: {\"\": m}}]}",
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        if (accepts(*state, str_from(bad[i])))
            fail_msg("accepted: %s", bad[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_generated_scenes),
        cmocka_unit_test(test_examples),
        cmocka_unit_test(test_other_spellings),
        cmocka_unit_test(test_mistakes),
    };
    return cmocka_run_group_tests(tests, load_schema, free_schema);
}
