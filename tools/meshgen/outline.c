#include "tools/meshgen/outline.h"

#include "core/angle.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

static const double ARC_STEP_DEG = 6;

// The polygon that ear clipping eats: a ring of point indices, a point that carries a bridge twice.
struct ring {
    int index[OUTLINE_POINTS_MAX + 2 * OUTLINE_CONTOURS_MAX];
    int count;
    vec2 points[OUTLINE_POINTS_MAX];
};

void outline_init(struct outline *outline) {
    memset(outline, 0, sizeof *outline);
}

static int *open_end(struct outline *outline) {
    return &outline->starts[outline->contour_count + 1];
}

static double distance(vec2 a, vec2 b) {
    return hypot(a.x - b.x, a.y - b.y);
}

void outline_point(struct outline *outline, double x, double y) {
    int start = outline->starts[outline->contour_count], *end = open_end(outline);
    vec2 point = {x, y};
    if (*end < start)
        *end = start;
    if (*end > start && distance(outline->points[*end - 1], point) < 1e-6)
        return;
    assert(*end < OUTLINE_POINTS_MAX);
    outline->points[(*end)++] = point;
}

void outline_arc(struct outline *outline, vec2 centre, double radius, double from_deg, double to_deg) {
    int steps = (int)ceil(fabs(to_deg - from_deg) / ARC_STEP_DEG - 1e-9);
    for (int i = 0; i <= steps; i++) {
        double angle = (from_deg + (to_deg - from_deg) * i / steps) * PI / 180;
        outline_point(outline, centre.x + radius * cos(angle), centre.y + radius * sin(angle));
    }
}

void outline_close(struct outline *outline) {
    int start = outline->starts[outline->contour_count], *end = open_end(outline);
    assert(outline->contour_count < OUTLINE_CONTOURS_MAX - 1);
    if (distance(outline->points[start], outline->points[*end - 1]) < 1e-6)
        --*end;
    outline->contour_count++;
}

static int contour_of(const struct outline *outline, int i) {
    int contour = 0;
    while (i >= outline->starts[contour + 1])
        contour++;
    return contour;
}

int outline_next(const struct outline *outline, int i) {
    int contour = contour_of(outline, i);
    return i + 1 < outline->starts[contour + 1] ? i + 1 : outline->starts[contour];
}

int outline_previous(const struct outline *outline, int i) {
    int contour = contour_of(outline, i);
    return i > outline->starts[contour] ? i - 1 : outline->starts[contour + 1] - 1;
}

vec2 outline_edge_normal(const struct outline *outline, int i) {
    vec2 a = outline->points[i], b = outline->points[outline_next(outline, i)];
    double length = distance(a, b);
    return (vec2){(b.y - a.y) / length, (a.x - b.x) / length};
}

vec2 outline_inset_direction(const struct outline *outline, int i) {
    vec2 m = outline_edge_normal(outline, outline_previous(outline, i)), n = outline_edge_normal(outline, i);
    double scale = -1 / (1 + m.x * n.x + m.y * n.y);
    return (vec2){scale * (m.x + n.x), scale * (m.y + n.y)};
}

// Twice the signed area of a, b, c.
static double turn(vec2 a, vec2 b, vec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

static bool bridge_is_free(const struct outline *outline, const struct ring *ring, int from, int to) {
    vec2 a = ring->points[from], b = ring->points[to];
    for (int i = 0; i < outline->starts[outline->contour_count]; i++) {
        int j = outline_next(outline, i);
        vec2 c = ring->points[i], d = ring->points[j];
        if (i == from || i == to || j == from || j == to)
            continue;
        if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0)
            return false;
    }
    return true;
}

// Splices the hole into the ring where a bridge is shortest.
static bool join_hole(const struct outline *outline, struct ring *ring, int contour) {
    int first = outline->starts[contour], count = outline->starts[contour + 1] - first;
    int best_at = -1, best_hole = -1;
    double best = INFINITY;
    for (int i = 0; i < ring->count; i++) {
        for (int j = first; j < first + count; j++) {
            double length = distance(ring->points[ring->index[i]], ring->points[j]);
            if (length < best && bridge_is_free(outline, ring, ring->index[i], j)) {
                best = length;
                best_at = i;
                best_hole = j;
            }
        }
    }
    if (best_at < 0)
        return false;
    int tail = ring->count - best_at;
    memmove(&ring->index[best_at + count + 2], &ring->index[best_at], (size_t)tail * sizeof *ring->index);
    for (int k = 0; k <= count; k++)
        ring->index[best_at + 1 + k] = first + (best_hole - first + k) % count;
    ring->count += count + 2;
    return true;
}

static bool holds_a_point(const struct ring *ring, vec2 a, vec2 b, vec2 c) {
    for (int i = 0; i < ring->count; i++) {
        vec2 p = ring->points[ring->index[i]];
        bool corner = distance(p, a) < 1e-9 || distance(p, b) < 1e-9 || distance(p, c) < 1e-9;
        if (!corner && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0)
            return true;
    }
    return false;
}

// The ear with the shortest cut, so that the triangles stay as round as the shape lets them; -1: none.
static int best_ear(const struct ring *ring) {
    int best = -1;
    double shortest = INFINITY;
    for (int i = 0; i < ring->count; i++) {
        vec2 a = ring->points[ring->index[(i + ring->count - 1) % ring->count]],
             b = ring->points[ring->index[i]];
        vec2 c = ring->points[ring->index[(i + 1) % ring->count]];
        double length = distance(a, c);
        if (length < shortest && turn(a, b, c) > 1e-8 && !holds_a_point(ring, a, b, c)) {
            shortest = length;
            best = i;
        }
    }
    return best;
}

int outline_triangulate(const struct outline *outline, double inset, int triangles[][3]) {
    struct ring ring = {.count = outline->starts[1]};
    int count = 0;
    for (int i = 0; i < outline->starts[outline->contour_count]; i++) {
        vec2 inward = outline_inset_direction(outline, i);
        ring.points[i] =
            (vec2){outline->points[i].x + inset * inward.x, outline->points[i].y + inset * inward.y};
    }
    for (int i = 0; i < ring.count; i++)
        ring.index[i] = i;
    for (int contour = 1; contour < outline->contour_count; contour++)
        if (!join_hole(outline, &ring, contour))
            return -1;
    while (ring.count >= 3) {
        int ear = best_ear(&ring);
        if (ear < 0)
            return -1;
        triangles[count][0] = ring.index[(ear + ring.count - 1) % ring.count];
        triangles[count][1] = ring.index[ear];
        triangles[count][2] = ring.index[(ear + 1) % ring.count];
        count++;
        ring.count--;
        memmove(&ring.index[ear], &ring.index[ear + 1], (size_t)(ring.count - ear) * sizeof *ring.index);
    }
    return count;
}
