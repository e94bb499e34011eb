// The codes with their sentences: the only object that a changed sentence rebuilds.
#include "core/ranges.h"
#include "diag/codes/binding.h"
#include "diag/codes/command.h"
#include "diag/codes/device.h"
#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "diag/codes/reference.h"
#include "diag/codes/rule.h"
#include "diag/codes/syntax.h"
#include "diag/diag.h"
#include "picture/formats/formats.h"

#include <string.h>

// Both lists have the same codes, each under the same name.
#define X(NAME, code, where, title, meaning, remedy) +1
enum {
    SENTENCES = 0
#include "diag/diag_sentences.def"
};
#undef X
#define X(NAME, code) +1
enum {
    NAMES = 0
#include "diag/diag_names.def"
};
#undef X
_Static_assert((int)SENTENCES == (int)NAMES,
               "diag_names.def or diag_sentences.def lacks a code of the other");
enum {
#define X(NAME, code) NAMED_##NAME##_##code,
#include "diag/diag_names.def"
#undef X
};
#define X(NAME, code, where, title, meaning, remedy)                                                         \
    _Static_assert((int)NAMED_##NAME##_##code >= 0, "another name in diag_names.def: " #code);
#include "diag/diag_sentences.def"
#undef X

#define SEVERITY(code) (code[0] == 'E' ? DIAG_ERROR : code[0] == 'W' ? DIAG_WARNING : DIAG_NOTE)

static const struct diag_info infos[DIAG_CODE_COUNT] = {
#define X(NAME, code, where, title, meaning, remedy)                                                         \
    [DIAG_##NAME] = {#NAME, #code, SEVERITY(#code), where, title, meaning, remedy},
#include "diag/diag_sentences.def"
#undef X
};

diag_code diag_next(diag_code code) {
    do
        code++;
    while (code < DIAG_CODE_COUNT && !infos[code].code);
    return code;
}

const struct diag_info *diag_info(diag_code code) {
    return &infos[code];
}

const char *diag_stage(diag_code code) {
    static const char *const stages[] = {"glint", "syntax", "binding", "reference", "rule",
                                         "limit", "file",   "device",  "command",   "configuration"};
    return stages[(unsigned)(infos[code].code[1] - '0') % 10];
}

diag_code diag_find(str code) {
    for (diag_code i = diag_next(-1); i < DIAG_CODE_COUNT; i = diag_next(i))
        if (code.len == strlen(infos[i].code) && str_ends_with_nocase(code, infos[i].code))
            return i;
    return DIAG_CODE_COUNT;
}
