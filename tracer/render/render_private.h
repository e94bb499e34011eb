// Internal to the renderer: what the files render*.c share. Thread safety: as render.h.
#ifndef GLINT_TRACER_RENDER_RENDER_PRIVATE_H
#define GLINT_TRACER_RENDER_RENDER_PRIVATE_H

#include "shaders/features.h"
#include "shaders/frame.h"
#include "shaders/gpu_scene.h"
#include "shaders/records.h"
#include "tracer/render/render.h"

#define VECTOR_FIELD(name) float name[3];
#define FLOAT_FIELD(name)  float name;
#define UINT_FIELD(name)   uint32_t name;
#define DOUBLE_FIELD(name) double name;
struct frame_block {
    FRAME_FIELDS(VECTOR_FIELD, FLOAT_FIELD, UINT_FIELD)
    FRAME_DOUBLE_FIELDS(DOUBLE_FIELD)
};
struct dispatch_block {
    DISPATCH_FIELDS(FLOAT_FIELD, UINT_FIELD)
};
#undef VECTOR_FIELD
#undef FLOAT_FIELD
#undef UINT_FIELD
#undef DOUBLE_FIELD

// Offsets of the samples that are traced at once; two fill 16 bytes.
struct samples_block {
    float offsets[SAMPLES_AT_ONCE][2];
};

struct renderer_hits;
struct renderer_log;

// A kernel that was compiled, for the settings that it depends on.
struct renderer_kept {
    uint64_t features;
    uint32_t workgroup;
    uint32_t branches; // in private memory; 0: samples are not traced at once
    bool is_listed;    // paths begin by a list
    bool is_part;      // of a larger picture
    enum render_alternative alternative;
    struct gpu_program *program; // NULL: none
};
enum {
    RENDERER_KEPT = 16
};

// What tiles show, in the order in which their paths are started.
enum renderer_rank {
    RENDERER_RANK_REFRACTS,
    RENDERER_RANK_REFLECTS,
    RENDERER_RANK_ENDS, // paths end at what they hit first
    RENDERER_RANKS,
};

// How many paths a dispatch may take so that it ends soon, and a signal is noticed (render_pace.c).
struct renderer_pace {
    uint32_t paths; // of the next dispatch; 0: nothing is known yet
    double seconds; // of a path
};
enum renderer_pass {
    RENDERER_BEGINS,  // paths from the camera
    RENDERER_RESUMES, // saved ones
    RENDERER_REPORTS, // first hits
    RENDERER_PASSES,
};

// Of the picture that the camera sees.
struct render_size {
    uint32_t width, height;
};
static inline bool renderer_is_part(const struct render_settings *settings) {
    return settings->whole_width != 0;
}
static inline struct render_size renderer_whole(const struct render_settings *settings) {
    return renderer_is_part(settings) ? (struct render_size){settings->whole_width, settings->whole_height}
                                      : (struct render_size){settings->width, settings->height};
}

struct renderer {
    struct gpu *gpu;
    const struct flat_scene *flat; // not owned
    struct render_settings settings;
    uint64_t features;        // of the scene, FEATURE_SLICES and FEATURE_LONG_RAYS
    bool has_long_rays;       // one was found
    uint32_t path_stack;      // entries
    uint32_t samples_at_once; // 0: a dispatch traces one sample, and paths are in the state buffer
    uint32_t places;          // for saved paths
    struct gpu_buffer *picture,
        *counters; // if samples are traced at once: the copy in this process
    struct gpu_program *resolve;
    uint32_t *order; // there too: as in the buffer BINDING_ORDER, for the camera `ordered`; NULL: none yet
    struct view_camera ordered;
    uint32_t ordered_x, ordered_y;            // and its first_x and first_y
    uint32_t rank_begins[RENDERER_RANKS + 1]; // of that order: the first tile of each rank, and the end
    uint32_t tiles_x, tiles;                  // whole runs: some tiles may lie below the picture
    uint32_t run_tiles, runs, run_step;
    uint32_t portion_tiles; // in a portion; the last one may have fewer
    struct gpu_buffer *buffers[GPU_BINDINGS];
    uint32_t triangle_depth, sphere_depth; // levels that kernels have stacks for
    struct gpu_program *program;           // one of those kept; NULL: none was needed yet
    struct gpu_program *counting;          // the same, with counters
    struct gpu_program *begins;            // most of it, for paths that begin
    bool has_drawn;                        // a frame with these settings
    struct renderer_kept kept[RENDERER_KEPT];
    uint32_t kept_next;         // which one is replaced next
    uint32_t *portion;          // the portion's output, read back: 4 words per slot
    struct renderer_hits *hits; // made by the first renderer_hits
    struct renderer_log *log;   // made by the first renderer_log
    uint32_t pending[2];        // values of COUNTER_PENDING after the last dispatch, by list
    uint32_t taken, restarts;   // and of COUNTER_PLACES and COUNTER_RESTARTS
    struct renderer_pace paces[RENDERER_PASSES];
    struct render_estimate estimate; // of an adaptive frame; its arrays NULL: there was none
};

