// Parts of a picture that can be left out: on the device features that are not compiled in, for the reference
// another scene.
#include "core/heap.h"
#include "measure/tradeoff/measure/measure.h"
#include "shaders/features.h"

#include <stdlib.h>
#include <string.h>

static const struct {
    enum knob knob;
    uint32_t feature;
} parts[] = {
    {KNOB_CLEAR_SHADOWS, FEATURE_CLEAR_SHADOWS}, {KNOB_OCCLUSION, FEATURE_OCCLUSION},
    {KNOB_SOFT_LIGHTS, FEATURE_SOFT_LIGHT},      {KNOB_LENS, FEATURE_CAMERA},
    {KNOB_ROUGHNESS, FEATURE_ROUGHNESS},         {KNOB_FILTER, FEATURE_FOOTPRINT},
};

enum {
    PARTS = sizeof parts / sizeof *parts
};

uint32_t without_parts(uint64_t features, const struct view_camera *camera) {
    uint32_t has = 0;
    for (int i = 0; i < PARTS; i++)
        if (features & parts[i].feature && (parts[i].knob != KNOB_LENS || camera->lens_radius > 0))
            has |= 1u << parts[i].knob;
    return has;
}

uint64_t without_features(uint32_t without, const struct view_camera *camera) {
    uint32_t features = 0;
    for (int i = 0; i < PARTS; i++)
        if (without >> parts[i].knob & 1 &&
            (parts[i].knob != KNOB_LENS || camera->projection == IR_PROJECTION_PERSPECTIVE))
            features |= parts[i].feature;
    return features;
}

// ---- for the reference

static void change_material(struct scene_material *m, uint32_t without) {
    if (without & 1u << KNOB_ROUGHNESS)
        m->alpha = 0;
    if (!(without & 1u << KNOB_FILTER))
        return;
    m->soft = false;
    for (int i = 0; i < ASSETS_IMAGES; i++)
        m->images[i].filter =
            m->images[i].filter == IR_FILTER_AUTO ? IR_FILTER_BILINEAR : m->images[i].filter;
}

// false: no memory.
static bool make(struct measuring *s, bool shadows, uint32_t without) {
    const struct tradeoff_input *in = s->input;
    struct measure_variant *v = &s->variant;
    const uint32_t materials = in->scene->material_count, lights = in->view->light_count;
    v->ir = *in->scene->ir;
    v->ir.trace.shadows = shadows;
    v->ir.trace.transparent_shadows &= !(without & 1u << KNOB_CLEAR_SHADOWS);
    v->scene = *in->scene;
    v->scene.ir = &v->ir;
    v->scene.occlusion = without & 1u << KNOB_OCCLUSION ? 0 : v->scene.occlusion;
    v->scene.materials = heap_array((size_t)materials + 1, sizeof *v->scene.materials);
    v->view = *in->view;
    v->view.camera.lens_radius = without & 1u << KNOB_LENS ? 0 : v->view.camera.lens_radius;
    v->view.lights = heap_array((size_t)lights + 1, sizeof *v->view.lights);
    const struct reference_input input = {.scene = &v->scene, .view = &v->view};
    const struct folder_store none = {0};
    reference_source_init(&v->source, &input, none);
    v->is_made = true;
    v->shadows = shadows;
    v->without = without;
    if (!v->scene.materials || !v->view.lights)
        return false;
    for (uint32_t i = 0; i < materials; i++) {
        v->scene.materials[i] = in->scene->materials[i];
        change_material(&v->scene.materials[i], without);
    }
    for (uint32_t i = 0; i < lights; i++) {
        v->view.lights[i] = in->view->lights[i];
        if (without & 1u << KNOB_SOFT_LIGHTS)
            v->view.lights[i].extent = VIEW_POINT;
    }
    return true;
}

void without_close(struct measuring *s) {
    struct measure_variant *v = &s->variant;
    if (!v->is_made)
        return;
    reference_source_finish(&v->source);
    free(v->scene.materials);
    free(v->view.lights);
    v->is_made = false;
}

struct reference_source *without_source(struct measuring *s, bool shadows, uint32_t without) {
    struct measure_variant *v = &s->variant;
    if (!without)
        return &s->source[!shadows];
    if (v->is_made && v->shadows == shadows && v->without == without)
        return &v->source;
    without_close(s);
    return make(s, shadows, without) ? &v->source : NULL;
}
