#include "core/parallel.h"
#include "core/srgb.h"
#include "picture/write/image.h"

#include <math.h>
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
    struct thresholds thresholds;
};

static float clamped(float c) {
    return c > 0 ? (c < 1 ? c : 1) : 0;
}

// The divisor of a colour's channels before clamping.
static float tone_divisor(const float c[3], unsigned tone) {
    float largest = 1;
    for (int i = 0; tone == IR_TONE_NORMALIZE && i < 3; i++)
        if (c[i] > largest)
            largest = c[i];
    return largest;
}

static float toned(float c, float divisor) {
    // Also if both are infinite: the largest channel is full.
    return divisor > 1 && c == divisor ? 1 : clamped(c / divisor);
}

static void convert_pixels(void *context, size_t begin, size_t end) {
    const struct conversion *job = context;
    for (size_t i = begin; i < end; i++) {
        const float *c = job->rgb + 3 * i;
        if (image_is_marked(c)) {
            memcpy(job->bytes + 3 * i, (uint8_t[3]){255, 0, 255}, 3);
            continue;
        }
        float divisor = tone_divisor(c, job->display.tone);
        for (int k = 0; k < 3; k++) {
            float value = toned(c[k], divisor);
            job->bytes[3 * i + (size_t)k] = job->display.transfer == IR_TRANSFER_SRGB
                                                ? threshold_byte(&job->thresholds, value)
                                                : round_to_byte(value);
        }
    }
}

void image_to_bytes(const struct image *image, struct image_display display, uint8_t *bytes) {
    struct conversion job = {.rgb = image->rgb, .display = display};
    job.bytes = bytes;
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
        const float divisor = tone_divisor(c, job->display.tone);
        for (size_t k = 0; k < 3; k++) {
            const double value = marked ? k != 1 : (double)toned(c[k], divisor);
            const double shown = job->display.transfer == IR_TRANSFER_SRGB ? srgb_encode(value) : value;
            const uint32_t word = (uint32_t)floor(65535 * shown + 0.5);
            job->bytes[6 * i + 2 * k] = (uint8_t)(word >> 8);
            job->bytes[6 * i + 2 * k + 1] = (uint8_t)word;
        }
    }
}

void image_to_words(const struct image *image, struct image_display display, uint8_t *bytes) {
    struct conversion job = {.rgb = image->rgb, .bytes = bytes, .display = display};
    parallel_for((size_t)image->width * image->height, PIECE_PIXELS, word_pixels, &job);
}

struct displaying {
    const float *linear;
    float *displayed;
    struct image_display display;
};

static void display_pixels(void *context, size_t begin, size_t end) {
    const struct displaying *job = context;
    for (size_t i = begin; i < end; i++) {
        const float *c = job->linear + 3 * i;
        const float divisor = tone_divisor(c, job->display.tone);
        for (size_t k = 0; k < 3; k++) {
            const float value = toned(c[k], divisor);
            job->displayed[3 * i + k] =
                job->display.transfer == IR_TRANSFER_SRGB ? (float)srgb_encode((double)value) : value;
        }
    }
}

void image_to_displayed(const float *linear, size_t pixels, struct image_display display, float *displayed) {
    struct displaying job = {linear, displayed, display};
    parallel_for(pixels, PIECE_PIXELS, display_pixels, &job);
}
