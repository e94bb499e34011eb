#include "precision/precision.h"

#include "core/parallel.h"
#include "grammar/ir.h"
#include "picture/write/image.h"
#include "reference/reference.h"
#include "scene/scene.h"
#include "scene/spread.h"

#include <math.h>
#include <stdatomic.h>

enum {
    CELLS = 3700,
    RAYS = 256, // of a pixel at most, the heaviest ones
    PIECE = 16, // pixels
};

struct trial {
    struct reference *exact, *single;
    struct reference_settings settings;
    struct image_display display;
    struct spread spread;
    atomic_uint off;
    atomic_bool failed;
};

static bool differ(const struct trial *trial, const double exact[3], const double single[3]) {
    float linear[6], shown[6];
    for (int k = 0; k < 3; k++) {
        linear[k] = (float)exact[k];
        linear[k + 3] = (float)single[k];
    }
    image_to_displayed(linear, 2, trial->display, shown);
    for (int k = 0; k < 3; k++)
        if (!(fabs((double)shown[k] - (double)shown[k + 3]) <= PRECISION_OFF))
            return true;
    return false;
}

static void trace_piece(void *context, size_t begin, size_t end) {
    struct trial *trial = context;
    for (size_t i = begin; i < end; i++) {
        uint32_t x, y;
        double exact[3], single[3];
        spread_pixel(&trial->spread, (uint32_t)i, &x, &y);
        if (!reference_pixel(trial->exact, &trial->settings, x, y, exact) ||
            !reference_pixel(trial->single, &trial->settings, x, y, single))
            atomic_store(&trial->failed, true);
        else if (differ(trial, exact, single))
            atomic_fetch_add(&trial->off, 1);
    }
}

static bool run(struct trial *trial, struct precision_choice *out) {
    out->pixels = trial->spread.columns * trial->spread.lines;
    parallel_for(out->pixels, PIECE, trace_piece, trial);
    out->off = atomic_load(&trial->off);
    out->traced = true;
    return !atomic_load(&trial->failed);
}

static bool try_pixels(const struct flat_input *input, uint32_t width, uint32_t height,
                       struct precision_choice *out) {
    const struct ir_scene *ir = input->scene->ir;
    struct reference_input wanted = {.scene = input->scene, .view = input->view, .gradient = true};
    struct trial trial = {.exact = reference_create(&wanted),
                          .display = {ir->image.tone, ir->image.transfer},
                          .spread = spread_make(width, height, CELLS)};
    wanted.as_single = true;
    trial.single = trial.exact ? reference_create(&wanted) : NULL;
    trial.settings =
        (struct reference_settings){.width = width,
                                    .height = height,
                                    .samples = 1,
                                    .max_depth = (uint32_t)ir->trace.max_depth,
                                    .min_weight = ir->trace.min_weight,
                                    .cut_sees_background = ir->trace.depth_limit == IR_DEPTH_BACKGROUND,
                                    .segments = RAYS};
    const bool good = trial.single && run(&trial, out);
    reference_destroy(trial.single);
    reference_destroy(trial.exact);
    return good;
}

static uint64_t size_of(const struct scene *scene) {
    uint64_t sum = 0;
    for (uint32_t i = 0; i < scene->body_count; i++)
        sum += scene->bodies[i].shape == SCENE_SPHERE ? 1 : scene->bodies[i].triangle_count;
    return sum;
}

bool precision_decide(const struct flat_input *input, uint32_t width, uint32_t height,
                      struct precision_choice *out) {
    *out = (struct precision_choice){.pixels = 0};
    if (!precision_measure(input, &out->report))
        return false;
    if (size_of(input->scene) > PRECISION_TRACED) {
        out->needs_double = !out->report.suffices;
        return true;
    }
    if (!try_pixels(input, width, height, out))
        return false;
    out->needs_double = out->off > PRECISION_SHARE * out->pixels;
    return true;
}

bool precision_is_double(const struct ir_scene *ir, const struct precision_choice *choice) {
    return ir->trace.precision == IR_PRECISION_DOUBLE ||
           (ir->trace.precision == IR_PRECISION_AUTO && choice->needs_double);
}
