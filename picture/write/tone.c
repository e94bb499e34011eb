#include "core/heap.h"
#include "core/parallel.h"
#include "core/quantile.h"
#include "core/srgb.h"
#include "grammar/ir.h"
#include "picture/write/image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    PIECE_PIXELS = 16384
};

static uint8_t round_to_byte(double displayed) {
    return (uint8_t)floor(255 * displayed + 0.5);
}

// The least float of each byte under sRGB: looking one up costs a hundredth of computing a power.
struct thresholds {
    float least[256];
};

static bool reaches(float linear, int byte) {
    return round_to_byte(srgb_encode(linear)) >= byte;
}

static void thresholds_make(struct thresholds *t) {
    t->least[0] = 0;
    for (int byte = 1; byte < 256; byte++) {
        float linear = (float)srgb_decode((byte - 0.5) / 255);
        while (linear > 0 && reaches(nextafterf(linear, 0), byte))
            linear = nextafterf(linear, 0);
        while (!reaches(linear, byte))
            linear = nextafterf(linear, 1);
        t->least[byte] = linear;
    }
}

static uint8_t threshold_byte(const struct thresholds *t, float linear) {
    int byte = 0;
    for (int step = 128; step; step /= 2)
        if (linear >= t->least[byte + step])
            byte += step;
    return (uint8_t)byte;
}

struct conversion {
    const float *rgb;
    uint8_t *bytes;
    struct image_display display;
    float gain;
    struct thresholds thresholds;
};

struct image_display image_display_of(const struct ir_image *image) {
    return (struct image_display){image->tone, image->transfer, image->exposure};
}

// ---- tone

// Brighter than any picture, so that no product overflows.
#define BRIGHTEST 1e30

static float clamped(float c) {
    return c > 0 ? (c < 1 ? c : 1) : 0;
}

static void normalize(const float c[3], float out[3]) {
    float largest = 1;
    for (int i = 0; i < 3; i++)
        largest = c[i] > largest ? c[i] : largest;
    for (int i = 0; i < 3; i++) // also if both are infinite: the largest channel is full
        out[i] = largest > 1 && c[i] == largest ? 1 : clamped(c[i] / largest);
}

// Khronos PBR Neutral, version 1.0 of its specification (Khronos Group 2024).
static void neutral(const float c[3], float out[3]) {
    const double f90 = 0.04, start = 0.8 - f90, desaturation = 0.15, rest = 1 - start;
    double rgb[3];
    for (int i = 0; i < 3; i++)
        rgb[i] = fmin(fmax((double)c[i], 0), BRIGHTEST);
    const double least = fmin(rgb[0], fmin(rgb[1], rgb[2]));
    const double offset = least < 2 * f90 ? least - least * least / (4 * f90) : f90;
    const double peak = fmax(rgb[0], fmax(rgb[1], rgb[2])) - offset;
    const double shown = peak < start ? peak : 1 - rest * rest / (peak + rest - start);
    const double scale = peak < start ? 1 : shown / peak;
    const double white = peak < start ? 0 : 1 - 1 / (desaturation * (peak - shown) + 1);
    for (int i = 0; i < 3; i++)
        out[i] = clamped((float)((rgb[i] - offset) * scale * (1 - white) + shown * white));
}

// A fit to the curve of ACES (Narkowicz 2015), channel by channel.
static void filmic(const float c[3], float out[3]) {
    for (int i = 0; i < 3; i++) {
        const double x = fmin(fmax((double)c[i], 0), BRIGHTEST);
        out[i] = clamped((float)(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)));
    }
}

// What is shown of linear values, as linear values from 0 to 1. `gain`: of the exposure.
static void tone(const float linear[3], unsigned kind, float gain, float out[3]) {
    const float c[3] = {linear[0] * gain, linear[1] * gain, linear[2] * gain};
    if (kind == IR_TONE_NORMALIZE)
        normalize(c, out);
    else if (kind == IR_TONE_NEUTRAL)
        neutral(c, out);
    else if (kind == IR_TONE_FILMIC)
        filmic(c, out);
    else
        for (int i = 0; i < 3; i++)
            out[i] = clamped(c[i]);
}

static float gain_of(struct image_display display) {
    return (float)exp2(display.exposure);
}

// ---- pictures

