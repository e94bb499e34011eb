#include "tools/meshgen/stroke.h"

#include "core/angle.h"
#include "tools/meshgen/outline.h"

#include <math.h>
#include <stdlib.h>

enum {
    PIECES_MAX = 32,
};

static const double QUARTER = 0.58;  // of the way to the corner: a little squarer than an ellipse (0.55)
static const double SMOOTH = 0.05;   // radians: pieces that turn less have no corner between them
static const double CURVE_STEP = 30; // degrees of a curve that one quadratic piece follows
static const double ROUND_STEP = 60; // of the pen's circle

struct piece {
    vec2 at[4];
    bool is_line;
};

struct chain {
    struct piece pieces[PIECES_MAX];
    int count;
    bool is_closed, flat_start, flat_end;
};

// ---- vectors

static vec2 add(vec2 a, vec2 b, double s) {
    return (vec2){a.x + s * b.x, a.y + s * b.y};
}

static vec2 unit(vec2 from, vec2 to) {
    const double length = hypot(to.x - from.x, to.y - from.y);
    return (vec2){(to.x - from.x) / length, (to.y - from.y) / length};
}

static vec2 left_of(vec2 t) {
    return (vec2){-t.y, t.x};
}

static double cross(vec2 a, vec2 b) {
    return a.x * b.y - a.y * b.x;
}

static double turn(vec2 a, vec2 b) {
    return atan2(cross(a, b), a.x * b.x + a.y * b.y);
}

// Where the line from a along s meets the line from b along t; their middle if they are parallel.
static vec2 meet(vec2 a, vec2 s, vec2 b, vec2 t) {
    const double by = cross(s, t);
    if (fabs(by) < 0.02)
        return (vec2){(a.x + b.x) / 2, (a.y + b.y) / 2};
    return add(a, s, cross((vec2){b.x - a.x, b.y - a.y}, t) / by);
}

// ---- points of the contour

static void put(struct glyph *glyph, vec2 at, bool on) {
    const struct glyph_point point = {(int)lround(at.x), (int)lround(at.y), on};
    const int first = glyph->contour_count > 0 ? glyph->ends[glyph->contour_count - 1] + 1 : 0;
    if (glyph->point_count > first) {
        const struct glyph_point *last = &glyph->points[glyph->point_count - 1];
        if (last->x == point.x && last->y == point.y && last->on && on)
            return;
    }
    if (glyph->point_count == GLYPH_POINTS_MAX)
        abort();
    glyph->points[glyph->point_count++] = point;
}

static void end_contour(struct glyph *glyph) {
    const int first = glyph->contour_count > 0 ? glyph->ends[glyph->contour_count - 1] + 1 : 0;
    struct glyph_point *points = glyph->points;
    const struct glyph_point begin = points[first], *last = &points[glyph->point_count - 1];
    if (glyph->contour_count == GLYPH_CONTOURS_MAX)
        abort();
    if (!begin.on) { // closed strokes begin with a control point
        for (int i = first; i + 1 < glyph->point_count; i++)
            points[i] = points[i + 1];
        points[glyph->point_count - 1] = begin;
    } else if (last->on && last->x == begin.x && last->y == begin.y) {
        glyph->point_count--;
    }
    glyph->ends[glyph->contour_count++] = glyph->point_count - 1;
}

// Clockwise round the centre, from the direction n by an angle in radians.
static void put_round(struct glyph *glyph, vec2 centre, double radius, vec2 n, double angle) {
    const int steps = (int)ceil(angle / (ROUND_STEP * RADIANS) - 1e-6);
    const double step = angle / steps, from = atan2(n.y, n.x);
    for (int i = 1; i <= steps; i++) {
        const double end = from - i * step, middle = end + step / 2;
        const vec2 control = {cos(middle), sin(middle)}, to = {cos(end), sin(end)};
        put(glyph, add(centre, control, radius / cos(step / 2)), false);
        put(glyph, add(centre, to, radius), true);
    }
}

// ---- pieces

static vec2 place_on(const struct piece *piece, double t) {
    const double u = 1 - t, w[4] = {u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t};
    vec2 sum = {0, 0};
    for (int i = 0; i < 4; i++)
        sum = add(sum, piece->at[i], w[i]);
    return sum;
}

static vec2 direction_on(const struct piece *piece, double t) {
    const double u = 1 - t, w[3] = {u * u, 2 * u * t, t * t};
    vec2 sum = {0, 0};
    for (int i = 0; i < 3; i++)
        sum = add(sum, add(piece->at[i + 1], piece->at[i], -1), w[i]);
    return unit((vec2){0, 0}, sum);
}

static vec2 beside(const struct piece *piece, double t) {
    return add(place_on(piece, t), left_of(direction_on(piece, t)), STROKE_RADIUS);
}

static void put_curve(struct glyph *glyph, const struct piece *piece) {
    const int samples = 16;
    double turned = 0;
    for (int i = 0; i < samples; i++)
        turned +=
            fabs(turn(direction_on(piece, (double)i / samples), direction_on(piece, (i + 1.0) / samples)));
    const int steps = (int)fmax(2, ceil(turned / (CURVE_STEP * RADIANS) - 1e-6));
    for (int i = 0; i < steps; i++) {
        const double from = (double)i / steps, to = (i + 1.0) / steps;
        put(glyph,
            meet(beside(piece, from), direction_on(piece, from), beside(piece, to), direction_on(piece, to)),
            false);
        put(glyph, beside(piece, to), true);
    }
}

