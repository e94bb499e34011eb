#include "app/audit.h"

#include "core/clock.h"
#include "core/parallel.h"
#include "grammar/ir.h"
#include "reference/reference.h"
#include "scene/spread.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

enum {
    CELLS = 3700,       // of the first look: if none is off, at most 0.1 % of the picture is
    MORE_CELLS = 7400,  // of the second
    MORE_BELOW = 16,    // there is one where some pixels, but fewer, are off
    PIECE = 16,         // pixels
    CHUNK = 64 * PIECE, // pixels between two reports of the progress
};

// ---- tracing them again

struct work {
    const struct reference *reference;
    struct reference_settings settings;
    const struct image *image;
    struct image_display display;
    struct spread grid;
    uint32_t first; // cell of the chunk
    atomic_uint off, first_off;
    atomic_bool failed;
};

static bool is_off(const struct work *w, const float *rgb, const double *exact) {
    float linear[6], shown[6];
    for (int k = 0; k < 3; k++) {
        linear[k] = rgb[k];
        linear[k + 3] = (float)exact[k];
    }
    image_to_displayed(linear, 2, w->display, shown);
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
        double exact[3];
        spread_pixel(&w->grid, w->first + (uint32_t)i, &x, &y);
        const size_t place = (size_t)y * w->image->width + x;
        if (!reference_pixel(w->reference, &w->settings, x, y, exact))
            atomic_store(&w->failed, true);
        else if (is_off(w, w->image->rgb + 3 * place, exact))
            note_off(w, (uint32_t)place);
    }
}

// One look: a pixel of each cell.
static enum shot_status look(struct work *w, uint32_t cells, const struct render_progress *progress,
                             struct audit *out) {
    w->grid = spread_make(w->image->width, w->image->height, cells);
    const uint32_t count = w->grid.columns * w->grid.lines;
    for (w->first = 0; w->first < count; w->first += CHUNK) {
        const uint32_t left = count - w->first;
        parallel_for(left < CHUNK ? left : CHUNK, PIECE, trace_piece, w);
        if (progress && progress->report && !progress->report(progress->context, (double)w->first / count))
            return SHOT_CANCELLED;
    }
    out->whole = w->grid.columns == w->image->width && w->grid.lines == w->image->height;
    out->pixels += count;
    return SHOT_OK;
}

static enum shot_status look_twice(struct work *w, const struct render_progress *progress,
                                   struct audit *out) {
    enum shot_status status = look(w, CELLS, progress, out);
    const uint32_t off = atomic_load(&w->off);
    if (status != SHOT_OK || out->whole || off == 0 || off >= MORE_BELOW)
        return status;
    const struct spread whole = spread_make(w->image->width, w->image->height, MORE_CELLS);
    if (whole.columns == w->image->width && whole.lines == w->image->height) {
        out->pixels = 0; // each pixel counts once
        atomic_store(&w->off, 0);
    }
    return look(w, MORE_CELLS, progress, out);
}

static void conclude(struct work *w, struct audit *out) {
    out->off = atomic_load(&w->off);
    out->bound = out->whole ? (double)out->off / out->pixels : audit_bound(out->off, out->pixels);
    const uint32_t first = out->off ? atomic_load(&w->first_off) : 0;
    out->x = first % w->image->width;
    out->y = first / w->image->width;
}

enum shot_status audit_take(struct session *session, const struct view *view, const struct image *image,
                            const struct render_progress *progress, struct audit *out) {
    const double start = clock_seconds();
    const struct reference_input input = {.scene = &session->resolved, .view = view};
    struct reference *reference = reference_create(&input);
    struct work work = {.reference = reference,
                        .image = image,
                        .display = {session->image->tone, session->image->transfer},
                        .first_off = UINT32_MAX};
    work.settings = reference_settings_of(session->scene, session->image, &session->options.limits, true);
    *out = (struct audit){0};
    enum shot_status status = reference ? look_twice(&work, progress, out) : SHOT_SCENE;
    if (!reference || atomic_load(&work.failed))
        status = shot_no_memory(session, "the audit");
    if (status == SHOT_OK)
        conclude(&work, out);
    reference_destroy(reference);
    out->seconds = clock_seconds() - start;
    return status;
}

// ---- what it says

// The probability of `off` or fewer among `pixels` where the share is `share`, 0 < share < 1: terms by their
// logarithms.
static double at_most(uint32_t off, uint32_t pixels, double share) {
    double sum = 0, term = pixels * log1p(-share);
    for (uint32_t k = 0; k <= off; k++) {
        sum += exp(term);
        term += log((double)(pixels - k) / (k + 1)) + log(share) - log1p(-share);
    }
    return sum;
}

double audit_bound(uint32_t off, uint32_t pixels) {
    double low = (double)off / pixels, high = 1;
    if (off >= pixels)
        return 1;
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        if (at_most(off, pixels, middle) > 0.5 * (1 - AUDIT_CONFIDENCE))
            low = middle;
        else
            high = middle;
    }
    return high;
}

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
