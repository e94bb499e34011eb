// A build without FreeType: no font opens.
#include "assets/made/font.h"

bool font_is_built(void) {
    return false;
}

struct font *font_open(str bytes) {
    (void)bytes;
    return NULL;
}

void font_close(struct font *font) {
    (void)font;
}

uint32_t font_glyph(struct font *font, uint32_t character) {
    (void)font;
    (void)character;
    return 0;
}

bool font_load(struct font *font, uint32_t glyph, struct arena *arena, struct font_outline *out,
               double *advance) {
    (void)font;
    (void)glyph;
    (void)arena;
    *out = (struct font_outline){0};
    *advance = 0;
    return false;
}

double font_kerning(struct font *font, uint32_t left, uint32_t right) {
    (void)font;
    (void)left;
    (void)right;
    return 0;
}

double font_line(const struct font *font) {
    (void)font;
    return 1;
}

double font_em(const struct font *font) {
    (void)font;
    return 1;
}
