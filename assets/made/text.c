#include "assets/made/made.h"

#include "assets/made/arrange.h"
#include "assets/made/fault.h"
#include "assets/made/layout.h"

// Of the font's unit: finer than any tolerance shows, and exact for lines of any length.
#define GRID 0x1p-16

bool made_has_fonts(void) {
    return font_is_built();
}

static struct ir_pair on_grid(struct ir_pair at, struct ir_pair offset) {
    return (struct ir_pair){rint((at.u + offset.u) / GRID) * GRID, rint((at.v + offset.v) / GRID) * GRID};
}

static void take_contour(struct arrange *arrange, const struct path *path, struct ir_pair offset) {
    const uint32_t first = arrange->points.count;
    for (uint32_t i = 0; i < path->count; i++) {
        const struct path_piece *piece = &path->pieces[i];
        const uint32_t next = i + 1 < path->count ? first + i + 1 : first;
        arrange->looks[arrange->edges.count] =
            (struct prism_look){{piece->along_from, piece->along_to},
                                {piece->length_before / path->length, piece->length_after / path->length}};
        arrange->points.items[arrange->points.count++] = on_grid(piece->from, offset);
        arrange->edges.items[arrange->edges.count++] = (struct region_edge){first + i, next};
    }
}

static struct arrange take_layout(const struct layout *layout, struct arena *arena) {
    struct arrange arrange = {.arena = arena, .grid = GRID};
    uint32_t count = 0;
    for (uint32_t i = 0; i < layout->contours.count; i++)
        count += layout->contours.items[i].count;
    arrange.points.items = ARENA_ARRAY(arena, struct ir_pair, count);
    arrange.points.capacity = count;
    arrange.edges.items = ARENA_ARRAY(arena, struct region_edge, count);
    arrange.edges.capacity = count;
    arrange.looks = ARENA_ARRAY(arena, struct prism_look, count);
    for (uint32_t i = 0; i < layout->contours.count; i++)
        take_contour(&arrange, &layout->contours.items[i], layout->offsets.items[i]);
    return arrange;
}

struct work {
    const struct made_text *text;
    const struct made_to *to;
    struct made *out;
    struct font *font;
    bool done;
};

static bool build(struct work *work) {
    struct arena *arena = work->to->arena;
    struct made_fault *fault = &work->out->fault;
    struct layout layout;
    if (!layout_make(&layout, work->font, work->text, arena, fault))
        return false;
    if (layout.contours.count == 0)
        return made_fail(fault, MADE_TEXT_EMPTY, "the text has nothing to draw");
    struct arrange arrange = take_layout(&layout, arena);
    struct region region;
    if (!arrange_run(&arrange, &region))
        return made_fail(fault, MADE_GLYPH_BROKEN, "the outlines of the letters cross too often");
    if (region.side_count == 0)
        return made_fail(fault, MADE_TEXT_EMPTY, "the text has nothing to draw");
    const struct prism prism = {&region, arrange.looks, work->text->height / layout.cap_height,
                                work->text->depth, work->text->bevel};
    return prism_build(&prism, work->to, work->out);
}

static void run(void *context) {
    struct work *work = context;
    work->done = build(work);
}

static bool check(const struct made_text *text, struct made_fault *fault) {
    if (!made_check_size(text->height, "the height", fault) ||
        !made_check_size(text->depth, "the depth", fault) ||
        !made_check_bevel(text->bevel, text->depth, "depth", fault) ||
        !made_check_tolerance(text->tolerance, fault))
        return false;
    if (text->text.len > MADE_TEXT_MOST)
        return made_fail(fault, MADE_POINTS_MANY, "a text has at most %d bytes", (int)MADE_TEXT_MOST);
    const size_t error = utf8_first_error(text->text);
    if (error >= text->text.len)
        return true;
    fault->points[0] = (uint32_t)error;
    return made_fail(fault, MADE_TEXT, "byte %zu of the text is not UTF-8", error + 1);
}

bool made_build_text(const struct made_text *text, const struct made_to *to, struct made *out) {
    made_begin(out);
    if (!check(text, &out->fault))
        return false;
    if (!font_is_built())
        return made_fail(&out->fault, MADE_NO_FONTS, "this build of glint reads no fonts (GLINT_FONTS=OFF)");
    // The font is not the arena's: it must be closed even if memory ends.
    struct work work = {.text = text, .to = to, .out = out, .font = font_open(text->font)};
    if (!work.font)
        return made_fail(&out->fault, MADE_FONT, "this is not a font with outlines that glint reads");
    const enum arena_fault fault = arena_guarded(to->arena, run, &work);
    font_close(work.font);
    if (fault != ARENA_FAULT_NONE)
        arena_raise(to->arena, fault);
    return work.done;
}
