#include "assets/obj/read_obj.h"
#include "diag/codes/file.h"

#include "assets/obj/obj_chunk.h"
#include "assets/obj/obj_lex.h"
#include "core/parallel.h"
#include "core/str_map.h"

#include <math.h>
#include <string.h>

enum {
    WITH_COLOR = 6, // numbers of a vertex
    CHUNK_BYTES = 1 << 18,
    // Threads read lines other than vertices, normals and faces up to this many, plus one in so many bytes.
    OTHERS_FEW = 64,
    OTHER_BYTES_LEAST = 16,
};

struct obj_reader {
    struct asset_file *file;
    struct arena *scratch;
    struct polygons *obj;
    struct obj_lex lex;
    bool refers_forward; // a face refers to something not defined yet
    bool is_full;        // a limit is exceeded: read no further
    bool is_quiet;       // faults are only noted
    bool is_faulty;
    // The name of the last `usemtl`; its group is made by the first face.
    str material;
    uint32_t material_line;
    uint32_t group;        // IR_NO_INDEX until a face needs it
    struct str_map groups; // 1 + index, by name
};

// ---- faults

static void report_word(struct obj_reader *r, diag_code code, str word, const char *what) {
    if (r->is_quiet) {
        r->is_faulty = true;
        return;
    }
    size_t at = (size_t)(word.ptr - r->lex.begin);
    // A word can be a whole binary file.
    int shown = word.len < 64 ? (int)word.len : 64;
    asset_report(r->file, code, at, at + word.len, "'%.*s' %s", shown, word.ptr, what);
}

// Reports that the line ends too soon, at its first word.
static void report_short(struct obj_reader *r, str keyword, const char *what) {
    size_t at = (size_t)(keyword.ptr - r->lex.begin);
    asset_report(r->file, DIAG_MESH_SYNTAX, at, at + keyword.len, "'%.*s' needs %s", STR_ARG(keyword), what);
}

// ---- vertices and normals

static double read_coordinate(struct obj_reader *r) {
    const char *begin = r->lex.at;
    double value;
    enum number_status status = obj_lex_number(&r->lex, &value);
    if (status == NUMBER_OK && fabs(value) <= MESH_COORDINATE_MAX)
        return value;
    str word = {begin, (size_t)(r->lex.at - begin)};
    report_word(r, DIAG_MESH_NUMBER, word,
                status == NUMBER_OK ? "is larger than 1e18" : number_problem(status));
    return 0;
}

// Three coordinates, and whatever numbers follow: w, or a colour. A faulty line still defines a vertex, so
// that the indices after it keep their meaning.
static vec3 read_point(struct obj_reader *r, str keyword) {
    double value[3] = {0};
    int count = 0;
    while (obj_lex_more(&r->lex)) {
        double v = read_coordinate(r);
        if (count < 3)
            value[count] = v;
        count++;
    }
    if (count < 3)
        report_short(r, keyword, "three numbers");
    if (count >= WITH_COLOR && keyword.len == 1)
        mesh_lose(r->obj->losses, MESH_LOSS_COLORS, r->lex.line);
    return (vec3){value[0], value[1], value[2]};
}

// ---- groups

static uint32_t current_group(struct obj_reader *r) {
    if (r->group != IR_NO_INDEX)
        return r->group;
    uint32_t *number = str_map_at(&r->groups, r->material);
    if (*number == 0) {
        struct mesh_group *group = ARENA_PUSH(r->scratch, &r->obj->groups);
        *group = (struct mesh_group){.name = r->material, .line = r->material_line};
        *number = r->obj->groups.count;
    }
    r->group = *number - 1;
    return r->group;
}

static void read_usemtl(struct obj_reader *r) {
    uint32_t line = r->lex.line;
    bool named = obj_lex_more(&r->lex) || (!obj_lex_done(&r->lex) && *r->lex.at == '#');
    r->material = named ? obj_lex_rest(&r->lex) : STR("");
    r->material_line = r->material.len ? line : 0;
    r->group = IR_NO_INDEX;
}

static void read_mtllib(struct obj_reader *r) {
    uint32_t line = r->lex.line;
    if (!obj_lex_more(&r->lex))
        return;
    struct mesh_library *library = ARENA_PUSH(r->scratch, &r->obj->libraries);
    *library = (struct mesh_library){.names = obj_lex_rest(&r->lex), .line = line};
}

// ---- faces

