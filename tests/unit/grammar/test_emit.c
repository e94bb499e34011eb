// The files made from the table are those that are committed, well formed, and hold every name; so does
// what `glint explain` says.
#include "diag/diag.h"
#include "grammar/emit/emit.h"
#include "grammar/emit/explain.h"
#include "grammar/schema.h"
#include "load/settings/key_schema.h"
#include "tests/generate/dictionary.h"

#include <jansson.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef void emitter(struct strbuf *out);

static struct strbuf emitted(emitter *emit) {
    struct strbuf out;
    strbuf_init(&out);
    emit(&out);
    assert_false(out.failed);
    return out;
}

static void assert_fresh(emitter *emit, const char *path) {
    struct strbuf wanted = emitted(emit);
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("cannot read %s", path);
    char *committed = malloc(wanted.len + 2);
    size_t length = fread(committed, 1, wanted.len + 1, file);
    fclose(file);
    if (length != wanted.len || memcmp(committed, wanted.data, length) != 0)
        fail_msg("%s is not what the table says; build the target 'emitted' and commit it", path);
    free(committed);
    strbuf_finish(&wanted);
}

static void test_committed_files_are_fresh(void **state) {
    (void)state;
    assert_fresh(emit_json_schema, "docs/schema/glint.schema.json");
    assert_fresh(emit_relaxng, "docs/schema/glint.rng");
    assert_fresh(emit_relaxng_compact, "docs/schema/glint.rnc");
    assert_fresh(emit_markdown, "docs/reference.md");
    assert_fresh(emit_limits, "docs/limits.md");
    assert_fresh(emit_codes, "docs/codes.md");
    assert_fresh(dictionary_write, "tests/fuzz/glint.dict");
    assert_fresh(key_schema_settings, "docs/schema/glintrc.schema.json");
    assert_fresh(key_schema_bounds, "docs/schema/bounds.schema.json");
    assert_fresh(key_schema_tests, "docs/schema/test.schema.json");
}

// ---- JSON Schema

static json_t *load_schema(void) {
    struct strbuf text = emitted(emit_json_schema);
    json_error_t error;
    json_t *root = json_loads(text.data, JSON_REJECT_DUPLICATES, &error);
    if (!root)
        fail_msg("line %d: %s", error.line, error.text);
    strbuf_finish(&text);
    return root;
}

static const json_t *definition(const json_t *root, const struct schema_element *schema) {
    const json_t *found = json_object_get(json_object_get(root, "definitions"), schema->name);
    return schema == &SCHEMA_SCENE ? root : found;
}

static void test_json_schema_has_every_row(void **state) {
    (void)state;
    json_t *root = load_schema();
    for (const struct schema_element *const *e = schema_elements; *e; e++) {
        const json_t *object = definition(root, *e);
        const json_t *properties = json_object_get(object, "properties");
        assert_non_null(properties);
        assert_true(json_is_false(json_object_get(object, "additionalProperties")));
        for (uint32_t i = 0; i < (*e)->row_count; i++) {
            const struct schema_row *row = &(*e)->rows[i];
            const json_t *property = json_object_get(properties, schema_yaml_key(row));
            // A key is the map's key, no property.
            assert_int_equal(property == NULL, row->key);
            if (row->key)
                continue;
            assert_string_equal(json_string_value(json_object_get(property, "description")), row->doc);
            assert_non_null(json_object_get(property, "markdownDescription"));
            assert_int_equal(json_object_get(property, "default") != NULL,
                             row->standard != NULL && row->many == SCHEMA_ONE);
            assert_int_equal(json_object_get(properties, row->name) != NULL,
                             !row->plural || row->single || strcmp(row->plural, row->name) == 0);
        }
    }
    json_decref(root);
}

// Each reference leads to a definition.
static void check_references(const json_t *root, const json_t *value) {
    const json_t *child;
    const char *key;
    size_t index;
    const char *address = json_string_value(json_object_get(value, "$ref"));
    if (address) {
        assert_memory_equal(address, "#/definitions/", 14);
        assert_non_null(json_object_get(json_object_get(root, "definitions"), address + 14));
    }
    if (json_is_object(value)) {
        json_object_foreach((json_t *)value, key, child) check_references(root, child);
    }
    if (json_is_array(value)) {
        json_array_foreach(value, index, child) check_references(root, child);
    }
}

static void test_json_schema_references(void **state) {
    (void)state;
    json_t *root = load_schema();
    check_references(root, root);
    json_decref(root);
}

// ---- the other files

static void assert_holds(const struct strbuf *text, const char *before, const char *word, const char *after) {
    char wanted[128];
    snprintf(wanted, sizeof wanted, "%s%s%s", before, word, after);
    if (!strstr(text->data, wanted))
        fail_msg("'%s' does not occur", wanted);
}

