#include "render/audit.h"

#include "core/clock.h"
#include "core/parallel.h"
#include "grammar/ir.h"
#include "measure/share.h"
#include "reference/reference.h"
#include "scene/spread.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

enum {
    CELLS = 3700,       // of the first look: if none is off, at most 0.1 % of the picture is
    MORE_CELLS = 5000,  // of the second; each after it takes as many as all before
    LOOKS = 2,          // unless it has to be decided
    PIECE = 16,         // pixels
    CHUNK = 64 * PIECE, // pixels between two reports of the progress
};

// ---- tracing them again

struct work {
    const struct reference *reference;
    struct reference_settings settings;
    const struct image *image;
    const uint32_t *samples; // NULL: all pixels have those of the settings
    struct image_display display;
    struct spread grid;
    uint32_t first; // cell of the chunk
    atomic_uint off, first_off;
    atomic_bool failed;
};

bool audit_is_off(const float rgb[3], const double reference[3], struct image_display display) {
    float linear[6], shown[6];
    for (int k = 0; k < 3; k++) {
        linear[k] = rgb[k];
        linear[k + 3] = (float)reference[k];
    }
    image_to_displayed(linear, 2, display, shown);
    bool off = image_is_marked(rgb) || image_is_marked(linear + 3);
    for (int k = 0; k < 3; k++)
        off = off || fabs((double)shown[k] - (double)shown[k + 3]) > AUDIT_THRESHOLD;
    return off;
}

static void note_off(struct work *w, uint32_t place) {
    atomic_fetch_add(&w->off, 1);
    unsigned first = atomic_load(&w->first_off);
    while (place < first && !atomic_compare_exchange_weak(&w->first_off, &first, place))
        ;
}

static void trace_piece(void *context, size_t begin, size_t end) {
    struct work *w = context;
    for (size_t i = begin; i < end; i++) {
        uint32_t x, y;
        double reference[3];
        spread_pixel(&w->grid, w->first + (uint32_t)i, &x, &y);
        const size_t place = (size_t)y * w->image->width + x;
        struct reference_settings settings = w->settings;
        settings.samples = w->samples ? w->samples[place] : settings.samples;
        if (!reference_pixel(w->reference, &settings, x, y, reference))
            atomic_store(&w->failed, true);
        else if (audit_is_off(w->image->rgb + 3 * place, reference, w->display))
            note_off(w, (uint32_t)place);
    }
}

// Whether a picture has no more than about twice as many pixels: then all of them are traced, which is exact.
static bool is_small(const struct image *image, uint64_t pixels) {
    return (uint64_t)image->width * image->height <= 2 * pixels;
}

static void begin_look(struct work *w, uint32_t cells, struct audit *out) {
    const struct image *image = w->image;
    const uint64_t seen = (uint64_t)out->pixels + cells;
    const bool all = is_small(image, seen);
    w->grid = spread_make(image->width, image->height, all ? image->width * image->height : cells);
    out->whole = all;
    if (all) { // each pixel counts once
        out->pixels = 0;
        atomic_store(&w->off, 0);
    }
}

// One look: a pixel of each cell.
static enum shot_status look(struct work *w, uint32_t cells, const struct render_progress *progress,
                             struct audit *out) {
    begin_look(w, cells, out);
    const uint32_t count = w->grid.columns * w->grid.lines;
    for (w->first = 0; w->first < count; w->first += CHUNK) {
        const uint32_t left = count - w->first;
        parallel_for(left < CHUNK ? left : CHUNK, PIECE, trace_piece, w);
        if (progress && progress->report && !progress->report(progress->context, (double)w->first / count))
            return SHOT_CANCELLED;
    }
    out->pixels += count;
    out->off = atomic_load(&w->off);
    return SHOT_OK;
}

// All looks together may err in one of 20 pictures: the first gets half of that risk, each further one half
// of the risk of the one before. Bounds of earlier looks still hold.
static void conclude(struct audit *out, double risk) {
    const double share = (double)out->off / out->pixels;
    out->bound = out->whole ? share : fmin(out->bound, share_bound(out->off, out->pixels, risk));
    out->floor = out->whole ? share : fmax(out->floor, share_floor(out->off, out->pixels, risk));
}

static bool is_decided(const struct audit *audit, double share) {
    return audit->whole || audit->bound <= share || audit->floor > share;
}

static enum shot_status take_looks(struct work *w, const struct audit_wish *wish,
                                   const struct render_progress *progress, struct audit *out) {
    double risk = 1 - AUDIT_CONFIDENCE;
    for (uint32_t looks = 0; looks < LOOKS || wish->decides; looks++) {
        const uint32_t cells = looks == 0 ? CELLS : looks == 1 ? MORE_CELLS : out->pixels;
        const enum shot_status status = look(w, cells, progress, out);
        if (status != SHOT_OK || atomic_load(&w->failed))
            return status;
        risk *= 0.5;
        conclude(out, risk);
        if (is_decided(out, wish->share))
            break;
    }
    return SHOT_OK;
}

enum shot_status audit_take(struct session *session, const struct view *view, const struct image *image,
                            const struct audit_wish *wish, const struct render_progress *progress,
                            struct audit *out) {
    const double start = clock_seconds();
    const struct reference_input input = {
        .scene = &session->resolved, .view = view, .few_rays = true, .no_bound = true};
    struct reference *made = wish->reference ? NULL : reference_create(&input);
    struct work work = {.reference = wish->reference ? wish->reference : made,
                        .image = image,
                        .samples = wish->samples,
                        .display = image_display_of(session->image),
                        .first_off = UINT32_MAX};
    work.settings = reference_settings_of(session->scene, session->image, &session->options.limits, true);
    work.settings.planned = wish->planned;
    *out = (struct audit){.bound = 1};
    enum shot_status status = work.reference ? take_looks(&work, wish, progress, out) : SHOT_SCENE;
    if (!work.reference || atomic_load(&work.failed))
        status = shot_no_memory(session, "the audit");
    const uint32_t first = out->off ? atomic_load(&work.first_off) : 0;
    out->x = first % image->width;
    out->y = first / image->width;
    reference_destroy(made);
    out->seconds = clock_seconds() - start;
    return status;
}

// ---- what it says

void audit_words(const struct audit *audit, struct strbuf *out) {
    if (audit->whole)
        strbuf_format(out,
                      "%.3g %% of the pixels are off by more than 1/255: %u of all %u, traced again in "
                      "double precision",
                      100 * audit->bound, audit->off, audit->pixels);
    else
        strbuf_format(
            out,
            "at most %.3g %% of the pixels are off by more than 1/255 (%g %% sure): %u of %u traced "
            "again in double precision",
            100 * audit->bound, 100 * AUDIT_CONFIDENCE, audit->off, audit->pixels);
}
