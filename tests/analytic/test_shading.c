// Diffuse light and highlights of one wall (docs/language.md, "Hit"): each kind of light, each weight,
// exponents from 0 to a million, and sums over lights in their order.
#include "analytic_kit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_LIGHTS = 3
};

struct light {
    bool directional, inverse_square;
    vec3 place; // or the way light travels
    double intensity;
    vec3 color;
};

struct wall {
    double a_d, a_s, exponent;
    vec3 diffuse, specular;
    struct light lights[MOST_LIGHTS];
    int light_count;
    vec3 normal; // either side
    double fov;
};

// Middle of the wall, a square of 12 by 12.
static const vec3 WALL_POINT = {0, 0, -4};
static const double HALF = 6;

static vec3 edge_u(const struct wall *wall) {
    return vec3_unit(vec3_cross((vec3){0, 1, 0.125}, wall->normal));
}
static vec3 edge_v(const struct wall *wall) {
    return vec3_unit(vec3_cross(wall->normal, edge_u(wall)));
}

// How much light l of this strength adds, by channel.
static void add_light(const struct wall *wall, const struct light *light, vec3 p, vec3 direction, vec3 n,
                      double rgb[3]) {
    vec3 way = light->directional ? vec3_neg(light->place) : vec3_sub(light->place, p);
    vec3 l = vec3_unit(way);
    double facing = vec3_dot(n, l), strength = light->intensity;
    if (light->inverse_square)
        strength /= vec3_dot(way, way);
    if (facing <= 0)
        return;
    vec3 r = vec3_sub(vec3_mul(n, 2 * facing), l);
    double along = fmax(0, vec3_dot(r, vec3_neg(direction)));
    double highlight = wall->a_s == 0 ? 0 : wall->a_s * pow(along, wall->exponent);
    const double diffuse[3] = {wall->diffuse.x, wall->diffuse.y, wall->diffuse.z};
    const double specular[3] = {wall->specular.x, wall->specular.y, wall->specular.z};
    const double color[3] = {light->color.x, light->color.y, light->color.z};
    for (int i = 0; i < 3; i++)
        rgb[i] += strength * color[i] * (wall->a_d * diffuse[i] * facing + specular[i] * highlight);
}

static bool wall_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct wall *wall = context;
    vec3 n = vec3_unit(wall->normal);
    double t = analytic_plane(origin, direction, WALL_POINT, n);
    vec3 p = analytic_at(origin, direction, t), own = vec3_sub(p, WALL_POINT);
    double side = fmax(fabs(vec3_dot(own, edge_u(wall))), fabs(vec3_dot(own, edge_v(wall)))) - HALF;
    if (t < 0 || side > 0)
        return fabs(side) > 1e-3;
    n = vec3_dot(n, direction) <= 0 ? n : vec3_neg(n);
    for (int i = 0; i < wall->light_count; i++)
        add_light(wall, &wall->lights[i], p, direction, n, rgb);
    return true;
}

static void check_wall(struct analytic *a, const char *name, const struct wall *wall, double tolerance) {
    char scene[4096];
    struct strbuf text;
    const vec3 u = vec3_mul(edge_u(wall), 2 * HALF), v = vec3_mul(edge_v(wall), 2 * HALF);
    strbuf_init(&text);
    if (wall->light_count)
        strbuf_cstr(&text, "lights:\n");
    for (int i = 0; i < wall->light_count; i++) {
        const struct light *l = &wall->lights[i];
        strbuf_format(
            &text, "  - {%s: [%.17g, %.17g, %.17g], intensity: %.17g, color: [%.17g, %.17g, %.17g]%s}\n",
            l->directional ? "direction" : "position", l->place.x, l->place.y, l->place.z, l->intensity,
            l->color.x, l->color.y, l->color.z, l->inverse_square ? ", falloff: inverse_square" : "");
    }
    strbuf_format(&text,
                  "rectangles:\n  - corner: [%.17g, %.17g, %.17g]\n    edge_u: [%.17g, %.17g, %.17g]\n"
                  "    edge_v: [%.17g, %.17g, %.17g]\n    material: {albedo: [%.17g, %.17g, 0, 0],"
                  " diffuse_color: [%.17g, %.17g, %.17g], specular_color: [%.17g, %.17g, %.17g],"
                  " specular_exponent: %.17g}\n",
                  -(u.x + v.x) / 2, -(u.y + v.y) / 2, WALL_POINT.z - (u.z + v.z) / 2, u.x, u.y, u.z, v.x, v.y,
                  v.z, wall->a_d, wall->a_s, wall->diffuse.x, wall->diffuse.y, wall->diffuse.z,
                  wall->specular.x, wall->specular.y, wall->specular.z, wall->exponent);
    snprintf(scene, sizeof scene, "%.*s", STR_ARG(strbuf_view(&text)));
    strbuf_finish(&text);
    struct analytic_picture picture = {.name = name,
                                       .scene = scene,
                                       .camera = {.fov = wall->fov},
                                       .color = wall_color,
                                       .context = wall,
                                       .tolerance = tolerance,
                                       .most_beside = 0.05};
    analytic_check(a, &picture);
}

