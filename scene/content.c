#include "scene/content.h"

#include "grammar/ir.h"
#include "grammar/ir_hash.h"

#include <assert.h>
#include <inttypes.h>
#include <stdio.h>

static_assert(sizeof(struct mesh_triangle) == 8 * sizeof(uint32_t), "triangles are hashed as bytes");

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

// Meshes, and which material each of their groups has. A mesh is read once; bodies that show it again refer
// to the first.
static void add_bodies(struct hash128 *h, const struct scene *scene) {
    for (uint32_t i = 0; i < scene->body_count; i++) {
        const struct scene_body *body = &scene->bodies[i];
        const affine3 *place = body->element ? scene_place(scene, body->element, body->index) : NULL;
        if (place)
            hash128_array(h, place, 1, sizeof *place);
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

// The images of all materials: their levels follow from them. An image already hashed is referred to by its
// number.
static void add_images(struct hash128 *h, const struct scene *scene) {
    for (uint32_t i = 0; i < scene->material_count; i++)
        for (int k = 0; k < ASSETS_IMAGES; k++) {
            const struct scene_texture *texture = scene->materials[i].images[k].texture;
            hash128_whole(h, texture ? texture->number + UINT64_C(1) : 0);
        }
    for (const struct scene_texture *t = scene->textures; t; t = t->next)
        add_picture(h, t->picture);
}

void scene_content(struct hash128 *h, const struct scene *scene) {
    ir_hash(h, &SCHEMA_SCENE, scene->ir);
    // The scene's materials again, as they are used, and those that the material files of meshes add.
    hash128_whole(h, scene->assets->material_count);
    for (uint32_t i = 0; i < scene->assets->material_count; i++)
        ir_hash(h, &SCHEMA_MATERIAL, &scene->assets->materials[i]);
    add_bodies(h, scene);
    add_picture(h, scene->background.picture);
    add_images(h, scene);
}

void scene_content_text(const struct scene *scene, char text[SCENE_CONTENT_TEXT]) {
    struct hash128 h;
    uint64_t key[2];
    hash128_begin(&h);
    scene_content(&h, scene);
    hash128_end(&h, key);
    snprintf(text, SCENE_CONTENT_TEXT, "%016" PRIx64 "%016" PRIx64, key[0], key[1]);
}
