#include "loaded.h"

#include "grammar/concept.h"
#include "grammar/ir.h"
#include "grammar/schema.h"
#include "parser/tree/mend.h"

static bool same_color(struct ir_color c, double r, double g, double b) {
    return !c.is_hex && c.r == r && c.g == g && c.b == b;
}

static bool same_vec(vec3 v, double x, double y, double z) {
    return v.x == x && v.y == y && v.z == z;
}

// ---- values

static void numbers_of_every_form(void **state) {
    (void)state;
    struct loaded l;
    loaded_yaml(&l, HEAD_YAML "camera: {position: {x: 1, y: -2.5, z: +3e0}, fov: .5e2}\nimage: {width: 20}\n"
                              "models: [{mesh: a.obj, scale: 0.7, smooth: true}]\n");
    assert_string_equal(l.codes, "");
    const struct ir_camera *camera = &loaded_scene(&l)->cameras.items[0];
    assert_true(same_vec(camera->position, 1, -2.5, 3));
    assert_true(camera->fov == 50);
    assert_int_equal(l.output.scene->image.width, 20);
    assert_int_equal(l.output.scene->image.height, 768);
    assert_true(same_vec(l.output.scene->models.items[0].scale, 0.7, 0.7, 0.7));
    assert_true(l.output.scene->models.items[0].smooth);
    loaded_finish(&l);
}

static void colors_of_every_form(void **state) {
    (void)state;
    struct loaded l;
    loaded_yaml(&l, HEAD_YAML "materials:\n"
                              "  a: {diffuse_color: [1, 0.5, 0]}\n"
                              "  b: {diffuse_color: {r: 1, g: 0.5, b: 0}}\n"
                              "  c: {diffuse_color: 0.25}\n"
                              "  d: {diffuse_color: \"#ff8000\"}\n"
                              "  e: {diffuse_color: {color: [1, 0.5, 0]}}\n"
                              "  f: {diffuse_color: {checker: {colors: [0.25, \"#ff8000\"], size: 3}}}\n");
    assert_string_equal(l.codes, "");
    const struct ir_material *m = loaded_scene(&l)->materials.items;
    assert_int_equal(l.output.scene->materials.count, 6);
    assert_true(same_color(m[0].diffuse_color.color, 1, 0.5, 0));
    assert_true(same_color(m[1].diffuse_color.color, 1, 0.5, 0));
    assert_true(same_color(m[2].diffuse_color.color, 0.25, 0.25, 0.25));
    assert_true(m[3].diffuse_color.color.is_hex && m[3].diffuse_color.color.hex == 0xff8000);
    assert_true(same_color(m[4].diffuse_color.color, 1, 0.5, 0));
    assert_int_equal(m[5].diffuse_color.kind, IR_PAINT_CHECKER);
    assert_true(same_color(m[5].diffuse_color.checker.colors[0], 0.25, 0.25, 0.25));
    assert_true(m[5].diffuse_color.checker.colors[1].is_hex);
    assert_true(m[5].diffuse_color.checker.size == 3);
    loaded_finish(&l);
}

static void the_same_in_xml(void **state) {
    (void)state;
    struct loaded l;
    loaded_xml(&l, HEAD_XML
               "<Material name=\"b\" specular_color=\"#00ff00\"><DiffuseColor r=\"1\" g=\"0.5\" b=\"0\"/>"
               "<Albedo specular=\"0.5\"/></Material>"
               "<Material name=\"c\" diffuse_color=\"0.25\"/>"
               "<Material name=\"f\"><DiffuseColor><Checker size=\"3\"><Color r=\"0\" g=\"0\" b=\"0\"/>"
               "<Color r=\"1\" g=\"1\" b=\"1\"/></Checker></DiffuseColor></Material>"
               "<Model mesh=\"a.obj\" scale=\"2\" smooth=\"false\"><MaterialMap from=\"Gold\" "
               "to=\"b\"/></Model>" END_XML);
    assert_string_equal(l.codes, "");
    const struct ir_material *m = loaded_scene(&l)->materials.items;
    assert_true(same_color(m[0].diffuse_color.color, 1, 0.5, 0));
    assert_true(m[0].specular_color.color.is_hex && m[0].specular_color.color.hex == 0x00ff00);
    assert_true(m[0].albedo.diffuse == 0 && m[0].albedo.specular == 0.5);
    assert_true(same_color(m[1].diffuse_color.color, 0.25, 0.25, 0.25));
    assert_int_equal(m[2].diffuse_color.kind, IR_PAINT_CHECKER);
    const struct ir_model *model = &l.output.scene->models.items[0];
    assert_true(same_vec(model->scale, 2, 2, 2));
    assert_int_equal(model->material_map.count, 1);
    assert_true(str_equal_cstr(model->material_map.items[0].from, "Gold"));
    assert_int_equal(model->material_map.items[0].to.index, 0);
    loaded_finish(&l);
}

