// Chooses the filter for each row of a PNG, and filters the row.
#include "core/heap.h"
#include "core/parallel.h"
#include "picture/write/png_data.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum {
    PIXEL_MOST = 6,
    FILTERS = 5,
    ROWS = 16,    // of a piece of work
    BLOCK = 4096, // bytes whose sum fits 32 bits
};

struct filtering {
    size_t row_bytes, pixel;
    const uint8_t *rgb, *above; // above: the row before the first; NULL: there is none
    uint8_t *out;
    atomic_bool failed;
};

// A row and the one above it, each after a pixel of zeros; and the row after each filter.
struct rows {
    uint8_t *row, *above;
    uint8_t *through[FILTERS];
};

static uint8_t size_of(uint8_t difference) {
    return difference < 128 ? difference : (uint8_t)(256 - difference);
}

static size_t sum_of_sizes(const uint8_t *bytes, size_t count) {
    size_t sum = 0;
    for (size_t begin = 0; begin < count; begin += BLOCK) {
        const size_t end = count - begin < BLOCK ? count : begin + BLOCK;
        uint32_t part = 0;
        for (size_t i = begin; i < end; i++)
            part += size_of(bytes[i]);
        sum += part;
    }
    return sum;
}

static int distance(int a, int b) {
    return a < b ? b - a : a - b;
}

// Returns whichever of left, above and above left is nearest to left + above - above left (clause 9.4).
static uint8_t paeth(int a, int b, int c) {
    const int to_a = distance(b, c), to_b = distance(a, c), to_c = distance(a + b, 2 * c);
    const int other = to_b <= to_c ? b : c;
    return (uint8_t)(to_a <= to_b && to_a <= to_c ? a : other);
}

// All filters but the one that changes nothing.
static void filter(const struct rows *rows, size_t count, size_t pixel) {
    const uint8_t *x = rows->row, *a = x - pixel, *b = rows->above, *c = b - pixel;
    uint8_t *sub = rows->through[1], *up = rows->through[2], *average = rows->through[3],
            *nearest = rows->through[4];
    for (size_t i = 0; i < count; i++)
        sub[i] = (uint8_t)(x[i] - a[i]);
    for (size_t i = 0; i < count; i++)
        up[i] = (uint8_t)(x[i] - b[i]);
    for (size_t i = 0; i < count; i++)
        average[i] = (uint8_t)(x[i] - ((a[i] + b[i]) >> 1));
    for (size_t i = 0; i < count; i++)
        nearest[i] = (uint8_t)(x[i] - paeth(a[i], b[i], c[i]));
}

static void put_best(const struct rows *rows, size_t count, uint8_t *to) {
    size_t least = SIZE_MAX;
    uint8_t best = 0;
    for (uint8_t i = 0; i < FILTERS; i++) {
        const size_t sum = sum_of_sizes(rows->through[i], count);
        if (sum < least) {
            least = sum;
            best = i;
        }
    }
    *to = best;
    memcpy(to + 1, rows->through[best], count);
}

static void filter_rows(void *context, size_t begin, size_t end) {
    struct filtering *f = context;
    const size_t count = f->row_bytes;
    uint8_t *memory = heap_zeroed(FILTERS + 1, count + PIXEL_MOST);
    if (!memory) {
        f->failed = true;
        return;
    }
    struct rows rows = {.row = memory + PIXEL_MOST, .above = memory + count + (size_t)2 * PIXEL_MOST};
    rows.through[0] = rows.row;
    for (size_t i = 1; i < FILTERS; i++)
        rows.through[i] = memory + (i + 1) * (count + PIXEL_MOST);
    const uint8_t *above = begin > 0 ? f->rgb + (begin - 1) * count : f->above;
    if (above)
        memcpy(rows.above, above, count);
    for (size_t y = begin; y < end; y++) {
        memcpy(rows.row, f->rgb + y * count, count);
        filter(&rows, count, f->pixel);
        put_best(&rows, count, f->out + y * (count + 1));
        uint8_t *row = rows.above;
        rows.above = rows.row;
        rows.through[0] = rows.row = row;
    }
    free(memory);
}

bool png_filter_rows(uint32_t width, uint32_t height, uint32_t pixel, const uint8_t *rgb,
                     const uint8_t *above, uint8_t *filtered) {
    struct filtering f = {
        .row_bytes = (size_t)pixel * width, .pixel = pixel, .rgb = rgb, .above = above, .out = filtered};
    parallel_for(height, ROWS, filter_rows, &f);
    return !f.failed;
}