// The end of a piece on its left, and the way round the corner to the next one.
static void put_end(struct glyph *glyph, const struct piece *piece, const struct piece *next) {
    const vec2 s = direction_on(piece, 1), end = beside(piece, 1);
    const double angle = next ? turn(s, direction_on(next, 0)) : 0;
    if (angle > SMOOTH && piece->is_line && next->is_line) {
        put(glyph, meet(end, s, beside(next, 0), direction_on(next, 0)), true);
        return;
    }
    if (piece->is_line)
        put(glyph, end, true);
    if (angle < -SMOOTH)
        put_round(glyph, piece->at[3], STROKE_RADIUS, left_of(s), -angle);
    if (angle > SMOOTH) { // both sides end inside the stroke: by way of its middle they go round the same way
        put(glyph, piece->at[3], true);
        put(glyph, beside(next, 0), true);
    }
}

static void put_left(struct glyph *glyph, const struct chain *chain) {
    if (!chain->is_closed)
        put(glyph, beside(&chain->pieces[0], 0), true);
    for (int i = 0; i < chain->count; i++) {
        const struct piece *piece = &chain->pieces[i];
        const bool is_last = i + 1 == chain->count;
        if (!piece->is_line)
            put_curve(glyph, piece);
        put_end(glyph, piece, !is_last ? piece + 1 : chain->is_closed ? chain->pieces : NULL);
    }
    const struct piece *last = &chain->pieces[chain->count - 1];
    if (!chain->is_closed && !chain->flat_end)
        put_round(glyph, last->at[3], STROKE_RADIUS, left_of(direction_on(last, 1)), PI);
}

static void reverse(struct chain *chain) {
    const struct chain from = *chain;
    chain->flat_start = from.flat_end;
    chain->flat_end = from.flat_start;
    for (int i = 0; i < chain->count; i++)
        for (int k = 0; k < 4; k++) {
            chain->pieces[i].at[k] = from.pieces[chain->count - 1 - i].at[3 - k];
            chain->pieces[i].is_line = from.pieces[chain->count - 1 - i].is_line;
        }
}

static void put_chain(struct glyph *glyph, struct chain *chain, vec2 start) {
    if (chain->count == 0) {
        put_round(glyph, start, STROKE_DOT, (vec2){-1, 0}, 2 * PI);
        end_contour(glyph);
        return;
    }
    put_left(glyph, chain);
    if (chain->is_closed)
        end_contour(glyph);
    reverse(chain);
    put_left(glyph, chain);
    end_contour(glyph);
}

// ---- the text

static vec2 read_point(const char **text) {
    char *end;
    vec2 at;
    at.x = strtod(*text, &end);
    at.y = strtod(end, &end);
    *text = end;
    return at;
}

static void add_piece(struct chain *chain, vec2 from, const vec2 *to, char kind) {
    if (chain->count == PIECES_MAX)
        abort();
    struct piece *piece = &chain->pieces[chain->count++];
    const vec2 end = kind == 'C' ? to[2] : to[0];
    const vec2 corner = kind == 'h' ? (vec2){end.x, from.y} : (vec2){from.x, end.y};
    piece->is_line = kind == 'L';
    piece->at[0] = from;
    piece->at[3] = end;
    for (int i = 1; i < 3; i++) {
        const vec2 near = i == 1 ? from : end;
        piece->at[i] = kind == 'C'   ? to[i - 1]
                       : kind == 'L' ? add(from, add(end, from, -1), i / 3.0)
                                     : add(near, add(corner, near, -1), QUARTER);
    }
}

// From the M, after the mark of a flat start, to the next stroke.
static const char *read_chain(const char *text, struct chain *chain, vec2 *start) {
    vec2 at = *start;
    while (*text && *text != 'M') {
        const char kind = *text++;
        vec2 to[3];
        if (kind == ' ')
            continue;
        if (kind == '|') {
            if (*text == 'M')
                return text - 1;
            chain->flat_end = true;
            continue;
        }
        chain->is_closed |= kind == 'z';
        for (int i = 0; kind != 'z' && i < (kind == 'C' ? 3 : 1); i++)
            to[i] = read_point(&text);
        if (kind == 'z')
            to[0] = *start;
        if (kind != 'z' || fabs(at.x - to[0].x) + fabs(at.y - to[0].y) > 0)
            add_piece(chain, at, to, kind == 'z' ? 'L' : kind);
        at = chain->pieces[chain->count - 1].at[3];
    }
    return text;
}

void stroke_glyph(const char *strokes, struct glyph *glyph) {
    *glyph = (struct glyph){.point_count = 0};
    while (*strokes) {
        struct chain chain = {.count = 0};
        for (; *strokes != 'M'; strokes++)
            chain.flat_start |= *strokes == '|';
        strokes++;
        vec2 start = read_point(&strokes);
        strokes = read_chain(strokes, &chain, &start);
        put_chain(glyph, &chain, start);
    }
    for (int i = 0; i < glyph->point_count; i++) {
        const struct glyph_point *point = &glyph->points[i];
        if (i == 0 || point->x < glyph->left)
            glyph->left = point->x;
        if (i == 0 || point->x > glyph->right)
            glyph->right = point->x;
        if (i == 0 || point->y < glyph->bottom)
            glyph->bottom = point->y;
        if (i == 0 || point->y > glyph->top)
            glyph->top = point->y;
    }
}

void glyph_move(struct glyph *glyph, int dx) {
    for (int i = 0; i < glyph->point_count; i++)
        glyph->points[i].x += dx;
    glyph->left += dx;
    glyph->right += dx;
}
