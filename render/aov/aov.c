#include "render/aov/aov.h"

#include "core/heap.h"
#include "core/parallel.h"

#include <stdlib.h>
#include <string.h>

enum {
    ROWS_A_PIECE = 16,
};

static const struct aov_info infos[AOVS] = {
#define AOV_ROW(id, name, channels, is_whole, of_hits)                                                       \
    [AOV_##id] = {name, channels, sizeof channels - 1, is_whole, of_hits},
    AOV_TABLE(AOV_ROW)
#undef AOV_ROW
};

const struct aov_info *aov_info(enum aov aov) {
    return &infos[aov];
}

enum aov aov_named(str name) {
    int aov = 0;
    while (aov < AOVS && !str_equal(name, str_from(infos[aov].name)))
        aov++;
    return (enum aov)aov;
}

bool aov_needs_hits(uint32_t wanted) {
    bool needs = false;
    for (int i = 0; i < AOVS; i++)
        needs |= (wanted >> i & 1) && infos[i].of_hits;
    return needs;
}

bool aov_init(struct aov_planes *planes, uint32_t width, uint32_t height, uint32_t wanted) {
    *planes = (struct aov_planes){.width = width, .height = height, .wanted = wanted};
    const size_t pixels = heap_times(width, height);
    for (int i = 0; i < AOVS; i++) {
        if (!(wanted >> i & 1))
            continue;
        planes->planes[i] = heap_zeroed(heap_times(pixels, infos[i].channel_count), sizeof(float));
        if (!planes->planes[i]) {
            aov_finish(planes);
            return false;
        }
    }
    return true;
}

void aov_finish(struct aov_planes *planes) {
    for (int i = 0; i < AOVS; i++) {
        free(planes->planes[i]);
        planes->planes[i] = NULL;
    }
}

// ---- of a hit

uint32_t aov_cost(const struct hit_pixel *hit) {
    uint32_t rays = 1 + hit->reflects + hit->refracts;
    for (uint32_t bits = hit->considered; bits; bits &= bits - 1)
        rays++;
    return rays;
}

uint32_t aov_material(const struct scene *scene, const struct hit_pixel *hit) {
    return hit->body == HIT_NONE ? HIT_NONE : scene_body_material(&scene->bodies[hit->body], hit->triangle);
}

struct filling {
    struct aov_planes *planes;
    const struct scene *scene;
    const struct view_camera *camera;
    const struct hit_pixel *hits;
};

static void put_number(const struct aov_planes *planes, enum aov aov, size_t pixel, double value) {
    float *plane = planes->planes[aov];
    if (plane)
        plane[pixel] = (float)value;
}

static void put_vector(const struct aov_planes *planes, enum aov aov, size_t pixel, vec3 v) {
    float *plane = planes->planes[aov];
    if (!plane)
        return;
    plane[3 * pixel] = (float)v.x;
    plane[3 * pixel + 1] = (float)v.y;
    plane[3 * pixel + 2] = (float)v.z;
}

static void put_whole(const struct aov_planes *planes, enum aov aov, size_t pixel, uint32_t value) {
    uint32_t *plane = planes->planes[aov];
    if (plane)
        plane[pixel] = value;
}

static vec3 place_of(const struct filling *f, uint32_t x, uint32_t y, double distance) {
    const struct aov_planes *p = f->planes;
    double across, down;
    view_sample_offset(0, &across, &down);
    const struct view_ray ray = view_ray_at(f->camera, (double)p->width / p->height,
                                            2 * (x + across) / p->width - 1, 1 - 2 * (y + down) / p->height);
    return vec3_add(ray.start, vec3_mul(ray.direction, distance));
}

static void fill_pixel(const struct filling *f, uint32_t x, uint32_t y) {
    const size_t pixel = (size_t)y * f->planes->width + x;
    const struct hit_pixel *hit = &f->hits[pixel];
    put_whole(f->planes, AOV_COST, pixel, aov_cost(hit));
    if (hit->body == HIT_NONE)
        return;
    put_number(f->planes, AOV_DEPTH, pixel, hit->distance);
    put_vector(f->planes, AOV_NORMAL, pixel, hit->normal);
    put_vector(f->planes, AOV_ALBEDO, pixel, hit->albedo);
    if (f->planes->planes[AOV_POSITION])
        put_vector(f->planes, AOV_POSITION, pixel, place_of(f, x, y, hit->distance));
    put_whole(f->planes, AOV_OBJECT, pixel, hit->body + 1);
    put_whole(f->planes, AOV_MATERIAL, pixel, aov_material(f->scene, hit) + 1);
    put_whole(f->planes, AOV_INDEX, pixel, hit->triangle + 1);
}

static void fill_rows(void *context, size_t begin, size_t end) {
    const struct filling *f = context;
    for (size_t y = begin; y < end; y++)
        for (uint32_t x = 0; x < f->planes->width; x++)
            fill_pixel(f, x, (uint32_t)y);
}

void aov_fill(struct aov_planes *planes, const struct scene *scene, const struct view_camera *camera,
              const struct hit_pixel *hits) {
    struct filling filling = {planes, scene, camera, hits};
    parallel_for(planes->height, ROWS_A_PIECE, fill_rows, &filling);
}

void aov_fill_samples(struct aov_planes *planes, const float *error, const uint32_t *samples, uint32_t all) {
    const size_t pixels = (size_t)planes->width * planes->height;
    if (error && planes->planes[AOV_ERROR])
        memcpy(planes->planes[AOV_ERROR], error, pixels * sizeof *error);
    for (size_t i = 0; i < pixels; i++)
        put_whole(planes, AOV_SAMPLES, i, samples ? samples[i] : all);
}
