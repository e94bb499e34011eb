// The texture coordinates of an OBJ file (`vt`): a second walk over its text, so meshes without images cost
// no time or memory for it.
#include "assets/obj/obj_lex.h"
#include "assets/obj/read_obj.h"
#include "diag/codes/file.h"

#include <math.h>
#include <string.h>

struct reading {
    struct asset_file *file;
    struct arena *scratch;
    struct textured_faces *out;
    struct obj_lex lex;
};

// ---- faults

static void report(struct reading *r, diag_code code, const char *begin, const char *what) {
    const size_t at = (size_t)(begin - r->lex.begin), end = obj_lex_offset(&r->lex);
    const int shown = end - at < 64 ? (int)(end - at) : 64;
    asset_report(r->file, code, at, end, "'%.*s' %s", shown, begin, what);
}

// ---- lines

// One or two numbers; a third is for solid textures, which glint does not have.
static void read_coordinate(struct reading *r, str keyword) {
    double value[2] = {0, 0};
    int count = 0;
    for (; obj_lex_more(&r->lex); count++) {
        const char *begin = r->lex.at;
        double number;
        const enum number_status status = obj_lex_number(&r->lex, &number);
        if (status != NUMBER_OK)
            report(r, DIAG_MESH_NUMBER, begin, number_problem(status));
        else if (fabs(number) > MESH_COORDINATE_MAX)
            report(r, DIAG_MESH_NUMBER, begin, "is larger than 1e18");
        else if (count < 2)
            value[count] = number;
    }
    if (count == 0)
        report(r, DIAG_MESH_SYNTAX, keyword.ptr, "needs a number");
    *ARENA_PUSH(r->scratch, &r->out->coordinates) = (struct ir_pair){value[0], value[1]};
}

// Converts an index from 1, or one counted back from the last, to an index from 0.
static uint32_t from_zero(int64_t index, uint32_t count) {
    const int64_t absolute = index < 0 ? (int64_t)count + index : index - 1;
    return absolute >= 0 && absolute < (int64_t)IR_NO_INDEX ? (uint32_t)absolute : IR_NO_INDEX;
}

static void read_corner(struct reading *r) {
    const char *begin = r->lex.at;
    int64_t vertex = 0, coordinate = 0;
    struct textured_corner *corner = ARENA_PUSH(r->scratch, &r->out->corners);
    *corner = (struct textured_corner){.coordinate = IR_NO_INDEX};
    if (obj_lex_integer(&r->lex, &vertex))
        corner->vertex = from_zero(vertex, r->out->vertex_count);
    if (!obj_lex_done(&r->lex) && *r->lex.at == '/') {
        r->lex.at++;
        if (obj_lex_integer(&r->lex, &coordinate)) {
            corner->coordinate = from_zero(coordinate, r->out->coordinates.count);
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
        r->out->vertex_count++;
    } else if (str_equal_cstr(keyword, "vt")) {
        read_coordinate(r, keyword);
    } else if (str_equal_cstr(keyword, "f") || str_equal_cstr(keyword, "fo")) {
        *ARENA_PUSH(r->scratch, &r->out->faces) = r->out->corners.count;
        while (obj_lex_more(&r->lex))
            read_corner(r);
    }
}

// Indices of coordinates that no line defines, once the whole file is known.
static void check_forward(struct reading *r) {
    uint32_t wrong = 0;
    uint32_t largest = 0;
    for (uint32_t i = 0; i < r->out->corners.count; i++) {
        const uint32_t index = r->out->corners.items[i].coordinate;
        if (index == IR_NO_INDEX || index < r->out->coordinates.count)
            continue;
        wrong++;
        largest = index > largest ? index : largest;
    }
    if (wrong)
        asset_report_line(
            r->file, DIAG_MESH_INDEX, 0,
            "%u corner%s of faces name texture coordinates up to number %u; the file defines %u", wrong,
            wrong == 1 ? "" : "s", largest + 1, r->out->coordinates.count);
}

void read_obj_coordinates(struct asset_file *file, struct arena *scratch, struct textured_faces *out) {
    *out = (struct textured_faces){0};
    struct reading r = {.file = file, .scratch = scratch, .out = out};
    obj_lex_init(&r.lex, file->text);
    while (!obj_lex_done(&r.lex)) {
        read_line(&r);
        obj_lex_next_line(&r.lex);
    }
    check_forward(&r);
}
