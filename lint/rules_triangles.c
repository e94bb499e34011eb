// Triangles one by one: without area, given twice, with normals that oppose them.
#include "diag/codes/rule.h"
#include "lint/lint_internal.h"

static str others(struct lint *lint, const struct lint_mesh *mesh) {
    if (mesh->model_count == 1)
        return STR("");
    return arena_format(lint->arena, "; %u models share it", mesh->model_count);
}

// ---- without area

static void check_area(struct lint *lint, struct lint_mesh *mesh) {
    if (mesh->mesh->zero_area == 0)
        return;
    uint32_t line = 0;
    for (uint32_t i = 0; i < mesh->mesh->triangle_count; i++) {
        const struct mesh_triangle *triangle = &mesh->mesh->triangles[i];
        if ((line == 0 || triangle->line < line) && !mesh_has_area(mesh->mesh, i))
            line = triangle->line;
    }
    uint32_t n = mesh->mesh->zero_area;
    diag_add(lint->sink, DIAG_ZERO_AREA, lint_place_mesh(lint, mesh->first),
             "%u of the mesh's %u triangles %s no area%.*s", n, mesh->mesh->triangle_count,
             n == 1 ? "has" : "have", STR_ARG(others(lint, mesh)));
    lint_note_mesh(lint, mesh, line, n == 1 ? "in this face" : "the first is in this face");
    diag_help(lint->sink, "remove them%s; they are not drawn",
              mesh->mesh->is_made ? "" : " in a modelling program");
}

void lint_zero_area(struct lint *lint) {
    for (uint32_t i = 0; i < lint->meshes.count; i++)
        check_area(lint, lint->meshes.items[i]);
}

// ---- given twice

struct corners {
    uint32_t c[3]; // merged, ascending
};

static struct corners corners_of(const struct mesh *mesh, uint32_t triangle) {
    const uint32_t *from = mesh->triangles[triangle].corners;
    uint32_t a = mesh->merged[from[0]];
    uint32_t b = mesh->merged[from[1]];
    uint32_t c = mesh->merged[from[2]];
    uint32_t least = a < b ? a < c ? a : c : b < c ? b : c;
    uint32_t most = a > b ? a > c ? a : c : b > c ? b : c;
    return (struct corners){{least, a ^ b ^ c ^ least ^ most, most}};
}

struct twins {
    uint32_t count;
    uint32_t line, of_line; // of the first pair: the later face, and the one that it repeats
};

static uint64_t hash_of(struct corners corners) {
    uint64_t hash = 0;
    for (int k = 0; k < 3; k++) {
        // The finalizer of MurmurHash3 over each part.
        hash = (hash ^ corners.c[k]) * UINT64_C(0xff51afd7ed558ccd);
        hash = (hash ^ hash >> 33) * UINT64_C(0xc4ceb9fe1a85ec53);
        hash ^= hash >> 33;
    }
    return hash;
}

static bool is_same(struct corners a, struct corners b) {
    return a.c[0] == b.c[0] && a.c[1] == b.c[1] && a.c[2] == b.c[2];
}

// Of `count` triangles in file order; NULL: the first ones.
static struct twins find_twins(struct lint *lint, const struct mesh *mesh, const uint32_t *triangles,
                               uint32_t count) {
    struct twins twins = {0};
    uint64_t slots = 16;
    while (slots < 2 * (uint64_t)count)
        slots *= 2;
    uint32_t *table = ARENA_ARRAY(lint->arena, uint32_t, slots); // triangle plus 1
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t i = triangles ? triangles[k] : k;
        struct corners own = corners_of(mesh, i);
        if (own.c[0] == own.c[1] || own.c[1] == own.c[2])
            continue;
        uint64_t at = hash_of(own) & (slots - 1);
        while (table[at] && !is_same(corners_of(mesh, table[at] - 1), own))
            at = (at + 1) & (slots - 1);
        if (!table[at]) {
            table[at] = i + 1;
            continue;
        }
        if (twins.count++ == 0) {
            twins.line = mesh->triangles[i].line;
            twins.of_line = mesh->triangles[table[at] - 1].line;
        }
    }
    return twins;
}

