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

// Rows lie in the order of the codes, family after family. A code that one of the two lists lacks, or names
// otherwise, does not compile.
enum {
#define X(NAME, code) ROW_##NAME##_##code,
#include "diag/diag_names.def"
#undef X
    ROW_COUNT
};
#define X(NAME, code, where, title, meaning, remedy) +1
enum {
    SENTENCE_COUNT = 0
#include "diag/diag_sentences.def"
};
#undef X
_Static_assert((int)SENTENCE_COUNT == (int)ROW_COUNT, "diag_sentences.def lacks a code of diag_names.def");

#define SEVERITY(code) (code[0] == 'E' ? DIAG_ERROR : code[0] == 'W' ? DIAG_WARNING : DIAG_NOTE)

static const struct diag_info infos[ROW_COUNT] = {
#define X(NAME, code, where, title, meaning, remedy)                                                         \
    [ROW_##NAME##_##code] = {#NAME, #code, SEVERITY(#code), where, title, meaning, remedy},
#include "diag/diag_sentences.def"
#undef X
};

// After the last code of each family.
static const diag_code AFTER[DIAG_CODE_COUNT / DIAG_FAMILY] = {
    0,
    DIAG_AFTER_SYNTAX,
    DIAG_AFTER_BINDING,
    DIAG_AFTER_REFERENCE,
    DIAG_AFTER_RULE,
    DIAG_AFTER_LIMIT,
    DIAG_AFTER_FILE,
    DIAG_AFTER_DEVICE,
    DIAG_AFTER_COMMAND,
};

diag_code diag_next(diag_code code) {
    do
        code++;
    while (code < DIAG_CODE_COUNT && code >= AFTER[code / DIAG_FAMILY]);
    return code;
}

const struct diag_info *diag_info(diag_code code) {
    int row = code % DIAG_FAMILY;
    for (int family = 1; family < code / DIAG_FAMILY; family++)
        row += AFTER[family] % DIAG_FAMILY;
    return &infos[row];
}

const char *diag_stage(diag_code code) {
    static const char *const stages[] = {"glint", "syntax", "binding", "reference", "rule",
                                         "limit", "file",   "device",  "command",   "configuration"};
    return stages[(unsigned)(diag_info(code)->code[1] - '0') % 10];
}

diag_code diag_find(str code) {
    for (diag_code i = diag_next(-1); i < DIAG_CODE_COUNT; i = diag_next(i))
        if (code.len == strlen(diag_info(i)->code) && str_ends_with_nocase(code, diag_info(i)->code))
            return i;
    return DIAG_CODE_COUNT;
}