static const struct light lamp = {false, false, {1.5, 1, -2}, 0.75, {1, 0.5, 0.25}};
static const struct light near_lamp = {false, true, {-1, -0.5, -3}, 3, {0.25, 1, 0.5}};
static const struct light sun = {true, false, {0.3, -0.6, -1}, 0.5, {1, 1, 0.5}};

static void check_kinds(struct analytic *a) {
    struct wall wall = {.a_d = 0.9,
                        .exponent = 8,
                        .diffuse = {0.9, 0.6, 0.3},
                        .specular = {0.2, 0.7, 1},
                        .lights = {lamp, near_lamp, sun},
                        .normal = {0, 0, 1},
                        .fov = 60};
    static const struct light *const kinds[] = {&lamp, &near_lamp, &sun};
    static const char *const names[] = {"a point light", "inverse square", "a directional light"};
    // Next to a lamp, a rounding of the point hit weighs more.
    for (int i = 0; i < 3; i++) {
        wall.lights[0] = *kinds[i];
        wall.light_count = 1;
        wall.a_s = 0, wall.a_d = 0.9;
        check_wall(a, names[i], &wall, kinds[i]->inverse_square ? 1e-5 : 2e-6);
        wall.a_s = 0.6;
        check_wall(a, names[i], &wall, kinds[i]->inverse_square ? 1e-5 : 2e-6);
        wall.a_d = 0;
        check_wall(a, names[i], &wall, kinds[i]->inverse_square ? 1e-5 : 2e-6);
    }
    wall.a_d = 0.5, wall.a_s = 10, wall.light_count = 3; // weights above 1 are in use
    wall.lights[0] = lamp, wall.lights[1] = near_lamp, wall.lights[2] = sun;
    check_wall(a, "three lights", &wall, 2e-5);
    wall.normal = (vec3){0.4, -0.3, 1};
    check_wall(a, "a turned wall", &wall, 2e-5);
    wall.normal = (vec3){-0.4, 0.3, -1};
    check_wall(a, "its other side", &wall, 2e-5);
    wall.lights[0].place = (vec3){1.5, 1, -12};
    wall.lights[2].place = (vec3){0.3, -0.6, 1};
    check_wall(a, "lights behind the wall", &wall, 2e-5);
    // So far away that it is a direction to the kernel; its strength stays.
    wall.lights[0] = (struct light){false, false, {2e15, 1e15, 5e15}, 0.5, {1, 1, 1}};
    wall.lights[1] = (struct light){false, true, {-2e15, 1e15, 5e15}, 1e6, {1, 1, 1}};
    wall.lights[2] = (struct light){false, false, {1e6, -3e5, 2e6}, 0.5, {1, 1, 1}};
    wall.a_s = 1;
    check_wall(a, "lights far away", &wall, 2e-5);
}

