// A frame whose pixels end when the error of their displayed colour is small enough.
//
// A pixel's samples are taken in rounds, and each of four groups gets a quarter of each round. The groups'
// means differ by their errors: the variance of the four means, over four, is the variance of their mean.
// Points of a good sequence have a smaller error together than apart, so this estimate is too large rather
// than too small. A pixel goes on if its own error, that of the 3 x 3 pixels around it within its tile, or
// the rare error of the tile is above the bound: so pixels that look even by chance go on with their
// neighbours, and nothing outside its tile affects a pixel.
#include "core/float_bits.h"
#include "core/heap.h"
#include "core/parallel.h"
#include "scene/points.h"
#include "tracer/render/render_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    GROUPS = 4,
    TILES_A_PIECE = 64,
    COLUMNS = TILE_SIDE,
};
// A normally distributed value exceeds its mean by more than this many standard deviations in one of twenty
// cases.
static const double SURE = 1.645;

// In 19 of 20 tiles the square of the error is at most this many times what the tile's variances say:
// 1 + SURE sqrt(2 + 2 / 3), by the spread that `conclude` explains.
static const double TILE_SURE = 3.686;

// A variance is isolated if it is more than this many times the mean of its neighbours'. At an edge, where
// two of the eight neighbours are like it, it is only 4 times that mean.
static const float ALONE = 6;

// Pixels that are drawn again: their share, and about how many at most.
static const double AGAIN_PART = 0.04, AGAIN_MOST = 16384;

// What is known about the pixels of a portion, by slot.
struct portion {
    struct renderer_frame *run;
    uint32_t begin, tiles;
    float (*sums)[GROUPS][3];
    float *variance;   // of the displayed mean, averaged over the channels
    uint32_t *samples; // that each pixel has
    uint32_t *faults;  // the first word with a fault, as in shaders/frame.h
    uint32_t *list;    // slots of the pixels that go on
    uint32_t count;    // pixels in the list
    float *shown;      // GROUPS colours for each pixel of the list
    bool *goes_on;     // by slot
    uint64_t ended;    // pixels of the frame
};

static void finish(struct portion *portion) {
    free(portion->sums);
    free(portion->variance);
    free(portion->samples);
    free(portion->faults);
    free(portion->list);
    free(portion->shown);
    free(portion->goes_on);
}

static bool make(struct portion *portion, uint32_t tiles) {
    const size_t slots = heap_times(tiles, TILE_PIXELS);
    portion->sums = heap_array(slots, sizeof *portion->sums);
    portion->variance = heap_array(slots, sizeof *portion->variance);
    portion->samples = heap_array(slots, sizeof *portion->samples);
    portion->faults = heap_array(slots, sizeof *portion->faults);
    portion->list = heap_array(slots, sizeof *portion->list);
    portion->shown = heap_array(heap_times(heap_times(slots, GROUPS), 3), sizeof *portion->shown);
    portion->goes_on = heap_array(slots, sizeof *portion->goes_on);
    return portion->sums && portion->variance && portion->samples && portion->faults && portion->list &&
           portion->shown && portion->goes_on;
}

// ---- rounds

// What a round makes of the number of samples that a pixel has: twice as many, because the parts of the
// sequence that cover evenly are those whose lengths are powers of two.
static uint32_t next_samples(const struct render_settings *settings, uint32_t samples) {
    const uint32_t most = settings->samples / GROUPS * GROUPS;
    const uint32_t least = (settings->least_samples + GROUPS - 1) / GROUPS * GROUPS;
    const uint32_t next = samples ? 2 * samples : least > GROUPS ? least : GROUPS;
    return next < most ? next : most;
}

static void take_sums(struct portion *portion, int group) {
    const struct renderer *renderer = portion->run->renderer;
    for (uint32_t i = 0; i < portion->count; i++) {
        const uint32_t slot = portion->list[i], *words = renderer->portion + 4 * (size_t)slot;
        for (int k = 0; k < 3; k++)
            portion->sums[slot][group][k] += float_of_bits(words[k]);
        if (portion->faults[slot] >> FAULT_KIND_SHIFT == FAULT_NONE)
            portion->faults[slot] = words[3];
    }
}

