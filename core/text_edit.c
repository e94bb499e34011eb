#include "core/text_edit.h"

#include <stdlib.h>

static int by_order(const void *left, const void *right) {
    const struct text_edit *a = left, *b = right;
    return a->order < b->order ? -1 : a->order > b->order;
}

static int by_place(const void *left, const void *right) {
    const struct text_edit *a = left, *b = right;
    if (a->begin != b->begin)
        return a->begin < b->begin ? -1 : 1;
    return a->end < b->end ? -1 : a->end > b->end;
}

static bool collide(const struct text_edit *a, const struct text_edit *b) {
    if (a->begin == b->begin || a->end == b->end)
        return true;
    return a->begin < b->end && b->begin < a->end;
}

// Of edits that overlap, keeps those of the lowest order; returns their number.
static uint32_t settle_cluster(struct text_edit *edits, uint32_t count) {
    uint32_t kept = 0;
    if (count > 1)
        qsort(edits, count, sizeof *edits, by_order);
    for (uint32_t i = 0; i < count; i++) {
        bool free = true;
        for (uint32_t j = 0; j < kept && free; j++)
            free = !collide(&edits[i], &edits[j]);
        if (free)
            edits[kept++] = edits[i];
    }
    if (kept > 1)
        qsort(edits, kept, sizeof *edits, by_place);
    return kept;
}

// Whether an edit may collide with those before it, which end at `end`. Ranges that only touch do not (a line
// of nothing but comments has a thousand in a row); an insertion between them may.
static bool joins(const struct text_edit *edits, uint32_t i, uint32_t end) {
    const struct text_edit *edit = &edits[i];
    bool touches = edit->begin == end;
    bool insertion = edit->end == edit->begin || edits[i - 1].begin == edit->begin;
    return edit->begin < end || (touches && insertion);
}

uint32_t text_edits_settle(struct text_edit *edits, uint32_t count) {
    uint32_t kept = 0;
    if (count > 1)
        qsort(edits, count, sizeof *edits, by_place);
    for (uint32_t i = 0, n; i < count; i += n) {
        uint32_t end = edits[i].end;
        for (n = 1; i + n < count && joins(edits, i + n, end); n++)
            end = edits[i + n].end > end ? edits[i + n].end : end;
        uint32_t stay = settle_cluster(edits + i, n);
        for (uint32_t j = 0; j < stay; j++)
            edits[kept++] = edits[i + j];
    }
    return kept;
}

void text_edits_apply(str text, const struct text_edit *edits, uint32_t count, struct strbuf *out) {
    size_t at = 0;
    for (uint32_t i = 0; i < count; i++) {
        strbuf_str(out, str_slice(text, at, edits[i].begin));
        strbuf_str(out, edits[i].text);
        at = edits[i].end;
    }
    strbuf_str(out, str_slice(text, at, text.len));
}