static void check_exponents(struct analytic *a) {
    // An error of the highlight's angle weighs e times.
    static const struct {
        double exponent, tolerance;
    } cases[] = {{0, 2e-6}, {0.5, 2e-6}, {1, 2e-6}, {2, 2e-6}, {32, 4e-6}, {1000, 4e-5}, {1e6, 2e-3}};
    struct wall wall = {.a_s = 1,
                        .diffuse = {1, 1, 1},
                        .specular = {1, 0.5, 2},
                        .lights = {{true, false, {0, 0, -1}, 1, {1, 1, 1}}, lamp},
                        .light_count = 1,
                        .normal = {0, 0, 1},
                        .fov = 60};
    char name[64];
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        snprintf(name, sizeof name, "exponent %g", cases[i].exponent);
        // The highlight in the middle of the picture, which it fills whatever its size.
        wall.exponent = cases[i].exponent;
        wall.normal = (vec3){0.2, 0.1, 1};
        wall.lights[0].place = analytic_mirrored((vec3){0, 0, -1}, vec3_unit(wall.normal));
        wall.lights[0].place = vec3_neg(wall.lights[0].place);
        wall.fov = wall.exponent < 4 ? 60 : 240 / sqrt(wall.exponent);
        check_wall(a, name, &wall, cases[i].tolerance);
        // r points away from the viewer over most of the picture: 0^0 = 1 still.
        wall.normal = (vec3){0, 1, 0.25};
        wall.lights[0].place = (vec3){-0.1, -0.3, -1};
        wall.fov = 60;
        check_wall(a, name, &wall, cases[i].tolerance);
    }
}

// 1 + 2^-24 + 2^-24 is 1 in floats, and 2^-24 + 2^-24 + 1 is not.
static void check_order(struct analytic *a, bool strong_first, float wanted) {
    char scene[1024];
    const double strengths[3] = {strong_first ? 1 : 0x1p-24, 0x1p-24, strong_first ? 0x1p-24 : 1};
    int length = snprintf(scene, sizeof scene, "trace: {shadows: false}\nlights:\n");
    for (int i = 0; i < 3; i++)
        length += snprintf(scene + length, sizeof scene - (size_t)length,
                           "  - {direction: [0, 0, -1], intensity: %.17g}\n", strengths[i]);
    snprintf(scene + length, sizeof scene - (size_t)length,
             "rectangles:\n  - {corner: [-64, -64, -4], edge_u: [128, 0, 0], edge_v: [0, 128, 0],"
             " material: {diffuse_color: 1}}\n");
    struct analytic_picture picture = {.name = "order of lights", .scene = scene};
    struct image image;
    bool good = analytic_take(a, &picture, &image);
    for (size_t i = 0; good && i < (size_t)image.width * image.height * 3; i++)
        good = image.rgb[i] == wanted;
    analytic_expect(a, good, picture.name, "the lights do not add in index order");
    image_finish(&image);
}

// A plain sum of ten thousand floats is wrong in the fourth digit.
static void check_many(struct analytic *a, bool shadows) {
    enum {
        LIGHTS = 10000,
        LIGHT_BYTES = 64
    };
    const size_t size = LIGHTS * LIGHT_BYTES + 1024;
    char *scene = malloc(size);
    const float each = 0x1.5p-14f;
    size_t length =
        (size_t)snprintf(scene, size, "trace: {shadows: %s}\nlights:\n", shadows ? "true" : "false");
    for (int i = 0; i < LIGHTS; i++)
        length += (size_t)snprintf(scene + length, size - length,
                                   "  - {direction: [0, 0, -1], intensity: %.9g}\n", (double)each);
    snprintf(scene + length, size - length,
             "rectangles:\n  - {corner: [-64, -64, -4], edge_u: [128, 0, 0], edge_v: [0, 128, 0],"
             " material: {diffuse_color: 1}}\n");
    struct analytic_picture picture = {.name = "many lights", .scene = scene, .width = 16, .height = 8};
    struct image image;
    bool good = analytic_take(a, &picture, &image);
    const double wanted = (double)LIGHTS * (double)each;
    for (size_t i = 0; good && i < (size_t)image.width * image.height * 3; i++)
        good = fabs((double)image.rgb[i] / wanted - 1) < 2e-7;
    analytic_expect(a, good, picture.name, "the sum loses digits");
    image_finish(&image);
    free(scene);
}

int main(int argc, char **argv) {
    struct analytic a;
    int code = analytic_open(&a, argc, argv);
    if (code)
        return code;
    check_kinds(&a);
    check_exponents(&a);
    check_many(&a, false);
    check_many(&a, true);
    if (!a.kit.by_reference) { // whose sums are exact here
        check_order(&a, true, 1);
        check_order(&a, false, 1 + 0x1p-23f);
    }
    return analytic_close(&a);
}