// The arrays of a flat scene on the device, and where they are.
enum {
    RENDERER_ARRAYS = 10
};
struct renderer_array {
    uint32_t binding;
    const struct flat_array *array;
};
// Returns how many arrays it has.
uint32_t renderer_arrays(const struct flat_scene *flat, struct renderer_array out[RENDERER_ARRAYS]);
// Makes the array's buffer and fills it: after the paints with the texels of the renderer's flat scene.
bool renderer_upload_array(struct renderer *renderer, const struct renderer_array *array);
bool renderer_make_background(struct renderer *renderer);
// Destroys all kernels, and what depends on the settings: renderer_change must follow.
void renderer_forget_kernels(struct renderer *renderer);

// A kernel over the renderer's scene and trees, as its settings want it; `output` and `state` replace the
// portion's unless NULL.
enum renderer_kernel {
    RENDERER_TRACE,
    RENDERER_HITS,
    RENDERER_LOG,
    RENDERER_RESOLVE,
    RENDERER_KERNELS,
};
struct gpu_program *renderer_compile_kernel(struct renderer *renderer, enum renderer_kernel kernel,
                                            uint64_t features, struct gpu_buffer *output,
                                            struct gpu_buffer *state);
// Whether the numbers of a group of nodes fit into one word.
bool renderer_packs_groups(const struct flat_scene *flat);
// The tracing kernel, compiled now or before, over the portion's buffers. NULL: see gpu_error.
struct gpu_program *renderer_program(struct renderer *renderer, bool counts);
// Whether it pays to begin paths in a kernel with only what most of them need; and whether they do begin
// there.
bool renderer_pays_apart(const struct renderer *renderer);
bool renderer_begins_apart(const struct renderer *renderer);
// The kernel in which the paths of a frame begin; those that it saves go on in the tracing kernel.
struct gpu_program *renderer_first_program(struct renderer *renderer, bool counts);
// A number that a kernel wrote in its own precision (shaders/bits.glsl).
double renderer_real(const struct renderer *renderer, uint32_t low, uint32_t high);
// The frame's uniforms for a camera.
bool renderer_write_frame(struct renderer *renderer, const struct view_camera *camera);
// What one frame works on.
struct renderer_frame {
    struct renderer *renderer;
    struct gpu_program *program; // in which paths begin
    // If samples are traced at once and `program` lacks a part: the tracing kernel, in which paths saved by a
    // pass go on. Else NULL.
    struct gpu_program *whole;
    uint32_t follow; // at most how many of them went on right after the last dispatch
    const struct render_progress *progress;
    struct render_statistics *statistics;
    uint64_t steps_done, steps; // a portion's sample is a step
    bool met_long_ray;          // the frame was given up: renderer_take_long_rays, and restart
    bool counting;
    uint32_t counters[COUNTER_COUNT]; // after the last dispatch; those in banks only if it counts
    uint64_t counts[COUNTER_KINDS];   // of all banks and dispatches
    // NULL: all samples are made, portion by portion.
    const struct render_limit *limit;
    uint32_t samples_done; // under a limit: the number that all pixels have
    bool is_over;          // the limit ended the current sample
    // Where samples are traced at once and the last ones of a portion are under way: what follows each pass.
    bool shows, shows_all; // the portion's pixels go into the picture; and all pixels to this process
    struct dispatch_block resolve;
};
// One sample of one portion: all its paths to their ends.
enum render_result renderer_draw_sample(struct renderer_frame *run, uint32_t tile_begin, uint32_t tile_count,
                                        uint32_t sample);
// One sample of those pixels of a portion whose slots are in the list: `listed` of them. `before`: how many
// samples the output holds, to which it is added; 0: it replaces the output.
enum render_result renderer_draw_listed(struct renderer_frame *run, uint32_t tile_begin, uint32_t tile_count,
                                        uint32_t sample, uint32_t before, uint32_t listed);
