// The order in which tiles are traced if samples are traced at once: tiles in which bodies reflect or refract
// come first.
//
// A path with many rays takes long, and what begins last ends last: the GPU's other processors then wait
// idle. Longest work first keeps this wait short (Graham 1969, "Bounds on Multiprocessing Timing Anomalies").
// The length of paths is not known beforehand, so tiles are ranked by the boxes that they show; within a rank
// they keep their order, so neighbours follow each other.
#include "core/heap.h"
#include "tracer/render/render_private.h"

#include <stdlib.h>
#include <string.h>

// Tiles [x0, x1) by [y0, y1).
struct area {
    uint32_t x0, y0, x1, y1;
};

struct grid {
    uint32_t width, height; // in tiles
    int32_t *
        edges[RENDERER_RANK_ENDS]; // by rank: where areas begin (1) and end (-1), with a tile more in x and y
};

// From -1..1 to tiles.
static double tile_at(double place, uint32_t pixels) {
    return (place + 1) / 2 * pixels / TILE_SIDE;
}

static uint32_t clamp_tile(double tile, uint32_t count) {
    return tile > 0 ? tile < count ? (uint32_t)tile : count : 0;
}

// Where a point is seen, in half heights of the picture to the right and down, and half the width of its blur
// by the lens. false: it is not in front of the camera.
static bool see(const struct view_camera *camera, vec3 point, double at[2], double *blur) {
    const vec3 way = vec3_sub(point, camera->position);
    const double along = vec3_dot(way, camera->forward);
    const bool is_parallel = camera->projection == IR_PROJECTION_ORTHOGRAPHIC;
    const double height = is_parallel ? camera->half_height : along * camera->tan_half_fov;
    at[0] = vec3_dot(way, camera->right) / height;
    at[1] = -vec3_dot(way, camera->up) / height;
    *blur = camera->lens_radius > 0 ? camera->lens_radius * fabs(1 - along / camera->focus) / height : 0;
    return along > 0;
}

// An upper bound on what the picture shows of a box: all of the picture, if the box reaches behind the
// camera.
static struct area area_of(const struct renderer *renderer, const struct view_camera *camera,
                           const struct flat_bounce *body, const struct grid *grid) {
    const struct render_settings *settings = &renderer->settings;
    const struct render_size whole = renderer_whole(settings);
    const double aspect = (double)whole.width / whole.height;
    const double first_x = (double)settings->first_x / TILE_SIDE,
                 first_y = (double)settings->first_y / TILE_SIDE;
    double x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
    uint32_t before = 0;
    if (camera->projection == IR_PROJECTION_FISHEYE || camera->projection == IR_PROJECTION_PANORAMA)
        return (struct area){0, 0, grid->width, grid->height};
    for (int i = 0; i < 8; i++) {
        const vec3 corner = {i & 1 ? body->upper.x : body->lower.x, i & 2 ? body->upper.y : body->lower.y,
                             i & 4 ? body->upper.z : body->lower.z};
        double at[2], blur;
        if (!see(camera, corner, at, &blur))
            continue;
        before++;
        x0 = fmin(x0, tile_at((at[0] - blur) / aspect, whole.width) - first_x);
        x1 = fmax(x1, tile_at((at[0] + blur) / aspect, whole.width) - first_x);
        y0 = fmin(y0, tile_at(at[1] - blur, whole.height) - first_y);
        y1 = fmax(y1, tile_at(at[1] + blur, whole.height) - first_y);
    }
    if (before == 0)
        return (struct area){0};
    if (before < 8)
        return (struct area){0, 0, grid->width, grid->height};
    return (struct area){clamp_tile(floor(x0), grid->width), clamp_tile(floor(y0), grid->height),
                         clamp_tile(floor(x1) + 1, grid->width), clamp_tile(floor(y1) + 1, grid->height)};
}

static void add_area(const struct grid *grid, enum renderer_rank rank, struct area area) {
    const size_t row = grid->width + 1;
    int32_t *edges = grid->edges[rank];
    if (area.x0 >= area.x1 || area.y0 >= area.y1)
        return;
    edges[area.y0 * row + area.x0]++;
    edges[area.y0 * row + area.x1]--;
    edges[area.y1 * row + area.x0]--;
    edges[area.y1 * row + area.x1]++;
}

