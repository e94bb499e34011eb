// Queries on the table: rows by name, ranges, defaults.
#include "grammar/schema.h"

#include "core/arena.h"
#include "core/nearest.h"
#include "core/number.h"
#include "core/ranges.h"
#include "core/vec3.h"
#include "grammar/ir_value.h"
#include "grammar/mesh_format.h"
#include "picture/formats/formats.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct schema_range_info ranges[SCHEMA_RANGE_COUNT] = {
    [SCHEMA_RANGE_NONE] = {"none", -INFINITY, INFINITY, true, false, "any finite number"},
    [SCHEMA_RANGE_VERSION] = {"version", 1, 1, false, false, "1"},
    [SCHEMA_RANGE_EXTENT] = {"extent", 1, RANGE_SIDE_MOST, false, false,
                             "from 1 to " RANGE_TEXT(RANGE_SIDE_MOST)},
    [SCHEMA_RANGE_SAMPLES] = {"samples", 1, RANGE_SAMPLES_MOST, false, false,
                              "from 1 to " RANGE_TEXT(RANGE_SAMPLES_MOST)},
    [SCHEMA_RANGE_DEPTH] = {"depth", 0, 64, false, false, "from 0 to 64"},
    [SCHEMA_RANGE_FRACTION] = {"fraction", 0, 1, false, false, "from 0 to 1"},
    [SCHEMA_RANGE_COORDINATE] = {"coordinate", -1e18, 1e18, false, false, "from -1e18 to 1e18"},
    [SCHEMA_RANGE_LENGTH] = {"length", 1e-18, 1e18, false, false, "from 1e-18 to 1e18"},
    [SCHEMA_RANGE_DISTANCE] = {"distance", 0, 1e18, false, false, "from 0 to 1e18"},
    [SCHEMA_RANGE_SCALE] = {"scale", 1e-18, 1e18, false, true, "of magnitude 1e-18 to 1e18"},
    [SCHEMA_RANGE_WEIGHT] = {"weight", 0, 1e6, false, false, "from 0 to 1e6"},
    [SCHEMA_RANGE_ANGLE] = {"angle", -1e6, 1e6, false, false, "from -1e6 to 1e6"},
    [SCHEMA_RANGE_FOV] = {"field_of_view", 0, 360, true, false, "greater than 0 and at most 360"},
    [SCHEMA_RANGE_EXPONENT] = {"exponent", 0, 1e6, false, false, "from 0 to 1e6"},
    [SCHEMA_RANGE_INDEX] = {"index", 0.1, 10, false, false, "from 0.1 to 10"},
    [SCHEMA_RANGE_PRIORITY] = {"priority", -1000, 1000, false, false, "from -1000 to 1000"},
    [SCHEMA_RANGE_REPEAT] = {"repeat", 1e-6, 1e6, false, false, "from 1e-6 to 1e6"},
    [SCHEMA_RANGE_SHIFT] = {"shift", -1e6, 1e6, false, false, "from -1e6 to 1e6"},
    [SCHEMA_RANGE_SIZE] = {"size", 0, 1e18, false, false, "from 0 to 1e18"},
    [SCHEMA_RANGE_OPENING] = {"opening", 0, 180, false, false, "from 0 to 180"},
    [SCHEMA_RANGE_TURN] = {"turn", 0, 360, true, false, "greater than 0 and at most 360"},
    [SCHEMA_RANGE_TOLERANCE] = {"tolerance", 1e-6, 0.1, false, false, "from 1e-6 to 0.1"},
    [SCHEMA_RANGE_CORNER] = {"corner", 0, RANGE_CORNER_MOST, false, false,
                             "from 0 to " RANGE_TEXT(RANGE_CORNER_MOST)},
    [SCHEMA_RANGE_FRAMES] = {"frames", 1, RANGE_FRAMES_MOST, false, false,
                             "from 1 to " RANGE_TEXT(RANGE_FRAMES_MOST)},
    [SCHEMA_RANGE_FRAME] = {"frame", 0, RANGE_FRAMES_MOST, false, false,
                            "from 0 to " RANGE_TEXT(RANGE_FRAMES_MOST)},
    [SCHEMA_RANGE_STOPS] = {"stops", -100, 100, false, false, "from -100 to 100"},
    [SCHEMA_RANGE_RATE] = {"rate", RANGE_RATE_LEAST, RANGE_RATE_MOST, false, false,
                           "from " RANGE_TEXT(RANGE_RATE_LEAST) " to " RANGE_TEXT(RANGE_RATE_MOST)},
    [SCHEMA_RANGE_COPIES] = {"copies", 0, RANGE_COPIES_MOST, false, false,
                             "from 0 to " RANGE_TEXT(RANGE_COPIES_MOST)},
};