// Samples of a portion, from `first` on: `count` of them at once, or one that is added to the output.
enum render_result renderer_draw_paths(struct renderer_frame *run, struct dispatch_block *block);
// Whether pixels end when their error is small enough.
static inline bool renderer_is_adaptive(const struct renderer *renderer) {
    return renderer->settings.error > 0;
}
// Draws the frame if they do (render_adaptive.c).
enum render_result renderer_draw_adaptive(struct renderer_frame *run, float *rgb);
// Draws the frame if samples are traced at once (render_at_once.c).
enum render_result renderer_draw_at_once(struct renderer_frame *run, float *rgb);
// Reports the frame's progress, with a part of the current step; false: it must end.
bool renderer_is_wanted(const struct renderer_frame *run, double part);
// The offsets of samples that are traced at once. false: see gpu_error.
bool renderer_write_samples(struct renderer *renderer, uint32_t first, uint32_t count);
// Records the resolving of samples, in a mode of shaders/frame.h; clears the faults that it counts, and
// copies the counters to this process.
bool renderer_resolve(struct renderer_frame *run, uint32_t mode);
bool renderer_clear_faults(struct renderer *renderer);
bool renderer_copy_counters(struct renderer_frame *run);
// Records what follows a pass of such a frame, at the end of it.
bool renderer_follow_pass(struct renderer_frame *run, bool ends);
// In which order tiles are traced at once, for a camera. false: see gpu_error.
bool renderer_order_tiles(struct renderer *renderer, const struct view_camera *camera);
// Fills renderer->order and rank_begins; needs no device. false: no memory.
bool renderer_sort_tiles(struct renderer *renderer, const struct view_camera *camera);
// Their buffers, where there are any, and the kernel that resolves them. false: see gpu_error.
bool renderer_make_at_once(struct renderer *renderer);
void renderer_drop_at_once(struct renderer *renderer);
// A portion's sums, as the kernel leaves them at its end: 4 words per slot, valid until the next dispatch. If
// this process can read them in place they are not copied. NULL: see gpu_error.
const uint32_t *renderer_sums(const struct renderer *renderer, uint32_t tile_count);
// Copies these sums to their pixels of the picture. Returns whether some have faults.
bool renderer_unpack(const struct renderer *renderer, uint32_t tile_begin, uint32_t tile_count,
                     const uint32_t *sums, uint32_t samples, float *rgb);
// Adds the faults of a portion's sums to the statistics.
void renderer_note_faults(const struct renderer *renderer, uint32_t tile_begin, uint32_t tile_count,
                          const uint32_t *sums, struct render_statistics *statistics);
// The frame under its limit, sample by sample over all portions (render_until.c).
enum render_result renderer_draw_until(struct renderer_frame *run, const struct view_camera *camera,
                                       float *rgb);
// Before the first sample: counts of steps, and the uniforms for a camera.
bool renderer_begin_frame(struct renderer_frame *run, const struct view_camera *camera);
// Adds to the statistics, which the caller has cleared. `rgb` NULL: no picture.
enum render_result renderer_draw_frame(struct renderer_frame *run, const struct view_camera *camera,
                                       float *rgb);
// The most refracted rays that wait in a path at the same time; `by_weight`: with the weights of the scene's
// materials and the least weight of the settings, else whatever they are (render_waiting.c).
uint32_t renderer_most_waiting(const struct renderer *renderer, bool by_weight);
// Entries of the deeper tree's stack.
uint32_t renderer_stack_levels(const struct renderer *renderer);
// Switches to kernels that can save a ray in the middle of a tree. false: see gpu_error.
bool renderer_take_long_rays(struct renderer *renderer);
// The first path of a rank among a portion's paths, in the order in which they begin; for RENDERER_RANKS:
// their end.
uint32_t renderer_rank_begin(const struct renderer *renderer, const struct dispatch_block *block, int rank);
// Runs paths from block->path_begin on and sets block->path_end and grid_width: at most to `end`, and no more
// than should finish in a twentieth of a second, judging by earlier dispatches of this kind. Waits for them;
// *seconds is the device's time. `workgroup` is the program's. `run`, unless NULL, follows the dispatch from
// before it is submitted: renderer_follow_pass.
bool renderer_run_paths(struct renderer *renderer, struct gpu_program *program, enum renderer_pass pass,
                        uint32_t workgroup, struct dispatch_block *block, uint32_t end,
                        struct renderer_frame *run, double *seconds);
// The body in IR order, and its triangle in file order, for a number as in FAULT_NUMBER.
void renderer_number(const struct renderer *renderer, uint32_t number, uint32_t *body, uint32_t *triangle);
void renderer_hits_destroy(struct renderer *renderer); // what renderer_hits made
void renderer_log_destroy(struct renderer *renderer);  // what renderer_log made
// Adds a fault, whose word is as in shaders/frame.h, to those of its kind.
void renderer_note_fault(const struct renderer *renderer, uint32_t word, uint32_t pixels, uint32_t x,
                         uint32_t y, struct render_fault *fault);
bool renderer_pixel(const struct renderer *renderer, uint32_t tile_begin, uint32_t slot, uint32_t *x,
                    uint32_t *y);

#endif
