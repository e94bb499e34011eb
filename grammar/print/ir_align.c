#include "grammar/print/ir_align.h"

#include <stdlib.h>

enum {
    PAIRS_MAX = 250000 // pairs compared one by one; beyond that, the rest pairs in order
};

void ir_align_init(struct ir_align *align, struct arena *arena, uint32_t a_count, uint32_t b_count) {
    *align = (struct ir_align){.arena = arena, .a_count = a_count, .b_count = b_count};
    align->b_of_a = ARENA_ARRAY(arena, int32_t, a_count);
    align->a_of_b = ARENA_ARRAY(arena, int32_t, b_count);
    for (uint32_t i = 0; i < a_count; i++)
        align->b_of_a[i] = IR_ALIGN_NONE;
    for (uint32_t i = 0; i < b_count; i++)
        align->a_of_b[i] = IR_ALIGN_NONE;
}

static void join(struct ir_align *align, uint32_t a, uint32_t b) {
    align->b_of_a[a] = (int32_t)b;
    align->a_of_b[b] = (int32_t)a;
}

struct keyed {
    str key;
    uint32_t index;
};

static int compare(const void *left, const void *right) {
    const struct keyed *a = left, *b = right;
    int order = str_compare(a->key, b->key);
    return order ? order : a->index < b->index ? -1 : a->index > b->index;
}

static struct keyed *sorted(struct ir_align *align, const str *keys, const int32_t *partner, uint32_t count,
                            uint32_t *kept) {
    struct keyed *items = ARENA_ARRAY(align->arena, struct keyed, count);
    *kept = 0;
    for (uint32_t i = 0; i < count; i++)
        if (keys[i].len && partner[i] == IR_ALIGN_NONE)
            items[(*kept)++] = (struct keyed){keys[i], i};
    if (*kept)
        qsort(items, *kept, sizeof *items, compare);
    return items;
}

void ir_align_keys(struct ir_align *align, const str *a_keys, const str *b_keys) {
    uint32_t a_count, b_count;
    struct keyed *a = sorted(align, a_keys, align->b_of_a, align->a_count, &a_count);
    struct keyed *b = sorted(align, b_keys, align->a_of_b, align->b_count, &b_count);
    for (uint32_t i = 0, j = 0; i < a_count && j < b_count;) {
        int order = str_compare(a[i].key, b[j].key);
        if (order == 0)
            join(align, a[i].index, b[j].index);
        i += order <= 0;
        j += order >= 0;
    }
}

static uint32_t count_free(const int32_t *partner, uint32_t count) {
    uint32_t free = 0;
    for (uint32_t i = 0; i < count; i++)
        free += partner[i] == IR_ALIGN_NONE;
    return free;
}

static void join_in_order(struct ir_align *align) {
    for (uint32_t a = 0, b = 0; a < align->a_count && b < align->b_count;) {
        if (align->b_of_a[a] != IR_ALIGN_NONE)
            a++;
        else if (align->a_of_b[b] != IR_ALIGN_NONE)
            b++;
        else
            join(align, a++, b++);
    }
}

void ir_align_rest(struct ir_align *align, ir_align_likeness *likeness, void *context) {
    uint32_t free_a = count_free(align->b_of_a, align->a_count);
    uint32_t free_b = count_free(align->a_of_b, align->b_count);
    if ((uint64_t)free_a * free_b > PAIRS_MAX) {
        join_in_order(align);
        return;
    }
    double least = free_a == 1 && free_b == 1 ? 0 : 1.0 / 3;
    for (uint32_t b = 0; b < align->b_count; b++) {
        double best = -1;
        uint32_t found = 0;
        for (uint32_t a = 0; align->a_of_b[b] == IR_ALIGN_NONE && a < align->a_count; a++) {
            double alike = align->b_of_a[a] == IR_ALIGN_NONE ? likeness(context, a, b) : -1;
            if (alike > best) {
                best = alike;
                found = a;
            }
        }
        if (best >= least)
            join(align, found, b);
    }
}

// The longest increasing run of partners stays in place (Fredman 1975: keep the least end of the runs of each
// length).
void ir_align_moved(const struct ir_align *align, bool *moved) {
    uint32_t *ends = ARENA_ARRAY(align->arena, uint32_t, align->a_count + 1);
    int32_t *before = ARENA_ARRAY(align->arena, int32_t, align->a_count);
    uint32_t length = 0;
    for (uint32_t a = 0; a < align->a_count; a++) {
        if (align->b_of_a[a] == IR_ALIGN_NONE)
            continue;
        uint32_t low = 0, high = length;
        while (low < high) {
            uint32_t middle = (low + high) / 2;
            if (align->b_of_a[ends[middle]] < align->b_of_a[a])
                low = middle + 1;
            else
                high = middle;
        }
        before[a] = low ? (int32_t)ends[low - 1] : IR_ALIGN_NONE;
        ends[low] = a;
        length = low == length ? length + 1 : length;
        moved[a] = true;
    }
    for (int32_t a = length ? (int32_t)ends[length - 1] : IR_ALIGN_NONE; a != IR_ALIGN_NONE; a = before[a])
        moved[a] = false;
}
