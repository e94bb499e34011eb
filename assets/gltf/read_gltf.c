#include "assets/gltf/read_gltf.h"
#include "diag/codes/file.h"

#include "assets/gltf/asset_gltf.h"
#include "assets/gltf/material.h"
#include "core/nearest.h"
#include "core/number.h"

#include <math.h>
#include <string.h>

// A primitive that is shown once.
struct shown {
    const struct gltf_primitive *primitive;
    affine3 place;
    uint32_t group;
};

struct reading {
    struct gltf_document *document;
    struct gltf *gltf;
    struct asset_file *file;
    struct arena *scratch;
    struct polygons *out;
    struct {
        struct shown *items;
        uint32_t count, capacity;
    } shown;
    uint32_t *group_of; // by material, the last for none: 1 + the group
    uint64_t vertices;  // at most
    uint64_t most;      // most triangles; those beyond are only counted
    bool has_normals;
    struct {
        struct ir_pair *items;
        uint32_t count, capacity;
    } coordinates; // of every vertex, if requested; NaN: it has none
    bool wants_coordinates;
};

static const affine3 here = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}};

// ---- which

static uint32_t group_of(struct reading *r, const struct gltf_primitive *p) {
    const bool has = p->material != GLTF_NONE;
    uint32_t *group = &r->group_of[has ? p->material : r->gltf->materials.count];
    if (*group == 0) {
        *ARENA_PUSH(r->scratch, &r->out->groups) =
            (struct mesh_group){.name = has ? gltf_material_name(r->gltf, p->material) : STR("")};
        *group = r->out->groups.count;
    }
    return *group - 1;
}

// Whether sharing vertices costs less than giving each corner its own.
static bool shares(const struct gltf *gltf, const struct gltf_primitive *p) {
    return gltf->accessors.items[p->position].count <= 3 * gltf_triangle_count(gltf, p);
}

// A few bytes can show a mesh again, which takes as much memory again.
static uint64_t most_triangles(const struct reading *r) {
    uint64_t bytes = r->gltf->json.text.len;
    for (uint32_t i = 0; i < r->gltf->buffers.count; i++)
        bytes += r->gltf->buffers.items[i].bytes.len;
    return bytes / 3 + r->file->input->limits->value[LIMIT_MESH_COPIES];
}

static void show_mesh(struct reading *r, uint32_t mesh, affine3 place) {
    const struct gltf_mesh *m = &r->gltf->meshes.items[mesh];
    for (uint32_t i = m->first; i < m->first + m->count; i++) {
        const struct gltf_primitive *p = &r->gltf->primitives.items[i];
        const uint64_t triangles = gltf_triangle_count(r->gltf, p);
        if (triangles == 0)
            continue;
        r->out->triangle_count += triangles;
        if (r->out->triangle_count > r->most) // which check_counts reports
            continue;
        *ARENA_PUSH(r->scratch, &r->shown) = (struct shown){p, place, group_of(r, p)};
        r->vertices += shares(r->gltf, p) ? r->gltf->accessors.items[p->position].count : 3 * triangles;
        r->has_normals |= p->normal != GLTF_NONE;
    }
}

static bool show_all(struct reading *r) {
    for (uint32_t i = 0; i < r->gltf->order_count; i++) {
        const struct gltf_node *node = &r->gltf->nodes.items[r->gltf->order[i]];
        if (node->mesh != GLTF_NONE)
            show_mesh(r, node->mesh, node->world);
    }
    return true;
}

// "mesh 3", "node 7".
static bool is_numbered(str part, const char *word, uint32_t count, uint32_t *index) {
    int64_t number;
    const str rest = str_slice(part, strlen(word), part.len);
    if (!str_starts_with(part, str_from(word)) || number_parse_integer(rest, &number) != NUMBER_OK)
        return false;
    *index = number >= 0 && number < count ? (uint32_t)number : GLTF_NONE;
    return *index != GLTF_NONE;
}

static bool show_part(struct reading *r, str part) {
    uint32_t index;
    r->most = most_triangles(r);
    if (part.len == 0)
        return show_all(r);
    for (index = 0; index < r->gltf->meshes.count; index++)
        if (str_equal(r->gltf->meshes.items[index].name, part))
            break;
    if (index < r->gltf->meshes.count || is_numbered(part, "mesh ", r->gltf->meshes.count, &index)) {
        show_mesh(r, index, here);
        return true;
    }
    if (!is_numbered(part, "node ", r->gltf->nodes.count, &index))
        return false;
    const struct gltf_node *node = &r->gltf->nodes.items[index];
    if (node->mesh != GLTF_NONE)
        show_mesh(r, node->mesh, node->world);
    return true;
}

// ---- vertices