static void report_index(struct obj_reader *r, str word, int64_t index, uint32_t count, const char *things) {
    size_t at = (size_t)(word.ptr - r->lex.begin);
    if (index == 0)
        asset_report(r->file, DIAG_MESH_INDEX, at, at + word.len, "index 0: %s count from 1", things);
    else if (index < 0)
        asset_report(r->file, DIAG_MESH_INDEX, at, at + word.len,
                     "index %lld goes back further than the %u %s so far", (long long)index, count, things);
    else
        asset_report(r->file, DIAG_MESH_INDEX, at, at + word.len, "index %lld: the file defines %u %s",
                     (long long)index, count, things);
}

// One index at the cursor, converted to start from 0. Positive ones may refer to later lines; `check_forward`
// checks these.
static bool read_index(struct obj_reader *r, uint32_t count, const char *things, uint32_t *out) {
    const char *begin = r->lex.at;
    int64_t index;
    if (!obj_lex_integer(&r->lex, &index))
        return false;
    int64_t absolute = index < 0 ? (int64_t)count + index : index - 1;
    *out = IR_NO_INDEX;
    if (absolute >= 0 && absolute < (int64_t)IR_NO_INDEX) {
        *out = (uint32_t)absolute;
        r->refers_forward |= absolute >= (int64_t)count;
    } else {
        str word = {begin, (size_t)(r->lex.at - begin)};
        report_index(r, word, index, count, things);
    }
    return true;
}

static bool take_slash(struct obj_reader *r) {
    if (obj_lex_done(&r->lex) || *r->lex.at != '/')
        return false;
    r->lex.at++;
    return true;
}

// v, v/vt, v//vn or v/vt/vn; texture coordinates are not used, so only their form is checked.
static bool read_corner(struct obj_reader *r, struct polygon_corner *corner) {
    corner->normal = IR_NO_INDEX;
    if (!read_index(r, r->obj->vertices.count, "vertices", &corner->vertex))
        return false;
    if (take_slash(r)) {
        int64_t texture;
        bool textured = obj_lex_integer(&r->lex, &texture);
        if (take_slash(r)) {
            // Some programs write "1//" and "1/2/".
            if (!obj_lex_word_ends(&r->lex) &&
                !read_index(r, r->obj->normals.count, "normals", &corner->normal))
                return false;
        } else if (!textured && !obj_lex_word_ends(&r->lex)) {
            return false;
        }
    }
    return obj_lex_word_ends(&r->lex);
}

static bool face_fits(struct obj_reader *r, str keyword, uint32_t corners) {
    const struct limits *limits = r->file->input->limits;
    size_t at = (size_t)(keyword.ptr - r->lex.begin);
    enum limit exceeded =
        corners > limits->value[LIMIT_MESH_CORNERS] ? LIMIT_MESH_CORNERS : LIMIT_MESH_TRIANGLES;
    if (exceeded == LIMIT_MESH_TRIANGLES && r->obj->triangle_count <= limits->value[LIMIT_MESH_TRIANGLES])
        return true;
    // Reading on would only cost time; twice the limit is a guess.
    asset_report_limit(r->file, exceeded, at, at + keyword.len, 2 * limits->value[exceeded]);
    r->is_full = true;
    return false;
}

static void read_face(struct obj_reader *r, str keyword) {
    struct polygons *obj = r->obj;
    uint32_t line = r->lex.line;
    uint32_t first = obj->corners.count;
    uint64_t most = r->file->input->limits->value[LIMIT_MESH_CORNERS];
    bool broken = false;
    while (obj_lex_more(&r->lex) && obj->corners.count - first <= most) {
        const char *begin = r->lex.at;
        struct polygon_corner *corner = ARENA_PUSH(r->scratch, &obj->corners);
        if (read_corner(r, corner))
            continue;
        broken = true;
        obj_lex_word(&r->lex);
        report_word(r, DIAG_MESH_SYNTAX, (str){begin, (size_t)(r->lex.at - begin)},
                    "is not a corner; write V, V/VT, V//VN or V/VT/VN");
    }
    uint32_t corners = obj->corners.count - first;
    if (corners < 3 && !broken) {
        size_t at = (size_t)(keyword.ptr - r->lex.begin);
        asset_report(r->file, DIAG_MESH_FACE, at, obj_lex_offset(&r->lex), "a face with %u corner%s", corners,
                     corners == 1 ? "" : "s");
    }
    obj->triangle_count += corners >= 3 ? corners - 2 : 0;
    if (corners < 3 || broken || !face_fits(r, keyword, corners)) {
        obj->corners.count = first;
        return;
    }
    struct polygon_face *face = ARENA_PUSH(r->scratch, &obj->faces);
    *face = (struct polygon_face){.first = first, .line = line, .group = current_group(r)};
}

