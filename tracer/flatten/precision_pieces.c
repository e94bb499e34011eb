// Bounds on the measures of a mesh's triangles where a body shows it. A map multiplies a length by at least
// the root of the least eigenvalue of M^T M and at most that of the greatest, which lie within Gershgorin's
// discs (Golub and Van Loan 2013, theorem 7.2.1); for a model's map, whose columns are perpendicular, the
// discs are points.
#include "core/heap.h"
#include "core/parallel.h"
#include "tracer/flatten/precision_internal.h"

#include <stdlib.h>

// More than the rounding of a product of a few numbers, and of a sum of coordinates.
#define ROUNDED 0x1p-40
#define SLACK   0x1p-46

// ---- in the mesh

static double edge(const struct mesh *mesh, const uint32_t *corners, int k) {
    return vec3_length(vec3_sub(mesh->positions[corners[(k + 1) % 3]], mesh->positions[corners[k]]));
}

static void add(const struct mesh *mesh, uint32_t triangle, struct precision_piece *piece) {
    const uint32_t *corners = mesh->triangles[triangle].corners;
    const double length[3] = {edge(mesh, corners, 0), edge(mesh, corners, 1), edge(mesh, corners, 2)};
    if (!(length[0] > 0 && length[1] > 0 && length[2] > 0))
        return;
    for (int k = 0; k < 3; k++) {
        piece->lower = vec3_least(piece->lower, mesh->positions[corners[k]]);
        piece->upper = vec3_greatest(piece->upper, mesh->positions[corners[k]]);
        piece->shortest = length[k] < piece->shortest ? length[k] : piece->shortest;
        piece->longest = length[k] > piece->longest ? length[k] : piece->longest;
    }
}

static struct precision_piece no_piece(void) {
    return (struct precision_piece){
        {INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, INFINITY, 0};
}

static void make_pieces(void *context, size_t begin, size_t end) {
    const struct precision_pieces *pieces = context;
    for (size_t i = begin; i < end; i++) {
        const uint32_t first = (uint32_t)i * PRECISION_PIECE, all = pieces->mesh->triangle_count;
        const uint32_t last = all - first < PRECISION_PIECE ? all : first + PRECISION_PIECE;
        pieces->items[i] = no_piece();
        for (uint32_t t = first; t < last; t++)
            add(pieces->mesh, t, &pieces->items[i]);
    }
}

bool precision_pieces_make(const struct mesh *mesh, struct precision_pieces *out) {
    const uint32_t count =
        mesh->triangle_count / PRECISION_PIECE + (mesh->triangle_count % PRECISION_PIECE != 0);
    *out = (struct precision_pieces){.mesh = mesh, .count = count, .whole = no_piece()};
    out->items = heap_array(count + (size_t)1, sizeof *out->items);
    if (!out->items)
        return false;
    parallel_for(count, PRECISION_PIECE, make_pieces, out);
    for (uint32_t i = 0; i < count; i++) {
        const struct precision_piece *piece = &out->items[i];
        out->whole.lower = vec3_least(out->whole.lower, piece->lower);
        out->whole.upper = vec3_greatest(out->whole.upper, piece->upper);
        out->whole.shortest = fmin(out->whole.shortest, piece->shortest);
        out->whole.longest = fmax(out->whole.longest, piece->longest);
    }
    return true;
}

void precision_pieces_finish(struct precision_pieces *pieces) {
    free(pieces->items);
    pieces->items = NULL;
}

// ---- in a body

static vec3 rows_size(const mat3 *m, vec3 v) {
    double size[3];
    for (int i = 0; i < 3; i++)
        size[i] = fabs(m->m[i][0]) * v.x + fabs(m->m[i][1]) * v.y + fabs(m->m[i][2]) * v.z;
    return (vec3){size[0], size[1], size[2]};
}

struct precision_view precision_view_of(const struct flat_input *input, const affine3 *map,
                                        const struct mesh *mesh) {
    struct precision_view view = {.map = *map,
                                  .camera = vec3_sub(input->view->camera.position, input->origin)};
    double least = INFINITY, most = 0, size = 0;
    for (int i = 0; i < 3; i++) {
        const double own = vec3_dot(mat3_column(map->linear, i), mat3_column(map->linear, i));
        double others = 0;
        for (int k = 0; k < 3; k++)
            others += k == i ? 0 : fabs(vec3_dot(mat3_column(map->linear, i), mat3_column(map->linear, k)));
        size = fmax(size, own + others);
        least = fmin(least, own - others);
        most = fmax(most, own + others);
    }
    view.least = sqrt(fmax(least - ROUNDED * size, 0));
    view.most = sqrt(most * (1 + ROUNDED));
    const vec3 farthest = vec3_max(vec3_abs(mesh->lower), vec3_abs(mesh->upper));
    view.slack = SLACK * (vec3_max_abs(rows_size(&map->linear, farthest)) + vec3_max_abs(map->offset) +
                          vec3_max_abs(view.camera));
    return view;
}

// NaN, from a piece without triangles or from numbers too large, means that it must be looked at.
bool precision_is_beyond(const struct precision_view *view, const struct precision_piece *piece,
                         const struct precision_report *found) {
    const struct precision_measure *edges = &found->least[PRECISION_EDGE],
                                   *heights = &found->least[PRECISION_HEIGHT];
    if (!edges->any || !heights->any)
        return false;
    const vec3 half = vec3_mul(vec3_sub(piece->upper, piece->lower), 0.5);
    const vec3 middle = affine3_apply(view->map, vec3_add(piece->lower, half));
    const vec3 around = rows_size(&view->map.linear, half);
    const double reach = vec3_max_abs(vec3_add(vec3_abs(middle), around)) + view->slack;
    const double shortest = piece->shortest * view->least - view->slack;
    if (!(shortest > edges->steps * (1 + ROUNDED) * reach * 0x1p-24))
        return false;
    const vec3 gap = vec3_sub(vec3_abs(vec3_sub(middle, view->camera)), around);
    const double below = fmax(gap.x, fmax(gap.y, gap.z)) - view->slack;
    const double longest = piece->longest * view->most + view->slack;
    return below * PRECISION_HEIGHT_PART > heights->steps * (1 + ROUNDED) * longest * 0x1p-24;
}
