// How much work a dispatch gets. Nothing can end a dispatch from outside, so none may take long: whoever
// presses Ctrl-C waits for the running one. The cost of paths is learned from earlier ones. Portions take
// their runs of tiles from all over the picture, so a few paths are representative.
#include "tracer/render/render_private.h"

#include "core/clock.h"

#include <math.h>

enum {
    GRID_WIDTH_MAX = 65535, // what every device allows; more workgroups go to further rows
    FIRST_PATHS_CPU = 1024,
    FIRST_PATHS = 65536,  // a GPU is not busy with fewer
    SPREAD_MOST = 32,     // lanes of the largest subgroup
    SPREAD_MOST_CPU = 2,  // a processor is not idle; so that tests see it
    SPREAD_PATHS = 32768, // a GPU has room for this many at a time
    FOLLOW_PATHS = 65536, // the most paths that go on right after a pass
    FOLLOW_PATHS_CPU = 64,
    GROWTH_MOST = 4, // from one dispatch to the next: after a few cheap paths, others may cost more
};
static const double DISPATCH_SECONDS = 0.05;
// The part of a path's cost that is kept if the next ones cost less: neighbours are alike, and cheap ones may
// end soon.
static const double COST_KEPT = 0.75;

// Rows have equal length: empty workgroups at the end would all fall to one of a CPU's threads.
static uint32_t grid_width(uint32_t groups) {
    const uint32_t rows = (groups + GRID_WIDTH_MAX - 1) / GRID_WIDTH_MAX;
    return (groups + rows - 1) / rows;
}

static uint32_t paths_of(const struct renderer *renderer, const struct renderer_pace *pace, uint32_t left) {
    const uint32_t first = gpu_info(renderer->gpu)->kind == GPU_CPU ? FIRST_PATHS_CPU : FIRST_PATHS;
    uint32_t paths = pace->paths ? pace->paths : first;
    if (renderer->settings.dispatch_paths)
        paths = renderer->settings.dispatch_paths;
    // A much smaller remainder would keep only few threads busy.
    return left - left / 4 <= paths ? left : paths;
}

static void learn(struct renderer_pace *pace, uint32_t ran, uint32_t workgroup, double seconds) {
    // The first one may have waited for its kernel to be compiled.
    if (pace->paths == 0) {
        pace->paths = ran;
        return;
    }
    pace->seconds = fmax(seconds / ran, pace->seconds * COST_KEPT);
    const uint32_t most = ran < pace->paths ? pace->paths : GROWTH_MOST * ran; // fewer: the rest of a pass
    const double fits = pace->seconds > 0 ? DISPATCH_SECONDS / pace->seconds : most;
    const uint32_t paths = fits < most ? (uint32_t)fits : most;
    pace->paths = paths < workgroup ? workgroup : paths - paths % workgroup;
}

// Few long paths leave a GPU idle anyway: so each path gets more of it for itself, because the lanes of a
// subgroup wait for each other wherever their rays differ.
static uint32_t spread_of(const struct gpu *gpu, uint32_t paths) {
    const uint32_t most = gpu_info(gpu)->kind == GPU_CPU ? SPREAD_MOST_CPU : SPREAD_MOST;
    uint32_t spread = 1;
    while (spread < most && paths <= SPREAD_PATHS / 2 / spread)
        spread *= 2;
    return spread;
}

// Runs paths [begin, end) in a program, a spread apart; another dispatch may follow at once.
static bool dispatch(struct gpu *gpu, struct gpu_program *program, uint32_t workgroup,
                     struct dispatch_block *block, uint32_t begin, uint32_t end, bool is_last) {
    const uint32_t groups = ((end - begin) * (block->spread ? block->spread : 1) + workgroup - 1) / workgroup;
    block->path_begin = begin;
    block->path_end = end;
    block->grid_width = grid_width(groups);
    const uint32_t height = (groups + block->grid_width - 1) / block->grid_width;
    return (is_last ? gpu_dispatch : gpu_dispatch_beside)(gpu, program, block->grid_width, height, block);
}