static void weights_of_both_forms(void **state) {
    (void)state;
    struct loaded l;
    loaded_yaml(&l,
                HEAD_YAML "materials: {a: {albedo: [1, 2, 3, 4]}, b: {albedo: {refraction: 0.5}}, c: {}}\n");
    assert_string_equal(l.codes, "");
    const struct ir_material *m = loaded_scene(&l)->materials.items;
    assert_true(m[0].albedo.diffuse == 1 && m[0].albedo.refraction == 4);
    assert_true(m[1].albedo.diffuse == 0 && m[1].albedo.refraction == 0.5);
    assert_true(m[2].albedo.diffuse == 1); // the default
    loaded_finish(&l);
}

static void references_and_bodies(void **state) {
    (void)state;
    struct loaded l;
    loaded_yaml(&l, HEAD_YAML
                "spheres:\n"
                "  - {center: [0, 0, 0], radius: 1, material: NO}\n"
                "  - {center: [0, 0, 0], radius: 1, material: {specular_exponent: 7}}\n"
                "  - {center: [0, 0, 0], radius: 1}\n"
                "models: [{mesh: a.obj, material_map: {G: NO, H: {specular_exponent: 8}, I: {to: NO}}}]\n"
                "materials: {NO: {}}\n");
    assert_string_equal(l.codes, "");
    const struct ir_scene *s = loaded_scene(&l);
    assert_true(str_equal_cstr(s->materials.items[s->spheres.items[0].material.index].name, "NO"));
    const struct ir_material *own = &s->materials.items[s->spheres.items[1].material.index];
    assert_true(own->name.len == 0 && own->specular_exponent == 7);
    assert_int_equal(s->spheres.items[2].material.index, IR_NO_INDEX);
    const struct ir_map_entry *map = s->models.items[0].material_map.items;
    assert_true(s->materials.items[map[1].to.index].specular_exponent == 8);
    assert_true(str_equal_cstr(map[2].to.name, "NO"));
    loaded_finish(&l);
}

// ---- what is written, where

static void written_bits_and_places(void **state) {
    (void)state;
    struct loaded l;
    loaded_yaml(&l, HEAD_YAML "# the picture\nimage: {width: 20}\nlights: []\nspheres:\nmaterials: {}\n");
    assert_string_equal(l.codes, "");
    const struct ir_scene *s = loaded_scene(&l);
    assert_int_equal(s->image.head.written, 1u << schema_find_row(&SCHEMA_IMAGE, STR("width")));
    uint64_t scene = (1u << schema_find_row(&SCHEMA_SCENE, STR("glint"))) |
                     (1u << schema_find_row(&SCHEMA_SCENE, STR("image")));
    assert_int_equal(s->head.written, scene); // an empty list is no list
    span value = ir_place_value(&l.output.origin, &s->image.head, &SCHEMA_IMAGE, "width");
    assert_true(str_equal_cstr(source_text(&l.sources, value), "20"));
    const struct ir_row_origin *row =
        ir_origin_row(&l.output.origin, &s->head, (uint32_t)schema_find_row(&SCHEMA_SCENE, STR("image")));
    assert_true(str_equal_cstr(source_text(&l.sources, l.output.origin.comments.items[row->comments]),
                               "# the picture"));
    loaded_finish(&l);
}

