// Rows come and go.
#include "core/heap.h"
#include "measure/tradeoff/tradeoff_internal.h"
#include "shaders/features.h"

#include <math.h>

struct row *tradeoff_add_row(struct tradeoff *t, const struct row *row) {
    struct row *rows = heap_grow(t->rows, t->count, &t->capacity, sizeof *rows);
    if (!rows)
        return NULL;
    t->rows = rows;
    struct row *added = &t->rows[t->count++];
    *added = *row;
    strbuf_init(&added->thumbnail);
    strbuf_init(&added->difference);
    for (int i = 0; i < METRIC_COUNT; i++)
        added->value[i] = (double)NAN;
    return added;
}

void tradeoff_drop_row(struct tradeoff *t) {
    struct row *row = &t->rows[--t->count];
    strbuf_finish(&row->thumbnail);
    strbuf_finish(&row->difference);
}

bool tradeoff_bounces(const struct measuring *s) {
    return s->flat[s->base.is_double].features & (FEATURE_REFLECTION | FEATURE_REFRACTION);
}
