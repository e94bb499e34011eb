// Pixels for a window: a picture, enlarged where it has fewer pixels, and text over it.
//
// Pixels are four bytes: blue, green, red, 255; rows from the top. Text is ASCII in a font of glint's own, of
// 5 x 7 dots; other characters are shown as '?'. Ownership: canvas_finish frees. Errors: false if memory
// ran out. Thread safety: a canvas belongs to one thread.
#ifndef GLINT_WINDOW_CANVAS_H
#define GLINT_WINDOW_CANVAS_H

#include "core/str.h"

struct canvas {
    uint32_t width, height;
    uint8_t *pixels;
};

enum {
    CANVAS_GLYPH_WIDTH = 6, // dots, with the gap
    CANVAS_GLYPH_HEIGHT = 9,
};

// Makes room for another size; what it shows is lost.
bool canvas_resize(struct canvas *canvas, uint32_t width, uint32_t height);
void canvas_finish(struct canvas *canvas);
// Fills the canvas with a picture of width * height * 3 bytes, red first, taking the nearest pixel.
void canvas_put_picture(struct canvas *canvas, const uint8_t *rgb, uint32_t width, uint32_t height);
// A box of one colour, 0xrrggbb; what lies outside the canvas is left out.
void canvas_fill(struct canvas *canvas, uint32_t x, uint32_t y, uint32_t width, uint32_t height,
                 uint32_t rgb);
// A darker box; what lies outside the canvas is left out.
void canvas_darken(struct canvas *canvas, uint32_t x, uint32_t y, uint32_t width, uint32_t height);
// A line of text whose upper left corner is x, y; each dot is `scale` pixels wide. What does not fit is left
// out.
void canvas_put_text(struct canvas *canvas, uint32_t x, uint32_t y, uint32_t scale, uint32_t rgb, str text);
// Lines of text in a dark box of their size, at the upper left or, `is_below`, along the lower edge.
void canvas_put_lines(struct canvas *canvas, const str *lines, uint32_t count, uint32_t scale, uint32_t rgb,
                      bool is_below);

#endif
