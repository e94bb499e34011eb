#include "tools/meshgen/solids.h"

#include "core/angle.h"

enum {
    SIDES_MAX = 12
};

struct ring_corners {
    int index[SIDES_MAX];
    bool is_point;
};

// Turns the faces from `first_face` on outward, by their signed volume.
static void solids_orient(struct mesh *mesh, int first_face) {
    double volume = 0;
    if (mesh->failed || first_face >= mesh->face_count)
        return;
    vec3 origin = mesh->positions[mesh->faces[first_face].corners[0]];
    for (int f = first_face; f < mesh->face_count; f++) {
        const struct mesh_face *face = &mesh->faces[f];
        vec3 offset = vec3_sub(mesh->positions[face->corners[0]], origin);
        volume += vec3_dot(offset, mesh_face_normal(mesh, face));
    }
    for (int f = first_face; volume < 0 && f < mesh->face_count; f++) {
        struct mesh_face *face = &mesh->faces[f];
        for (int i = 0, j = face->corner_count - 1; i < j; i++, j--) {
            int swapped = face->corners[i];
            face->corners[i] = face->corners[j];
            face->corners[j] = swapped;
        }
    }
}

static double corner_angle(double first_deg, double k, int sides) {
    return PI * (first_deg / 180 + 2 * k / sides);
}

static struct ring_corners place_ring(struct mesh *mesh, const struct solids_ring *ring, int sides,
                                      double first_deg) {
    struct ring_corners placed = {.is_point = vec3_is_zero(ring->u) && vec3_is_zero(ring->v)};
    for (int k = 0; k < sides; k++) {
        double angle = corner_angle(first_deg, k, sides);
        vec3 offset = vec3_add(vec3_mul(ring->u, cos(angle)), vec3_mul(ring->v, sin(angle)));
        placed.index[k] =
            placed.is_point && k ? placed.index[0] : mesh_vertex(mesh, vec3_add(ring->centre, offset));
    }
    return placed;
}

// Two triangles a side, the diagonal leaning towards the middle plane on both sides of it, so that a
// symmetric ring gives a symmetric figure.
static void join_side(struct mesh *mesh, const struct ring_corners *a, const struct ring_corners *b, int k,
                      int sides) {
    int next = (k + 1) % sides;
    bool lean = 2 * k < sides;
    if (a->is_point || b->is_point) {
        if (!a->is_point)
            mesh_triangle(mesh, a->index[k], a->index[next], b->index[0]);
        if (!b->is_point)
            mesh_triangle(mesh, a->index[0], b->index[next], b->index[k]);
    } else if (lean) {
        mesh_triangle(mesh, a->index[k], a->index[next], b->index[k]);
        mesh_triangle(mesh, a->index[next], b->index[next], b->index[k]);
    } else {
        mesh_triangle(mesh, a->index[k], a->index[next], b->index[next]);
        mesh_triangle(mesh, a->index[k], b->index[next], b->index[k]);
    }
}

static void lid(struct mesh *mesh, const struct ring_corners *ring, int sides, bool reversed) {
    int corners[SIDES_MAX];
    if (ring->is_point)
        return;
    for (int k = 0; k < sides; k++)
        corners[k] = ring->index[reversed ? sides - 1 - k : k];
    mesh_face(mesh, corners, sides);
}

void solids_loft(struct mesh *mesh, const struct solids_ring *rings, int ring_count, int sides,
                 double angle_deg) {
    int first_face = mesh->face_count;
    struct ring_corners before = place_ring(mesh, &rings[0], sides, angle_deg);
    mesh->material = rings[0].material;
    lid(mesh, &before, sides, true);
    for (int i = 1; i < ring_count; i++) {
        struct ring_corners after = place_ring(mesh, &rings[i], sides, angle_deg);
        const struct solids_ring *look = &rings[i - 1];
        for (int k = 0; k < sides; k++) {
            bool below = sin(corner_angle(angle_deg, k + 0.5, sides)) < -0.1;
            mesh->material = below && look->second ? look->second : look->material;
            join_side(mesh, &before, &after, k, sides);
        }
        before = after;
    }
    mesh->material = rings[ring_count - 1].material;
    lid(mesh, &before, sides, false);
    solids_orient(mesh, first_face);
}

void solids_octahedron(struct mesh *mesh, vec3 centre, vec3 half_axes) {
    const struct solids_ring rings[3] = {
        {.centre = {centre.x, centre.y, centre.z - half_axes.z}, .material = mesh->material},
        {centre, {half_axes.x, 0, 0}, {0, half_axes.y, 0}, mesh->material, NULL},
        {.centre = {centre.x, centre.y, centre.z + half_axes.z}, .material = mesh->material},
    };
    solids_loft(mesh, rings, 3, 4, 0);
}
