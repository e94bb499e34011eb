#include "diag/diag.h"

#include "core/heap.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    SINK_BYTES_MAX = 64 * 1024 * 1024,
    TEXT_BYTES_MAX = 2000,               // of one message, note or help line
    SEARCH_COST_MAX = 100 * 1000 * 1000, // for all suggestions: some tenths of a second
};

void diag_sink_init(struct diag_sink *sink) {
    *sink = (struct diag_sink){.kept_max = DIAG_KEPT_MAX, .search_left = SEARCH_COST_MAX};
    arena_init(&sink->arena, SINK_BYTES_MAX);
}

void diag_sink_keep(struct diag_sink *sink, uint32_t most) {
    if (most <= sink->kept_max)
        return;
    sink->kept_max = most;
    sink->arena.cap_bytes = (size_t)most * (SINK_BYTES_MAX / DIAG_KEPT_MAX);
}

void diag_sink_finish(struct diag_sink *sink) {
    if (!sink)
        return;
    arena_finish(&sink->arena);
    *sink = (struct diag_sink){0};
}

// Formats without the guard: a sink that is full must not jump out of its user. false: no room.
__attribute__((format(printf, 3, 0))) static bool format_text(struct diag_sink *sink, str *text,
                                                              const char *format, va_list args) {
    char buffer[TEXT_BYTES_MAX + 1];
    int length = vsnprintf(buffer, sizeof buffer, format, args);
    size_t size = length < 0 ? 0 : (size_t)length;
    if (size > TEXT_BYTES_MAX) {
        size = TEXT_BYTES_MAX - 3;
        while (size > 0 && ((unsigned char)buffer[size] & 0xC0) == 0x80)
            size--;
        memcpy(buffer + size, "...", 3);
        size += 3;
    }
    char *copy = arena_try_alloc(&sink->arena, size + 1);
    if (!copy)
        return false;
    memcpy(copy, buffer, size);
    *text = (str){copy, size};
    return true;
}

static bool make_room(struct diag_sink *sink) {
    if (sink->count < sink->capacity)
        return true;
    const size_t capacity = sink->capacity ? heap_times(2, sink->capacity) : 16;
    struct diag *items = arena_try_alloc_array(&sink->arena, capacity, sizeof *items);
    if (!items)
        return false;
    if (sink->count)
        memcpy(items, sink->items, sink->count * sizeof *items);
    sink->items = items;
    sink->capacity = (uint32_t)capacity;
    return true;
}

static void count(struct diag_sink *sink, enum diag_severity severity) {
    if (severity == DIAG_ERROR)
        sink->errors++;
    else if (severity == DIAG_WARNING)
        sink->warnings++;
    else
        sink->notes++;
}

static void drop(struct diag_sink *sink, diag_code code, uint32_t number) {
    sink->dropped += number;
    sink->dropped_of[code] += number;
}

bool diag_is_full(const struct diag_sink *sink) {
    return sink->count >= sink->kept_max;
}

static int compare_spans(const void *a, const void *b) {
    const span *x = a, *y = b;
    if (x->source != y->source)
        return x->source < y->source ? -1 : 1;
    return x->begin < y->begin ? -1 : x->begin > y->begin;
}

void diag_repeats(struct diag_sink *sink, span at) {
    if (sink->repeated.count == sink->repeated.capacity) {
        const size_t capacity = sink->repeated.capacity ? heap_times(2, sink->repeated.capacity) : 16;
        span *items = arena_try_alloc_array(&sink->arena, capacity, sizeof *items);
        if (!items)
            return;
        if (sink->repeated.count)
            memcpy(items, sink->repeated.items, sink->repeated.count * sizeof *items);
        sink->repeated.items = items;
        sink->repeated.capacity = (uint32_t)capacity;
    }
    sink->repeated.items[sink->repeated.count++] = at;
    sink->repeated.is_sorted = false;
}

// The one like it, if there are several of what it is about.
static struct diag *find_repeat(struct diag_sink *sink, diag_code code, span at) {
    if (!sink->repeated.is_sorted)
        qsort(sink->repeated.items, sink->repeated.count, sizeof *sink->repeated.items, compare_spans);
    sink->repeated.is_sorted = true;
    uint32_t low = 0, high = sink->repeated.count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (compare_spans(&sink->repeated.items[middle], &at) <= 0)
            low = middle + 1;
        else
            high = middle;
    }
    const span *around = low ? &sink->repeated.items[low - 1] : NULL;
    if (!around || around->source != at.source || at.end > around->end)
        return NULL;
    for (uint32_t i = sink->count; i-- > 0;) {
        struct diag *item = &sink->items[i];
        if (item->code == code && item->at.source == at.source && item->at.begin == at.begin &&
            item->at.end == at.end)
            return item;
    }
    return NULL;
}

