#include "core/angle.h"
#include "tools/meshgen/extrude.h"
#include "tools/meshgen/generators.h"

// Letters of our own, drawn with one stroke width on a square grid: x height 1, baseline 0.
static const double STROKE = 0.25;
static const double GAP = 0.18;
static const double HALF_DEPTH = 0.16;
#define EDGE_RADIUS       0.05
#define SPARK_EDGE_RADIUS 0.02 // its points are thin

static double degrees(double radians) {
    return radians * 180 / PI;
}

// A round bowl, a stem at its right that runs down into a hook. Arcs that end in a sharp corner end in a
// straight piece longer than the edge radius, or the inset would turn their last step round.
static double draw_g(struct outline *o) {
    const vec2 bowl = {0.5, 0.5}, hook = {0.5, -0.12};
    const double hook_end = 0.14;
    double stem = 1 - STROKE, half_chord = degrees(acos((stem - bowl.x) / 0.5));
    outline_point(o, 1, 1);
    outline_point(o, stem, 1);
    outline_arc(o, bowl, 0.5, half_chord, 360 - half_chord);
    outline_arc(o, hook, 0.5 - STROKE, 0, -90);
    outline_point(o, hook_end, hook.y - 0.5 + STROKE);
    outline_point(o, hook_end, hook.y - 0.5);
    outline_arc(o, hook, 0.5, -90, 0);
    outline_close(o);
    outline_arc(o, bowl, 0.5 - STROKE, 0, -360);
    outline_close(o);
    return 1;
}

static void draw_bar(struct outline *o, double top) {
    outline_point(o, 0, 0);
    outline_point(o, STROKE, 0);
    outline_point(o, STROKE, top);
    outline_point(o, 0, top);
    outline_close(o);
}

static double draw_l(struct outline *o) {
    draw_bar(o, 1.45);
    return STROKE;
}

static double draw_i(struct outline *o) {
    draw_bar(o, 1);
    return STROKE;
}

// Four points, joined by quarter circles that bend inward.
static double draw_spark(struct outline *o) {
    const double reach = 0.26, tip = 0.04;
    const vec2 centre = {STROKE / 2, 1.33};
    for (int i = 0; i < 4; i++) {
        double along_x = i == 0 || i == 3 ? 1 : -1, along_y = i < 2 ? 1 : -1;
        vec2 pivot = {centre.x + along_x * reach, centre.y + along_y * reach};
        outline_arc(o, pivot, reach - tip, 270 + 90 * i, 180 + 90 * i);
    }
    outline_close(o);
    return STROKE;
}

static double draw_n(struct outline *o) {
    const vec2 arch = {0.45, 0.55};
    double right = 2 * arch.x, crotch = degrees(acos((STROKE - arch.x) / arch.x));
    outline_point(o, 0, 0);
    outline_point(o, STROKE, 0);
    outline_arc(o, arch, arch.x - STROKE, 180, 0);
    outline_point(o, right - STROKE, 0);
    outline_point(o, right, 0);
    outline_arc(o, arch, arch.x, 0, crotch);
    outline_point(o, STROKE, 1);
    outline_point(o, 0, 1);
    outline_close(o);
    return right;
}

static double draw_t(struct outline *o) {
    const double left = 0.17, bar = 0.23, width = 0.70;
    const vec2 foot = {left + 0.38, 0.38};
    outline_arc(o, foot, 0.38, 180, 270);
    outline_point(o, width, 0);
    outline_point(o, width, STROKE);
    outline_arc(o, foot, 0.38 - STROKE, 270, 180);
    outline_point(o, left + STROKE, 1 - bar);
    outline_point(o, width, 1 - bar);
    outline_point(o, width, 1);
    outline_point(o, left + STROKE, 1);
    outline_point(o, left + STROKE, 1.35);
    outline_point(o, left, 1.35);
    outline_point(o, left, 1);
    outline_point(o, 0, 1);
    outline_point(o, 0, 1 - bar);
    outline_point(o, left, 1 - bar);
    outline_close(o);
    return width;
}

void word_generate(struct mesh *mesh) {
    static const struct {
        double (*draw)(struct outline *outline); // gives the letter's width
        bool stays;                              // the next one stands above this one, not beside it
        double edge_radius;
        const char *material;
    } letters[] = {
        {draw_g, false, EDGE_RADIUS, "letters"}, {draw_l, false, EDGE_RADIUS, "letters"},
        {draw_i, true, EDGE_RADIUS, "letters"},  {draw_spark, false, SPARK_EDGE_RADIUS, "spark"},
        {draw_n, false, EDGE_RADIUS, "letters"}, {draw_t, false, EDGE_RADIUS, "letters"},
    };
    const double width = 1 + STROKE + STROKE + 0.9 + 0.7 + 4 * GAP;
    double x = -width / 2;
    for (size_t i = 0; i < sizeof letters / sizeof letters[0]; i++) {
        struct outline outline;
        outline_init(&outline);
        double advance = letters[i].draw(&outline);
        const struct extrude_profile profile = {HALF_DEPTH, letters[i].edge_radius};
        mesh->material = letters[i].material;
        extrude_outline(mesh, &outline, x, &profile);
        x += letters[i].stays ? 0 : advance + GAP;
    }
}
