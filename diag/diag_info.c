// The codes with their sentences: the only object that a changed sentence rebuilds.
#include "core/ranges.h"
#include "diag/diag.h"
#include "picture/formats/formats.h"

#include <string.h>

// One row for each code, in the order of the codes.
enum {
#define X(NAME, code, where, title, meaning, remedy) ROW_##NAME##_##code,
#include "diag/diag_sentences.def"
#undef X
    ROW_COUNT
};
#define X(NAME, code)                                                                                        \
    _Static_assert((int)ROW_##NAME##_##code == (int)DIAG_##NAME,                                             \
                   "diag_sentences.def: wrong place for " #code);
#include "diag/diag_names.def"
#undef X
_Static_assert((int)ROW_COUNT == (int)DIAG_CODE_COUNT, "diag_names.def lacks a code of diag_sentences.def");

#define SEVERITY(code) (code[0] == 'E' ? DIAG_ERROR : code[0] == 'W' ? DIAG_WARNING : DIAG_NOTE)

static const struct diag_info infos[DIAG_CODE_COUNT] = {
#define X(NAME, code, where, title, meaning, remedy)                                                         \
    {#NAME, #code, SEVERITY(#code), where, title, meaning, remedy},
#include "diag/diag_sentences.def"
#undef X
};

const struct diag_info *diag_info(enum diag_code code) {
    return &infos[code];
}

const char *diag_stage(enum diag_code code) {
    static const char *const stages[] = {"glint", "syntax", "binding", "reference", "rule",
                                         "limit", "file",   "device",  "command",   "configuration"};
    return stages[(unsigned)(infos[code].code[1] - '0') % 10];
}

enum diag_code diag_find(str code) {
    for (int i = 0; i < DIAG_CODE_COUNT; i++)
        if (code.len == strlen(infos[i].code) && str_ends_with_nocase(code, infos[i].code))
            return (enum diag_code)i;
    return DIAG_CODE_COUNT;
}
