// glint as a system that takes turns, in single or double precision, or with a copy of the mesh for each
// model in place of instances; and the method of the course project that it grew out of.
//
//     turns_glint [--system single|double|baked|baseline] ... (turns.h)
#include "bench/kit.h"
#include "bench/original/original.h"
#include "bench/turns/turns.h"
#include "grammar/ir.h"
#include "render/shot.h"

#include <string.h>

struct glint {
    struct gpu *gpu;
    struct shot shot;
    struct original *original; // of the baseline
    uint32_t cut;              // pixels that the device cut short
    struct render_statistics last;
    struct render_rays rays;
};

static enum turns_status device_says(const struct glint *g) {
    return turns_say(TURNS_FAILED, "%s", *gpu_error(g->gpu) ? gpu_error(g->gpu) : "not enough memory");
}

static enum turns_status open_baseline(struct glint *g, struct image *image) {
    char error[GPU_ERROR_BYTES];
    // It takes camera and frame of glint's last picture.
    if (shot_take(&g->shot, image, NULL, &g->last) != SHOT_OK)
        return device_says(g);
    g->original = original_create(g->shot.renderer, ORIGINAL_STORAGE, error);
    return g->original ? TURNS_DONE : turns_say(TURNS_CANNOT, "%s", error);
}

static enum turns_status warm(struct glint *g, const struct turns_options *o) {
    struct image image;
    if (!image_init(&image, g->shot.settings.width, g->shot.settings.height))
        return turns_say(TURNS_FAILED, "not enough memory");
    enum turns_status status = TURNS_DONE;
    if (strcmp(o->system, "baseline") == 0)
        status = open_baseline(g, &image);
    else if (shot_take(&g->shot, &image, NULL, &g->last) != SHOT_OK ||
             renderer_count(g->shot.renderer, &g->shot.view.camera, NULL, &g->rays) != RENDER_DONE)
        status = device_says(g);
    image_finish(&image);
    return status;
}

static enum turns_status open_glint(void *state, const struct turns_options *o, struct session *session) {
    struct glint *g = state;
    g->gpu = bench_gpu(o->device);
    if (!g->gpu)
        return TURNS_CANNOT;
    const bool is_double = strcmp(o->system, "double") == 0;
    if (is_double && !gpu_info(g->gpu)->has_double)
        return turns_say(TURNS_CANNOT, "%s has no double precision", gpu_info(g->gpu)->name);
    session->scene->trace.precision = is_double ? IR_PRECISION_DOUBLE : IR_PRECISION_SINGLE;
    const struct shot_wish wish = {.copies = strcmp(o->system, "baked") == 0};
    const enum shot_status status = shot_open_for(&g->shot, session, g->gpu, 0, wish);
    if (status != SHOT_OK)
        return status == SHOT_DEVICE ? device_says(g) : TURNS_FAILED;
    return warm(g, o);
}

static bool take_frame(void *state, struct image *image, double *device) {
    struct glint *g = state;
    if (g->original)
        return original_render(g->original, image->rgb, device, &g->cut) || device_says(g) == TURNS_DONE;
    if (shot_take(&g->shot, image, NULL, &g->last) != SHOT_OK)
        return device_says(g) == TURNS_DONE;
    *device = g->last.device_seconds;
    return true;
}

static void write_facts(void *state, struct json_writer *w) {
    const struct glint *g = state;
    const struct render_rays *rays = &g->rays;
    json_write_text(w, "device", str_from(gpu_info(g->gpu)->name));
    json_write_boolean(w, "on_processor", gpu_info(g->gpu)->kind == GPU_CPU);
    json_write_integer(w, "triangles", g->shot.flat.triangle_count);
    json_write_integer(w, "spheres", g->shot.flat.sphere_count);
    json_write_real(w, "flatten_s", g->shot.flatten_seconds);
    json_write_real(w, "tree_s", g->shot.flat.build_seconds);
    json_write_real(w, "upload_s", g->shot.upload_seconds);
    json_write_integer(w, "scene_bytes", renderer_scene_bytes(g->shot.renderer));
    json_write_integer(w, "cut_pixels", g->cut);
    json_open_object(w, "rays");
    json_write_integer(w, "primary", rays->primary);
    json_write_integer(w, "reflected", rays->reflected);
    json_write_integer(w, "refracted", rays->refracted);
    json_write_integer(w, "shadow", rays->shadow);
    json_close_object(w);
    json_write_integer(w, "nodes_tested", rays->nodes);
    json_write_integer(w, "items_tested", rays->items);
}

static void close_glint(void *state) {
    struct glint *g = state;
    original_destroy(g->original);
    shot_close(&g->shot);
    if (g->gpu)
        gpu_destroy(g->gpu);
}

int main(int argc, char **argv) {
    static const struct turns_system system = {"single", open_glint, take_frame, write_facts, close_glint};
    static struct glint glint;
    return turns_main(argc, argv, &system, &glint);
}
