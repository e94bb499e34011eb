#include "core/text_diff.h"

#include "core/heap.h"

#include <stdlib.h>
#include <string.h>

enum {
    CONTEXT = 3,
    STEPS_PER_LINE = 128 // that the search may take: it grows with the square of the lines that differ
};

struct line {
    str text; // with its line end
    uint64_t hash;
    bool changed; // removed, or added
};

struct side {
    struct line *lines;
    size_t count;
};

static size_t line_end(str text, size_t at) {
    const char *end = at < text.len ? memchr(text.ptr + at, '\n', text.len - at) : NULL;
    return end ? (size_t)(end - text.ptr) + 1 : text.len;
}

static bool split(str text, struct side *side) {
    size_t count = 0;
    for (size_t at = 0; at < text.len; at = line_end(text, at))
        count++;
    side->count = count;
    side->lines = heap_zeroed(count + 1, sizeof *side->lines);
    if (!side->lines)
        return false;
    size_t begin = 0;
    for (size_t i = 0; i < count; i++) {
        size_t end = line_end(text, begin);
        side->lines[i].text = str_slice(text, begin, end);
        side->lines[i].hash = str_hash(side->lines[i].text);
        begin = end;
    }
    return true;
}

static bool same(const struct line *a, const struct line *b) {
    return a->hash == b->hash && str_equal(a->text, b->text);
}

// What remains of both sides without the equal lines at the beginning and the end.
struct middle {
    struct line *a, *b;
    int32_t n, m;
};

// The furthest x on each diagonal k = x - y that d edits reach: rows[d][d + k], for d from 0 on.
struct rows {
    int32_t **items;
    int32_t count;
};

static int32_t furthest(const struct rows *rows, int32_t d, int32_t k) {
    return rows->items[d][d + k];
}

// Whether the path to diagonal k with d edits extends the path with d - 1 by adding a line of `b`.
static bool came_down(const struct rows *rows, int32_t d, int32_t k) {
    return k == -d || (k != d && furthest(rows, d - 1, k - 1) < furthest(rows, d - 1, k + 1));
}

// One more edit; true: both ends are reached. *failed: no memory.
static bool next_row(const struct middle *mid, struct rows *rows, int32_t d, bool *failed) {
    int32_t *row = heap_array(heap_times(2, (uint64_t)d) + 1, sizeof *row);
    *failed = !row;
    if (*failed)
        return false;
    rows->items[d] = row;
    rows->count = d + 1;
    for (int32_t k = -d; k <= d; k += 2) {
        int32_t x = d == 0                  ? 0
                    : came_down(rows, d, k) ? furthest(rows, d - 1, k + 1)
                                            : furthest(rows, d - 1, k - 1) + 1;
        int32_t y = x - k;
        while (x < mid->n && y < mid->m && y >= 0 && same(&mid->a[x], &mid->b[y]))
            x++, y++;
        row[d + k] = x;
        if (k < d)
            row[d + k + 1] = -1;
        if (x >= mid->n && y >= mid->m)
            return true;
    }
    return false;
}

// Walks back along the shortest path and marks what it removes and adds.
static void mark_path(const struct middle *mid, const struct rows *rows) {
    int32_t x = mid->n, y = mid->m;
    for (int32_t d = rows->count - 1; d > 0; d--) {
        int32_t k = x - y;
        bool down = came_down(rows, d, k);
        int32_t before = down ? k + 1 : k - 1;
        x = furthest(rows, d - 1, before);
        y = x - before;
        if (down)
            mid->b[y].changed = true;
        else
            mid->a[x].changed = true;
    }
}

static void mark_all(const struct middle *mid) {
    for (int32_t i = 0; i < mid->n; i++)
        mid->a[i].changed = true;
    for (int32_t i = 0; i < mid->m; i++)
        mid->b[i].changed = true;
}

// How many lines may differ before all of them are replaced.
static int32_t most_differences(int64_t lines) {
    int32_t most = 0;
    while (most < lines && most < TEXT_DIFF_MOST && (int64_t)most * most / 2 < STEPS_PER_LINE * lines)
        most++;
    return most;
}

