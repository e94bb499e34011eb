// What a whole study and a search share. Private to measure/tradeoff. Ownership: the study owns its rows.
// Thread safety: as tradeoff.h.
#ifndef GLINT_MEASURE_TRADEOFF_TRADEOFF_INTERNAL_H
#define GLINT_MEASURE_TRADEOFF_TRADEOFF_INTERNAL_H

#include "measure/tradeoff/measure/measure.h"

// rows.c: appends a copy of the row to the study's rows, its values not yet known. NULL: no memory.
struct row *tradeoff_add_row(struct tradeoff *study, const struct row *row);
// Removes the last row again.
void tradeoff_drop_row(struct tradeoff *study);
// Whether something reflects or refracts.
bool tradeoff_bounces(const struct measuring *s);

// search.c: the rows of a search, timed.
enum tradeoff_status tradeoff_search_rows(struct measuring *s);

#endif