// The matrix that transforms normals: that of cofactors, the inverse transpose times the determinant.
static mat3 for_normals(mat3 a) {
    const double sign = mat3_determinant(a) < 0 ? -1 : 1;
    mat3 c;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            c.m[i][j] = sign * (a.m[i1][j1] * a.m[i2][j2] - a.m[i1][j2] * a.m[i2][j1]);
        }
    return c;
}

static vec3 vector_at(const double *numbers, uint32_t at) {
    return (vec3){numbers[3 * (size_t)at] + 0, numbers[3 * (size_t)at + 1] + 0,
                  numbers[3 * (size_t)at + 2] + 0};
}

struct placing {
    struct reading *r;
    const struct gltf_geometry *geometry;
    const struct shown *shown;
    mat3 turn; // of normals
    const double *coordinates;
    uint32_t first; // vertex of it
};

static void put_vertex(const struct placing *p, uint32_t at) {
    struct reading *r = p->r;
    const vec3 place = affine3_apply(p->shown->place, vector_at(p->geometry->positions, at));
    // No coordinate is -0.
    r->out->vertices.items[r->out->vertices.count++] = (vec3){place.x + 0, place.y + 0, place.z + 0};
    if (r->has_normals && p->geometry->normals)
        r->out->normals.items[r->out->normals.count++] =
            mat3_apply(p->turn, vector_at(p->geometry->normals, at));
    if (!r->wants_coordinates)
        return;
    const double *c = p->coordinates ? &p->coordinates[2 * (size_t)at] : NULL;
    r->coordinates.items[r->coordinates.count++] =
        c ? (struct ir_pair){c[0], 1 - c[1]} : (struct ir_pair){NAN, NAN};
}

// The normal of a face if the primitive has no normals: it is flat.
static void put_flat(struct reading *r, const uint32_t corners[3]) {
    const vec3 *v = r->out->vertices.items;
    const vec3 a = v[corners[0]], b = v[corners[1]], c = v[corners[2]];
    r->out->normals.items[r->out->normals.count++] = vec3_unit(vec3_cross(vec3_sub(b, a), vec3_sub(c, a)));
}

static void put_face(const struct placing *p, uint32_t triangle, uint32_t first_normal, bool is_mirrored,
                     bool shared) {
    struct reading *r = p->r;
    struct polygons *out = r->out;
    uint32_t corners[3];
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t from = is_mirrored ? 2 - k : k;
        corners[k] =
            p->first + (shared ? p->geometry->corners[3 * (size_t)triangle + from] : 3 * triangle + from);
    }
    const bool flat = r->has_normals && !p->geometry->normals;
    if (flat)
        put_flat(r, corners);
    const uint32_t number = out->faces.count++;
    out->faces.items[number] =
        (struct polygon_face){.first = out->corners.count, .line = number + 1, .group = p->shown->group};
    for (int k = 0; k < 3; k++) {
        const uint32_t normal = !r->has_normals ? IR_NO_INDEX
                                : flat          ? out->normals.count - 1
                                                : first_normal + (corners[k] - p->first);
        out->corners.items[out->corners.count++] = (struct polygon_corner){corners[k], normal};
    }
}

// The coordinates that the image of its material uses.
static const double *coordinates_of(const struct reading *r, const struct gltf_primitive *primitive,
                                    const struct gltf_geometry *geometry) {
    const uint32_t material = primitive->material;
    const uint32_t set = material == GLTF_NONE ? 0 : r->gltf->materials.items[material].base_texture.set;
    return geometry->coordinates[set < GLTF_COORDINATE_SETS ? set : 0];
}

static bool put_shown(struct reading *r, const struct shown *shown) {
    struct gltf_geometry geometry;
    if (!gltf_read_primitive(r->gltf, shown->primitive, r->scratch, &geometry))
        return false;
    const struct placing p = {.r = r,
                              .geometry = &geometry,
                              .shown = shown,
                              .turn = for_normals(shown->place.linear),
                              .coordinates = coordinates_of(r, shown->primitive, &geometry),
                              .first = r->out->vertices.count};
    const uint32_t first_normal = r->out->normals.count;
    const bool shared = shares(r->gltf, shown->primitive),
               is_mirrored = mat3_determinant(shown->place.linear) < 0;
    const uint32_t vertices = shared ? geometry.vertices : 3 * geometry.triangles;
    for (uint32_t i = 0; i < vertices; i++)
        put_vertex(&p, shared ? i : geometry.corners[i]);
    for (uint32_t t = 0; t < geometry.triangles; t++)
        put_face(&p, t, first_normal, is_mirrored, shared);
    return true;
}

// ---- all

