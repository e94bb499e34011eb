#include "assets/made/revolve.h"

#include "assets/made/ends.h"
#include "assets/made/fault.h"
#include "assets/made/shell.h"
#include "core/angle.h"
#include "core/heap.h"

enum {
    COLUMNS_LEAST = 8, // of a whole turn
};

struct revolving {
    const struct revolve *in;
    struct shell shell;
    uint32_t columns, node_count;
    bool is_whole;
    double out_sign;         // 1: outside is to the right of the path; -1: to its left
    struct vec3_turn *turns; // of half columns, 2 * columns + 1
    uint32_t *first;         // per node: its vertex in column 0
    uint32_t *u;             // coordinates of one node: reused
};

uint32_t revolve_columns(double angle, double share) {
    // 1 - cos(x) is at most x * x / 2.
    double whole = 4 * ceil(PI / sqrt(2 * share) / 4);
    whole = fmin(fmax(whole, COLUMNS_LEAST), MADE_COLUMNS_MOST);
    const double columns = ceil(whole * (angle / 360));
    return columns > 1 ? (uint32_t)columns : 1;
}

static struct ir_pair node_at(const struct revolving *r, uint32_t node) {
    const struct path *path = r->in->path;
    return node < path->count ? path->pieces[node].from : path->pieces[path->count - 1].to;
}

static uint32_t node_after(const struct revolving *r, uint32_t piece) {
    return piece + 1 < r->node_count ? piece + 1 : 0;
}

// Twice the area between the path and the axis; positive if the body is to the left of the path.
static double signed_area(const struct revolving *r) {
    const struct path *path = r->in->path;
    const struct ir_pair first = node_at(r, 0), last = path->pieces[path->count - 1].to;
    double sum = r->in->is_ring ? 0 : last.u * last.v - first.u * first.v;
    for (uint32_t i = 0; i < path->count; i++)
        sum += plane_cross(path->pieces[i].from, path->pieces[i].to);
    return sum;
}

// ---- counts

static uint32_t on_axis(const struct path_piece *piece) {
    return (piece->from.u == 0) + (piece->to.u == 0);
}

static uint64_t count_pieces(const struct revolving *r, uint64_t for_quad, uint64_t for_triangle) {
    uint64_t sum = 0;
    for (uint32_t i = 0; i < r->in->path->count; i++) {
        const uint32_t ends = on_axis(&r->in->path->pieces[i]);
        sum += ends == 0 ? for_quad : ends == 1 ? for_triangle : 0;
    }
    return sum * r->columns;
}

// ---- vertices

static void make_turns(struct revolving *r, struct arena *arena) {
    r->turns = ARENA_ARRAY(arena, struct vec3_turn, heap_times(2, r->columns) + 1);
    for (uint32_t i = 0; i <= 2 * r->columns; i++)
        r->turns[i] = vec3_turn_of(r->in->angle * i / (2 * r->columns));
}

// A point, or a direction, of the path's plane turned by half columns.
static vec3 turned(const struct revolving *r, struct ir_pair at, uint32_t half) {
    return (vec3){at.u * r->turns[half].cosine, at.v, -at.u * r->turns[half].sine};
}

static void make_vertices(struct revolving *r, struct arena *arena) {
    const uint32_t columns = r->is_whole ? r->columns : r->columns + 1;
    r->first = ARENA_ARRAY(arena, uint32_t, r->node_count);
    for (uint32_t node = 0; node < r->node_count; node++) {
        const struct ir_pair at = node_at(r, node);
        const uint32_t count = at.u == 0 ? 1 : columns;
        for (uint32_t column = 0; column < count; column++) {
            const uint32_t vertex = shell_vertex(&r->shell, turned(r, at, 2 * column));
            if (column == 0)
                r->first[node] = vertex;
        }
    }
}

static uint32_t vertex_at(const struct revolving *r, uint32_t node, uint32_t column) {
    if (node_at(r, node).u == 0)
        return r->first[node];
    return r->first[node] + (r->is_whole && column == r->columns ? 0 : column);
}

// ---- normals and coordinates of one end of a piece: of each column boundary, or, on the axis, of each
// column

struct rim {
    struct ir_pair along;
    uint32_t node, normal, coordinate;
    bool is_pole;
};

