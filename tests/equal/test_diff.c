// What ir_diff finds in generated scenes: nothing between spellings, and one thing after one change.
#include "grammar/print/ir_diff.h"
#include "tests/equal/equal_kit.h"
#include "tests/generate/generate.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum {
    SCENE_COUNT = 300
};

static const str meshes[] = {{"a.obj", 5}, {"b.obj", 5}};

static struct ir_scene *generate(uint64_t seed, struct arena *arena) {
    const struct generate_options options = {.seed = seed, .renderable = seed % 2, .meshes = {meshes, 2}};
    return generate_scene(&options, arena);
}

static uint32_t count(const struct ir_scene *a, const struct ir_origin *a_origin, const struct ir_scene *b,
                      const struct ir_origin *b_origin, struct arena *arena, struct ir_changes *changes) {
    struct ir_diff_side before = {a, a_origin, NULL, NULL}, after = {b, b_origin, NULL, NULL};
    ir_diff(&before, &after, arena, changes);
    return changes->count;
}

static void test_spellings(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < SCENE_COUNT; seed++) {
        struct arena arena;
        struct strbuf yaml, xml;
        struct loaded a, b;
        struct ir_changes changes;
        arena_init(&arena, (size_t)1 << 28);
        strbuf_init(&yaml), strbuf_init(&xml);
        const struct ir_scene *scene = generate(seed, &arena);
        ir_write_yaml(scene, NULL, NULL, (struct ir_write_options){0}, &yaml);
        ir_write_xml(scene, NULL, NULL, (struct ir_write_options){0}, &xml);
        load_text(&a, "a.yaml", strbuf_view(&yaml));
        load_text(&b, "b.xml", strbuf_view(&xml));
        assert_no_errors(&a, "yaml"), assert_no_errors(&b, "xml");
        uint32_t found =
            count(a.output.scene, &a.output.origin, b.output.scene, &b.output.origin, &arena, &changes);
        if (found)
            fail_msg("seed %llu: '%.*s' differs", (unsigned long long)seed,
                     STR_ARG(changes.items[0].path_after));
        loaded_finish(&a), loaded_finish(&b);
        strbuf_finish(&yaml), strbuf_finish(&xml);
        arena_finish(&arena);
    }
}

// A scene of text in both spellings' terms, and what its change must be told as.
static void check(const char *before, const char *after, const char *expected) {
    struct loaded a, b;
    struct arena arena;
    struct ir_changes changes;
    char told[512] = "";
    arena_init(&arena, (size_t)1 << 26);
    load_text(&a, "a.yaml", str_from(before));
    load_text(&b, "b.yaml", str_from(after));
    assert_no_errors(&a, before), assert_no_errors(&b, after);
    uint32_t found =
        count(a.output.scene, &a.output.origin, b.output.scene, &b.output.origin, &arena, &changes);
    for (uint32_t i = 0; i < found; i++) {
        const struct ir_change *c = &changes.items[i];
        snprintf(told + strlen(told), sizeof told - strlen(told), "%c%.*s%s%.*s=%.*s>%.*s ", "~+-><"[c->kind],
                 STR_ARG(c->path_before), c -> path_before.len && c->path_after.len ? "," : "",
                 STR_ARG(c->path_after), STR_ARG(c->value_before), STR_ARG(c->value_after));
    }
    assert_string_equal(told, expected);
    loaded_finish(&a), loaded_finish(&b);
    arena_finish(&arena);
}

static void test_changes(void **state) {
    (void)state;
    check("glint: 1\n", "glint: 1\nimage: {width: 1024}\ncamera: {}\n", "+cameras.main=>{} ");
    check("glint: 1\ntrace: {max_depth: 3}\n", "glint: 1\ntrace: {shadows: false}\n",
          "~trace.max_depth,trace.max_depth=3>16 ~trace.shadows,trace.shadows=true>false ");
    check("glint: 1\ncamera: {look_at: [1, 2, 3]}\n", "glint: 1\ncamera: {rotation: [1, 2, 3]}\n",
          "-cameras.main.look_at=[1, 2, 3]> +cameras.main.rotation=>[1, 2, 3] ");
    check("glint: 1\ncameras: {a: {fov: 3}, b: {}}\n", "glint: 1\ncameras: {b: {}, a: {fov: 3}}\n",
          ">cameras.b,cameras.b=> ");
    check("glint: 1\nmaterials: {m: {}, n: {diffuse_color: 0.5}}\n",
          "glint: 1\nmaterials: {n: {diffuse_color: \"#808080\"}, m: {}}\n",
          "~materials.n.diffuse_color,materials.n.diffuse_color=0.5>\"#808080\" ");
}

static void test_lists(void **state) {
    (void)state;
    const char *three =
        "glint: 1\nspheres:\n  - {center: [1, 0, 0], radius: 1}\n  - {center: [2, 0, 0], radius: 2}\n"
        "  - {center: [3, 0, 0], radius: 3}\n";
    check(three,
          "glint: 1\nspheres:\n  - {center: [1, 0, 0], radius: 1}\n  - {center: [3, 0, 0], radius: 3}\n",
          "-spheres[1]={center: [2, 0, 0], radius: 2}> ");
    check(three,
          "glint: 1\nspheres:\n  - {center: [3, 0, 0], radius: 3}\n  - {center: [1, 0, 0], radius: 1}\n"
          "  - {center: [2, 0, 0], radius: 2}\n",
          ">spheres[2],spheres[0]=> ");
    check(three,
          "glint: 1\nspheres:\n  - {center: [0, 0, 9], radius: 7}\n  - {center: [1, 0, 0], radius: 1}\n"
          "  - {center: [2, 0, 0], radius: 5}\n  - {center: [3, 0, 0], radius: 3}\n",
          "+spheres[0]=>{center: [0, 0, 9], radius: 7} ~spheres[1].radius,spheres[2].radius=2>5 ");
    check("glint: 1\nlights: [{name: a, position: [1, 2, 3]}, {name: b, position: [4, 5, 6]}]\n",
          "glint: 1\nlights: [{name: b, position: [1, 2, 3]}]\n",
          "-lights[a]={name: a, position: [1, 2, 3]}> ~lights[b].position,lights[b].position=[4, 5, 6]>[1, "
          "2, 3] ");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_spellings),
        cmocka_unit_test(test_changes),
        cmocka_unit_test(test_lists),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
