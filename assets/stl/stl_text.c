#include "assets/stl/stl_text.h"
#include "diag/codes/file.h"

#include "assets/file/mesh_number.h"
#include "core/str_map.h"

#include <stdio.h>

#include <math.h>

enum {
    SHOWN_MOST = 64,
    VERTICES_GUESS = 1024,
};

// The kinds of line that may be at a place.
enum place {
    OUTSIDE,
    IN_SOLID,
    IN_FACET,
    IN_LOOP,
    AFTER_LOOP,
};

struct text_reader {
    struct asset_file *file;
    struct arena *scratch;
    struct polygons *out;
    struct join join;
    struct str_map groups; // 1 + index, by name
    str text;
    size_t at, end; // the next word, and the end of the line
    uint32_t line;  // from 1
    str name;       // of the solid
    uint32_t name_line;
    uint32_t facet_line, first; // of the facet: its line, and its first corner
    enum place place;
    bool is_full; // a limit is exceeded: read no further
};

// ---- words

static str next_word(struct text_reader *r) {
    while (r->at < r->end && char_is_blank(r->text.ptr[r->at]))
        r->at++;
    const size_t begin = r->at;
    while (r->at < r->end && !char_is_blank(r->text.ptr[r->at]))
        r->at++;
    return str_slice(r->text, begin, r->at);
}

static bool is_word(str word, const char *keyword) {
    return word.len == strlen(keyword) && str_ends_with_nocase(word, keyword);
}

static void report_word(struct text_reader *r, diag_code code, str word, const char *what) {
    const size_t at = (size_t)(word.ptr - r->text.ptr);
    const int shown = word.len < SHOWN_MOST ? (int)word.len : SHOWN_MOST;
    asset_report(r->file, code, at, at + word.len, "'%.*s' %s", shown, word.ptr, what);
}

// ---- lines

static double read_coordinate(struct text_reader *r) {
    const str word = next_word(r);
    double value = 0;
    const enum number_status status = mesh_number(word, &value);
    if (word.len == 0)
        asset_report_line(r->file, DIAG_MESH_SYNTAX, r->line, "a vertex has three numbers");
    else if (status != NUMBER_OK)
        report_word(r, DIAG_MESH_NUMBER, word, number_problem(status));
    else if (fabs(value) > MESH_COORDINATE_MAX)
        report_word(r, DIAG_MESH_NUMBER, word, "is larger than 1e18");
    return status == NUMBER_OK && fabs(value) <= MESH_COORDINATE_MAX ? value + 0.0 : 0;
}

static void read_vertex(struct text_reader *r) {
    const vec3 position = {read_coordinate(r), read_coordinate(r), read_coordinate(r)};
    struct polygon_corner *corner = ARENA_PUSH(r->scratch, &r->out->corners);
    corner->normal = IR_NO_INDEX;
    join_vertices(&r->join, &position, 1, &corner->vertex);
}

static void begin_solid(struct text_reader *r) {
    r->name = str_trim(str_slice(r->text, r->at, r->end));
    r->name_line = r->name.len ? r->line : 0;
    r->at = r->end;
}

// The group of the solid; made by its first facet.
static uint32_t current_group(struct text_reader *r) {
    uint32_t *number = str_map_at(&r->groups, r->name);
    if (*number == 0) {
        struct mesh_group *group = ARENA_PUSH(r->scratch, &r->out->groups);
        *group = (struct mesh_group){.name = r->name, .line = r->name_line};
        *number = r->out->groups.count;
    }
    return *number - 1;
}

static bool fits(struct text_reader *r, str word, uint32_t corners) {
    const struct limits *limits = r->file->input->limits;
    const enum limit limit =
        corners > limits->value[LIMIT_MESH_CORNERS] ? LIMIT_MESH_CORNERS : LIMIT_MESH_TRIANGLES;
    const size_t at = (size_t)(word.ptr - r->text.ptr);
    if (limit == LIMIT_MESH_TRIANGLES && r->out->triangle_count <= limits->value[limit])
        return true;
    asset_report_limit(r->file, limit, at, at + word.len, 2 * limits->value[limit]);
    r->is_full = true;
    return false;
}

