#include "render/parts/parts.h"

#include "core/heap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    TILE_ROWS = 8
};

uint32_t parts_most(uint32_t height) {
    return (height + TILE_ROWS - 1) / TILE_ROWS;
}

bool parts_cut(uint32_t width, uint32_t height, uint32_t number, uint32_t count, struct part_region *region) {
    const uint64_t rows = parts_most(height);
    const uint32_t begin = (uint32_t)(rows * (number - 1) / count) * TILE_ROWS;
    uint32_t end = (uint32_t)(rows * number / count) * TILE_ROWS;
    end = end < height ? end : height;
    *region = (struct part_region){0, begin, width, end - begin};
    return count <= rows;
}

// ---- whether parts fit

static bool same_key(const uint64_t a[2], const uint64_t b[2]) {
    return a[0] == b[0] && a[1] == b[1];
}

const char *parts_difference(const struct part *a, const struct part *b) {
    if (!same_key(a->scene, b->scene))
        return "is of another scene than";
    if (a->width != b->width || a->height != b->height)
        return "is of a picture of another size than";
    if (a->samples != b->samples)
        return "is of a picture with other samples than";
    if (!same_key(a->settings, b->settings))
        return "was rendered with other settings, or by another version of glint, than";
    if (strcmp(a->device, b->device) != 0)
        return "was rendered by another device, whose floats may differ, than";
    return NULL;
}

static bool same_region(const struct part_region *a, const struct part_region *b) {
    return a->x == b->x && a->y == b->y && a->width == b->width && a->height == b->height;
}

static bool overlap(const struct part_region *a, const struct part_region *b) {
    return a->x < b->x + b->width && b->x < a->x + a->width && a->y < b->y + b->height &&
           b->y < a->y + a->height;
}

// By place, then by samples.
struct entry {
    const struct part *part;
    uint32_t number;
};

static int compare_numbers(uint32_t a, uint32_t b) {
    return (a > b) - (a < b);
}

static int compare(const void *left, const void *right) {
    const struct entry *a = left, *b = right;
    const struct part_region *p = &a->part->region, *q = &b->part->region;
    const int keys[] = {compare_numbers(p->y, q->y),
                        compare_numbers(p->x, q->x),
                        compare_numbers(p->height, q->height),
                        compare_numbers(p->width, q->width),
                        compare_numbers(a->part->first_sample, b->part->first_sample),
                        compare_numbers(a->number, b->number)};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (keys[i])
            return keys[i];
    return 0;
}

static bool doubled(struct parts_fault *fault, uint32_t part, uint32_t other) {
    strbuf_cstr(&fault->text, "has pixels and samples that are also in");
    fault->part = part;
    fault->other = other;
    return false;
}

static bool lacks_samples(struct parts_fault *fault, const struct part_region *r, uint32_t first,
                          uint32_t end) {
    strbuf_format(&fault->text, "samples %u to %u of the region %u,%u,%u,%u are missing", first, end, r->x,
                  r->y, r->width, r->height);
    return false;
}

// Whether the parts of one region have each sample once. Returns the entry after them; NULL: they do not, and
// fault says why.
static const struct entry *judge_samples(const struct entry *begin, const struct entry *end,
                                         struct parts_fault *fault) {
    const struct part *first = begin->part;
    uint32_t next = 0;
    const struct entry *e = begin;
    for (; e < end && same_region(&e->part->region, &first->region); e++) {
        if (e->part->first_sample > next &&
            !lacks_samples(fault, &first->region, next, e->part->first_sample))
            return NULL;
        if (e->part->first_sample < next && !doubled(fault, e->number, e[-1].number))
            return NULL;
        next = e->part->end_sample;
    }
    if (next < first->samples && !lacks_samples(fault, &first->region, next, first->samples))
        return NULL;
    return e;
}