// Draws samples first .. end - 1 of the listed pixels, into a group.
static enum render_result draw_group(struct portion *portion, int group, uint32_t first, uint32_t end) {
    struct renderer *renderer = portion->run->renderer;
    for (uint32_t sample = first; sample < end; sample++) {
        const enum render_result result = renderer_draw_listed(portion->run, portion->begin, portion->tiles,
                                                               sample, sample - first, portion->count);
        if (result != RENDER_DONE)
            return result;
    }
    if (!gpu_read(renderer->gpu, renderer->buffers[BINDING_OUTPUT], 0, renderer->portion,
                  (uint64_t)portion->tiles * TILE_PIXELS * sizeof(struct gpu_word)))
        return RENDER_FAILED;
    take_sums(portion, group);
    return RENDER_DONE;
}

static bool write_list(const struct portion *portion) {
    struct renderer *renderer = portion->run->renderer;
    const uint64_t at = COUNTER_COUNT + 2 * (uint64_t)renderer->places;
    return gpu_write(renderer->gpu, renderer->buffers[BINDING_COUNTERS], at * sizeof *portion->list,
                     portion->list, portion->count * sizeof *portion->list);
}

static enum render_result draw_round(struct portion *portion, uint32_t samples, uint32_t next) {
    const uint32_t step = (next - samples) / GROUPS;
    if (!write_list(portion))
        return RENDER_FAILED;
    for (int group = 0; group < GROUPS; group++) {
        const uint32_t first = samples + (uint32_t)group * step;
        const enum render_result result = draw_group(portion, group, first, first + step);
        if (result != RENDER_DONE)
            return result;
    }
    for (uint32_t i = 0; i < portion->count; i++)
        portion->samples[portion->list[i]] = next;
    portion->run->statistics->all_samples += (uint64_t)portion->count * (next - samples);
    return RENDER_DONE;
}

// ---- errors

// The variance of the mean of the groups, as displayed.
static float variance_of(const float *shown) {
    float sum = 0;
    for (int k = 0; k < 3; k++) {
        float mean = 0;
        for (int group = 0; group < GROUPS; group++)
            mean += shown[3 * group + k] / GROUPS;
        for (int group = 0; group < GROUPS; group++) {
            const float off = shown[3 * group + k] - mean;
            sum += off * off;
        }
    }
    return sum / (3 * (GROUPS - 1) * GROUPS);
}

// Whether all samples were finite; else nothing is known about the pixel.
static bool is_sound(const struct portion *portion, uint32_t slot) {
    return portion->faults[slot] >> FAULT_KIND_SHIFT != FAULT_NOT_FINITE;
}

static void estimate(struct portion *portion) {
    const struct render_settings *settings = &portion->run->renderer->settings;
    for (uint32_t i = 0; i < portion->count; i++) {
        const uint32_t slot = portion->list[i];
        const float part = (float)GROUPS / (float)portion->samples[slot];
        for (int c = 0; c < GROUPS * 3; c++)
            portion->shown[GROUPS * 3 * (size_t)i + (size_t)c] = portion->sums[slot][c / 3][c % 3] * part;
    }
    settings->show(settings->show_context, portion->shown, (size_t)GROUPS * portion->count, portion->shown);
    for (uint32_t i = 0; i < portion->count; i++) {
        const uint32_t slot = portion->list[i];
        portion->variance[slot] =
            is_sound(portion, slot) ? variance_of(portion->shown + GROUPS * 3 * (size_t)i) : NAN;
    }
}

static int slot_in_tile(int x, int y) {
    return (x & 1) | (y & 1) << 1 | (x & 2) << 1 | (y & 2) << 2 | (x & 4) << 2 | (y & 4) << 3;
}

// Statistics of the variances around a pixel, within its tile; pixels outside the picture, or not finite,
// have NaN.
struct around {
    float sum;
    int count;
};

static struct around look_around(const float *variance, int x, int y) {
    struct around around = {0, 0};
    for (int j = y > 0 ? y - 1 : 0; j <= y + 1 && j < TILE_SIDE; j++)
        for (int i = x > 0 ? x - 1 : 0; i <= x + 1 && i < TILE_SIDE; i++) {
            const float v = variance[slot_in_tile(i, j)];
            around.sum += isnan(v) ? 0 : v;
            around.count += !isnan(v);
        }
    return around;
}

