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

enum limit_status limits_set(struct limits *limits, str assignment, enum limit *which) {
    size_t equals = 0;
    while (equals < assignment.len && assignment.ptr[equals] != '=')
        equals++;
    str name = str_slice(assignment, 0, equals);
    for (int i = 0; i < LIMIT_COUNT; i++) {
        if (!str_equal_cstr(name, infos[i].name))
            continue;
        *which = (enum limit)i;
        int64_t value;
        if (number_parse_integer(str_slice(assignment, equals + 1, assignment.len), &value) != NUMBER_OK ||
            value < (int64_t)infos[i].least || value > (int64_t)infos[i].greatest)
            return LIMIT_BAD_VALUE;
        limits->value[i] = (uint64_t)value;
        limits->given |= (uint64_t)1 << i;
        return LIMIT_SET;
    }
    return LIMIT_UNKNOWN_NAME;
}

void limits_fill(struct limits *limits, const struct limits *from) {
    uint64_t taken = from->given & ~limits->given;
    for (int i = 0; i < LIMIT_COUNT; i++)
        if (taken >> i & 1)
            limits->value[i] = from->value[i];
    limits->given |= taken;
}
