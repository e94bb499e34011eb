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
// One-sided, for the normal distribution.
static const double SURE = 1.645;

// Of a tile's error alone, squared, in the mean of its variances: that is above its own square by
// 1.645 sqrt(2 + 2 / 3) of it in one of twenty tiles (conclude).
static const double TILE_SURE = 3.686;

// How many times the mean of its neighbours' an isolated variance is: at an edge two of eight are like it.
static const float ALONE = 6;

// Pixels that are drawn again: their share, and about how many at most.
static const double AGAIN_PART = 0.04, AGAIN_MOST = 16384;

// What is known about the pixels of a band, by slot.
struct band {
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

static void finish(struct band *band) {
    free(band->sums);
    free(band->variance);
    free(band->samples);
    free(band->faults);
    free(band->list);
    free(band->shown);
    free(band->goes_on);
}

static bool make(struct band *band, uint32_t tiles) {
    const size_t slots = heap_times(tiles, TILE_PIXELS);
    band->sums = heap_array(slots, sizeof *band->sums);
    band->variance = heap_array(slots, sizeof *band->variance);
    band->samples = heap_array(slots, sizeof *band->samples);
    band->faults = heap_array(slots, sizeof *band->faults);
    band->list = heap_array(slots, sizeof *band->list);
    band->shown = heap_array(heap_times(heap_times(slots, GROUPS), 3), sizeof *band->shown);
    band->goes_on = heap_array(slots, sizeof *band->goes_on);
    return band->sums && band->variance && band->samples && band->faults && band->list && band->shown &&
           band->goes_on;
}

// ---- rounds

// Samples of a pixel after the round that follows `samples`: twice as many, because the parts of the sequence
// that cover evenly are those whose lengths are powers of two.
static uint32_t next_samples(const struct render_settings *settings, uint32_t samples) {
    const uint32_t most = settings->samples / GROUPS * GROUPS;
    const uint32_t least = (settings->least_samples + GROUPS - 1) / GROUPS * GROUPS;
    const uint32_t next = samples ? 2 * samples : least > GROUPS ? least : GROUPS;
    return next < most ? next : most;
}

static void take_sums(struct band *band, int group) {
    const struct renderer *renderer = band->run->renderer;
    for (uint32_t i = 0; i < band->count; i++) {
        const uint32_t slot = band->list[i], *words = renderer->band + 4 * (size_t)slot;
        for (int k = 0; k < 3; k++)
            band->sums[slot][group][k] += float_of_bits(words[k]);
        if (band->faults[slot] >> FAULT_KIND_SHIFT == FAULT_NONE)
            band->faults[slot] = words[3];
    }
}

// Draws samples first .. end - 1 of the listed pixels, into a group.
static enum render_result draw_group(struct band *band, int group, uint32_t first, uint32_t end) {
    struct renderer *renderer = band->run->renderer;
    for (uint32_t sample = first; sample < end; sample++) {
        const enum render_result result =
            renderer_draw_listed(band->run, band->begin, band->tiles, sample, sample - first, band->count);
        if (result != RENDER_DONE)
            return result;
    }
    if (!gpu_read(renderer->gpu, renderer->buffers[BINDING_OUTPUT], 0, renderer->band,
                  (uint64_t)band->tiles * TILE_PIXELS * sizeof(struct gpu_word)))
        return RENDER_FAILED;
    take_sums(band, group);
    return RENDER_DONE;
}

static bool write_list(const struct band *band) {
    struct renderer *renderer = band->run->renderer;
    const uint64_t at = COUNTER_COUNT + 2 * (uint64_t)renderer->places;
    return gpu_write(renderer->gpu, renderer->buffers[BINDING_COUNTERS], at * sizeof *band->list, band->list,
                     band->count * sizeof *band->list);
}

static enum render_result draw_round(struct band *band, uint32_t samples, uint32_t next) {
    const uint32_t step = (next - samples) / GROUPS;
    if (!write_list(band))
        return RENDER_FAILED;
    for (int group = 0; group < GROUPS; group++) {
        const uint32_t first = samples + (uint32_t)group * step;
        const enum render_result result = draw_group(band, group, first, first + step);
        if (result != RENDER_DONE)
            return result;
    }
    for (uint32_t i = 0; i < band->count; i++)
        band->samples[band->list[i]] = next;
    band->run->statistics->all_samples += (uint64_t)band->count * (next - samples);
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
static bool is_sound(const struct band *band, uint32_t slot) {
    return band->faults[slot] >> FAULT_KIND_SHIFT != FAULT_NOT_FINITE;
}

static void estimate(struct band *band) {
    const struct render_settings *settings = &band->run->renderer->settings;
    for (uint32_t i = 0; i < band->count; i++) {
        const uint32_t slot = band->list[i];
        const float part = (float)GROUPS / (float)band->samples[slot];
        for (int c = 0; c < GROUPS * 3; c++)
            band->shown[GROUPS * 3 * (size_t)i + (size_t)c] = band->sums[slot][c / 3][c % 3] * part;
    }
    settings->show(settings->show_context, band->shown, (size_t)GROUPS * band->count, band->shown);
    for (uint32_t i = 0; i < band->count; i++) {
        const uint32_t slot = band->list[i];
        band->variance[slot] = is_sound(band, slot) ? variance_of(band->shown + GROUPS * 3 * (size_t)i) : NAN;
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

// Bright and rarely hit things show in a few pixels of a tile, but could have shown in the others as well:
// the mean over the tile of the isolated variances.
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
    const struct band *band = context;
    const double bound = band->run->renderer->settings.error;
    for (size_t tile = begin; tile < end; tile++) {
        const float *variance = band->variance + tile * TILE_PIXELS, rare = rare_of_tile(variance);
        for (int i = 0; i < TILE_PIXELS; i++) {
            bool *goes_on =
                &band->goes_on[tile * TILE_PIXELS + (size_t)slot_in_tile(i % COLUMNS, i / COLUMNS)];
            const float most = pooled(variance, i % COLUMNS, i / COLUMNS, rare);
            *goes_on = *goes_on && TILE_SURE * (double)most > bound * bound;
        }
    }
}

// Keeps the pixels of the list that go on. Pixels that are not finite do not get better.
static void shorten_list(struct band *band) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < band->count; i++) {
        const uint32_t slot = band->list[i];
        if (band->goes_on[slot] && is_sound(band, slot))
            band->list[count++] = slot;
    }
    band->count = count;
}

// ---- a band

static void begin_band(struct band *band) {
    const size_t slots = (size_t)band->tiles * TILE_PIXELS;
    memset(band->sums, 0, slots * sizeof *band->sums);
    band->count = 0;
    for (uint32_t slot = 0; slot < slots; slot++) {
        uint32_t x, y;
        const bool exists = renderer_pixel(band->run->renderer, band->begin, slot, &x, &y);
        band->variance[slot] = NAN;
        band->samples[slot] = band->faults[slot] = 0;
        band->goes_on[slot] = exists;
        if (exists)
            band->list[band->count++] = slot;
    }
}

static void put_pixel(const struct band *band, uint32_t slot, float *rgb) {
    struct renderer *renderer = band->run->renderer;
    uint32_t x, y;
    if (!renderer_pixel(renderer, band->begin, slot, &x, &y))
        return;
    const size_t pixel = (size_t)y * renderer->settings.width + x;
    const bool sound = is_sound(band, slot);
    for (int k = 0; k < 3; k++) {
        float sum = 0;
        for (int group = 0; group < GROUPS; group++)
            sum += band->sums[slot][group][k];
        rgb[3 * pixel + (size_t)k] = sound ? sum / (float)band->samples[slot] : NAN;
    }
    const float *tile = band->variance + slot / TILE_PIXELS * TILE_PIXELS;
    const float most = pooled(tile, (int)(x % TILE_SIDE), (int)(y % TILE_SIDE), rare_of_tile(tile));
    renderer->estimate.error[pixel] = sound ? sqrtf((float)TILE_SURE * most) : NAN;
    renderer->estimate.unknown += !sound;
    renderer->estimate.samples[pixel] = band->samples[slot];
}

// Sums over the tiles: of the variances, and of the squares of a tile's variance. Sums over the pixels that
// were drawn again: of the excess of the squared error over the variance, and of the squares of this excess.
struct total {
    double variance, squares;
    double excess, excess_squares;
    uint32_t again;
};

static void end_band(const struct band *band, float *rgb, struct total *total) {
    struct renderer *renderer = band->run->renderer;
    for (uint32_t slot = 0; rgb && slot < band->tiles * TILE_PIXELS; slot++) {
        uint32_t x, y;
        put_pixel(band, slot, rgb);
        if (band->faults[slot] >> FAULT_KIND_SHIFT != FAULT_NONE &&
            renderer_pixel(renderer, band->begin, slot, &x, &y))
            renderer_note_fault(renderer, band->faults[slot], 1, x, y,
                                &band->run->statistics->faults[band->faults[slot] >> FAULT_KIND_SHIFT]);
    }
    for (uint32_t tile = 0; tile < band->tiles; tile++) {
        double sum = 0;
        for (int i = 0; i < TILE_PIXELS; i++) {
            const float v = band->variance[tile * TILE_PIXELS + (uint32_t)i];
            sum += isnan(v) ? 0 : (double)v;
        }
        total->variance += sum;
        total->squares += sum * sum;
    }
}

// ---- pixels that are drawn again

// The groups of a pixel are parts of one sequence. What none of its samples met is missing from all groups,
// and if a picture is as fine as the sequence, the groups can differ by less than the error of their mean:
// its square is up to twice as large as for independent places (Owen 1997, "Monte Carlo Variance of Scrambled
// Net Quadrature"). So some pixels, chosen at random, are drawn again when they have ended, with as many
// samples from a different sequence: half of the squared difference is the squared error.
static bool is_drawn_again(const struct render_settings *settings, uint32_t x, uint32_t y) {
    const double part = AGAIN_MOST / ((double)settings->width * settings->height);
    const uint32_t hash = point_hash(point_hash(x + settings->first_x) + y + settings->first_y);
    return hash * 0x1p-32 < fmin(part, AGAIN_PART);
}

static void list_again(struct band *band, uint32_t samples) {
    band->count = 0;
    for (uint32_t slot = 0; slot < band->tiles * TILE_PIXELS; slot++) {
        uint32_t x, y;
        if (band->samples[slot] == samples && is_sound(band, slot) &&
            renderer_pixel(band->run->renderer, band->begin, slot, &x, &y) &&
            is_drawn_again(&band->run->renderer->settings, x, y))
            band->list[band->count++] = slot;
    }
}

// Moves the mean of a pixel's samples to `to`; its sums are cleared.
static void take_mean(struct band *band, uint32_t slot, float *to) {
    for (int k = 0; k < 3; k++) {
        to[k] = 0;
        for (int group = 0; group < GROUPS; group++)
            to[k] += band->sums[slot][group][k] / (float)band->samples[slot];
    }
    memset(band->sums[slot], 0, sizeof band->sums[slot]);
}

static void add_excess(const struct band *band, struct total *total) {
    for (uint32_t i = 0; i < band->count; i++) {
        const float *first = band->shown + 3 * (size_t)i, *second = first + 3 * (size_t)band->count;
        double square = 0;
        for (int k = 0; k < 3; k++)
            square += pow((double)first[k] - (double)second[k], 2) / (2 * 3);
        if (!is_sound(band, band->list[i]) || !isfinite(square))
            continue;
        const double excess = square - (double)band->variance[band->list[i]];
        total->excess += excess;
        total->excess_squares += excess * excess;
        total->again++;
    }
}

// Draws again pixels that have ended with this number of samples. Sample numbers from a power of two on that
// the picture does not use belong to another sequence.
static enum render_result draw_again(struct band *band, uint32_t samples, struct total *total) {
    const struct render_settings *settings = &band->run->renderer->settings;
    const uint32_t bits = points_bits(settings->first_sample, settings->samples);
    const uint32_t first = (((settings->samples - 1) >> bits) + 1) << bits;
    list_again(band, samples);
    if (band->count == 0)
        return RENDER_DONE;
    for (uint32_t i = 0; i < band->count; i++)
        take_mean(band, band->list[i], band->shown + 3 * (size_t)i);
    const enum render_result result =
        write_list(band) ? draw_group(band, 0, first, first + samples) : RENDER_FAILED;
    if (result != RENDER_DONE)
        return result;
    for (uint32_t i = 0; i < band->count; i++)
        take_mean(band, band->list[i], band->shown + 3 * ((size_t)band->count + i));
    settings->show(settings->show_context, band->shown, 2 * (size_t)band->count, band->shown);
    add_excess(band, total);
    return RENDER_DONE;
}

static enum render_result draw_band(struct band *band, float *rgb, struct total *total) {
    const struct render_settings *settings = &band->run->renderer->settings;
    enum render_result result = RENDER_DONE;
    begin_band(band);
    for (uint32_t samples = 0, next; band->count > 0 && result == RENDER_DONE; samples = next) {
        next = next_samples(settings, samples);
        if (next == samples)
            break;
        result = draw_round(band, samples, next);
        if (result != RENDER_DONE)
            return result;
        estimate(band);
        parallel_for(band->tiles, TILES_A_PIECE, judge_tiles, band);
        band->ended += band->count;
        shorten_list(band);
        band->ended -= band->count;
        band->run->steps_done = band->ended;
    }
    band->ended += band->count;
    end_band(band, rgb, total);
    for (uint32_t samples = 0, next; result == RENDER_DONE; samples = next) {
        next = next_samples(settings, samples);
        if (next == samples)
            break;
        result = draw_again(band, next, total);
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

// Neither the errors nor their estimates are independent within a tile, because edges continue; a tile's
// squared error has a variance of twice its square, and an estimate from four groups one of two thirds of it.
// If the pixels that were drawn again indicate more than that, they count: for all pixels, with their own
// spread.
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
    struct band band = {.run = run};
    struct total total = {0};
    run->statistics->all_samples = 0;
    renderer->estimate.unknown = 0;
    run->steps = (uint64_t)renderer->settings.width * renderer->settings.height;
    enum render_result result =
        make_estimate(renderer) && make(&band, renderer->band_tiles) ? RENDER_DONE : RENDER_FAILED;
    for (; result == RENDER_DONE && band.begin < renderer->tiles; band.begin += band.tiles) {
        const uint32_t left = renderer->tiles - band.begin;
        band.tiles = left < renderer->band_tiles ? left : renderer->band_tiles;
        result = draw_band(&band, rgb, &total);
    }
    finish(&band);
    if (result == RENDER_DONE)
        conclude(renderer, &total);
    return result;
}

const struct render_estimate *renderer_estimate(const struct renderer *renderer) {
    return renderer->estimate.error ? &renderer->estimate : NULL;
}
