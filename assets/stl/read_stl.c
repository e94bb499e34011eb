#include "assets/stl/read_stl.h"

#include "assets/stl/stl_text.h"
#include "grammar/mesh_format.h"

#include <math.h>
#include <string.h>

enum {
    HEAD_BYTES = 84, // a text of 80 bytes, and the number of facets
    TEXT_BYTES = 80,
    FACET_BYTES = 50, // a normal, three corners, two bytes of attributes
    NORMAL_BYTES = 12,
    POINT_BYTES = 12,
    AT_ONCE = 32, // facets
};

static uint32_t load32(const char *at) {
    const unsigned char *b = (const unsigned char *)at;
    return (uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 | (uint32_t)b[1] << 8 | b[0];
}

// ---- which of the two

// A text has no byte that no text has, as far as a binary header and the beginning of its facets go.
static bool looks_like_text(str text) {
    const size_t most = 4 * HEAD_BYTES;
    for (size_t i = 0; i < text.len && i < most; i++) {
        const unsigned char c = (unsigned char)text.ptr[i];
        if ((c < ' ' && !char_is_space((char)c) && c != '\f' && c != '\v') || c == 0x7F)
            return false;
    }
    return true;
}

static bool is_text(str text) {
    const bool fits = text.len >= HEAD_BYTES &&
                      text.len == HEAD_BYTES + (uint64_t)FACET_BYTES * load32(text.ptr + TEXT_BYTES);
    return !fits && looks_like_text(text);
}

// ---- binary

struct binary {
    struct asset_file *file;
    struct polygons *out;
    struct join join;
    uint32_t count;  // of facets
    uint32_t colors; // of them have attributes
    // Of the corners of some facets.
    vec3 positions[3 * AT_ONCE];
    uint32_t vertices[3 * AT_ONCE];
};

// A coordinate, never -0.
static float load_coordinate(const char *at) {
    const uint32_t bits = load32(at);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value + 0.0F;
}

static bool is_fine(const float point[3]) {
    return fabsf(point[0]) <= (float)MESH_COORDINATE_MAX && fabsf(point[1]) <= (float)MESH_COORDINATE_MAX &&
           fabsf(point[2]) <= (float)MESH_COORDINATE_MAX;
}

static void report_point(struct binary *b, uint32_t facet, const char *at, const float point[3]) {
    int k = 0;
    while (k < 2 && fabsf(point[k]) <= (float)MESH_COORDINATE_MAX)
        k++;
    asset_report_byte(b->file, DIAG_MESH_NUMBER, (uint64_t)(at - b->file->text.ptr) + 4 * (uint64_t)k,
                      "%.9g in facet %u is not a number up to 1e18", (double)point[k], facet + 1);
}

// Its corners' positions.
static void read_facet(struct binary *b, const char *at, uint32_t facet, vec3 *positions) {
    b->out->faces.items[facet] = (struct polygon_face){.first = 3 * facet, .line = facet + 1};
    for (int k = 0; k < 3; k++) {
        const char *place = at + NORMAL_BYTES + k * POINT_BYTES;
        const float p[3] = {load_coordinate(place), load_coordinate(place + 4), load_coordinate(place + 8)};
        if (!is_fine(p))
            report_point(b, facet, place, p);
        positions[k] = (vec3){(double)p[0], (double)p[1], (double)p[2]};
    }
    b->colors += at[FACET_BYTES - 2] != 0 || at[FACET_BYTES - 1] != 0;
}

static void read_facets(struct binary *b, uint32_t begin, uint32_t end) {
    for (uint32_t i = begin; i < end; i++)
        read_facet(b, b->file->text.ptr + HEAD_BYTES + (size_t)FACET_BYTES * i, i,
                   b->positions + 3 * (i - begin));
    if (b->file->errors)
        return;
    join_vertices(&b->join, b->positions, 3 * (end - begin), b->vertices);
    for (uint32_t i = 0; i < 3 * (end - begin); i++)
        b->out->corners.items[3 * (size_t)begin + i] = (struct polygon_corner){b->vertices[i], IR_NO_INDEX};
}

// Whether the file is as long as it says.
static bool has_length(struct binary *b) {
    const str text = b->file->text;
    if (text.len < HEAD_BYTES) {
        const enum mesh_format_id other = mesh_format_of_text(text);
        if (asset_report_byte(
                b->file, DIAG_MESH_SYNTAX, 0,
                "an STL file begins with 'solid' and is text, or has a header of %d bytes; this one "
                "has %zu bytes",
                HEAD_BYTES, text.len) &&
            other != MESH_FORMAT_COUNT)
            diag_help(b->file->input->sink, "this is %s: let its name end in %s", mesh_formats[other].called,
                      mesh_formats[other].endings[0]);
        return false;
    }
    b->count = load32(text.ptr + TEXT_BYTES);
    const uint64_t room = (text.len - HEAD_BYTES) / FACET_BYTES;
    if (b->count > room)
        asset_report_byte(b->file, DIAG_MESH_SYNTAX, TEXT_BYTES,
                          "%u facets are announced, and the file ends after %llu", b->count,
                          (unsigned long long)room);
    return b->count <= room;
}

static bool is_within_limits(struct binary *b) {
    const uint64_t most = b->file->input->limits->value[LIMIT_MESH_TRIANGLES];
    if (b->count == 0)
        asset_report_line(b->file, DIAG_MESH_EMPTY, 0, "the mesh has no faces");
    else if (b->count > most)
        asset_report_limit(b->file, LIMIT_MESH_TRIANGLES, 0, 0, b->count);
    return b->count > 0 && b->count <= most;
}

static void read_binary(struct asset_file *file, struct arena *scratch, struct polygons *out) {
    struct binary b = {.file = file, .out = out};
    file->is_binary = out->is_binary = true;
    if (!has_length(&b) || !is_within_limits(&b))
        return;
    out->triangle_count = out->faces.count = out->faces.capacity = b.count;
    out->faces.items = ARENA_ARRAY(scratch, struct polygon_face, b.count);
    out->corners.count = out->corners.capacity = 3 * b.count;
    out->corners.items = ARENA_ARRAY(scratch, struct polygon_corner, out->corners.count);
    *ARENA_PUSH(scratch, &out->groups) = (struct mesh_group){.name = STR("")};
    // A closed mesh has about half as many vertices as triangles.
    join_init(&b.join, scratch, out, b.count / 2 + 2);
    for (uint32_t i = 0; i < b.count; i += AT_ONCE)
        read_facets(&b, i, b.count - i < AT_ONCE ? b.count : i + AT_ONCE);
    const size_t rest = file->text.len - HEAD_BYTES - (size_t)FACET_BYTES * b.count;
    out->losses[MESH_LOSS_REST].count = rest < UINT32_MAX ? (uint32_t)rest : UINT32_MAX;
    out->losses[MESH_LOSS_SCANNED].count = b.colors;
}

void read_stl(struct asset_file *file, struct arena *scratch, struct polygons *out) {
    *out = (struct polygons){.is_joined = true};
    if (is_text(file->text))
        read_stl_text(file, scratch, out);
    else
        read_binary(file, scratch, out);
}
