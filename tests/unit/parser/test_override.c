#include "loaded.h"

#include "grammar/ir.h"
#include "grammar/schema.h"

static const char SCENE[] =
    HEAD_YAML "image: {width: 100}\n"
              "camera: {position: [0, 0, 5], look_at: [0, 0, 0]}\n"
              "lights:\n"
              "  - {name: key, position: [1, 2, 3]}\n"
              "  - {direction: [0, -1, 0], color: \"#ff0000\"}\n"
              "materials:\n"
              "  glass: {albedo: [0, 0.5, 0.1, 0.8]}\n"
              "  floor: {diffuse_color: {checker: {colors: [1, 0], size: 2}}}\n"
              "spheres:\n"
              "  - {name: ball, center: [0, 0, 0], radius: 1, material: glass}\n"
              "  - {center: [0, 2, 0], radius: 1, material: {specular_exponent: 7}}\n"
              "models:\n"
              "  - {name: dragon, mesh: x.obj, material_map: {Gold: glass, Iron: floor}}\n";

static void set(struct loaded *l, const char *a, const char *b) {
    const char *const sets[] = {a, b, NULL};
    loaded_init(l);
    loaded_run(l, "scene.yaml", SCENE, sets);
}

static const struct ir_scene *good(struct loaded *l, const char *a, const char *b) {
    set(l, a, b);
    if (l->codes[0])
        loaded_expect_text(l, "(no message)");
    return loaded_scene(l);
}

static void rows_and_their_places(void **state) {
    (void)state;
    struct loaded l;
    const struct ir_scene *s = good(&l, "image.height=50", "background.color=0.5");
    assert_true(s->image.width == 100 && s->image.height == 50);
    assert_true(s->background.color.g == 0.5);
    assert_true(s->head.written & (1u << schema_find_row(&SCHEMA_SCENE, STR("background"))));
    span at = ir_place_value(&l.output.origin, &s->image.head, &SCHEMA_IMAGE, "height");
    assert_true(str_equal_cstr(source_text(&l.sources, at), "50"));
    assert_true(l.sources.items[at.source].kind == SOURCE_KIND_OPTION);
    // The file's own scene and places are as written.
    const struct ir_scene *file = l.output.origin.files.items[0].scene;
    assert_int_equal(file->image.height, 768);
    assert_null(ir_origin_row(&l.output.origin, &file->image.head, 1));
    loaded_finish(&l);
    s = good(&l, "background.color=#8090a0", "image.height = 50");
    assert_true(s->background.color.is_hex && s->background.color.hex == 0x8090A0);
    assert_int_equal(s->image.height, 50);
    loaded_finish(&l);
}

static void later_options_win(void **state) {
    (void)state;
    struct loaded l;
    assert_int_equal(good(&l, "image.width=50", "image.width=60")->image.width, 60);
    loaded_finish(&l);
}

static void entries_by_number_and_name(void **state) {
    (void)state;
    struct loaded l;
    const struct ir_scene *s = good(&l, "lights[1].intensity=2", "lights[key].intensity=3");
    assert_true(s->lights.items[1].intensity == 2 && s->lights.items[0].intensity == 3);
    loaded_finish(&l);
    s = good(&l, "materials.glass.refractive_index=1.5", "materials[floor].specular_exponent=3");
    assert_true(s->materials.items[0].refractive_index == 1.5 &&
                s->materials.items[1].specular_exponent == 3);
    loaded_finish(&l);
    s = good(&l, "camera.fov=30", "cameras.main.position.y=4");
    assert_true(s->cameras.items[0].fov == 30 && s->cameras.items[0].position.y == 4);
    loaded_finish(&l);
    s = good(&l, "models[dragon].material_map.Gold=floor", "spheres[1].material.albedo.reflection=0.5");
    assert_int_equal(s->models.items[0].material_map.items[0].to.index, 1);
    const struct ir_material *own = &s->materials.items[s->spheres.items[1].material.index];
    assert_true(own->albedo.reflection == 0.5 && own->albedo.diffuse == 1 && own->specular_exponent == 7);
    loaded_finish(&l);
    s = good(&l, "materials.floor.diffuse_color.checker.colors[1].g=0.25",
             "materials.glass.diffuse_color.r=0.5");
    assert_true(s->materials.items[1].diffuse_color.checker.colors[1].g == 0.25);
    assert_true(s->materials.items[0].diffuse_color.color.r == 0.5 &&
                s->materials.items[0].diffuse_color.color.g == 0.8);
    loaded_finish(&l);
}

