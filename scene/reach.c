#include "scene/reach.h"

#include "grammar/schema.h"
#include "scene/view.h"

static void check_model(const struct ir_model *model, const struct mesh *mesh, const struct ir_origin *origin,
                        struct diag_sink *sink) {
    affine3 place = view_model_transform(model);
    double largest = 0;
    for (int i = 0; i < 8; i++) {
        vec3 corner = {i & 1 ? mesh->upper.x : mesh->lower.x, i & 2 ? mesh->upper.y : mesh->lower.y,
                       i & 4 ? mesh->upper.z : mesh->lower.z};
        largest = fmax(largest, vec3_max_abs(affine3_apply(place, corner)));
    }
    if (largest <= schema_range_info(SCHEMA_RANGE_COORDINATE)->greatest)
        return;
    diag_add(
        sink, DIAG_TRANSFORM_OVERFLOW, ir_place_label(origin, &model->head),
        "after scale, rotation and translation the model has coordinates of %.3g; at most 1e18 is allowed",
        largest);
}

void scene_check_reach(const struct ir_scene *scene, const struct assets *assets, struct diag_sink *sink) {
    for (uint32_t i = 0; i < assets->model_count; i++)
        if (assets->models[i].mesh)
            check_model(&scene->models.items[i], assets->models[i].mesh, assets->origin, sink);
}
