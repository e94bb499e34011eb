#include "core/limits.h"

#include "core/number.h"

static const struct limit_info infos[LIMIT_COUNT] = {
#define X(NAME, option, standard, least, greatest, doc) {option, standard, least, greatest, doc},
#include "core/limits.def"
#undef X
};

struct limits limits_default(void) {
    struct limits limits = {.given = 0};
    for (int i = 0; i < LIMIT_COUNT; i++)
        limits.value[i] = infos[i].standard;
    return limits;
}

const struct limit_info *limit_info(enum limit which) {
    return &infos[which];
}

size_t limits_size(const struct limits *limits, enum limit which) {
    const uint64_t value = limits->value[which];
    return value < SIZE_MAX / 2 ? (size_t)value : SIZE_MAX / 2;
}

// The two halves of it.
static bool limit_find(str name, enum limit *which) {
    for (int i = 0; i < LIMIT_COUNT; i++)
        if (str_equal_cstr(name, infos[i].name)) {
            *which = (enum limit)i;
            return true;
        }
    return false;
}

bool limits_set_value(struct limits *limits, enum limit which, str value) {
    int64_t number;
    if (number_parse_integer(value, &number) != NUMBER_OK || number < (int64_t)infos[which].least ||
        number > (int64_t)infos[which].greatest)
        return false;
    limits->value[which] = (uint64_t)number;
    limits->given |= (uint64_t)1 << which;
    return true;
}

enum limit_status limits_set(struct limits *limits, str assignment, enum limit *which) {
    size_t equals = 0;
    while (equals < assignment.len && assignment.ptr[equals] != '=')
        equals++;
    if (!limit_find(str_slice(assignment, 0, equals), which))
        return LIMIT_UNKNOWN_NAME;
    str value = str_slice(assignment, equals + 1, assignment.len);
    return limits_set_value(limits, *which, value) ? LIMIT_SET : LIMIT_BAD_VALUE;
}

void limits_fill(struct limits *limits, const struct limits *from) {
    uint64_t taken = from->given & ~limits->given;
    for (int i = 0; i < LIMIT_COUNT; i++)
        if (taken >> i & 1)
            limits->value[i] = from->value[i];
    limits->given |= taken;
}
