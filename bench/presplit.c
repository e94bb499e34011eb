#include "bench/presplit.h"

#include <math.h>
#include <stdlib.h>

enum {
    POLYGON_MOST = 32, // corners of a triangle cut by boxes
    PIECES_MOST = 256, // of one triangle
};

struct polygon {
    int count;
    double p[POLYGON_MOST][3];
};

struct bounds {
    double lower[3], upper[3];
};

static struct bounds bounds_of(const struct polygon *polygon) {
    struct bounds b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (int i = 0; i < polygon->count; i++)
        for (int axis = 0; axis < 3; axis++) {
            b.lower[axis] = fmin(b.lower[axis], polygon->p[i][axis]);
            b.upper[axis] = fmax(b.upper[axis], polygon->p[i][axis]);
        }
    return b;
}

static double area_of(const struct bounds *b) {
    const double x = b->upper[0] - b->lower[0], y = b->upper[1] - b->lower[1], z = b->upper[2] - b->lower[2];
    return x * y + y * z + z * x;
}

// The part with sign * p[axis] <= sign * at (Sutherland and Hodgman 1974).
static void clip(const struct polygon *from, int axis, double at, double sign, struct polygon *to) {
    to->count = 0;
    for (int i = 0; i < from->count; i++) {
        const double *a = from->p[i], *b = from->p[(i + 1) % from->count];
        const double da = sign * (a[axis] - at), db = sign * (b[axis] - at);
        if (da <= 0 && to->count < POLYGON_MOST) {
            for (int k = 0; k < 3; k++)
                to->p[to->count][k] = a[k];
            to->count++;
        }
        if ((da < 0) != (db < 0) && da != db && to->count < POLYGON_MOST) {
            for (int k = 0; k < 3; k++)
                to->p[to->count][k] = a[k] + (b[k] - a[k]) * (da / (da - db));
            to->p[to->count++][axis] = at;
        }
    }
}

static struct polygon triangle_of(const struct bench_mesh *mesh, uint32_t triangle) {
    struct polygon polygon = {.count = 3};
    for (int k = 0; k < 3; k++)
        for (int axis = 0; axis < 3; axis++)
            polygon.p[k][axis] =
                (double)mesh
                    ->positions[3 * (size_t)mesh->corners[3 * (size_t)triangle + (size_t)k] + (size_t)axis];
    return polygon;
}

// How much of its box a triangle leaves empty: what remains of the box's area without the triangle's own, as
// it is seen along the axes.
static double priority_of(const struct bench_mesh *mesh, uint32_t triangle) {
    const struct polygon t = triangle_of(mesh, triangle);
    const struct bounds b = bounds_of(&t);
    double u[3], v[3], own = 0;
    for (int axis = 0; axis < 3; axis++) {
        u[axis] = t.p[1][axis] - t.p[0][axis];
        v[axis] = t.p[2][axis] - t.p[0][axis];
    }
    for (int axis = 0; axis < 3; axis++) {
        const int y = (axis + 1) % 3, z = (axis + 2) % 3;
        own += 0.5 * fabs(u[y] * v[z] - u[z] * v[y]);
    }
    return cbrt(fmax(area_of(&b) - own, 0));
}

struct pieces {
    struct bvh_item *items;
    uint32_t count;
};

static void cut(struct pieces *pieces, const struct polygon *polygon, uint32_t parts, uint32_t triangle) {
    const struct bounds b = bounds_of(polygon);
    int axis = 0;
    for (int k = 1; k < 3; k++)
        if (b.upper[k] - b.lower[k] > b.upper[axis] - b.lower[axis])
            axis = k;
    struct polygon left, right;
    if (parts > 1) {
        const double middle = 0.5 * (b.lower[axis] + b.upper[axis]);
        clip(polygon, axis, middle, 1, &left);
        clip(polygon, axis, middle, -1, &right);
        if (left.count > 2 && right.count > 2) {
            cut(pieces, &left, parts - parts / 2, triangle);
            cut(pieces, &right, parts / 2, triangle);
            return;
        }
    }
    struct bvh_item *item = &pieces->items[pieces->count++];
    *item = (struct bvh_item){.index = triangle};
    for (int k = 0; k < 3; k++) {
        const double pad = 0x1p-18 * fmax(fabs(b.lower[k]), fabs(b.upper[k]));
        item->lower[k] = (float)(b.lower[k] - pad);
        item->upper[k] = (float)(b.upper[k] + pad);
    }
}

struct bvh_item *presplit(const struct bench_mesh *mesh, double extra, uint32_t *count) {
    const size_t most = (size_t)((1 + extra) * mesh->triangle_count) + 1;
    struct pieces pieces = {malloc(most * sizeof *pieces.items), 0};
    double sum = 0;
    if (!pieces.items)
        return NULL;
    for (uint32_t i = 0; i < mesh->triangle_count; i++)
        sum += priority_of(mesh, i);
    double owed = 0; // what of the shares so far was less than a cut
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        owed += sum > 0 ? priority_of(mesh, i) / sum * extra * mesh->triangle_count : 0;
        const struct polygon triangle = triangle_of(mesh, i);
        const uint32_t cuts = (uint32_t)fmin(owed, PIECES_MOST - 1);
        cut(&pieces, &triangle, 1 + cuts, i);
        owed -= cuts;
    }
    *count = pieces.count;
    return pieces.items;
}