static void convert_pixels(void *context, size_t begin, size_t end) {
    const struct conversion *job = context;
    for (size_t i = begin; i < end; i++) {
        const float *c = job->rgb + 3 * i;
        if (image_is_marked(c)) {
            memcpy(job->bytes + 3 * i, (uint8_t[3]){255, 0, 255}, 3);
            continue;
        }
        float shown[3];
        tone(c, job->display.tone, job->gain, shown);
        for (int k = 0; k < 3; k++) {
            const float value = shown[k];
            job->bytes[3 * i + (size_t)k] = job->display.transfer == IR_TRANSFER_SRGB
                                                ? threshold_byte(&job->thresholds, value)
                                                : round_to_byte(value);
        }
    }
}

void image_to_bytes(const struct image *image, struct image_display display, uint8_t *bytes) {
    struct conversion job = {.rgb = image->rgb, .bytes = bytes, .display = display, .gain = gain_of(display)};
    if (display.transfer == IR_TRANSFER_SRGB)
        thresholds_make(&job.thresholds);
    parallel_for((size_t)image->width * image->height, PIECE_PIXELS, convert_pixels, &job);
}

// For 16 bits there is no table: one power per channel.
static void word_pixels(void *context, size_t begin, size_t end) {
    const struct conversion *job = context;
    for (size_t i = begin; i < end; i++) {
        const float *c = job->rgb + 3 * i;
        const bool marked = image_is_marked(c);
        float shown[3] = {1, 0, 1};
        if (!marked)
            tone(c, job->display.tone, job->gain, shown);
        for (size_t k = 0; k < 3; k++) {
            const double value = (double)shown[k];
            const double encoded = job->display.transfer == IR_TRANSFER_SRGB ? srgb_encode(value) : value;
            const uint32_t word = (uint32_t)floor(65535 * encoded + 0.5);
            job->bytes[6 * i + 2 * k] = (uint8_t)(word >> 8);
            job->bytes[6 * i + 2 * k + 1] = (uint8_t)word;
        }
    }
}

void image_to_words(const struct image *image, struct image_display display, uint8_t *bytes) {
    struct conversion job = {.rgb = image->rgb, .bytes = bytes, .display = display, .gain = gain_of(display)};
    parallel_for((size_t)image->width * image->height, PIECE_PIXELS, word_pixels, &job);
}

struct displaying {
    const float *linear;
    float *displayed;
    struct image_display display;
    float gain;
};

static void display_pixels(void *context, size_t begin, size_t end) {
    const struct displaying *job = context;
    for (size_t i = begin; i < end; i++) {
        float shown[3];
        tone(job->linear + 3 * i, job->display.tone, job->gain, shown);
        for (size_t k = 0; k < 3; k++) {
            const float value = shown[k];
            job->displayed[3 * i + k] =
                job->display.transfer == IR_TRANSFER_SRGB ? (float)srgb_encode((double)value) : value;
        }
    }
}

void image_to_displayed(const float *linear, size_t pixels, struct image_display display, float *displayed) {
    struct displaying job = {linear, displayed, display, gain_of(display)};
    parallel_for(pixels, PIECE_PIXELS, display_pixels, &job);
}

// ---- what is cut off

static double brightest(const float c[3]) {
    return fmax((double)c[0], fmax((double)c[1], (double)c[2]));
}

double image_clipped(const struct image *image, struct image_display display, double least,
                     double *exposure) {
    const size_t pixels = image->rgb ? heap_times(image->width, image->height) : 0;
    const double most = (1 + 1.0 / 255) / (double)gain_of(display);
    const size_t dark = (size_t)ceil(0.995 * (double)pixels); // so many are shown
    size_t count = 0, taken = 0;
    for (size_t i = 0; display.tone == IR_TONE_CLIP && i < pixels; i++)
        count += brightest(image->rgb + 3 * i) > most;
    if (count == 0 || (double)count <= least * (double)pixels)
        return 0;
    double *values = heap_array(count, sizeof *values);
    for (size_t i = 0; values && i < pixels; i++)
        if (brightest(image->rgb + 3 * i) > most)
            values[taken++] = fmin(brightest(image->rgb + 3 * i), BRIGHTEST);
    if (!values || dark <= pixels - count) {
        free(values);
        return 0;
    }
    quantile_sort(values, count);
    *exposure = -log2(values[dark - (pixels - count) - 1]);
    free(values);
    return (double)count / (double)pixels;
}
