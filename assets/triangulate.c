#include "assets/triangulate.h"

#include "core/heap.h"

#include <math.h>
#include <string.h>

enum {
    EXPONENT_MAX = 1000, // of a power of two that is a double
    GRID_SIDE_MAX = 256,
    WORK_PER_CORNER = 1000, // point tests and grid cells per corner, before corners are cut unchecked
};

#define ROUNDING_MARGIN 0x1p-40
#define WORK_ALL        (UINT64_C(1) << 32) // for all polygons of one triangulator: some ten seconds

struct triangulate_point {
    double x, y;
};

struct triangulate_link {
    uint32_t next, previous;
    bool is_gone, is_queued, is_deferred;
};

struct grid {
    double x, y;         // lower corner
    double per_x, per_y; // cells per unit
    uint32_t side;       // cells along each axis
};

struct clipping {
    const struct triangulate_point *points;
    struct triangulate_link *links;
    const uint32_t *cell_first;
    const uint32_t *cell_items;
    struct grid grid;
    uint64_t work_left;
    uint32_t left;   // corners not cut yet
    uint32_t *out;   // of the next triangle
    uint32_t *queue; // a ring; each corner is in it at most once
    uint32_t queue_size, queue_head, queue_count;
};

void triangulate_init(struct triangulator *t, struct arena *arena) {
    *t = (struct triangulator){.arena = arena, .work_left = WORK_ALL};
}

static void fan(uint32_t n, uint32_t *out) {
    for (uint32_t i = 1; i + 1 < n; i++) {
        *out++ = 0;
        *out++ = i;
        *out++ = i + 1;
    }
}

// A quadrilateral is cut from the corner that is not convex, if there is one; else from its first.
static void quadrilateral(const vec3 *p, uint32_t *out) {
    vec3 normal = vec3_cross(vec3_sub(p[2], p[0]), vec3_sub(p[3], p[1]));
    double turn[4];
    for (int i = 0; i < 4; i++) {
        vec3 in = vec3_sub(p[i], p[(i + 3) % 4]);
        vec3 on = vec3_sub(p[(i + 1) % 4], p[i]);
        turn[i] = vec3_dot(vec3_cross(in, on), normal);
    }
    double even = fmin(turn[0], turn[2]);
    double odd = fmin(turn[1], turn[3]);
    bool from_odd = odd <= 0 && odd < even;
    static const uint32_t cuts[2][6] = {{0, 1, 2, 0, 2, 3}, {1, 2, 3, 1, 3, 0}};
    memcpy(out, cuts[from_odd], sizeof cuts[0]);
}

// The power of two that brings the polygon's extent near 1, so that no product leaves the range of a double;
// 0 if all corners are one point.
static double polygon_scale(const vec3 *corners, uint32_t n) {
    double largest = 0;
    for (uint32_t i = 1; i < n; i++)
        largest = fmax(largest, vec3_max_abs(vec3_sub(corners[i], corners[0])));
    if (!(largest > 0) || !isfinite(largest))
        return 0;
    int exponent = -ilogb(largest);
    return scalbn(1, exponent < EXPONENT_MAX ? exponent : EXPONENT_MAX);
}

static vec3 newell_normal(const vec3 *corners, uint32_t n, double scale) {
    vec3 sum = {0, 0, 0};
    for (uint32_t i = 1; i + 1 < n; i++) {
        vec3 a = vec3_mul(vec3_sub(corners[i], corners[0]), scale);
        vec3 b = vec3_mul(vec3_sub(corners[i + 1], corners[0]), scale);
        sum = vec3_add(sum, vec3_cross(a, b));
    }
    return sum;
}

// Drops the axis along which the polygon looks largest; the result turns counter-clockwise.
static void project(const vec3 *corners, uint32_t n, double scale, vec3 normal,
                    struct triangulate_point *points) {
    double ax = fabs(normal.x), ay = fabs(normal.y), az = fabs(normal.z);
    int axis = ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2;
    double along = vec3_along(normal, axis);
    for (uint32_t i = 0; i < n; i++) {
        vec3 p = vec3_mul(vec3_sub(corners[i], corners[0]), scale);
        double u = axis == 0 ? p.y : axis == 1 ? p.z : p.x;
        double v = axis == 0 ? p.z : axis == 1 ? p.x : p.y;
        points[i] = along > 0 ? (struct triangulate_point){u, v} : (struct triangulate_point){v, u};
    }
}

