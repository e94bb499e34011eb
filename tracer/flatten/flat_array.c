// Arrays of words for the device.
#include "tracer/flatten/flatten_parts.h"

#include <stdlib.h>

bool flat_array_make(struct flat_array *array, uint64_t words) {
    array->count = words;
    array->words =
        words > SIZE_MAX / sizeof *array->words ? NULL : calloc(words ? words : 1, sizeof *array->words);
    return array->words != NULL;
}