// ---- lines

static bool is_word_of(const char *const *words, str word) {
    for (; *words; words++)
        if (str_equal_cstr(word, *words))
            return true;
    return false;
}

// Everything except vertices, normals and faces, which are most of a file.
static void read_other(struct obj_reader *r, str keyword) {
    static const char *const without_effect[] = {
        "vt",       "vp",     "o",      "g",          "s",         "mg",    "lod",   "bevel", "c_interp",
        "d_interp", "usemap", "maplib", "shadow_obj", "trace_obj", "ctech", "stech", NULL};
    static const char *const not_drawn[] = {"p", "l", "curv", "curv2", "surf", "call", NULL};
    static const char *const of_curves[] = {"cstype", "deg",  "bmat", "step", "parm", "trim",
                                            "hole",   "scrv", "sp",   "end",  "con",  NULL};
    if (str_equal_cstr(keyword, "usemtl")) {
        read_usemtl(r);
    } else if (str_equal_cstr(keyword, "mtllib")) {
        read_mtllib(r);
    } else if (str_equal_cstr(keyword, "fo")) {
        read_face(r, keyword); // the name of f in the first version of the format
    } else if (is_word_of(not_drawn, keyword)) {
        mesh_lose(r->obj->losses, MESH_LOSS_NOT_FACES, r->lex.line);
    } else if (str_equal_cstr(keyword, "usemap") && obj_lex_more(&r->lex) &&
               !str_equal_cstr(obj_lex_word(&r->lex), "off")) {
        mesh_lose(r->obj->losses, MESH_LOSS_IMAGES, r->lex.line);
    } else if (!is_word_of(without_effect, keyword) && !is_word_of(of_curves, keyword)) {
        report_word(r, DIAG_MESH_SYNTAX, keyword, "cannot begin a line of an OBJ file");
    }
}

static void read_line(struct obj_reader *r) {
    if (!obj_lex_more(&r->lex))
        return;
    str keyword = obj_lex_word(&r->lex);
    if (keyword.len == 1 && keyword.ptr[0] == 'v')
        *ARENA_PUSH(r->scratch, &r->obj->vertices) = read_point(r, keyword);
    else if (keyword.len == 1 && keyword.ptr[0] == 'f')
        read_face(r, keyword);
    else if (keyword.len == 2 && keyword.ptr[0] == 'v' && keyword.ptr[1] == 'n')
        *ARENA_PUSH(r->scratch, &r->obj->normals) = read_point(r, keyword);
    else
        read_other(r, keyword);
}

// ---- indices that refer to later lines

// Finds the corner in the text again: storing its place would waste memory in files without faults. Faces
// come in the order of their lines, so the search continues from the line of the last one.
static void report_forward(struct obj_reader *r, const struct polygon_face *face, uint32_t number,
                           bool is_normal) {
    while (r->lex.line < face->line && !obj_lex_done(&r->lex))
        obj_lex_next_line(&r->lex);
    const struct obj_lex line = r->lex;
    obj_lex_more(&r->lex);
    obj_lex_word(&r->lex);
    str word = STR("");
    for (uint32_t i = 0; i <= number && obj_lex_more(&r->lex); i++)
        word = obj_lex_word(&r->lex);
    const struct polygon_corner *corner = &r->obj->corners.items[face->first + number];
    size_t cut = 0;
    while (!is_normal && cut < word.len && word.ptr[cut] != '/')
        cut++;
    if (is_normal) {
        for (size_t i = 0; i < word.len; i++)
            cut = word.ptr[i] == '/' ? i + 1 : cut;
        report_index(r, str_slice(word, cut, word.len), (int64_t)corner->normal + 1, r->obj->normals.count,
                     "normals");
    } else {
        report_index(r, str_slice(word, 0, cut), (int64_t)corner->vertex + 1, r->obj->vertices.count,
                     "vertices");
    }
    r->lex = line;
}

