#include "core/diag.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SINK_BYTES_MAX = 64 * 1024 * 1024 };

#define SEVERITY(code) (code[0] == 'E' ? DIAG_ERROR : code[0] == 'W' ? DIAG_WARNING : DIAG_NOTE)

static const struct diag_info infos[DIAG_CODE_COUNT] = {
#define X(NAME, code, where, title, meaning, remedy) {#NAME, #code, SEVERITY(#code), where, title, meaning, remedy},
#include "core/diag_codes.def"
#undef X
};

const struct diag_info *diag_info(enum diag_code code) { return &infos[code]; }

enum diag_code diag_find(str code) {
    for (int i = 0; i < DIAG_CODE_COUNT; i++)
        if (code.len == strlen(infos[i].code) && str_ends_with_nocase(code, infos[i].code))
            return (enum diag_code)i;
    return DIAG_CODE_COUNT;
}

void diag_sink_init(struct diag_sink *sink) {
    *sink = (struct diag_sink){0};
    arena_init(&sink->arena, SINK_BYTES_MAX);
}

void diag_sink_finish(struct diag_sink *sink) {
    if (!sink)
        return;
    arena_finish(&sink->arena);
    *sink = (struct diag_sink){0};
}

// Formats without the guard: a sink that is full must not jump out of its user.
static str format_text(struct diag_sink *sink, const char *format, va_list args) {
    va_list again;
    va_copy(again, args);
    int length = vsnprintf(NULL, 0, format, args);
    char *text = length < 0 ? NULL : arena_try_alloc(&sink->arena, (size_t)length + 1);
    if (text)
        vsnprintf(text, (size_t)length + 1, format, again);
    va_end(again);
    return text ? (str){text, (size_t)length} : STR("");
}

static struct diag *push(struct diag_sink *sink) {
    if (sink->count == sink->capacity) {
        uint32_t capacity = sink->capacity ? sink->capacity * 2 : 16;
        struct diag *items = arena_try_alloc(&sink->arena, capacity * sizeof *items);
        if (!items)
            return NULL;
        if (sink->count)
            memcpy(items, sink->items, sink->count * sizeof *items);
        sink->items = items;
        sink->capacity = capacity;
    }
    return &sink->items[sink->count++];
}

static void count(struct diag_sink *sink, enum diag_severity severity) {
    if (severity == DIAG_ERROR)
        sink->errors++;
    else if (severity == DIAG_WARNING)
        sink->warnings++;
    else
        sink->notes++;
}

struct diag *diag_add(struct diag_sink *sink, enum diag_code code, span at, const char *format, ...) {
    count(sink, infos[code].severity);
    va_list args;
    va_start(args, format);
    str message = format_text(sink, format, args);
    va_end(args);
    struct diag *item = push(sink);
    if (!item) {
        sink->dropped++;
        return &sink->items[sink->count - 1];
    }
    *item = (struct diag){.code = code, .at = at, .message = message};
    return item;
}

void diag_note(struct diag_sink *sink, span at, const char *format, ...) {
    struct diag_related *note = arena_try_alloc(&sink->arena, sizeof *note);
    if (!note || sink->count == 0)
        return;
    va_list args;
    va_start(args, format);
    *note = (struct diag_related){.at = at, .message = format_text(sink, format, args)};
    va_end(args);
    struct diag_related **end = &sink->items[sink->count - 1].notes;
    while (*end)
        end = &(*end)->next;
    *end = note;
}

void diag_help(struct diag_sink *sink, const char *format, ...) {
    if (sink->count == 0)
        return;
    va_list args;
    va_start(args, format);
    sink->items[sink->count - 1].help = format_text(sink, format, args);
    va_end(args);
}

void diag_fix(struct diag_sink *sink, bool safe, span at, str replacement) {
    char *text = arena_try_alloc(&sink->arena, replacement.len + 1);
    if (!text || sink->count == 0)
        return;
    if (replacement.len)
        memcpy(text, replacement.ptr, replacement.len);
    struct diag *item = &sink->items[sink->count - 1];
    item->has_fix = true;
    item->fix_is_safe = safe;
    item->fix_at = at;
    item->fix_text = (str){text, replacement.len};
}

static int compare_place(const struct diag *a, const struct diag *b) {
    if (a->at.source != b->at.source)
        return a->at.source < b->at.source ? -1 : 1;
    if (a->at.begin != b->at.begin)
        return a->at.begin < b->at.begin ? -1 : 1;
    return 0;
}

// Merge sort: stable, so that equal places keep their order of report.
static void sort_items(struct diag *items, struct diag *spare, size_t n) {
    if (n < 2)
        return;
    size_t half = n / 2;
    sort_items(items, spare, half);
    sort_items(items + half, spare, n - half);
    memcpy(spare, items, n * sizeof *items);
    size_t left = 0;
    size_t right = half;
    for (size_t i = 0; i < n; i++) {
        bool take_left = right == n || (left < half && compare_place(&spare[left], &spare[right]) <= 0);
        items[i] = take_left ? spare[left++] : spare[right++];
    }
}

static bool same(const struct diag *a, const struct diag *b) {
    return a->code == b->code && compare_place(a, b) == 0 && a->at.end == b->at.end && str_equal(a->message, b->message);
}

static void uncount(struct diag_sink *sink, enum diag_severity severity) {
    if (severity == DIAG_ERROR)
        sink->errors--;
    else if (severity == DIAG_WARNING)
        sink->warnings--;
    else
        sink->notes--;
}

void diag_sort(struct diag_sink *sink) {
    struct diag *spare = malloc((sink->count ? sink->count : 1) * sizeof *spare);
    if (!spare)
        return;
    sort_items(sink->items, spare, sink->count);
    free(spare);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < sink->count; i++) {
        bool repeat = false;
        for (uint32_t j = kept; j > 0 && compare_place(&sink->items[j - 1], &sink->items[i]) == 0 && !repeat; j--)
            repeat = same(&sink->items[j - 1], &sink->items[i]);
        if (repeat)
            uncount(sink, infos[sink->items[i].code].severity);
        else
            sink->items[kept++] = sink->items[i];
    }
    sink->count = kept;
}

void diag_merge(struct diag_sink *into, const struct diag_sink *from) {
    for (uint32_t i = 0; i < from->count; i++) {
        const struct diag *d = &from->items[i];
        struct diag *copy = diag_add(into, d->code, d->at, "%.*s", STR_ARG(d->message));
        copy->repeats = d->repeats;
        for (const struct diag_related *n = d->notes; n; n = n->next)
            diag_note(into, n->at, "%.*s", STR_ARG(n->message));
        if (d->help.len)
            diag_help(into, "%.*s", STR_ARG(d->help));
        if (d->has_fix)
            diag_fix(into, d->fix_is_safe, d->fix_at, d->fix_text);
    }
    into->dropped += from->dropped;
}
