#include "reference/key.h"

#include "core/hash128.h"
#include "core/xxh64.h"
#include "scene/content.h"

#include <assert.h>

// Hashes by name what is not in the table: the view, which is made from the scene and may be moved
// afterwards. A new field in one of these structs changes its size: hash the field, then update the size.
// Sizes are for 64 bits.
static_assert(sizeof(void *) != 8 || sizeof(struct view_camera) == 16 + 4 * sizeof(vec3) + 6 * 8,
              "hash the new field of a camera");
static_assert(sizeof(void *) != 8 || sizeof(struct view_light) == 9 * 8 + 8 * sizeof(vec3) + 8,
              "hash the new field of a light");

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
        hash128_whole(h, view_light_is_seen(light));
        hash128_vector(h, light->radiance);
        hash128_whole(h, light->spot);
        hash128_vector(h, light->axis);
        hash128_number(h, light->open);
        hash128_number(h, light->rate);
    }
}

void reference_scene_key(const struct reference_input *input, uint64_t key[2]) {
    struct hash128 h;
    hash128_begin(&h);
    hash128_whole(&h, REFERENCE_VERSION);
    hash128_whole(&h, input->test);
    scene_content(&h, input->scene);
    add_view(&h, input->view);
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
        hash128_number(&h, settings->apart);
        hash128_whole(&h, settings->max_depth);
        hash128_number(&h, settings->min_weight);
        hash128_whole(&h, settings->cut_sees_background);
        hash128_whole(&h, settings->segments);
        hash128_whole(&h, settings->as_file);
    }
    hash128_end(&h, key);
}
