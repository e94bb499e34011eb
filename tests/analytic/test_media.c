// Media: layers, nested balls, total reflection between them, attenuation, Fresnel's equations and light that
// shines through, in both precisions (docs/language.md, "Media").
#include "analytic_kit.h"
#include "core/angle.h"

#include <stdio.h>
#include <string.h>

enum {
    LAYERS = 8,
    TEXT = 4096,
};

// In double precision, where what is left is the rounding of colours, and unless `single` is 0 in single
// precision.
static void check_both(struct analytic *a, struct analytic_picture picture, const char *trace,
                       double single) {
    static const char *const words[] = {"single", "double"};
    static char scene[2][2 * TEXT], name[2][256];
    const char *given = picture.scene, *title = picture.name;
    for (int i = single > 0 ? 0 : 1; i < 2; i++) {
        snprintf(scene[i], sizeof scene[i], "trace: {precision: %s%s}\n%s", words[i], trace, given);
        snprintf(name[i], sizeof name[i], "%s, %s precision", title, words[i]);
        picture.scene = scene[i];
        picture.name = name[i];
        picture.tolerance = i ? 1e-6 : single;
        analytic_check(a, &picture);
    }
}

// ---- layers between parallel planes

struct layer {
    double index, thickness;
    double left[3]; // of light, after a way of 1
};

// From z = -2 on.
struct layers {
    struct layer items[LAYERS];
    int count;
    double weight;  // of all surfaces together
    bool in_single; // precision too
};

// Snell: index times sine is the same in all layers, so the ray leaves as it came, displaced.
static bool layers_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct layers *l = context;
    vec3 p = analytic_at(origin, direction, (-2 - origin.z) / direction.z);
    double left[3] = {l->weight, l->weight, l->weight};
    for (int i = 0; i < l->count; i++) {
        const struct layer *layer = &l->items[i];
        vec3 d = {direction.x / layer->index, direction.y / layer->index, 0};
        d.z = -sqrt(1 - d.x * d.x - d.y * d.y);
        const double way = layer->thickness / -d.z;
        p = analytic_at(p, d, way);
        for (int k = 0; k < 3; k++)
            left[k] *= pow(layer->left[k], way);
    }
    analytic_sky(p, direction, rgb);
    for (int k = 0; k < 3; k++)
        rgb[k] *= left[k];
    return true;
}

// `models`: slabs, each 1 thick before its scale.
static void check_layers(struct analytic *a, const char *name, const char *materials, const char *models,
                         const struct layers *layers) {
    char scene[TEXT];
    snprintf(scene, sizeof scene, "%sspheres:\n%smaterials:\n%smodels:\n%s", analytic_sky_lights,
             analytic_sky_sphere, materials, models);
    const struct analytic_picture picture = {
        .name = name,
        .scene = scene,
        .camera = {.position = {1, 2, 3}, .forward = {0.3, -0.2, -1}, .fov = 70},
        .color = layers_color,
        .context = layers};
    check_both(a, picture, ", shadows: false", layers->in_single ? 1e-5 : 0);
}

#define CLEAR                                                                                                \
    { 1, 1, 1 }
#define MATERIAL "albedo: [0, 0, 0, 1], refractive_index: "

