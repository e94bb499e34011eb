#include "assets/ply/ply_header.h"

#include "core/number.h"
#include "diag/codes/file.h"
#include "grammar/mesh_format.h"

#include <string.h>

enum {
    HEADER_BYTES_MOST = 1 << 20,
    SHOWN_MOST = 64, // bytes of a word in a message
};

const unsigned char ply_type_bytes[PLY_TYPES] = {0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};

struct header_reader {
    struct asset_file *file;
    struct arena *arena;
    struct ply_header *out;
    str text;
    const char *line_end;  // the line end, as after the first line
    size_t at;             // the next line
    size_t begin, end;     // this line
    size_t word;           // in this line, the next word
    size_t taken;          // the last one
    bool has_format, ends; // "end_header" was read
};

// ---- lines and words

static const char *line_end_of(str text) {
    const char *cr = memchr(text.ptr, '\r', text.len < SHOWN_MOST ? text.len : SHOWN_MOST);
    const char *lf = memchr(text.ptr, '\n', text.len < SHOWN_MOST ? text.len : SHOWN_MOST);
    if (!cr || (lf && lf < cr))
        return "\n";
    return lf == cr + 1 ? "\r\n" : "\r";
}

// The next line; false: the text has no further complete line.
static bool next_line(struct header_reader *r) {
    const size_t length = strlen(r->line_end);
    r->begin = r->word = r->at;
    for (size_t at = r->at; at + length <= r->text.len; at++)
        if (memcmp(r->text.ptr + at, r->line_end, length) == 0) {
            r->end = at;
            r->at = at + length;
            return true;
        }
    r->end = r->text.len;
    return false;
}

static str next_word(struct header_reader *r) {
    while (r->word < r->end && char_is_blank(r->text.ptr[r->word]))
        r->word++;
    r->taken = r->word;
    while (r->word < r->end && !char_is_blank(r->text.ptr[r->word]))
        r->word++;
    return str_slice(r->text, r->taken, r->word);
}

static void report_word(struct header_reader *r, str word, const char *what) {
    const size_t at = (size_t)(word.ptr - r->text.ptr);
    const int shown = word.len < SHOWN_MOST ? (int)word.len : SHOWN_MOST;
    if (word.len)
        asset_report(r->file, DIAG_MESH_SYNTAX, at, at + word.len, "'%.*s' %s", shown, word.ptr, what);
    else
        asset_report(r->file, DIAG_MESH_SYNTAX, r->begin, r->end, "this line ends where something %s", what);
}

// ---- types

static enum ply_type type_of(str word) {
    static const char *const names[PLY_TYPES][3] = {
        [PLY_INT8] = {"char", "int8"},        [PLY_UINT8] = {"uchar", "uint8"},
        [PLY_INT16] = {"short", "int16"},     [PLY_UINT16] = {"ushort", "uint16"},
        [PLY_INT32] = {"int", "int32"},       [PLY_UINT32] = {"uint", "uint32"},
        [PLY_INT64] = {"int64", "long"},      [PLY_UINT64] = {"uint64", "ulong"},
        [PLY_FLOAT32] = {"float", "float32"}, [PLY_FLOAT64] = {"double", "float64"},
    };
    for (enum ply_type type = PLY_NONE + 1; type < PLY_TYPES; type++)
        if (str_equal_cstr(word, names[type][0]) || str_equal_cstr(word, names[type][1]))
            return type;
    return PLY_NONE;
}

static enum ply_type take_type(struct header_reader *r) {
    const str word = next_word(r);
    const enum ply_type type = type_of(word);
    if (type == PLY_NONE)
        report_word(r, word, "should be a type: char, uchar, short, ushort, int, uint, float or double");
    return type;
}

static enum ply_type take_count_type(struct header_reader *r) {
    const enum ply_type type = take_type(r);
    if (type == PLY_NONE || ply_is_whole(type))
        return type;
    report_word(r, str_slice(r->text, r->taken, r->word),
                "cannot count the items of a list: choose a whole type, such as uchar");
    return PLY_NONE;
}

// ---- lines of each kind