// clang-format off
const struct schema_element *const schema_elements[] = {
    &SCHEMA_SCENE,
    &SCHEMA_INCLUDE,
    &SCHEMA_PARAMETER,
    &SCHEMA_VARIABLE,
    &SCHEMA_IMAGE,
    &SCHEMA_TRACE,
    &SCHEMA_CAMERA,
    &SCHEMA_BACKGROUND,
    &SCHEMA_AMBIENT,
    &SCHEMA_LIGHT,
    &SCHEMA_PANEL,
    &SCHEMA_SPOT,
    &SCHEMA_MATERIAL,
    &SCHEMA_PAINT,
    &SCHEMA_CHECKER,
    &SCHEMA_TEXTURE,
    &SCHEMA_HIGHLIGHT,
    &SCHEMA_MESH,
    &SCHEMA_LATHE,
    &SCHEMA_OUTLINE_POINT,
    &SCHEMA_TORUS,
    &SCHEMA_EXTRUDE,
    &SCHEMA_HOLE,
    &SCHEMA_FACES,
    &SCHEMA_VERTEX,
    &SCHEMA_UV,
    &SCHEMA_FACE,
    &SCHEMA_CORNER,
    &SCHEMA_MESH_TEXT,
    &SCHEMA_SPHERE,
    &SCHEMA_RECTANGLE,
    &SCHEMA_BOX,
    &SCHEMA_CYLINDER,
    &SCHEMA_CONE,
    &SCHEMA_MODEL,
    &SCHEMA_MAP_ENTRY,
    &SCHEMA_OBJECT,
    &SCHEMA_INSTANCE,
    &SCHEMA_WITH,
    &SCHEMA_MATRIX,
    &SCHEMA_MATRIX_ROW,
    &SCHEMA_ANIMATION,
    &SCHEMA_TRACK,
    &SCHEMA_KEYFRAME,
    NULL,
};
// clang-format on

const struct schema_range_info *schema_range_info(enum schema_range range) {
    return &ranges[range];
}

bool schema_in_range(enum schema_range range, double value) {
    const struct schema_range_info *info = &ranges[range];
    if (!isfinite(value))
        return false;
    if (info->magnitude && value == 0)
        return true;
    double v = info->magnitude ? fabs(value) : value;
    return (info->open ? v > info->least : v >= info->least) && v <= info->greatest;
}

const char *const *schema_words(const struct schema_element *element, const char *row) {
    return element->rows[schema_find_row(element, str_from(row))].words;
}

int schema_word(const char *const *words, str text) {
    for (int i = 0; words[i]; i++)
        if (str_equal_cstr(text, words[i]))
            return i;
    return -1;
}

int schema_find_row(const struct schema_element *element, str name) {
    for (uint32_t i = 0; i < element->row_count; i++)
        if (str_equal_cstr(name, element->rows[i].name))
            return (int)i;
    return -1;
}

const char *schema_yaml_key(const struct schema_row *row) {
    return row->plural ? row->plural : row->name;
}

int schema_find_yaml(const struct schema_element *element, str key, bool *is_single) {
    *is_single = false;
    for (uint32_t i = 0; i < element->row_count; i++) {
        const struct schema_row *row = &element->rows[i];
        if (row->key)
            continue;
        if (str_equal_cstr(key, schema_yaml_key(row)))
            return (int)i;
        if (row->single && str_equal_cstr(key, row->name)) {
            *is_single = true;
            return (int)i;
        }
    }
    return -1;
}

