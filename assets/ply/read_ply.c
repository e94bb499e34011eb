#include "assets/ply/read_ply.h"
#include "diag/codes/file.h"

#include "assets/ply/ply_plain.h"
#include "assets/ply/ply_rows.h"
#include "core/parallel.h"

#include <math.h>
#include <stdatomic.h>
#include <stdio.h>

enum {
    NORMALS = 3, // the first of nx ny nz, after x y z
    TEXTURE = 6, // of u v
    COLUMNS = 8, // values of a vertex
    SHOWN_MOST = 64,
};

// Reads the rows of elements: with threads that only note that there is a fault, or with one thread that
// reports.
struct ply_reading {
    struct asset_file *file;
    struct arena *scratch;
    struct polygons *out;
    struct ply_header header;
    struct ply_extent *extents;                         // of the header's elements
    const struct ply_extent *vertices, *faces, *strips; // without rows if the file has none
    uint8_t *column_of;          // the column of each vertex property; COLUMNS: one that is not read
    bool has_normals;            // of vertices
    uint32_t texcoord;           // the property of a face; PLY_ABSENT
    struct ir_pair *coordinates; // of textures, by vertex or by corner
    bool *has_texture;           // by face: whether it has its own coordinates
    bool is_quiet;
    atomic_bool is_faulty;
};

// ---- faults

static size_t offset(const struct ply_reading *r, const char *at) {
    return (size_t)(at - r->file->text.ptr);
}

// Notes a fault; whether it must be reported.
static bool is_told(struct ply_reading *r) {
    atomic_store_explicit(&r->is_faulty, true, memory_order_relaxed);
    return !r->is_quiet;
}

// Reads a value; reports what is wrong with it.
static void report_value(struct ply_reading *r, diag_code code, const char *begin, const char *end,
                         double value, const char *what) {
    if (!is_told(r))
        return;
    if (r->header.form != PLY_TEXT) {
        asset_report_byte(r->file, code, offset(r, begin), "%.9g %s", value, what);
        return;
    }
    while (begin < end && char_is_blank(*begin))
        begin++;
    const int shown = end - begin < SHOWN_MOST ? (int)(end - begin) : SHOWN_MOST;
    asset_report(r->file, code, offset(r, begin), offset(r, end), "'%.*s' %s", shown, begin, what);
}

// A row that does not have the form that the header says.
static void report_row(struct ply_reading *r, diag_code code, const struct ply_cursor *c, const char *what) {
    if (!is_told(r))
        return;
    if (r->header.form == PLY_TEXT)
        asset_report_line(r->file, code, c->line, "%s", what);
    else
        asset_report_byte(r->file, code, offset(r, c->at), "%s", what);
}

static void report_status(struct ply_reading *r, enum ply_status status, const char *begin,
                          const struct ply_cursor *c, enum number_status why) {
    if (status == PLY_BAD)
        report_value(r, DIAG_MESH_NUMBER, begin, c->at, 0, number_problem(why));
    else
        report_row(r, DIAG_MESH_SYNTAX, c, "the line has fewer values than the header says");
}

static void end_row(struct ply_reading *r, struct ply_cursor *c, bool is_whole) {
    const struct ply_cursor before = *c;
    if (!ply_end_row(c) && is_whole)
        report_row(r, DIAG_MESH_SYNTAX, &before, "the line has more values than the header says");
}

// ---- by threads

struct piece_work {
    struct ply_reading *r;
    const struct ply_extent *extent;
    void (*row)(struct ply_reading *r, struct ply_cursor *c, uint32_t row, uint32_t *item);
};

static void read_piece(void *context, size_t begin, size_t end) {
    const struct piece_work *w = context;
    const size_t piece = begin / PLY_PIECE;
    struct ply_cursor c = ply_piece(w->extent, piece);
    uint32_t item = w->extent->starts ? w->extent->starts[piece].items : 0;
    for (size_t row = begin; row < end; row++) {
        ply_begin_row(&c);
        w->row(w->r, &c, (uint32_t)row, &item);
    }
}

