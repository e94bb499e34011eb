#include "reference/reference.h"

#include "core/clock.h"
#include "core/heap.h"
#include "core/parallel.h"
#include "grammar/ir.h"
#include "reference/reference_internal.h"

#include <stdatomic.h>
#include <stdlib.h>

enum {
    TILE = 16,            // pixels a side
    RAYS_A_REPORT = 2048, // per report of a tile, before its pixels count as done
};

// ---- making

static void fill(void *context) {
    struct reference *r = context;
    if (!reference_make_bodies(r))
        arena_raise(&r->arena, ARENA_FAULT_CAP);
    reference_make_background(r);
}

struct reference *reference_create(const struct reference_input *input) {
    struct reference *r = heap_alloc(sizeof *r);
    if (!r)
        return NULL;
    *r = (struct reference){.input = *input, .origin = input->view->camera.position};
    arena_init(&r->arena, SIZE_MAX);
    if (arena_guarded(&r->arena, fill, r) == ARENA_FAULT_NONE && reference_make_tree(r) &&
        reference_make_media(r))
        return r;
    reference_destroy(r);
    return NULL;
}

void reference_destroy(struct reference *r) {
    if (!r)
        return;
    for (uint32_t i = 0; i < r->shared_mesh_count; i++) {
        free(r->shared_meshes[i].nodes);
        free(r->shared_meshes[i].order);
    }
    arena_finish(&r->arena);
    free(r->primitives);
    free(r->nodes);
    free(r);
}

void reference_look(struct reference *r, const struct view *view) {
    r->input.view = view;
}

struct reference_settings reference_settings_of(const struct ir_scene *ir, const struct ir_image *image,
                                                const struct limits *limits, bool as_file) {
    const struct ir_trace *trace = &ir->trace;
    const bool by_error = image->error > 0 && image->samples > 1;
    return (struct reference_settings){
        .width = (uint32_t)image->width,
        .height = (uint32_t)image->height,
        .samples = (uint32_t)image->samples,
        .points_of = by_error ? (uint32_t)image->samples : 0,
        .footprint_of = by_error ? (uint32_t)image->min_samples : 0,
        .max_depth = as_file ? (uint32_t)trace->max_depth : REFERENCE_MAX_DEPTH,
        .min_weight = as_file ? trace->min_weight : REFERENCE_MIN_WEIGHT,
        .cut_sees_background = as_file && trace->depth_limit == IR_DEPTH_BACKGROUND,
        .segments = limits->value[as_file ? LIMIT_PATH_SEGMENTS : LIMIT_REFERENCE_SEGMENTS],
        .as_file = as_file};
}

// ---- single rays

static struct points points_of(const struct reference_settings *settings, uint32_t x, uint32_t y,
                               uint32_t sample) {
    const uint32_t planned = settings->planned ? settings->planned : settings->samples;
    const uint32_t samples = settings->points_of ? settings->points_of : planned;
    return (struct points){x, y, sample, points_bits(settings->first_sample, samples)};
}

vec3 reference_camera_ray(const struct reference *r, const struct reference_settings *settings, uint32_t x,
                          uint32_t y, uint32_t sample, vec3 *origin) {
    const struct points points = points_of(settings, x, y, sample);
    const struct camera_ray ray = reference_lens_ray(r, settings, &points);
    if (origin)
        *origin = vec3_add(ray.start, r->origin);
    return ray.direction;
}

void reference_closest(const struct reference *r, vec3 origin, vec3 direction, double t_max,
                       struct reference_hit *hit) {
    struct ray ray = {
        .start = reference_start(vec3_sub(origin, r->origin)), .direction = direction, .t_max = t_max};
    struct intersection nearest;
    struct surface s;
    *hit = (struct reference_hit){.body = HIT_NONE, .material = IR_NO_INDEX};
    reference_intersect(r, &ray, &nearest);
    if (nearest.primitive == NO_PRIMITIVE)
        return;
    reference_surface(r, &ray, &nearest, &s);
    const vec3 start_through = reference_leave(r, &s, vec3_neg(s.geometric)).at;
    const vec3 start_back = reference_leave(r, &s, s.geometric).at;
    *hit = (struct reference_hit){.body = s.body,
                                  .triangle = s.triangle,
                                  .t = s.distance,
                                  .b1 = s.b1,
                                  .b2 = s.b2,
                                  .point = vec3_add(s.point, r->origin),
                                  .geometric = s.geometric,
                                  .shading = s.shading,
                                  .enters = s.enters,
                                  .material = s.material,
                                  .start_back = vec3_add(start_back, r->origin),
                                  .start_through = vec3_add(start_through, r->origin)};
}

