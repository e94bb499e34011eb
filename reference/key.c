#include "reference/key.h"

#include "core/xxh64.h"
#include "grammar/ir.h"

// Two seeds make 128 bits.
struct hash {
    struct xxh64 states[2];
};

static void begin(struct hash *h) {
    xxh64_begin(&h->states[0], 0);
    xxh64_begin(&h->states[1], 1);
}

static void add(struct hash *h, const void *bytes, size_t count) {
    xxh64_add(&h->states[0], bytes, count);
    xxh64_add(&h->states[1], bytes, count);
}

static void end(const struct hash *h, uint64_t key[2]) {
    key[0] = xxh64_end(&h->states[0]);
    key[1] = xxh64_end(&h->states[1]);
}

// Value by value: structs have padding.
static void whole(struct hash *h, uint64_t value) {
    add(h, &value, sizeof value);
}
static void number(struct hash *h, double value) {
    add(h, &value, sizeof value);
}
static void vector(struct hash *h, vec3 v) {
    number(h, v.x);
    number(h, v.y);
    number(h, v.z);
}

// ---- the scene

static void add_view(struct hash *h, const struct view *view) {
    const struct view_camera *c = &view->camera;
    const vec3 camera[4] = {c->position, c->right, c->up, c->forward};
    for (int i = 0; i < 4; i++)
        vector(h, camera[i]);
    number(h, c->tan_half_fov);
    whole(h, view->light_count);
    for (uint32_t i = 0; i < view->light_count; i++) {
        const struct view_light *light = &view->lights[i];
        whole(h, light->directional);
        whole(h, light->inverse_square);
        vector(h, light->position);
        vector(h, light->to_light);
        vector(h, light->emission);
    }
}

static void add_material(struct hash *h, const struct ir_material *m, unsigned transfer) {
    const struct ir_paint *paint = &m->diffuse_color;
    bool checker = paint->kind == IR_PAINT_CHECKER;
    whole(h, checker);
    for (int i = 0; i < 2; i++)
        vector(h, view_linear_color(checker ? paint->checker.colors[i] : paint->color, transfer));
    number(h, checker ? paint->checker.size : 0);
    vector(h, view_linear_color(m->specular_color, transfer));
    const double numbers[] = {m->albedo.diffuse,    m->albedo.specular,   m->albedo.reflection,
                              m->albedo.refraction, m->specular_exponent, m->refractive_index};
    add(h, numbers, sizeof numbers);
}

static void add_mesh(struct hash *h, const struct mesh *mesh) {
    whole(h, mesh->closed);
    whole(h, mesh->position_count);
    add(h, mesh->positions, mesh->position_count * sizeof *mesh->positions);
    whole(h, mesh->normal_count);
    if (mesh->normal_count)
        add(h, mesh->normals, mesh->normal_count * sizeof *mesh->normals);
    whole(h, mesh->triangle_count);
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const struct mesh_triangle *t = &mesh->triangles[i];
        const uint32_t words[7] = {t->corners[0], t->corners[1], t->corners[2], t->normals[0],
                                   t->normals[1], t->normals[2], t->group};
        add(h, words, sizeof words);
    }
}

// A mesh is read once; models that show it again name the first that did.
static void add_models(struct hash *h, const struct reference_input *input) {
    const struct ir_models *models = &input->scene->models;
    whole(h, models->count);
    for (uint32_t i = 0; i < models->count; i++) {
        const struct assets_model *asset = &input->assets->models[i];
        affine3 place = view_model_transform(&models->items[i]);
        uint32_t first = 0;
        while (input->assets->models[first].mesh != asset->mesh)
            first++;
        whole(h, first);
        if (!asset->mesh)
            continue;
        add(h, place.linear.m, sizeof place.linear.m);
        vector(h, place.offset);
        whole(h, models->items[i].smooth);
        if (first == i)
            add_mesh(h, asset->mesh);
        add(h, asset->group_material, asset->mesh->group_count * sizeof *asset->group_material);
    }
}

static void add_simple_bodies(struct hash *h, const struct ir_scene *scene) {
    whole(h, scene->spheres.count);
    for (uint32_t i = 0; i < scene->spheres.count; i++) {
        const struct ir_sphere *sphere = &scene->spheres.items[i];
        vector(h, sphere->center);
        number(h, sphere->radius);
        whole(h, assets_material(scene, &sphere->material));
    }
    whole(h, scene->rectangles.count);
    for (uint32_t i = 0; i < scene->rectangles.count; i++) {
        const struct ir_rectangle *r = &scene->rectangles.items[i];
        vector(h, r->corner);
        vector(h, r->edge_u);
        vector(h, r->edge_v);
        whole(h, assets_material(scene, &r->material));
    }
}

static void add_background(struct hash *h, const struct reference_input *input) {
    const struct ir_background *b = &input->scene->background;
    const struct picture *picture = input->assets->background;
    whole(h, b->kind);
    number(h, b->intensity);
    number(h, b->rotation);
    vector(h, b->kind == IR_BACKDROP_COLOR ? view_linear_color(b->color, input->scene->image.transfer)
                                           : (vec3){0, 0, 0});
    whole(h, picture != NULL);
    if (!picture)
        return;
    whole(h, input->scene->image.transfer);
    whole(h, picture->depth);
    whole(h, picture->width);
    whole(h, picture->height);
    add(h, picture->pixels, picture->size_bytes);
}

void reference_scene_key(const struct reference_input *input, uint64_t key[2]) {
    struct hash h;
    begin(&h);
    whole(&h, REFERENCE_VERSION);
    whole(&h, input->test);
    whole(&h, input->scene->trace.shadows);
    add_view(&h, input->view);
    whole(&h, input->assets->material_count);
    for (uint32_t i = 0; i < input->assets->material_count; i++)
        add_material(&h, &input->assets->materials[i], input->scene->image.transfer);
    add_simple_bodies(&h, input->scene);
    add_models(&h, input);
    add_background(&h, input);
    end(&h, key);
}

// ---- one call

void reference_call_key(const uint64_t scene_key[2], const struct reference_settings *settings, bool hits,
                        uint64_t key[2]) {
    struct hash h;
    begin(&h);
    whole(&h, scene_key[0]);
    whole(&h, scene_key[1]);
    whole(&h, hits);
    whole(&h, settings->width);
    whole(&h, settings->height);
    if (!hits) {
        whole(&h, settings->samples);
        whole(&h, settings->max_depth);
        number(&h, settings->min_weight);
        whole(&h, settings->cut_sees_background);
        whole(&h, settings->segments);
        whole(&h, settings->as_file);
    }
    end(&h, key);
}
