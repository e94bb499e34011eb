// The table is whole: every field of the IR has a row, every row is sound.
#include "core/expression.h"
#include "core/number.h"
#include "grammar/concept.h"
#include "grammar/ir.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"
#include "grammar/schema_index.h"

#include <ctype.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// The struct behind each element, as ir.h names it.
// clang-format off
static const struct {
    const struct schema_element *schema;
    const char *structure;
} structures[] = {
    {&SCHEMA_SCENE, "ir_scene"}, {&SCHEMA_PARAMETER, "ir_parameter"},
    {&SCHEMA_VARIABLE, "ir_variable"}, {&SCHEMA_INCLUDE, "ir_include"},
    {&SCHEMA_IMAGE, "ir_image"}, {&SCHEMA_TRACE, "ir_trace"},
    {&SCHEMA_CAMERA, "ir_camera"}, {&SCHEMA_BACKGROUND, "ir_background"},
    {&SCHEMA_LIGHT, "ir_light"}, {&SCHEMA_PANEL, "ir_panel"}, {&SCHEMA_SPOT, "ir_spot"},
    {&SCHEMA_AMBIENT, "ir_ambient"}, {&SCHEMA_MATERIAL, "ir_material"},
    {&SCHEMA_PAINT, "ir_paint"}, {&SCHEMA_CHECKER, "ir_checker"},
    {&SCHEMA_TEXTURE, "ir_texture"}, {&SCHEMA_HIGHLIGHT, "ir_highlight"},
    {&SCHEMA_MESH, "ir_mesh"}, {&SCHEMA_LATHE, "ir_lathe"},
    {&SCHEMA_OUTLINE_POINT, "ir_outline_point"}, {&SCHEMA_TORUS, "ir_torus"},
    {&SCHEMA_EXTRUDE, "ir_extrude"}, {&SCHEMA_HOLE, "ir_hole"},
    {&SCHEMA_FACES, "ir_faces"}, {&SCHEMA_VERTEX, "ir_vertex"},
    {&SCHEMA_UV, "ir_coordinate"}, {&SCHEMA_FACE, "ir_face"},
    {&SCHEMA_CORNER, "ir_corner"}, {&SCHEMA_MESH_TEXT, "ir_text"},
    {&SCHEMA_SPHERE, "ir_sphere"}, {&SCHEMA_RECTANGLE, "ir_rectangle"},
    {&SCHEMA_BOX, "ir_box"}, {&SCHEMA_CYLINDER, "ir_cylinder"},
    {&SCHEMA_CONE, "ir_cone"}, {&SCHEMA_MODEL, "ir_model"},
    {&SCHEMA_MAP_ENTRY, "ir_map_entry"}, {&SCHEMA_TRACK, "ir_track"},
    {&SCHEMA_ANIMATION, "ir_animation"}, {&SCHEMA_KEYFRAME, "ir_keyframe"},
    {&SCHEMA_OBJECT, "ir_object"}, {&SCHEMA_INSTANCE, "ir_instance"},
    {&SCHEMA_WITH, "ir_with"}, {&SCHEMA_MATRIX, "ir_matrix"},
    {&SCHEMA_MATRIX_ROW, "ir_matrix_row"},
};
// clang-format on

#define EACH_ELEMENT(e) for (const struct schema_element *const *e = schema_elements; *e; e++)

static bool has_numbers(const struct schema_row *row) {
    return row->kind == SCHEMA_INTEGER || row->kind == SCHEMA_NUMBER || row->kind == SCHEMA_VECTOR ||
           row->kind == SCHEMA_PAIR || row->kind == SCHEMA_POINT || row->kind == SCHEMA_COLOR ||
           row->kind == SCHEMA_WEIGHTS || row->kind == SCHEMA_QUAD;
}

// ---- fields

struct field {
    size_t offset, size, align;
};

static size_t alignment_of(const struct schema_row *row) {
    switch (row->kind) {
    case SCHEMA_BOOLEAN:
        return _Alignof(bool);
    case SCHEMA_INTEGER:
        return _Alignof(int32_t);
    case SCHEMA_WORD:
        return _Alignof(unsigned);
    default:
        return _Alignof(double);
    }
}

static int by_offset(const void *a, const void *b) {
    const struct field *x = a, *y = b;
    return (x->offset > y->offset) - (x->offset < y->offset);
}

