// The one table of limits: how large an input may be before it is refused with E501.
//
// Thread safety: `struct limits` is a value; set it up before work begins.
#ifndef GLINT_CORE_LIMITS_H
#define GLINT_CORE_LIMITS_H

#include "core/str.h"

enum limit {
#define X(NAME, option, standard, least, greatest, doc) LIMIT_##NAME,
#include "core/limits.def"
#undef X
    LIMIT_COUNT
};

struct limits {
    uint64_t value[LIMIT_COUNT];
    uint64_t given; // bit i: limits_set has set limit i
};

enum limit_status {
    LIMIT_SET,
    LIMIT_UNKNOWN_NAME,
    LIMIT_BAD_VALUE, // not a whole number, or outside the limit's own range
};

struct limit_info {
    const char *name;
    uint64_t standard;
    uint64_t least;
    uint64_t greatest;
    const char *doc;
};

struct limits limits_default(void);
// Applies "name=value". On LIMIT_BAD_VALUE *which is the row.
enum limit_status limits_set(struct limits *limits, str assignment, enum limit *which);
bool limits_set_value(struct limits *limits, enum limit which, str value);
// Copies from `from` the limits that were set there and not in `limits`.
void limits_fill(struct limits *limits, const struct limits *from);
const struct limit_info *limit_info(enum limit which);
// A byte limit for this process's memory: at most half of what a size_t can hold.
size_t limits_size(const struct limits *limits, enum limit which);

#endif
