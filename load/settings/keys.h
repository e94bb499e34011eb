// Tables of the keys that the small YAML files beside scenes may have: settings, limits, bounds.
//
// One row per key, as in the table of the scene language (grammar/schema.h): its name, its kind of value, its
// range, one sentence. The reader, "did you mean" and the JSON Schema come from the rows; no other file lists
// the names. Thread safety: constant data.
#ifndef GLINT_LOAD_SETTINGS_KEYS_H
#define GLINT_LOAD_SETTINGS_KEYS_H

#include "core/arena.h"
#include "core/nearest.h"
#include "diag/diag.h"

enum key_shape {
    KEY_ONE,  // one value
    KEY_LIST, // each item is a value
    KEY_MAP,  // each pair has a value
};

// What a value is.
enum key_value {
    KEY_FOLDER,
    KEY_CODE,          // W401, or a family, W4xx
    KEY_CODE_OR_PATH,  // the same, or a pattern of paths
    KEY_CODE_SEVERITY, // of a map: from codes to severities
    KEY_FAIL_WORD,
    KEY_LIMIT,        // of a map: from limits to numbers
    KEY_MAX_MESSAGES, // the limit on messages
    KEY_WHOLE_NUMBER, // from `least` to `greatest`
    KEY_AXIS_BOUNDS,  // of a list: the bounds of an axis
    KEY_FROM_TO,      // a number from `least`, where a bound begins or ends
    KEY_BOUND,        // likewise, the most that a metric may be
    // Of the file of `glint test`:
    KEY_PATH,         // of a scene
    KEY_PATTERN,      // of paths
    KEY_CAMERA,       // its name
    KEY_DEVICE,       // its name
    KEY_SIZE,         // "320x240", each from `least` to `greatest`
    KEY_ASSIGNMENT,   // PATH=VALUE
    KEY_TEST_BOUNDS,  // a map of TEST_BOUND_KEYS
    KEY_TEST_PICTURE, // of a map: from pictures to TEST_PICTURE_KEYS
    KEY_METRIC,       // a number from `least` to `greatest`: the most that the metric `offset` may be
    KEY_THRESHOLD,    // likewise, of a share
    KEY_PIXELS,       // likewise, how many
};

struct key_row {
    const char *name;
    enum key_shape shape;
    enum key_value value;
    const char *form; // for "'only' takes ..."; NULL: key_form makes it from the range
    const char *example;
    double least, greatest; // of numbers
    uint32_t axes;          // KEY_AXIS_BOUNDS: bit 1 << axis
    uint32_t offset;        // of the number in struct extreme_bound; KEY_METRIC: enum metric
    const char *doc;
};

struct key_table {
    const char *what; // "setting", as in "there is no setting 'x'"
    const struct key_row *rows;
    uint32_t count;
};

extern const struct key_table SETTING_KEYS; // of .glintrc.yaml
extern const struct key_table
    LIMIT_KEYS; // of its limits, in the order of enum limit; each from its least value to its default
extern const struct key_table AXIS_KEYS;         // of a file of bounds
extern const struct key_table BOUND_KEYS;        // of one bound
extern const struct key_table TEST_KEYS;         // of glint-test.yaml
extern const struct key_table TEST_PICTURE_KEYS; // of one picture in it
extern const struct key_table TEST_BOUND_KEYS;   // of its bounds

// What a value of the row is, in words: "a whole number from 1 to 4096". In the arena, whose guard the caller
// sets.
const char *key_form(const struct key_row *row, struct arena *arena);
// The row of a name; if it is NULL, `search` holds the nearest one.
const struct key_row *key_find(const struct key_table *table, str name, struct nearest *search);
// "a, b and c", in the arena, whose guard the caller sets.
str key_list(const struct key_table *table, struct arena *arena);
// Reports an unknown key, with the one that may be meant; false: no name is near.
bool key_report_unknown(const struct key_table *table, struct diag_sink *sink, diag_code code, span at,
                        str name, const struct nearest *search);

#endif