static void check_slabs(struct analytic *a) {
    static const char plain[] =
        "  glass: {" MATERIAL "1.5}\n  water: {" MATERIAL "1.33}\n  air: {" MATERIAL "1}\n";
    const struct layers nested = {{{1.5, 1, CLEAR}, {1.33, 2, CLEAR}, {1.5, 1, CLEAR}}, 3, 1, true};
    check_layers(a, "a slab of water in one of glass", plain,
                 "  - {mesh: slab.obj, material: glass, scale: [1, 1, 4], translation: [0, 0, -2]}\n"
                 "  - {mesh: slab.obj, material: water, scale: [0.9, 0.9, 2], translation: [0, 0, -3]}\n",
                 &nested);
    check_layers(a, "the same, the inner one first", plain,
                 "  - {mesh: slab.obj, material: water, scale: [0.9, 0.9, 2], translation: [0, 0, -3]}\n"
                 "  - {mesh: slab.obj, material: glass, scale: [1, 1, 4], translation: [0, 0, -2]}\n",
                 &nested);
    const struct layers gap = {{{1.5, 1, CLEAR}, {1, 1, CLEAR}, {1.5, 1, CLEAR}}, 3, 1, false};
    check_layers(a, "a layer of air in a slab", plain,
                 "  - {mesh: slab.obj, material: glass, scale: [1, 1, 3], translation: [0, 0, -2]}\n"
                 "  - {mesh: slab.obj, material: air, scale: [0.9, 0.9, 1], translation: [0, 0, -3]}\n",
                 &gap);
    const struct layers one = {{{1.5, 3, CLEAR}}, 1, 1, false};
    check_layers(a, "two slabs of one material", plain,
                 "  - {mesh: slab.obj, material: glass, scale: [1, 1, 2], translation: [0, 0, -2]}\n"
                 "  - {mesh: slab.obj, material: glass, scale: [0.9, 0.9, 2], translation: [0, 0, -3]}\n",
                 &one);
}

// The one of higher priority has its place whole, in whatever order they are written and entered.
static void check_priority(struct analytic *a) {
    static const char materials[] = "  glass: {" MATERIAL "1.5, priority: 1}\n  water: {" MATERIAL "1.33}\n";
    static const char *const slabs[] = {
        "  - {mesh: slab.obj, material: glass, scale: [1, 1, 2], translation: [0, 0, -2]}\n",
        "  - {mesh: slab.obj, material: water, scale: [0.9, 0.9, 2.5], translation: [0, 0, -3.5]}\n",
        "  - {mesh: slab.obj, material: water, scale: [0.9, 0.9, 2.5], translation: [0, 0, -2]}\n",
        "  - {mesh: slab.obj, material: glass, scale: [1, 1, 2], translation: [0, 0, -4]}\n"};
    const struct layers first = {{{1.5, 2, CLEAR}, {1.33, 2, CLEAR}}, 2, 1, false};
    const struct layers second = {{{1.33, 2, CLEAR}, {1.5, 2, CLEAR}}, 2, 1, false};
    for (int turned = 0; turned < 2; turned++)
        for (int late = 0; late < 2; late++) {
            char models[TEXT];
            snprintf(models, sizeof models, "%s%s", slabs[2 * late + turned], slabs[2 * late + 1 - turned]);
            check_layers(a,
                         late ? "water that reaches into glass behind it" : "glass that reaches into water",
                         materials, models, late ? &second : &first);
        }
}

static void check_attenuation(struct analytic *a) {
    const struct layers one = {{{1.5, 2, {0.5, 0.8, 0.25}}}, 1, 0.81, false};
    check_layers(a, "coloured glass",
                 "  glass: {albedo: [0, 0, 0, 0.9], refractive_index: 1.5, "
                 "attenuation_color: [0.25, 0.64, 0.0625], attenuation_distance: 2}\n",
                 "  - {mesh: slab.obj, material: glass, scale: [1, 1, 2], translation: [0, 0, -2]}\n", &one);
    // In the water there is no glass.
    const struct layers two = {
        {{1.5, 1, {0.5, 0.9, 0.9}}, {1.33, 2, {0.9, 0.8, 1}}, {1.5, 1, {0.5, 0.9, 0.9}}}, 3, 1, true};
    check_layers(a, "coloured water in coloured glass",
                 "  glass: {" MATERIAL "1.5, attenuation_color: [0.5, 0.9, 0.9]}\n"
                 "  water: {" MATERIAL "1.33, attenuation_color: [0.81, 0.64, 1], attenuation_distance: 2}\n",
                 "  - {mesh: slab.obj, material: glass, scale: [1, 1, 4], translation: [0, 0, -2]}\n"
                 "  - {mesh: slab.obj, material: water, scale: [0.9, 0.9, 2], translation: [0, 0, -3]}\n",
                 &two);
    const struct layers black = {{{1.2, 1, {1, 0, 0.5}}}, 1, 1, false};
    check_layers(a, "glass that takes a colour wholly",
                 "  glass: {" MATERIAL "1.2, attenuation_color: [1, 0, 0.5]}\n",
                 "  - {mesh: slab.obj, material: glass, translation: [0, 0, -2]}\n", &black);
}