// The rare error of a tile: the isolated variances, averaged over all of its pixels. What is bright and
// rarely hit shows in a few pixels of the tile, but the others could have hit it as well.
static float rare_of_tile(const float *variance) {
    float sum = 0;
    int count = 0;
    for (int i = 0; i < TILE_PIXELS; i++) {
        const float own = variance[slot_in_tile(i % COLUMNS, i / COLUMNS)];
        if (isnan(own))
            continue;
        const struct around around = look_around(variance, i % COLUMNS, i / COLUMNS);
        const bool alone = own * (float)(around.count - 1) > ALONE * (around.sum - own);
        sum += alone ? own : 0;
        count++;
    }
    return count ? sum / (float)count : 0;
}

// The largest of the pixel's own variance, the mean of those around it, and the rare error of its tile.
static float pooled(const float *variance, int x, int y, float rare) {
    const struct around around = look_around(variance, x, y);
    return fmaxf(fmaxf(variance[slot_in_tile(x, y)], around.sum / (float)around.count), rare);
}

static void judge_tiles(void *context, size_t begin, size_t end) {
    const struct portion *portion = context;
    const double bound = portion->run->renderer->settings.error;
    for (size_t tile = begin; tile < end; tile++) {
        const float *variance = portion->variance + tile * TILE_PIXELS, rare = rare_of_tile(variance);
        for (int i = 0; i < TILE_PIXELS; i++) {
            bool *goes_on =
                &portion->goes_on[tile * TILE_PIXELS + (size_t)slot_in_tile(i % COLUMNS, i / COLUMNS)];
            const float most = pooled(variance, i % COLUMNS, i / COLUMNS, rare);
            *goes_on = *goes_on && TILE_SURE * (double)most > bound * bound;
        }
    }
}

// Keeps the pixels of the list that go on. Pixels that are not finite do not get better.
static void shorten_list(struct portion *portion) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < portion->count; i++) {
        const uint32_t slot = portion->list[i];
        if (portion->goes_on[slot] && is_sound(portion, slot))
            portion->list[count++] = slot;
    }
    portion->count = count;
}

// ---- a portion

static void begin_portion(struct portion *portion) {
    const size_t slots = (size_t)portion->tiles * TILE_PIXELS;
    memset(portion->sums, 0, slots * sizeof *portion->sums);
    portion->count = 0;
    for (uint32_t slot = 0; slot < slots; slot++) {
        uint32_t x, y;
        const bool exists = renderer_pixel(portion->run->renderer, portion->begin, slot, &x, &y);
        portion->variance[slot] = NAN;
        portion->samples[slot] = portion->faults[slot] = 0;
        portion->goes_on[slot] = exists;
        if (exists)
            portion->list[portion->count++] = slot;
    }
}

static void put_pixel(const struct portion *portion, uint32_t slot, float *rgb) {
    struct renderer *renderer = portion->run->renderer;
    uint32_t x, y;
    if (!renderer_pixel(renderer, portion->begin, slot, &x, &y))
        return;
    const size_t pixel = (size_t)y * renderer->settings.width + x;
    const bool sound = is_sound(portion, slot);
    for (int k = 0; k < 3; k++) {
        float sum = 0;
        for (int group = 0; group < GROUPS; group++)
            sum += portion->sums[slot][group][k];
        rgb[3 * pixel + (size_t)k] = sound ? sum / (float)portion->samples[slot] : NAN;
    }
    const float *tile = portion->variance + slot / TILE_PIXELS * TILE_PIXELS;
    const float most = pooled(tile, (int)(x % TILE_SIDE), (int)(y % TILE_SIDE), rare_of_tile(tile));
    renderer->estimate.error[pixel] = sound ? sqrtf((float)TILE_SURE * most) : NAN;
    renderer->estimate.unknown += !sound;
    renderer->estimate.samples[pixel] = portion->samples[slot];
}

// Sums over the tiles: of the variances, and of the squares of a tile's variance. Sums over the pixels that
// were drawn again: of the excess of the squared error over the variance, and of the squares of this excess.
struct total {
    double variance, squares;
    double excess, excess_squares;
    uint32_t again;
};