// The first pixel of a row that no region has; the width: none.
static uint32_t gap_in_row(const struct entry *entries, uint32_t count, uint32_t width, uint32_t y) {
    uint32_t x = 0;
    for (bool goes_on = true; goes_on && x < width;) {
        goes_on = false;
        for (uint32_t i = 0; i < count && !goes_on; i++) {
            const struct part_region *r = &entries[i].part->region;
            goes_on = y >= r->y && y - r->y < r->height && x >= r->x && x - r->x < r->width;
            x = goes_on ? r->x + r->width : x;
        }
    }
    return x;
}

// Whether each pixel is in a region: rows differ only where regions begin or end.
static bool judge_gaps(const struct entry *entries, uint32_t count, struct parts_fault *fault) {
    const struct part *first = entries->part;
    for (uint32_t i = 0; i <= count; i++) {
        const uint32_t y = i < count ? entries[i].part->region.y + entries[i].part->region.height : 0;
        if (y >= first->height)
            continue;
        const uint32_t x = gap_in_row(entries, count, first->width, y);
        if (x < first->width) {
            strbuf_format(&fault->text, "no part has the pixel %u,%u", x, y);
            return false;
        }
    }
    return true;
}

static bool judge(const struct entry *entries, uint32_t count, struct parts_fault *fault) {
    const struct entry *end = entries + count;
    for (const struct entry *e = entries; e < end;) {
        const struct entry *next = judge_samples(e, end, fault);
        if (!next)
            return false;
        // Those that begin below it cannot overlap it.
        for (const struct entry *o = next;
             o < end && o->part->region.y < e->part->region.y + e->part->region.height; o++)
            if (overlap(&o->part->region, &e->part->region))
                return doubled(fault, o->number, e->number);
        e = next;
    }
    return judge_gaps(entries, count, fault);
}

bool parts_fit(const struct part *parts, uint32_t count, uint32_t *order, struct parts_fault *fault) {
    fault->part = fault->other = PARTS_NONE;
    for (uint32_t i = 1; i < count; i++) {
        const char *words = parts_difference(&parts[i], &parts[0]);
        if (words) {
            strbuf_cstr(&fault->text, words);
            fault->part = i;
            fault->other = 0;
            return false;
        }
    }
    struct entry *entries = heap_array(count, sizeof *entries);
    if (!entries)
        return false;
    for (uint32_t i = 0; i < count; i++)
        entries[i] = (struct entry){&parts[i], i};
    qsort(entries, count, sizeof *entries, compare);
    for (uint32_t i = 0; i < count; i++)
        order[i] = entries[i].number;
    const bool fits = judge(entries, count, fault);
    free(entries);
    return fits;
}

// ---- their picture

// As the tracer adds samples: a value that is not finite marks the pixel for good.
static void add_sample(float sum[3], const float sample[3]) {
    const float next[3] = {sum[0] + sample[0], sum[1] + sample[1], sum[2] + sample[2]};
    const bool finite = isfinite(next[0]) && isfinite(next[1]) && isfinite(next[2]);
    for (int k = 0; k < 3; k++)
        sum[k] = finite ? next[k] : NAN;
}

static void add_row(const struct part *part, const float *row, uint32_t y, bool ends, struct image *image) {
    float *to = image->rgb + ((size_t)(part->region.y + y) * image->width + part->region.x) * 3;
    for (size_t i = 0; i < part->region.width; i++) {
        add_sample(to + 3 * i, row + 3 * i);
        for (int k = 0; ends && k < 3; k++)
            to[3 * i + (size_t)k] /= (float)part->samples;
    }
}

void parts_add(const struct part *part, struct image *image) {
    const uint32_t planes = part_planes(part);
    const size_t row = (size_t)part->region.width * 3;
    const bool is_mean = part->end_sample - part->first_sample == part->samples;
    for (uint32_t y = 0; y < part->region.height; y++)
        for (uint32_t plane = 0; plane < planes; plane++) {
            const float *from = part->rgb + ((size_t)plane * part->region.height + y) * row;
            float *to = image->rgb + ((size_t)(part->region.y + y) * image->width + part->region.x) * 3;
            if (is_mean)
                memcpy(to, from, row * sizeof *to);
            else
                add_row(part, from, y, plane + 1 == planes && part->end_sample == part->samples, image);
        }
}