static struct rim make_rim(struct revolving *r, uint32_t node, struct ir_pair along, double length) {
    const struct ir_pair normal = {along.v * r->out_sign, -along.u * r->out_sign};
    const double v = length / r->in->path->length;
    const struct rim rim = {along, node, r->shell.out->polygons.normals.count,
                            r->shell.out->textured.coordinates.count, node_at(r, node).u == 0};
    const uint32_t count = rim.is_pole ? r->columns : r->columns + 1;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t half = rim.is_pole ? 2 * i + 1 : 2 * i;
        shell_normal(&r->shell, turned(r, normal, half));
        shell_coordinate(&r->shell, half / (2.0 * r->columns), v);
    }
    return rim;
}

static struct shell_corner corner_of(const struct revolving *r, const struct rim *rim, uint32_t column) {
    return (struct shell_corner){vertex_at(r, rim->node, column), rim->normal + column,
                                 rim->coordinate + column};
}

static void add_column(struct revolving *r, const struct rim *from, const struct rim *to, uint32_t column) {
    struct shell_corner corners[4];
    uint32_t count = 0;
    corners[count++] = corner_of(r, from, column);
    if (!from->is_pole)
        corners[count++] = corner_of(r, from, column + 1);
    if (!to->is_pole)
        corners[count++] = corner_of(r, to, column + 1);
    corners[count++] = corner_of(r, to, column);
    for (uint32_t i = 0; r->out_sign < 0 && i < count / 2; i++) {
        const struct shell_corner swap = corners[i];
        corners[i] = corners[count - 1 - i];
        corners[count - 1 - i] = swap;
    }
    shell_face(&r->shell, corners, count);
}

static void add_pieces(struct revolving *r) {
    struct rim last = {.node = IR_NO_INDEX};
    for (uint32_t i = 0; i < r->in->path->count; i++) {
        const struct path_piece *piece = &r->in->path->pieces[i];
        if (on_axis(piece) == 2)
            continue;
        const bool goes_on = last.node == i && plane_same(last.along, piece->along_from);
        const struct rim from = goes_on ? last : make_rim(r, i, piece->along_from, piece->length_before);
        const struct rim to = make_rim(r, node_after(r, i), piece->along_to, piece->length_after);
        for (uint32_t column = 0; column < r->columns; column++)
            add_column(r, &from, &to, column);
        last = to;
    }
}

// ---- end faces

static void add_end(struct revolving *r, const struct ends *ends, uint32_t column) {
    const struct vec3_turn turn = r->turns[2 * column];
    const double sign = column == 0 ? 1 : -1;
    const uint32_t normal = shell_normal(&r->shell, (vec3){sign * turn.sine, 0, sign * turn.cosine});
    const uint32_t first = shell_box_coordinates(&r->shell, &ends->box, ends->nodes, r->node_count);
    for (uint32_t t = 0; t < ends->triangle_count; t++) {
        struct shell_corner corners[3];
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t node = ends->triangles[t][column == 0 ? k : 2 - k];
            corners[k] = (struct shell_corner){vertex_at(r, node, column), normal, first + node};
        }
        shell_face(&r->shell, corners, 3);
    }
}

static struct ends find_ends(const struct revolving *r, struct arena *arena) {
    const bool closes = r->in->is_ring || (node_at(r, 0).u == 0 && node_at(r, r->node_count - 1).u == 0);
    struct ends ends = {0};
    if (!r->is_whole && closes)
        ends_cut(&ends, r->in->path, r->in->is_ring, arena);
    return ends;
}

bool revolve_build(const struct revolve *in, const struct made_to *to, struct made *out) {
    struct revolving r = {.in = in,
                          .columns = in->columns,
                          .node_count = in->is_ring ? in->path->count : in->path->count + 1,
                          .is_whole = in->angle == 360};
    r.out_sign = signed_area(&r) < 0 ? -1 : 1;
    const struct ends ends = find_ends(&r, to->arena);
    if (!made_count(out, to, count_pieces(&r, 2, 1) + 2 * (uint64_t)ends.triangle_count))
        return false;
    shell_begin(&r.shell, to, out, count_pieces(&r, 1, 1) + 2 * (uint64_t)ends.triangle_count,
                count_pieces(&r, 4, 3) + 6 * (uint64_t)ends.triangle_count);
    make_turns(&r, to->arena);
    make_vertices(&r, to->arena);
    add_pieces(&r);
    if (ends.triangle_count) {
        add_end(&r, &ends, 0);
        add_end(&r, &ends, r.columns);
    }
    shell_end(&r.shell);
    return true;
}
