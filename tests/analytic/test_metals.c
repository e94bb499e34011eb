// Mirrors with a colour, and metals: Schlick's form pixel by pixel, and how far it is from the equations for
// metals with the refractive index n and the extinction k of each preset.
#include "analytic_kit.h"

#include <stdio.h>

struct mirror {
    double reflection, refraction; // weights
    vec3 color;
    bool metal;
    vec3 background;
};

static double channel(vec3 v, int i) {
    return i == 0 ? v.x : i == 1 ? v.y : v.z;
}

static double schlick(double straight_on, double c) {
    return straight_on + (1 - straight_on) * pow(1 - c, 5);
}

// The camera looks at a wall at z = -1, which shows the background mirrored, and through it the same
// background.
static bool wall_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct mirror *m = context;
    (void)origin;
    for (int i = 0; i < 3; i++) {
        const double color = channel(m->color, i);
        const double share = m->metal ? schlick(color, fabs(direction.z)) : color;
        rgb[i] = (m->reflection * share + m->refraction) * channel(m->background, i);
    }
    return true;
}

static void check_wall(struct analytic *a, struct mirror m) {
    char scene[1024], name[256];
    snprintf(name, sizeof name, "wall %g %g, colour %g %g %g%s", m.reflection, m.refraction, m.color.x,
             m.color.y, m.color.z, m.metal ? ", metal" : "");
    snprintf(scene, sizeof scene,
             "background: {color: [%.17g, %.17g, %.17g]}\n"
             "materials:\n  wall: {albedo: [0, 0, %.17g, %.17g], reflection_color: [%.17g, %.17g, %.17g], "
             "metal: %s}\n"
             "rectangles:\n"
             "  - {corner: [-1e3, -1e3, -1], edge_u: [2e3, 0, 0], edge_v: [0, 2e3, 0], material: wall}\n",
             m.background.x, m.background.y, m.background.z, m.reflection, m.refraction, m.color.x, m.color.y,
             m.color.z, m.metal ? "true" : "false");
    const struct analytic_picture picture = {.name = name,
                                             .scene = scene,
                                             .camera = {.fov = 150}, // up to 80 degrees from the normal
                                             .width = 72,
                                             .height = 48,
                                             .color = wall_color,
                                             .context = &m,
                                             .tolerance = 2e-6};
    analytic_check(a, &picture);
}

// From within a ball of glass past the angle of total reflection the colour counts for the weight of
// reflection alone. The camera stands near the edge and looks along it; light is turned back again and again
// until the depth ends.
struct ball {
    double reflection, refraction;
    vec3 color;
    int depth;
};

static bool ball_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct ball *b = context;
    const double along = vec3_dot(origin, direction);
    const double nearest =
        sqrt(fmax(vec3_dot(origin, origin) - along * along, 0)); // also the sine of all its hits
    if (nearest < 1 / 1.5 + 1e-3)
        return false;
    for (int i = 0; i < 3; i++)
        rgb[i] = pow(b->reflection * channel(b->color, i) + b->refraction, b->depth + 1);
    return true;
}

static void check_ball(struct analytic *a, struct ball b) {
    char scene[1024], name[256];
    snprintf(name, sizeof name, "ball %g %g, depth %d", b.reflection, b.refraction, b.depth);
    snprintf(
        scene, sizeof scene,
        "trace: {max_depth: %d, min_weight: 0}\nbackground: {color: [1, 1, 1]}\n"
        "materials:\n  ball: {albedo: [0, 0, %.17g, %.17g], refractive_index: 1.5, reflection_color: [%.17g, "
        "%.17g, %.17g]}\n"
        "spheres:\n  - {center: [0, 0, 0], radius: 1, material: ball}\n",
        b.depth, b.reflection, b.refraction, b.color.x, b.color.y, b.color.z);
    const struct analytic_picture picture = {
        .name = name,
        .scene = scene,
        .camera = {.position = {0.9, 0, 0}, .forward = {0, 0, -1}, .fov = 30},
        .width = 36,
        .height = 24,
        .color = ball_color,
        .context = &b,
        .tolerance = 1e-5,
        .most_beside = 0.05};
    analytic_check(a, &picture);
}

// ---- the presets

struct metal {
    const char *preset;
    double n[3], k[3]; // at red, green and blue: refractiveindex.info, as in physicallybased.info
};