// Reads all rows of an element, on all processors; if there is a fault, again in order to report it. false:
// there was one.
static bool read_rows(struct ply_reading *r, const struct ply_extent *extent,
                      void (*row)(struct ply_reading *r, struct ply_cursor *c, uint32_t row,
                                  uint32_t *item)) {
    struct piece_work work = {r, extent, row};
    const uint32_t count = extent->element->count;
    r->is_quiet = true;
    atomic_store(&r->is_faulty, false);
    parallel_for(count, PLY_PIECE, read_piece, &work);
    if (!atomic_load(&r->is_faulty))
        return true;
    r->is_quiet = false;
    for (size_t begin = 0; begin < count; begin += PLY_PIECE)
        read_piece(&work, begin, begin + PLY_PIECE < count ? begin + PLY_PIECE : count);
    return false;
}

// ---- vertices

static enum ply_status skip_property(struct ply_cursor *c, const struct ply_property *property) {
    uint32_t count = 1;
    const enum ply_status status = property->count ? ply_count(c, property->count, &count) : PLY_OK;
    return status == PLY_OK && !ply_skip(c, property->type, count) ? PLY_ENDS : status;
}

// A coordinate, or a texture coordinate. false: the rest of the row cannot be read.
static bool read_coordinate(struct ply_reading *r, struct ply_cursor *c, enum ply_type type, double *value) {
    const char *begin = c->at;
    enum number_status why = NUMBER_OK;
    const enum ply_status status = ply_number(c, type, value, &why);
    if (status != PLY_OK)
        report_status(r, status, begin, c, why);
    else if (!(fabs(*value) <= MESH_COORDINATE_MAX))
        report_value(r, DIAG_MESH_NUMBER, begin, c->at, *value, "is not a number up to 1e18");
    return status != PLY_ENDS;
}

// A part of a normal; NaN if it is not a number, so that the normal counts as one of length 0.
static bool read_normal(struct ply_reading *r, struct ply_cursor *c, enum ply_type type, double *value) {
    enum number_status why = NUMBER_OK;
    const enum ply_status status = ply_number(c, type, value, &why);
    if (status == PLY_ENDS)
        report_status(r, status, c->at, c, why);
    if (status == PLY_BAD || !(fabs(*value) <= MESH_COORDINATE_MAX))
        *value = NAN;
    return status != PLY_ENDS;
}

static void keep_vertex(struct ply_reading *r, uint32_t row, const double value[COLUMNS]) {
    const double *n = value + NORMALS;
    // A sum with 0 is never -0.
    r->out->vertices.items[row] = (vec3){value[0] + 0.0, value[1] + 0.0, value[2] + 0.0};
    if (r->has_normals)
        r->out->normals.items[row] = isnan(n[0] + n[1] + n[2]) ? (vec3){0, 0, 0} : (vec3){n[0], n[1], n[2]};
}

static void read_vertex(struct ply_reading *r, struct ply_cursor *c, uint32_t row, uint32_t *item) {
    const struct ply_element *element = r->vertices->element;
    double value[COLUMNS] = {0};
    bool is_whole = true;
    (void)item;
    for (uint32_t i = 0; is_whole && i < element->properties.count; i++) {
        const struct ply_property *property = &element->properties.items[i];
        const uint32_t column = r->column_of[i];
        if (column < NORMALS)
            is_whole = read_coordinate(r, c, property->type, &value[column]);
        else if (column < TEXTURE)
            is_whole = read_normal(r, c, property->type, &value[column]);
        else if (skip_property(c, property) != PLY_OK) {
            report_row(r, DIAG_MESH_SYNTAX, c, "the line has fewer values than the header says");
            is_whole = false;
        }
    }
    end_row(r, c, is_whole);
    keep_vertex(r, row, value);
}

// ---- faces

static uint32_t vertex_count(const struct ply_reading *r) {
    return r->vertices->element->count;
}

