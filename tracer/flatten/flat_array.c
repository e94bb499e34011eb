// Arrays of words for the device.
#include "core/heap.h"
#include "tracer/flatten/flatten_internal.h"

bool flat_array_make(struct flat_array *array, uint64_t words) {
    array->count = words;
    array->words = heap_zeroed(words ? words : 1, sizeof *array->words);
    return array->words != NULL;
}