static void poisoned_rows_hold_their_default(void **state) {
    (void)state;
    struct loaded l;
    loaded_yaml(&l, HEAD_YAML "camera: {fov: 500, position: [1, a, 3], look_at: [0, 0, 0]}\n");
    assert_string_equal(l.codes, "E206 E205");
    const struct ir_camera *camera = &loaded_scene(&l)->cameras.items[0];
    uint64_t fov = 1u << schema_find_row(&SCHEMA_CAMERA, STR("fov"));
    assert_true(camera->head.written & fov);
    assert_true(camera->head.poisoned & fov);
    assert_true(camera->fov == 60);
    assert_true(same_vec(camera->position, 0, 0, 0)); // where look_at is: not reported, since it follows
    loaded_finish(&l);
}

static void one_camera_or_several(void **state) {
    (void)state;
    struct loaded l;
    loaded_yaml(&l, HEAD_YAML "cameras: {a: {fov: 10}, b: {}}\n");
    assert_int_equal(loaded_scene(&l)->cameras.count, 2);
    assert_true(str_equal_cstr(l.output.scene->cameras.items[0].name, "a"));
    loaded_finish(&l);
    loaded_xml(&l, HEAD_XML "<Camera name=\"a\"/><Camera fov=\"10\"/>" END_XML);
    assert_string_equal(l.codes, "");
    assert_true(str_equal_cstr(loaded_scene(&l)->cameras.items[1].name, "main"));
    assert_int_equal(l.output.scene->cameras.items[0].head.written, 1);
    loaded_finish(&l);
    loaded_yaml(&l, HEAD_YAML "camera: {}\ncameras:\n");
    assert_string_equal(l.codes, "");
    assert_int_equal(loaded_scene(&l)->cameras.count, 1);
    loaded_finish(&l);
}

static void root_keys_for_anchors_are_ignored(void **state) {
    (void)state;
    loaded_check(HEAD_YAML
                 "x-common: &c {radius: 1, anything: [goes]}\nspheres: [{center: [0, 0, 0], radius: 1}]\n",
                 "", NULL);
    loaded_check(HEAD_YAML "image: {x-a: 1}\n", "E202", "'image' has no 'x-a'");
}

// ---- mistakes, with the same codes and words in both spellings

static void mistakes_in_numbers(void **state) {
    (void)state;
    loaded_check_twins(HEAD_YAML "image: {width: 0x10}\n", HEAD_XML "<Image width=\"0x10\"/>" END_XML, "E205",
                       "'image.width': '0x10' is hexadecimal; write it in decimal");
    loaded_check_twins(HEAD_YAML "image: {width: 1.5}\n", HEAD_XML "<Image width=\"1.5\"/>" END_XML, "E205",
                       "'image.width': '1.5' is not a whole number written with digits only");
    loaded_check_twins(HEAD_YAML "camera: {fov: .nan}\n", HEAD_XML "<Camera fov=\".nan\"/>" END_XML, "E205",
                       "'fov' of camera 'main': '.nan' is not a finite number");
    loaded_check_twins(HEAD_YAML "camera: {fov: 180}\n", HEAD_XML "<Camera fov=\"180\"/>" END_XML, "E206",
                       "'fov' of camera 'main' is 180; in perspective it must be less than 180 degrees");
    loaded_check_twins(
        HEAD_YAML "spheres: [{name: ball, center: [0, 0, 0], radius: -2}]\n",
        HEAD_XML "<Sphere name=\"ball\" radius=\"-2\"><Center x=\"0\" y=\"0\" z=\"0\"/></Sphere>" END_XML,
        "E206", "'radius' of sphere 'ball' is -2; it must be from 1e-18 to 1e18");
    loaded_check_twins(
        HEAD_YAML "lights: [{position: [0, 1, 2], color: {r: 1, g: 2, b: -3}}]\n",
        HEAD_XML
        "<Light><Position x=\"0\" y=\"1\" z=\"2\"/><Color r=\"1\" g=\"2\" b=\"-3\"/></Light>" END_XML,
        "E206", "'color.b' of this light is -3; it must be from 0 to 1e6");
}