// A corner's vertex; false: the rest of the row cannot be read.
static bool read_index(struct ply_reading *r, struct ply_cursor *c, enum ply_type type, uint32_t *index) {
    const char *begin = c->at;
    double value = 0;
    enum number_status why = NUMBER_OK;
    char what[128];
    const enum ply_status status = ply_number(c, type, &value, &why);
    *index = 0;
    if (status != PLY_OK) {
        report_status(r, status, begin, c, why);
    } else if (!(value >= 0 && value < vertex_count(r)) || floor(value) != value) {
        snprintf(what, sizeof what, "is not a vertex: the file has %u, counted from 0", vertex_count(r));
        report_value(r, DIAG_MESH_INDEX, begin, c->at, value, what);
    } else {
        *index = (uint32_t)value;
    }
    return status != PLY_ENDS;
}

static struct polygon_corner corner_of(const struct ply_reading *r, uint32_t vertex) {
    return (struct polygon_corner){vertex, r->has_normals ? vertex : IR_NO_INDEX};
}

static bool read_corners(struct ply_reading *r, struct ply_cursor *c, const struct ply_property *list,
                         uint32_t *item) {
    uint32_t count = 0, vertex;
    const struct ply_cursor before = *c;
    if (ply_count(c, list->count, &count) != PLY_OK)
        return false; // cannot happen: the row was walked over
    if (count < 3)
        report_row(r, DIAG_MESH_FACE, &before, "a face with fewer than three corners");
    for (uint32_t i = 0; i < count; i++) {
        if (!read_index(r, c, list->type, &vertex))
            return false;
        r->out->corners.items[(*item)++] = corner_of(r, vertex);
    }
    return true;
}

static void read_face(struct ply_reading *r, struct ply_cursor *c, uint32_t row, uint32_t *item) {
    const struct ply_element *element = r->faces->element;
    const uint32_t first = *item;
    bool is_whole = true;
    r->out->faces.items[row] = (struct polygon_face){
        .first = first, .line = r->header.form == PLY_TEXT ? c->line : row + 1, .group = 0};
    for (uint32_t i = 0; is_whole && i < element->properties.count; i++) {
        const struct ply_property *property = &element->properties.items[i];
        if (i == r->faces->list) {
            is_whole = read_corners(r, c, property, item);
        } else if (skip_property(c, property) != PLY_OK) {
            report_row(r, DIAG_MESH_SYNTAX, c, "the line has fewer values than the header says");
            is_whole = false;
        }
    }
    end_row(r, c, is_whole);
}

// ---- strips

struct strip {
    uint32_t last[2]; // vertices
    uint32_t length;  // so far
};

// Every vertex after the second makes a triangle with the two before it; every other triangle is turned
// round. Those that repeat a vertex only lead from one strip to another.
static void add_to_strip(struct ply_reading *r, struct strip *strip, uint32_t vertex, uint32_t line) {
    const uint32_t a = strip->last[0], b = strip->last[1];
    strip->last[0] = b;
    strip->last[1] = vertex;
    if (strip->length++ < 2 || a == b || b == vertex || a == vertex)
        return;
    const bool is_turned = strip->length % 2 == 0;
    struct polygons *out = r->out;
    out->faces.items[out->faces.count++] = (struct polygon_face){.first = out->corners.count, .line = line};
    out->corners.items[out->corners.count++] = corner_of(r, is_turned ? b : a);
    out->corners.items[out->corners.count++] = corner_of(r, is_turned ? a : b);
    out->corners.items[out->corners.count++] = corner_of(r, vertex);
    out->triangle_count++;
}

// Whether it is the index that ends a strip; then the cursor is past it.
static bool take_strip_end(struct ply_cursor *c, enum ply_type type) {
    struct ply_cursor after = *c;
    double value;
    enum number_status why;
    const bool ends = ply_number(&after, type, &value, &why) == PLY_OK && value == -1;
    if (ends)
        *c = after;
    return ends;
}

