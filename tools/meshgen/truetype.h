// A TrueType font in memory: letters of quadratic outlines, by their codes of Unicode up to U+FFFF.
//
// The unit is a thousandth of the em. The first letter stands for all that the font lacks; the others are by
// code. Tables are those that programs ask for: OS/2, cmap, glyf, head, hhea, hmtx, loca, maxp, name, post.
// Nothing depends on the time, so the same letters are the same bytes. Thread safety: none needed.
#ifndef GLINT_MESHGEN_TRUETYPE_H
#define GLINT_MESHGEN_TRUETYPE_H

#include "core/strbuf.h"
#include "tools/meshgen/stroke.h"

struct truetype_letter {
    int code;
    int advance;
    struct glyph glyph;
};

struct truetype_names {
    const char *family, *style, *postscript;
};

void truetype_write(const struct truetype_letter *letters, int count, const struct truetype_names *names,
                    struct strbuf *bytes);

#endif
