// Which material a face has, and what a material file means.
#include "assets_scene.h"
#include "diag/codes/file.h"
#include "diag/codes/rule.h"

#include "core/strbuf.h"

#include <math.h>
#include <string.h>

#define VERTICES "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
#define MESH     "mtllib own.mtl\n" VERTICES "usemtl gold\nf 1 2 3\nusemtl glass\nf 1 2 3\n"

static const struct ir_material *material_of(const struct assets_scene *s, uint32_t model, uint32_t group) {
    return &s->assets.materials[s->assets.models[model].group_material[group]];
}

// The first material of a material file, as a face has it.
static const struct ir_material *from_mtl(struct assets_scene *s, const char *lines) {
    str text = arena_format(&s->arena, "newmtl gold\n%s\n", lines);
    assets_scene_file(s, "own.mtl", text.ptr);
    assert_non_null(assets_scene_mesh(s, "mtllib own.mtl\n" VERTICES "usemtl gold\nf 1 2 3\n"));
    return material_of(s, 0, 0);
}

static void assert_weights(struct ir_weights w, double diffuse, double specular, double reflection,
                           double refraction) {
    double got[4] = {w.diffuse, w.specular, w.reflection, w.refraction};
    double expected[4] = {diffuse, specular, reflection, refraction};
    for (int i = 0; i < 4; i++)
        if (fabs(got[i] - expected[i]) > 1e-15)
            fail_msg("weight %d is %.17g, not %.17g", i, got[i], expected[i]);
}

static void every_value_has_its_place(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct ir_material *m = from_mtl(
        s, "  Kd .1 .2 .3\n\tKs 0.5 0.25 0.75\nNs 250\nNi 1.45\nd 0.75\nKe 0 2 1\nPr 0.5\nillum 2 # plain");
    assert_int_equal(s->sink.count, assets_scene_count(s, DIAG_OPEN_DIELECTRIC));
    assert_true(str_equal_cstr(m->name, "gold"));
    assert_int_equal(m->diffuse_color.kind, IR_PAINT_COLOR);
    assert_true(m->diffuse_color.color.r == .1 && m->diffuse_color.color.g == .2 &&
                m->diffuse_color.color.b == .3);
    assert_true(m->specular_color.color.r == .5 && m->specular_color.color.g == .25 &&
                m->specular_color.color.b == .75);
    assert_true(m->specular_exponent == 250 && m->refractive_index == 1.45);
    assert_true(m->emission.r == 0 && m->emission.g == 2 && m->emission.b == 1 && m->roughness == 0.5);
    assert_weights(m->albedo, 0.75, 1, 0, 0.25);
    assert_int_equal(m->head.origin, 0);
    assets_scene_end(s);
}