static void read_strips_of_row(struct ply_reading *r, struct ply_cursor *c, uint32_t row, uint32_t *item) {
    const struct ply_element *element = r->strips->element;
    const uint32_t line = r->header.form == PLY_TEXT ? c->line : row + 1;
    bool is_whole = true;
    (void)item;
    for (uint32_t i = 0; is_whole && i < element->properties.count; i++) {
        const struct ply_property *property = &element->properties.items[i];
        struct strip strip = {.length = 0};
        uint32_t count = 0, vertex;
        if (i != r->strips->list) {
            is_whole = skip_property(c, property) == PLY_OK;
            continue;
        }
        is_whole = ply_count(c, property->count, &count) == PLY_OK;
        for (; is_whole && count; count--) {
            if (take_strip_end(c, property->type))
                strip.length = 0;
            else if ((is_whole = read_index(r, c, property->type, &vertex)))
                add_to_strip(r, &strip, vertex, line);
        }
    }
    end_row(r, c, is_whole);
}

// By one thread: how many triangles a strip gives is known when it has been read.
static void read_strips(struct ply_reading *r) {
    struct ply_cursor c = ply_piece(r->strips, 0);
    r->is_quiet = false;
    for (uint32_t row = 0; row < r->strips->element->count; row++) {
        ply_begin_row(&c);
        read_strips_of_row(r, &c, row, NULL);
    }
}

// ---- the whole

static void find_columns(struct ply_reading *r, const struct ply_element *vertex) {
    static const char *const names[COLUMNS][5] = {{"x"},
                                                  {"y"},
                                                  {"z"},
                                                  {"nx"},
                                                  {"ny"},
                                                  {"nz"},
                                                  {"u", "s", "texture_u", "texture_s"},
                                                  {"v", "t", "texture_v", "texture_t"}};
    static const char *const colors[] = {"red", "r", "diffuse_red", NULL};
    uint32_t found = 0;
    r->column_of = ARENA_ARRAY(r->scratch, uint8_t, vertex->properties.count + 1);
    for (uint32_t i = 0; i < vertex->properties.count; i++)
        r->column_of[i] = COLUMNS;
    for (uint32_t column = 0; column < COLUMNS; column++) {
        const uint32_t at = ply_find_property(vertex, names[column]);
        if (at == PLY_ABSENT || vertex->properties.items[at].count)
            continue;
        r->column_of[at] = (uint8_t)column;
        found |= 1U << column;
    }
    r->has_normals = (found >> NORMALS & 7) == 7;
    if ((found & 7) != 7)
        asset_report(r->file, DIAG_MESH_SYNTAX, vertex->at, vertex->end, "a vertex has no property '%s'",
                     names[found & 1 ? (found & 2 ? 2 : 1) : 0][0]);
    if (ply_find_property(vertex, colors) != PLY_ABSENT)
        r->out->losses[MESH_LOSS_SCANNED].count = vertex->count;
}

static void find_texcoord(struct ply_reading *r) {
    static const char *const names[] = {"texcoord", "texcoords", NULL};
    r->texcoord = r->faces ? ply_find_property(r->faces->element, names) : PLY_ABSENT;
    if (r->texcoord != PLY_ABSENT && !r->faces->element->properties.items[r->texcoord].count)
        r->texcoord = PLY_ABSENT;
}