// Fields of the element as the table knows them: the head, the tags, one a row.
static size_t known_fields(const struct schema_element *schema, struct field out[64]) {
    size_t count = 0;
    out[count++] = (struct field){0, sizeof(struct ir_head), _Alignof(struct ir_head)};
    for (int c = 0; c < 3; c++)
        if (schema->choices[c].rule != SCHEMA_CHOICE_NONE)
            out[count++] =
                (struct field){schema->choices[c].tag_offset, sizeof(unsigned), _Alignof(unsigned)};
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        size_t times = row->many == SCHEMA_FIXED ? row->fixed_count : 1;
        out[count++] = (struct field){row->offset, row->size * times, alignment_of(row)};
    }
    if (schema == &SCHEMA_SCENE) { // the texts of values that are computed, and what bodies are copies of
        out[count++] = (struct field){offsetof(struct ir_scene, formulas), sizeof(void *), _Alignof(void *)};
        out[count++] = (struct field){offsetof(struct ir_scene, copies), sizeof(void *), _Alignof(void *)};
    }
    qsort(out, count, sizeof out[0], by_offset);
    return count;
}

// The compiler's layout of the known fields alone is that of the struct: nothing lies between.
static void test_no_field_without_a_row(void **state) {
    (void)state;
    EACH_ELEMENT(e) {
        struct field fields[64];
        size_t count = known_fields(*e, fields);
        size_t at = 0, widest = 1;
        for (size_t i = 0; i < count; i++) {
            at = (at + fields[i].align - 1) / fields[i].align * fields[i].align;
            if (at != fields[i].offset)
                fail_msg("%s: a field without a row before offset %zu", (*e)->name, fields[i].offset);
            at += fields[i].size;
            widest = fields[i].align > widest ? fields[i].align : widest;
        }
        assert_int_equal((at + widest - 1) / widest * widest, (*e)->size);
    }
}

static char *read_text(const char *path) {
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("cannot read %s", path);
    char *text = calloc(1, 1 << 16);
    size_t length = fread(text, 1, (1 << 16) - 1, file);
    fclose(file);
    assert_in_range(length, 1, (1 << 16) - 2);
    return text;
}

// Members that ir.h declares in a struct; comments and nested braces do not occur inside declarations.
static size_t declared_members(const char *header, const char *structure) {
    char opening[64];
    snprintf(opening, sizeof opening, "\nstruct %s {", structure);
    const char *at = strstr(header, opening);
    if (!at)
        fail_msg("ir.h has no struct %s", structure);
    size_t count = 0;
    for (at += strlen(opening); strncmp(at, "\n};", 3) != 0; at++) {
        if (strncmp(at, "//", 2) == 0)
            at = strchr(at, '\n') - 1;
        else
            count += *at == ';' || *at == ',';
    }
    return count;
}

// A small field may hide in padding, where the layout does not tell: so they are counted too.
static void test_every_member_is_counted(void **state) {
    (void)state;
    char *header = read_text("grammar/ir.h");
    for (size_t i = 0; i < sizeof structures / sizeof structures[0]; i++) {
        struct field fields[64];
        const size_t known = known_fields(structures[i].schema, fields);
        size_t declared = declared_members(header, structures[i].structure);
        if (known != declared)
            fail_msg("struct %s has %zu members, not %zu", structures[i].structure, declared, known);
    }
    free(header);
}

static void test_all_elements_are_listed(void **state) {
    (void)state;
    size_t count = 0;
    EACH_ELEMENT(e) {
        bool has_structure = false;
        for (size_t i = 0; i < sizeof structures / sizeof structures[0]; i++)
            has_structure = has_structure || structures[i].schema == *e;
        assert_true(has_structure);
        count++;
        for (uint32_t i = 0; i < (*e)->row_count; i++) {
            bool listed = !(*e)->rows[i].child;
            EACH_ELEMENT(other) listed = listed || *other == (*e)->rows[i].child;
            assert_true(listed);
        }
    }
    assert_int_equal(count, sizeof structures / sizeof structures[0]);
    assert_ptr_equal(schema_elements[0], &SCHEMA_SCENE);
}

// ---- names and words

static void assert_snake(const char *name) {
    assert_true(islower((unsigned char)name[0]));
    for (const char *c = name; *c; c++)
        assert_true(islower((unsigned char)*c) || *c == '_');
}

static void assert_pascal_of(const char *pascal, const char *snake) {
    for (bool upper = true; *snake; upper = *snake++ == '_')
        if (*snake != '_')
            assert_int_equal(*pascal++, upper ? toupper((unsigned char)*snake) : *snake);
    assert_int_equal(*pascal, '\0');
}

