// THE table: one row for every attribute of the scene language (schema.c).
//
// Binder, writers, JSON Schema, RELAX NG, the reference page, `glint explain`, the feature mask, the
// fuzz dictionary and the generator of random scenes all walk it; none of them knows an element's name.
// Adding an attribute is one field in ir.h, one row here, one use, one scene.
// Thread safety: constant data.
#ifndef GLINT_GRAMMAR_SCHEMA_H
#define GLINT_GRAMMAR_SCHEMA_H

#include "core/str.h"

#include <stdbool.h>
#include <stdint.h>

struct arena;

// What a row's field is; derived from the field's C type.
enum schema_kind {
    SCHEMA_BOOLEAN,   // bool
    SCHEMA_INTEGER,   // int32_t
    SCHEMA_NUMBER,    // double
    SCHEMA_WORD,      // unsigned: one of `words`
    SCHEMA_TEXT,      // str: see schema_text
    SCHEMA_VECTOR,    // vec3: x y z
    SCHEMA_PAIR,      // struct ir_pair: u v
    SCHEMA_POINT,     // struct ir_point: x y
    SCHEMA_QUAD,      // struct ir_quad: x y z t
    SCHEMA_COLOR,     // struct ir_color: r g b, one number, or #rrggbb (an XML element: hex="#rrggbb")
    SCHEMA_WEIGHTS,   // struct ir_weights: diffuse specular reflection refraction
    SCHEMA_ELEMENT,   // a child struct, described by `child`
    SCHEMA_REFERENCE, // struct ir_reference: a name, or a body that becomes an anonymous element; of a row
                      // with a `file`, text with a point is the path of one
    SCHEMA_LIST,      // {items, count, capacity} of `child`
};

// In a colour that is an XML element, #rrggbb is this attribute.
#define SCHEMA_HEX_ATTRIBUTE "hex"

enum schema_text {
    SCHEMA_TEXT_FREE,
    SCHEMA_TEXT_NAME,         // the language's names
    SCHEMA_TEXT_BODY_NAME,    // a body's name in the language
    SCHEMA_TEXT_FOREIGN_NAME, // a name from another file: any text but the empty one
    SCHEMA_TEXT_PATH,
    SCHEMA_TEXT_TARGET, // the path to a number of the scene, as in --set: any text but the empty one
    SCHEMA_TEXT_VALUES, // one to four numbers, expressions (core/expression.h) or #rrggbb, with ", "
                        // between them; YAML: one of them, or a list
    SCHEMA_TEXT_LIST,   // a list of any length of the same, with three of them in brackets for a vector;
                        // YAML: a list
};

// Which kind of file a SCHEMA_TEXT_PATH names.
enum schema_file {
    SCHEMA_FILE_NONE,
    SCHEMA_FILE_SCENE,
    SCHEMA_FILE_IMAGE,
    SCHEMA_FILE_MESH,
    SCHEMA_FILE_FONT,
};

enum schema_unit {
    SCHEMA_UNIT_NONE,
    SCHEMA_UNIT_SCENE, // scene units of length
    SCHEMA_UNIT_DEGREES,
    SCHEMA_UNIT_PIXELS,
};

enum schema_range {
    SCHEMA_RANGE_NONE, // kinds without numbers
    SCHEMA_RANGE_VERSION,
    SCHEMA_RANGE_EXTENT,     // 1..RANGE_SIDE_MOST
    SCHEMA_RANGE_SAMPLES,    // 1..RANGE_SAMPLES_MOST
    SCHEMA_RANGE_DEPTH,      // 0..64
    SCHEMA_RANGE_FRACTION,   // 0..1
    SCHEMA_RANGE_COORDINATE, // -1e18..1e18
    SCHEMA_RANGE_LENGTH,     // 1e-18..1e18
    SCHEMA_RANGE_DISTANCE,   // 0..1e18
    SCHEMA_RANGE_SCALE,      // magnitude 1e-18..1e18 (0 has its own diagnostic)
    SCHEMA_RANGE_WEIGHT,     // 0..1e6
    SCHEMA_RANGE_ANGLE,      // -1e6..1e6
    SCHEMA_RANGE_FOV,        // above 0, up to 360
    SCHEMA_RANGE_EXPONENT,   // 0..1e6
    SCHEMA_RANGE_INDEX,      // 0.1..10
    SCHEMA_RANGE_PRIORITY,   // -1000..1000
    SCHEMA_RANGE_REPEAT,     // 1e-6..1e6
    SCHEMA_RANGE_SHIFT,      // -1e6..1e6
    SCHEMA_RANGE_SIZE,       // 0..1e18
    SCHEMA_RANGE_OPENING,    // 0..180
    SCHEMA_RANGE_TURN,       // above 0, up to 360
    SCHEMA_RANGE_TOLERANCE,  // 1e-6..0.1
    SCHEMA_RANGE_CORNER,     // 0..RANGE_CORNER_MOST
    SCHEMA_RANGE_FRAMES,     // 1..RANGE_FRAMES_MOST
    SCHEMA_RANGE_FRAME,      // 0..RANGE_FRAMES_MOST
    SCHEMA_RANGE_RATE,       // 0.001..1000
    SCHEMA_RANGE_STOPS,      // -100..100
    SCHEMA_RANGE_COPIES,     // 0..RANGE_COPIES_MOST
    SCHEMA_RANGE_COUNT,
};