// Finds the rows of every element, in the order of the file.
static bool walk(struct ply_reading *r) {
    static const char *const indices[] = {"vertex_indices", "vertex_index", NULL};
    struct ply_cursor c = {r->file->text.ptr + r->header.bytes, r->file->text.ptr + r->file->text.len,
                           r->header.lines + 1, r->header.form};
    r->extents = ARENA_ARRAY(r->scratch, struct ply_extent, r->header.elements.count + 1);
    for (uint32_t i = 0; i < r->header.elements.count; i++) {
        const struct ply_element *element = &r->header.elements.items[i];
        struct ply_extent *extent = &r->extents[i];
        *extent = (struct ply_extent){.element = element, .list = PLY_ABSENT};
        if (str_equal_cstr(element->name, "vertex") && !r->vertices)
            r->vertices = extent;
        const bool is_face = str_equal_cstr(element->name, "face") && !r->faces;
        const bool is_strip = str_equal_cstr(element->name, "tristrips") && !r->strips;
        if (is_face || is_strip)
            extent->list = ply_find_property(element, indices);
        if (extent->list != PLY_ABSENT && element->properties.items[extent->list].count)
            *(is_face ? &r->faces : &r->strips) = extent;
        else if ((is_face || is_strip) && element->count)
            asset_report(r->file, DIAG_MESH_SYNTAX, element->at, element->end,
                         "'%.*s' has no list 'vertex_indices'", STR_ARG(element->name));
        if (extent->list != PLY_ABSENT && !ply_is_whole(element->properties.items[extent->list].type))
            asset_report(r->file, DIAG_MESH_SYNTAX, element->at, element->end,
                         "the '%.*s' of '%.*s' must be whole numbers, such as int",
                         STR_ARG(element->properties.items[extent->list].name), STR_ARG(element->name));
        if (r->file->errors || !ply_walk(r->file, r->scratch, &c, extent))
            return false;
    }
    ply_begin_row(&c);
    r->out->losses[MESH_LOSS_REST].count = c.end - c.at < UINT32_MAX ? (uint32_t)(c.end - c.at) : UINT32_MAX;
    return true;
}

static bool fits(struct ply_reading *r, const struct ply_extent *extent, enum limit limit, uint64_t value) {
    if (value <= r->file->input->limits->value[limit])
        return true;
    asset_report_limit(r->file, limit, extent->element->at, extent->element->end, value);
    return false;
}

static bool begin(struct ply_reading *r) {
    if (!ply_read_header(r->file, r->scratch, &r->header) || !walk(r))
        return false;
    const struct ply_extent *faces = r->faces, *strips = r->strips;
    const uint64_t face_count = faces ? faces->element->count : 0;
    const uint64_t strip_items = strips ? strips->items : 0;
    if (face_count + strip_items == 0) {
        if (asset_report_line(r->file, DIAG_MESH_EMPTY, 0, "the mesh has no faces") && r->vertices)
            diag_help(r->file->input->sink,
                      "it has %u points: a program for scans can make a surface of them", vertex_count(r));
        return false;
    }
    if (!r->vertices) {
        asset_report_line(r->file, DIAG_MESH_SYNTAX, 0, "the file has faces, and no 'vertex'");
        return false;
    }
    find_columns(r, r->vertices->element);
    find_texcoord(r);
    return r->file->errors == 0 && (!faces || fits(r, faces, LIMIT_MESH_TRIANGLES, face_count)) &&
           (!faces || fits(r, faces, LIMIT_MESH_CORNERS, faces->items_most)) &&
           (!faces || faces->items <= 2 * face_count ||
            fits(r, faces, LIMIT_MESH_TRIANGLES, faces->items - 2 * face_count)) &&
           (!strips || fits(r, strips, LIMIT_MESH_TRIANGLES, strip_items));
}

static void make_room(struct ply_reading *r) {
    struct polygons *out = r->out;
    const uint32_t faces = r->faces ? r->faces->element->count : 0;
    const uint32_t corners = r->faces ? (uint32_t)r->faces->items : 0;
    const size_t of_strips = r->strips ? r->strips->items : 0;
    out->vertices.count = out->vertices.capacity = vertex_count(r);
    out->vertices.items = ARENA_ARRAY(r->scratch, vec3, vertex_count(r));
    out->normals.count = out->normals.capacity = r->has_normals ? vertex_count(r) : 0;
    out->normals.items = ARENA_ARRAY(r->scratch, vec3, out->normals.count);
    out->faces.count = faces;
    out->faces.capacity = faces + (uint32_t)of_strips;
    out->faces.items = ARENA_ARRAY(r->scratch, struct polygon_face, out->faces.capacity);
    out->corners.count = corners;
    out->corners.capacity = corners + 3 * (uint32_t)of_strips;
    out->corners.items = ARENA_ARRAY(r->scratch, struct polygon_corner, out->corners.capacity);
    out->triangle_count = corners > 2 * (uint64_t)faces ? corners - 2 * (uint64_t)faces : 0;
    *ARENA_PUSH(r->scratch, &out->groups) = (struct mesh_group){.name = STR("")};
}

