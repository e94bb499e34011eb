// Variants of a scene that extremes makes: a panel that comes down to a surface, and what is moved and scaled
// where models are turned and stretched.
#include "core/angle.h"
#include "measure/extremes/extremes_internal.h"

#include "assets_scene.h"

#include <math.h>

static const double NEAR = 1e-13;

static void assert_near(vec3 v, vec3 wanted, double size) {
    if (!(vec3_length(vec3_sub(v, wanted)) <= NEAR * size))
        fail_msg("(%.17g %.17g %.17g) is not (%.17g %.17g %.17g)", v.x, v.y, v.z, wanted.x, wanted.y,
                 wanted.z);
}

static void assert_close(double v, double wanted) {
    if (!(fabs(v - wanted) <= NEAR * fabs(wanted)))
        fail_msg("%.17g is not %.17g", v, wanted);
}

// A panel that lights by falloff, a model that is turned and stretched, and a camera.
struct setting {
    struct assets_scene *scene;
    struct extremes_input input;
    struct extreme_base base;
    struct arena arena;
};

static void begin(struct setting *t, vec3 edge_u, vec3 edge_v) {
    *t = (struct setting){.scene = assets_scene_begin()};
    struct assets_scene *s = t->scene;
    struct ir_camera *camera = ARENA_PUSH(&s->arena, &s->scene.cameras);
    schema_init(&SCHEMA_CAMERA, camera);
    camera->position = (vec3){0, 1, 7};
    struct ir_light *light = ARENA_PUSH(&s->arena, &s->scene.lights);
    schema_init(&SCHEMA_LIGHT, light);
    light->kind = IR_LIGHT_RECTANGLE;
    light->falloff = IR_FALLOFF_INVERSE_SQUARE;
    light->intensity = 7;
    light->rectangle.corner = (vec3){0.5, 6, -2};
    light->rectangle.edge_u = edge_u;
    light->rectangle.edge_v = edge_v;
    assets_scene_file(s, "mesh.obj", "v 1 2 3\nv 4 1 0\nv -2 1 5\nf 1 2 3\n");
    struct ir_model *model = assets_scene_model(s, "mesh.obj");
    model->scale = (vec3){4, 0.25, -1.5};
    model->rotation = (vec3){20, 65, -110};
    model->translation = (vec3){0.3, -2, 1};
    assets_scene_load(s);
    arena_init(&t->arena, SIZE_MAX);
    t->input = (struct extremes_input){.scene = &s->resolved, .width = 4, .height = 3, .limits = &s->limits};
    t->base = (struct extreme_base){.input = &t->input, .radius = 3, .has_surface = true};
    t->base.surface = (vec3){2, -1, 0.5};
}

static void end(struct setting *t) {
    arena_finish(&t->arena);
    assets_scene_end(t->scene);
}

// Whatever way it shone before: it keeps its shape, is in its place, and shines straight at the surface.
static void check_panel(vec3 edge_u, vec3 edge_v, vec3 normal, double height) {
    struct setting t;
    struct variant v;
    begin(&t, edge_u, edge_v);
    t.base.normal = vec3_unit(normal);
    assert_null(variant_make(&v, &t.arena, &t.base, EXTREME_LIGHT, height));
    const struct view_light *light = &v.view.lights[0];
    const double size = vec3_length(edge_u) + vec3_length(edge_v);
    assert_int_equal(v.view.light_count, 1);
    assert_int_equal(light->extent, VIEW_PANEL);
    assert_false(light->directional || light->inverse_square || light->before_body > 0);
    assert_near(light->position, vec3_add(t.base.surface, vec3_mul(t.base.normal, 3 * height)), 3);
    assert_near(light->outward, vec3_neg(t.base.normal), 1);
    assert_near(vec3_unit(vec3_cross(light->edge_u, light->edge_v)), light->outward, 1);
    assert_close(vec3_length(light->edge_u), vec3_length(edge_u));
    assert_close(vec3_length(light->edge_v), vec3_length(edge_v));
    assert_true(fabs(vec3_dot(light->edge_u, light->edge_v) - vec3_dot(edge_u, edge_v)) <=
                NEAR * size * size);
    // As bright as what lights the camera's place by 1 (docs/language.md, "Lights that are seen").
    const vec3 way = vec3_sub(light->position, v.view.camera.position);
    assert_close(light->radiance.x, PI * vec3_dot(way, way) / vec3_length(vec3_cross(edge_u, edge_v)));
    end(&t);
}

