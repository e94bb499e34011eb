// Smooth glass: `smooth` bends light by normals that lie between those of its faces, and what one sees
// through a body is as wrong as these are.
#include "diag/codes/rule.h"
#include "lint/lint_internal.h"

#include "core/angle.h"
#include "grammar/ir.h"

#include <math.h>

// A ball of glass of which normals differ from the faces by this many degrees shows the scene wrong by 1 % of
// the range of its pixels, a thin-walled bowl by 3 % (bench/smooth_glass.sh).
#define OFF_MOST  6.0
#define PART_MOST 0.25 // of the surface

struct facets {
    double area, coarse; // of the mesh; of the triangles that differ by more than OFF_MOST
    double most;         // degrees
    uint32_t line;       // of the first of them
};

static void look_at(const struct mesh *mesh, uint32_t triangle, const vec3 normals[3],
                    struct facets *facets) {
    const uint32_t *c = mesh->triangles[triangle].corners;
    const vec3 u = vec3_sub(mesh->positions[c[1]], mesh->positions[c[0]]);
    const vec3 face = vec3_cross(u, vec3_sub(mesh->positions[c[2]], mesh->positions[c[0]]));
    const double area = vec3_length(face);
    double off = 0;
    // Turned normals count as the device takes them: on the face's side.
    for (int k = 0; k < 3; k++)
        off = fmax(off, atan2(vec3_length(vec3_cross(face, normals[k])), fabs(vec3_dot(face, normals[k]))) /
                            RADIANS);
    facets->area += area;
    facets->most = fmax(facets->most, off);
    if (off <= OFF_MOST)
        return;
    facets->coarse += area;
    if (facets->line == 0 || mesh->triangles[triangle].line < facets->line)
        facets->line = mesh->triangles[triangle].line;
}

static bool bends(const struct lint *lint, const struct lint_body *body) {
    for (uint32_t i = 0; i < body->is->group_count; i++) {
        const struct ir_material *material = lint_material(lint, body, i);
        if (material->albedo.refraction > 0 && material->refractive_index != 1)
            return true;
    }
    return false;
}

static void report(struct lint *lint, const struct lint_body *body, const struct facets *facets) {
    diag_add(
        lint->sink, DIAG_COARSE_GLASS, ir_place_key(lint->origin, body->is->head, &SCHEMA_MODEL, "smooth"),
        "the faces of %.*s are too coarse for smooth glass: on %.0f %% of its surface normals differ from "
        "the face by "
        "more than %.0f degrees, at most %.0f",
        STR_ARG(lint_words(lint, body)), ceil(100 * facets->coarse / facets->area), OFF_MOST, facets->most);
    lint_note_mesh(lint, body->mesh, facets->line, "the first of these faces");
    const bool is_made = body->mesh->mesh->is_made, lacks = mesh_lacks_normals(body->mesh->mesh);
    diag_help(lint->sink, "%s; %swithout 'smooth' it is cut glass",
              is_made ? "give the mesh a smaller tolerance, such as tolerance: 0.0001"
                      : "take a mesh with more faces",
              lacks ? "crease_angle: 40 keeps edges sharp that should be sharp, and " : "");
}

void lint_coarse_glass(struct lint *lint) {
    for (uint32_t i = 0; i < lint->body_count; i++) {
        const struct lint_body *body = &lint->bodies[i];
        struct lint_mesh *mesh = body->mesh;
        if (!mesh || !body->is->smooth || !body->is->closed || !bends(lint, body) ||
            mesh->facets_of == body->is->crease_angle)
            continue;
        struct facets facets = {0};
        const vec3 *normals = mesh_smooth_normals(mesh->mesh, body->is->crease_angle, lint->arena);
        for (uint32_t t = 0; t < mesh->mesh->triangle_count; t++)
            look_at(mesh->mesh, t, normals + 3 * (size_t)t, &facets);
        mesh->facets_of = body->is->crease_angle; // of many models most have the same
        if (facets.coarse > PART_MOST * facets.area)
            report(lint, body, &facets);
    }
}