static void weights_follow_from_illum_and_transparency(void **state) {
    (void)state;
    static const struct {
        const char *lines;
        double weights[4];
    } cases[] = {
        {"", {1, 0, 0, 0}},
        {"Ks 0 0 0\nillum 3", {1, 0, 0, 0}},
        {"Ks 0 .5 .25\nillum 3", {1, 1, .5, 0}},
        {"Ks .5\nillum 7\nd 0\nNi 1.5", {0, 1, .5, 1}},
        {"Ks .5 .5 .5\nillum 8", {1, 1, 0, 0}},
        {"Ks .5 .5 .5\nillum 2", {1, 1, 0, 0}},
        {"Tr 0.75", {.25, 0, 0, .75}},
        {"d 0.5\nTr 0.75", {.5, 0, 0, .5}},
        {"Tr 0.75\nd 0.5", {.5, 0, 0, .5}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct assets_scene *s = assets_scene_begin();
        const double *w = cases[i].weights;
        assert_weights(from_mtl(s, cases[i].lines)->albedo, w[0], w[1], w[2], w[3]);
        // An open mesh that refracts is warned of elsewhere; so are a Tr and a d that do not agree.
        bool disagree = strstr(cases[i].lines, "Tr 0.75") && strstr(cases[i].lines, "d 0.5");
        assert_int_equal(assets_scene_count(s, DIAG_MTL_DROPPED), disagree);
        assert_int_equal(s->sink.count, assets_scene_count(s, DIAG_OPEN_DIELECTRIC) + disagree);
        assets_scene_end(s);
    }
}

static void fresnel_follows_from_illum_and_the_index(void **state) {
    (void)state;
    static const struct {
        const char *lines;
        bool fresnel, told;
    } cases[] = {
        {"Ks 1\nillum 5\nNi 1.5", true, false},  {"illum 7\nNi 1.5\nd 0", true, false},
        {"Ks 1\nillum 3\nNi 1.5", false, false}, {"illum 6\nNi 1.5\nd 0", false, false},
        {"illum 7\nd 0", false, true},           {"Ks 1\nillum 5\nNi 1", false, true},
        {"illum 5\nNi 1.5", false, false}, // nothing to mirror
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct assets_scene *s = assets_scene_begin();
        assert_int_equal(from_mtl(s, cases[i].lines)->fresnel, cases[i].fresnel);
        assert_int_equal(assets_scene_count(s, DIAG_MTL_DROPPED), cases[i].told);
        assets_scene_end(s);
    }
}

static void what_illum_and_filters_cannot_do_is_told(void **state) {
    (void)state;
    static const struct {
        const char *lines, *told; // NULL: nothing
    } cases[] = {
        {"Tf .5 .9 1\nd 0\nNi 1.5", "own.mtl:2:1: warning: 'Tf' has no effect: light takes its colour on its "
                                    "way inside, and not at surfaces [W605]"},
        {"illum 4\nTf .5\nNi 1", "own.mtl:3:1: warning: 'Tf' has no effect: 'd' and 'Tr' say how much light "
                                 "is let through, and neither lets any [W605]"},
        {"Tf 1\nillum 4\nNi 1", NULL}, // as Maya writes what is opaque
        {"illum 4\nNi 1.5", "own.mtl:2:1: warning: 'illum 4' has no effect: 'd' and 'Tr' say how much"},
        {"illum 4\nNi 1.5\nd 1", NULL},
        {"illum 1\nKs .5", "own.mtl:2:1: warning: 'illum 1' has no effect: 'Ks' gives a highlight [W605]"},
        {"illum 1\nKs 0", NULL},
        {"illum 0", "own.mtl:2:1: warning: 'illum 0' has no effect: all surfaces are shaded [W605]"},
        {"illum 10", "own.mtl:2:1: warning: 'illum 10' has no effect: all surfaces are seen [W605]"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct assets_scene *s = assets_scene_begin();
        from_mtl(s, cases[i].lines);
        assert_int_equal(assets_scene_count(s, DIAG_MTL_DROPPED), cases[i].told != NULL);
        if (cases[i].told)
            assert_says(s, cases[i].told);
        assets_scene_end(s);
    }
}

static void what_is_not_written_has_the_default(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct ir_material *m = from_mtl(s, "illum 2");
    struct ir_material standard = {0};
    schema_init(&SCHEMA_MATERIAL, &standard);
    standard.name = m->name;
    assert_memory_equal(m, &standard, sizeof standard);
    assets_scene_end(s);
}

static void each_kind_of_unused_line_is_a_warning(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    from_mtl(s, "Ka 1 1 1\nmap_Kd wood.png\nKa 0 0 1\nKa 0 0 0\nd -halo 0.5\nKs spectral a.rfl 1");
    assert_int_equal(assets_scene_count(s, DIAG_MTL_DROPPED), 4);
    assert_says(s, "own.mtl:2:1: warning: 'Ka' has no effect (2 lines): ambient light is the scene's");
    assert_says(s, "own.mtl:3:1: warning: 'map_Kd' has no effect: 'wood.png' cannot be found");
    assert_says(s, "own.mtl:6:3: warning: '-halo' has no effect: transparency does not depend on the angle");
    assert_says(s, "own.mtl:7:1: warning: 'Ks spectral' has no effect: colours are three numbers");
    assert_says(s, "mesh.obj:1:1: note: the material file is named here");
    assert_says(s, "scene.yaml:1:7: note: the mesh is named here");
    assert_weights(material_of(s, 0, 0)->albedo, .5, 0, 0, .5);
    assets_scene_end(s);
}

static void what_changes_nothing_is_not_told(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    from_mtl(s, "Ke 0 0 0\nKa 0.0 0 0\nTf 1 1 1\nsharpness 0\nd 0.999\nTr 0.001");
    assert_int_equal(assets_scene_count(s, DIAG_MTL_DROPPED), 0);
    assets_scene_end(s);
}

// However many kinds there are, a file of another format cannot flood the report.
static void many_kinds_share_the_last_warning(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    struct strbuf lines;
    strbuf_init(&lines);
    for (int i = 0; i < 1000; i++)
        strbuf_format(&lines, "word%d 1\n", i);
    strbuf_char(&lines, '\0');
    from_mtl(s, lines.data);
    assert_int_equal(assets_scene_count(s, DIAG_MTL_DROPPED), 16);
    assert_says(s,
                "own.mtl:17:1: warning: 'word15' and others have no effect (985 lines): glint does not know");
    strbuf_finish(&lines);
    assets_scene_end(s);
}

static void a_second_material_of_a_name_is_told(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct ir_material *m = from_mtl(s, "Kd 1 0 0\nnewmtl gold\nKd 0 1 0\nnewmtl gold");
    assert_true(m->diffuse_color.color.r == 1);
    assert_int_equal(assets_scene_count(s, DIAG_MTL_DROPPED), 1);
    assert_says(s, "own.mtl:3:1: warning: 'newmtl gold' has no effect (2 lines): a material of this name");
    assets_scene_end(s);
}

static void values_before_the_first_material_are_told(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    assets_scene_file(s, "own.mtl", "Kd 1 0 0\nnewmtl gold\n");
    assert_non_null(assets_scene_mesh(s, "mtllib own.mtl\n" VERTICES "usemtl gold\nf 1 2 3\n"));
    assert_says(s, "own.mtl:1:1: warning: 'Kd' has no effect: it comes before the first 'newmtl' [W605]");
    assets_scene_end(s);
}

static void values_outside_their_range_are_cut_with_a_warning(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct ir_material *m = from_mtl(s, "Ni 0\nNs -2\nd 1.5\nKd 0 -1 0");
    assert_true(m->refractive_index == 0.1 && m->specular_exponent == 0 && m->diffuse_color.color.g == 0);
    assert_weights(m->albedo, 1, 0, 0, 0);
    assert_int_equal(assets_scene_count(s, DIAG_MTL_RANGE), 4);
    assert_says(s, "own.mtl:2:4: warning: 0 is outside the range from 0.1 to 10; 0.1 is used [W603]");
    assert_int_equal(s->sink.errors, 0);
    assets_scene_end(s);
}

static void bad_values_are_errors(void **state) {
    (void)state;
    static const struct {
        const char *lines;
        const char *message;
    } cases[] = {
        {"Kd 1 x 0", "own.mtl:2:6: error: 'x' is not a number [E615]"},
        {"Ns nan", "own.mtl:2:4: error: 'nan' is not a finite number [E615]"},
        {"Kd", "own.mtl:2:1: error: 'Kd' needs a number [E615]"},
        {"Kd 1 1", "own.mtl:2:1: error: 'Kd' has 2 numbers; it needs 3, or 1 for all three [E615]"},
        {"newmtl", "own.mtl:2:1: error: 'newmtl' needs a name [E615]"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct assets_scene *s = assets_scene_begin();
        from_mtl(s, cases[i].lines);
        assert_says(s, cases[i].message);
        assert_says(s, "mesh.obj:1:1: note: the material file is named here");
        assert_int_equal(s->sink.errors, 1);
        assets_scene_end(s);
    }
}

static void the_first_of_one_name_counts(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    assert_true(from_mtl(s, "Ns 5\nnewmtl other\nNs 6\nnewmtl gold\nNs 7")->specular_exponent == 5);
    assert_int_equal(s->assets.material_count, 2); // the default one, and gold
    assets_scene_end(s);
}

// ---- which material

static void map_then_material_then_file_then_default(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    uint32_t brass = assets_scene_material(s, "brass", 0);
    uint32_t stone = assets_scene_material(s, "stone", 0);
    assets_scene_file(s, "own.mtl", "newmtl glass\nNs 9\n");
    assets_scene_file(s, "mesh.obj", VERTICES "f 1 2 3\n" MESH);
    for (int i = 0; i < 4; i++) {
        struct ir_model *model = assets_scene_model(s, "mesh.obj");
        if (i & 1)
            model->material = (struct ir_reference){STR("stone"), stone};
        if (i & 2) {
            struct ir_map_entry *entry = ARENA_PUSH(&s->arena, &model->material_map);
            *entry = (struct ir_map_entry){.from = STR("gold"), .to = {STR("brass"), brass}};
        }
    }
    assets_scene_load(s);
    // Faces without usemtl, of gold, of glass; 2 is the default, 3 the glass of the material file.
    static const uint32_t expected[4][3] = {{2, 2, 3}, {1, 1, 1}, {2, 0, 3}, {1, 0, 1}};
    for (uint32_t i = 0; i < 4; i++)
        for (uint32_t g = 0; g < 3; g++)
            assert_int_equal(s->assets.models[i].group_material[g], expected[i][g]);
    assert_int_equal(s->assets.material_count, 4);
    assert_true(str_equal_cstr(s->assets.materials[3].name, "glass"));
    // gold is missing once, whoever asks.
    assert_int_equal(s->sink.count, 1);
    assert_says(
        s,
        "mesh.obj:9:1: warning: no material file defines 'gold'; its faces get the default material [W602]");
    assets_scene_end(s);
}

static void files_are_read_where_a_face_needs_them(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    uint32_t stone = assets_scene_material(s, "stone", 0);
    assets_scene_file(s, "mesh.obj", MESH);
    assets_scene_model(s, "mesh.obj")->material.index = stone;
    struct ir_model *mapped = assets_scene_model(s, "mesh.obj");
    static const char *const names[] = {"gold", "glass"};
    for (int i = 0; i < 2; i++)
        *ARENA_PUSH(&s->arena, &mapped->material_map) =
            (struct ir_map_entry){.from = str_from(names[i]), .to = {STR("stone"), stone}};
    // A reference that was not found has its message: nothing else is looked for.
    assets_scene_model(s, "mesh.obj")->material.name = STR("ston");
    assets_scene_load(s);
    assert_silent(s); // own.mtl does not exist
    assert_int_equal(s->assets.models[2].group_material[0], 1);
    assets_scene_end(s);
}

static void a_missing_file_is_a_warning(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    assets_scene_file(s, "mesh.obj", MESH);
    assets_scene_model(s, "mesh.obj");
    assets_scene_model(s, "mesh.obj");
    assets_scene_load(s);
    assert_int_equal(s->sink.count, 1);
    assert_int_equal(s->sink.errors, 0);
    assert_says(s, "mesh.obj:1:1: warning: the material file 'own.mtl' does not exist");
    assert_says(s, "scene.yaml:1:7: note: the mesh is named here");
    assert_int_equal(s->assets.models[1].group_material[1], 0);
    assets_scene_end(s);
}

static void a_mesh_without_material_file(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    assets_scene_mesh(s, VERTICES "usemtl red\nf 1 2 3\n");
    assert_says(s, "mesh.obj:4:1: warning: the mesh names no material file that could define 'red'");
    assert_int_equal(s->sink.count, 1);
    assets_scene_end(s);
}

static void names_of_files_may_be_several_or_have_blanks(void **state) {
    (void)state;
    static const struct {
        const char *line;
        const char *files[2];
    } cases[] = {
        {"mtllib a.mtl b.mtl", {"a.mtl", "b.mtl"}},
        {"mtllib a.mtl\nmtllib b.mtl", {"a.mtl", "b.mtl"}},
        {"mtllib my own.mtl", {"my own.mtl", NULL}},
        {"mtllib my own.mtl an other.MTL ", {"my own.mtl", "an other.MTL"}},
        {"mtllib both.mtl of them.mtl", {"both.mtl of them.mtl", NULL}},
        {"mtllib tests\\own.mtl", {"tests/own.mtl", NULL}},
        {"mtllib ./own", {"own", NULL}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct assets_scene *s = assets_scene_begin();
        bool two = cases[i].files[1];
        assets_scene_file(s, cases[i].files[0],
                          two ? "newmtl gold\nNs 3\n" : "newmtl gold\nNs 3\nnewmtl glass\nNs 4\n");
        if (two)
            assets_scene_file(s, cases[i].files[1], "newmtl glass\nNs 4\n");
        str mesh = arena_format(&s->arena, "%s\n%s", cases[i].line,
                                VERTICES "usemtl gold\nf 1 2 3\nusemtl glass\nf 1 2 3\n");
        assets_scene_mesh(s, mesh.ptr);
        assert_silent(s);
        assert_true(material_of(s, 0, 0)->specular_exponent == 3);
        assert_true(material_of(s, 0, 1)->specular_exponent == 4);
        assets_scene_end(s);
    }
}

static void an_unknown_name_in_the_map(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    uint32_t stone = assets_scene_material(s, "stone", 0);
    assets_scene_file(s, "mesh.obj", MESH "usemtl unused\n");
    struct ir_model *model = assets_scene_model(s, "mesh.obj");
    model->material.index = stone;
    static const char *const names[] = {"Glas", "unused"};
    for (int i = 0; i < 2; i++) {
        struct ir_map_entry *entry = ARENA_PUSH(&s->arena, &model->material_map);
        *entry = (struct ir_map_entry){.from = str_from(names[i]), .to = {STR("stone"), stone}};
        entry->head.origin = assets_scene_place(s, &SCHEMA_MAP_ENTRY, "from", names[i]);
    }
    assets_scene_load(s);
    assert_says(s, "scene.yaml:1:7: error: no face of the mesh 'mesh.obj' has the material 'Glas' [E305]");
    assert_says(s, "= help: did you mean 'glass'? The mesh uses 'gold', 'glass'\n");
    assert_says(s, "scene.yaml:1:7: error: no face of the mesh 'mesh.obj' has the material 'unused' [E305]");
    assert_int_equal(s->sink.errors, 2);
    assets_scene_end(s);
}

static void of_many_names_some_are_shown(void **state) {
    (void)state;
    for (uint32_t count = 12; count < 15; count++) {
        struct assets_scene *s = assets_scene_begin();
        str mesh = STR(VERTICES), shown = STR("");
        for (uint32_t i = 0; i < count; i++) {
            mesh = arena_format(&s->arena, "%susemtl m%u\nf 1 2 3\n", mesh.ptr, i);
            if (i < 12)
                shown = arena_format(&s->arena, "%s%s'm%u'", shown.ptr, i ? ", " : "", i);
        }
        assets_scene_file(s, "mesh.obj", mesh.ptr);
        struct ir_model *model = assets_scene_model(s, "mesh.obj");
        model->material.index = assets_scene_material(s, "stone", 0);
        struct ir_map_entry *entry = ARENA_PUSH(&s->arena, &model->material_map);
        *entry = (struct ir_map_entry){.from = STR("velvet"), .to = {STR("stone"), model->material.index}};
        entry->head.origin = assets_scene_place(s, &SCHEMA_MAP_ENTRY, "from", "velvet");
        assets_scene_load(s);
        str help =
            arena_format(&s->arena, count > 12 ? "the mesh uses %s and %u more\n" : "the mesh uses %s\n",
                         shown.ptr, count - 12);
        assert_says(s, help.ptr);
        assets_scene_end(s);
    }
}

// A material file with an error may define anything: that a name is not found there is not said too.
static void an_error_in_the_file_is_enough(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    assets_scene_file(s, "own.mtl", "newmtl silver\nKd red\n");
    assets_scene_mesh(s, MESH);
    assert_int_equal(s->sink.errors, 1);
    assert_int_equal(s->sink.count, 1);
    assets_scene_end(s);
}

static void refraction_needs_a_closed_mesh(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    uint32_t glass = assets_scene_material(s, "glass", 0.8);
    assets_scene_file(s, "open.obj", VERTICES "v 0 0 1\n\nf 1 3 2\nf 1 2 4\nf 2 3 4\n");
    assets_scene_file(s, "closed.obj", VERTICES "v 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    assets_scene_model(s, "open.obj")->material.index = glass;
    assets_scene_model(s, "closed.obj")->material.index = glass;
    assets_scene_model(s, "open.obj");
    assets_scene_load(s);
    assert_int_equal(s->sink.count, 1);
    assert_says(s, "scene.yaml:1:1: warning: the mesh 'open.obj' is open and its material refracts");
    assert_says(s, "open.obj:6:1: note: 3 edges belong to only one face, the first to this face");
    assets_scene_end(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_value_has_its_place),
        cmocka_unit_test(weights_follow_from_illum_and_transparency),
        cmocka_unit_test(fresnel_follows_from_illum_and_the_index),
        cmocka_unit_test(what_illum_and_filters_cannot_do_is_told),
        cmocka_unit_test(what_is_not_written_has_the_default),
        cmocka_unit_test(each_kind_of_unused_line_is_a_warning),
        cmocka_unit_test(what_changes_nothing_is_not_told),
        cmocka_unit_test(many_kinds_share_the_last_warning),
        cmocka_unit_test(a_second_material_of_a_name_is_told),
        cmocka_unit_test(values_before_the_first_material_are_told),
        cmocka_unit_test(values_outside_their_range_are_cut_with_a_warning),
        cmocka_unit_test(bad_values_are_errors),
        cmocka_unit_test(the_first_of_one_name_counts),
        cmocka_unit_test(map_then_material_then_file_then_default),
        cmocka_unit_test(files_are_read_where_a_face_needs_them),
        cmocka_unit_test(a_missing_file_is_a_warning),
        cmocka_unit_test(a_mesh_without_material_file),
        cmocka_unit_test(names_of_files_may_be_several_or_have_blanks),
        cmocka_unit_test(an_unknown_name_in_the_map),
        cmocka_unit_test(of_many_names_some_are_shown),
        cmocka_unit_test(an_error_in_the_file_is_enough),
        cmocka_unit_test(refraction_needs_a_closed_mesh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