static void assert_sentence(const char *doc) {
    assert_non_null(doc);
    size_t length = strlen(doc);
    assert_true(length > 4);
    assert_true(isupper((unsigned char)doc[0]));
    assert_int_equal(doc[length - 1], '.');
}

static void test_names(void **state) {
    (void)state;
    EACH_ELEMENT(e) {
        assert_snake((*e)->name);
        assert_pascal_of((*e)->element, *e == &SCHEMA_VARIABLE ? "for" : (*e)->name); // its row says more
        assert_true((*e)->row_count >= 1 && (*e)->row_count <= 64);
        for (uint32_t i = 0; i < (*e)->row_count; i++) {
            const struct schema_row *row = &(*e)->rows[i];
            assert_snake(row->name);
            if (row->element)
                assert_pascal_of(row->element, row->name);
            if (row->plural)
                assert_snake(row->plural);
            for (uint32_t k = 0; k < i; k++) {
                const struct schema_row *other = &(*e)->rows[k];
                assert_string_not_equal(row->name, other->name);
                assert_string_not_equal(schema_yaml_key(row), schema_yaml_key(other));
                assert_true(!row->element || !other->element || strcmp(row->element, other->element) != 0);
            }
        }
    }
}

static void test_docs(void **state) {
    (void)state;
    EACH_ELEMENT(e) {
        assert_sentence((*e)->doc);
        for (uint32_t i = 0; i < (*e)->row_count; i++) {
            const struct schema_row *row = &(*e)->rows[i];
            assert_sentence(row->doc);
            assert_int_equal(row->kind == SCHEMA_WORD, row->words != NULL);
            for (uint32_t k = 0; row->words && row->words[k]; k++) {
                assert_snake(row->words[k]);
                assert_sentence(row->word_docs[k]);
                assert_int_equal(row->words[k + 1] == NULL, row->word_docs[k + 1] == NULL);
            }
        }
    }
}

// Each row can be spelled, and is found by its spellings.
static void test_spellings_find_their_row(void **state) {
    (void)state;
    struct arena arena;
    struct schema_index index;
    arena_init(&arena, SIZE_MAX);
    schema_index_init(&index, &arena);
    EACH_ELEMENT(e) {
        bool single;
        for (uint32_t i = 0; i < (*e)->row_count; i++) {
            const struct schema_row *row = &(*e)->rows[i];
            single = false;
            assert_int_equal(schema_find_row(*e, str_from(row->name)), i);
            assert_true(schema_is_attribute(row) || row->element);
            assert_int_equal(
                schema_index_find(&index, *e, SCHEMA_NAME_ATTRIBUTE, str_from(row->name), &single),
                schema_is_attribute(row) ? (int)i : -1);
            if (row->element)
                assert_int_equal(schema_find_child(*e, str_from(row->element)), i);
            if (row->key)
                continue;
            assert_int_equal(schema_find_yaml(*e, str_from(schema_yaml_key(row)), &single), i);
            assert_false(single);
            if (row->single)
                assert_int_equal(schema_find_yaml(*e, str_from(row->name), &single), i);
            assert_int_equal(single, row->single != NULL);
        }
        assert_int_equal(schema_index_find(&index, *e, SCHEMA_NAME_ATTRIBUTE, STR("no_such_name"), &single),
                         -1);
        assert_int_equal(schema_find_child(*e, STR("NoSuchName")), -1);
    }
    arena_finish(&arena);
}

// ---- columns that belong together

// A word of other programs must not be a name of this language at the same place, nor mean two rows.
static void test_words_of_other_programs(void **state) {
    (void)state;
    for (const struct schema_element *const *e = schema_elements; *e; e++)
        for (uint32_t i = 0; i < (*e)->row_count; i++) {
            char words[200] = "";
            snprintf(words, sizeof words, "%s", (*e)->rows[i].also ? (*e)->rows[i].also : "");
            char *rest = words;
            for (char *word = strsep(&rest, " "); word && *word; word = strsep(&rest, " ")) {
                bool single;
                assert_snake(word);
                assert_int_equal(schema_find_row(*e, str_from(word)), -1);
                assert_int_equal(schema_find_yaml(*e, str_from(word), &single), -1);
                assert_int_equal(schema_find_also(*e, str_from(word), 0), i);
            }
        }
    assert_int_equal(schema_find_also(&SCHEMA_MATERIAL, STR("io"), 0), -1);
    assert_int_equal(schema_find_also(&SCHEMA_MATERIAL, STR(""), 0), -1);
}