static uint32_t clamp(uint32_t value, uint32_t least, uint32_t most) {
    return value < least ? least : value < most ? value : most;
}

// Starts paths: the long ones, spread, and beside them the others.
static bool dispatch_ranks(struct renderer_frame *run, struct gpu_program *program, uint32_t workgroup,
                           struct dispatch_block *block, uint32_t end) {
    const uint32_t begin = block->path_begin;
    const uint32_t middle =
        clamp(renderer_rank_begin(run->renderer, block, RENDERER_RANK_REFRACTS + 1), begin, end);
    struct gpu *gpu = run->renderer->gpu;
    block->spread = spread_of(gpu, middle - begin);
    // One dispatch, if nothing must be spread.
    const uint32_t next = block->spread > 1 ? middle : begin;
    const bool first = begin == next || dispatch(gpu, program, workgroup, block, begin, next, next == end);
    block->spread = 1;
    const bool done = first && (next == end || dispatch(gpu, program, workgroup, block, next, end, true));
    block->path_begin = begin;
    return done;
}

// Runs the paths that a pass has saved, as soon as it has ended. Their number is not known when this is
// recorded.
static bool dispatch_saved(struct renderer_frame *run, uint32_t workgroup,
                           const struct dispatch_block *block) {
    struct gpu *gpu = run->renderer->gpu;
    const bool is_cpu = gpu_info(gpu)->kind == GPU_CPU;
    struct dispatch_block saved = *block;
    run->follow = is_cpu ? FOLLOW_PATHS_CPU : FOLLOW_PATHS;
    saved.resume = RESUME_COUNTED;
    saved.read_list = 1 - block->read_list;
    saved.read_base = block->pending_base;
    saved.pending_base = run->renderer->pending[block->read_list];
    saved.path_begin = 0;
    saved.path_end = run->follow;
    const uint32_t groups = (run->follow + workgroup - 1) / workgroup;
    saved.grid_width = grid_width(groups);
    saved.spread = is_cpu ? SPREAD_MOST_CPU : SPREAD_MOST;
    return gpu_dispatch(gpu, run->whole, saved.grid_width, (groups + saved.grid_width - 1) / saved.grid_width,
                        &saved);
}

static bool dispatch_one(struct renderer_frame *run, struct gpu *gpu, struct gpu_program *program,
                         uint32_t workgroup, struct dispatch_block *block, uint32_t end) {
    block->spread = run ? spread_of(gpu, end - block->path_begin) : 1;
    return dispatch(gpu, program, workgroup, block, block->path_begin, end, true);
}

bool renderer_run_paths(struct renderer *renderer, struct gpu_program *program, enum renderer_pass pass,
                        uint32_t workgroup, struct dispatch_block *block, uint32_t end,
                        struct renderer_frame *run, double *seconds) {
    struct renderer_pace *pace = &renderer->paces[pass];
    const uint32_t fit = paths_of(renderer, pace, end - block->path_begin);
    const uint32_t paths = program == renderer->counting && fit > COUNTED_PATHS ? COUNTED_PATHS : fit;
    const uint32_t to = block->path_begin + paths;
    const bool by_rank = run && pass == RENDERER_BEGINS && !block->restarts;
    const double start = clock_seconds();
    if (!(by_rank ? dispatch_ranks(run, program, workgroup, block, to)
                  : dispatch_one(run, renderer->gpu, program, workgroup, block, to)) ||
        (by_rank && run->whole && to == end && !dispatch_saved(run, workgroup, block)) ||
        (run && !renderer_follow_pass(run, block->path_end == end)) || !gpu_submit(renderer->gpu) ||
        !gpu_wait(renderer->gpu, seconds))
        return false;
    learn(pace, paths, workgroup, clock_seconds() - start);
    return true;
}
