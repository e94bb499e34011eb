#include "loaded.h"

#include "grammar/ir.h"
#include "grammar/schema.h"

#define SPHERE(rest) "spheres: [{center: [0, 0, 0], radius: 1" rest "}]\n"

static void start(struct loaded *l) {
    loaded_init(l);
}

static void run(struct loaded *l, const char *text) {
    loaded_run(l, text[0] == '<' ? "scene.xml" : "scene.yaml", text, NULL);
}

static void entries_of_included_files_come_first(void **state) {
    (void)state;
    struct loaded l;
    start(&l);
    loaded_add(&l, "a.xml",
               HEAD_XML "<Sphere name=\"a\" radius=\"1\"><Center x=\"0\" y=\"0\" z=\"0\"/></Sphere>" END_XML);
    loaded_add(&l, "b.yaml",
               HEAD_YAML "include: [c.yaml]\nspheres: [{name: b, center: [0, 0, 0], radius: 1}]\n");
    loaded_add(&l, "c.yaml", HEAD_YAML "spheres: [{name: c, center: [0, 0, 0], radius: 1}]\n");
    run(&l, HEAD_YAML "include: [a.xml, b.yaml]\nspheres: [{name: main, center: [0, 0, 0], radius: 1}]\n");
    assert_string_equal(l.codes, "");
    const struct ir_spheres *s = &loaded_scene(&l)->spheres;
    const char *const order[] = {"a", "c", "b", "main"};
    assert_int_equal(s->count, 4);
    for (uint32_t i = 0; i < 4; i++)
        assert_true(str_equal_cstr(s->items[i].name, order[i]));
    assert_int_equal(l.output.scene->includes.count, 0);
    assert_int_equal(l.output.origin.files.count, 4);
    assert_int_equal(l.output.origin.files.items[0].scene->includes.count, 2);
    assert_int_equal(l.output.origin.files.items[0].scene->spheres.count, 1);
    loaded_finish(&l);
}

static void single_elements_merge_by_attribute(void **state) {
    (void)state;
    struct loaded l;
    start(&l);
    loaded_add(&l, "a.yaml",
               HEAD_YAML
               "description: a\nimage: {width: 10, height: 20, samples: 3}\n"
               "background: {image: sky.png, intensity: 2}\ncamera: {fov: 33, look_at: [0, 0, -5]}\n");
    loaded_add(&l, "b.yaml",
               HEAD_YAML
               "description: b\nimage: {height: 21}\ncameras: {side: {}, main: {position: [1, 1, 1]}}\n");
    run(&l, HEAD_YAML "include: [a.yaml, b.yaml]\nimage: {width: 12}\nbackground: {color: 0.5}\ncamera: "
                      "{rotation: [0, 90, 0]}\n");
    assert_string_equal(l.codes, "");
    const struct ir_scene *s = loaded_scene(&l);
    assert_int_equal(s->image.width, 12);  // the including file wins
    assert_int_equal(s->image.height, 21); // a later include wins over an earlier
    assert_int_equal(s->image.samples, 3);
    assert_true(str_equal_cstr(s->description, "a"));
    assert_int_equal(s->background.kind, IR_BACKDROP_COLOR); // one alternative removes the others
    assert_true(s->background.image.len == 0 && s->background.intensity == 2);
    assert_int_equal(s->cameras.count, 2);
    const struct ir_camera *main = &s->cameras.items[0];
    assert_true(main->view == IR_VIEW_ROTATION && main->fov == 33 && main->position.x == 1);
    assert_true(vec3_is_zero(main->look_at));
    span width = ir_place_value(&l.output.origin, &s->image.head, &SCHEMA_IMAGE, "width");
    span samples = ir_place_value(&l.output.origin, &s->image.head, &SCHEMA_IMAGE, "samples");
    assert_true(str_equal_cstr(source_text(&l.sources, width), "12"));
    assert_true(width.source != samples.source);
    // The files themselves stay as they were written.
    const struct ir_scene *a = l.output.origin.files.items[1].scene;
    assert_true(a->image.width == 10 && a->background.kind == IR_BACKDROP_IMAGE);
    loaded_finish(&l);
}

