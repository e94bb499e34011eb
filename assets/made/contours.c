#include "assets/made/contours.h"

struct pen {
    struct path *path;
    struct arena *arena;
    double tolerance;
    struct ir_pair at;
    struct ir_pair control[2];
    uint32_t control_count;
    enum font_point_kind kind; // of the control points
};

static bool draw_to(struct pen *pen, struct ir_pair to) {
    struct ir_pair b[4] = {pen->at, pen->control[0], pen->control[1], to};
    const uint32_t controls = pen->control_count;
    pen->control_count = 0;
    pen->at = to;
    if (controls == 0)
        return path_add_line(pen->path, pen->arena, b[0], to, 0);
    if (pen->kind == FONT_CONIC) {
        b[2] = plane_mix(to, b[1], 2.0 / 3);
        b[1] = plane_mix(b[0], b[1], 2.0 / 3);
    }
    return (pen->kind == FONT_CONIC || controls == 2) &&
           path_add_cubic(pen->path, pen->arena, b, pen->tolerance, 0);
}

static bool take(struct pen *pen, const struct font_point *point) {
    if (point->kind == FONT_ON)
        return draw_to(pen, point->at);
    if (pen->control_count > 0 && pen->kind != point->kind)
        return false;
    if (point->kind == FONT_CONIC && pen->control_count == 1 &&
        !draw_to(pen, plane_mix(pen->control[0], point->at, 0.5)))
        return false;
    if (pen->control_count == 2)
        return false;
    pen->kind = point->kind;
    pen->control[pen->control_count++] = point->at;
    return true;
}

// A point on the contour to begin at, after which `*first` comes: its own, or one between two control points.
static bool find_start(const struct font_point *points, uint32_t count, uint32_t *first,
                       struct ir_pair *start) {
    for (uint32_t i = 0; i < count; i++) {
        *first = i + 1;
        *start = points[i].at;
        if (points[i].kind == FONT_ON)
            return true;
    }
    *first = 0;
    *start = plane_mix(points[count - 1].at, points[0].at, 0.5);
    return points[0].kind == FONT_CONIC;
}

static bool draw(struct pen *pen, const struct font_point *points, uint32_t count) {
    uint32_t first;
    struct ir_pair start;
    if (!find_start(points, count, &first, &start))
        return false;
    pen->at = start;
    for (uint32_t i = 0; i < (first ? count - 1 : count); i++)
        if (!take(pen, &points[(first + i) % count]))
            return false;
    return draw_to(pen, start);
}

bool contours_add(struct contours *contours, const struct font_outline *outline, double tolerance,
                  struct arena *arena) {
    uint32_t begin = 0;
    for (uint32_t i = 0; i < outline->contour_count; i++) {
        const uint32_t count = outline->ends[i] + 1 - begin;
        struct path path = {0};
        struct pen pen = {.path = &path, .arena = arena, .tolerance = tolerance};
        if (count >= 3 && !draw(&pen, outline->points + begin, count))
            return false;
        if (path.count >= 2)
            *ARENA_PUSH(arena, contours) = path;
        begin = outline->ends[i] + 1;
    }
    return true;
}