// Sums the edges above and to the left: the number of areas that a tile is in.
static void sum_edges(const struct grid *grid, int32_t *edges) {
    const size_t row = grid->width + 1;
    for (size_t y = 0; y <= grid->height; y++)
        for (size_t x = 1; x < row; x++)
            edges[y * row + x] += edges[y * row + x - 1];
    for (size_t at = row; at < row * (grid->height + 1); at++)
        edges[at] += edges[at - row];
}

static enum renderer_rank rank_of(const struct grid *grid, uint32_t tile) {
    const size_t at = (size_t)(tile / grid->width) * (grid->width + 1) + tile % grid->width;
    int rank = 0;
    while (rank < RENDERER_RANK_ENDS && grid->edges[rank][at] == 0)
        rank++;
    return (enum renderer_rank)rank;
}

// `begins`: the first tile of each rank, and the end.
static void sort_tiles(const struct grid *grid, uint32_t tiles, uint32_t *order, uint32_t *begins) {
    uint32_t next[RENDERER_RANKS + 1] = {0};
    for (uint32_t tile = 0; tile < tiles; tile++)
        next[rank_of(grid, tile) + 1]++;
    for (int rank = 1; rank <= RENDERER_RANKS; rank++)
        next[rank] += next[rank - 1];
    memcpy(begins, next, sizeof next);
    for (uint32_t tile = 0; tile < tiles; tile++)
        order[next[rank_of(grid, tile)]++] = tile % grid->width | tile / grid->width << 16;
}

bool renderer_sort_tiles(struct renderer *renderer, const struct view_camera *camera) {
    const uint32_t width = renderer->tiles_x, height = (renderer->tiles + width - 1) / width;
    const size_t words = heap_times((uint64_t)width + 1, (uint64_t)height + 1);
    int32_t *edges = heap_zeroed(heap_times(words, RENDERER_RANK_ENDS), sizeof *edges);
    if (!edges)
        return false;
    struct grid grid = {width, height, {edges, edges + words}};
    for (uint32_t i = 0; i < renderer->flat->bounce_count; i++) {
        const struct flat_bounce *body = &renderer->flat->bounces[i];
        add_area(&grid, body->refracts ? RENDERER_RANK_REFRACTS : RENDERER_RANK_REFLECTS,
                 area_of(renderer, camera, body, &grid));
    }
    for (int rank = 0; rank < RENDERER_RANK_ENDS; rank++)
        sum_edges(&grid, grid.edges[rank]);
    sort_tiles(&grid, renderer->tiles, renderer->order, renderer->rank_begins);
    free(edges);
    return true;
}

static bool same_view(const struct view_camera *a, const struct view_camera *b) {
    return memcmp(&a->position, &b->position, sizeof a->position) == 0 &&
           memcmp(&a->right, &b->right, sizeof a->right) == 0 && memcmp(&a->up, &b->up, sizeof a->up) == 0 &&
           memcmp(&a->forward, &b->forward, sizeof a->forward) == 0 && a->tan_half_fov == b->tan_half_fov &&
           a->projection == b->projection && a->half_height == b->half_height &&
           a->lens_radius == b->lens_radius && a->focus == b->focus;
}

bool renderer_order_tiles(struct renderer *renderer, const struct view_camera *camera) {
    const struct render_settings *settings = &renderer->settings;
    const bool same_place =
        renderer->ordered_x == settings->first_x && renderer->ordered_y == settings->first_y;
    if (renderer->samples_at_once == 0 ||
        (renderer->order && same_place && same_view(camera, &renderer->ordered)))
        return true;
    const size_t bytes = heap_times(renderer->tiles, sizeof *renderer->order);
    if (!renderer->order)
        renderer->order = heap_alloc(bytes);
    if (renderer->order && renderer_sort_tiles(renderer, camera) &&
        gpu_write(renderer->gpu, renderer->buffers[BINDING_ORDER], 0, renderer->order, bytes)) {
        renderer->ordered = *camera;
        renderer->ordered_x = settings->first_x;
        renderer->ordered_y = settings->first_y;
        return true;
    }
    free(renderer->order);
    renderer->order = NULL;
    return false;
}

uint32_t renderer_rank_begin(const struct renderer *renderer, const struct dispatch_block *block, int rank) {
    const uint32_t tile = renderer->rank_begins[rank], begin = block->tile_begin;
    const uint32_t tiles = tile < begin                       ? 0
                           : tile - begin < block->tile_count ? tile - begin
                                                              : block->tile_count;
    return tiles * TILE_PIXELS * (block->samples ? block->samples : 1);
}