static void mistakes_in_words(void **state) {
    (void)state;
    loaded_check_twins(HEAD_YAML "image: {tone: Clip}\n", HEAD_XML "<Image tone=\"Clip\"/>" END_XML, "E207",
                       "'image.tone' is 'Clip'; it must be 'clip', 'normalize', 'neutral' or 'filmic'");
    loaded_check_twins(HEAD_YAML "trace: {shadows: yes}\n", HEAD_XML "<Trace shadows=\"yes\"/>" END_XML,
                       "E208", "'trace.shadows' is 'yes'; it must be true or false");
    loaded_check_twins(HEAD_YAML "lights: [{name: 1a, direction: [0, 1, 0]}]\n",
                       HEAD_XML "<Light name=\"1a\"><Direction x=\"0\" y=\"1\" z=\"0\"/></Light>" END_XML,
                       "E212", "'1a' is not a name");
    loaded_check_twins(HEAD_YAML "background: {image: \"\"}\n", HEAD_XML "<Background image=\"\"/>" END_XML,
                       "E217", "'background.image' is empty");
    loaded_check_twins(HEAD_YAML "background: {color: red}\n", HEAD_XML "<Background color=\"red\"/>" END_XML,
                       "E213", "'background.color': 'red' is not a colour");
}

static void mistakes_in_shape(void **state) {
    (void)state;
    loaded_check_twins(HEAD_YAML "camera: {position: 5}\n", HEAD_XML "<Camera position=\"5\"/>" END_XML,
                       "E209", "'position' of camera 'main' must be three numbers x, y, z, not '5'");
    loaded_check_twins(HEAD_YAML "camera: {fov: {value: 5}}\n",
                       HEAD_XML "<Camera><Fov value=\"5\"/></Camera>" END_XML, "E209",
                       "'fov' of camera 'main' must be one number, not a group of attributes");
    loaded_check_twins(HEAD_YAML "image: 5\n", "<Scene glint=\"1\" image=\"5\"/>", "E209",
                       "'image' must be a group of attributes, not '5'");
    loaded_check(HEAD_YAML "lights: {position: [0, 0, 0]}\n", "E209",
                 "'lights' must be a list of lights, not a group of attributes");
    loaded_check(HEAD_YAML "materials: [glass]\n", "E209",
                 "'materials' must be a map of materials by name, not a list");
    loaded_check(HEAD_YAML "lights: [5]\n", "E209", "this light must be a group of attributes, not '5'");
    loaded_check(HEAD_YAML "include: base.yaml\n", "E209 E601", "write [base.yaml]");
    loaded_check(HEAD_YAML "camera: {position: [[1], 2, 3]}\n", "E209",
                 "'position.x' of camera 'main' must be one number, not a list");
    loaded_check_twins(
        HEAD_YAML "models: [{mesh: a.obj, scale: 1 2 3}]\n",
        HEAD_XML "<Model mesh=\"a.obj\" scale=\"1 2 3\"/>" END_XML, "E209",
        "'scale' of this model must be three numbers x, y, z, or one number for all three, not '1 2 3'");
}

static void mistakes_in_components(void **state) {
    (void)state;
    loaded_check(HEAD_YAML "camera: {position: [1, 2]}\n", "E210",
                 "'position' of camera 'main' has 2 numbers; it needs 3: x, y, z");
    loaded_check_twins(HEAD_YAML "camera: {position: {x: 1, y: 2}}\n",
                       HEAD_XML "<Camera><Position x=\"1\" y=\"2\"/></Camera>" END_XML, "E211",
                       "'position' of camera 'main' lacks 'z'; write every component, even if it is 0");
    loaded_check_twins(
        HEAD_YAML "camera: {position: {x: 1, y: 2, Z: 3}}\n",
        HEAD_XML "<Camera><Position x=\"1\" y=\"2\" Z=\"3\"/></Camera>" END_XML, "E202",
        "'position' of camera 'main' has no 'Z'; it has 'x', 'y', 'z'"); // and 'z' is not missing
    loaded_check_twins(HEAD_YAML "materials: {m: {diffuse_color: {checker: {colors: [[0, 0, 0]]}}}}\n",
                       HEAD_XML "<Material name=\"m\"><DiffuseColor><Checker><Color r=\"0\" g=\"0\" "
                                "b=\"0\"/></Checker></DiffuseColor></Material>" END_XML,
                       "E210", "'diffuse_color.checker.colors' of material 'm' has 1 value; it needs 2");
    loaded_check_twins(HEAD_YAML "materials: {m: {diffuse_color: {checker: {}}}}\n",
                       HEAD_XML
                       "<Material name=\"m\"><DiffuseColor><Checker/></DiffuseColor></Material>" END_XML,
                       "E204", "'diffuse_color.checker' of material 'm' lacks 'colors'");
}

