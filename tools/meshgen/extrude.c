#include "tools/meshgen/extrude.h"

#include "core/angle.h"

enum {
    ROUND_STEPS = 4,
    ROWS = 2 * (ROUND_STEPS + 1), // from the back face to the front face
};

static const double SMOOTH_COSINE = 0.866;

// A point of the outline stands in ROWS rows, once for each edge that meets there, or once for both where
// they join smoothly.
struct columns {
    int arriving[OUTLINE_POINTS_MAX]; // first vertex of the column, as the end of the edge before
    int leaving[OUTLINE_POINTS_MAX];  // the same, as the start of the edge after
};

static int place_column(struct mesh *mesh, vec2 point, vec2 inward, vec2 normal,
                        const struct extrude_profile *profile) {
    int first = mesh->vertex_count;
    for (int row = 0; row < ROWS; row++) {
        bool front = row > ROUND_STEPS;
        int step = front ? row - ROUND_STEPS - 1 : ROUND_STEPS - row;
        double angle = PI / 2 * step / ROUND_STEPS, side = front ? 1 : -1;
        double inset = profile->edge_radius * (1 - cos(angle));
        double z = side * (profile->half_depth - profile->edge_radius * (1 - sin(angle)));
        mesh_vertex_normal(mesh, (vec3){point.x + inset * inward.x, point.y + inset * inward.y, z},
                           (vec3){cos(angle) * normal.x, cos(angle) * normal.y, side * sin(angle)});
    }
    return first;
}

static void place_columns(struct mesh *mesh, const struct outline *outline, double shift_x,
                          const struct extrude_profile *profile, struct columns *columns) {
    for (int i = 0; i < outline->starts[outline->contour_count]; i++) {
        vec2 point = {outline->points[i].x + shift_x, outline->points[i].y};
        vec2 inward = outline_inset_direction(outline, i);
        vec2 before = outline_edge_normal(outline, outline_previous(outline, i));
        vec2 after = outline_edge_normal(outline, i);
        if (before.x * after.x + before.y * after.y > SMOOTH_COSINE) {
            vec2 both = {before.x + after.x, before.y + after.y};
            double length = hypot(both.x, both.y);
            both = (vec2){both.x / length, both.y / length};
            columns->arriving[i] = columns->leaving[i] = place_column(mesh, point, inward, both, profile);
        } else {
            columns->arriving[i] = place_column(mesh, point, inward, before, profile);
            columns->leaving[i] = place_column(mesh, point, inward, after, profile);
        }
    }
}

void extrude_outline(struct mesh *mesh, const struct outline *outline, double shift_x,
                     const struct extrude_profile *profile) {
    struct columns columns;
    int triangles[OUTLINE_TRIANGLES_MAX][3];
    place_columns(mesh, outline, shift_x, profile, &columns);
    for (int i = 0; i < outline->starts[outline->contour_count]; i++) {
        int a = columns.leaving[i], b = columns.arriving[outline_next(outline, i)];
        for (int row = 0; row + 1 < ROWS; row++)
            mesh_quad(mesh, a + row, b + row, b + row + 1, a + row + 1);
    }
    int count = outline_triangulate(outline, profile->edge_radius, triangles);
    mesh->failed |= count < 0;
    for (int t = 0; t < count; t++) {
        const int *corner = triangles[t];
        const int *column = columns.leaving;
        mesh_triangle(mesh, column[corner[0]] + ROWS - 1, column[corner[1]] + ROWS - 1,
                      column[corner[2]] + ROWS - 1);
        mesh_triangle(mesh, column[corner[2]], column[corner[1]], column[corner[0]]);
    }
}