static void check_forward(struct obj_reader *r) {
    const struct polygons *obj = r->obj;
    obj_lex_init(&r->lex, r->file->text);
    for (uint32_t f = 0; f < obj->faces.count; f++) {
        const struct polygon_face *face = &obj->faces.items[f];
        uint32_t end = f + 1 < obj->faces.count ? face[1].first : obj->corners.count;
        for (uint32_t c = face->first; c < end; c++) {
            const struct polygon_corner *corner = &obj->corners.items[c];
            bool vertex = corner->vertex >= obj->vertices.count && corner->vertex != IR_NO_INDEX;
            bool normal = corner->normal >= obj->normals.count && corner->normal != IR_NO_INDEX;
            if (vertex && !asset_only_counts(r->file, DIAG_MESH_INDEX))
                report_forward(r, face, c - face->first, false);
            if (normal && !asset_only_counts(r->file, DIAG_MESH_INDEX))
                report_forward(r, face, c - face->first, true);
        }
    }
}

// Faults that only the whole file shows.
static void finish(struct obj_reader *r) {
    if (r->refers_forward)
        check_forward(r);
    if (r->obj->faces.count == 0 && r->file->errors == 0)
        asset_report_line(r->file, DIAG_MESH_EMPTY, 0, "the mesh has no faces");
}

static void reader_init(struct obj_reader *r, struct asset_file *file, struct arena *scratch,
                        struct polygons *out) {
    *out = (struct polygons){0};
    *r = (struct obj_reader){.file = file, .scratch = scratch, .obj = out, .group = IR_NO_INDEX};
    str_map_init(&r->groups, scratch);
    obj_lex_init(&r->lex, file->text);
}

void read_obj_in_order(struct asset_file *file, struct arena *scratch, struct polygons *out) {
    struct obj_reader r;
    reader_init(&r, file, scratch, out);
    while (!obj_lex_done(&r.lex) && !r.is_full) {
        read_line(&r);
        obj_lex_next_line(&r.lex);
    }
    finish(&r);
}

// ---- by threads

struct chunks {
    struct obj_chunk *items;
    uint32_t count;
    uint64_t corners_most;
    struct polygons *obj;
    struct obj_other *others;
};

static void count_chunks(void *context, size_t begin, size_t end) {
    const struct chunks *chunks = context;
    for (size_t i = begin; i < end; i++)
        obj_chunk_count(&chunks->items[i]);
}

static void read_chunks(void *context, size_t begin, size_t end) {
    const struct chunks *chunks = context;
    for (size_t i = begin; i < end; i++)
        obj_chunk_read(&chunks->items[i], chunks->corners_most, chunks->obj, chunks->others);
}

// Cuts the text, from the cursor on, at the first line ends after every `bytes` bytes.
static void cut_text(struct obj_reader *r, size_t bytes, struct chunks *chunks) {
    const char *const text = r->lex.at;
    const size_t length = (size_t)(r->lex.end - text);
    size_t at = 0;
    chunks->count = (uint32_t)(length / bytes + 1);
    chunks->items = ARENA_ARRAY(r->scratch, struct obj_chunk, chunks->count);
    for (uint32_t i = 0; i < chunks->count; i++) {
        size_t end = (i + (size_t)1) * bytes;
        if (end < at)
            end = at;
        const char *line = end < length ? memchr(text + end, '\n', length - end) : NULL;
        end = line ? (size_t)(line - text) + 1 : length;
        chunks->items[i].begin = text + at;
        chunks->items[i].end = text + end;
        at = end;
    }
}

static bool are_ordinary(const struct chunks *chunks) {
    for (uint32_t i = 0; i < chunks->count; i++)
        if (!chunks->items[i].is_ordinary)
            return false;
    return true;
}

static void add_counts(struct obj_counts *sum, const struct obj_counts *counts) {
    sum->vertices += counts->vertices;
    sum->normals += counts->normals;
    sum->corners += counts->corners;
    sum->faces += counts->faces;
    sum->others += counts->others;
    sum->lines += counts->lines;
}