// ---- balls in balls

struct balls {
    double radius[LAYERS], index[LAYERS]; // from the outermost one in
    int count;
};

static const vec3 middle = {0.25, 1, -3};

// false: a ray passes a rim or the critical angle too near to tell.
static bool balls_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct balls *b = context;
    int inside = 0; // of how many
    for (int i = 0; i < b->count; i++)
        inside += vec3_length(vec3_sub(origin, middle)) < b->radius[i];
    for (int step = 0; step < 40; step++) {
        const double out =
            inside > 0 ? analytic_sphere(origin, direction, middle, b->radius[inside - 1], 1e-9) : -1;
        const double in =
            inside < b->count ? analytic_sphere(origin, direction, middle, b->radius[inside], 1e-9) : -1;
        const vec3 way = vec3_sub(middle, origin);
        const double rim = vec3_length(vec3_sub(way, vec3_mul(direction, vec3_dot(way, direction))));
        for (int i = 0; i < b->count; i++)
            if (fabs(rim / b->radius[i] - 1) < 0.02)
                return false;
        if (out < 0 && in < 0) {
            analytic_sky(origin, direction, rgb);
            return true;
        }
        const bool enters = in > 0 && vec3_dot(way, direction) > 0 && (out < 0 || in < out);
        const int boundary = enters ? inside : inside - 1;
        const double here = inside ? b->index[inside - 1] : 1;
        const double next = enters ? b->index[inside] : inside > 1 ? b->index[inside - 2] : 1;
        origin = analytic_at(origin, direction, enters ? in : out);
        vec3 n = vec3_mul(vec3_sub(origin, middle), (enters ? 1 : -1) / b->radius[boundary]), bent;
        const double eta = here / next, c = -vec3_dot(direction, n);
        if (fabs(1 - eta * eta * (1 - c * c)) < 0.01)
            return false;
        if (analytic_refracted(direction, n, eta, &bent)) {
            inside += enters ? 1 : -1;
            direction = bent;
        } else {
            direction = analytic_mirrored(direction, n);
        }
    }
    return false;
}

static void check_balls(struct analytic *a, const char *name, struct balls balls, vec3 camera, bool turned) {
    char scene[TEXT];
    int length = snprintf(scene, sizeof scene, "%sspheres:\n%s", analytic_sky_lights, analytic_sky_sphere);
    for (int i = 0; i < balls.count; i++) {
        const int k = turned ? balls.count - 1 - i : i;
        length += snprintf(scene + length, sizeof scene - (size_t)length,
                           "  - {center: [0.25, 1, -3], radius: %g, material: {" MATERIAL "%g}}\n",
                           balls.radius[k], balls.index[k]);
    }
    const struct analytic_picture picture = {.name = name,
                                             .scene = scene,
                                             .camera = {.position = camera, .fov = 50},
                                             .color = balls_color,
                                             .context = &balls,
                                             .most_beside = 0.4};
    check_both(a, picture, ", shadows: false, max_depth: 40, min_weight: 0", balls.count > 2 ? 3e-5 : 0);
}