static void what_is_missing(void **state) {
    (void)state;
    loaded_check_twins(HEAD_YAML "spheres: [{center: [0, 0, 0]}]\n",
                       HEAD_XML "<Sphere><Center x=\"0\" y=\"0\" z=\"0\"/></Sphere>" END_XML, "E204",
                       "this sphere lacks 'radius'");
    loaded_check_twins(HEAD_YAML "lights: [{intensity: 2}]\n", HEAD_XML "<Light intensity=\"2\"/>" END_XML,
                       "E215", "this light needs 'position' or 'direction' or 'rectangle'");
    loaded_check_twins("image: {}\n", "<Scene/>", "E204", "the scene lacks 'glint'");
    loaded_check(HEAD_XML "<Material/>" END_XML, "E204", "this material lacks 'name'");
    // What is missing because it was misspelt is said once.
    loaded_check(HEAD_YAML "spheres: [{center: [0, 0, 0], raduis: 1}]\n", "E202", "did you mean 'radius'?");
    loaded_check(HEAD_YAML "lights: [{positon: [0, 0, 0]}]\n", "E202", NULL);
    loaded_check(HEAD_XML "<Material nmae=\"x\"/>" END_XML, "E202", "did you mean 'name'?");
}

static void what_is_there_twice(void **state) {
    (void)state;
    loaded_check(HEAD_YAML "camera: {}\ncameras: {a: {}}\n", "E203", "both 'camera' and 'cameras' are given");
    loaded_check(HEAD_XML "<Image/><Image/>" END_XML, "E203", "'image' is given twice");
    loaded_check(HEAD_XML "<Light color=\"1\"><Position x=\"0\" y=\"0\" z=\"0\"/><Color r=\"1\" g=\"1\" "
                          "b=\"1\"/></Light>" END_XML,
                 "E203", "'color' of this light is given twice");
    loaded_check(HEAD_XML "<Material name=\"a\"/><Model mesh=\"a.obj\"><MaterialMap from=\"G\" "
                          "to=\"a\"/><MaterialMap from=\"G\" to=\"a\"/></Model>" END_XML,
                 "E203", "material map 'G' is given twice");
    loaded_check_twins(HEAD_YAML "camera: {look_at: [0, 0, 0], position: [1, 1, 1], rotation: [0, 0, 0]}\n",
                       HEAD_XML "<Camera><LookAt x=\"0\" y=\"0\" z=\"0\"/><Position x=\"1\" y=\"1\" "
                                "z=\"1\"/><Rotation x=\"0\" y=\"0\" z=\"0\"/></Camera>" END_XML,
                       "E214", "camera 'main' has both 'look_at' and 'rotation'; only one is allowed");
    // The second value is looked into all the same.
    loaded_check(HEAD_YAML "camera: {look_at: [0, 0, 9], rotation: [0, 3m, 0]}\n", "E214 E205", NULL);
    loaded_check(HEAD_XML "<Image/><Image width=\"3m\"/>" END_XML, "E203 E205", NULL);
}

