#include "render/aov/matte.h"

#include "core/heap.h"
#include "core/parallel.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    ROWS_A_PIECE = 16,
};

// In the order in which the samples see them; `count` 0: free.
struct matte_pixel {
    uint32_t bits[MATTE_KEPT];
    uint16_t counts[MATTE_KEPT];
};

// ---- names

static uint32_t turned(uint32_t value, int by) {
    return value << by | value >> (32 - by);
}

static uint32_t scrambled(uint32_t block) {
    return turned(block * UINT32_C(0xcc9e2d51), 15) * UINT32_C(0x1b873593);
}

uint32_t matte_hash(str name) {
    const uint8_t *bytes = (const uint8_t *)name.ptr;
    uint32_t hash = 0, block = 0;
    for (size_t i = 0; i < name.len; i++) {
        block |= (uint32_t)bytes[i] << 8 * (i % 4);
        if (i % 4 == 3) {
            hash = turned(hash ^ scrambled(block), 13) * 5 + UINT32_C(0xe6546b64);
            block = 0;
        }
    }
    hash ^= scrambled(block); // 0 if no bytes are left
    hash ^= (uint32_t)name.len;
    hash = (hash ^ hash >> 16) * UINT32_C(0x85ebca6b);
    hash = (hash ^ hash >> 13) * UINT32_C(0xc2b2ae35);
    return hash ^ hash >> 16;
}

uint32_t matte_bits(uint32_t hash) {
    const uint32_t exponent = hash >> 23 & 255;
    return exponent == 0 || exponent == 255 ? hash ^ UINT32_C(1) << 23 : hash;
}

void matte_key(str layer, char key[8]) {
    char digits[9];
    snprintf(digits, sizeof digits, "%08x", matte_hash(layer));
    memcpy(key, digits, 7);
    key[7] = '\0';
}

// ---- pixels

bool matte_init(struct matte *matte, uint32_t width, uint32_t height) {
    *matte = (struct matte){.width = width, .height = height};
    matte->pixels = heap_zeroed(heap_times(width, height), sizeof *matte->pixels);
    return matte->pixels != NULL;
}

void matte_finish(struct matte *matte) {
    free(matte->pixels);
    free(matte->ranks);
    matte->pixels = NULL;
    matte->ranks = NULL;
}

// Where all places are taken, the name with the fewest samples makes room.
void matte_add(struct matte *matte, size_t pixel, uint32_t bits) {
    struct matte_pixel *p = &matte->pixels[pixel];
    int least = 0;
    if (bits == 0)
        return;
    for (int i = 0; i < MATTE_KEPT; i++) {
        if (p->counts[i] == 0 || p->bits[i] == bits) {
            p->bits[i] = bits;
            p->counts[i]++;
            return;
        }
        least = p->counts[i] < p->counts[least] ? i : least;
    }
    p->bits[least] = bits;
    p->counts[least] = 1;
}

// The largest coverage first, equal ones by their bits: so results do not depend on the order of samples.
static bool is_before(const struct matte_pixel *p, int a, int b) {
    return p->counts[a] != p->counts[b] ? p->counts[a] > p->counts[b] : p->bits[a] < p->bits[b];
}

static void rank_pixel(const struct matte *matte, size_t pixel) {
    const struct matte_pixel *p = &matte->pixels[pixel];
    float *out = matte->ranks + pixel * 2 * MATTE_RANKS;
    for (int i = 0; i < MATTE_KEPT && p->counts[i]; i++) {
        int rank = 0;
        for (int j = 0; j < MATTE_KEPT && p->counts[j]; j++)
            rank += j != i && is_before(p, j, i);
        if (rank >= MATTE_RANKS)
            continue;
        memcpy(&out[2 * rank], &p->bits[i], sizeof *out);
        out[2 * rank + 1] = (float)p->counts[i] / (float)matte->samples;
    }
}

static void rank_rows(void *context, size_t begin, size_t end) {
    const struct matte *matte = context;
    for (size_t pixel = begin * matte->width; pixel < end * matte->width; pixel++)
        rank_pixel(matte, pixel);
}

bool matte_end(struct matte *matte, uint32_t samples) {
    matte->samples = samples;
    matte->ranks = heap_zeroed(heap_times(matte->width, matte->height), sizeof(float[2 * MATTE_RANKS]));
    if (matte->ranks)
        parallel_for(matte->height, ROWS_A_PIECE, rank_rows, matte);
    return matte->ranks != NULL;
}