// Whether an element has the word under this name, or under another.
static bool is_taken(const struct schema_element *element, str word) {
    bool single;
    return schema_find_row(element, word) >= 0 || schema_find_yaml(element, word, &single) >= 0 ||
           schema_find_also(element, word, 0) >= 0;
}

static const struct schema_element *element_called(str name) {
    EACH_ELEMENT(e)
    if (str_equal_cstr(name, (*e)->name))
        return *e;
    return NULL;
}

// Where a row of concepts.def is for certain elements, none of them has the word: a row that the language has
// outgrown must go. Elsewhere no element has it as a name, and one does without it.
static void check_concept_word(const struct concept *concept, str word) {
    str in = str_from(concept->in);
    while (in.len) {
        str name = concept_next_word(&in);
        const struct schema_element *element = element_called(name);
        if (!element)
            fail_msg("there is no element '%.*s'", STR_ARG(name));
        if (is_taken(element, word))
            fail_msg("%.*s has '%.*s': remove it from '%s'", STR_ARG(name), STR_ARG(word), concept->title);
        if (concept_find(element, word) != concept)
            fail_msg("'%.*s' is in two rows for %.*s", STR_ARG(word), STR_ARG(name));
    }
    bool is_free = false;
    for (const struct schema_element *const *e = schema_elements; !concept->in && *e; e++) {
        if (schema_find_row(*e, word) >= 0)
            fail_msg("%s has '%.*s': remove it from '%s'", (*e)->name, STR_ARG(word), concept->title);
        is_free = is_free || (!is_taken(*e, word) && concept_find(*e, word) == concept);
    }
    if (!concept->in && !is_free)
        fail_msg("'%.*s' of '%s' is never answered", STR_ARG(word), concept->title);
}

static void test_what_other_tools_have(void **state) {
    (void)state;
    uint32_t count = 0;
    for (const struct concept *c = concepts; c->title; c++, count++) {
        str words = str_from(c->words);
        while (words.len) {
            char word[64];
            str next = concept_next_word(&words);
            snprintf(word, sizeof word, "%.*s", STR_ARG(next));
            assert_snake(word);
            check_concept_word(c, str_from(word));
        }
        assert_int_equal(c->use != NULL, concept_use(c) != NULL);
        assert_false(c->lacks[strlen(c->lacks) - 1] == '.' || c->instead[strlen(c->instead) - 1] == '.');
    }
    assert_true(count >= 40);
    assert_null(concept_find(&SCHEMA_SCENE, STR("")));
    assert_null(concept_find(&SCHEMA_SCENE, STR("spheres")));
    assert_null(concept_find(&SCHEMA_CAMERA, STR("metalness_of")));
    assert_ptr_equal(concept_find(&SCHEMA_SCENE, STR("boxes")), concept_find(NULL, STR("box")));
    assert_ptr_equal(concept_find(NULL, STR("textures")), concept_find(&SCHEMA_SPHERE, STR("texture")));
}

static void check_row(const struct schema_element *schema, const struct schema_row *row) {
    assert_int_equal(has_numbers(row), row->range != SCHEMA_RANGE_NONE);
    assert_int_equal((row->kind == SCHEMA_TEXT && row->text == SCHEMA_TEXT_PATH) ||
                         (row->kind == SCHEMA_REFERENCE && row->child == &SCHEMA_MESH),
                     row->file != SCHEMA_FILE_NONE);
    assert_int_equal(row->kind == SCHEMA_LIST, row->many == SCHEMA_SEQUENCE || row->many == SCHEMA_NAMED_MAP);
    assert_int_equal(row->kind == SCHEMA_ELEMENT || row->kind == SCHEMA_REFERENCE || row->kind == SCHEMA_LIST,
                     row->child != NULL);
    assert_int_equal(row->many == SCHEMA_FIXED, row->fixed_count > 1);
    assert_true(!row->fill || row->kind == SCHEMA_VECTOR || row->kind == SCHEMA_PAIR);
    assert_true(!row->single || row->many == SCHEMA_NAMED_MAP);
    assert_true(!row->required || !row->standard);
    assert_true((size_t)row->offset + row->size <= schema->size);
    if (row->many == SCHEMA_NAMED_MAP)
        assert_true(schema_key_row(row->child) >= 0);
    if (row->kind == SCHEMA_REFERENCE)
        assert_non_null(ir_walk_pool(row->child));
    if (row->key)
        assert_int_equal(row->kind, SCHEMA_TEXT);
    // Something always says what a value is where nothing is written.
    bool may_lack = row->required || row->choice || row->kind == SCHEMA_TEXT || row->child ||
                    row->range == SCHEMA_RANGE_FRAME || // without it nothing moves
                    schema == &SCHEMA_PARAMETER;        // without it there is no bound
    assert_true(row->standard || may_lack);
}