static void check_all_balls(struct analytic *a) {
    const vec3 outside = {0.5, 1, 2}, within = {0.3, 0.9, -2.2}, between = {0.4, 1.1, -1.9};
    check_balls(a, "a bubble of air in glass", (struct balls){{1.5, 0.75}, {1.5, 1}, 2}, outside, false);
    check_balls(a, "water in glass", (struct balls){{1.5, 1.25}, {1.5, 1.33}, 2}, outside, true);
    check_balls(a, "glass, water, ice and a bubble",
                (struct balls){{1.5, 1.25, 0.8, 0.3}, {1.5, 1.33, 1.31, 1}, 4}, outside, true);
    check_balls(a, "a camera in the water of a glass", (struct balls){{1.5, 1.25}, {1.5, 1.33}, 2}, within,
                false);
    check_balls(a, "a camera in a wall of glass", (struct balls){{1.5, 1}, {1.5, 1}, 2}, between, true);
}

// ---- one surface: max_depth 0 shows where its rays lead

// White from 45 degrees up, black from 45 degrees down, linear between: two rows.
static double two_rows(vec3 d) {
    double v = acos(d.y) / PI;
    return fmin(1, fmax(0, 1 - (v - 0.25) * 2));
}

struct boundary {
    double before, after; // indices; the camera is below, or the surface opaque or a pane seen from below
    double reflection, refraction;
    bool fresnel, pane;
    bool one_angle;
};

// The unpolarised share, by the sine and tangent laws: another form than the tracers'.
static double share(double before, double after, double angle, bool pane) {
    const double sine = before / after * sin(angle);
    if (sine >= 1)
        return 1;
    const double other = asin(sine), less = angle - other, sum = angle + other;
    double across = (before - after) / (before + after), along = across;
    if (angle > 1e-6) {
        across = sin(less) / sin(sum);
        along = tan(less) / tan(sum);
    }
    across *= across;
    along *= along;
    if (pane) {
        across = 2 * across / (1 + across);
        along = 2 * along / (1 + along);
    }
    return (across + along) / 2;
}

static bool boundary_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct boundary *b = context;
    const vec3 down = {0, -1, 0};
    const double eta = b->before / b->after, sine = eta * sqrt(1 - direction.y * direction.y);
    vec3 out = direction;
    (void)origin;
    const bool through = b->pane || analytic_refracted(direction, down, eta, &out);
    double back = b->reflection + (through ? 0 : b->refraction), on = through ? b->refraction : 0;
    if (b->fresnel) {
        const double r = share(b->before, b->after, acos(direction.y), b->pane);
        back = b->reflection * r;
        on = b->refraction * (1 - r);
    }
    rgb[0] = rgb[1] = rgb[2] = back * two_rows(analytic_mirrored(direction, down)) + on * two_rows(out);
    return b->one_angle || fabs(sine - 1) > 0.01;
}

#define ALL_ANGLES -1.0

// One direction for all pixels, `angle` from straight up, in double precision only; or those up to 79
// degrees.
static void check_boundary(struct analytic *a, const char *name, const char *bodies, struct boundary boundary,
                           double angle) {
    char scene[TEXT], title[200];
    struct analytic_picture picture = {.name = title,
                                       .scene = scene,
                                       .camera = {.forward = {0, 1, 0}, .up = {0, 0, 1}, .fov = 150},
                                       .width = 25,
                                       .height = 25,
                                       .color = boundary_color,
                                       .context = &boundary,
                                       .most_beside = 0.1};
    boundary.one_angle = angle >= 0;
    snprintf(scene, sizeof scene, "background: {image: rows.png}\n%s", bodies);
    snprintf(title, sizeof title, "%s, all angles", name);
    if (boundary.one_angle) {
        snprintf(title, sizeof title, "%s, %g degrees", name, angle * 180 / PI);
        picture.camera.forward = (vec3){sin(angle), cos(angle), 0};
        picture.camera.fov = 1e-5;
        picture.width = picture.height = 4;
    }
    check_both(a, picture, ", max_depth: 0", boundary.one_angle || boundary.pane ? 0 : 3e-5);
}

