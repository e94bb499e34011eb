#include "window/canvas.h"

#include "core/heap.h"
#include "core/parallel.h"
#include "window/font.h"

#include <stdlib.h>

enum {
    ROWS_A_PIECE = 64,
    MARGIN = 4, // of a box around its text, in dots
};

bool canvas_resize(struct canvas *canvas, uint32_t width, uint32_t height) {
    if (canvas->pixels && canvas->width == width && canvas->height == height)
        return true;
    canvas_finish(canvas);
    canvas->pixels = heap_zeroed(heap_times(width, height), 4);
    if (!canvas->pixels)
        return false;
    canvas->width = width;
    canvas->height = height;
    return true;
}

void canvas_finish(struct canvas *canvas) {
    free(canvas->pixels);
    *canvas = (struct canvas){0};
}

// ---- the picture

struct putting {
    struct canvas *canvas;
    const uint8_t *rgb;
    uint32_t width, height;
};

static void put_rows(void *context, size_t begin, size_t end) {
    const struct putting *p = context;
    const struct canvas *canvas = p->canvas;
    for (size_t y = begin; y < end; y++) {
        const uint8_t *row = p->rgb + 3 * (size_t)p->width * (y * p->height / canvas->height);
        uint8_t *to = canvas->pixels + 4 * canvas->width * y;
        for (size_t x = 0; x < canvas->width; x++, to += 4) {
            const uint8_t *from = row + 3 * (x * p->width / canvas->width);
            to[0] = from[2];
            to[1] = from[1];
            to[2] = from[0];
            to[3] = UINT8_MAX;
        }
    }
}

void canvas_put_picture(struct canvas *canvas, const uint8_t *rgb, uint32_t width, uint32_t height) {
    struct putting putting = {canvas, rgb, width, height};
    parallel_for(canvas->height, ROWS_A_PIECE, put_rows, &putting);
}

// ---- text

static uint32_t least(uint32_t a, uint32_t b) {
    return a < b ? a : b;
}

void canvas_darken(struct canvas *canvas, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
    const uint32_t right = least(x + width, canvas->width), below = least(y + height, canvas->height);
    for (uint32_t row = y; row < below; row++)
        for (uint32_t at = x; at < right; at++)
            for (int c = 0; c < 3; c++)
                canvas->pixels[4 * ((size_t)row * canvas->width + at) + (size_t)c] /= 4;
}

void canvas_fill(struct canvas *canvas, uint32_t x, uint32_t y, uint32_t width, uint32_t height,
                 uint32_t rgb) {
    const uint32_t right = least(x + width, canvas->width), below = least(y + height, canvas->height);
    for (uint32_t row = y; row < below; row++)
        for (uint32_t at = x; at < right; at++) {
            uint8_t *to = canvas->pixels + 4 * ((size_t)row * canvas->width + at);
            to[0] = (uint8_t)rgb;
            to[1] = (uint8_t)(rgb >> 8);
            to[2] = (uint8_t)(rgb >> 16);
        }
}

static const char *glyph_of(char character) {
    const int at = (unsigned char)character - FONT_FIRST;
    return font_dots[at >= 0 && at < FONT_COUNT ? at : '?' - FONT_FIRST];
}

void canvas_put_text(struct canvas *canvas, uint32_t x, uint32_t y, uint32_t scale, uint32_t rgb, str text) {
    for (size_t i = 0; i < text.len && x < canvas->width; i++, x += CANVAS_GLYPH_WIDTH * scale) {
        const char *dots = glyph_of(text.ptr[i]);
        for (uint32_t k = 0; k < FONT_WIDTH * FONT_HEIGHT; k++)
            if (dots[k] == '#')
                canvas_fill(canvas, x + k % FONT_WIDTH * scale, y + k / FONT_WIDTH * scale, scale, scale,
                            rgb);
    }
}

void canvas_put_lines(struct canvas *canvas, const str *lines, uint32_t count, uint32_t scale, uint32_t rgb,
                      bool is_below) {
    const uint32_t margin = MARGIN * scale, line = CANVAS_GLYPH_HEIGHT * scale;
    const uint32_t height = count * line + 2 * margin;
    const uint32_t top = is_below && canvas->height > height ? canvas->height - height : 0;
    size_t longest = 0;
    for (uint32_t i = 0; i < count; i++)
        longest = lines[i].len > longest ? lines[i].len : longest;
    const uint32_t width =
        is_below
            ? canvas->width
            : (uint32_t)least((uint32_t)longest, canvas->width) * CANVAS_GLYPH_WIDTH * scale + 2 * margin;
    canvas_darken(canvas, 0, top, width, height);
    for (uint32_t i = 0; i < count; i++)
        canvas_put_text(canvas, margin, top + margin + i * line, scale, rgb, lines[i]);
}