static void test_columns(void **state) {
    (void)state;
    EACH_ELEMENT(e) {
        unsigned keys = 0, shorts = 0, lists = 0;
        for (uint32_t i = 0; i < (*e)->row_count; i++) {
            check_row(*e, &(*e)->rows[i]);
            keys += (*e)->rows[i].key;
            lists += (*e)->rows[i].short_form && (*e)->rows[i].text == SCHEMA_TEXT_LIST;
            shorts += (*e)->rows[i].short_form && (*e)->rows[i].text != SCHEMA_TEXT_LIST;
        }
        assert_true(keys <= 1 && shorts <= 1 && lists <= shorts);
    }
}

static void test_choices(void **state) {
    (void)state;
    EACH_ELEMENT(e) {
        for (uint8_t c = 1; c <= 3; c++) {
            uint64_t alternatives = 0;
            unsigned members = 0;
            for (uint32_t i = 0; i < (*e)->row_count; i++) {
                const struct schema_row *row = &(*e)->rows[i];
                if (row->choice != c)
                    continue;
                assert_false(row->required);
                assert_false(alternatives >> row->alternative & 1);
                alternatives |= UINT64_C(1) << row->alternative;
                members++;
            }
            assert_int_equal(members > 1, (*e)->choices[c - 1].rule != SCHEMA_CHOICE_NONE);
            assert_int_not_equal(members, 1);
            if (members)
                assert_true((*e)->choices[c - 1].tag_offset + sizeof(unsigned) <= (*e)->size);
        }
    }
}

// ---- ranges

static void test_ranges_end_where_they_say(void **state) {
    (void)state;
    for (enum schema_range r = SCHEMA_RANGE_NONE + 1; r < SCHEMA_RANGE_COUNT; r++) {
        const struct schema_range_info *info = schema_range_info(r);
        const double ends[2] = {info->least, info->greatest};
        for (int k = 0; k < 2; k++) {
            double inside = nextafter(ends[k], ends[1 - k]);
            double outside = nextafter(ends[k], k ? INFINITY : -INFINITY);
            if (info->least == info->greatest)
                inside = ends[k];
            assert_int_equal(schema_in_range(r, ends[k]), k || !info->open);
            assert_true(schema_in_range(r, inside));
            assert_false(schema_in_range(r, outside));
            if (info->magnitude) {
                assert_true(schema_in_range(r, -inside));
                assert_false(schema_in_range(r, -outside));
            }
        }
        assert_int_equal(schema_in_range(r, 0), info->magnitude || (info->least < 0 && info->greatest > 0) ||
                                                    (info->least == 0 && !info->open));
        assert_false(schema_in_range(r, NAN));
        assert_false(schema_in_range(r, INFINITY));
        assert_false(schema_in_range(r, -INFINITY));
        assert_true(strlen(info->name) > 0 && strlen(info->text) > 0);
    }
}

static void test_every_range_is_used(void **state) {
    (void)state;
    bool used[SCHEMA_RANGE_COUNT] = {true};
    EACH_ELEMENT(e) {
        for (uint32_t i = 0; i < (*e)->row_count; i++)
            used[(*e)->rows[i].range] = true;
    }
    for (int r = 0; r < SCHEMA_RANGE_COUNT; r++)
        assert_true(used[r]);
}

// ---- defaults and examples

static void check_numbers(const struct schema_row *row, const char *text, uint32_t wanted) {
    uint32_t count = 0;
    str rest = str_from(text);
    while (rest.len) {
        size_t end = 0;
        while (end < rest.len && rest.ptr[end] != ' ')
            end++;
        double value;
        int64_t whole;
        assert_int_equal(number_parse(str_slice(rest, 0, end), &value), NUMBER_OK);
        if (row->kind == SCHEMA_INTEGER)
            assert_int_equal(number_parse_integer(str_slice(rest, 0, end), &whole), NUMBER_OK);
        assert_true(schema_in_range(row->range, value));
        count++;
        rest = str_trim(str_slice(rest, end, rest.len));
    }
    assert_int_equal(count, wanted);
}

