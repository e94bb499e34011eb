// The copy of a text in which mistakes are overwritten, and the places of these.
#include "parser/tree/reader_text.h"

#include <stdlib.h>
#include <string.h>

void reader_text_put(const struct reader_context *context, struct reader_text *text, uint32_t begin,
                     str replacement) {
    if (!text->copy) {
        text->copy = arena_alloc(context->arena, text->bytes.len + 1);
        memcpy(text->copy, text->bytes.ptr, text->bytes.len);
        text->bytes.ptr = text->copy;
    }
    memcpy(text->copy + begin, replacement.ptr, replacement.len);
}

void reader_text_mark(const struct reader_context *context, struct reader_text *text, uint32_t begin,
                      uint32_t end) {
    if (text->bad.count && text->bad.items[text->bad.count - 1].end == begin) {
        text->bad.items[text->bad.count - 1].end = end;
        return;
    }
    struct reader_range *range = ARENA_PUSH(context->arena, &text->bad);
    *range = (struct reader_range){begin, end};
}

static int compare_ranges(const void *a, const void *b) {
    const struct reader_range *left = a, *right = b;
    return (left->begin > right->begin) - (left->begin < right->begin);
}

void reader_text_seal(struct reader_text *text) {
    if (text->bad.count > 1)
        qsort(text->bad.items, text->bad.count, sizeof *text->bad.items, compare_ranges);
}

bool reader_text_is_bad(const struct reader_text *text, uint32_t begin, uint32_t end) {
    uint32_t low = 0, high = text->bad.count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (text->bad.items[middle].end <= begin)
            low = middle + 1;
        else
            high = middle;
    }
    return low < text->bad.count && text->bad.items[low].begin < end;
}