// ---- rows that are plain

struct plain_work {
    struct ply_reading *r;
    struct ply_plain_vertices vertices;
    struct ply_plain_faces faces;
};

static void note(struct ply_reading *r, bool is_fine) {
    if (!is_fine)
        atomic_store_explicit(&r->is_faulty, true, memory_order_relaxed);
}

static void read_plain_vertices(void *context, size_t begin, size_t end) {
    const struct plain_work *w = context;
    const struct ply_cursor c = ply_piece(w->r->vertices, begin / PLY_PIECE);
    note(w->r, ply_read_plain_vertices(&w->vertices, c.at, begin, end));
}

static void read_plain_faces(void *context, size_t begin, size_t end) {
    const struct plain_work *w = context;
    struct ply_reading *r = w->r;
    const struct ply_cursor c = ply_piece(r->faces, begin / PLY_PIECE);
    note(r, ply_read_plain_faces(&w->faces, c.at, begin, end, vertex_count(r), r->has_normals,
                                 r->faces->starts[begin / PLY_PIECE].items, r->out));
}

// Each is read in the general way if it is not plain, or if there is a fault, which the general way reports.
static void read_vertices_and_faces(struct ply_reading *r) {
    struct plain_work w = {.r = r};
    bool is_plain =
        ply_plain_vertices(r->vertices->element, r->header.form, r->column_of, r->has_normals, &w.vertices);
    w.vertices.positions = r->out->vertices.items;
    w.vertices.normals = r->out->normals.items;
    if (is_plain)
        parallel_for(vertex_count(r), PLY_PIECE, read_plain_vertices, &w);
    if (!is_plain || atomic_load(&r->is_faulty))
        read_rows(r, r->vertices, read_vertex);
    if (!r->faces)
        return;
    is_plain = ply_plain_faces(r->faces->element, r->header.form, r->faces->list, &w.faces);
    atomic_store(&r->is_faulty, false);
    if (is_plain)
        parallel_for(r->faces->element->count, PLY_PIECE, read_plain_faces, &w);
    if (!is_plain || atomic_load(&r->is_faulty))
        read_rows(r, r->faces, read_face);
}

static void read_all(struct ply_reading *r) {
    const struct ply_element *edges = ply_find_element(&r->header, "edge");
    make_room(r);
    read_vertices_and_faces(r);
    if (r->strips)
        read_strips(r);
    r->out->losses[MESH_LOSS_NOT_FACES].count = edges ? edges->count : 0;
    if (r->out->faces.count == 0 && r->file->errors == 0)
        asset_report_line(r->file, DIAG_MESH_EMPTY, 0, "the mesh has no faces");
}

void read_ply(struct asset_file *file, struct arena *scratch, struct polygons *out) {
    struct ply_reading r = {.file = file, .scratch = scratch, .out = out};
    *out = (struct polygons){0};
    if (begin(&r))
        read_all(&r);
    out->is_binary = file->is_binary;
}

// ---- texture coordinates

static void read_vertex_texture(struct ply_reading *r, struct ply_cursor *c, uint32_t row, uint32_t *item) {
    const struct ply_element *element = r->vertices->element;
    double value[COLUMNS] = {0};
    bool is_whole = true;
    (void)item;
    for (uint32_t i = 0; is_whole && i < element->properties.count; i++) {
        const struct ply_property *property = &element->properties.items[i];
        const uint32_t column = r->column_of[i];
        is_whole = column >= TEXTURE && column < COLUMNS
                       ? read_coordinate(r, c, property->type, &value[column])
                       : skip_property(c, property) == PLY_OK;
    }
    end_row(r, c, is_whole);
    r->coordinates[row] = (struct ir_pair){value[TEXTURE], value[TEXTURE + 1]};
}