static void check_scene_text(const struct schema_row *row, const char *text) {
    switch (row->kind) {
    case SCHEMA_BOOLEAN:
        assert_true(strcmp(text, "true") == 0 || strcmp(text, "false") == 0 ||
                    expression_is_meant(str_from(text)));
        break;
    case SCHEMA_INTEGER:
    case SCHEMA_NUMBER:
        check_numbers(row, text, 1);
        break;
    case SCHEMA_PAIR:
    case SCHEMA_POINT:
        check_numbers(row, text, 2);
        break;
    case SCHEMA_QUAD:
        check_numbers(row, text, 4);
        break;
    case SCHEMA_VECTOR:
    case SCHEMA_COLOR:
        check_numbers(row, text, 3);
        break;
    case SCHEMA_WEIGHTS:
        check_numbers(row, text, 4);
        break;
    case SCHEMA_WORD: {
        bool found = false;
        for (uint32_t i = 0; row->words[i]; i++)
            found = found || strcmp(row->words[i], text) == 0;
        assert_true(found);
        break;
    }
    case SCHEMA_TEXT:
        assert_true((row->text != SCHEMA_TEXT_NAME && row->text != SCHEMA_TEXT_BODY_NAME) ||
                    str_is_name(str_from(text)));
        break;
    default: // docs/reference checks the values of a list
        assert_true(row->kind == SCHEMA_REFERENCE || schema_short_row(row->child) >= 0);
        break;
    }
}

static void test_defaults_and_examples(void **state) {
    (void)state;
    EACH_ELEMENT(e) {
        for (uint32_t i = 0; i < (*e)->row_count; i++) {
            const struct schema_row *row = &(*e)->rows[i];
            if (row->standard)
                check_scene_text(row, row->standard);
            if (row->example)
                check_scene_text(row, row->example);
            assert_true(!row->example_next || row->many == SCHEMA_FIXED);
            if (row->example_next)
                check_scene_text(row, row->example_next);
            // What nobody can guess has an example.
            assert_true(row->example || row->standard || row->child || row->words);
        }
    }
}

static void test_init_gives_the_defaults(void **state) {
    (void)state;
    struct ir_scene scene = {0};
    struct ir_camera camera = {0};
    struct ir_material material = {0};
    struct ir_model model = {0};
    schema_init(&SCHEMA_SCENE, &scene);
    schema_init(&SCHEMA_CAMERA, &camera);
    schema_init(&SCHEMA_MATERIAL, &material);
    schema_init(&SCHEMA_MODEL, &model);
    assert_int_equal(scene.image.width, 1024);
    assert_int_equal(scene.image.height, 768);
    assert_int_equal(scene.trace.max_depth, 16);
    assert_true(scene.trace.min_weight == 0x1p-10);
    assert_true(scene.trace.shadows);
    assert_int_equal(scene.trace.depth_limit, IR_DEPTH_BACKGROUND);
    assert_true(camera.direction.z == -1 && camera.up.y == 1 && camera.fov == 60);
    assert_int_equal(camera.view, IR_VIEW_DIRECTION);
    assert_true(material.albedo.diffuse == 1 && material.albedo.refraction == 0);
    assert_true(material.diffuse_color.color.g == 0.8 && material.specular_exponent == 32);
    assert_true(model.scale.x == 1 && model.scale.y == 1 && model.scale.z == 1);
    assert_int_equal(model.material.index, IR_NO_INDEX);
    assert_int_equal(scene.head.written | material.head.written | model.head.written, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_field_without_a_row),
        cmocka_unit_test(test_every_member_is_counted),
        cmocka_unit_test(test_all_elements_are_listed),
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_docs),
        cmocka_unit_test(test_spellings_find_their_row),
        cmocka_unit_test(test_words_of_other_programs),
        cmocka_unit_test(test_what_other_tools_have),
        cmocka_unit_test(test_columns),
        cmocka_unit_test(test_choices),
        cmocka_unit_test(test_ranges_end_where_they_say),
        cmocka_unit_test(test_every_range_is_used),
        cmocka_unit_test(test_defaults_and_examples),
        cmocka_unit_test(test_init_gives_the_defaults),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