static void end_portion(const struct portion *portion, float *rgb, struct total *total) {
    struct renderer *renderer = portion->run->renderer;
    for (uint32_t slot = 0; rgb && slot < portion->tiles * TILE_PIXELS; slot++) {
        uint32_t x, y;
        put_pixel(portion, slot, rgb);
        if (portion->faults[slot] >> FAULT_KIND_SHIFT != FAULT_NONE &&
            renderer_pixel(renderer, portion->begin, slot, &x, &y))
            renderer_note_fault(renderer, portion->faults[slot], 1, x, y,
                                &portion->run->statistics->faults[portion->faults[slot] >> FAULT_KIND_SHIFT]);
    }
    for (uint32_t tile = 0; tile < portion->tiles; tile++) {
        double sum = 0;
        for (int i = 0; i < TILE_PIXELS; i++) {
            const float v = portion->variance[tile * TILE_PIXELS + (uint32_t)i];
            sum += isnan(v) ? 0 : (double)v;
        }
        total->variance += sum;
        total->squares += sum * sum;
    }
}

// ---- pixels that are drawn again

// The groups of a pixel are parts of one sequence, so they can differ by less than their mean errs. What none
// of the samples hit is missing from every group; and if the picture is as fine as the sequence, the square
// of the error is up to twice that of independent samples (Owen 1997, "Monte Carlo Variance of Scrambled Net
// Quadrature"). So some pixels, chosen at random, are drawn again when they have ended, with as many samples
// from a different sequence: half of the squared difference estimates the squared error.
static bool is_drawn_again(const struct render_settings *settings, uint32_t x, uint32_t y) {
    const double part = AGAIN_MOST / ((double)settings->width * settings->height);
    const uint32_t hash = point_hash(point_hash(x + settings->first_x) + y + settings->first_y);
    return hash * 0x1p-32 < fmin(part, AGAIN_PART);
}

static void list_again(struct portion *portion, uint32_t samples) {
    portion->count = 0;
    for (uint32_t slot = 0; slot < portion->tiles * TILE_PIXELS; slot++) {
        uint32_t x, y;
        if (portion->samples[slot] == samples && is_sound(portion, slot) &&
            renderer_pixel(portion->run->renderer, portion->begin, slot, &x, &y) &&
            is_drawn_again(&portion->run->renderer->settings, x, y))
            portion->list[portion->count++] = slot;
    }
}

// Moves the mean of a pixel's samples to `to`; its sums are cleared.
static void take_mean(struct portion *portion, uint32_t slot, float *to) {
    for (int k = 0; k < 3; k++) {
        to[k] = 0;
        for (int group = 0; group < GROUPS; group++)
            to[k] += portion->sums[slot][group][k] / (float)portion->samples[slot];
    }
    memset(portion->sums[slot], 0, sizeof portion->sums[slot]);
}

static void add_excess(const struct portion *portion, struct total *total) {
    for (uint32_t i = 0; i < portion->count; i++) {
        const float *first = portion->shown + 3 * (size_t)i, *second = first + 3 * (size_t)portion->count;
        double square = 0;
        for (int k = 0; k < 3; k++)
            square += pow((double)first[k] - (double)second[k], 2) / (2 * 3);
        if (!is_sound(portion, portion->list[i]) || !isfinite(square))
            continue;
        const double excess = square - (double)portion->variance[portion->list[i]];
        total->excess += excess;
        total->excess_squares += excess * excess;
        total->again++;
    }
}

// Draws again the chosen pixels that ended with this many samples. The new samples are numbered from the
// first multiple of 2^bits that the picture does not reach: there another sequence begins.
static enum render_result draw_again(struct portion *portion, uint32_t samples, struct total *total) {
    const struct render_settings *settings = &portion->run->renderer->settings;
    const uint32_t bits = points_bits(settings->first_sample, settings->samples);
    const uint32_t first = (((settings->samples - 1) >> bits) + 1) << bits;
    list_again(portion, samples);
    if (portion->count == 0)
        return RENDER_DONE;
    for (uint32_t i = 0; i < portion->count; i++)
        take_mean(portion, portion->list[i], portion->shown + 3 * (size_t)i);
    const enum render_result result =
        write_list(portion) ? draw_group(portion, 0, first, first + samples) : RENDER_FAILED;
    if (result != RENDER_DONE)
        return result;
    for (uint32_t i = 0; i < portion->count; i++)
        take_mean(portion, portion->list[i], portion->shown + 3 * ((size_t)portion->count + i));
    settings->show(settings->show_context, portion->shown, 2 * (size_t)portion->count, portion->shown);
    add_excess(portion, total);
    return RENDER_DONE;
}

