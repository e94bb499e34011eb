#include "assets/made/font.h"

#include "core/heap.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_MODULE_H
#include FT_OUTLINE_H
#include FT_SYSTEM_H

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    HEAP_MOST = 256 << 20, // bytes in one piece: a font can ask for any size
};

struct font {
    struct FT_MemoryRec_ memory;
    FT_Library library;
    FT_Face face;
};

static void *take(FT_Memory memory, long size) {
    (void)memory;
    return size > 0 && size <= HEAP_MOST ? heap_alloc((size_t)size) : NULL;
}

static void give(FT_Memory memory, void *block) {
    (void)memory;
    free(block);
}

static void *resize(FT_Memory memory, long before, long size, void *block) {
    (void)memory;
    (void)before;
    return size > 0 && size <= HEAP_MOST ? heap_resize(block, (size_t)size) : NULL;
}

bool font_is_built(void) {
    return true;
}

void font_close(struct font *font) {
    if (!font)
        return;
    if (font->face)
        FT_Done_Face(font->face);
    if (font->library)
        FT_Done_Library(font->library);
    free(font);
}

// The same files in every build, whatever else its FreeType reads.
static bool is_read(str bytes) {
    static const char *const marks[] = {"\0\1\0\0", "true", "OTTO", "ttcf"};
    for (size_t i = 0; i < sizeof marks / sizeof *marks; i++)
        if (bytes.len >= 4 && memcmp(bytes.ptr, marks[i], 4) == 0)
            return true;
    return false;
}

static bool open_face(struct font *font, str bytes) {
    if (!is_read(bytes) || bytes.len > LONG_MAX || FT_New_Library(&font->memory, &font->library) != 0)
        return false;
    FT_Add_Default_Modules(font->library);
    if (FT_New_Memory_Face(font->library, (const FT_Byte *)bytes.ptr, (FT_Long)bytes.len, 0, &font->face) !=
        0)
        return false;
    return FT_IS_SCALABLE(font->face) && font->face->units_per_EM > 0 && font->face->charmap;
}

struct font *font_open(str bytes) {
    struct font *font = heap_zeroed(1, sizeof *font);
    if (!font)
        return NULL;
    font->memory = (struct FT_MemoryRec_){NULL, take, give, resize};
    if (open_face(font, bytes))
        return font;
    font_close(font);
    return NULL;
}

uint32_t font_glyph(struct font *font, uint32_t character) {
    return FT_Get_Char_Index(font->face, character);
}

static enum font_point_kind kind_of(unsigned char tag) {
    return FT_CURVE_TAG(tag) == FT_CURVE_TAG_ON      ? FONT_ON
           : FT_CURVE_TAG(tag) == FT_CURVE_TAG_CONIC ? FONT_CONIC
                                                     : FONT_CUBIC;
}

static bool is_in_order(const FT_Outline *outline) {
    long last = -1;
    for (int i = 0; i < outline->n_contours; i++) {
        if ((long)outline->contours[i] < last || (long)outline->contours[i] >= (long)outline->n_points)
            return false;
        last = (long)outline->contours[i];
    }
    return true;
}

static bool copy_outline(const FT_Outline *outline, struct arena *arena, struct font_outline *out) {
    if (outline->n_points < 0 || outline->n_contours < 0 || !is_in_order(outline))
        return false;
    out->points = ARENA_ARRAY(arena, struct font_point, (size_t)outline->n_points);
    out->ends = ARENA_ARRAY(arena, uint32_t, (size_t)outline->n_contours);
    out->contour_count = (uint32_t)outline->n_contours;
    for (int i = 0; i < outline->n_contours; i++)
        out->ends[i] = (uint32_t)outline->contours[i];
    for (int i = 0; i < outline->n_points; i++) {
        const struct ir_pair at = {(double)outline->points[i].x, (double)outline->points[i].y};
        if (!(fabs(at.u) <= FONT_COORDINATE_MOST && fabs(at.v) <= FONT_COORDINATE_MOST))
            return false;
        out->points[i] = (struct font_point){at, kind_of((unsigned char)outline->tags[i])};
    }
    return true;
}

bool font_load(struct font *font, uint32_t glyph, struct arena *arena, struct font_outline *out,
               double *advance) {
    *out = (struct font_outline){0};
    if (FT_Load_Glyph(font->face, glyph, FT_LOAD_NO_SCALE | FT_LOAD_IGNORE_TRANSFORM) != 0)
        return false;
    const FT_GlyphSlot slot = font->face->glyph;
    *advance = (double)slot->advance.x;
    return slot->format == FT_GLYPH_FORMAT_OUTLINE && fabs(*advance) <= FONT_COORDINATE_MOST &&
           copy_outline(&slot->outline, arena, out);
}

double font_kerning(struct font *font, uint32_t left, uint32_t right) {
    FT_Vector by = {0, 0};
    if (!FT_HAS_KERNING(font->face) || FT_Get_Kerning(font->face, left, right, FT_KERNING_UNSCALED, &by) != 0)
        return 0;
    return fabs((double)by.x) <= FONT_COORDINATE_MOST ? (double)by.x : 0;
}

double font_em(const struct font *font) {
    return font->face->units_per_EM;
}

double font_line(const struct font *font) {
    return font->face->height > 0 ? font->face->height : font_em(font) * 1.2;
}
