// One frame: its uniforms, portions and samples.
#include "core/angle.h"
#include "scene/points.h"
#include "tracer/render/render_private.h"

#include <assert.h>
#include <math.h>
#include <string.h>

static void put(float out[3], vec3 v) {
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
}

#define PUT_DOUBLES(frame, name, v)                                                                          \
    do {                                                                                                     \
        const vec3 put_vector = v;                                                                           \
        (frame).double_##name##_x = put_vector.x;                                                            \
        (frame).double_##name##_y = put_vector.y;                                                            \
        (frame).double_##name##_z = put_vector.z;                                                            \
    } while (false)

// Exact at multiples of 90 degrees.
static double cos_degrees(double degrees) {
    const double turn = remainder(degrees, 360);
    if (fmod(turn, 90) == 0)
        return turn == 0 ? 1 : fabs(turn) == 180 ? -1 : 0;
    return cos(turn * RADIANS);
}

// What the camera is inside, in the order of media.glsl: last entered first.
static void put_inside(const struct flat_scene *flat, const struct view_camera *camera,
                       struct frame_block *frame) {
    uint32_t *entries[MEDIA_MOST] = {&frame->inside_0, &frame->inside_1, &frame->inside_2, &frame->inside_3,
                                     &frame->inside_4, &frame->inside_5, &frame->inside_6, &frame->inside_7};
    const struct scene *scene = flat->scene;
    struct scene_inside inside;
    if (!(flat->features & FEATURE_MEDIA))
        return;
    scene_media_at(scene, camera->position, &inside);
    for (uint32_t i = 0; i < inside.count; i++) {
        const uint32_t body = inside.bodies[inside.count - 1 - i];
        const uint32_t material = scene_medium_material(scene, &scene->bodies[body]);
        const uint32_t priority = (uint32_t)(scene->materials[material].priority + MEDIUM_PRIORITY);
        *entries[i] = priority << MEDIUM_BITS | (body + 1);
    }
}

// The samples that share a pixel's footprint: if pixels end by their error, the number that each pixel has.
static double samples_of(const struct renderer *renderer) {
    const struct render_settings *settings = &renderer->settings;
    const uint32_t all = settings->whole_samples ? settings->whole_samples : settings->samples;
    return renderer_is_adaptive(renderer) ? settings->least_samples : all;
}

static_assert(IR_PROJECTION_ORTHOGRAPHIC == PROJECTION_ORTHOGRAPHIC &&
                  IR_PROJECTION_FISHEYE == PROJECTION_FISHEYE &&
                  IR_PROJECTION_PANORAMA == PROJECTION_PANORAMA,
              "kernels know projections by the same numbers");

// What camera_right and camera_up are multiplied by (PROJECTION_).
static void reach_of(const struct view_camera *camera, double aspect, double scale, double *right,
                     double *up) {
    *up = 1;
    *right = 1;
    if (camera->projection == IR_PROJECTION_PANORAMA)
        return;
    if (camera->projection == IR_PROJECTION_ORTHOGRAPHIC)
        *up = camera->half_height * scale;
    else if (camera->projection == IR_PROJECTION_FISHEYE)
        *up = camera->half_field / (90 * RADIANS);
    else
        *up = camera->tan_half_fov;
    *right = *up * aspect;
}

// How much wider a pixel gets per length along the view; for parallel rays its width, for fisheye and
// panorama its angle.
static double footprint_of(const struct view_camera *camera, double scale) {
    if (camera->projection == IR_PROJECTION_ORTHOGRAPHIC)
        return 2 * camera->half_height * scale;
    if (camera->projection == IR_PROJECTION_FISHEYE)
        return 2 * camera->half_field;
    return camera->projection == IR_PROJECTION_PANORAMA ? 180 * RADIANS : 2 * camera->tan_half_fov;
}

// Describes the picture that the camera sees, and the part of it that is drawn.
static void put_place(const struct render_settings *settings, struct frame_block *frame) {
    const struct render_size whole = renderer_whole(settings);
    frame->whole_width = whole.width;
    frame->whole_height = whole.height;
    frame->first_x = settings->first_x;
    frame->first_y = settings->first_y;
    frame->width = settings->width;
    frame->height = settings->height;
    frame->double_background_cos = cos_degrees(settings->background_rotation);
    frame->double_background_sin = cos_degrees(settings->background_rotation - 90);
    frame->point_bits = settings->whole_samples ? points_bits(0, settings->whole_samples)
                                                : points_bits(settings->first_sample, settings->samples);
}