static const struct metal metals[] = {
    {"gold", {0.18299, 0.42108, 1.3734}, {3.4242, 2.3459, 1.7704}},
    {"silver", {0.15943, 0.14512, 0.13547}, {3.9291, 3.19, 2.3808}},
    {"copper", {0.27105, 0.67693, 1.3164}, {3.6092, 2.6248, 2.2921}},
    {"brass", {0.444, 0.527, 1.094}, {3.695, 2.765, 1.829}},
    {"iron", {2.9114, 2.9497, 2.5845}, {3.0893, 2.9318, 2.767}},
    {"chrome", {3.4256, 2.7891, 2.0246}, {4.273, 4.1976, 3.8586}},
    {"aluminium", {1.3456, 0.96521, 0.61722}, {7.4746, 6.3995, 5.3031}},
    {"titanium", {2.7407, 2.5418, 2.267}, {3.8143, 3.4345, 3.0385}},
};

// Fresnel's equations for unpolarised light from air on a metal (Born and Wolf 1999, section 14.2).
static double exact(double n, double k, double c) {
    const double s2 = 1 - c * c, d = n * n - k * k - s2;
    const double ab = sqrt(d * d + 4 * n * n * k * k), a = sqrt((ab + d) / 2);
    const double across = (ab + c * c - 2 * a * c) / (ab + c * c + 2 * a * c);
    const double along =
        across * (ab * c * c + s2 * s2 - 2 * a * c * s2) / (ab * c * c + s2 * s2 + 2 * a * c * s2);
    return (across + along) / 2;
}

static bool preset_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct metal *m = context;
    (void)origin;
    for (int i = 0; i < 3; i++)
        rgb[i] = schlick(exact(m->n[i], m->k[i], 1), fabs(direction.z));
    return true;
}

static void check_preset(struct analytic *a, const struct metal *m) {
    char scene[512], name[64];
    double most = 0, mean = 0;
    for (int i = 0; i < 3; i++) {
        double sum = 0;
        for (int step = 0; step < 900; step++) {
            const double angle = (step + 0.5) / 900 * 1.57079632679489662, c = cos(angle);
            const double far = fabs(schlick(exact(m->n[i], m->k[i], 1), c) - exact(m->n[i], m->k[i], c));
            most = fmax(most, far);
            sum += far * 2 * sin(angle) * c * 1.57079632679489662 / 900;
        }
        mean = fmax(mean, sum);
    }
    printf("%-10s Schlick's form differs from Fresnel's equations by at most %.3f, by %.4f in light from "
           "everywhere\n",
           m->preset, most, mean);
    analytic_expect(a, most < 0.23 && mean < 0.035, m->preset, "Schlick's form is not near enough");
    snprintf(name, sizeof name, "preset %s", m->preset);
    snprintf(scene, sizeof scene,
             "background: {color: [1, 1, 1]}\nlights: []\nmaterials:\n  wall: {preset: %s}\n"
             "rectangles:\n"
             "  - {corner: [-1e3, -1e3, -1], edge_u: [2e3, 0, 0], edge_v: [0, 2e3, 0], material: wall}\n",
             m->preset);
    // Colours are written with three digits.
    const struct analytic_picture picture = {.name = name,
                                             .scene = scene,
                                             .camera = {.fov = 150},
                                             .color = preset_color,
                                             .context = m,
                                             .tolerance = 7e-4};
    analytic_check(a, &picture);
}

int main(int argc, char **argv) {
    struct analytic a;
    int code = analytic_open(&a, argc, argv);
    if (code)
        return code;
    const vec3 gold = {1, 0.75, 0.25}, white = {1, 1, 1}, odd = {0, 0.5, 1}, sky = {0.5, 0.25, 2};
    check_wall(&a, (struct mirror){.reflection = 1, .color = gold, .metal = true, .background = white});
    check_wall(&a, (struct mirror){.reflection = 0.5, .color = odd, .metal = true, .background = sky});
    check_wall(&a, (struct mirror){.reflection = 1, .color = gold, .background = white});
    check_wall(&a, (struct mirror){.reflection = 0.75, .color = odd, .background = sky});
    check_wall(&a, (struct mirror){.reflection = 0.5, .refraction = 0.25, .color = odd, .background = sky});
    check_wall(&a,
               (struct mirror){
                   .reflection = 0.5, .refraction = 0.25, .color = gold, .metal = true, .background = sky});
    check_wall(&a, (struct mirror){.reflection = 1, .color = white, .metal = true, .background = sky});
    check_ball(&a, (struct ball){0.25, 0.75, {1, 0.5, 0}, 0});
    check_ball(&a, (struct ball){0.25, 0.75, {1, 0.5, 0}, 3});
    check_ball(&a, (struct ball){0, 0.9, {1, 0.5, 0}, 5});
    for (size_t i = 0; i < sizeof metals / sizeof metals[0]; i++)
        check_preset(&a, &metals[i]);
    return analytic_close(&a);
}