static void alternatives_replace_each_other(void **state) {
    (void)state;
    struct loaded l;
    const struct ir_scene *s =
        good(&l, "camera.direction=[1, 0, 0]", "lights[0].direction={x: 0, y: 0, z: 1}");
    assert_true(s->cameras.items[0].view == IR_VIEW_DIRECTION && s->cameras.items[0].direction.x == 1);
    assert_false(s->cameras.items[0].head.written & (1u << schema_find_row(&SCHEMA_CAMERA, STR("look_at"))));
    assert_true(s->lights.items[0].kind == IR_LIGHT_DIRECTION);
    loaded_finish(&l);
    s = good(&l, "materials.floor.diffuse_color=[1, 0, 0]", NULL);
    assert_true(s->materials.items[1].diffuse_color.kind == IR_PAINT_COLOR);
    loaded_finish(&l);
}

static void whole_entries_and_lists(void **state) {
    (void)state;
    struct loaded l;
    const struct ir_scene *s =
        good(&l, "spheres[0]={center: [9, 9, 9], radius: 3}", "materials.new={specular_exponent: 2}");
    assert_true(s->spheres.items[0].center.x == 9 && s->spheres.items[0].name.len == 0);
    bool found = false;
    for (uint32_t i = 0; i < s->materials.count; i++)
        found = found || (str_equal_cstr(s->materials.items[i].name, "new") &&
                          s->materials.items[i].specular_exponent == 2);
    assert_true(found);
    loaded_finish(&l);
    s = good(&l, "lights=[{position: [7, 7, 7]}]", "materials={glass: {}, floor: {}}");
    assert_true(s->lights.count == 1 && s->lights.items[0].position.x == 7);
    assert_true(s->materials.items[s->spheres.items[1].material.index].specular_exponent == 7);
    loaded_finish(&l);
    s = good(&l, "camera={fov: 20}", "spheres[1].material=glass");
    assert_true(s->cameras.count == 1 && s->cameras.items[0].fov == 20 &&
                s->cameras.items[0].view == IR_VIEW_DIRECTION);
    assert_int_equal(s->materials.count, 2); // the one in place is gone
    loaded_finish(&l);
}

static void removing(void **state) {
    (void)state;
    struct loaded l;
    const struct ir_scene *s = good(&l, "image.width=", "camera.look_at=");
    assert_true(s->image.width == 1024 && s->image.head.written == 0);
    assert_true(s->cameras.items[0].view == IR_VIEW_DIRECTION);
    loaded_finish(&l);
    s = good(&l, "lights[0]=", "lights[0]= ");
    assert_int_equal(s->lights.count, 0);
    assert_false(s->head.written & (1u << schema_find_row(&SCHEMA_SCENE, STR("light"))));
    loaded_finish(&l);
    s = good(&l, "models=", "materials.floor=");
    assert_int_equal(s->models.count, 0);
    assert_true(s->materials.items[s->spheres.items[1].material.index].specular_exponent == 7);
    loaded_finish(&l);
    set(&l, "spheres[0].radius=", "lights[0].position=");
    assert_string_equal(l.codes, "E204 E215");
    loaded_expect_text(&l, "--set:1:1: error: sphere 'ball' lacks 'radius'");
    loaded_finish(&l);
    set(&l, "materials.glass=", NULL);
    assert_string_equal(l.codes, "E301 E301");
    loaded_finish(&l);
}