bool reference_occluded(const struct reference *r, vec3 origin, vec3 direction, double t_max) {
    struct ray ray = {
        .start = reference_start(vec3_sub(origin, r->origin)), .direction = direction, .t_max = t_max};
    return reference_blocks(r, &ray);
}

static void follow(const struct reference *r, const struct reference_settings *settings, uint32_t x,
                   uint32_t y, uint32_t number, struct queue *queue, struct log *log, struct sample *out) {
    const struct points points = points_of(settings, x, y, number);
    reference_follow(r, settings, &points, queue, log, out);
}

uint32_t reference_log(const struct reference *r, const struct reference_settings *settings, uint32_t x,
                       uint32_t y, uint32_t sample, struct reference_segment *segments, uint32_t capacity,
                       vec3 *radiance) {
    struct queue queue = {0};
    struct log log = {segments, capacity, 0};
    struct sample out;
    follow(r, settings, x, y, sample, &queue, &log, &out);
    bool failed = queue.failed;
    reference_queue_finish(&queue);
    if (radiance)
        *radiance = out.radiance;
    return failed ? 0 : log.count;
}

// ---- pictures

// A tile's part of the statistics.
struct tile_sum {
    struct sample sum; // of the counts; largest of `deepest` and `brightest`
    double left_weight_most, left_weight;
    struct reference_fault not_finite, over_segments, cut_short;
};

struct work {
    const struct reference *r;
    const struct reference_settings *settings;
    double *rgb;            // a picture, or
    struct hit_pixel *hits; // what first rays hit
    struct tile_sum *tiles;
    uint32_t tiles_x;
    const struct reference_progress *progress;
    size_t pixels;
    atomic_size_t done;
    atomic_bool cancelled, failed;
    atomic_flag reporting;
    double told; // the progress last reported, for whoever holds `reporting`
};

// One thread at a time reports progress; the others go on.
static void tell(struct work *w, size_t pixels) {
    atomic_fetch_add(&w->done, pixels);
    if (!w->progress || atomic_flag_test_and_set(&w->reporting))
        return;
    // In the middle of a pixel, half a pixel more is done. Never goes back.
    double done = (double)atomic_load(&w->done) + (pixels ? 0 : 0.5);
    w->told = fmax(w->told, done / (double)w->pixels);
    if (!w->progress->report(w->progress->context, fmin(w->told, 1)))
        atomic_store(&w->cancelled, true);
    atomic_flag_clear(&w->reporting);
}

// Called in the middle of a pixel, which may take long.
static bool goes_on(void *context) {
    struct work *w = context;
    tell(w, 0);
    return !atomic_load_explicit(&w->cancelled, memory_order_relaxed);
}

static void note_fault(struct reference_fault *fault, uint32_t x, uint32_t y, const struct sample *s) {
    if (fault->pixels++ == 0)
        *fault = (struct reference_fault){1, x, y, s->body, s->triangle, s->is_nested};
}