bool diag_is_repeat(struct diag_sink *sink, diag_code code, span at) {
    struct diag *item = sink->repeated.count ? find_repeat(sink, code, at) : NULL;
    if (item && item - sink->items >= sink->settled)
        item->repeats++;
    return item != NULL;
}

struct diag *diag_add(struct diag_sink *sink, diag_code code, span at, const char *format, ...) {
    if (diag_is_repeat(sink, code, at)) {
        sink->last_kept = false;
        return &sink->spare;
    }
    count(sink, diag_info(code)->severity);
    str message = STR("");
    va_list args;
    va_start(args, format);
    sink->last_kept = !diag_is_full(sink) && make_room(sink) && format_text(sink, &message, format, args);
    va_end(args);
    struct diag *item = &sink->spare;
    if (sink->last_kept)
        item = &sink->items[sink->count++];
    else
        drop(sink, code, 1);
    *item = (struct diag){.code = code, .severity = diag_info(code)->severity, .at = at, .message = message};
    return item;
}

// The diagnostic that was added last; NULL if it was dropped.
static struct diag *last(struct diag_sink *sink) {
    return sink->last_kept && sink->count > 0 ? &sink->items[sink->count - 1] : NULL;
}

static void add_note(struct diag_sink *sink, struct diag *item, span at, const char *format, va_list args) {
    struct diag_related *note = item ? arena_try_alloc(&sink->arena, sizeof *note) : NULL;
    if (!note)
        return;
    note->at = at;
    struct diag_related **end = &item->notes;
    while (*end)
        end = &(*end)->next;
    if (format_text(sink, &note->message, format, args))
        *end = note;
}

void diag_note(struct diag_sink *sink, span at, const char *format, ...) {
    va_list args;
    va_start(args, format);
    add_note(sink, last(sink), at, format, args);
    va_end(args);
}

void diag_note_to(struct diag_sink *sink, struct diag *item, span at, const char *format, ...) {
    va_list args;
    va_start(args, format);
    add_note(sink, item, at, format, args);
    va_end(args);
}

void diag_help(struct diag_sink *sink, const char *format, ...) {
    struct diag *item = last(sink);
    if (!item)
        return;
    va_list args;
    va_start(args, format);
    format_text(sink, &item->help, format, args);
    va_end(args);
}

static str copy_text(struct diag_sink *sink, str text) {
    char *copy = arena_try_alloc(&sink->arena, text.len + 1);
    if (copy && text.len)
        memcpy(copy, text.ptr, text.len);
    return copy ? (str){copy, text.len} : STR("");
}

void diag_with(struct diag_sink *sink, str name, str value) {
    struct diag *item = last(sink);
    struct diag_value *with = item ? arena_try_alloc(&sink->arena, sizeof *with) : NULL;
    if (!with)
        return;
    *with = (struct diag_value){.name = copy_text(sink, name), .value = copy_text(sink, value)};
    if (!with->name.len || !with->value.len)
        return;
    struct diag_value **end = &item->with;
    while (*end)
        end = &(*end)->next;
    *end = with;
}

void diag_fix(struct diag_sink *sink, bool safe, span at, str replacement) {
    struct diag *item = last(sink);
    if (!item)
        return;
    item->fix_text = copy_text(sink, replacement);
    item->has_fix = item->fix_text.len == replacement.len;
    item->fix_is_safe = safe;
    item->fix_at = at;
}

void diag_fix_file(struct diag_sink *sink, bool safe, str path, str text) {
    struct diag *item = last(sink);
    if (!item)
        return;
    item->fix_file = copy_text(sink, path);
    item->fix_text = copy_text(sink, text);
    item->fix_is_safe = safe;
}

void diag_fix_part(struct diag_sink *sink, const struct source_set *sources, bool safe, str old,
                   str replacement) {
    struct diag *item = last(sink);
    str text = item ? source_text(sources, item->at) : STR("");
    for (size_t i = 0; old.len && i + old.len <= text.len; i++) {
        if (!str_equal(str_slice(text, i, i + old.len), old))
            continue;
        uint32_t begin = item->at.begin + (uint32_t)i;
        diag_fix(sink, safe, (span){item->at.source, begin, begin + (uint32_t)old.len}, replacement);
        return;
    }
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
    return a->code == b->code && compare_place(a, b) == 0 && a->at.end == b->at.end &&
           str_equal(a->message, b->message);
}

