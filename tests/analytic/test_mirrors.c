// Two facing mirrors: each bounce is known, so is its weight; depth and weight end the path exactly where
// docs/language.md, "Depth and weight", says.
#include "analytic_kit.h"

#include <stdio.h>

struct mirrors {
    double reflection, diffuse; // weights
    int max_depth;
    double min_weight;
    bool black;
    vec3 background;
};

enum {
    HALF_WIDTH = 9,
    HALF_HEIGHT = 7
};

// The camera stands in the middle between mirrors at z = -1 and z = 1.
static bool mirrors_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct mirrors *m = context;
    double weight = 1, light = 0, seen = 0;
    (void)origin;
    for (int depth = 0;; depth++) {
        double t = (1 + 2 * depth) / fabs(direction.z);
        double x = fabs(direction.x) * t, y = fabs(direction.y) * t;
        if (fabs(x - HALF_WIDTH) < 1e-4 || fabs(y - HALF_HEIGHT) < 1e-4)
            return false;
        if (depth > m->max_depth) {
            seen = m->black ? 0 : weight;
            break;
        }
        if (x > HALF_WIDTH || y > HALF_HEIGHT) {
            seen = weight;
            break;
        }
        // Light travels along -z: only the mirror at z = -1 faces it.
        if (depth % 2 == 0)
            light += weight * m->diffuse * 0.5;
        weight *= m->reflection;
        if (weight == 0 || weight < m->min_weight)
            break;
    }
    rgb[0] = light + seen * m->background.x;
    rgb[1] = light + seen * m->background.y;
    rgb[2] = light + seen * m->background.z;
    return true;
}

static void check(struct analytic *a, struct mirrors m) {
    char scene[1024], name[256];
    snprintf(name, sizeof name, "mirrors %g, diffuse %g, depth %d, weight %.9g%s", m.reflection, m.diffuse,
             m.max_depth, m.min_weight, m.black ? ", black" : "");
    snprintf(scene, sizeof scene,
             "trace: {max_depth: %d, min_weight: %.17g, depth_limit: %s, shadows: false}\n"
             "background: {color: [%.17g, %.17g, %.17g]}\n"
             "lights:\n  - {direction: [0, 0, -1], intensity: 0.5}\n"
             "materials:\n  mirror: {albedo: [%.17g, 0, %.17g, 0], diffuse_color: 1}\n"
             "rectangles:\n"
             "  - {corner: [-9, -7, -1], edge_u: [18, 0, 0], edge_v: [0, 14, 0], material: mirror}\n"
             "  - {corner: [-9, -7, 1], edge_u: [18, 0, 0], edge_v: [0, 14, 0], material: mirror}\n",
             m.max_depth, m.min_weight, m.black ? "black" : "background", m.background.x, m.background.y,
             m.background.z, m.diffuse, m.reflection);
    struct analytic_picture picture = {.name = name,
                                       .scene = scene,
                                       .width = 72,
                                       .height = 48,
                                       .color = mirrors_color,
                                       .context = &m,
                                       .tolerance = 2e-6,
                                       .most_beside = 0.01};
    analytic_check(a, &picture);
}

static void check_depths(struct analytic *a) {
    static const int depths[] = {0, 1, 2, 3, 4, 15, 16, 40, 64};
    for (size_t i = 0; i < sizeof depths / sizeof depths[0]; i++) {
        struct mirrors m = {0.9, 0, depths[i], 0, false, {1, 0.5, 2}};
        check(a, m);
        m.black = true;
        m.diffuse = 0.25;
        check(a, m);
    }
    check(a, (struct mirrors){1, 0, 64, 0, false, {0.5, 0.25, 1}});
    check(a, (struct mirrors){1.5, 0, 30, 0, false, {0.5, 0.25, 1}});
}

// With weights 2^-n: the ray of exactly this weight is still sent, one below is not, at the depth limit too.
static void check_weights(struct analytic *a) {
    static const double weights[] = {0.0009765625, 0.03125, 0.0312501, 0.5, 0.500001, 1};
    for (size_t i = 0; i < sizeof weights / sizeof weights[0]; i++) {
        struct mirrors m = {0.5, 0, 16, weights[i], false, {1, 1, 1}};
        check(a, m);
        m.max_depth = 4; // the first ray not sent would have 2^-5
        check(a, m);
    }
}

int main(int argc, char **argv) {
    struct analytic a;
    int code = analytic_open(&a, argc, argv);
    if (code)
        return code;
    check_depths(&a);
    check_weights(&a);
    return analytic_close(&a);
}