// The camera is in the lower slab, whose top is half a unit above; the upper one reaches into it.
static void check_total(struct analytic *a) {
    static const char bodies[] =
        "materials:\n"
        "  glass: {albedo: [0, 0, 0.25, 0.5], refractive_index: 1.5, priority: 1}\n"
        "  water: {albedo: [0, 0, 0.25, 0.5], refractive_index: 1.33}\nmodels:\n"
        "  - {mesh: slab.obj, material: water, rotation: [-90, 0, 0], translation: [0, 1.2, 0]}\n"
        "  - {mesh: slab.obj, material: glass, rotation: [-90, 0, 0], translation: [0, 0.5, 0]}\n";
    const struct boundary boundary = {1.5, 1.33, 0.25, 0.5, false, false, false};
    const double critical = asin(1.33 / 1.5);
    check_boundary(a, "glass below water", bodies, boundary, ALL_ANGLES);
    check_boundary(a, "glass below water", bodies, boundary, critical - 1e-3);
    check_boundary(a, "glass below water", bodies, boundary, critical + 1e-3);
}

// Seen from inside a ball of glass that has the same index: what a diver sees.
static void check_window(struct analytic *a) {
    check_boundary(a, "Snell's window",
                   "materials:\n  water: {albedo: [0, 0, 0.25, 0.5], refractive_index: 1.33}\n"
                   "spheres:\n  - {center: [0, 0, 0], radius: 0.3, material: water}\nmodels:\n"
                   "  - {mesh: slab.obj, material: water, scale: [1, 1, 9], rotation: [-90, 0, 0], "
                   "translation: [0, 0.5, 0]}\n",
                   (struct boundary){1.33, 1, 0.25, 0.5, false, false, false}, ALL_ANGLES);
}

static void check_fresnel_at(struct analytic *a, double angle) {
    static const char above[] = "rotation: [-90, 0, 0], translation: [0, 1.5, 0]}\n";
    static const char within[] = "rotation: [-90, 0, 0], translation: [0, 0.5, 0]}\n";
    char bodies[TEXT];
    snprintf(bodies, sizeof bodies,
             "models:\n  - {mesh: slab.obj, material: {albedo: [0, 0, 0.5, 0.75], refractive_index: 1.5, "
             "fresnel: true}, %s",
             above);
    check_boundary(a, "into glass", bodies, (struct boundary){1, 1.5, 0.5, 0.75, true, false, false}, angle);
    snprintf(bodies, sizeof bodies,
             "models:\n  - {mesh: slab.obj, material: {albedo: [0, 0, 0.5, 0.75], refractive_index: 1.5, "
             "fresnel: true}, %s",
             within);
    check_boundary(a, "out of glass", bodies, (struct boundary){1.5, 1, 0.5, 0.75, true, false, false},
                   angle);
    snprintf(bodies, sizeof bodies,
             "models:\n  - {mesh: slab.obj, material: {albedo: [0, 0, 0.5, 0.75], refractive_index: 1.33}, "
             "scale: [1, 1, 4], rotation: [-90, 0, 0], translation: [0, 2, 0]}\n"
             "  - {mesh: slab.obj, material: {albedo: [0, 0, 0.5, 0.75], refractive_index: 1.5, fresnel: "
             "true}, scale: 0.9, %s",
             above);
    check_boundary(a, "from water into glass", bodies,
                   (struct boundary){1.33, 1.5, 0.5, 0.75, true, false, false}, angle);
    check_boundary(
        a, "a varnish",
        "rectangles:\n  - {corner: [-40, 1, -40], edge_u: [80, 0, 0], edge_v: [0, 0, 80], material: "
        "{albedo: [0, 0, 0.5, 0], refractive_index: 1.5, fresnel: true}}\n",
        (struct boundary){1, 1.5, 0.5, 0, true, false, false}, angle);
    check_boundary(
        a, "a pane",
        "rectangles:\n  - {corner: [-40, 1, -40], edge_u: [80, 0, 0], edge_v: [0, 0, 80], material: "
        "{albedo: [0, 0, 0.5, 0.75], refractive_index: 1.5, fresnel: true}}\n",
        (struct boundary){1, 1.5, 0.5, 0.75, true, true, false}, angle);
}

