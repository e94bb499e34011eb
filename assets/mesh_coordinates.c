#include "assets/mesh_coordinates.h"

#include "assets/obj_lex.h"
#include "assets/read_obj.h"

#include <math.h>
#include <string.h>

struct textured_corner {
    uint32_t vertex;     // in the file, from 0
    uint32_t coordinate; // into mesh->coordinates; IR_NO_INDEX: none
};

struct reading {
    struct asset_file *file;
    struct arena *scratch;
    struct mesh *mesh;
    struct obj_lex lex;
    uint32_t vertices; // so far
    struct {
        struct ir_pair *items;
        uint32_t count, capacity;
    } coordinates;
    struct {
        struct textured_corner *items;
        uint32_t count, capacity;
    } corners;
    struct {
        uint32_t *items; // the first corner of each
        uint32_t count, capacity;
    } faces;
};

// ---- faults

static void report(struct reading *r, enum diag_code code, const char *begin, const char *what) {
    const size_t at = (size_t)(begin - r->lex.begin), end = obj_lex_offset(&r->lex);
    const int shown = end - at < 64 ? (int)(end - at) : 64;
    asset_report(r->file, code, at, end, "'%.*s' %s", shown, begin, what);
}

// ---- lines

// One or two numbers; a third is for solid textures, which there are not.
static void read_coordinate(struct reading *r, str keyword) {
    double value[2] = {0, 0};
    int count = 0;
    for (; obj_lex_more(&r->lex); count++) {
        const char *begin = r->lex.at;
        double number;
        const enum number_status status = obj_lex_number(&r->lex, &number);
        if (status != NUMBER_OK)
            report(r, DIAG_MESH_NUMBER, begin, number_problem(status));
        else if (fabs(number) > OBJ_COORDINATE_MAX)
            report(r, DIAG_MESH_NUMBER, begin, "is larger than 1e18");
        else if (count < 2)
            value[count] = number;
    }
    if (count == 0)
        report(r, DIAG_MESH_SYNTAX, keyword.ptr, "needs a number");
    *ARENA_PUSH(r->scratch, &r->coordinates) = (struct ir_pair){value[0], value[1]};
}

// An index from 1 on, or counted back from the last; as one from 0.
static uint32_t from_zero(int64_t index, uint32_t count) {
    const int64_t absolute = index < 0 ? (int64_t)count + index : index - 1;
    return absolute >= 0 && absolute < (int64_t)IR_NO_INDEX ? (uint32_t)absolute : IR_NO_INDEX;
}

static void read_corner(struct reading *r) {
    const char *begin = r->lex.at;
    int64_t vertex = 0, coordinate = 0;
    struct textured_corner *corner = ARENA_PUSH(r->scratch, &r->corners);
    *corner = (struct textured_corner){.coordinate = IR_NO_INDEX};
    if (obj_lex_integer(&r->lex, &vertex))
        corner->vertex = from_zero(vertex, r->vertices);
    if (!obj_lex_done(&r->lex) && *r->lex.at == '/') {
        r->lex.at++;
        if (obj_lex_integer(&r->lex, &coordinate)) {
            corner->coordinate = from_zero(coordinate, r->coordinates.count);
            if (corner->coordinate == IR_NO_INDEX)
                report(r, DIAG_MESH_INDEX, begin,
                       coordinate == 0 ? "has the index 0: texture coordinates count from 1"
                                       : "goes back further than the texture coordinates so far");
        }
    }
    obj_lex_word(&r->lex);
}

static void read_line(struct reading *r) {
    if (!obj_lex_more(&r->lex))
        return;
    const str keyword = obj_lex_word(&r->lex);
    if (str_equal_cstr(keyword, "v")) {
        r->vertices++;
    } else if (str_equal_cstr(keyword, "vt")) {
        read_coordinate(r, keyword);
    } else if (str_equal_cstr(keyword, "f") || str_equal_cstr(keyword, "fo")) {
        *ARENA_PUSH(r->scratch, &r->faces) = r->corners.count;
        while (obj_lex_more(&r->lex))
            read_corner(r);
    }
}