static enum render_result draw_portion(struct portion *portion, float *rgb, struct total *total) {
    const struct render_settings *settings = &portion->run->renderer->settings;
    enum render_result result = RENDER_DONE;
    begin_portion(portion);
    for (uint32_t samples = 0, next; portion->count > 0 && result == RENDER_DONE; samples = next) {
        next = next_samples(settings, samples);
        if (next == samples)
            break;
        result = draw_round(portion, samples, next);
        if (result != RENDER_DONE)
            return result;
        estimate(portion);
        parallel_for(portion->tiles, TILES_A_PIECE, judge_tiles, portion);
        portion->ended += portion->count;
        shorten_list(portion);
        portion->ended -= portion->count;
        portion->run->steps_done = portion->ended;
    }
    portion->ended += portion->count;
    end_portion(portion, rgb, total);
    for (uint32_t samples = 0, next; result == RENDER_DONE; samples = next) {
        next = next_samples(settings, samples);
        if (next == samples)
            break;
        result = draw_again(portion, next, total);
    }
    return result;
}

// ---- the frame

static bool make_estimate(struct renderer *renderer) {
    const size_t pixels = heap_times(renderer->settings.width, renderer->settings.height);
    struct render_estimate *estimate = &renderer->estimate;
    if (!estimate->error)
        estimate->error = heap_array(pixels, sizeof *estimate->error);
    if (!estimate->samples)
        estimate->samples = heap_array(pixels, sizeof *estimate->samples);
    return estimate->error && estimate->samples;
}

// How large the error of the whole picture may be. Edges continue from pixel to pixel, so within a tile
// neither errors nor estimates are independent, and a tile counts as one value: its squared error has a
// variance of twice its own square, and the estimate from four groups adds two thirds of that square. The
// pixels that were drawn again give a second estimate, which has a spread of its own; the larger of the two
// counts.
static void conclude(struct renderer *renderer, const struct total *total) {
    const double all = (double)renderer->settings.width * renderer->settings.height;
    const double pixels = fmax(all - renderer->estimate.unknown, 1), again = total->again;
    double most = total->variance + SURE * sqrt((2 + 2.0 / (GROUPS - 1)) * total->squares);
    if (again > 1) {
        const double excess = total->excess / again;
        const double squares = (total->excess_squares - again * excess * excess) / (again - 1);
        const double spread = SURE * sqrt(2 * total->squares + pixels * pixels * fmax(squares, 0) / again);
        most = fmax(most, total->variance + pixels * excess + spread);
    }
    renderer->estimate.mean = sqrt(total->variance / pixels);
    renderer->estimate.most = sqrt(most / pixels);
}

enum render_result renderer_draw_adaptive(struct renderer_frame *run, float *rgb) {
    struct renderer *renderer = run->renderer;
    struct portion portion = {.run = run};
    struct total total = {0};
    run->statistics->all_samples = 0;
    renderer->estimate.unknown = 0;
    run->steps = (uint64_t)renderer->settings.width * renderer->settings.height;
    enum render_result result =
        make_estimate(renderer) && make(&portion, renderer->portion_tiles) ? RENDER_DONE : RENDER_FAILED;
    for (; result == RENDER_DONE && portion.begin < renderer->tiles; portion.begin += portion.tiles) {
        const uint32_t left = renderer->tiles - portion.begin;
        portion.tiles = left < renderer->portion_tiles ? left : renderer->portion_tiles;
        result = draw_portion(&portion, rgb, &total);
    }
    finish(&portion);
    if (result == RENDER_DONE)
        conclude(renderer, &total);
    return result;
}

const struct render_estimate *renderer_estimate(const struct renderer *renderer) {
    return renderer->estimate.error ? &renderer->estimate : NULL;
}