static void check_fresnel(struct analytic *a) {
    static const char slab[] = "models:\n  - {mesh: slab.obj, material: {albedo: [0, 0, 0.5, 0.75], "
                               "refractive_index: 1.5, fresnel: true}, "
                               "scale: [9, 9, 1], rotation: [-90, 0, 0], translation: [0, 1.5, 0]}\n";
    const struct boundary boundary = {1, 1.5, 0.5, 0.75, true, false, false};
    check_fresnel_at(a, ALL_ANGLES);
    check_fresnel_at(a, 0);
    check_fresnel_at(a, atan(1 / 1.5));    // Brewster's angle out of glass
    check_fresnel_at(a, atan(1.5 / 1.33)); // from water into glass
    check_fresnel_at(a, 88 * PI / 180);    // grazing, beyond the critical angle out of glass
    check_boundary(a, "into glass, Brewster's angle", slab, boundary, atan(1.5));
    check_boundary(a, "into glass, grazing", slab, boundary, 89.5 * PI / 180);
}

// ---- shadows of glass: a white floor, lit straight through slabs

struct lit {
    double value[3];
    bool in_single; // too
};

static bool lit_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct lit *lit = context;
    (void)origin;
    (void)direction;
    memcpy(rgb, lit->value, sizeof lit->value);
    return true;
}

static void check_lit(struct analytic *a, const char *name, const char *bodies, const char *light,
                      struct lit lit) {
    char scene[TEXT];
    snprintf(
        scene, sizeof scene,
        "lights: [{%s}]\n%srectangles:\n"
        "  - {corner: [-40, 0, -40], edge_u: [80, 0, 0], edge_v: [0, 0, 80], material: {diffuse_color: 1}}\n",
        light, bodies);
    const struct analytic_picture picture = {.name = name,
                                             .scene = scene,
                                             .camera = {{0, 0.4, 0}, {0, -1, 0}, {0, 0, 1}, 1e-4},
                                             .width = 4,
                                             .height = 4,
                                             .color = lit_color,
                                             .context = &lit};
    check_both(a, picture, ", transparent_shadows: true", lit.in_single ? 1e-5 : 0);
}