static void a_panel_turns_to_the_surface(void **state) {
    (void)state;
    static const struct panel {
        vec3 edge_u, edge_v;
    } panels[] = {{{2, 0, 0}, {0, 0, 2}}, {{0, 0.5, 1}, {3, 1, 0}}, {{1e-3, 0, 0}, {0, -4e-3, 1e-3}}};
    static const vec3 normals[] = {{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0.2, -0.3, 0.9}, {-1, 1, 1}};
    for (size_t p = 0; p < sizeof panels / sizeof *panels; p++) {
        const struct panel panel = panels[p];
        const vec3 ahead = vec3_cross(panel.edge_u, panel.edge_v);
        for (size_t n = 0; n < sizeof normals / sizeof *normals; n++)
            check_panel(panel.edge_u, panel.edge_v, normals[n], 0.1);
        check_panel(panel.edge_u, panel.edge_v, ahead, 0);
        check_panel(panel.edge_u, panel.edge_v, vec3_neg(ahead), 1e-7);
    }
}

static void no_surface_is_told(void **state) {
    (void)state;
    struct setting t;
    struct variant v;
    begin(&t, (vec3){2, 0, 0}, (vec3){0, 0, 2});
    t.base.has_surface = false;
    assert_non_null(variant_make(&v, &t.arena, &t.base, EXTREME_LIGHT, 0.1));
    assert_non_null(variant_make(&v, &t.arena, &t.base, EXTREME_CAMERA, 0.1));
    assert_null(variant_make(&v, &t.arena, &t.base, EXTREME_MOVE, 1));
    end(&t);
}

// x becomes factor * x + offset: corners of the model, the panel and the camera, and the light on the way.
static void check_change(enum extreme_axis axis, double value, double factor, vec3 offset) {
    const vec3 edge_u = {0, 0.5, 1}, edge_v = {3, 1, 0};
    struct setting t;
    struct variant v;
    begin(&t, edge_u, edge_v);
    assert_null(variant_make(&v, &t.arena, &t.base, axis, value));
    const struct scene_body *before = &t.scene->resolved.bodies[0], *after = &v.scene.bodies[0];
    const double size = factor * 30 + vec3_length(offset);
    for (uint32_t i = 0; i < before->mesh->position_count; i++) {
        const vec3 p = before->mesh->positions[i];
        const vec3 was = affine3_apply(before->object_to_world, p);
        assert_near(affine3_apply(after->object_to_world, p), vec3_add(vec3_mul(was, factor), offset), size);
    }
    struct view view;
    view_build(&t.scene->resolved, 0, 4, 3, &t.arena, NULL, &view);
    const struct view_light *light = &v.view.lights[0];
    assert_near(light->position, vec3_add(vec3_mul(view.lights[0].position, factor), offset), size);
    assert_near(light->edge_u, vec3_mul(edge_u, factor), size);
    assert_near(light->edge_v, vec3_mul(edge_v, factor), size);
    assert_near(light->outward, view.lights[0].outward, 1);
    assert_close(light->emission.x, 7 * factor * factor);
    assert_near(v.view.camera.position, vec3_add(vec3_mul((vec3){0, 1, 7}, factor), offset), size);
    end(&t);
}

static void turned_and_stretched_models_go_along(void **state) {
    (void)state;
    check_change(EXTREME_SCALE, 1, 1, (vec3){0, 0, 0});
    check_change(EXTREME_SCALE, 1e-6, 1e-6, (vec3){0, 0, 0});
    check_change(EXTREME_SCALE, 1e5, 1e5, (vec3){0, 0, 0});
    check_change(EXTREME_MOVE, 100, 1, (vec3){100, -50, 75});
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_panel_turns_to_the_surface),
        cmocka_unit_test(no_surface_is_told),
        cmocka_unit_test(turned_and_stretched_models_go_along),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