bool schema_is_attribute(const struct schema_row *row) {
    if (row->many != SCHEMA_ONE || row->kind == SCHEMA_LIST || row->kind == SCHEMA_WEIGHTS ||
        row->kind == SCHEMA_QUAD)
        return false;
    if (row->kind == SCHEMA_VECTOR || row->kind == SCHEMA_PAIR || row->kind == SCHEMA_POINT)
        return row->fill;
    if (row->kind != SCHEMA_ELEMENT)
        return true;
    const int only = schema_short_row(row->child);
    return only >= 0 && row->child->rows[only].kind != SCHEMA_LIST;
}

int schema_find_child(const struct schema_element *element, str name) {
    for (uint32_t i = 0; i < element->row_count; i++)
        if (element->rows[i].element && str_equal_cstr(name, element->rows[i].element))
            return (int)i;
    return -1;
}

int schema_find_also(const struct schema_element *element, str name, unsigned distance) {
    for (uint32_t i = 0; i < element->row_count; i++) {
        str rest = str_from(element->rows[i].also);
        while (rest.len) {
            const char *blank = memchr(rest.ptr, ' ', rest.len);
            size_t end = blank ? (size_t)(blank - rest.ptr) : rest.len;
            const str word = str_slice(rest, 0, end);
            if (str_equal(word, name) || (distance && nearest_distance(word, name) <= distance))
                return (int)i;
            rest = str_slice(rest, blank ? end + 1 : end, rest.len);
        }
    }
    return -1;
}

int schema_short_row(const struct schema_element *element) {
    for (uint32_t i = 0; i < element->row_count; i++)
        if (element->rows[i].short_form)
            return (int)i;
    return -1;
}

int schema_list_row(const struct schema_element *element) {
    for (uint32_t i = element->row_count; i-- > 0;)
        if (element->rows[i].short_form)
            return (int)i;
    return -1;
}

int schema_key_row(const struct schema_element *element) {
    for (uint32_t i = 0; i < element->row_count; i++)
        if (element->rows[i].key)
            return (int)i;
    return -1;
}

const char *const *schema_components(enum schema_kind kind) {
    static const char *const xyz[] = {"x", "y", "z", NULL};
    static const char *const xy[] = {"x", "y", NULL};
    static const char *const xyzt[] = {"x", "y", "z", "t", NULL};
    static const char *const uv[] = {"u", "v", NULL};
    static const char *const rgb[] = {"r", "g", "b", NULL};
    static const char *const weights[] = {"diffuse", "specular", "reflection", "refraction", NULL};
    static const char *const none[] = {NULL};
    return kind == SCHEMA_VECTOR    ? xyz
           : kind == SCHEMA_PAIR    ? uv
           : kind == SCHEMA_POINT   ? xy
           : kind == SCHEMA_QUAD    ? xyzt
           : kind == SCHEMA_COLOR   ? rgb
           : kind == SCHEMA_WEIGHTS ? weights
                                    : none;
}

uint32_t schema_component_count(enum schema_kind kind) {
    uint32_t count = 0;
    for (const char *const *names = schema_components(kind); names[count];)
        count++;
    return count;
}

const char *const *schema_file_endings(enum schema_file kind) {
    static const char *const scenes[] = {".yaml", ".yml", ".json", ".xml", NULL};
    static const char *const fonts[] = {".ttf", ".otf", ".ttc", NULL};
    static const char *const none[] = {NULL};
    return kind == SCHEMA_FILE_SCENE   ? scenes
           : kind == SCHEMA_FILE_IMAGE ? image_scene_endings()
           : kind == SCHEMA_FILE_MESH  ? mesh_format_endings
           : kind == SCHEMA_FILE_FONT  ? fonts
                                       : none;
}

str schema_file_words(enum schema_file kind, struct arena *arena) {
    str words = STR("");
    for (const char *const *ending = schema_file_endings(kind); *ending; ending++) {
        const char *joint = words.len == 0 ? "" : ending[1] ? ", " : " or ";
        words = arena_format(arena, "%.*s%s%s", STR_ARG(words), joint, *ending);
    }
    return words;
}

bool schema_file_fits(enum schema_file kind, str path) {
    for (const char *const *ending = schema_file_endings(kind); *ending; ending++)
        if (str_ends_with_nocase(path, *ending))
            return true;
    return false;
}