static bool mark(const struct middle *mid) {
    int32_t most = most_differences((int64_t)mid->n + mid->m);
    struct rows rows = {.items = heap_zeroed((size_t)most + 1, sizeof *rows.items)};
    bool failed = !rows.items, found = false;
    for (int32_t d = 0; !failed && !found && d <= most; d++)
        found = next_row(mid, &rows, d, &failed);
    if (found)
        mark_path(mid, &rows);
    else
        mark_all(mid);
    for (int32_t d = 0; d < rows.count; d++)
        free(rows.items[d]);
    free(rows.items);
    return !failed;
}

static bool compare(struct side *a, struct side *b) {
    size_t head = 0, tail = 0;
    while (head < a->count && head < b->count && same(&a->lines[head], &b->lines[head]))
        head++;
    while (tail < a->count - head && tail < b->count - head &&
           same(&a->lines[a->count - 1 - tail], &b->lines[b->count - 1 - tail]))
        tail++;
    size_t n = a->count - head - tail, m = b->count - head - tail;
    if (n > INT32_MAX / 4 || m > INT32_MAX / 4)
        return false;
    struct middle mid = {a->lines + head, b->lines + head, (int32_t)n, (int32_t)m};
    return mark(&mid);
}

// ---- the patch

static void put_line(struct strbuf *out, char sign, str text) {
    strbuf_char(out, sign);
    strbuf_str(out, text);
    if (text.len == 0 || text.ptr[text.len - 1] != '\n')
        strbuf_cstr(out, "\n\\ No newline at end of file\n");
}

static void put_range(struct strbuf *out, char sign, size_t begin, size_t count) {
    strbuf_format(out, "%c%zu", sign, count ? begin + 1 : begin);
    if (count != 1)
        strbuf_format(out, ",%zu", count);
}

struct hunk {
    size_t a, a_end, b, b_end;
};

static void put_hunk(struct strbuf *out, const struct side *a, const struct side *b, struct hunk h) {
    strbuf_cstr(out, "@@ ");
    put_range(out, '-', h.a, h.a_end - h.a);
    strbuf_char(out, ' ');
    put_range(out, '+', h.b, h.b_end - h.b);
    strbuf_cstr(out, " @@\n");
    for (size_t i = h.a, j = h.b; i < h.a_end || j < h.b_end;) {
        if (i < h.a_end && a->lines[i].changed)
            put_line(out, '-', a->lines[i++].text);
        else if (j < h.b_end && b->lines[j].changed)
            put_line(out, '+', b->lines[j++].text);
        else
            put_line(out, ' ', a->lines[i++].text), j++;
    }
}

// From the first change at or after *i, *j to before the first gap that is wider than both contexts.
static bool next_hunk(const struct side *a, const struct side *b, size_t *i, size_t *j, struct hunk *h) {
    while (*i < a->count && *j < b->count && !a->lines[*i].changed && !b->lines[*j].changed)
        ++*i, ++*j;
    if (*i >= a->count && *j >= b->count)
        return false;
    size_t before = *i < CONTEXT ? *i : CONTEXT;
    *h = (struct hunk){.a = *i - before, .b = *j - before};
    size_t equal = 0;
    while (*i < a->count || *j < b->count) {
        if (*i < a->count && a->lines[*i].changed)
            ++*i, equal = 0;
        else if (*j < b->count && b->lines[*j].changed)
            ++*j, equal = 0;
        else if (equal == 2 * CONTEXT)
            break;
        else
            ++*i, ++*j, ++equal;
    }
    size_t behind = equal > CONTEXT ? equal - CONTEXT : 0;
    h->a_end = *i - behind;
    h->b_end = *j - behind;
    return true;
}

void text_diff(str old_name, str old_text, str new_name, str new_text, struct strbuf *out) {
    struct side a = {0}, b = {0};
    if (str_equal(old_text, new_text))
        return;
    if (split(old_text, &a) && split(new_text, &b) && compare(&a, &b)) {
        size_t i = 0, j = 0;
        struct hunk hunk;
        strbuf_format(out, "--- %.*s\n+++ %.*s\n", STR_ARG(old_name), STR_ARG(new_name));
        while (next_hunk(&a, &b, &i, &j, &hunk))
            put_hunk(out, &a, &b, hunk);
    } else {
        out->failed = true;
    }
    free(a.lines);
    free(b.lines);
}