static void bodies_in_place_keep_their_material(void **state) {
    (void)state;
    struct loaded l;
    start(&l);
    loaded_add(&l, "a.yaml", HEAD_YAML "materials: {m: {}}\n" SPHERE(", material: {specular_exponent: 5}"));
    run(&l, HEAD_YAML "include: [a.yaml]\n"
                      "spheres:\n"
                      "  - {center: [0, 0, 0], radius: 1, material: {specular_exponent: 6}}\n"
                      "  - {center: [0, 0, 0], radius: 1, material: m}\n"
                      "models: [{mesh: x.obj, material_map: {A: {specular_exponent: 7}}}]\n");
    assert_string_equal(l.codes, "");
    const struct ir_scene *s = loaded_scene(&l);
    const struct ir_material *m = s->materials.items;
    assert_true(m[s->spheres.items[0].material.index].specular_exponent == 5);
    assert_true(m[s->spheres.items[1].material.index].specular_exponent == 6);
    assert_true(str_equal_cstr(m[s->spheres.items[2].material.index].name, "m"));
    assert_true(m[s->models.items[0].material_map.items[0].to.index].specular_exponent == 7);
    loaded_finish(&l);
}

static void a_file_reached_twice_is_read_once(void **state) {
    (void)state;
    struct loaded l;
    start(&l);
    loaded_add(&l, "a.yaml", HEAD_YAML SPHERE(""));
    loaded_add(&l, "b.yaml", HEAD_YAML "include: [./a.yaml]\n");
    run(&l, HEAD_YAML "include: [a.yaml, b.yaml, a.yaml]\n");
    assert_string_equal(l.codes, "");
    assert_int_equal(loaded_scene(&l)->spheres.count, 1);
    loaded_finish(&l);
}

static void cycles_show_their_chain(void **state) {
    (void)state;
    struct loaded l;
    start(&l);
    loaded_add(&l, "a.yaml", HEAD_YAML "include: [b.xml]\n");
    loaded_add(&l, "b.xml", HEAD_XML "<Include file=\"a.yaml\"/>" END_XML);
    run(&l, HEAD_YAML "include: [a.yaml]\n" SPHERE(", material: nix"));
    assert_string_equal(l.codes, "E304"); // the material may stand in what was not read
    loaded_expect_text(&l, "error: 'a.yaml' includes itself");
    loaded_expect_text(&l, "note: 'a.yaml' includes 'b.xml'");
    loaded_expect_text(&l, "note: 'b.xml' includes 'a.yaml'");
    loaded_finish(&l);
}

static void files_that_are_not_there(void **state) {
    (void)state;
    struct loaded l;
    start(&l);
    run(&l, HEAD_YAML "include: [nix.yaml, mesh.obj, \"\", tests, /etc/hostname]\n");
    assert_string_equal(l.codes, "E601 E605 E217 E603 E602");
    loaded_expect_text(&l, "the included file 'nix.yaml' does not exist");
    loaded_finish(&l);
}

static void limits_of_includes(void **state) {
    (void)state;
    struct loaded l;
    start(&l);
    l.limits.value[LIMIT_INCLUDE_DEPTH] = 2;
    loaded_add(&l, "a.yaml", HEAD_YAML "include: [b.yaml]\n");
    loaded_add(&l, "b.yaml", HEAD_YAML "include: [c.yaml]\n");
    loaded_add(&l, "c.yaml", HEAD_YAML);
    run(&l, HEAD_YAML "include: [a.yaml]\n");
    assert_string_equal(l.codes, "E501");
    loaded_expect_text(&l, "b.yaml:2:11: error: the chain of includes is too long");
    loaded_expect_text(&l, "scene.yaml:2:11: note: included here");
    loaded_finish(&l);
    start(&l);
    l.limits.value[LIMIT_INCLUDE_FILES] = 1;
    loaded_add(&l, "a.yaml", HEAD_YAML);
    loaded_add(&l, "b.yaml", HEAD_YAML);
    run(&l, HEAD_YAML "include: [a.yaml, b.yaml]\n");
    assert_string_equal(l.codes, "E501");
    loaded_finish(&l);
}

static void memory_has_a_limit(void **state) {
    (void)state;
    struct loaded l;
    start(&l);
    l.limits.value[LIMIT_SCENE_MEMORY] = 600;
    run(&l, HEAD_YAML SPHERE(""));
    assert_false(l.ok);
    assert_string_equal(l.codes, "E501");
    loaded_expect_text(&l, "--limit scene-memory=");
    assert_null(l.arena.guard);
    loaded_finish(&l);
}

