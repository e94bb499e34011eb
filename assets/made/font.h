// Fonts by FreeType: glyphs with their outlines, advances and kerning, in the font's own units.
//
// The only file that includes FreeType is font.c; a build without it has no_font.c, which opens nothing.
// Input: the bytes of a font file, which must stay while the font is open; hostile ones do no harm: FreeType
// gets at most some hundred megabytes. Output: points as the font has them, not hinted. Units: a few hundred
// to a few thousand per em; y upwards. Ownership: font_close frees what font_open made; outlines are in the
// arena. Thread safety: one font belongs to one thread.
#ifndef GLINT_ASSETS_MADE_FONT_H
#define GLINT_ASSETS_MADE_FONT_H

#include "core/arena.h"
#include "grammar/ir_value.h"

#define FONT_COORDINATE_MOST 1048576.0

struct font;

enum font_point_kind {
    FONT_ON,    // on the outline
    FONT_CONIC, // a control point of quadratic curves; two in a row have a point on the outline between them
    FONT_CUBIC, // one of two control points of a cubic curve
};

struct font_point {
    struct ir_pair at;
    enum font_point_kind kind;
};

struct font_outline {
    struct font_point *points;
    uint32_t *ends; // of each contour: its last point
    uint32_t contour_count;
};

bool font_is_built(void);
// NULL: not a font, or one without outlines.
struct font *font_open(str bytes);
void font_close(struct font *font); // NULL does nothing
// 0: the font has none for this character.
uint32_t font_glyph(struct font *font, uint32_t character);
// false: broken. Glyphs such as the space's have no contours.
bool font_load(struct font *font, uint32_t glyph, struct arena *arena, struct font_outline *out,
               double *advance);
double font_kerning(struct font *font, uint32_t left, uint32_t right);
// From one baseline to the next; more than 0.
double font_line(const struct font *font);
// The em, by which the heights of fonts without capital letters are guessed; more than 0.
double font_em(const struct font *font);

#endif