// If the tree holds all triangles, only those at the same place on the curve can be twins.
static struct twins twins_of(struct lint *lint, const struct lint_mesh *mesh) {
    const uint32_t all = mesh->mesh->triangle_count;
    if (mesh->tree.crowded && mesh->tree.count == all)
        return find_twins(lint, mesh->mesh, mesh->tree.crowded, mesh->tree.crowded_count);
    return find_twins(lint, mesh->mesh, NULL, all);
}

void lint_duplicates(struct lint *lint) {
    for (uint32_t i = 0; i < lint->meshes.count; i++) {
        struct lint_mesh *mesh = lint->meshes.items[i];
        struct twins twins = twins_of(lint, mesh);
        if (twins.count == 0)
            continue;
        diag_add(lint->sink, DIAG_DUPLICATE_TRIANGLES, lint_place_mesh(lint, mesh->first),
                 "%u of the mesh's %u triangles %s the same corners as an earlier one%.*s", twins.count,
                 mesh->mesh->triangle_count, twins.count == 1 ? "has" : "have", STR_ARG(others(lint, mesh)));
        lint_note_mesh(lint, mesh, twins.line, "%s in this face",
                       twins.count == 1 ? "it is" : "the first is");
        lint_note_mesh(lint, mesh, twins.of_line, "which repeats this one");
        diag_help(lint->sink, "remove the repeated faces%s",
                  mesh->mesh->is_made ? "" : " in a modelling program");
    }
}

// ---- normals

// A normal that lies in the face, which rounding may tip over, does not count as opposing it.
static const double SLACK = 0.05;

struct torn {
    uint32_t count, line;   // faces whose normals point to both sides: no orientation makes them all fit
    uint32_t opposed, seen; // faces whose normals all point against them, of those with normals
    uint32_t opposed_line;
};

static void look_at(const struct mesh *mesh, uint32_t i, struct torn *torn) {
    const struct mesh_triangle *triangle = &mesh->triangles[i];
    vec3 face = lint_face_of(lint_mesh_triangle(mesh, i)).normal;
    bool any = false;
    bool along = false;
    bool against = false;
    for (int k = 0; k < 3; k++) {
        if (triangle->normals[k] == IR_NO_INDEX)
            continue;
        double cosine = vec3_dot(face, mesh->normals[triangle->normals[k]]);
        any = true;
        along = along || cosine > SLACK;
        against = against || cosine < -SLACK;
    }
    torn->seen += any;
    if (along && against)
        torn->line = torn->count++ == 0 ? triangle->line : torn->line;
    else if (against)
        torn->opposed_line = torn->opposed++ == 0 ? triangle->line : torn->opposed_line;
}

static void report_torn(struct lint *lint, struct lint_mesh *mesh, const struct torn *torn) {
    uint32_t n = torn->count + torn->opposed;
    diag_add(lint->sink, DIAG_OPPOSING_NORMALS, lint_place_mesh(lint, mesh->first_smooth),
             "%u of the mesh's %u triangles %s normals in the file that oppose the face", n,
             mesh->mesh->triangle_count, n == 1 ? "has" : "have");
    if (torn->count)
        lint_note_mesh(lint, mesh, torn->line, "%u triangle%s on both sides, the first in this face",
                       torn->count, torn->count == 1 ? " has normals" : "s have normals");
    if (torn->opposed)
        lint_note_mesh(lint, mesh, torn->opposed_line,
                       "%u triangle%s only on the back, the first in this face", torn->opposed,
                       torn->opposed == 1 ? " has normals" : "s have normals");
    diag_help(lint->sink, "recompute the normals in a modelling program, or remove them from the file: "
                          "smooth models without normals compute their own");
}

void lint_opposing_normals(struct lint *lint) {
    for (uint32_t i = 0; i < lint->meshes.count; i++) {
        struct lint_mesh *mesh = lint->meshes.items[i];
        if (!mesh->first_smooth || mesh->mesh->normal_count == 0)
            continue;
        struct torn torn = {0};
        for (uint32_t t = 0; t < mesh->mesh->triangle_count; t++)
            if (mesh->mesh->zero_area == 0 || mesh_has_area(mesh->mesh, t))
                look_at(mesh->mesh, t, &torn);
        // If all point to the back, a sheet or a mesh that was turned at load is merely seen from there; but
        // the normals of a closed body point into it.
        bool all_back = torn.opposed == torn.seen && !(mesh->mesh->closed && !mesh->mesh->turned);
        if (torn.count || (torn.opposed && !all_back))
            report_torn(lint, mesh, &torn);
    }
}