// ---- triangles

// The index in mesh->positions of each vertex: those that faces use, in the order of the file.
static uint32_t *place_vertices(struct reading *r) {
    uint32_t *place = ARENA_ARRAY(r->scratch, uint32_t, (size_t)r->vertices + 1);
    uint32_t used = 0;
    for (uint32_t i = 0; i < r->corners.count; i++)
        if (r->corners.items[i].vertex < r->vertices)
            place[r->corners.items[i].vertex] = 1;
    for (uint32_t i = 0; i < r->vertices; i++)
        place[i] = place[i] ? used++ : IR_NO_INDEX;
    return place;
}

static bool is_same_file(const struct reading *r) {
    uint64_t triangles = 0;
    for (uint32_t f = 0; f < r->faces.count; f++) {
        const uint32_t end = f + 1 < r->faces.count ? r->faces.items[f + 1] : r->corners.count;
        triangles += end - r->faces.items[f] >= 3 ? end - r->faces.items[f] - 2 : 0;
    }
    return triangles == r->mesh->triangle_count;
}

// Each corner of a triangle is one of its face, known by its position: however the face was cut or turned.
static void find_corners(struct reading *r, const uint32_t *place, uint32_t begin, uint32_t end,
                         uint32_t triangle) {
    for (int k = 0; k < 3; k++) {
        const uint32_t position = r->mesh->triangles[triangle].corners[k];
        uint32_t at = begin;
        while (at + 1 < end && place[r->corners.items[at].vertex] != position)
            at++;
        r->mesh->textured[triangle][k] = r->corners.items[at].coordinate;
    }
}

static void assign(struct reading *r) {
    struct mesh *mesh = r->mesh;
    const uint32_t *place = place_vertices(r);
    uint32_t triangle = 0;
    mesh->textured = arena_alloc_array(&mesh->arena, mesh->triangle_count, sizeof *mesh->textured);
    for (uint32_t f = 0; f < r->faces.count; f++) {
        const uint32_t begin = r->faces.items[f];
        const uint32_t end = f + 1 < r->faces.count ? r->faces.items[f + 1] : r->corners.count;
        for (uint32_t i = 2; i < end - begin; i++)
            find_corners(r, place, begin, end, triangle++);
    }
    mesh->coordinate_count = r->coordinates.count;
    mesh->coordinates = ARENA_ARRAY(&mesh->arena, struct ir_pair, (size_t)r->coordinates.count + 1);
    if (r->coordinates.count)
        memcpy(mesh->coordinates, r->coordinates.items, r->coordinates.count * sizeof *mesh->coordinates);
}

// Indices that name what no line defines, once the whole file is known.
static void check_forward(struct reading *r) {
    uint32_t wrong = 0;
    uint32_t largest = 0;
    for (uint32_t i = 0; i < r->corners.count; i++) {
        const uint32_t index = r->corners.items[i].coordinate;
        if (index == IR_NO_INDEX || index < r->coordinates.count)
            continue;
        wrong++;
        largest = index > largest ? index : largest;
    }
    if (wrong)
        asset_report_line(
            r->file, DIAG_MESH_INDEX, 0,
            "%u corner%s of faces name texture coordinates up to number %u; the file defines %u", wrong,
            wrong == 1 ? "" : "s", largest + 1, r->coordinates.count);
}

void mesh_read_coordinates(struct asset_file *file, struct arena *scratch, struct mesh *mesh) {
    struct reading r = {.file = file, .scratch = scratch, .mesh = mesh};
    const uint32_t before = file->errors;
    obj_lex_init(&r.lex, file->text);
    while (!obj_lex_done(&r.lex)) {
        read_line(&r);
        obj_lex_next_line(&r.lex);
    }
    check_forward(&r);
    if (file->errors == before && !is_same_file(&r))
        asset_report_named(file, DIAG_FILE_UNREADABLE, "the mesh has changed while it was read");
    if (file->errors == before)
        assign(&r);
}
