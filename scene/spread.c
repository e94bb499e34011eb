#include "scene/spread.h"

#include "core/splitmix.h"

#include <math.h>

static uint32_t at_least(uint32_t pixels, uint32_t cells) {
    return pixels < cells ? pixels : cells;
}

struct spread spread_make(uint32_t width, uint32_t height, uint32_t cells) {
    struct spread spread = {width, height, width, height};
    if ((uint64_t)width * height <= 2 * (uint64_t)cells)
        return spread;
    const double across = sqrt((double)cells * width / height);
    spread.columns = at_least(width, (uint32_t)fmax(1, ceil(across)));
    spread.lines = at_least(height, (cells + spread.columns - 1) / spread.columns);
    spread.columns = at_least(width, (cells + spread.lines - 1) / spread.lines);
    return spread;
}

// A pixel of cell `index` of `cells` along one side of the picture. The place is drawn before it is rounded
// to a pixel: otherwise cells of two and three pixels would not give all pixels the same chance.
static uint32_t pixel_in(uint32_t index, uint32_t cells, uint32_t pixels, uint32_t random) {
    if (cells == pixels)
        return index;
    const double place = (index + random * 0x1p-32) * pixels / cells;
    return place < pixels ? (uint32_t)place : pixels - 1;
}

void spread_pixel(const struct spread *spread, uint32_t cell, uint32_t *x, uint32_t *y) {
    const uint64_t random = splitmix((uint64_t)spread->columns << 32 | cell);
    *x = pixel_in(cell % spread->columns, spread->columns, spread->width, (uint32_t)random);
    *y = pixel_in(cell / spread->columns, spread->lines, spread->height, (uint32_t)(random >> 32));
}
