#include "mesh_kit.h"

#include <math.h>
#include <string.h>

const char *const mesh_kit_names[MESH_KIT_FORMS] = {"as.obj",  "text.ply", "little.ply",
                                                    "big.ply", "text.stl", "binary.stl"};

static uint32_t corners_of(const struct mesh_kit *mesh, uint32_t face) {
    return mesh->counts ? mesh->counts[face] : 3;
}

static void put_bytes(struct strbuf *out, const void *value, size_t size, bool is_big) {
    unsigned char bytes[8];
    memcpy(bytes, value, size); // this machine's are little
    for (size_t i = 0; i < size; i++)
        strbuf_char(out, (char)bytes[is_big ? size - 1 - i : i]);
}

static void put_uint32(struct strbuf *out, uint32_t value, bool is_big) {
    put_bytes(out, &value, sizeof value, is_big);
}

static void put_coordinate(struct strbuf *out, const struct mesh_kit *mesh, double value, bool is_big) {
    const float single = (float)value;
    if (mesh->single)
        put_bytes(out, &single, sizeof single, is_big);
    else
        put_bytes(out, &value, sizeof value, is_big);
}

// ---- OBJ

static void write_obj(const struct mesh_kit *mesh, struct strbuf *out) {
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        strbuf_format(out, "v %.17g %.17g %.17g\n", mesh->positions[3 * (size_t)i],
                      mesh->positions[3 * (size_t)i + 1], mesh->positions[3 * (size_t)i + 2]);
    for (uint32_t f = 0, c = 0; f < mesh->face_count; f++) {
        strbuf_char(out, 'f');
        for (uint32_t k = corners_of(mesh, f); k > 0; k--)
            strbuf_format(out, " %u", mesh->corners[c++] + 1);
        strbuf_char(out, '\n');
    }
}

// ---- PLY

static void write_ply_header(const struct mesh_kit *mesh, enum mesh_kit_form form, struct strbuf *out) {
    static const char *const forms[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const char *type = mesh->single ? "float" : "double";
    strbuf_format(out, "ply\nformat %s 1.0\ncomment by the kit\n", forms[form - MESH_KIT_PLY_TEXT]);
    if (mesh->extras)
        strbuf_cstr(out, "element camera 2\nproperty int16 mode\nproperty list uint8 float32 view\n");
    strbuf_format(out, "element vertex %u\n", mesh->vertex_count);
    if (mesh->extras)
        strbuf_cstr(out, "property uchar quality\n");
    strbuf_format(out, "property %s x\nproperty %s y\n", type, type);
    if (mesh->extras)
        strbuf_cstr(out, "property list ushort double weights\n");
    strbuf_format(out, "property %s z\nelement face %u\n", type, mesh->face_count);
    if (mesh->extras)
        strbuf_cstr(out, "property double area\n");
    strbuf_cstr(out, "property list uchar int vertex_indices\n");
    if (mesh->extras)
        strbuf_cstr(out, "property list int char flags\n");
    strbuf_cstr(out, "end_header\n");
}

static void write_ply_text(const struct mesh_kit *mesh, struct strbuf *out) {
    if (mesh->extras)
        strbuf_cstr(out, "1 0\n-2 3 .5 1e3 nan\n");
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const double *p = mesh->positions + 3 * (size_t)i;
        if (mesh->extras)
            strbuf_format(out, "200 %.17g %.17g 2 0.5 0.5 %.17g\n", p[0], p[1], p[2]);
        else
            strbuf_format(out, "%.17g %.17g %.17g\n", p[0], p[1], p[2]);
    }
    for (uint32_t f = 0, c = 0; f < mesh->face_count; f++) {
        strbuf_format(out, mesh->extras ? "1.5 %u" : "%u", corners_of(mesh, f));
        for (uint32_t k = corners_of(mesh, f); k > 0; k--)
            strbuf_format(out, " %u", mesh->corners[c++]);
        strbuf_cstr(out, mesh->extras ? " 1 -7\n" : "\n");
    }
}

