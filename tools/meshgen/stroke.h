// Outlines of letters that are written as strokes of one width with round ends and joins.
//
// A letter is a text of strokes, in units of the font, along the middle of the pen:
//
//     M x y         begins a stroke; one that ends here is a dot
//     L x y         a line
//     h x y, v x y  a quarter of an oval that begins horizontally, or vertically
//     C x y x y x y a cubic curve
//     z             closes the stroke
//     |             right before M, or after the last piece: the pen's end is flat there (inside another
//     stroke)
//
// Contours are TrueType's: filled to the right of the way, by the nonzero rule, so that strokes may overlap.
// Curves turn by at least the pen's radius. Sizes are fixed: a letter that passes them is a programmer's
// mistake. Thread safety: one thread a glyph.
#ifndef GLINT_MESHGEN_STROKE_H
#define GLINT_MESHGEN_STROKE_H

#include <stdbool.h>

enum {
    GLYPH_POINTS_MAX = 512,
    GLYPH_CONTOURS_MAX = 16,
    STROKE_RADIUS = 45, // half of the width of a stroke
    STROKE_DOT = 58,    // radius of a dot
};

struct glyph_point {
    int x, y;
    bool on; // the curve; else the control point of a quadratic piece
};

struct glyph {
    struct glyph_point points[GLYPH_POINTS_MAX];
    int point_count;
    int ends[GLYPH_CONTOURS_MAX]; // the last point of each contour
    int contour_count;
    int left, bottom, right, top; // of all points
};

void stroke_glyph(const char *strokes, struct glyph *glyph);
// To the right by dx.
void glyph_move(struct glyph *glyph, int dx);

#endif
