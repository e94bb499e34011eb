// A sweep: random scenes (sweep_scene.h) traced in single and in double precision on a device and by the
// reference, and whether the precision that `auto` chose for each was the right one.
//
// The caller reads each scene from its text (a room above this one does) and hands it to sweep_judge.
// Ownership: sweep_finish frees the items. Errors: a status; device errors are in gpu_error. Thread safety:
// the gpu's thread.
#ifndef GLINT_TESTS_SWEEP_SWEEP_H
#define GLINT_TESTS_SWEEP_SWEEP_H

#include "core/limits.h"
#include "core/strbuf.h"
#include "tests/sweep/sweep_scene.h"
#include "tracer/gpu/gpu.h"

struct scene;

// A picture is wrong where more than this share of its pixels is off by more than SWEEP_OFF in a displayed
// channel, or where a closed body shows the background.
#define SWEEP_SHARE 0.001
#define SWEEP_OFF   (1.0 / 255)

enum sweep_tracer {
    SWEEP_SINGLE,
    SWEEP_DOUBLE,
    SWEEP_REFERENCE,
    SWEEP_TRACERS,
};

enum sweep_verdict {
    SWEEP_RIGHT,
    SWEEP_WRONG,    // single precision was chosen, is wrong, and double is not
    SWEEP_NEEDLESS, // double precision was chosen, and single would have been right
    SWEEP_BEYOND,   // double precision is wrong too
    SWEEP_VERDICTS,
};
extern const char *const sweep_verdict_names[SWEEP_VERDICTS];

struct sweep_picture {
    double
        off; // share of pixels with a displayed channel off by more than 1/255, compared with the reference
    uint32_t background; // pixels that show the background through something closed
    bool wrong;
};

struct sweep_item {
    enum sweep_family family;
    uint32_t number;
    bool is_double;   // what `auto` chose
    double trial_off; // share of the pixels that the choice found to differ
    double steps;     // of the feature that decides (tracer/flatten/precision.h); infinite: there is none
    struct sweep_picture pictures[SWEEP_TRACERS];
    enum sweep_verdict verdict;
    double seconds;
};

struct sweep_input {
    struct gpu *gpu; // must have doubles
    const struct limits *limits;
    uint32_t width, height; // of the pictures
    uint64_t families;      // bit 1 << family: those wanted
    uint32_t count;         // of scenes, all families together
    uint64_t seed;
};

struct sweep {
    struct sweep_item *items; // in the order in which they were made; `count` of them
    uint32_t count;
    uint32_t verdicts[SWEEP_VERDICTS];
    uint32_t doubles; // scenes for which double was chosen
    char device[256];
    double seconds;
};

enum sweep_status {
    SWEEP_DONE,
    SWEEP_DEVICE, // see gpu_error
    SWEEP_MEMORY,
    SWEEP_COORDINATES, // the scene's coordinates exceed what can be traced
};

// false: no memory.
bool sweep_init(struct sweep *sweep, const struct sweep_input *input);
void sweep_finish(struct sweep *sweep); // a zeroed one is fine
// Which scene is made as number `index` of the run: families take turns.
void sweep_which(const struct sweep_input *input, uint32_t index, enum sweep_family *family,
                 uint32_t *number);
// Judges a scene that was read from `made` and adds it to the sweep.
enum sweep_status sweep_judge(struct sweep *sweep, const struct sweep_input *input,
                              const struct sweep_scene *made, const struct scene *scene);
// Share of the doubles that were not needed; 0 where there is none.
double sweep_needless(const struct sweep *sweep);

// ---- reports

struct sweep_report {
    const struct sweep *sweep;
    const struct sweep_input *input;
    uint32_t max_wrong;  // bounds
    double max_needless; // of sweep_needless
    bool all;            // the text lists all scenes; else those that sweep_is_noted names
};
// Whether a scene is not right, or the reference itself sees the background through something closed.
bool sweep_is_noted(const struct sweep_item *item);
bool sweep_is_broken(const struct sweep_report *report);
void sweep_text(const struct sweep_report *report, struct strbuf *out);

#endif
