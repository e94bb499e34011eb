// The least of the measures, regardless of the order in which they are found.
#include "tracer/flatten/precision_internal.h"

#include <float.h>

void precision_keep(struct precision_measure *least, const struct precision_measure *found) {
    if (!found->any)
        return;
    bool lesser = !least->any || found->steps < least->steps;
    if (least->any && found->steps == least->steps)
        lesser =
            found->body < least->body || (found->body == least->body && found->triangle < least->triangle);
    if (lesser)
        *least = *found;
}

void precision_note(struct precision_measure *least, struct precision_measure found) {
    found.any = true;
    found.steps = found.distance > 0 ? found.length * found.part / (found.distance * 0x1p-24) : DBL_MAX;
    precision_keep(least, &found);
}
