#include "assets/mesh_coordinates.h"
#include "diag/codes/file.h"

#include "assets/mesh_reader.h"

#include <string.h>

struct assigning {
    const struct textured_faces *faces;
    struct arena *scratch;
    struct mesh *mesh;
};

// The index in mesh->positions of each vertex: those that faces use, in the order of the file.
static uint32_t *place_vertices(struct assigning *r) {
    uint32_t *place = ARENA_ARRAY(r->scratch, uint32_t, (size_t)r->faces->vertex_count + 1);
    uint32_t used = 0;
    for (uint32_t i = 0; i < r->faces->corners.count; i++)
        if (r->faces->corners.items[i].vertex < r->faces->vertex_count)
            place[r->faces->corners.items[i].vertex] = 1;
    for (uint32_t i = 0; i < r->faces->vertex_count; i++)
        place[i] = place[i] ? used++ : IR_NO_INDEX;
    return place;
}

static bool is_same_file(const struct assigning *r) {
    uint64_t triangles = 0;
    for (uint32_t f = 0; f < r->faces->faces.count; f++) {
        const uint32_t end =
            f + 1 < r->faces->faces.count ? r->faces->faces.items[f + 1] : r->faces->corners.count;
        triangles += end - r->faces->faces.items[f] >= 3 ? end - r->faces->faces.items[f] - 2 : 0;
    }
    return triangles == r->mesh->triangle_count;
}

// Each corner of a triangle is one of its face's corners, identified by position, however the face was cut or
// turned.
static void find_corners(struct assigning *r, const uint32_t *place, uint32_t begin, uint32_t end,
                         uint32_t triangle) {
    for (int k = 0; k < 3; k++) {
        const uint32_t position = r->mesh->triangles[triangle].corners[k];
        uint32_t at = begin;
        while (at + 1 < end && place[r->faces->corners.items[at].vertex] != position)
            at++;
        r->mesh->textured[triangle][k] = r->faces->corners.items[at].coordinate;
    }
}

static void assign(struct assigning *r) {
    struct mesh *mesh = r->mesh;
    const uint32_t *place = place_vertices(r);
    uint32_t triangle = 0;
    mesh->textured = arena_alloc_array(&mesh->arena, mesh->triangle_count, sizeof *mesh->textured);
    for (uint32_t f = 0; f < r->faces->faces.count; f++) {
        const uint32_t begin = r->faces->faces.items[f];
        const uint32_t end =
            f + 1 < r->faces->faces.count ? r->faces->faces.items[f + 1] : r->faces->corners.count;
        for (uint32_t i = 2; i < end - begin; i++)
            find_corners(r, place, begin, end, triangle++);
    }
    mesh->coordinate_count = r->faces->coordinates.count;
    mesh->coordinates = ARENA_ARRAY(&mesh->arena, struct ir_pair, (size_t)r->faces->coordinates.count + 1);
    if (r->faces->coordinates.count)
        memcpy(mesh->coordinates, r->faces->coordinates.items,
               r->faces->coordinates.count * sizeof *mesh->coordinates);
}

void mesh_assign_coordinates(const struct textured_faces *faces, struct arena *scratch, struct mesh *mesh) {
    struct assigning assigning = {faces, scratch, mesh};
    assign(&assigning);
}

void mesh_read_coordinates(struct asset_file *file, struct arena *scratch, struct mesh *mesh) {
    const struct mesh_reader *reader = mesh_reader_of(file->path);
    const uint32_t before = file->errors;
    struct textured_faces faces = {0};
    if (!reader->coordinates) {
        mesh->textured = arena_alloc_array(&mesh->arena, mesh->triangle_count, sizeof *mesh->textured);
        memset(mesh->textured, 0xFF, (size_t)mesh->triangle_count * sizeof *mesh->textured);
        return;
    }
    reader->coordinates(file, scratch, &faces);
    struct assigning assigning = {&faces, scratch, mesh};
    if (file->errors == before && !is_same_file(&assigning))
        asset_report_named(file, DIAG_FILE_UNREADABLE, "the mesh has changed while it was read");
    if (file->errors == before)
        assign(&assigning);
}
