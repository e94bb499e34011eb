// Which bodies send rays on: a GPU begins with the paths that lead to them.
#include "core/heap.h"
#include "tracer/flatten/flatten_internal.h"

// Appends the body if one of its materials reflects or refracts; a body without a mesh has an empty box.
static void add_body(struct flat_scene *out, const struct scene *scene, const struct scene_body *body) {
    bool reflects = false, refracts = false;
    for (uint32_t i = 0; i < body->group_count; i++) {
        const struct scene_material *material = &scene->materials[body->materials[i]];
        reflects = reflects || material->reflection > 0;
        refracts = refracts || material->refraction > 0;
    }
    if ((reflects || refracts) && body->lower.x <= body->upper.x)
        out->bounces[out->bounce_count++] = (struct flat_bounce){body->lower, body->upper, refracts};
}

enum flatten_fault flatten_bounces(struct flattening *f) {
    const struct scene *scene = f->scene;
    f->out->bounces = heap_array((size_t)scene->body_count + 1, sizeof *f->out->bounces);
    if (!f->out->bounces)
        return FLATTEN_NO_MEMORY;
    for (uint32_t i = 0; i < scene->body_count; i++)
        add_body(f->out, scene, &scene->bodies[i]);
    return FLATTEN_DONE;
}
