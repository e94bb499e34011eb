#include "assets/triangulate.h"

#include <math.h>
#include <string.h>

enum {
    EXPONENT_MAX = 1000, // of a power of two that is a double
    GRID_SIDE_MAX = 256,
    WORK_PER_CORNER = 1000, // point tests and grid cells, before corners are cut unchecked
};

struct triangulate_point {
    double x, y;
};

struct triangulate_link {
    uint32_t next, previous;
    bool is_gone;
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
};

void triangulate_init(struct triangulator *t, struct arena *arena) {
    *t = (struct triangulator){.arena = arena};
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
// 0 where all corners are one point.
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

// Drops the axis along which the polygon is seen largest; the result turns counter-clockwise.
static void project(const vec3 *corners, uint32_t n, double scale, vec3 normal,
                    struct triangulate_point *points) {
    double ax = fabs(normal.x), ay = fabs(normal.y), az = fabs(normal.z);
    int axis = ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2;
    double along = axis == 0 ? normal.x : axis == 1 ? normal.y : normal.z;
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

// Every corner turns left, and the boundary goes round once: along x it turns back twice only.
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

// ---- the grid of corners that are not convex: only these can lie in an ear

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

// Sorts the reflex corners into cells by counting. `first` holds a cell more than there are.
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
    // Filled from behind, so that the ends become the beginnings.
    for (uint32_t i = n; i > 0; i--)
        if (is_reflex(points, n, i - 1))
            items[--first[cell_of(&grid, points[i - 1])]] = i - 1;
    return grid;
}

// ---- ears

// How much is asked of a corner before it is cut: less from level to level, as rounds go by without a cut.
enum level {
    LEVEL_EMPTY, // nothing lies in the ear or on its rim
    LEVEL_FLAT,  // or its area is 0
    LEVEL_RIM,   // or others lie on its rim alone
    LEVEL_ANY,
};

// Whether the boundary through corner `k`, which stands where corner `i` does, leaves into the ear at i.
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

static bool is_clear(struct clipping *c, uint32_t i, enum level level) {
    const struct grid *g = &c->grid;
    struct triangulate_point a = c->points[c->links[i].previous];
    struct triangulate_point b = c->points[i];
    struct triangulate_point d = c->points[c->links[i].next];
    uint32_t left = cell_along(fmin(a.x, fmin(b.x, d.x)), g->x, g->per_x, g->side);
    uint32_t right = cell_along(fmax(a.x, fmax(b.x, d.x)), g->x, g->per_x, g->side);
    uint32_t low = cell_along(fmin(a.y, fmin(b.y, d.y)), g->y, g->per_y, g->side);
    uint32_t high = cell_along(fmax(a.y, fmax(b.y, d.y)), g->y, g->per_y, g->side);
    for (uint32_t y = low; y <= high; y++) {
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

static bool is_ear(struct clipping *c, uint32_t i, enum level level) {
    const struct triangulate_link *link = &c->links[i];
    struct triangulate_point b = c->points[i];
    if (level == LEVEL_ANY || c->work_left == 0 || same_point(b, c->points[link->next]) ||
        same_point(b, c->points[link->previous]))
        return true;
    double area = area2(c->points[link->previous], b, c->points[link->next]);
    if (area == 0)
        return level >= LEVEL_FLAT;
    return area > 0 && is_clear(c, i, level);
}

static uint32_t *cut(struct clipping *c, uint32_t i, uint32_t *out) {
    struct triangulate_link *link = &c->links[i];
    *out++ = link->previous;
    *out++ = i;
    *out++ = link->next;
    c->links[link->previous].next = link->next;
    c->links[link->next].previous = link->previous;
    link->is_gone = true;
    return out;
}

static void clip(struct clipping *c, uint32_t n, uint32_t *out) {
    uint32_t left = n;
    uint32_t i = 0;
    uint32_t idle = 0; // corners looked at since the last cut
    enum level level = LEVEL_EMPTY;
    while (left > 3) {
        if (is_ear(c, i, level)) {
            out = cut(c, i, out);
            left--;
            idle = 0;
            level = LEVEL_EMPTY;
            // Not the neighbour: taking turns keeps the triangles from becoming a fan of slivers.
            i = c->links[c->links[i].next].next;
        } else {
            i = c->links[i].next;
            if (++idle >= left) {
                idle = 0;
                level++;
            }
        }
    }
    cut(c, i, out);
}

static void reserve(struct triangulator *t, uint32_t n) {
    if (n <= t->capacity)
        return;
    t->capacity = n > 2 * t->capacity ? n : 2 * t->capacity;
    t->points = ARENA_ARRAY(t->arena, struct triangulate_point, t->capacity);
    t->links = ARENA_ARRAY(t->arena, struct triangulate_link, t->capacity);
    t->cell_items = ARENA_ARRAY(t->arena, uint32_t, t->capacity);
    if (!t->cell_first)
        t->cell_first = ARENA_ARRAY(t->arena, uint32_t, GRID_SIDE_MAX * GRID_SIDE_MAX + 1);
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
    struct clipping c = {.points = t->points,
                         .links = t->links,
                         .cell_first = t->cell_first,
                         .cell_items = t->cell_items,
                         .grid = fill_grid(t->points, n, t->cell_first, t->cell_items),
                         .work_left = (uint64_t)WORK_PER_CORNER * n};
    clip(&c, n, out);
}