static bool check_counts(struct reading *r) {
    const uint64_t most = r->file->input->limits->value[LIMIT_MESH_TRIANGLES];
    if (r->out->triangle_count == 0) {
        asset_report_line(r->file, DIAG_MESH_EMPTY, 0, "the mesh has no faces");
        return false;
    }
    if (r->out->triangle_count > r->most) {
        asset_report_limit(r->file, LIMIT_MESH_COPIES, 0, 0,
                           r->out->triangle_count - r->most +
                               r->file->input->limits->value[LIMIT_MESH_COPIES]);
        return false;
    }
    if (r->out->triangle_count <= most && r->vertices < UINT32_MAX)
        return true;
    asset_report_limit(r->file, LIMIT_MESH_TRIANGLES, 0, 0, r->out->triangle_count);
    return false;
}

#define MAKE_ROOM(list, most)                                                                                \
    ((list).items = arena_alloc_array(r->scratch, (size_t)(most), sizeof *(list).items),                     \
     (list).capacity = (uint32_t)(most))

static void make_room(struct reading *r) {
    const uint64_t triangles = r->out->triangle_count;
    MAKE_ROOM(r->out->vertices, r->vertices);
    MAKE_ROOM(r->out->corners, 3 * triangles);
    MAKE_ROOM(r->out->faces, triangles);
    if (r->has_normals)
        MAKE_ROOM(r->out->normals, r->vertices + triangles);
    if (r->wants_coordinates)
        MAKE_ROOM(r->coordinates, r->vertices);
}

static void report_part(struct reading *r) {
    const str part = r->file->part;
    asset_report_part(r->file, "the mesh '%.*s' has no part '%.*s'", STR_ARG(r->file->path),
                      part.len < 80 ? (int)part.len : 80, part.ptr);
    struct nearest search = nearest_begin(part);
    for (uint32_t i = 0; i < r->gltf->meshes.count; i++)
        nearest_offer(&search, r->gltf->meshes.items[i].name);
    const str best = nearest_best(&search);
    if (best.len) {
        diag_help(r->file->input->sink, "did you mean '%.*s'?", STR_ARG(best));
        diag_fix_part(r->file->input->sink, r->file->input->sources, false, part, best);
    } else
        diag_help(r->file->input->sink,
                  "it has %u mesh%s and %u node%s: write the name of a mesh, 'mesh 0' or 'node 0'",
                  r->gltf->meshes.count, r->gltf->meshes.count == 1 ? "" : "es", r->gltf->nodes.count,
                  r->gltf->nodes.count == 1 ? "" : "s");
}

static bool read_all(struct reading *r) {
    if (!gltf_document_buffers(r->document))
        return false;
    r->group_of = ARENA_ARRAY(r->scratch, uint32_t, (size_t)r->gltf->materials.count + 1);
    if (!show_part(r, r->file->part)) {
        report_part(r);
        return false;
    }
    if (!check_counts(r))
        return false;
    make_room(r);
    bool good = true;
    for (uint32_t i = 0; i < r->shown.count; i++)
        good &= put_shown(r, &r->shown.items[i]);
    return good;
}

void read_gltf(struct asset_file *file, struct arena *scratch, struct polygons *out) {
    struct gltf_document *document = file->document;
    struct reading r = {
        .document = document, .gltf = &document->gltf, .file = file, .scratch = scratch, .out = out};
    *out = (struct polygons){.is_binary = true}; // faces have numbers, and no lines
    if (!read_all(&r))
        file->errors += file->errors == 0;
}

void read_gltf_coordinates(struct asset_file *file, struct arena *scratch, struct textured_faces *out) {
    struct gltf_document *document = file->document;
    struct polygons polygons = {0};
    struct reading r = {.document = document,
                        .gltf = &document->gltf,
                        .file = file,
                        .scratch = scratch,
                        .out = &polygons,
                        .wants_coordinates = true};
    if (!read_all(&r)) {
        file->errors += file->errors == 0;
        return;
    }
    out->vertex_count = polygons.vertices.count;
    out->coordinates.items = r.coordinates.items;
    out->coordinates.count = r.coordinates.count;
    out->corners.items = ARENA_ARRAY(scratch, struct textured_corner, polygons.corners.count);
    out->faces.items = ARENA_ARRAY(scratch, uint32_t, polygons.faces.count);
    for (uint32_t i = 0; i < polygons.corners.count; i++) {
        const uint32_t vertex = polygons.corners.items[i].vertex;
        const bool has = !isnan(r.coordinates.items[vertex].u);
        out->corners.items[out->corners.count++] =
            (struct textured_corner){vertex, has ? vertex : IR_NO_INDEX};
    }
    for (uint32_t i = 0; i < polygons.faces.count; i++)
        out->faces.items[out->faces.count++] = polygons.faces.items[i].first;
    for (uint32_t i = 0; i < out->coordinates.count; i++)
        if (isnan(out->coordinates.items[i].u))
            out->coordinates.items[i] = (struct ir_pair){0, 0};
}
