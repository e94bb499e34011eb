// Measures the rows of a study: on the device, with the reference, and one against the other. Private to
// measure/tradeoff.
//
// Input: a row's setting. Output: its work, times, errors, hits and pictures. Ownership: tradeoff_run makes
// and frees struct measuring; device_close and parts_close free what those files made. Errors: TRADEOFF_DONE
// or what went wrong. Thread safety: as tradeoff.h.
#ifndef GLINT_MEASURE_TRADEOFF_MEASURE_MEASURE_H
#define GLINT_MEASURE_TRADEOFF_MEASURE_MEASURE_H

#include "grammar/ir.h"
#include "measure/tradeoff/study/study.h"
#include "picture/write/image.h"
#include "reference/cache.h"
#include "scene/hits.h"
#include "tracer/flatten/flatten.h"
#include "tracer/render/render.h"

enum {
    TIMES_ROUNDS_MOST = 9,
    PROBE_PIXELS = 2048, // at which the parts of the errors are measured
    PROBE_SETS_MAX = 256,
    THUMBNAIL_WIDTH = 160,
};

// Share of the budget after which no more rows are started.
#define MEASURE_ROWS_SHARE 0.7

// What the reference shows at the probes, displayed.
struct probe_set {
    uint32_t width, height, samples, first_sample, max_depth;
    double min_weight;
    uint32_t without;
    bool shadows, full;    // full: paths to their ends, whatever depth and weight
    const uint32_t *taken; // samples of each of the row's pixels, which are points of `samples`; NULL: all
    uint32_t min_samples;  // with these
    float *values;         // three per probe
};

// The scene with parts of it left out, for the reference: the last one requested.
struct measure_variant {
    bool is_made, shadows;
    uint32_t without;
    struct ir_scene ir;
    struct scene scene;
    struct view view;
    struct reference_source source;
};

// The pictures of a search.
struct search_pictures {
    // For a small picture with a few samples that no row has, linear: the reference's, whose paths go to
    // their ends, and the device's with the settings tried last.
    uint32_t probe_width, probe_height, probe_samples;
    float *full, *tried;
    struct setting tried_setting;
    float *bias, *smooth; // of the file's size: what the reference has beyond those, and that spread over
                          // neighbours
    double change;        // what more rays of the reference might change, mean of the pixels
    // The samples from 0 on of the setting whose row was tried last, as sums: all but those added last, and
    // those added last.
    double *older, *newer;
    uint32_t older_samples, newer_samples;
    struct setting row_setting;
    uint64_t row_not_finite;
    double row_seconds; // on the device's clock
    float *best;        // displayed: the last row of the file's size, with the bias
    double *rgb;        // the reference's
    double *column;     // of a picture
    uint32_t deepest;   // level that the file's rays reach
    bool is_cut;        // the file's settings cut rays
};

struct measuring {
    const struct tradeoff_input *input;
    const struct tradeoff_progress *progress;
    struct tradeoff *out;
    double begun;         // clock
    double round_seconds; // that a round of timing the rows takes, estimated from their pictures
    double deadline;      // clock; the device's rays end there, and `late` is set. 0: none
    bool late;
    uint32_t steps_done, steps;
    const char *step; // the current step
    // On the device: single and double precision.
    struct flat_scene flat[2], shadowless[2]; // the latter share the former's memory
    struct renderer *renderer[2];
    struct setting current[2]; // what the renderer is set to
    uint32_t current_first[2]; // and its first sample
    // The reference, and the same without shadows.
    struct ir_scene ir_shadowless;
    struct scene scene_shadowless; // over that IR
    struct reference_source source[2];
    struct measure_variant variant;
    struct reference_settings full; // of the file's size, ground truth's samples and rays
    double ground_truth_rays;       // that a sample of the ground truth takes, on average
    double reference_rate;          // rays per second of the ground truth
    // Displayed values of the ground truth, three per pixel of the file's size.
    float *ground_truth, *shown, *picture; // the two others are a row's, shown at the file's size
    struct image_display display;
    struct setting base;
    uint32_t *taken;           // samples of a row's pixels, if they end by their error
    struct hit_pixel *hits[2]; // device's, reference's
    float *as_file;            // the reference at the file's own settings, displayed; NULL until asked
    bool only_probes;          // the budget does not allow as_file
    bool no_hits;              // nor does it allow hits
    struct probe_set sets[PROBE_SETS_MAX];
    uint32_t set_count;
    struct search_pictures search;
};