static void check_shine(struct analytic *a) {
    static const char sun[] = "direction: [1, -1, 0]", lamp[] = "position: [0, 9, 0]";
    const double half = sqrt(0.5), way = sqrt(2);
    check_lit(a, "nothing between", "", sun, (struct lit){{half, half, half}, false});
    check_lit(a, "a slab",
              "models:\n  - {mesh: slab.obj, rotation: [-90, 0, 0], translation: [0, 2, 0], material: "
              "{albedo: [0, 0, 0, 0.5], refractive_index: 1.5, attenuation_color: [0.5, 0.25, 1]}}\n",
              sun, (struct lit){{half / 4 * pow(0.5, way), half / 4 * pow(0.25, way), half / 4}, false});
    // One inside another: the inner one's colour counts there, and each surface.
    check_lit(
        a, "a slab in a slab, a lamp",
        "materials:\n  outer: {albedo: [0, 0, 0, 0.5], refractive_index: 1.5, attenuation_color: [0.5, 1, "
        "1]}\n"
        "  inner: {albedo: [0, 0, 0, 0.9], refractive_index: 1.2, attenuation_color: [1, 0.5, 1]}\nmodels:\n"
        "  - {mesh: slab.obj, scale: [1, 1, 3], rotation: [-90, 0, 0], translation: [0, 4, 0], material: "
        "outer}\n"
        "  - {mesh: slab.obj, scale: 0.9, rotation: [-90, 0, 0], translation: [0, 3, 0], material: inner}\n",
        lamp, (struct lit){{0.25 * 0.81 * pow(0.5, 2.1), 0.25 * 0.81 * pow(0.5, 0.9), 0.25 * 0.81}, true});
    check_lit(
        a, "a lamp in water",
        "models:\n  - {mesh: slab.obj, scale: [1, 1, 20], rotation: [-90, 0, 0], translation: [0, 19, 0], "
        "material: {albedo: [0, 0, 0, 0.5], refractive_index: 1.33, attenuation_color: [0.9, 1, 1]}}\n",
        lamp, (struct lit){{pow(0.9, 9.4), 1, 1}, false});
    const double r = share(1, 1.5, PI / 4, false), p = share(1, 1.5, PI / 4, true);
    const double slab = half * (1 - r) * (1 - r), pane = half * (1 - p);
    check_lit(a, "a slab, by Fresnel",
              "models:\n  - {mesh: slab.obj, rotation: [-90, 0, 0], translation: [0, 2, 0], material: "
              "{albedo: [0, 0, 0, 1], refractive_index: 1.5, fresnel: true}}\n",
              sun, (struct lit){{slab, slab, slab}, false});
    check_lit(a, "an open mesh, by Fresnel",
              "models:\n  - {mesh: pane.obj, translation: [0, 2, 0], material: "
              "{albedo: [0, 0, 0, 1], refractive_index: 1.5, fresnel: true}}\n",
              sun, (struct lit){{pane, pane, pane}, false});
    check_lit(a, "something opaque behind a slab",
              "spheres:\n  - {center: [0, 6, 0], radius: 1}\n"
              "models:\n  - {mesh: slab.obj, rotation: [-90, 0, 0], translation: [0, 2, 0], material: "
              "{albedo: [0, 0, 0, 1], refractive_index: 1.5}}\n",
              lamp, (struct lit){{0, 0, 0}, false});
}

// ---- files

static bool write_rows(struct analytic *a) {
    struct image image;
    struct strbuf bytes;
    if (!image_init(&image, 1, 2))
        return false;
    for (int i = 0; i < 3; i++)
        image.rgb[i] = 1;
    strbuf_init(&bytes);
    image_encode(&image, IMAGE_PNG,
                 (struct image_display){.tone = IR_TONE_CLIP, .transfer = IR_TRANSFER_NONE}, &bytes);
    str text = strbuf_view(&bytes);
    const bool good = !bytes.failed && analytic_write(a, "rows.png", text.ptr, text.len);
    strbuf_finish(&bytes);
    image_finish(&image);
    return good;
}

static const char slab_mesh[] = "v -40 -40 0\nv 40 -40 0\nv 40 40 0\nv -40 40 0\n"
                                "v -40 -40 -1\nv 40 -40 -1\nv 40 40 -1\nv -40 40 -1\n"
                                "f 1 2 3 4\nf 6 5 8 7\nf 5 1 4 8\nf 2 6 7 3\nf 4 3 7 8\nf 5 6 2 1\n";
static const char pane_mesh[] = "v -40 0 -40\nv 40 0 -40\nv 40 0 40\nv -40 0 40\nf 1 2 3 4\n";

int main(int argc, char **argv) {
    struct analytic a;
    int code = analytic_open(&a, argc, argv);
    if (code)
        return code;
    if (analytic_write(&a, "slab.obj", slab_mesh, strlen(slab_mesh)) &&
        analytic_write(&a, "pane.obj", pane_mesh, strlen(pane_mesh)) && write_rows(&a)) {
        check_slabs(&a);
        check_priority(&a);
        check_attenuation(&a);
        check_all_balls(&a);
        check_total(&a);
        check_window(&a);
        check_fresnel(&a);
        check_shine(&a);
    }
    return analytic_close(&a);
}