static void names_that_do_not_exist(void **state) {
    (void)state;
    loaded_check_twins(HEAD_YAML "spheres: [{center: [0, 0, 0], radius: 1, fov: 2}]\n",
                       HEAD_XML
                       "<Sphere radius=\"1\" fov=\"2\"><Center x=\"0\" y=\"0\" z=\"0\"/></Sphere>" END_XML,
                       "E202", "a sphere has no 'fov'");
    loaded_check(HEAD_YAML "image: {lights: []}\n", "E202", "'light' belongs to the scene itself");
    loaded_check(HEAD_YAML "materials: {m: {DiffuseColor: 1}}\n", "E202",
                 "did you mean 'diffuse_color'? Names are snake_case here");
    loaded_check(HEAD_YAML "materials: {m: {diffuseColor: 1}}\n", "E202", "did you mean 'diffuse_color'?");
    loaded_check(HEAD_YAML "light: [{position: [0, 0, 0]}]\n", "E202", "did you mean 'lights'?");
    loaded_check(HEAD_XML "<lights/>" END_XML, "E202", "write each <Light> without <lights> around it");
    loaded_check(HEAD_XML "<diffuse_color/>" END_XML, "E202", "belongs to a material");
    loaded_check(HEAD_XML "<Camera lookAt=\"0 0 0\"/>" END_XML, "E202", "<LookAt x=");
    loaded_check(HEAD_YAML "materials: {m: {name: x}}\n", "E202", "the key above it is its name");
    loaded_check(HEAD_YAML "spheres: [{center: [0, 0, 0], radius: 1, material: {name: x}}]\n", "E202",
                 "needs no name");
    loaded_check(HEAD_YAML "trace: {wobble: 1}\n", "E202",
                 "it can have: max_depth, min_weight, depth_limit, precision, shadows");
    loaded_check(
        HEAD_XML
        "<Sphere radius=\"1\"><Center x=\"0\" y=\"0\" z=\"0\"/><Material name=\"x\"/></Sphere>" END_XML,
        "E218", "write material=\"x\"");
}

// Each word of concepts.def is answered with its row, in both spellings.
static void names_of_other_tools(void **state) {
    (void)state;
    for (const struct concept *c = concepts; c->title; c++) {
        char yaml[200], xml[200];
        int length = (int)strcspn(c->words, " ");
        if (c->in)
            continue;
        snprintf(yaml, sizeof yaml, "glint: 1\n%.*s: 1\n", length, c->words);
        snprintf(xml, sizeof xml, "<Scene glint=\"1\" %.*s=\"1\"/>", length, c->words);
        loaded_check(yaml, "E202", c->lacks);
        loaded_check(xml, "E202", c->lacks);
    }

    loaded_check(HEAD_YAML "materials: {m: {anisotropy: 1}}\n", "E202", "as much along as across");
    loaded_check(HEAD_XML "<AreaLights><Position/></AreaLights>" END_XML, "E202", "has soft shadows");
    loaded_check(HEAD_XML "<Plane/>" END_XML, "E202",
                 "use a large rectangle, for example <Rectangle><Corner");
    loaded_check(HEAD_YAML "Plane: {}\n", "E202", "use a large rectangle, for example rectangles: [{corner");
    // A name that is surely meant goes before, and so does another name of the same.
    loaded_check(HEAD_YAML "camera: {fog: 60}\n", "E202", "did you mean 'fov'?");
    loaded_check(HEAD_YAML "camera: {hfov: 60}\n", "E202", "'fov' is vertical");
    loaded_check(HEAD_YAML "background: {texture: a.png}\n", "E202",
                 "did you mean 'image'? For example image: ");
    loaded_check(HEAD_YAML "materials: {m: {ior: 1.5}}\n", "E202",
                 "did you mean 'refractive_index'? For example refractive_index: 1.5");
    loaded_check(HEAD_YAML "spheres: [{center: [0, 0, 0], radius: 1, ior: 2}]\n", "E202",
                 "did you mean 'refractive_index' of a material? For example refractive_index: 1.5");
    // Of three elements none is surely meant.
    loaded_check(HEAD_YAML "spheres: [{center: [0, 0, 0], radius: 1, strength: 2}]\n", "E202",
                 "it can have: name, for, if, center");
}