static void read_format(struct header_reader *r) {
    static const char *const forms[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const str word = next_word(r);
    for (enum ply_form form = PLY_TEXT; form <= PLY_BIG; form++)
        if (str_equal_cstr(word, forms[form])) {
            r->out->form = form;
            r->has_format = true;
        }
    if (!r->has_format)
        report_word(r, word, "should be ascii, binary_little_endian or binary_big_endian");
}

static void read_element(struct header_reader *r) {
    struct ply_element *element = ARENA_PUSH(r->arena, &r->out->elements);
    const str name = next_word(r);
    const str word = next_word(r);
    int64_t count = 0;
    *element = (struct ply_element){.name = name, .at = r->begin, .end = r->end};
    if (name.len == 0 || number_parse_integer(word, &count) != NUMBER_OK || count < 0)
        report_word(r, word, "should be the number of elements");
    else if (count >= UINT32_MAX)
        report_word(r, word, "is more than 4294967294");
    else
        element->count = (uint32_t)count;
}

static void read_property(struct header_reader *r) {
    struct ply_property property = {.name = STR("")};
    if (r->out->elements.count == 0) {
        report_word(r, str_slice(r->text, r->begin, r->word), "belongs after an element");
        return;
    }
    struct ply_element *element = &r->out->elements.items[r->out->elements.count - 1];
    const size_t before = r->word;
    const bool is_list = str_equal_cstr(next_word(r), "list");
    if (!is_list)
        r->word = before;
    if (is_list && (property.count = take_count_type(r)) == PLY_NONE)
        return;
    if ((property.type = take_type(r)) == PLY_NONE)
        return;
    property.name = next_word(r);
    if (property.name.len == 0)
        report_word(r, property.name, "should be the property's name");
    *ARENA_PUSH(r->arena, &element->properties) = property;
    element->has_lists |= is_list;
    element->bytes_least += ply_type_bytes[is_list ? property.count : property.type];
}

static void read_line(struct header_reader *r) {
    const str word = next_word(r);
    if (str_equal_cstr(word, "format"))
        read_format(r);
    else if (str_equal_cstr(word, "element"))
        read_element(r);
    else if (str_equal_cstr(word, "property"))
        read_property(r);
    else if (str_equal_cstr(word, "end_header"))
        r->ends = true;
    else if (word.len && !str_equal_cstr(word, "comment") && !str_equal_cstr(word, "obj_info"))
        report_word(r, word, "cannot begin a line of a PLY header");
}

// ---- the whole

// Whether the form is binary, decided before anything is reported: how the file is shown depends on it.
static void look_ahead(struct header_reader *r) {
    const struct header_reader start = *r;
    while (next_line(r) && r->at <= HEADER_BYTES_MOST) {
        const str word = next_word(r);
        if (str_equal_cstr(word, "format"))
            r->file->is_binary = str_starts_with(next_word(r), STR("binary"));
        if (str_equal_cstr(word, "end_header"))
            break;
    }
    r->file->head_bytes = (uint32_t)(r->at < HEADER_BYTES_MOST ? r->at : HEADER_BYTES_MOST);
    *r = start;
}

static void report_other(struct asset_file *file) {
    const enum mesh_format_id id = mesh_format_of_text(file->text);
    file->is_binary = true; // perhaps it is: show none of its text
    if (asset_report_byte(file, DIAG_MESH_SYNTAX, 0, "a PLY file begins with a line 'ply'") &&
        id != MESH_FORMAT_COUNT)
        diag_help(file->input->sink, "this is %s: let its name end in %s", mesh_formats[id].called,
                  mesh_formats[id].endings[0]);
}

// A file cannot hold more elements than it has bytes for: in text each value takes a digit and a separator,
// which the last one may lack.
static void check_counts(struct header_reader *r) {
    uint64_t left = r->text.len - r->out->bytes + (r->out->form == PLY_TEXT);
    for (uint32_t i = 0; i < r->out->elements.count; i++) {
        const struct ply_element *element = &r->out->elements.items[i];
        const uint64_t least =
            r->out->form == PLY_TEXT ? 2 * (uint64_t)element->properties.count : element->bytes_least;
        if (element->count * least > left) {
            asset_report(r->file, DIAG_MESH_SYNTAX, element->at, element->end,
                         "%u of '%.*s' are announced, and the file has room for %llu at most", element->count,
                         STR_ARG(element->name), (unsigned long long)(left / least));
            return;
        }
        left -= element->count * least;
    }
}

bool ply_read_header(struct asset_file *file, struct arena *arena, struct ply_header *out) {
    struct header_reader r = {.file = file, .arena = arena, .out = out, .text = file->text};
    const uint32_t before = file->errors;
    *out = (struct ply_header){0};
    r.line_end = line_end_of(r.text);
    if (!next_line(&r) || !str_equal_cstr(str_slice(r.text, r.begin, r.end), "ply")) {
        report_other(file);
        return false;
    }
    look_ahead(&r);
    for (out->lines = 1; !r.ends && r.at <= HEADER_BYTES_MOST && next_line(&r); out->lines++)
        read_line(&r);
    out->bytes = r.at;
    if (!r.ends)
        asset_report(file, DIAG_MESH_SYNTAX, r.begin, r.end, "the header does not end with 'end_header'");
    else if (!r.has_format && file->errors == before)
        asset_report(file, DIAG_MESH_SYNTAX, 0, 3, "the header has no line 'format'");
    if (file->errors == before)
        check_counts(&r);
    return file->errors == before;
}

const struct ply_element *ply_find_element(const struct ply_header *header, const char *name) {
    for (uint32_t i = 0; i < header->elements.count; i++)
        if (str_equal_cstr(header->elements.items[i].name, name))
            return &header->elements.items[i];
    return NULL;
}

uint32_t ply_find_property(const struct ply_element *element, const char *const *names) {
    for (; *names; names++)
        for (uint32_t i = 0; i < element->properties.count; i++)
            if (str_equal_cstr(element->properties.items[i].name, *names))
                return i;
    return PLY_ABSENT;
}