// Two numbers for each corner; otherwise the face has none.
static void read_face_texture(struct ply_reading *r, struct ply_cursor *c, uint32_t row, uint32_t *item) {
    const struct ply_element *element = r->faces->element;
    const uint32_t first = r->out->faces.items[row].first;
    const uint32_t corners =
        (row + 1 < r->out->faces.count ? r->out->faces.items[row + 1].first : r->out->corners.count) - first;
    bool is_whole = true;
    (void)item;
    for (uint32_t i = 0; is_whole && i < element->properties.count; i++) {
        const struct ply_property *property = &element->properties.items[i];
        uint32_t count = 0;
        if (i != r->texcoord) {
            is_whole = skip_property(c, property) == PLY_OK;
            continue;
        }
        is_whole = ply_count(c, property->count, &count) == PLY_OK;
        for (uint32_t k = 0; is_whole && k < count; k++) {
            double value = 0;
            is_whole = read_coordinate(r, c, property->type, &value);
            if (count == 2 * corners)
                *(k % 2 ? &r->coordinates[first + k / 2].v : &r->coordinates[first + k / 2].u) = value;
        }
        r->has_texture[row] = count == 2 * corners;
    }
    end_row(r, c, is_whole);
}

static bool has_vertex_texture(const struct ply_reading *r) {
    uint32_t found = 0;
    for (uint32_t i = 0; i < r->vertices->element->properties.count; i++)
        found |= 1U << r->column_of[i];
    return (found >> TEXTURE & 3) == 3;
}

// Whether there are coordinates; if so, all have been read.
static bool read_texture(struct ply_reading *r, struct textured_faces *out) {
    const bool by_corner = r->texcoord != PLY_ABSENT;
    if (!by_corner && !has_vertex_texture(r))
        return false;
    const uint32_t count = by_corner ? r->out->corners.count : vertex_count(r);
    r->coordinates = ARENA_ARRAY(r->scratch, struct ir_pair, count);
    r->has_texture = ARENA_ARRAY(r->scratch, bool, r->out->faces.count);
    read_rows(r, by_corner ? r->faces : r->vertices, by_corner ? read_face_texture : read_vertex_texture);
    out->coordinates.items = r->coordinates;
    out->coordinates.count = out->coordinates.capacity = count;
    return true;
}

void read_ply_coordinates(struct asset_file *file, struct arena *scratch, struct textured_faces *out) {
    struct polygons polygons = {0};
    struct ply_reading r = {.file = file, .scratch = scratch, .out = &polygons};
    *out = (struct textured_faces){0};
    if (!begin(&r))
        return;
    read_all(&r);
    if (file->errors)
        return;
    const bool has = read_texture(&r, out), by_corner = r.texcoord != PLY_ABSENT;
    out->vertex_count = vertex_count(&r);
    out->faces.count = out->faces.capacity = polygons.faces.count;
    out->faces.items = ARENA_ARRAY(scratch, uint32_t, polygons.faces.count);
    out->corners.count = out->corners.capacity = polygons.corners.count;
    out->corners.items = ARENA_ARRAY(scratch, struct textured_corner, polygons.corners.count);
    for (uint32_t f = 0, c = 0; f < polygons.faces.count; f++) {
        const uint32_t end =
            f + 1 < polygons.faces.count ? polygons.faces.items[f + 1].first : polygons.corners.count;
        out->faces.items[f] = c;
        for (; c < end; c++) {
            const uint32_t vertex = polygons.corners.items[c].vertex;
            const bool is_known = has && (!by_corner || r.has_texture[f]);
            out->corners.items[c] = (struct textured_corner){vertex, !is_known   ? IR_NO_INDEX
                                                                     : by_corner ? c
                                                                                 : vertex};
        }
    }
}
