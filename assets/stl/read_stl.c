#include "assets/stl/read_stl.h"

#include "assets/stl/stl_text.h"
#include "assets/stl/weld.h"
#include "core/float_bits.h"
#include "diag/codes/file.h"
#include "grammar/mesh_format.h"

#include <math.h>
#include <string.h>

enum {
    HEAD_BYTES = 84, // a text of 80 bytes, and the number of facets
    TEXT_BYTES = 80,
    FACET_BYTES = 50, // a normal, three corners, two bytes of attributes
    NORMAL_BYTES = 12,
    AHEAD_BYTES = 2048, // how far ahead is prefetched while facets are read
};

static uint32_t load32(const char *at) {
    const unsigned char *b = (const unsigned char *)at;
    return (uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 | (uint32_t)b[1] << 8 | b[0];
}

// ---- ascii or binary

// Whether all bytes, as far as a binary header and the beginning of its facets go, may occur in text.
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
    struct weld weld;
    uint32_t count;  // of facets
    uint32_t colors; // how many facets have attributes
};

static bool is_fine(float coordinate) {
    return fabsf(coordinate) <= (float)MESH_COORDINATE_MAX;
}

// Reports the first coordinate that is wrong in each corner.
static void report_facet(struct binary *b, uint32_t facet, const char *at) {
    for (int i = 0; i < WELD_FLOATS; i++) {
        const char *place = at + NORMAL_BYTES + 4 * (size_t)i;
        if (is_fine(float_of_bits(load32(place))))
            continue;
        asset_report_byte(b->file, DIAG_MESH_NUMBER, (uint64_t)(place - b->file->text.ptr),
                          "%.9g in facet %u is not a number up to 1e18", (double)float_of_bits(load32(place)),
                          facet + 1);
        i += 2 - i % 3;
    }
}

// The corners' positions, no coordinate -0; false: one is wrong.
static bool read_positions(struct binary *b, uint32_t begin, uint32_t end) {
    float *positions = weld_room(&b->weld);
    const char *at = b->file->text.ptr + HEAD_BYTES + (size_t)FACET_BYTES * begin;
    struct polygon_face *faces = b->out->faces.items;
    uint32_t colors = 0;
    bool fine = true;
    for (uint32_t facet = begin; facet < end; facet++, at += FACET_BYTES, positions += WELD_FLOATS) {
        __builtin_prefetch(at + AHEAD_BYTES);
        faces[facet] = (struct polygon_face){.first = 3 * facet, .line = facet + 1};
        colors += (at[FACET_BYTES - 2] | at[FACET_BYTES - 1]) != 0;
        for (int i = 0; i < WELD_FLOATS; i++) {
            positions[i] = float_of_bits(load32(at + NORMAL_BYTES + 4 * (size_t)i)) + 0.0F;
            fine &= is_fine(positions[i]);
        }
    }
    b->colors += colors;
    return fine;
}

static void read_facets(struct binary *b, uint32_t begin, uint32_t end) {
    const char *at = b->file->text.ptr + HEAD_BYTES + (size_t)FACET_BYTES * begin;
    if (!read_positions(b, begin, end))
        for (uint32_t facet = begin; facet < end; facet++, at += FACET_BYTES)
            report_facet(b, facet, at);
    if (b->file->errors == 0)
        weld_facets(&b->weld, end - begin, b->out->corners.items + 3 * (size_t)begin);
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

// Whether the header has the colour of all facets, as some CAD programs write it.
static bool has_color(str text) {
    static const char word[] = "COLOR=";
    for (size_t at = 0; at + sizeof word - 1 <= TEXT_BYTES; at++)
        if (memcmp(text.ptr + at, word, sizeof word - 1) == 0)
            return true;
    return false;
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
    weld_init(&b.weld, scratch, out, b.count / 2 + 2);
    for (uint32_t i = 0; i < b.count; i += WELD_FACETS)
        read_facets(&b, i, b.count - i < WELD_FACETS ? b.count : i + WELD_FACETS);
    weld_finish(&b.weld);
    const size_t rest = file->text.len - HEAD_BYTES - (size_t)FACET_BYTES * b.count;
    out->losses[MESH_LOSS_REST].count = rest < UINT32_MAX ? (uint32_t)rest : UINT32_MAX;
    out->losses[MESH_LOSS_SCANNED].count = b.colors + has_color(file->text);
}

void read_stl(struct asset_file *file, struct arena *scratch, struct polygons *out) {
    *out = (struct polygons){.is_joined = true};
    if (is_text(file->text))
        read_stl_text(file, scratch, out);
    else
        read_binary(file, scratch, out);
}