static void included_files_need_their_own_line(void **state) {
    (void)state;
    struct loaded l;
    start(&l);
    loaded_add(&l, "a.yaml", SPHERE(", fov: 1"));
    run(&l, HEAD_YAML "include: [a.yaml]\n");
    assert_string_equal(l.codes, "E204 E202");
    loaded_expect_text(&l, "scene.yaml:2:11: note: included here");
    loaded_finish(&l);
}

static void names_are_used_once(void **state) {
    (void)state;
    struct loaded l;
    start(&l);
    loaded_add(&l, "a.yaml",
               HEAD_YAML
               "materials: {m: {}}\ncameras: {c: {}}\nspheres: [{name: x, center: [0, 0, 0], radius: 1}]\n");
    run(&l, HEAD_YAML "include: [a.yaml]\nmaterials: {m: {}}\ncameras: {c: {}}\nlights: [{name: x, position: "
                      "[0, 0, 0]}]\n");
    assert_string_equal(l.codes, "E303 E303 E303");
    loaded_expect_text(&l, "scene.yaml:3:13: error: two materials have the name 'm'");
    loaded_expect_text(&l, "a.yaml:2:13: note: the first one is here");
    loaded_expect_text(&l, "a sphere and a light have the name 'x'");
    loaded_finish(&l);
    loaded_check(HEAD_XML "<Material name=\"a\"/><Material name=\"a\"/>" END_XML, "E303", NULL);
    loaded_check(HEAD_XML "<Camera/><Camera/>" END_XML, "E303", "a camera without a name is called 'main'");
    loaded_check(HEAD_YAML "materials: {x: {}}\ncameras: {x: {}}\nlights: [{name: x, position: [0, 0, 0]}]\n",
                 "", NULL);
}

static void names_find_what_they_name(void **state) {
    (void)state;
    loaded_check(HEAD_YAML SPHERE(", material: glas") "materials: {glass: {}, jade: {}}\n", "E301",
                 "did you mean 'glass'?");
    loaded_check(HEAD_YAML SPHERE(", material: lead") "materials: {iron: {}, jade: {}}\n", "E301",
                 "there are: iron, jade");
    loaded_check(HEAD_YAML SPHERE(", material: gold"), "E301", "{preset: gold}");
    loaded_check(HEAD_YAML SPHERE(", material: lead"), "E301", "the scene defines no material");
    // A material with a bad name or of a bad shape is there all the same.
    loaded_check(HEAD_YAML SPHERE(", material: 1x") "materials: {1x: {}}\n", "E212", NULL);
    loaded_check(HEAD_YAML SPHERE(", material: x") "materials: {x: 5}\n", "E209", NULL);
    // So is one in a list of the wrong shape, or under a misspelt key.
    loaded_check(HEAD_YAML SPHERE(", material: x") "materials: [{name: x}]\n", "E209", NULL);
    loaded_check(HEAD_YAML SPHERE(", material: x") "material: {x: {}}\n", "E202", NULL);
    loaded_check(HEAD_XML "<Materials><Material name=\"x\"/></Materials><Sphere radius=\"1\" "
                          "material=\"x\"><Center x=\"0\" y=\"0\" z=\"0\"/></Sphere>" END_XML,
                 "E202", NULL);
    // What the reader could not read may define the name.
    struct loaded l;
    loaded_yaml(&l, HEAD_YAML SPHERE(", material: gold") "materials: {gold\n\"");
    assert_true(l.sink.count == 1 && l.codes[1] == '1');
    loaded_finish(&l);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(entries_of_included_files_come_first),
        cmocka_unit_test(single_elements_merge_by_attribute),
        cmocka_unit_test(bodies_in_place_keep_their_material),
        cmocka_unit_test(a_file_reached_twice_is_read_once),
        cmocka_unit_test(cycles_show_their_chain),
        cmocka_unit_test(files_that_are_not_there),
        cmocka_unit_test(limits_of_includes),
        cmocka_unit_test(memory_has_a_limit),
        cmocka_unit_test(included_files_need_their_own_line),
        cmocka_unit_test(names_are_used_once),
        cmocka_unit_test(names_find_what_they_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