static uint32_t read_numbers(const char *text, double out[4]) {
    uint32_t count = 0;
    str rest = str_from(text);
    while (rest.len && count < 4) {
        size_t end = 0;
        while (end < rest.len && rest.ptr[end] != ' ')
            end++;
        number_parse(str_slice(rest, 0, end), &out[count++]);
        rest = str_trim(str_slice(rest, end, rest.len));
    }
    return count;
}

static unsigned word_index(const struct schema_row *row, const char *word) {
    unsigned i = 0;
    while (row->words[i] && strcmp(row->words[i], word) != 0)
        i++;
    return i;
}

static struct ir_color read_color(const char *text) {
    double n[4] = {0};
    if (text[0] == '#')
        return (struct ir_color){.is_hex = true, .hex = (uint32_t)strtoul(text + 1, NULL, 16)};
    if (read_numbers(text, n) == 1)
        n[1] = n[2] = n[0];
    return (struct ir_color){.r = n[0], .g = n[1], .b = n[2]};
}

void schema_set_field(const struct schema_row *row, void *field, const char *text) {
    double n[4] = {0};
    if (row->kind == SCHEMA_INTEGER || row->kind == SCHEMA_NUMBER || row->kind == SCHEMA_VECTOR ||
        row->kind == SCHEMA_PAIR || row->kind == SCHEMA_POINT || row->kind == SCHEMA_WEIGHTS ||
        row->kind == SCHEMA_QUAD)
        read_numbers(text, n);
    switch (row->kind) {
    case SCHEMA_BOOLEAN:
        *(bool *)field = strcmp(text, "true") == 0;
        break;
    case SCHEMA_INTEGER:
        *(int32_t *)field = (int32_t)n[0];
        break;
    case SCHEMA_NUMBER:
        *(double *)field = n[0];
        break;
    case SCHEMA_WORD:
        *(unsigned *)field = word_index(row, text);
        break;
    case SCHEMA_TEXT:
        *(str *)field = str_from(text);
        break;
    case SCHEMA_VECTOR:
        *(vec3 *)field = (vec3){n[0], n[1], n[2]};
        break;
    case SCHEMA_PAIR:
        *(struct ir_pair *)field = (struct ir_pair){n[0], n[1]};
        break;
    case SCHEMA_POINT:
        *(struct ir_point *)field = (struct ir_point){n[0], n[1]};
        break;
    case SCHEMA_QUAD:
        *(struct ir_quad *)field = (struct ir_quad){n[0], n[1], n[2], n[3]};
        break;
    case SCHEMA_COLOR:
        *(struct ir_color *)field = read_color(text);
        break;
    case SCHEMA_WEIGHTS:
        *(struct ir_weights *)field = (struct ir_weights){n[0], n[1], n[2], n[3]};
        break;
    case SCHEMA_REFERENCE:
        *(struct ir_reference *)field = (struct ir_reference){.name = str_from(text), .index = IR_NO_INDEX};
        break;
    case SCHEMA_ELEMENT:
    case SCHEMA_LIST:
        break;
    }
}

static void init_field(const struct schema_row *row, void *field) {
    if (row->kind == SCHEMA_ELEMENT)
        schema_init(row->child, field);
    else if (row->kind == SCHEMA_REFERENCE)
        ((struct ir_reference *)field)->index = IR_NO_INDEX;
    else if (row->standard)
        schema_set_field(row, field, row->standard);
}

void schema_init(const struct schema_element *element, void *memory) {
    for (uint32_t i = 0; i < element->row_count; i++) {
        const struct schema_row *row = &element->rows[i];
        uint32_t count = row->many == SCHEMA_FIXED ? row->fixed_count : 1;
        for (uint32_t k = 0; k < count; k++)
            init_field(row, (char *)schema_field(row, memory) + (size_t)k * row->size);
    }
}

bool schema_may_compute(const struct schema_row *row) {
    const bool has_numbers = schema_components(row->kind)[0] || row->kind == SCHEMA_NUMBER ||
                             row->kind == SCHEMA_INTEGER || row->kind == SCHEMA_BOOLEAN;
    return has_numbers && !row->plain;
}