static void write_ply_binary(const struct mesh_kit *mesh, bool is_big, struct strbuf *out) {
    const double weights[2] = {0.5, NAN};
    if (mesh->extras)
        strbuf_str(out, (str){"\1\2\0\3\4\0", 6}); // lists of none, whatever the order of the modes
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const double *p = mesh->positions + 3 * (size_t)i;
        if (mesh->extras)
            strbuf_char(out, (char)200);
        put_coordinate(out, mesh, p[0], is_big);
        put_coordinate(out, mesh, p[1], is_big);
        if (mesh->extras) {
            const uint16_t count = 2;
            put_bytes(out, &count, sizeof count, is_big);
            put_bytes(out, &weights[0], sizeof weights[0], is_big);
            put_bytes(out, &weights[1], sizeof weights[1], is_big);
        }
        put_coordinate(out, mesh, p[2], is_big);
    }
    for (uint32_t f = 0, c = 0; f < mesh->face_count; f++) {
        if (mesh->extras)
            put_bytes(out, &weights[0], sizeof weights[0], is_big);
        strbuf_char(out, (char)corners_of(mesh, f));
        for (uint32_t k = corners_of(mesh, f); k > 0; k--)
            put_uint32(out, mesh->corners[c++], is_big);
        if (mesh->extras) {
            put_uint32(out, 1, is_big);
            strbuf_char(out, 'x');
        }
    }
}

// ---- STL

static void put_stl_corner(const struct mesh_kit *mesh, uint32_t vertex, bool is_text, struct strbuf *out) {
    const double *p = mesh->positions + 3 * (size_t)vertex;
    if (is_text)
        strbuf_format(out, "      vertex %.17g %.17g %.17g\n", p[0], p[1], p[2]);
    for (int k = 0; k < 3 && !is_text; k++) {
        const float single = (float)p[k];
        put_bytes(out, &single, sizeof single, false);
    }
}

// Polygons as fans, which is what they are where they are convex.
static void write_stl(const struct mesh_kit *mesh, bool is_text, struct strbuf *out) {
    uint32_t triangles = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        triangles += corners_of(mesh, f) - 2;
    if (is_text)
        strbuf_cstr(out, "solid kit\n");
    else
        strbuf_format(out, "%-80s", mesh->extras ? "solid kit" : "kit");
    if (!is_text)
        put_uint32(out, triangles, false);
    for (uint32_t f = 0, c = 0; f < mesh->face_count; c += corners_of(mesh, f++))
        for (uint32_t k = 2; k < corners_of(mesh, f); k++) {
            if (is_text)
                strbuf_format(out, "  facet normal %s\n    outer loop\n",
                              mesh->extras ? "nan 0 -3" : "0 0 0");
            else
                strbuf_str(out,
                           (str){mesh->extras ? "\0\0\300\177wrongone" : "\0\0\0\0\0\0\0\0\0\0\0\0", 12});
            put_stl_corner(mesh, mesh->corners[c], is_text, out);
            put_stl_corner(mesh, mesh->corners[c + k - 1], is_text, out);
            put_stl_corner(mesh, mesh->corners[c + k], is_text, out);
            if (is_text)
                strbuf_cstr(out, "    endloop\n  endfacet\n");
            else
                strbuf_str(out, (str){"\0\0", 2});
        }
    if (is_text)
        strbuf_cstr(out, "endsolid kit\n");
}

void mesh_kit_write(const struct mesh_kit *mesh, enum mesh_kit_form form, struct strbuf *out) {
    if (form == MESH_KIT_OBJ)
        write_obj(mesh, out);
    else if (form >= MESH_KIT_STL_TEXT)
        write_stl(mesh, form == MESH_KIT_STL_TEXT, out);
    else
        write_ply_header(mesh, form, out);
    if (form == MESH_KIT_PLY_TEXT)
        write_ply_text(mesh, out);
    else if (form == MESH_KIT_PLY_LITTLE || form == MESH_KIT_PLY_BIG)
        write_ply_binary(mesh, form == MESH_KIT_PLY_BIG, out);
}