// ---- measure.c

// Since the study began.
double measuring_seconds(const struct measuring *s);
// Reports how many steps are done; false: cancelled.
bool measuring_report(struct measuring *s, double steps);
// Reports one more step; false: cancelled.
bool measuring_step(struct measuring *s, const char *what);
// Whether the deadline has passed; then s->late is set, and the current work ends as if it were cancelled.
bool measuring_is_late(struct measuring *s);
// Passes the reference's progress on.
struct reference_progress measuring_reference_progress(struct measuring *s);
// The settings of the reference for the truth: paths to their ends. If light grows from bounce to bounce
// paths have no end, and max_depth is a part of the picture.
struct reference_settings measuring_all_paths(const struct measuring *s, const struct ir_image *image);
enum tradeoff_status measuring_reference_status(enum reference_result result);
// Whether the row traces the file's own rays, and differs at most in how they are computed.
bool measuring_traces_as_file(const struct row *row);

// ---- measure_device.c

// Flattens the scene in the file's precision, before anything is traced.
enum tradeoff_status device_open(struct measuring *s);
// The mean of some samples of a setting, in s->picture. *not_finite (which may be NULL) is raised to the
// number of NaN pixels if that is larger.
enum tradeoff_status device_samples(struct measuring *s, const struct setting *setting, uint32_t first,
                                    uint32_t count, double *seconds, uint64_t *not_finite);
// Fills not_finite.
enum tradeoff_status device_picture(struct measuring *s, struct row *row, float *rgb);
// Fills work.
enum tradeoff_status device_count(struct measuring *s, struct row *row);
// Brings an idle GPU up to its clock, before the first device_time.
enum tradeoff_status device_wake(struct measuring *s);
// Median of some frames, in milliseconds of the device's clock.
enum tradeoff_status device_time(struct measuring *s, const struct setting *setting, double *ms);
enum tradeoff_status device_hits(struct measuring *s, const struct setting *setting, struct hit_pixel *hits);
void device_close(struct measuring *s);

// ---- measure_without.c

// The parts among KNOBS_WITHOUT that a scene with these features and this camera has.
uint32_t without_parts(uint64_t features, const struct view_camera *camera);
// The features that go with the omitted parts.
uint64_t without_features(uint32_t without, const struct view_camera *camera);
// The reference of the scene without those parts; owned by the measuring, valid until the next call. NULL: no
// memory.
struct reference_source *without_source(struct measuring *s, bool shadows, uint32_t without);
void without_close(struct measuring *s);

// ---- measure_ground_truth.c

// The reference's picture of the file's size, displayed. `statistics` may be NULL.
enum tradeoff_status ground_truth_picture(struct measuring *s, const struct reference_settings *settings,
                                          float *shown, struct reference_statistics *statistics);
// Fills `full` and the ground truth, as far as the budget allows. `own`: of the file's settings; bounces:
// something reflects or refracts.
enum tradeoff_status ground_truth_make(struct measuring *s, const struct work *own, bool bounces);
// Whether the reference may trace this many more rays before the time for rows is over.
bool ground_truth_affords(const struct measuring *s, double rays);

// ---- measure_errors.c

// Fills value, not_finite and the thumbnails from the row's picture.
enum tradeoff_status errors_measure(struct measuring *s, struct row *row);

// ---- measure_parts.c

// Fills parts. Requires s->shown as errors_measure leaves it.
enum tradeoff_status parts_measure(struct measuring *s, struct row *row);
void parts_close(struct measuring *s);

// ---- measure_hits.c

// Fills hits.
enum tradeoff_status hits_measure(struct measuring *s, struct row *row);

// ---- measure_search.c

// Allocates, and finds out how far the ground truth may go.
enum tradeoff_status search_begin(struct measuring *s);
// Fills value, times, rounding and not_finite of a row, whose samples are compared with each other; for a
// probe, change and floor.
enum tradeoff_status search_row(struct measuring *s, struct row *row);
void search_close(struct measuring *s);

// ---- measure_times.c

// Fills the times of all rows: every round times every row once.
enum tradeoff_status times_measure(struct measuring *s);

#endif