static void test_every_name_is_everywhere(void **state) {
    (void)state;
    struct strbuf relaxng = emitted(emit_relaxng);
    struct strbuf compact = emitted(emit_relaxng_compact);
    struct strbuf markdown = emitted(emit_markdown);
    struct strbuf dictionary = emitted(dictionary_write);
    for (const struct schema_element *const *e = schema_elements; *e; e++) {
        assert_holds(&relaxng, "<define name=\"", (*e)->name, "\">");
        assert_holds(&markdown, "\n## ", (*e)->name, "\n");
        for (uint32_t i = 0; i < (*e)->row_count; i++) {
            const struct schema_row *row = &(*e)->rows[i];
            assert_holds(&markdown, "| `", row->name, "` |");
            if (schema_is_attribute(row))
                assert_holds(&relaxng, "<attribute name=\"", row->name, "\">");
            if (schema_is_attribute(row))
                assert_holds(&compact, "attribute ", row->name, " {");
            if (row->element)
                assert_holds(&relaxng, "<element name=\"", row->element, "\">");
            if (row->element)
                assert_holds(&compact, "element ", row->element, " {");
            assert_holds(&dictionary, "\"", schema_yaml_key(row), ": \"");
            if (row->element)
                assert_holds(&dictionary, "\"<", row->element, "\"");
        }
    }
    strbuf_finish(&relaxng), strbuf_finish(&compact), strbuf_finish(&markdown), strbuf_finish(&dictionary);
}

// ---- explain

static void assert_explained(const char *what, const char *holds) {
    struct strbuf out;
    strbuf_init(&out);
    if (!explain(str_from(what), false, &out))
        fail_msg("'%s': %s", what, out.data);
    if (!strstr(out.data, holds))
        fail_msg("'%s' does not tell '%s':\n%s", what, holds, out.data);
    assert_null(strchr(out.data, '\033'));
    strbuf_finish(&out);
}

static void assert_unknown(const char *what, const char *wanted) {
    struct strbuf out;
    strbuf_init(&out);
    assert_false(explain(str_from(what), false, &out));
    assert_string_equal(out.data, wanted);
    strbuf_finish(&out);
}

static void test_every_code_is_explained(void **state) {
    (void)state;
    for (diag_code code = diag_next(-1); code < DIAG_CODE_COUNT; code = diag_next(code)) {
        const struct diag_info *info = diag_info(code);
        char title[160];
        snprintf(title, sizeof title, "): %.120s", info->title);
        assert_explained(info->code, title);
    }
    assert_explained("e206", "E206 (error): ");
    assert_explained("W401", "Occurs in YAML scenes and XML scenes.");
}

static void test_every_row_is_explained(void **state) {
    (void)state;
    for (const struct schema_element *const *e = schema_elements; *e; e++) {
        char name[128];
        assert_explained((*e)->name, "In YAML:");
        assert_explained((*e)->element, "In XML:");
        for (uint32_t i = 0; i < (*e)->row_count; i++) {
            snprintf(name, sizeof name, "%s.%s", (*e)->name, (*e)->rows[i].name);
            assert_explained(name, name);
            assert_explained((*e)->name, (*e)->rows[i].name);
        }
    }
    assert_explained("camera.fov", "greater than 0 and at most 360, degrees; default 60");
    assert_explained("fov", "camera.fov");
    assert_explained("Light.Position", "not together with 'direction'");
    assert_explained("materials.diffuse_color.checker.colors", "checker.color");
    // As --set, other styles and other programs have them.
    assert_explained("materials.glass.albedo", "material.albedo");
    assert_explained("lights[0].position.x", "light.position");
    assert_explained("albedo.diffuse", "material.albedo");
    assert_explained("sphere.Radius", "sphere.radius");
    assert_explained("camera.lookat", "camera.look_at");
    assert_explained("ior", "material.refractive_index");
    assert_explained("paint", "XML: <DiffuseColor>");
    assert_explained("area-light", "has soft shadows");
    assert_explained("AreaLights", "one of them, and more samples");
    assert_explained("bump_map", "Relief");
    assert_explained("constant", "glint explain parameter");
    assert_explained("for", "It is the same in all that have it: light, sphere");
    assert_explained("image.tone", "clip: Values above 1 are clipped.");
}

static void test_colour(void **state) {
    (void)state;
    struct strbuf out;
    strbuf_init(&out);
    assert_true(explain(STR("fov"), true, &out));
    assert_non_null(strstr(out.data, "\033[1m"));
    strbuf_finish(&out);
}

static void test_unknown_things(void **state) {
    (void)state;
    assert_unknown("lihgt", "'lihgt' is not a code, element or attribute; did you mean 'light'?\n");
    assert_unknown("camera.fob",
                   "'camera.fob' is not a code, element or attribute; did you mean 'camera.fov'?\n");
    assert_unknown("E2006", "'E2006' is not a code, element or attribute; did you mean 'E206'?\n");
    assert_unknown("zzzzzz",
                   "'zzzzzz' is not a code, element or attribute; begin with 'glint explain scene'\n");
    assert_unknown("", "'' is not a code, element or attribute; begin with 'glint explain scene'\n");
    assert_unknown("camera.", "'camera.' is not a code, element or attribute; did you mean 'camera.up'?\n");
    assert_unknown("camera.fov.x",
                   "'camera.fov.x' is not a code, element or attribute; did you mean 'camera.fov'?\n");
    assert_unknown("eye",
                   "several attributes are like 'eye'; say which: 'scene.camera' or 'camera.position'\n");
    assert_unknown("rotation", "several elements have 'rotation'; say which: 'camera.rotation', "
                               "'background.rotation', 'texture.rotation', 'sphere.rotation', "
                               "'box.rotation', 'model.rotation' or 'instance.rotation'\n");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_committed_files_are_fresh),
        cmocka_unit_test(test_json_schema_has_every_row),
        cmocka_unit_test(test_json_schema_references),
        cmocka_unit_test(test_every_name_is_everywhere),
        cmocka_unit_test(test_every_code_is_explained),
        cmocka_unit_test(test_every_row_is_explained),
        cmocka_unit_test(test_colour),
        cmocka_unit_test(test_unknown_things),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
