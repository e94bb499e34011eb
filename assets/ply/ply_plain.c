#include "assets/ply/ply_plain.h"

#include "core/float_bits.h"

#include <math.h>

static uint32_t load(const char *at, bool is_big) {
    const unsigned char *b = (const unsigned char *)at;
    const uint32_t little =
        (uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 | (uint32_t)b[1] << 8 | (uint32_t)b[0];
    const uint32_t big = (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | (uint32_t)b[3];
    return is_big ? big : little;
}

static double load_float(const char *at, bool is_big) {
    return (double)float_of_bits(load(at, is_big));
}

bool ply_plain_vertices(const struct ply_element *element, enum ply_form form, const uint8_t *column_of,
                        bool has_normals, struct ply_plain_vertices *out) {
    uint32_t offset = 0;
    *out = (struct ply_plain_vertices){
        .stride = element->bytes_least, .has_normals = has_normals, .is_big = form == PLY_BIG};
    for (uint32_t i = 0; i < element->properties.count; i++) {
        const struct ply_property *property = &element->properties.items[i];
        if (column_of[i] < PLY_PLAIN_COLUMNS) {
            out->offsets[column_of[i]] = offset;
            if (property->type != PLY_FLOAT32)
                return false;
        }
        offset += ply_type_bytes[property->type];
    }
    return form != PLY_TEXT && !element->has_lists;
}

bool ply_plain_faces(const struct ply_element *element, enum ply_form form, uint32_t list,
                     struct ply_plain_faces *out) {
    const struct ply_property *items = &element->properties.items[list];
    *out = (struct ply_plain_faces){.is_big = form == PLY_BIG};
    for (uint32_t i = 0; i < element->properties.count; i++) {
        const struct ply_property *property = &element->properties.items[i];
        if (i != list && property->count)
            return false;
        if (i != list)
            *(i < list ? &out->before : &out->after) += ply_type_bytes[property->type];
    }
    return form != PLY_TEXT && items->count == PLY_UINT8 &&
           (items->type == PLY_INT32 || items->type == PLY_UINT32);
}

static bool read_normal(const struct ply_plain_vertices *plain, const char *at, vec3 *out) {
    const vec3 n = {load_float(at + plain->offsets[3], plain->is_big),
                    load_float(at + plain->offsets[4], plain->is_big),
                    load_float(at + plain->offsets[5], plain->is_big)};
    *out = n;
    return fabs(n.x) <= MESH_COORDINATE_MAX && fabs(n.y) <= MESH_COORDINATE_MAX &&
           fabs(n.z) <= MESH_COORDINATE_MAX;
}

bool ply_read_plain_vertices(const struct ply_plain_vertices *plain, const char *at, size_t begin,
                             size_t end) {
    const bool is_big = plain->is_big;
    const uint32_t *offsets = plain->offsets;
    bool is_fine = true;
    for (size_t row = begin; row < end; row++, at += plain->stride) {
        const double x = load_float(at + offsets[0], is_big);
        const double y = load_float(at + offsets[1], is_big);
        const double z = load_float(at + offsets[2], is_big);
        is_fine &= (fabs(x) <= MESH_COORDINATE_MAX) & (fabs(y) <= MESH_COORDINATE_MAX) &
                   (fabs(z) <= MESH_COORDINATE_MAX);
        plain->positions[row] = (vec3){x + 0.0, y + 0.0, z + 0.0};
        if (plain->has_normals && !read_normal(plain, at, &plain->normals[row]))
            plain->normals[row] = (vec3){0, 0, 0};
    }
    return is_fine;
}

bool ply_read_plain_faces(const struct ply_plain_faces *plain, const char *at, size_t begin, size_t end,
                          uint32_t vertex_count, bool has_normals, uint32_t item, struct polygons *out) {
    struct polygon_corner *corners = out->corners.items;
    bool is_fine = true;
    for (size_t row = begin; row < end; row++) {
        at += plain->before;
        const uint32_t count = (unsigned char)*at++;
        out->faces.items[row] = (struct polygon_face){.first = item, .line = (uint32_t)row + 1};
        is_fine &= count >= 3;
        for (uint32_t k = 0; k < count; k++, at += 4) {
            const uint32_t vertex = load(at, plain->is_big);
            is_fine &= vertex < vertex_count;
            corners[item++] = (struct polygon_corner){vertex, has_normals ? vertex : IR_NO_INDEX};
        }
        at += plain->after;
    }
    return is_fine;
}