static void what_is_no_scene(void **state) {
    (void)state;
    loaded_check("- a\n- b\n", "E201", NULL);
    loaded_check("name: x\nversion: 3\n", "E201", "a scene begins with 'glint: 1'");
    loaded_check("<svg width=\"3\"/>", "E201", "its root is 'svg'");
    loaded_check_twins("glint: 2\nnew_thing: 5\n", "<Scene glint=\"2\" new_thing=\"5\"/>", "E216",
                       "the file uses version 2 of the language; this program reads version 1");
    loaded_check("glint: one\nimage: {width: x}\n", "E205 E205", NULL);
}

static void quotes_and_nothing(void **state) {
    (void)state;
    loaded_check(HEAD_YAML "image: {width: \"5\"}\n", "E122", "write 5");
    loaded_check(HEAD_YAML "trace: {shadows: \"true\"}\n", "E122", NULL);
    loaded_check(HEAD_YAML "image: {tone: \"clip\"}\n", "", NULL);
    loaded_check(HEAD_YAML "image:\n", "E121", "'image' has no value");
    loaded_check(HEAD_YAML "materials: {m: }\nspheres: [{center: [0, 0, 0], radius: 1, material: m}]\n",
                 "E121",
                 "material 'm' has no value"); // and is not unknown
    loaded_check(HEAD_YAML "lights: [~]\n", "E121", "this light has no value");
    loaded_check(HEAD_YAML "description: null\n", "E121", "quote it if you mean the word");
}

// ---- fixes

static void expect_fix(const char *text, const char *fixed, bool safe) {
    struct loaded l;
    loaded_init(&l);
    loaded_run(&l, text[0] == '<' ? "scene.xml" : "scene.yaml", text, NULL);
    assert_int_equal(l.sink.count, 1);
    const struct diag *d = &l.sink.items[0];
    assert_true(d->has_fix);
    assert_int_equal(d->fix_is_safe, safe);
    char result[512];
    snprintf(result, sizeof result, "%.*s%.*s%s", (int)d->fix_at.begin, text, STR_ARG(d->fix_text),
             text + d->fix_at.end);
    assert_string_equal(result, fixed);
    loaded_finish(&l);
}

static void fixes_make_the_text_right(void **state) {
    (void)state;
    expect_fix(HEAD_YAML "image: {width: \"5\"}\n", HEAD_YAML "image: {width: 5}\n", true);
    expect_fix(HEAD_YAML "image: {widht: 5}\n", HEAD_YAML "image: {width: 5}\n", true);
    expect_fix(HEAD_YAML "camera: {fov: 60deg}\n", HEAD_YAML "camera: {fov: 60}\n", false);
    expect_fix(HEAD_YAML "camera: {fov: 4_0}\n", HEAD_YAML "camera: {fov: 40}\n", true);
    expect_fix(HEAD_YAML "background: {intensity: 50%}\n", HEAD_YAML "background: {intensity: 0.5}\n", false);
    expect_fix(HEAD_YAML "trace: {shadows: Yes}\n", HEAD_YAML "trace: {shadows: true}\n", true);
    expect_fix(HEAD_YAML "trace: {shadows: \"off\"}\n", HEAD_YAML "trace: {shadows: false}\n", true);
    expect_fix(HEAD_YAML "background: {color: \"#f80\"}\n", HEAD_YAML "background: {color: \"#ff8800\"}\n",
               true);
    expect_fix(HEAD_YAML "background: {color: ff8800}\n", HEAD_YAML "background: {color: \"#ff8800\"}\n",
               false);
    expect_fix(HEAD_XML "<Background color=\"#f80\"/>" END_XML,
               HEAD_XML "<Background color=\"#ff8800\"/>" END_XML, true);
    expect_fix(HEAD_XML "<Trace shadows=\"On\"/>" END_XML, HEAD_XML "<Trace shadows=\"true\"/>" END_XML,
               true);
    expect_fix(HEAD_XML "<image/>" END_XML, HEAD_XML "<Image/>" END_XML, true);
    expect_fix(
        HEAD_YAML "materials: {glass: {}}\nspheres: [{center: [0, 0, 0], radius: 1, material: 'glas'}]\n",
        HEAD_YAML "materials: {glass: {}}\nspheres: [{center: [0, 0, 0], radius: 1, material: 'glass'}]\n",
        true);
}