static bool is_finite(vec3 v) {
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static void add_sample(struct tile_sum *t, const struct sample *s) {
    for (int k = 0; k < 3; k++)
        t->sum.rays[k] += s->rays[k];
    t->sum.shadow += s->shadow;
    t->sum.total_reflections += s->total_reflections;
    t->sum.unseen += s->unseen;
    t->sum.cut_by_depth += s->cut_by_depth;
    t->sum.cut_by_weight += s->cut_by_weight;
    t->sum.cut_by_segments += s->cut_by_segments;
    if (s->deepest > t->sum.deepest)
        t->sum.deepest = s->deepest;
    t->sum.brightest = fmax(t->sum.brightest, s->brightest);
}

static void draw_pixel(const struct reference *r, const struct reference_settings *settings, uint32_t x,
                       uint32_t y, struct queue *queue, struct tile_sum *tile, double rgb[3]) {
    vec3 sum = {0, 0, 0};
    double left = 0;
    bool not_finite = false;
    bool over_segments = false;
    bool cut_short = false;
    struct sample sample = {0};
    for (uint32_t n = 0; n < settings->samples && !queue->failed && !sample.cancelled; n++) {
        follow(r, settings, x, y, settings->first_sample + n, queue, NULL, &sample);
        bool bad = !is_finite(sample.radiance);
        sum = bad ? (vec3){NAN, NAN, NAN} : vec3_add(sum, sample.radiance);
        if (bad && !not_finite)
            note_fault(&tile->not_finite, x, y, &sample);
        if (sample.over_segments && !over_segments)
            note_fault(&tile->over_segments, x, y, &sample);
        if (!settings->as_file && sample.cut_by_segments && !cut_short)
            note_fault(&tile->cut_short, x, y, &sample);
        not_finite |= bad;
        cut_short |= sample.cut_by_segments > 0;
        over_segments |= sample.over_segments;
        left += sample.left_weight;
        add_sample(tile, &sample);
    }
    left /= settings->samples;
    tile->left_weight_most = fmax(tile->left_weight_most, left);
    tile->left_weight += left;
    rgb[0] = sum.x / settings->samples;
    rgb[1] = sum.y / settings->samples;
    rgb[2] = sum.z / settings->samples;
}

bool reference_pixel(const struct reference *r, const struct reference_settings *settings, uint32_t x,
                     uint32_t y, double rgb[3]) {
    struct queue queue = {0};
    struct tile_sum sum = {0};
    draw_pixel(r, settings, x, y, &queue, &sum, rgb);
    const bool failed = queue.failed;
    reference_queue_finish(&queue);
    return !failed;
}

// The body that a ray from a surface hits.
static uint32_t body_ahead(const struct reference *r, struct start start, vec3 direction) {
    struct ray ray = {.start = start, .direction = direction, .t_max = INFINITY};
    struct intersection hit;
    reference_intersect(r, &ray, &hit);
    return hit.primitive == NO_PRIMITIVE ? HIT_NONE : r->primitives[hit.primitive].body;
}

static struct hit_pixel first_hit(const struct reference *r, const struct reference_settings *settings,
                                  const struct points *points) {
    struct hit_pixel hit = {.body = HIT_NONE, .reflected = HIT_NONE, .refracted = HIT_NONE};
    const struct camera_ray seen = reference_lens_ray(r, settings, points);
    const vec3 direction = seen.direction;
    struct reference_settings alone = *settings; // its footprint is that of a pixel's only sample
    alone.samples = 1;
    alone.footprint_of = alone.planned = 0;
    struct ray ray = {.start = reference_start(seen.start),
                      .direction = direction,
                      .t_max = INFINITY,
                      .cone = reference_camera_cone(r, &alone, direction)};
    struct intersection nearest;
    struct surface s;
    struct lighting lighting;
    reference_intersect(r, &ray, &nearest);
    if (nearest.primitive == NO_PRIMITIVE)
        return hit;
    reference_surface(r, &ray, &nearest, &s);
    reference_cross(r, &r->around_camera, &s);
    hit.body = s.body;
    hit.triangle = s.triangle;
    hit.distance = s.distance;
    hit.normal = s.shading;
    hit.albedo = s.diffuse;
    if (s.passes) {
        hit.refracts = 1;
        hit.refracted = body_ahead(r, reference_leave(r, &s, vec3_neg(s.geometric)), direction);
        return hit;
    }
    reference_light(r, &s, direction, &r->around_camera, points, point_root(points->x, points->y), &lighting);
    hit.considered = lighting.considered;
    hit.lit = lighting.lit;
    struct split split;
    reference_roughen(r, &s, direction, points, 0);
    reference_split(r, &s, direction, &split);
    hit.refracts = reference_refraction(&s, &split) > 0;
    hit.reflects = reference_reflection(&s, &split) > 0;
    if (hit.refracts)
        hit.refracted = body_ahead(r, reference_leave(r, &s, vec3_neg(s.geometric)), split.bent);
    // Under total reflection the mirrored ray also has the refracted ray's weight.
    if (hit.reflects)
        hit.reflected =
            body_ahead(r, reference_leave(r, &s, s.geometric), reference_mirrored(r, &s, direction));
    return hit;
}

static void do_tile(struct work *w, size_t index) {
    uint32_t width = w->settings->width;
    uint32_t height = w->settings->height;
    uint32_t left = (uint32_t)(index % w->tiles_x) * TILE;
    uint32_t top = (uint32_t)(index / w->tiles_x) * TILE;
    uint32_t right = width - left < TILE ? width : left + TILE;
    uint32_t bottom = height - top < TILE ? height : top + TILE;
    struct queue queue = {.goes_on = goes_on, .context = w};
    size_t untold = 0;
    for (uint32_t y = top; y < bottom; y++) {
        for (uint32_t x = left; x < right; x++) {
            if (queue.rays >= RAYS_A_REPORT) {
                tell(w, untold);
                untold = 0;
                queue.rays = 0;
            }
            if (atomic_load_explicit(&w->cancelled, memory_order_relaxed) || queue.failed)
                break;
            const struct points middle = {x, y, 0, 0};
            if (w->hits)
                w->hits[(size_t)y * width + x] = first_hit(w->r, w->settings, &middle);
            else
                draw_pixel(w->r, w->settings, x, y, &queue, &w->tiles[index],
                           w->rgb + 3 * ((size_t)y * width + x));
            untold++;
        }
    }
    tell(w, untold);
    if (queue.failed)
        atomic_store(&w->failed, true);
    reference_queue_finish(&queue);
}

static void do_tiles(void *context, size_t begin, size_t end) {
    for (size_t i = begin; i < end; i++)
        do_tile(context, i);
}

static void join_fault(struct reference_fault *all, const struct reference_fault *part) {
    if (part->pixels == 0)
        return;
    uint32_t pixels = all->pixels + part->pixels;
    if (all->pixels == 0 || part->y < all->y || (part->y == all->y && part->x < all->x))
        *all = *part;
    all->pixels = pixels;
}

static struct reference_statistics join_tiles(const struct work *w, size_t count) {
    struct tile_sum all = {0};
    for (size_t i = 0; i < count; i++) {
        const struct tile_sum *t = &w->tiles[i];
        add_sample(&all, &t->sum);
        all.left_weight_most = fmax(all.left_weight_most, t->left_weight_most);
        all.left_weight += t->left_weight;
        join_fault(&all.not_finite, &t->not_finite);
        join_fault(&all.over_segments, &t->over_segments);
        join_fault(&all.cut_short, &t->cut_short);
    }
    const struct sample *s = &all.sum;
    double brightest = fmax(s->brightest, w->r->background_brightest);
    return (struct reference_statistics){.primary = s->rays[REFERENCE_PRIMARY],
                                         .reflected = s->rays[REFERENCE_REFLECTED],
                                         .refracted = s->rays[REFERENCE_REFRACTED],
                                         .shadow = s->shadow,
                                         .total_reflections = s->total_reflections,
                                         .unseen = s->unseen,
                                         .cut_by_depth = s->cut_by_depth,
                                         .cut_by_weight = s->cut_by_weight,
                                         .cut_by_segments = s->cut_by_segments,
                                         .deepest = s->deepest,
                                         .left_weight_most = all.left_weight_most,
                                         .left_weight_mean = all.left_weight / (double)w->pixels,
                                         .brightest = brightest,
                                         .bound = all.left_weight_most * brightest,
                                         .not_finite = all.not_finite,
                                         .over_segments = all.over_segments,
                                         .cut_short = all.cut_short};
}

static enum reference_result run(struct work *w, struct reference_statistics *statistics) {
    double start = clock_seconds();
    w->tiles_x = (w->settings->width + TILE - 1) / TILE;
    size_t count = heap_times(w->tiles_x, (w->settings->height + TILE - 1) / TILE);
    w->pixels = (size_t)w->settings->width * w->settings->height;
    w->tiles = heap_zeroed(count, sizeof *w->tiles);
    if (!w->tiles)
        return REFERENCE_NO_MEMORY;
    atomic_flag_clear(&w->reporting);
    parallel_for(count, 1, do_tiles, w);
    if (statistics) {
        *statistics = join_tiles(w, count);
        statistics->seconds = clock_seconds() - start;
    }
    free(w->tiles);
    return atomic_load(&w->failed)      ? REFERENCE_NO_MEMORY
           : atomic_load(&w->cancelled) ? REFERENCE_CANCELLED
                                        : REFERENCE_DONE;
}

enum reference_result reference_render(const struct reference *r, const struct reference_settings *settings,
                                       double *rgb, const struct reference_progress *progress,
                                       struct reference_statistics *statistics) {
    struct work work = {.r = r, .settings = settings, .rgb = rgb, .progress = progress};
    return run(&work, statistics);
}

enum reference_result reference_hits(const struct reference *r, const struct reference_settings *settings,
                                     struct hit_pixel *hits, const struct reference_progress *progress) {
    struct work work = {.r = r, .settings = settings, .hits = hits, .progress = progress};
    return run(&work, NULL);
}
