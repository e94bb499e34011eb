#include "assets/made/layout.h"

#include "assets/made/fault.h"
#include "core/unicode.h"

#define CAP_HEIGHT_USUAL 0.7 // of the em

struct writing {
    struct layout *out;
    struct font *font;
    const struct made_text *text;
    struct arena *arena;
    struct made_fault *fault;
    struct ir_pair pen;
    uint32_t line_first; // contour
    uint32_t last_glyph; // 0: none in this line
    uint64_t pieces;
};

static double top_of(const struct font_outline *outline) {
    double top = 0;
    const uint32_t count = outline->contour_count ? outline->ends[outline->contour_count - 1] + 1 : 0;
    for (uint32_t i = 0; i < count; i++)
        top = fmax(top, outline->points[i].at.v);
    return top;
}

static double find_cap_height(struct font *font, struct arena *arena) {
    struct font_outline outline;
    double advance;
    const uint32_t glyph = font_glyph(font, 'H');
    const double top = glyph && font_load(font, glyph, arena, &outline, &advance) ? top_of(&outline) : 0;
    return top > 0 ? top : font_em(font) * CAP_HEIGHT_USUAL;
}

static void end_line(struct writing *w) {
    const double shares[] = {[MADE_ALIGN_LEFT] = 0, [MADE_ALIGN_CENTER] = 0.5, [MADE_ALIGN_RIGHT] = 1};
    const double by = w->pen.u * shares[w->text->align];
    for (uint32_t i = w->line_first; i < w->out->offsets.count; i++)
        w->out->offsets.items[i].u -= by;
    w->line_first = w->out->offsets.count;
    w->pen = (struct ir_pair){0, w->pen.v - font_line(w->font)};
    w->last_glyph = 0;
}

static bool fail_at(struct writing *w, size_t at, enum made_code code, const char *what) {
    const uint32_t c = utf8_decode(w->text->text, at);
    const str bytes = str_slice(w->text->text, at, at + utf8_sequence_length(w->text->text, at));
    const unsigned long long number = utf8_count(str_slice(w->text->text, 0, at)) + 1;
    w->fault->points[0] = (uint32_t)at;
    if (unicode_is_control(c))
        return made_fail(w->fault, code, "%s U+%04X, character %llu of the text", what, (unsigned)c, number);
    return made_fail(w->fault, code, "%s '%.*s' (U+%04X), character %llu of the text", what, STR_ARG(bytes),
                     (unsigned)c, number);
}

static bool add_glyph(struct writing *w, uint32_t glyph, size_t at) {
    struct font_outline outline;
    double advance;
    struct contours *contours = &w->out->contours;
    const uint32_t before = contours->count;
    if (!font_load(w->font, glyph, w->arena, &outline, &advance) ||
        !contours_add(contours, &outline, w->text->tolerance * w->out->cap_height, w->arena))
        return fail_at(w, at, MADE_GLYPH_BROKEN, "the font has a broken outline for");
    if (w->last_glyph)
        w->pen.u += font_kerning(w->font, w->last_glyph, glyph);
    for (uint32_t i = before; i < contours->count; i++) {
        w->pieces += contours->items[i].count;
        *ARENA_PUSH(w->arena, &w->out->offsets) = w->pen;
    }
    w->pen.u += advance;
    w->last_glyph = glyph;
    if (w->pieces <= MADE_POINTS_MOST)
        return true;
    return made_fail(w->fault, MADE_POINTS_MANY, "the letters need more than %d straight pieces",
                     (int)MADE_POINTS_MOST);
}

static bool add_character(struct writing *w, size_t at) {
    const uint32_t c = utf8_decode(w->text->text, at);
    if (c == '\n') {
        end_line(w);
        return true;
    }
    const uint32_t glyph = font_glyph(w->font, c);
    if (glyph == 0)
        return fail_at(w, at, MADE_GLYPH, "the font has no glyph for");
    return add_glyph(w, glyph, at);
}

static bool is_before_feed(str text, size_t at) {
    return text.ptr[at] == '\r' && at + 1 < text.len && text.ptr[at + 1] == '\n';
}

bool layout_make(struct layout *layout, struct font *font, const struct made_text *text, struct arena *arena,
                 struct made_fault *fault) {
    struct writing w = {.out = layout, .font = font, .text = text, .arena = arena, .fault = fault};
    *layout = (struct layout){.cap_height = find_cap_height(font, arena)};
    for (size_t at = 0; at < text->text.len; at += utf8_sequence_length(text->text, at))
        if (!is_before_feed(text->text, at) && !add_character(&w, at))
            return false;
    end_line(&w);
    return true;
}
