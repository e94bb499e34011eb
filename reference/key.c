#include "reference/key.h"

#include "core/hash128.h"
#include "core/xxh64.h"
#include "grammar/ir.h"
#include "grammar/ir_hash.h"

#include <assert.h>

// What is hashed by name here is not in the table: the view, which is made from the scene and may be moved
// afterwards, meshes and images. A field that one of these gains changes its size: hash the field, then count
// it. Sizes are those of 64 bits.
static_assert(sizeof(void *) != 8 || sizeof(struct view_camera) == 16 + 4 * sizeof(vec3) + 6 * 8,
              "hash the new field of a camera");
static_assert(sizeof(void *) != 8 || sizeof(struct view_light) == 5 * 8 + 6 * sizeof(vec3) + 8,
              "hash the new field of a light");
static_assert(sizeof(struct mesh_triangle) == 8 * sizeof(uint32_t), "triangles are hashed as bytes");

static void add_view(struct hash128 *h, const struct view *view) {
    const struct view_camera *c = &view->camera;
    hash128_text(h, c->name);
    hash128_vector(h, c->position);
    hash128_vector(h, c->right);
    hash128_vector(h, c->up);
    hash128_vector(h, c->forward);
    hash128_number(h, c->tan_half_fov);
    hash128_whole(h, c->projection);
    hash128_number(h, c->half_height);
    hash128_number(h, c->half_field);
    hash128_number(h, c->lens_radius);
    hash128_number(h, c->focus);
    hash128_whole(h, view->light_count);
    for (uint32_t i = 0; i < view->light_count; i++) {
        const struct view_light *light = &view->lights[i];
        hash128_whole(h, light->directional);
        hash128_whole(h, light->inverse_square);
        hash128_vector(h, light->position);
        hash128_vector(h, light->to_light);
        hash128_vector(h, light->emission);
        hash128_whole(h, light->extent);
        hash128_number(h, light->radius);
        hash128_number(h, light->half_angle);
        hash128_number(h, light->before_body);
        hash128_vector(h, light->edge_u);
        hash128_vector(h, light->edge_v);
        hash128_vector(h, light->outward);
    }
}

static void add_mesh(struct hash128 *h, const struct mesh *mesh) {
    hash128_whole(h, mesh->closed);
    hash128_whole(h, mesh->turned);
    hash128_array(h, mesh->positions, mesh->position_count, sizeof *mesh->positions);
    hash128_array(h, mesh->normals, mesh->normal_count, sizeof *mesh->normals);
    hash128_array(h, mesh->triangles, mesh->triangle_count, sizeof *mesh->triangles);
    hash128_whole(h, mesh->textured != NULL);
    if (!mesh->textured)
        return;
    hash128_array(h, mesh->coordinates, mesh->coordinate_count, sizeof *mesh->coordinates);
    hash128_array(h, mesh->textured, mesh->triangle_count, sizeof *mesh->textured);
}

// Meshes, and which material each of their groups has. A mesh is read once; bodies that show it again name
// one that did.
static void add_bodies(struct hash128 *h, const struct scene *scene) {
    for (uint32_t i = 0; i < scene->body_count; i++) {
        const struct scene_body *body = &scene->bodies[i];
        uint32_t same = i; // one more than an earlier body that shows the mesh; 0: none
        hash128_array(h, body->materials, body->group_count, sizeof *body->materials);
        while (same > 0 && scene->bodies[same - 1].mesh != body->mesh)
            same--;
        hash128_whole(h, body->mesh ? same : 0);
        if (body->mesh && same == 0)
            add_mesh(h, body->mesh);
    }
}

static void add_picture(struct hash128 *h, const struct picture *picture) {
    hash128_whole(h, picture != NULL);
    if (!picture)
        return;
    hash128_whole(h, picture->depth);
    hash128_whole(h, picture->width);
    hash128_whole(h, picture->height);
    hash128_array(h, picture->pixels, picture->size_bytes, 1);
}

// The images of all materials: their levels follow from them. One that was hashed is named by its number.
static void add_images(struct hash128 *h, const struct scene *scene) {
    for (uint32_t i = 0; i < scene->material_count; i++)
        for (int k = 0; k < ASSETS_IMAGES; k++) {
            const struct scene_texture *texture = scene->materials[i].images[k].texture;
            hash128_whole(h, texture ? texture->number + UINT64_C(1) : 0);
        }
    for (const struct scene_texture *t = scene->textures; t; t = t->next)
        add_picture(h, t->picture);
}

void reference_scene_key(const struct reference_input *input, uint64_t key[2]) {
    const struct scene *scene = input->scene;
    struct hash128 h;
    hash128_begin(&h);
    hash128_whole(&h, REFERENCE_VERSION);
    hash128_whole(&h, input->test);
    ir_hash(&h, &SCHEMA_SCENE, scene->ir);
    // The scene's materials again, as they are used, and those that material files of meshes add.
    hash128_whole(&h, scene->assets->material_count);
    for (uint32_t i = 0; i < scene->assets->material_count; i++)
        ir_hash(&h, &SCHEMA_MATERIAL, &scene->assets->materials[i]);
    add_view(&h, input->view);
    add_bodies(&h, scene);
    add_picture(&h, scene->background.picture);
    add_images(&h, scene);
    hash128_end(&h, key);
}

// ---- one call

void reference_call_key(const uint64_t scene_key[2], const struct reference_settings *settings, bool hits,
                        uint64_t key[2]) {
    struct hash128 h;
    hash128_begin(&h);
    hash128_whole(&h, scene_key[0]);
    hash128_whole(&h, scene_key[1]);
    hash128_whole(&h, hits);
    hash128_whole(&h, settings->width);
    hash128_whole(&h, settings->height);
    if (!hits) {
        hash128_whole(&h, settings->samples);
        hash128_whole(&h, settings->first_sample);
        hash128_whole(&h, settings->points_of);
        hash128_whole(&h, settings->footprint_of);
        hash128_whole(&h, settings->planned);
        hash128_whole(&h, settings->max_depth);
        hash128_number(&h, settings->min_weight);
        hash128_whole(&h, settings->cut_sees_background);
        hash128_whole(&h, settings->segments);
        hash128_whole(&h, settings->as_file);
    }
    hash128_end(&h, key);
}