struct schema_range_info {
    const char *name; // "coordinate", "field_of_view": as schemas define it
    double least, greatest;
    bool open;        // the least value is excluded
    bool magnitude;   // the ends apply to the absolute value; 0 is accepted by the range itself
    const char *text; // "from 0 to 1"
};

enum schema_many {
    SCHEMA_ONE,
    SCHEMA_SEQUENCE,  // YAML: a list under `plural`; XML: the element repeated
    SCHEMA_NAMED_MAP, // YAML: a map under `plural` from the child's key row; XML: the element repeated
    SCHEMA_FIXED,     // exactly `fixed_count` values side by side in the struct; spelled like a list
};

enum schema_choice_rule {
    SCHEMA_CHOICE_NONE,
    SCHEMA_CHOICE_AT_MOST_ONE,
    SCHEMA_CHOICE_EXACTLY_ONE,
};

struct schema_element;

struct schema_row {
    const char *name;    // YAML key of one value, XML attribute; snake_case
    const char *element; // XML child element, PascalCase; NULL: an attribute only
    const char *plural;  // YAML key of the list or map; NULL: as `name`
    const char *also; // what other programs call it, separated by spaces: for "did you mean"; NULL: nothing
    enum schema_kind kind;
    uint32_t offset; // of the field in the element's struct
    uint32_t size;   // of the field in bytes
    enum schema_text text;
    enum schema_file file; // SCHEMA_TEXT_PATH
    enum schema_unit unit;
    enum schema_range range;
    const char *standard; // the default, as scene text ("0 1 0", "clip", "true"); NULL: none
    const char *example;  // a value worth showing, as scene text; NULL if examples leave the row out. Of a
                          // SCHEMA_LIST: the short rows of its items, ", " between them
    bool example_alone;   // the example shows the row alone: the element's example leaves it out
    const char *example_next; // SCHEMA_FIXED: of the values after the first
    const char *const *words; // SCHEMA_WORD: in the order of the enum, NULL at the end
    const char *const *word_docs;
    bool required;
    bool fill;       // SCHEMA_VECTOR, SCHEMA_PAIR: a single number fills all components
    bool short_form; // the element's bare scalar or sequence is this row; of two, the second has the sequence
    bool key;        // in a named map, the map's key; written as an attribute in XML
    bool counted;    // the name of a body, which may end in the places of a copy: pawn[3][0]
    bool plain;      // its numbers are written, never computed
    bool aside;      // says nothing about the picture: no part of a scene's hash
    enum schema_many many;
    const char *single;   // SCHEMA_NAMED_MAP: YAML `name: {...}` is one entry with this key
    uint32_t fixed_count; // SCHEMA_FIXED
    // Rows of one choice exclude each other; taking one stores `alternative` in the element's tag field.
    uint8_t choice; // 0: none; else an index into the element's choices, from 1
    uint8_t alternative;
    // FEATURE_ bit while the value is not zero, false, the first word, empty, or white
    uint64_t feature;
    bool feature_of_first;              // SCHEMA_WORD: the bit is the first word's and no other's
    uint64_t weight_features[4];        // SCHEMA_WEIGHTS: one per component
    const struct schema_element *child; // SCHEMA_ELEMENT, SCHEMA_REFERENCE, SCHEMA_LIST
    const char *doc;                    // one sentence
};

struct schema_choice {
    enum schema_choice_rule rule;
    uint32_t tag_offset; // of an `unsigned` field
};

struct schema_element {
    const char *name;    // snake_case, singular: "light"
    const char *element; // PascalCase: "Light"
    const char *doc;
    const struct schema_row *rows;
    uint32_t row_count;
    uint32_t size;                   // of the struct in bytes; its first member is struct ir_head
    struct schema_choice choices[3]; // by schema_row.choice - 1
};