static uint64_t hash(const struct diag *d) {
    uint64_t h = str_hash(d->message);
    h = (h ^ d->at.source) * UINT64_C(0x9E3779B97F4A7C15);
    h = (h ^ d->at.begin) * UINT64_C(0x9E3779B97F4A7C15);
    return h ^ h >> 29;
}

static void uncount(struct diag_sink *sink, enum diag_severity severity) {
    if (severity == DIAG_ERROR)
        sink->errors--;
    else if (severity == DIAG_WARNING)
        sink->warnings--;
    else
        sink->notes--;
}

// Removes what was reported before. `slots` (a power of two of them, zeroed) hold 1 + the index of an item
// kept: a table instead of comparing neighbours, because a thousand may be at one place.
static void drop_repeats(struct diag_sink *sink, uint32_t *slots, size_t slot_count) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < sink->count; i++) {
        const struct diag *item = &sink->items[i];
        size_t at = (size_t)hash(item) & (slot_count - 1);
        while (slots[at] && !same(&sink->items[slots[at] - 1], item))
            at = (at + 1) & (slot_count - 1);
        if (slots[at]) {
            uncount(sink, item->severity);
            continue;
        }
        sink->items[kept++] = *item;
        slots[at] = kept;
    }
    sink->count = kept;
}

static void note_repeats(struct diag_sink *sink) {
    for (uint32_t i = 0; i < sink->count; i++) {
        struct diag *item = &sink->items[i];
        if (item->repeats || (item->with && !item->copies))
            item->copies = 1 + item->repeats;
        if (item->repeats)
            diag_note_to(sink, item, SPAN_NONE, "so it is with %u more of its copies", item->repeats);
        item->repeats = 0;
    }
}

void diag_sort(struct diag_sink *sink) {
    sink->last_kept = false;
    note_repeats(sink);
    if (sink->count < 2)
        return;
    size_t slot_count = 4;
    while (slot_count < (size_t)sink->count * 2)
        slot_count *= 2;
    struct diag *spare = heap_array(sink->count, sizeof *spare);
    uint32_t *slots = heap_zeroed(slot_count, sizeof *slots);
    if (spare)
        sort_items(sink->items, spare, sink->count);
    if (slots)
        drop_repeats(sink, slots, slot_count);
    free(slots);
    free(spare);
}

void diag_filter(struct diag_sink *sink, diag_keep *keep, void *context) {
    uint32_t kept = 0;
    sink->last_kept = false;
    for (uint32_t i = 0; i < sink->count; i++) {
        struct diag item = sink->items[i];
        enum diag_severity before = item.severity;
        uncount(sink, before);
        if (!keep(context, &item))
            continue;
        count(sink, item.severity);
        sink->items[kept++] = item;
    }
    sink->count = kept;
}

static void copy_diag(struct diag_sink *into, const struct diag *d) {
    struct diag *copy = diag_add(into, d->code, d->at, "%.*s", STR_ARG(d->message));
    copy->severity = d->severity;
    for (const struct diag_related *n = d->notes; n; n = n->next)
        diag_note(into, n->at, "%.*s", STR_ARG(n->message));
    for (const struct diag_value *v = d->with; v; v = v->next)
        diag_with(into, v->name, v->value);
    if (d->help.len)
        diag_help(into, "%.*s", STR_ARG(d->help));
    if (d->has_fix)
        diag_fix(into, d->fix_is_safe, d->fix_at, d->fix_text);
    else if (d->fix_file.len)
        diag_fix_file(into, d->fix_is_safe, d->fix_file, d->fix_text);
}

void diag_merge(struct diag_sink *into, const struct diag_sink *from) {
    uint32_t errors = into->errors + from->errors;
    uint32_t warnings = into->warnings + from->warnings;
    uint32_t notes = into->notes + from->notes;
    for (uint32_t i = 0; i < from->count; i++)
        copy_diag(into, &from->items[i]);
    for (diag_code code = diag_next(-1); code < DIAG_CODE_COUNT; code = diag_next(code))
        drop(into, code, from->dropped_of[code]);
    into->errors = errors;
    into->warnings = warnings;
    into->notes = notes;
}
