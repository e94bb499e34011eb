#include "app/exact.h"

#include <stdlib.h>

static enum shot_status no_memory(struct session *session) {
    diag_add(&session->sink, DIAG_OUT_OF_MEMORY, ir_place_label(&session->origin, &session->scene->head),
             "not enough memory for the reference");
    return SHOT_SCENE;
}

enum shot_status exact_open(struct exact *exact, struct session *session, uint32_t camera,
                            struct exact_options options) {
    *exact = (struct exact){.session = session};
    if (!session_view(session, camera, &exact->view))
        return no_memory(session);
    struct reference_input input = {
        .scene = session->scene, .assets = &session->assets, .view = &exact->view};
    exact->settings =
        reference_settings_of(session->scene, &session->image, &session->options.limits, options.as_file);
    exact->store_path = options.no_cache ? NULL : folder_store_path(REFERENCE_CACHE_NAME);
    struct folder_store store = {exact->store_path, REFERENCE_CACHE_BYTES};
    reference_source_init(&exact->source, &input, store);
    return SHOT_OK;
}

void exact_close(struct exact *exact) {
    if (!exact)
        return;
    reference_source_finish(&exact->source);
    free(exact->store_path);
    exact->store_path = NULL;
}

static const struct ir_head *body_head(const struct ir_scene *scene, uint32_t body) {
    if (body < scene->spheres.count)
        return &scene->spheres.items[body].head;
    body -= scene->spheres.count;
    if (body < scene->rectangles.count)
        return &scene->rectangles.items[body].head;
    body -= scene->rectangles.count;
    return body < scene->models.count ? &scene->models.items[body].head : &scene->head;
}

static void report_fault(struct session *s, enum diag_code code, const struct reference_fault *fault,
                         const char *words) {
    bool has_body = fault->body != HIT_NONE;
    const struct ir_head *head = has_body ? body_head(s->scene, fault->body) : &s->scene->head;
    if (fault->pixels == 0)
        return;
    diag_add(&s->sink, code, ir_place_label(&s->origin, head), "%u pixel%s %s, the first at %u,%u%s",
             fault->pixels, fault->pixels == 1 ? "" : "s", words, fault->x, fault->y,
             has_body ? ", where the ray last met this body" : "");
    uint32_t first_model = s->scene->spheres.count + s->scene->rectangles.count;
    if (!has_body || fault->body < first_model)
        return;
    const struct mesh *mesh = s->assets.models[fault->body - first_model].mesh;
    diag_note(&s->sink, SPAN_NONE, "at line %u of %.*s", mesh->triangles[fault->triangle].line,
              STR_ARG(mesh->path));
}

enum shot_status exact_take(struct exact *exact, struct image *image, double *rgb,
                            const struct reference_progress *progress,
                            struct reference_statistics *statistics) {
    size_t count = (size_t)exact->settings.width * exact->settings.height * 3;
    double *values = rgb ? rgb : malloc(count * sizeof *values);
    if (!values)
        return no_memory(exact->session);
    enum reference_result result =
        reference_source_render(&exact->source, &exact->settings, values, progress, statistics);
    for (size_t i = 0; result == REFERENCE_DONE && i < count; i++)
        image->rgb[i] = (float)values[i];
    if (!rgb)
        free(values);
    if (result != REFERENCE_DONE)
        return result == REFERENCE_CANCELLED ? SHOT_CANCELLED : no_memory(exact->session);
    report_fault(exact->session, DIAG_NOT_FINITE, &statistics->not_finite,
                 "got a value that is infinite or not a number");
    report_fault(exact->session, DIAG_PATH_SEGMENTS, &statistics->over_segments,
                 "needed more rays than the limit path-segments");
    return SHOT_OK;
}
