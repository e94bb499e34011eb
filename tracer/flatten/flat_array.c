// The words of a flat scene: arrays of them, and numbers in them.
#include "tracer/flatten/flatten_parts.h"

#include <stdlib.h>
#include <string.h>

uint32_t flat_bits(double value) {
    float rounded = (float)value;
    uint32_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    return bits;
}

struct flat_pair flat_double(double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return (struct flat_pair){(uint32_t)bits, (uint32_t)(bits >> 32)};
}

bool flat_array_make(struct flat_array *array, uint64_t words) {
    array->count = words;
    array->words =
        words > SIZE_MAX / sizeof *array->words ? NULL : calloc(words ? words : 1, sizeof *array->words);
    return array->words != NULL;
}
