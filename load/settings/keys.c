#include "load/settings/keys.h"

#include "core/limits.h"
#include "core/ranges.h"
#include "measure/extremes/extremes.h"
#include "picture/metrics/metrics.h"

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

// ---- glint test

#define PICTURE_SETTINGS                                                                                     \
    {.name = "camera",                                                                                       \
     .value = KEY_CAMERA,                                                                                    \
     .form = "the name of a camera",                                                                         \
     .example = "camera: side",                                                                              \
     .doc = "The camera to look through, instead of the scene's first."},                                    \
        {.name = "size",                                                                                     \
         .value = KEY_SIZE,                                                                                  \
         .example = "size: 320x240",                                                                         \
         .least = 1,                                                                                         \
         .greatest = RANGE_SIDE_MOST,                                                                        \
         .doc = "Size of the picture in pixels, instead of the scene's."},                                   \
        {.name = "samples",                                                                                  \
         .value = KEY_WHOLE_NUMBER,                                                                          \
         .example = "samples: 4",                                                                            \
         .least = 1,                                                                                         \
         .greatest = RANGE_SAMPLES_MOST,                                                                     \
         .doc = "Rays through each pixel, instead of the scene's."},                                         \
        {.name = "device",                                                                                   \
         .value = KEY_DEVICE,                                                                                \
         .form = "the name of a device",                                                                     \
         .example = "device: reference",                                                                     \
         .doc = "The device to render on; 'reference' is the tracer in double precision. --device is over "  \
                "it."},                                                                                      \
        {.name = "set",                                                                                      \
         .shape = KEY_LIST,                                                                                  \
         .value = KEY_ASSIGNMENT,                                                                            \
         .form = "a list of texts PATH=VALUE",                                                               \
         .example = "set: [materials.glass.refractive_index=1.6]",                                           \
         .doc = "Values of the scene to change, as with --set."},                                            \
    {                                                                                                        \
        .name = "bounds", .value = KEY_TEST_BOUNDS, .form = "a map from metrics to numbers",                 \
        .example = "bounds: {share: 0.01}",                                                                  \
        .doc = "How far a picture may be from its reference. A metric that is not named keeps its bound."    \
    }

static const struct key_row test_rows[] = {
    {.name = "pictures",
     .value = KEY_FOLDER,
     .form = "a folder",
     .example = "pictures: references",
     .doc = "The folder of the reference pictures, relative to this file, instead of beside each scene or in "
            "a folder 'pictures' there."},
    PICTURE_SETTINGS,
    {.name = "skip",
     .shape = KEY_LIST,
     .value = KEY_PATTERN,
     .form = "a list of paths",
     .example = "skip: [\"drafts/**\"]",
     .doc = "Patterns of scenes that have no picture: * and ? within one folder, ** across folders."},
    {.name = "tests",
     .shape = KEY_MAP,
     .value = KEY_TEST_PICTURE,
     .form = "a map from pictures to their settings",
     .example = "tests: {side.png: {scene: hall.glint.yaml, camera: side}}",
     .doc = "Pictures with settings of their own, by their paths in the folder of pictures."},
};
const struct key_table TEST_KEYS = {"setting", test_rows, sizeof test_rows / sizeof *test_rows};

static const struct key_row test_pictures[] = {
    {.name = "scene",
     .value = KEY_PATH,
     .form = "the path of a scene",
     .example = "scene: hall.glint.yaml",
     .doc = "The scene, relative to this file; without it, the scene whose name the picture has."},
    PICTURE_SETTINGS,
};
const struct key_table TEST_PICTURE_KEYS = {"setting of a picture", test_pictures,
                                            sizeof test_pictures / sizeof *test_pictures};

static const struct key_row test_bounds[] = {
#define X(NAME, text, title, of_displayed, from, to, bound, option, argument, fails, holds)                  \
    {.name = text, .value = KEY_METRIC, .least = from, .greatest = to, .offset = METRIC_##NAME, .doc = holds},
#include "picture/metrics/metrics.def"
#undef X
    {.name = "threshold",
     .value = KEY_THRESHOLD,
     .greatest = 1,
     .doc = "From which difference of a channel a pixel is off, of displayed values from 0 to 1; 2/255 "
            "without it."},
    {.name = "not_finite",
     .value = KEY_PIXELS,
     .form = "a number of 0 or more",
     .greatest = RANGE_BROKEN_MOST,
     .doc = "How many pixels may be infinite or not a number in one of the two float pictures only."},
};
const struct key_table TEST_BOUND_KEYS = {"metric", test_bounds, sizeof test_bounds / sizeof *test_bounds};

const char *key_form(const struct key_row *row, struct arena *arena) {
    if (row->form)
        return row->form;
    if (row->greatest == HUGE_VAL)
        return arena_format(arena, "a number of %g or more", row->least).ptr;
    return arena_format(arena, "%s from %.15g to %.15g",
                        row->value == KEY_SIZE           ? "a width and a height"
                        : row->value == KEY_WHOLE_NUMBER ? "a whole number"
                                                         : "a number",
                        row->least, row->greatest)
        .ptr;
}

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

bool key_report_unknown(const struct key_table *table, struct diag_sink *sink, diag_code code, span at,
                        str name, const struct nearest *search) {
    str best = nearest_best(search);
    diag_add(sink, code, at, "there is no %s '%.*s'", table->what, STR_ARG(name));
    if (best.len)
        diag_help(sink, "did you mean '%.*s'?", STR_ARG(best));
    return best.len > 0;
}