static void end_facet(struct text_reader *r, str word) {
    const uint32_t corners = r->out->corners.count - r->first;
    if (corners < 3) {
        asset_report_line(r->file, DIAG_MESH_FACE, r->facet_line, "a facet with %u corner%s", corners,
                          corners == 1 ? "" : "s");
        return;
    }
    r->out->triangle_count += corners - 2;
    *ARENA_PUSH(r->scratch, &r->out->faces) =
        (struct polygon_face){.first = r->first, .line = r->facet_line, .group = current_group(r)};
    fits(r, word, corners);
}

// The kind of the line. false: it is not allowed there.
static bool take_line(struct text_reader *r, str word) {
    static const struct {
        const char *word;
        enum place from, to;
    } lines[] = {
        {"solid", OUTSIDE, IN_SOLID},    {"facet", IN_SOLID, IN_FACET},    {"outer", IN_FACET, IN_LOOP},
        {"vertex", IN_LOOP, IN_LOOP},    {"endloop", IN_LOOP, AFTER_LOOP}, {"endfacet", AFTER_LOOP, IN_SOLID},
        {"endsolid", IN_SOLID, OUTSIDE},
    };
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        if (lines[i].from == r->place && is_word(word, lines[i].word)) {
            r->place = lines[i].to;
            return true;
        }
    return false;
}

static void read_line(struct text_reader *r) {
    static const char *const expected[] = {"'solid'", "'facet' or 'endsolid'", "'outer loop'",
                                           "'vertex' or 'endloop'", "'endfacet'"};
    const str word = next_word(r);
    char what[128];
    if (word.len == 0)
        return;
    if (!take_line(r, word)) {
        snprintf(what, sizeof what, "is not expected here: this is the place for %s", expected[r->place]);
        report_word(r, DIAG_MESH_SYNTAX, word, what);
        r->is_full = true; // everything after it is in the wrong place too
        return;
    }
    if (is_word(word, "solid"))
        begin_solid(r);
    if (is_word(word, "vertex"))
        read_vertex(r);
    if (is_word(word, "facet")) {
        r->facet_line = r->line;
        r->first = r->out->corners.count;
    }
    if (is_word(word, "endfacet"))
        end_facet(r, word);
}

static void next_line(struct text_reader *r, size_t *next) {
    r->at = *next;
    r->end = r->at;
    while (r->end < r->text.len && !char_is_break(r->text.ptr[r->end]))
        r->end++;
    *next = r->end < r->text.len ? r->end + str_break_length(r->text, r->end) : r->end;
    r->line++;
}

void read_stl_text(struct asset_file *file, struct arena *scratch, struct polygons *out) {
    struct text_reader r = {.file = file, .scratch = scratch, .out = out, .text = file->text};
    size_t next = str_skip_mark(file->text);
    str_map_init(&r.groups, scratch);
    join_init(&r.join, scratch, out, VERTICES_GUESS);
    while (next < r.text.len && !r.is_full) {
        next_line(&r, &next);
        read_line(&r);
    }
    if (file->errors)
        return;
    if (r.place != OUTSIDE)
        asset_report_line(file, DIAG_MESH_SYNTAX, r.line, "the file ends within a %s",
                          r.place == IN_SOLID ? "solid: 'endsolid' is missing" : "facet");
    else if (out->faces.count == 0)
        asset_report_line(file, DIAG_MESH_EMPTY, 0, "the mesh has no faces");
    // Programs write all kinds of things after the word: it counts as a name if it distinguishes solids.
    if (out->groups.count == 1)
        out->groups.items[0] = (struct mesh_group){.name = STR("")};
}