bool renderer_write_frame(struct renderer *renderer, const struct view_camera *camera) {
    const struct render_settings *settings = &renderer->settings;
    const struct flat_scene *flat = renderer->flat;
    const double scale = ldexp(1, flat->scale_exponent);
    const struct render_size whole = renderer_whole(settings);
    const double aspect = (double)whole.width / whole.height, apart = fmax(settings->apart, 1);
    struct frame_block frame = {
        .light_count = flat->light_count,
        .min_weight = (float)settings->min_weight,
        .max_depth = settings->max_depth,
        .path_segments =
            settings->path_segments < UINT32_MAX ? (uint32_t)settings->path_segments : UINT32_MAX,
        .background_intensity = (float)settings->background_intensity,
        .occlusion = (float)flat->occlusion,
        .background_width = flat->background ? flat->background->width : 1,
        .background_height = flat->background ? flat->background->height : 1,
        .background_cos = (float)cos_degrees(settings->background_rotation),
        .background_sin = (float)cos_degrees(settings->background_rotation - 90),
        .tiles_x = renderer->tiles_x,
        .run_tiles = renderer->run_tiles,
        .runs = renderer->runs,
        .run_step = renderer->run_step,
        .sphere_count = flat->sphere_count,
        .slice_iterations = settings->slice_iterations,
        .features = flat->features,
        .top_nodes = flat->top_nodes,
        .instance_table = flat->instance_table,
        .instance_shift = flat->instance_shift,
        .coordinates_table = flat->coordinates_table,
        .footprint = (float)(footprint_of(camera, scale) / whole.height / sqrt(samples_of(renderer)) / apart),
        .projection = camera->projection,
        .lens_radius = (float)fmin(camera->lens_radius * scale, FLAT_LENGTH_MAX),
        .focus = (float)(camera->focus * scale),
        .seen_table = flat->seen_table,
        .seen_count = flat->seen_count,
        .sky_table = flat->sky_table,
        .sky_width = flat->sky.width,
        .sky_rows = flat->sky.rows,
        .sky_stride = flat->sky.stride,
    };
    put_place(settings, &frame);
    put_inside(flat, camera, &frame);
    const vec3 position = vec3_mul(vec3_sub(camera->position, flat->origin), scale);
    double reach_right, reach_up;
    reach_of(camera, aspect, scale, &reach_right, &reach_up);
    const vec3 right = vec3_mul(camera->right, reach_right);
    const vec3 up = vec3_mul(camera->up, reach_up);
    put(frame.camera_position, position);
    put(frame.camera_forward, camera->forward);
    put(frame.camera_right, right);
    put(frame.camera_up, up);
    put(frame.background, settings->background);
    put(frame.ambient, flat->scene->ambient);
    PUT_DOUBLES(frame, position, position);
    PUT_DOUBLES(frame, forward, camera->forward);
    PUT_DOUBLES(frame, right, right);
    PUT_DOUBLES(frame, up, up);
    return gpu_write(renderer->gpu, renderer->buffers[BINDING_FRAME], 0, &frame, sizeof frame);
}

static enum render_result draw_portion(struct renderer_frame *run, uint32_t tile_begin, uint32_t tile_count,
                                       float *rgb) {
    struct renderer *renderer = run->renderer;
    for (uint32_t sample = 0; sample < renderer->settings.samples; sample++) {
        const enum render_result result = renderer_draw_sample(run, tile_begin, tile_count, sample);
        if (result != RENDER_DONE)
            return result;
    }
    if (!rgb)
        return RENDER_DONE;
    const uint32_t *sums = renderer_sums(renderer, tile_count);
    if (!sums)
        return RENDER_FAILED;
    if (renderer_unpack(renderer, tile_begin, tile_count, sums, renderer->settings.samples, rgb))
        renderer_note_faults(renderer, tile_begin, tile_count, sums, run->statistics);
    return RENDER_DONE;
}

bool renderer_begin_frame(struct renderer_frame *run, const struct view_camera *camera) {
    const struct renderer *renderer = run->renderer;
    run->steps_done = 0;
    run->met_long_ray = false;
    run->statistics->portions = (renderer->tiles + renderer->portion_tiles - 1) / renderer->portion_tiles;
    run->steps = (uint64_t)run->statistics->portions * renderer->settings.samples;
    run->statistics->samples = renderer->settings.samples;
    run->statistics->all_samples =
        (uint64_t)renderer->settings.width * renderer->settings.height * renderer->settings.samples;
    return renderer_write_frame(run->renderer, camera) && renderer_order_tiles(run->renderer, camera);
}

enum render_result renderer_draw_frame(struct renderer_frame *run, const struct view_camera *camera,
                                       float *rgb) {
    struct renderer *renderer = run->renderer;
    const uint32_t tiles = renderer->tiles;
    enum render_result result = renderer_begin_frame(run, camera) ? RENDER_DONE : RENDER_FAILED;
    if (result == RENDER_DONE && renderer_is_adaptive(renderer))
        return renderer_draw_adaptive(run, rgb);
    if (result == RENDER_DONE && renderer->samples_at_once)
        return renderer_draw_at_once(run, rgb);
    for (uint32_t begin = 0; result == RENDER_DONE && begin < tiles; begin += renderer->portion_tiles) {
        const uint32_t left = tiles - begin;
        result =
            draw_portion(run, begin, left < renderer->portion_tiles ? left : renderer->portion_tiles, rgb);
    }
    return result;
}