extern const struct schema_element SCHEMA_SCENE, SCHEMA_INCLUDE, SCHEMA_PARAMETER, SCHEMA_VARIABLE,
    SCHEMA_IMAGE, SCHEMA_TRACE, SCHEMA_CAMERA, SCHEMA_BACKGROUND, SCHEMA_AMBIENT, SCHEMA_LIGHT, SCHEMA_PANEL,
    SCHEMA_SPOT, SCHEMA_MATERIAL, SCHEMA_PAINT, SCHEMA_CHECKER, SCHEMA_TEXTURE, SCHEMA_HIGHLIGHT, SCHEMA_MESH,
    SCHEMA_LATHE, SCHEMA_OUTLINE_POINT, SCHEMA_TORUS, SCHEMA_EXTRUDE, SCHEMA_HOLE, SCHEMA_FACES,
    SCHEMA_VERTEX, SCHEMA_UV, SCHEMA_FACE, SCHEMA_CORNER, SCHEMA_MESH_TEXT, SCHEMA_SPHERE, SCHEMA_RECTANGLE,
    SCHEMA_BOX, SCHEMA_CYLINDER, SCHEMA_CONE, SCHEMA_MODEL, SCHEMA_MAP_ENTRY, SCHEMA_OBJECT, SCHEMA_INSTANCE,
    SCHEMA_WITH, SCHEMA_MATRIX, SCHEMA_MATRIX_ROW, SCHEMA_ANIMATION, SCHEMA_TRACK, SCHEMA_KEYFRAME;

// All elements, the scene first; NULL at the end.
extern const struct schema_element *const schema_elements[];

const struct schema_range_info *schema_range_info(enum schema_range range);
// Whether `value` is in the range; never true for NaN and infinity.
bool schema_in_range(enum schema_range range, double value);

// Index of the row of this name ("up"), or -1.
int schema_find_row(const struct schema_element *element, str name);
// The words of a row that has words, by their numbers; NULL ends them.
const char *const *schema_words(const struct schema_element *element, const char *row);
// The number of one of them; negative: it is not one.
int schema_word(const char *const *words, str text);
// Index of the row that a YAML key names: by plural for a list or map, by name otherwise, or by name for a
// named map with `single` (then *is_single is true). -1: none.
int schema_find_yaml(const struct schema_element *element, str key, bool *is_single);
// Index of the row that an XML child element names, or -1.
int schema_find_child(const struct schema_element *element, str name);
// Index of the row that other programs call `name` (snake_case), or one so many letters off; or -1.
int schema_find_also(const struct schema_element *element, str name, unsigned distance);
// Index of the short row, of that for a sequence, or of the key row, or -1.
int schema_short_row(const struct schema_element *element);
int schema_list_row(const struct schema_element *element);
int schema_key_row(const struct schema_element *element);
// Whether XML can write the row as an attribute: scalars always, vectors and colours if one number or #rrggbb
// is enough, references by name.
bool schema_is_attribute(const struct schema_row *row);
// The YAML key of a row: its plural if it has one.
const char *schema_yaml_key(const struct schema_row *row);
// Names of a kind's components: {"x","y","z"}, {"r","g","b"}, {"diffuse",...}; NULL at the end.
const char *const *schema_components(enum schema_kind kind);
// Whether its text is of values: SCHEMA_TEXT_VALUES, SCHEMA_TEXT_LIST.
static inline bool schema_has_values(const struct schema_row *row) {
    return row->kind == SCHEMA_TEXT && (row->text == SCHEMA_TEXT_VALUES || row->text == SCHEMA_TEXT_LIST);
}
// Whether an expression may stand there.
bool schema_may_compute(const struct schema_row *row);
uint32_t schema_component_count(enum schema_kind kind); // 0: it has none
// Endings of the files of a kind: {".png", ".jpg", ...}; NULL at the end.
const char *const *schema_file_endings(enum schema_file kind);
// The same as words: ".png, .jpg, .jpeg or .hdr".
str schema_file_words(enum schema_file kind, struct arena *arena);
// Whether a path has an ending of the kind's files, ignoring case.
bool schema_file_fits(enum schema_file kind, str path);

// Sets a field of one value (number, word, text, vector, colour, weights, boolean) from scene text, which
// must be valid: the table's own defaults and examples. Text is not copied.
void schema_set_field(const struct schema_row *row, void *field, const char *text);
// Fills a struct with the defaults of all its rows, children included; `memory` holds zeros before.
void schema_init(const struct schema_element *element, void *memory);
// Address of a row's field.
static inline void *schema_field(const struct schema_row *row, void *element) {
    return (char *)element + row->offset;
}
static inline const void *schema_field_const(const struct schema_row *row, const void *element) {
    return (const char *)element + row->offset;
}

#endif
