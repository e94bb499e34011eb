// What the window shows while a scene is loaded: a bar, and which step it is.
//
// Nobody knows how much work is left. Each step has a share of the bar, and each loop in it fills half of
// what is left of that share. So the bar never goes back, and never stands still while something is done. It
// is drawn between two pieces of the work, on the thread that does it, and takes a fiftieth of the time at
// most.
#include "core/clock.h"
#include "window/viewer_private.h"

enum {
    BAR_COLOR = 0x3f8fe0,
    STRIP_COLOR = 0x181818,
    EMPTY_COLOR = 0x303030,
    TEXT_COLOR = 0xf0f0f0,
    BAR_DOTS = 4, // its height
    MARGIN_DOTS = 4,
};
#define LEAST_SECONDS 0.05 // between two bars
#define MOST_PART     0.02 // of the time
#define LATE_SECONDS  0.15 // that a load may take before a bar covers the picture

static const struct {
    double begin;
    const char *words;
} steps[VIEWER_STEPS + 1] = {
    [VIEWER_READS_TEXT] = {0, "reading the scene"},
    [VIEWER_READS_FILES] = {0.05, "reading meshes and images"},
    [VIEWER_BUILDS] = {0.5, "building trees"},
    [VIEWER_COMPILES] = {0.85, "compiling for the device"},
    [VIEWER_STEPS] = {1, ""},
};

static double done_of(const struct viewer_loading *loading) {
    const double begin = steps[loading->step].begin, share = steps[loading->step + 1].begin - begin;
    return begin + share * (1 - loading->rest * (1 - loading->fraction / 2));
}

static void put_bar(struct viewer *v) {
    struct canvas *canvas = &v->canvas;
    const uint32_t scale = window_text_scale(v->window), bar = BAR_DOTS * scale;
    const uint32_t strip = bar + (2 * MARGIN_DOTS + CANVAS_GLYPH_HEIGHT) * scale;
    const uint32_t top = canvas->height > strip ? canvas->height - strip : 0;
    const uint32_t end = (uint32_t)(done_of(&v->loading) * canvas->width + 0.5);
    if (v->shown.samples == 0)
        canvas_fill(canvas, 0, 0, canvas->width, top, EMPTY_COLOR);
    canvas_fill(canvas, 0, top, canvas->width, strip, STRIP_COLOR);
    canvas_put_text(canvas, MARGIN_DOTS * scale, top + MARGIN_DOTS * scale, scale, TEXT_COLOR,
                    str_from(steps[v->loading.step].words));
    canvas_fill(canvas, 0, canvas->height > bar ? canvas->height - bar : 0, end, bar, BAR_COLOR);
}

// If this fails, so does the load, which says why.
static void show_bar(struct viewer *v) {
    const double begun = clock_seconds();
    uint32_t width, height;
    if (begun < v->loading.paused)
        return;
    window_wait(v->window, 0);
    window_size(v->window, &width, &height);
    if (width && height && canvas_resize(&v->canvas, width, height)) {
        put_bar(v);
        gpu_screen_show(v->gpu, v->screen, v->canvas.pixels, width, height);
    }
    const double now = clock_seconds(), rest = (now - begun) / MOST_PART;
    v->loading.paused = now + (rest > LEAST_SECONDS ? rest : LEAST_SECONDS);
}

// Each step is shown when it begins, if the bar is shown at all.
static void begin_step(struct viewer *v, enum viewer_step step) {
    struct viewer_loading *loading = &v->loading;
    if (step <= loading->step && step > 0)
        return;
    loading->step = step;
    loading->rest = 1;
    loading->fraction = 0;
    if (v->shown.samples == 0)
        loading->paused = 0;
    show_bar(v);
}

static void look(void *context, size_t done, size_t count) {
    struct viewer *v = context;
    struct viewer_loading *loading = &v->loading;
    const double fraction = (double)done / (double)count;
    if (fraction < loading->fraction)
        loading->rest /= 2;
    loading->fraction = fraction;
    show_bar(v);
}

// Phases that end on other threads do not count.
static void phase_ended(void *context, const char *name) {
    const str phase = str_from(name);
    if (str_equal_cstr(phase, "read"))
        begin_step(context, VIEWER_READS_FILES);
    else if (str_equal_cstr(phase, "flatten"))
        begin_step(context, VIEWER_COMPILES);
}

static void is_read(void *context) {
    begin_step(context, VIEWER_BUILDS);
}

void viewer_begin_loads(struct viewer *v) {
    v->loading.looker = (struct parallel_looker){look, v};
    v->loading.timeline.ended = phase_ended;
    v->loading.timeline.context = v;
    v->live->wish.session.timeline = &v->loading.timeline;
    v->live->wish.is_read = is_read;
    v->live->wish.context = v;
}

enum live_state viewer_load(struct viewer *v) {
    struct viewer_loading *loading = &v->loading;
    loading->timeline.count = 0;
    loading->paused = clock_seconds() + LATE_SECONDS;
    begin_step(v, VIEWER_READS_TEXT);
    parallel_look(&loading->looker);
    const enum live_state state = live_load(v->live);
    parallel_look(NULL);
    return state;
}