// Room for exactly what was counted, and where each chunk's part of it begins. false: it would be much more
// than the sequential reader takes for a file that is not ordinary.
static bool make_room(struct obj_reader *r, struct chunks *chunks, struct obj_counts *sum) {
    struct polygons *obj = r->obj;
    for (uint32_t i = 0; i < chunks->count; i++) {
        chunks->items[i].before = *sum;
        add_counts(sum, &chunks->items[i].here);
    }
    if (sum->faces > r->file->input->limits->value[LIMIT_MESH_TRIANGLES] ||
        sum->others > r->file->text.len / OTHER_BYTES_LEAST + OTHERS_FEW)
        return false;
    obj->vertices.items = ARENA_ARRAY(r->scratch, vec3, sum->vertices);
    obj->normals.items = ARENA_ARRAY(r->scratch, vec3, sum->normals);
    obj->corners.items = ARENA_ARRAY(r->scratch, struct polygon_corner, sum->corners);
    obj->faces.items = ARENA_ARRAY(r->scratch, struct polygon_face, sum->faces);
    chunks->others = ARENA_ARRAY(r->scratch, struct obj_other, sum->others);
    obj->vertices.count = obj->vertices.capacity = sum->vertices;
    obj->normals.count = obj->normals.capacity = sum->normals;
    obj->corners.count = obj->corners.capacity = sum->corners;
    obj->faces.count = obj->faces.capacity = sum->faces;
    return true;
}

static void give_back_room(struct obj_reader *r, struct chunks *chunks, const struct obj_counts *sum) {
    struct polygons *obj = r->obj;
    arena_give_back(r->scratch, obj->vertices.items, obj->vertices.capacity, sizeof *obj->vertices.items);
    arena_give_back(r->scratch, obj->normals.items, obj->normals.capacity, sizeof *obj->normals.items);
    arena_give_back(r->scratch, obj->corners.items, obj->corners.capacity, sizeof *obj->corners.items);
    arena_give_back(r->scratch, obj->faces.items, obj->faces.capacity, sizeof *obj->faces.items);
    arena_give_back(r->scratch, chunks->others, sum->others, sizeof *chunks->others);
    *obj = (struct polygons){0};
}

static void name_group(struct obj_reader *r, uint32_t begin, uint32_t end) {
    if (begin == end)
        return;
    const uint32_t group = current_group(r);
    for (uint32_t i = begin; group && i < end; i++)
        r->obj->faces.items[i].group = group;
}

// In the order of the file: the sums, and the lines that only make sense in order. false: one has a fault.
static bool join_chunks(struct obj_reader *r, const struct chunks *chunks, uint32_t others) {
    struct polygons *obj = r->obj;
    for (uint32_t i = 0; i < chunks->count; i++) {
        const struct obj_chunk *chunk = &chunks->items[i];
        obj->triangle_count += chunk->triangles;
        r->refers_forward |= chunk->refers_forward;
        struct mesh_loss_count *colors = &obj->losses[MESH_LOSS_COLORS];
        if (!colors->count)
            colors->line = chunk->colors.line;
        colors->count += chunk->colors.count;
    }
    uint32_t named = 0;
    for (uint32_t i = 0; i < others; i++) {
        const struct obj_other *other = &chunks->others[i];
        r->lex.at = other->at;
        r->lex.line = other->line;
        const str keyword = obj_lex_word(&r->lex);
        name_group(r, named, other->faces);
        named = other->faces;
        if (str_equal_cstr(keyword, "fo"))
            return false;
        read_other(r, keyword);
    }
    name_group(r, named, obj->faces.count);
    return !r->is_faulty && obj->triangle_count <= r->file->input->limits->value[LIMIT_MESH_TRIANGLES];
}

bool read_obj_in_chunks(struct asset_file *file, struct arena *scratch, size_t chunk_bytes,
                        struct polygons *out) {
    struct obj_reader r;
    struct obj_counts sum = {0};
    reader_init(&r, file, scratch, out);
    r.is_quiet = true;
    struct chunks chunks = {.obj = out, .corners_most = file->input->limits->value[LIMIT_MESH_CORNERS]};
    cut_text(&r, chunk_bytes, &chunks);
    parallel_for(chunks.count, 1, count_chunks, &chunks);
    bool done = are_ordinary(&chunks) && make_room(&r, &chunks, &sum);
    if (done) {
        parallel_for(chunks.count, 1, read_chunks, &chunks);
        done = are_ordinary(&chunks) && join_chunks(&r, &chunks, sum.others);
    }
    if (done) {
        r.is_quiet = false;
        finish(&r);
    } else {
        give_back_room(&r, &chunks, &sum);
    }
    arena_give_back(scratch, chunks.items, chunks.count, sizeof *chunks.items);
    return done;
}

void read_obj(struct asset_file *file, struct arena *scratch, struct polygons *out) {
    if (!read_obj_in_chunks(file, scratch, CHUNK_BYTES, out))
        read_obj_in_order(file, scratch, out);
}
