#include "app/settings/keys.h"

#include "core/limits.h"
#include "measure/extremes/extremes.h"

#include <math.h>

static const struct key_row settings[] = {
    {.name = "asset_paths",
     .shape = KEY_LIST,
     .value = KEY_FOLDER,
     .form = "a list of folders",
     .example = "asset_paths: [textures]",
     .doc = "Folders below this one, in which glint also looks for the files of scenes."},
    {.name = "severity",
     .shape = KEY_MAP,
     .value = KEY_CODE_SEVERITY,
     .form = "a map from codes to severities",
     .example = "severity: {W401: error, N601: off}",
     .doc = "The severity of a warning or note. W4xx is a family; a later entry overrides an earlier one."},
    {.name = "ignore",
     .shape = KEY_LIST,
     .value = KEY_CODE_OR_PATH,
     .form = "a list of codes and paths",
     .example = "ignore: [N401, \"drafts/**\"]",
     .doc = "Codes of warnings and notes to leave out, and patterns of paths: * and ? within one folder, ** "
            "across folders."},
    {.name = "only",
     .shape = KEY_LIST,
     .value = KEY_CODE,
     .form = "a list of codes",
     .example = "only: [W4xx]",
     .doc = "Codes: no other warnings and notes are reported."},
    {.name = "fail_on",
     .value = KEY_FAIL_WORD,
     .form = "error or warning",
     .example = "fail_on: warning",
     .doc = "What makes 'glint check' fail."},
    {.name = "max_messages",
     .value = KEY_MAX_MESSAGES,
     .form = "a whole number",
     .example = "max_messages: 20",
     .doc = "Findings reported for one scene; the rest are counted. Beside the scenes it can only lower the "
            "limit."},
    {.name = "limits",
     .shape = KEY_MAP,
     .value = KEY_LIMIT,
     .form = "a map from limits to numbers",
     .example = "limits: {mesh-bytes: 1000000}",
     .doc = "Limits on the size of inputs; 'glint check --limit help' lists them. Beside the scenes they can "
            "only be lowered: the command line, and a file named by --config, can raise them."},
};
const struct key_table SETTING_KEYS = {"setting", settings, sizeof settings / sizeof *settings};

static const struct key_row limits[] = {
#define X(NAME, option, standard, from, to, text)                                                            \
    {.name = option, .value = KEY_WHOLE_NUMBER, .least = from, .greatest = standard, .doc = text},
#include "core/limits.def"
#undef X
};
const struct key_table LIMIT_KEYS = {"limit", limits, sizeof limits / sizeof *limits};

static const struct key_row axes[] = {
    {.name = "all",
     .shape = KEY_LIST,
     .value = KEY_AXIS_BOUNDS,
     .axes = (1u << EXTREME_AXES) - 1,
     .doc = "every axis"},
#define X(NAME, text, title)                                                                                 \
    {.name = text, .shape = KEY_LIST, .value = KEY_AXIS_BOUNDS, .axes = 1u << EXTREME_##NAME, .doc = title},
#include "measure/extremes/axes.def"
#undef X
};
const struct key_table AXIS_KEYS = {"axis", axes, sizeof axes / sizeof *axes};

#define BOUND_FIELD(field) .greatest = HUGE_VAL, .offset = offsetof(struct extreme_bound, field)
static const struct key_row bounds[] = {
    {.name = "from",
     .value = KEY_FROM_TO,
     BOUND_FIELD(from),
     .doc = "The least value of the axis that it holds for."},
    {.name = "to",
     .value = KEY_FROM_TO,
     BOUND_FIELD(to),
     .doc = "The greatest value of the axis that it holds for."},
#define X(NAME, text, title, unit)                                                                           \
    {.name = text, .value = KEY_BOUND, BOUND_FIELD(bound[EXTREME_##NAME]), .doc = title},
#include "measure/extremes/metrics.def"
#undef X
};
const struct key_table BOUND_KEYS = {"metric", bounds, sizeof bounds / sizeof *bounds};

const struct key_row *key_find(const struct key_table *table, str name, struct nearest *search) {
    *search = nearest_begin(name);
    for (uint32_t i = 0; i < table->count; i++) {
        if (str_equal_cstr(name, table->rows[i].name))
            return &table->rows[i];
        nearest_offer(search, str_from(table->rows[i].name));
    }
    return NULL;
}

str key_list(const struct key_table *table, struct arena *arena) {
    str list = STR("");
    for (uint32_t i = 0; i < table->count; i++)
        list = arena_format(arena, "%.*s%s%s", STR_ARG(list),
                            i == 0                  ? ""
                            : i + 1 == table->count ? " and "
                                                    : ", ",
                            table->rows[i].name);
    return list;
}

bool key_report_unknown(const struct key_table *table, struct diag_sink *sink, enum diag_code code, span at,
                        str name, const struct nearest *search) {
    str best = nearest_best(search);
    diag_add(sink, code, at, "there is no %s '%.*s'", table->what, STR_ARG(name));
    if (best.len)
        diag_help(sink, "did you mean '%.*s'?", STR_ARG(best));
    return best.len > 0;
}