// ---- mends

static void near_words(void **state) {
    (void)state;
    struct arena arena;
    struct diag_sink sink;
    diag_sink_init(&sink);
    arena_init(&arena, 1 << 20);
    assert_true(str_equal_cstr(mend_snake(&arena, STR("DiffuseColor")), "diffuse_color"));
    assert_true(str_equal_cstr(mend_snake(&arena, STR("edge-u")), "edge_u"));
    assert_true(str_equal_cstr(mend_snake(&arena, STR("EdgeU")), "edge_u"));
    struct mend_search search = mend_begin(&sink, &arena, STR("abcdef"));
    mend_offer(&search, "abcdeg", 0);
    mend_offer(&search, "abcdeh", 1);
    assert_string_equal(search.best, "abcdeg");
    assert_false(mend_is_safe(&search)); // two are as near
    search = mend_begin(&sink, &arena, STR("pos"));
    mend_offer(&search, "name", 0);
    mend_offer(&search, "position", 1);
    assert_string_equal(search.best, "position"); // its beginning
    search = mend_begin(&sink, &arena, STR("po"));
    mend_offer(&search, "position", 0);
    assert_null(search.best);
    assert_true(mend_is_numbers(STR("1, 2 3")));
    assert_true(mend_is_numbers(STR("(1, 2)")));
    assert_true(str_equal_cstr(mend_numbers(&arena, STR("[[0, 5 1]]"), 3), "0, 5, 1"));
    assert_int_equal(mend_numbers(&arena, STR("[0, 5]"), 3).len, 0);
    assert_int_equal(mend_numbers(&arena, STR("[0, 5, 1, 2]"), 3).len, 0);
    assert_true(str_equal_cstr(mend_quotes(STR(" \xE2\x80\x9Cred\xE2\x80\x9D ")), "red"));
    assert_int_equal(mend_quotes(STR("\xE2\x80\x9C\xE2\x80\x9D")).len, 0);
    assert_false(mend_is_numbers(STR("1 two")));
    diag_sink_finish(&sink);
    arena_finish(&arena);
}

static void seven_mistakes_are_seven(void **state) {
    (void)state;
    loaded_check(HEAD_YAML "colour: 1\n"
                           "image: {width: 0}\n"
                           "camera: {fov: abc, position: [1, 2]}\n"
                           "lights: [{intensity: 1}]\n"
                           "materials: {glas: {}}\n"
                           "spheres:\n"
                           "  - {center: [0, 0, 0], radius: 1, material: glass}\n"
                           "  - {center: [0, 0, 0], raduis: 1}\n",
                 "E202 E206 E205 E210 E215 E301 E202", NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_of_every_form),
        cmocka_unit_test(colors_of_every_form),
        cmocka_unit_test(the_same_in_xml),
        cmocka_unit_test(weights_of_both_forms),
        cmocka_unit_test(references_and_bodies),
        cmocka_unit_test(written_bits_and_places),
        cmocka_unit_test(poisoned_rows_hold_their_default),
        cmocka_unit_test(one_camera_or_several),
        cmocka_unit_test(root_keys_for_anchors_are_ignored),
        cmocka_unit_test(mistakes_in_numbers),
        cmocka_unit_test(mistakes_in_words),
        cmocka_unit_test(mistakes_in_shape),
        cmocka_unit_test(mistakes_in_components),
        cmocka_unit_test(what_is_missing),
        cmocka_unit_test(what_is_there_twice),
        cmocka_unit_test(names_that_do_not_exist),
        cmocka_unit_test(names_of_other_tools),
        cmocka_unit_test(what_is_no_scene),
        cmocka_unit_test(quotes_and_nothing),
        cmocka_unit_test(fixes_make_the_text_right),
        cmocka_unit_test(near_words),
        cmocka_unit_test(seven_mistakes_are_seven),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