// Twice the signed area.
static double area2(struct triangulate_point a, struct triangulate_point b, struct triangulate_point c) {
    return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

static bool same_point(struct triangulate_point a, struct triangulate_point b) {
    return a.x == b.x && a.y == b.y;
}

// Every corner turns left, and the boundary goes round once: along x it turns back only twice.
static bool is_convex(const struct triangulate_point *p, uint32_t n) {
    int reversals = 0;
    double last = 0;
    double first = 0;
    for (uint32_t i = 0; i < n; i++) {
        const struct triangulate_point *b = &p[i + 1 == n ? 0 : i + 1];
        const struct triangulate_point *c = &p[i + 2 >= n ? i + 2 - n : i + 2];
        if (!(area2(p[i], *b, *c) > 0))
            return false;
        double step = b->x - p[i].x;
        if (step == 0)
            continue;
        reversals += last != 0 && (step > 0) != (last > 0);
        first = first == 0 ? step : first;
        last = step;
    }
    reversals += (first > 0) != (last > 0);
    return reversals <= 2;
}

// ---- the grid of corners that are not convex: only these can be in an ear

static uint32_t cell_along(double value, double origin, double per_unit, uint32_t side) {
    double cell = (value - origin) * per_unit;
    return !(cell > 0) ? 0 : cell >= side ? side - 1 : (uint32_t)cell;
}

static uint32_t cell_of(const struct grid *grid, struct triangulate_point p) {
    return cell_along(p.y, grid->y, grid->per_y, grid->side) * grid->side +
           cell_along(p.x, grid->x, grid->per_x, grid->side);
}

static struct grid grid_over(const struct triangulate_point *points, uint32_t n, uint32_t reflex_count) {
    struct triangulate_point low = points[0];
    struct triangulate_point high = points[0];
    for (uint32_t i = 1; i < n; i++) {
        low = (struct triangulate_point){fmin(low.x, points[i].x), fmin(low.y, points[i].y)};
        high = (struct triangulate_point){fmax(high.x, points[i].x), fmax(high.y, points[i].y)};
    }
    uint32_t side = 1 + (uint32_t)sqrt((double)reflex_count / 2);
    side = side < GRID_SIDE_MAX ? side : GRID_SIDE_MAX;
    double width = high.x - low.x;
    double height = high.y - low.y;
    return (struct grid){low.x, low.y, width > 0 ? side / width : 0, height > 0 ? side / height : 0, side};
}

static bool is_reflex(const struct triangulate_point *p, uint32_t n, uint32_t i) {
    return !(area2(p[i == 0 ? n - 1 : i - 1], p[i], p[i + 1 == n ? 0 : i + 1]) > 0);
}

// Sorts the reflex corners into cells by counting. `first` holds one cell more than there are.
static struct grid fill_grid(const struct triangulate_point *points, uint32_t n, uint32_t *first,
                             uint32_t *items) {
    uint32_t reflex_count = 0;
    for (uint32_t i = 0; i < n; i++)
        reflex_count += is_reflex(points, n, i);
    struct grid grid = grid_over(points, n, reflex_count);
    uint32_t cells = grid.side * grid.side;
    memset(first, 0, (cells + 1) * sizeof *first);
    for (uint32_t i = 0; i < n; i++)
        if (is_reflex(points, n, i))
            first[cell_of(&grid, points[i])]++;
    uint32_t sum = 0;
    for (uint32_t c = 0; c <= cells; c++) {
        sum += c < cells ? first[c] : 0;
        first[c] = sum;
    }
    // Filled backwards, so that the ends become the beginnings.
    for (uint32_t i = n; i > 0; i--)
        if (is_reflex(points, n, i - 1))
            items[--first[cell_of(&grid, points[i - 1])]] = i - 1;
    return grid;
}

// ---- ears

// The conditions for cutting a corner: fewer from level to level, as rounds pass without a cut.
enum level {
    LEVEL_EMPTY, // nothing is in the ear or on its rim
    LEVEL_FLAT,  // or its area is 0
    LEVEL_RIM,   // or others are only on its rim
    LEVEL_ANY,
};

// Whether the boundary through corner `k`, at the same position as corner `i`, continues into the ear at i.
static bool enters_ear(const struct clipping *c, uint32_t k, uint32_t i) {
    const struct triangulate_point *p = c->points;
    struct triangulate_point before = p[c->links[i].previous], at = p[i], after = p[c->links[i].next];
    struct triangulate_point ends[2] = {p[c->links[k].previous], p[c->links[k].next]};
    for (int e = 0; e < 2; e++)
        if (area2(before, at, ends[e]) > 0 && area2(at, after, ends[e]) > 0)
            return true;
    return false;
}

static bool blocks_ear(const struct clipping *c, uint32_t k, uint32_t i, enum level level) {
    struct triangulate_point a = c->points[c->links[i].previous];
    struct triangulate_point b = c->points[i];
    struct triangulate_point d = c->points[c->links[i].next];
    struct triangulate_point q = c->points[k];
    if (c->links[k].is_gone || k == i || same_point(q, a) || same_point(q, d))
        return false;
    if (same_point(q, b))
        return enters_ear(c, k, i);
    double u = area2(a, b, q), v = area2(b, d, q), w = area2(d, a, q);
    return level < LEVEL_RIM ? u >= 0 && v >= 0 && w >= 0 : u > 0 && v > 0 && w > 0;
}

// Widens lower..upper by the part of the edge a-b between the heights y0 and y1.
static void widen(struct triangulate_point a, struct triangulate_point b, double y0, double y1, double *lower,
                  double *upper) {
    if (a.y > b.y) {
        struct triangulate_point swap = a;
        a = b;
        b = swap;
    }
    if (b.y < y0 || a.y > y1)
        return;
    double slope = b.y > a.y ? (b.x - a.x) / (b.y - a.y) : 0;
    double from = a.y >= y0 ? a.x : a.x + (y0 - a.y) * slope;
    double to = b.y <= y1 ? b.x : a.x + (y1 - a.y) * slope;
    *lower = fmin(*lower, fmin(from, to));
    *upper = fmax(*upper, fmax(from, to));
}

// The grid is searched row by row, only where the triangle is: ears can be long and thin.
static bool is_clear(struct clipping *c, uint32_t i, enum level level) {
    const struct grid *g = &c->grid;
    struct triangulate_point a = c->points[c->links[i].previous];
    struct triangulate_point b = c->points[i];
    struct triangulate_point d = c->points[c->links[i].next];
    uint32_t low = cell_along(fmin(a.y, fmin(b.y, d.y)), g->y, g->per_y, g->side);
    uint32_t high = cell_along(fmax(a.y, fmax(b.y, d.y)), g->y, g->per_y, g->side);
    for (uint32_t y = low; y <= high; y++) {
        // Coordinates are near 1: the margin is larger than rounding and does not matter.
        double y0 = y == 0 ? -INFINITY : g->y + y / g->per_y - ROUNDING_MARGIN;
        double y1 = y + 1 == g->side ? INFINITY : g->y + (y + 1) / g->per_y + ROUNDING_MARGIN;
        double lower = INFINITY;
        double upper = -INFINITY;
        widen(a, b, y0, y1, &lower, &upper);
        widen(b, d, y0, y1, &lower, &upper);
        widen(d, a, y0, y1, &lower, &upper);
        uint32_t left = cell_along(lower - ROUNDING_MARGIN, g->x, g->per_x, g->side);
        uint32_t right = cell_along(upper + ROUNDING_MARGIN, g->x, g->per_x, g->side);
        uint32_t begin = c->cell_first[y * g->side + left];
        uint32_t end = c->cell_first[y * g->side + right + 1];
        uint64_t work = (uint64_t)(end - begin) + 1;
        c->work_left -= work < c->work_left ? work : c->work_left;
        for (uint32_t at = begin; at < end; at++)
            if (blocks_ear(c, c->cell_items[at], i, level))
                return false;
    }
    return true;
}

// A corner that adds nothing: it repeats a neighbour's position, or the boundary turns straight back.
static bool is_spike(const struct clipping *c, uint32_t i) {
    struct triangulate_point a = c->points[c->links[i].previous];
    struct triangulate_point b = c->points[i];
    struct triangulate_point d = c->points[c->links[i].next];
    return same_point(a, b) || same_point(b, d) || same_point(a, d);
}

static bool is_ear(struct clipping *c, uint32_t i, enum level level) {
    const struct triangulate_link *link = &c->links[i];
    if (level == LEVEL_ANY || c->work_left == 0)
        return true;
    double area = area2(c->points[link->previous], c->points[i], c->points[link->next]);
    if (area == 0)
        return level >= LEVEL_FLAT;
    return area > 0 && is_clear(c, i, level);
}

static void cut(struct clipping *c, uint32_t i) {
    struct triangulate_link *link = &c->links[i];
    *c->out++ = link->previous;
    *c->out++ = i;
    *c->out++ = link->next;
    c->links[link->previous].next = link->next;
    c->links[link->next].previous = link->previous;
    link->is_gone = true;
    c->left--;
}

// ---- corners that wait to be checked
//
// Cutting an ear (of a simple polygon) changes the kind of its two neighbours and nothing else, so each
// corner is checked once, and again when a neighbour is cut.

static void enqueue(struct clipping *c, uint32_t i) {
    if (c->links[i].is_queued || c->links[i].is_gone)
        return;
    c->links[i].is_queued = true;
    c->queue[(c->queue_head + c->queue_count) % c->queue_size] = i;
    c->queue_count++;
}

static uint32_t dequeue(struct clipping *c) {
    uint32_t i = c->queue[c->queue_head];
    c->queue_head = (c->queue_head + 1) % c->queue_size;
    c->queue_count--;
    c->links[i].is_queued = false;
    return i;
}

static void enqueue_all(struct clipping *c, uint32_t from) {
    uint32_t i = from;
    do {
        enqueue(c, i);
        i = c->links[i].next;
    } while (i != from);
    c->work_left -= c->left < c->work_left ? c->left : c->work_left;
}

// Cuts a corner, and neighbours that thereby become spikes: if kept, they would be mistaken for the other
// side of the boundary. Returns a corner that remains.
static uint32_t cut_with_spikes(struct clipping *c, uint32_t i) {
    cut(c, i);
    uint32_t before = c->links[i].previous;
    uint32_t after = c->links[i].next;
    while (c->left > 3 && (is_spike(c, before) || is_spike(c, after))) {
        if (is_spike(c, before)) {
            cut(c, before);
            before = c->links[before].previous;
        } else {
            cut(c, after);
            after = c->links[after].next;
        }
    }
    enqueue(c, before);
    enqueue(c, after);
    // Its turn comes later: cutting neighbours one after another would make a fan of slivers.
    c->links[after].is_deferred = true;
    return after;
}

static void clip(struct clipping *c) {
    uint32_t last = 0; // a corner that is left
    enum level level = LEVEL_EMPTY;
    for (uint32_t i = 0; i < c->queue_size && c->left > 3; i++)
        if (!c->links[i].is_gone && is_spike(c, i))
            last = cut_with_spikes(c, i);
    enqueue_all(c, last);
    while (c->left > 3) {
        if (c->queue_count == 0) {
            level++;
            enqueue_all(c, last);
        }
        uint32_t i = dequeue(c);
        if (c->links[i].is_gone)
            continue;
        if (c->links[i].is_deferred) {
            c->links[i].is_deferred = false;
            enqueue(c, i);
        } else if (is_spike(c, i) || is_ear(c, i, level)) {
            last = cut_with_spikes(c, i);
            level = LEVEL_EMPTY;
        }
    }
    cut(c, last);
}

static void reserve(struct triangulator *t, uint32_t n) {
    if (n <= t->capacity)
        return;
    t->capacity = n > 2 * t->capacity ? n : 2 * t->capacity;
    t->points = ARENA_ARRAY(t->arena, struct triangulate_point, t->capacity);
    t->links = ARENA_ARRAY(t->arena, struct triangulate_link, t->capacity);
    t->cell_items = ARENA_ARRAY(t->arena, uint32_t, t->capacity);
    t->queue = ARENA_ARRAY(t->arena, uint32_t, t->capacity);
    if (!t->cell_first)
        t->cell_first = ARENA_ARRAY(t->arena, uint32_t, heap_times(GRID_SIDE_MAX, GRID_SIDE_MAX) + 1);
}

void triangulate(struct triangulator *t, const vec3 *corners, uint32_t n, uint32_t *out) {
    if (n == 4) {
        quadrilateral(corners, out);
        return;
    }
    double scale = n > 4 ? polygon_scale(corners, n) : 0;
    vec3 normal = newell_normal(corners, n, scale);
    if (vec3_is_zero(normal)) {
        fan(n, out);
        return;
    }
    reserve(t, n);
    project(corners, n, scale, normal, t->points);
    if (is_convex(t->points, n)) {
        fan(n, out);
        return;
    }
    for (uint32_t i = 0; i < n; i++)
        t->links[i] =
            (struct triangulate_link){.next = i + 1 == n ? 0 : i + 1, .previous = i == 0 ? n - 1 : i - 1};
    uint64_t budget = (uint64_t)WORK_PER_CORNER * n;
    budget = budget < t->work_left ? budget : t->work_left;
    struct clipping c = {.points = t->points,
                         .links = t->links,
                         .cell_first = t->cell_first,
                         .cell_items = t->cell_items,
                         .grid = fill_grid(t->points, n, t->cell_first, t->cell_items),
                         .work_left = budget,
                         .left = n,
                         .out = out,
                         .queue = t->queue,
                         .queue_size = n};
    clip(&c);
    t->work_left -= budget - c.work_left;
}