static void expect(const char *option, const char *codes, const char *part) {
    struct loaded l;
    set(&l, option, NULL);
    if (strcmp(l.codes, codes) != 0)
        loaded_expect_text(&l, "(codes differ)");
    loaded_expect_text(&l, part);
    loaded_finish(&l);
}

static void mistakes_in_the_value(void **state) {
    (void)state;
    expect("image.width=0x5", "E205", "--set:1:13: error: 'image.width': '0x5' is hexadecimal");
    expect("camera.fov=400", "E206", "--set:1:12: error: 'fov' of camera 'main' is 400");
    expect("camera.fov=200", "E206", "in perspective");
    expect("camera.fov=~", "E121", "has no value");
    expect("camera.look_at=[0, 0, 5]", "E401", "--set:1:16: error: camera 'main' looks at its own position");
    expect("spheres[0].material=glas", "E301", "did you mean 'glass'?");
    expect("materials.glass.ior=1", "E220", "did you mean 'refractive_index'?");
    expect("lights[0].type=1", "E220", "a light has no type");
    expect("materials.glass={albdo: 1}", "E202", "--set:1:18: error: a material has no 'albdo'");
    expect("image.width=[1", "E219", "--set:1:");
    expect("image.width=#ffffff", "E205", "'#ffffff' is not a number");
    expect("background.color=[#ffffff]", "E120", "write \"#ffffff\"");
}

static void mistakes_in_the_path(void **state) {
    (void)state;
    expect("image.width =x", "E205", "--set:1:14: error: 'image.width': 'x' is not a number");
    expect("image .width=5", "E220", "did you mean 'image'?");
    expect("image", "E219", "'=' is missing after the path");
    expect("=5", "E219", "the path is missing before '='");
    expect("a..b=5", "E219", "--set:1:3: error: a key is missing here");
    expect("lights[0=5", "E219", "']' is missing");
    expect("lights[]=5", "E219", "a number or name is missing here");
    expect("lights[0]x=5", "E219", "a '.' or '[' is missing here");
    expect("lights[-1].x=5", "E219", "entries are counted from 0");
    expect("image.widht=5", "E220", "did you mean 'width'?");
    expect("imag.width=5", "E220", "did you mean 'image'?");
    expect("image.width.x=5", "E220", "'image.width' is a single value; there is nothing below it");
    expect("lights[2].intensity=1", "E220", "counted from 0, the last one is lights[1]");
    expect("lights[kye].intensity=1", "E220", "did you mean 'key'?");
    expect("lights.key.intensity=1", "E220", "for example lights[0] or lights[key]");
    expect("materials.glas.albedo=1", "E220", "did you mean 'glass'?");
    expect("materials.nothing=", "E220", "there is no material 'nothing'");
    expect("camera.direction.x=1", "E220", "is not written; it can only be set as a whole");
    expect("camera.position.w=1", "E220", "it has x, y, z");
    expect("camera.position.x=", "E220", "cannot be removed");
    expect("lights[1].color.r=1", "E220", "written as #rrggbb");
    expect("materials.floor.diffuse_color.checker.colors[2]=1", "E220", "has the entries [0] to [1]");
    expect("include=[x.yaml]", "E220", "cannot be set");
    expect("spheres[0].material.albedo=[1, 0, 0, 0]", "E221", "--set materials.glass.albedo=[1, 0, 0, 0]");
    expect("spheres[0].material.albedo=[1, 0, 0, 0]", "E221", "scene.yaml:14:54: note: it is used here too");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_and_their_places),      cmocka_unit_test(later_options_win),
        cmocka_unit_test(entries_by_number_and_name), cmocka_unit_test(alternatives_replace_each_other),
        cmocka_unit_test(whole_entries_and_lists),    cmocka_unit_test(removing),
        cmocka_unit_test(mistakes_in_the_value),      cmocka_unit_test(mistakes_in_the_path),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
