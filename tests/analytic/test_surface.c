// What a surface is at a point: checker cells, interpolated normals, sides, and which of two surfaces in one
// place is seen (docs/language.md, "Checker" and "Hit").
#include "analytic_kit.h"
#include "core/angle.h"

#include <stdio.h>
#include <string.h>

// ---- checker

// White light from the camera's side on a body without shadows: cosine times the cell's colour.
static const char lamp_scene[] = "trace: {shadows: false}\nlights:\n  - {direction: [0.25, -0.5, -1]}\n";
static const vec3 TO_LIGHT = {-0.25, 0.5, 1};
static const double EVEN[3] = {0.9, 0.1, 0.3}, ODD[3] = {0.2, 0.8, 0.6};
#define CHECKER "{diffuse_color: {checker: {colors: [[0.9, 0.1, 0.3], [0.2, 0.8, 0.6]], size: %g}}}"

static double cell(double q, double size, bool *near) {
    double x = q / size;
    *near = *near || fabs(x - nearbyint(x)) < 1e-4;
    return floor(x);
}

static void shade(double cells, vec3 normal, double rgb[3]) {
    double facing = fmax(0, vec3_dot(vec3_unit(normal), vec3_unit(TO_LIGHT)));
    for (int i = 0; i < 3; i++)
        rgb[i] = facing * (fmod(cells, 2) != 0 ? ODD[i] : EVEN[i]);
}

struct sheet {
    vec3 corner, u, v;
    double size;
};

static bool sheet_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct sheet *s = context;
    vec3 n = vec3_cross(s->u, s->v);
    vec3 p =
        vec3_sub(analytic_at(origin, direction, analytic_plane(origin, direction, s->corner, n)), s->corner);
    // p = a u + b v
    double uu = vec3_dot(s->u, s->u), uv = vec3_dot(s->u, s->v), vv = vec3_dot(s->v, s->v);
    double pu = vec3_dot(p, s->u), pv = vec3_dot(p, s->v), det = uu * vv - uv * uv;
    double a = (pu * vv - pv * uv) / det, b = (pv * uu - pu * uv) / det;
    double outside = fmax(fmax(-a, a - 1), fmax(-b, b - 1));
    bool near = fabs(outside) < 1e-4;
    if (outside > 0)
        return !near;
    n = vec3_dot(n, direction) <= 0 ? n : vec3_neg(n);
    shade(cell(a * vec3_length(s->u), s->size, &near) + cell(b * vec3_length(s->v), s->size, &near), n, rgb);
    return !near;
}

static void check_sheets(struct analytic *a) {
    static const struct sheet sheets[] = {
        {{-2, -1.5, -4}, {4, 0, 0}, {0, 3, 0}, 0.5},
        {{-2, -1.5, -4}, {0, 3, 0}, {4, 0, 0}, 0.75},             // seen from its back
        {{2, 1, -5}, {-4.5, 0.25, 0.5}, {0.7, -2.5, 1}, 0.6},     // not at a right angle
        {{-20, -1, 0.5}, {40, 0, 0}, {0, 0, -40}, 1.5},           // a floor
        {{-0.25, -0.5, -1}, {0.5, 0, 0}, {0, 1, -0.25}, 0.03125}, // many cells
        {{-2, -1.5, -4}, {4, 0, 0}, {0, 3, 0}, 100},              // less than one
    };
    char scene[1024];
    for (size_t i = 0; i < sizeof sheets / sizeof sheets[0]; i++) {
        const struct sheet *s = &sheets[i];
        snprintf(scene, sizeof scene,
                 "%srectangles:\n  - corner: [%.17g, %.17g, %.17g]\n    edge_u: [%.17g, %.17g, %.17g]\n"
                 "    edge_v: [%.17g, %.17g, %.17g]\n    material: " CHECKER "\n",
                 lamp_scene, s->corner.x, s->corner.y, s->corner.z, s->u.x, s->u.y, s->u.z, s->v.x, s->v.y,
                 s->v.z, s->size);
        struct analytic_picture picture = {.name = "checker of a rectangle",
                                           .scene = scene,
                                           .width = 96,
                                           .height = 64,
                                           .color = sheet_color,
                                           .context = s,
                                           .tolerance = 1e-6,
                                           .most_beside = 0.02};
        analytic_check(a, &picture);
    }
}

struct globe {
    vec3 center;
    double radius, size;
};

static bool globe_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct globe *g = context;
    double t = analytic_sphere(origin, direction, g->center, g->radius, 0);
    double rim = vec3_length(vec3_cross(direction, vec3_sub(g->center, origin))) / g->radius;
    if (t < 0 || fabs(rim - 1) < 1e-3)
        return fabs(rim - 1) > 1e-3;
    bool near = false;
    vec3 q = vec3_sub(analytic_at(origin, direction, t), g->center);
    vec3 n = vec3_dot(q, direction) <= 0 ? q : vec3_neg(q);
    shade(cell(q.x, g->size, &near) + cell(q.y, g->size, &near) + cell(q.z, g->size, &near), n, rgb);
    return !near;
}

static void check_globes(struct analytic *a) {
    static const struct globe globes[] = {
        {{0.5, -0.25, -5}, 2, 0.5}, {{100.125, 3, -400}, 150, 20}, {{0.25, 0, 0.5}, 3, 1}};
    char scene[1024];
    for (size_t i = 0; i < sizeof globes / sizeof globes[0]; i++) {
        const struct globe *g = &globes[i];
        snprintf(scene, sizeof scene,
                 "%sspheres:\n  - {center: [%.17g, %.17g, %.17g], radius: %.17g, material: " CHECKER "}\n",
                 lamp_scene, g->center.x, g->center.y, g->center.z, g->radius, g->size);
        struct analytic_picture picture = {.name = "checker of a sphere",
                                           .scene = scene,
                                           .color = globe_color,
                                           .context = g,
                                           .tolerance = 2e-6,
                                           .most_beside = 0.05};
        analytic_check(a, &picture);
    }
}

// ---- a triangle in the plane z = 0 of its mesh, placed

static const char triangle_mesh[] = "v -1 -1 0\nv 1 -1 0\nv 0 1.5 0\n"
                                    "vn -0.6 -0.3 1\nvn 2 0.1 3\nvn 0.1 0.5 0.7\nf 1//1 2//2 3//3\n";
static const vec3 corners[3] = {{-1, -1, 0}, {1, -1, 0}, {0, 1.5, 0}};
static const vec3 normals[3] = {{-0.6, -0.3, 1}, {2, 0.1, 3}, {0.1, 0.5, 0.7}};

struct placed {
    vec3 scale, rotation, translation;
    bool smooth;
    double size; // of the checker
};

static vec3 turned(vec3 v, vec3 degrees) {
    double x = degrees.x * RADIANS, y = degrees.y * RADIANS, z = degrees.z * RADIANS;
    v = (vec3){v.x, v.y * cos(x) - v.z * sin(x), v.y * sin(x) + v.z * cos(x)};
    v = (vec3){v.x * cos(y) + v.z * sin(y), v.y, -v.x * sin(y) + v.z * cos(y)};
    return (vec3){v.x * cos(z) - v.y * sin(z), v.x * sin(z) + v.y * cos(z), v.z};
}

static vec3 scaled(vec3 v, vec3 s) {
    return (vec3){v.x * s.x, v.y * s.y, v.z * s.z};
}

// The normal of a placed plane or vertex: by the inverse transpose, a rotation being its own.
static vec3 normal_of(const struct placed *m, vec3 own) {
    return vec3_unit(turned((vec3){own.x / m->scale.x, own.y / m->scale.y, own.z / m->scale.z}, m->rotation));
}

static vec3 place_of(const struct placed *m, vec3 own) {
    return vec3_add(turned(scaled(own, m->scale), m->rotation), m->translation);
}

static bool placed_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct placed *m = context;
    vec3 p[3];
    for (int i = 0; i < 3; i++)
        p[i] = place_of(m, corners[i]);
    vec3 area = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
    double t = analytic_plane(origin, direction, p[0], area);
    vec3 at = analytic_at(origin, direction, t), n = {0, 0, 0};
    double least = 1;
    for (int i = 0; i < 3; i++) {
        vec3 a = p[(i + 1) % 3], b = p[(i + 2) % 3];
        double share = vec3_dot(vec3_cross(vec3_sub(b, a), vec3_sub(at, a)), area) / vec3_dot(area, area);
        least = fmin(least, share);
        n = vec3_add(n, vec3_mul(normal_of(m, normals[i]), share));
    }
    bool near = fabs(least) < 1e-4;
    if (t < 0 || least < 0)
        return !near;
    vec3 flat = vec3_dot(area, direction) <= 0 ? area : vec3_neg(area);
    n = m->smooth ? (vec3_dot(n, flat) >= 0 ? n : vec3_neg(n)) : flat;
    if (vec3_dot(vec3_unit(flat), vec3_unit(TO_LIGHT)) <= 0)
        return !near;
    shade(0, n, rgb);
    return !near;
}

static void check_triangle(struct analytic *a, struct placed m) {
    char scene[1024];
    snprintf(scene, sizeof scene,
             "%smodels:\n  - mesh: triangle.obj\n    smooth: %s\n    scale: [%.17g, %.17g, %.17g]\n"
             "    rotation: [%.17g, %.17g, %.17g]\n    translation: [%.17g, %.17g, %.17g]\n"
             "    material: {diffuse_color: [0.9, 0.1, 0.3]}\n",
             lamp_scene, m.smooth ? "true" : "false", m.scale.x, m.scale.y, m.scale.z, m.rotation.x,
             m.rotation.y, m.rotation.z, m.translation.x, m.translation.y, m.translation.z);
    struct analytic_picture picture = {.name = m.smooth ? "interpolated normals" : "flat normals",
                                       .scene = scene,
                                       .camera = {.fov = 45},
                                       .color = placed_color,
                                       .context = &m,
                                       .tolerance = 2e-6,
                                       .most_beside = 0.05};
    analytic_check(a, &picture);
}

static void check_triangles(struct analytic *a) {
    static const struct placed places[] = {
        {{1, 1, 1}, {0, 0, 0}, {0, 0, -4}, false, 0},
        {{2, 0.75, 1}, {20, 30, 10}, {0.25, 0, -4.5}, false, 0},
        {{-1.5, 1, 2}, {20, -30, 10}, {0.25, 0, -4.5}, false, 0}, // mirrored
        {{1.5, 1, 1}, {10, 170, -20}, {0, 0, -4}, false, 0},      // from behind
        {{1, 1, 1}, {62, 0, 0}, {0, 0, -4}, false, 0},
        // The light is behind the face, and before the normals at its tip.
        {{1, 1, 1}, {67, 0, 0}, {0, 0, -4}, false, 0},
    };
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        struct placed m = places[i];
        check_triangle(a, m);
        m.smooth = true;
        check_triangle(a, m);
    }
}

// ---- a cuboid with a checker in its own coordinates

static const char box_mesh[] = "v -0.9 -0.6 -0.3\nv 0.9 -0.6 -0.3\nv 0.9 0.6 -0.3\nv -0.9 0.6 -0.3\n"
                               "v -0.9 -0.6 0.3\nv 0.9 -0.6 0.3\nv 0.9 0.6 0.3\nv -0.9 0.6 0.3\n"
                               "f 5 6 7 8\nf 2 1 4 3\nf 1 5 8 4\nf 6 2 3 7\nf 8 7 3 4\nf 1 2 6 5\n";

static bool box_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    static const double half[3] = {0.9, 0.6, 0.3};
    const struct placed *m = context;
    double nearest = HUGE_VAL;
    bool near = false;
    for (int axis = 0; axis < 6; axis++) {
        double own_normal[3] = {0, 0, 0};
        own_normal[axis / 2] = axis % 2 ? -1 : 1;
        vec3 o = {own_normal[0], own_normal[1], own_normal[2]};
        vec3 n = normal_of(m, o), on_face = place_of(m, vec3_mul(o, half[axis / 2]));
        double t = analytic_plane(origin, direction, on_face, n);
        if (t < 0 || t >= nearest)
            continue;
        // Back through rotation and scale: by dot products with the turned axes.
        vec3 p = vec3_sub(analytic_at(origin, direction, t), m->translation);
        double q[3] = {vec3_dot(p, turned((vec3){1, 0, 0}, m->rotation)) / m->scale.x,
                       vec3_dot(p, turned((vec3){0, 1, 0}, m->rotation)) / m->scale.y,
                       vec3_dot(p, turned((vec3){0, 0, 1}, m->rotation)) / m->scale.z};
        double outside = -1;
        for (int i = 0; i < 3; i++)
            if (i != axis / 2)
                outside = fmax(outside, fabs(q[i]) - half[i]);
        near = near || fabs(outside) < 1e-4;
        if (outside > 0)
            continue;
        nearest = t;
        bool border = false;
        double cells = 0;
        for (int i = 0; i < 3; i++)
            cells += cell(q[i], m->size, &border);
        near = near || border;
        shade(cells, vec3_dot(n, direction) <= 0 ? n : vec3_neg(n), rgb);
    }
    return !near;
}

static void check_boxes(struct analytic *a) {
    static const struct placed boxes[] = {{{1, 1, 1}, {0, 0, 0}, {0, 0, -3}, false, 0.25},
                                          {{1.5, 0.75, 2}, {25, -35, 50}, {0.25, 0.125, -4}, false, 0.25},
                                          {{-1, 1, 1}, {-100, 200, 10}, {-0.25, 0.125, -3}, false, 0.4}};
    char scene[1024];
    for (size_t i = 0; i < sizeof boxes / sizeof boxes[0]; i++) {
        const struct placed *m = &boxes[i];
        snprintf(scene, sizeof scene,
                 "%smodels:\n  - mesh: box.obj\n    scale: [%.17g, %.17g, %.17g]\n"
                 "    rotation: [%.17g, %.17g, %.17g]\n    translation: [%.17g, %.17g, %.17g]\n"
                 "    material: " CHECKER "\n",
                 lamp_scene, m->scale.x, m->scale.y, m->scale.z, m->rotation.x, m->rotation.y, m->rotation.z,
                 m->translation.x, m->translation.y, m->translation.z, m->size);
        struct analytic_picture picture = {.name = "checker of a model",
                                           .scene = scene,
                                           .camera = {.fov = 45},
                                           .color = box_color,
                                           .context = m,
                                           .tolerance = 2e-6,
                                           .most_beside = 0.05};
        analytic_check(a, &picture);
    }
}

// ---- surfaces in one place, and the order of bodies

#define RED   "material: {diffuse_color: [1, 0, 0]}"
#define GREEN "material: {diffuse_color: [0, 1, 0]}"
#define QUAD  "corner: [-1, -1, -3], edge_u: [2, 0, 0.3], edge_v: [0.2, 2, 0]"
#define BALL  "center: [0.1, 0.2, -3], radius: 1"

// Nothing of the other colour is seen.
static void check_tie(struct analytic *a, const char *bodies, bool red) {
    char scene[2048];
    snprintf(scene, sizeof scene, "%s%s", lamp_scene, bodies);
    struct analytic_picture picture = {
        .name = bodies, .scene = scene, .width = 96, .height = 64, .camera = {.fov = 45}};
    struct image image;
    bool good = analytic_take(a, &picture, &image) && picture_variety(&image) > 500;
    for (size_t i = 0; good && i < (size_t)image.width * image.height; i++)
        good = image.rgb[3 * i + (red ? 1 : 0)] == 0;
    analytic_expect(a, good, bodies, "the lower body does not win everywhere");
    image_finish(&image);
}

static void check_ties(struct analytic *a) {
    // The quad of the mesh is cut as a rectangle is, into (1 2 3) and (1 3 4).
    static const char quad[] = "v -1 -1 -3\nv 1 -1 -2.7\nv 1.2 1 -2.7\nv -0.8 1 -3\nf 1 2 3 4\n";
    if (!analytic_write(a, "quad.obj", quad, strlen(quad)))
        return;
    check_tie(a, "rectangles:\n  - {" QUAD ", " RED "}\n  - {" QUAD ", " GREEN "}\n", true);
    check_tie(a, "rectangles:\n  - {" QUAD ", " GREEN "}\n  - {" QUAD ", " RED "}\n", false);
    check_tie(a, "spheres:\n  - {" BALL ", " RED "}\n  - {" BALL ", " GREEN "}\n", true);
    check_tie(a, "spheres:\n  - {" BALL ", " GREEN "}\n  - {" BALL ", " RED "}\n", false);
    check_tie(a, "models:\n  - {mesh: quad.obj, " GREEN "}\nrectangles:\n  - {" QUAD ", " RED "}\n", true);
    check_tie(a, "models:\n  - {mesh: quad.obj, " GREEN "}\n  - {mesh: quad.obj, " RED "}\n", false);
}

// Where no two surfaces coincide, the order in the file does not show.
static void check_order(struct analytic *a) {
    static const char *const parts[] = {
        "  - {center: [-1, 0, -4], radius: 0.8, material: {albedo: [0, 0.5, 0.1, 0.8], refractive_index: "
        "1.5}}\n",
        "  - {center: [0.4, 0.2, -5], radius: 1, material: {albedo: [0.5, 0.3, 0.5, 0]}}\n",
        "  - {center: [0.2, -0.5, -2.5], radius: 0.3, material: {diffuse_color: [0.9, 0.4, 0.1]}}\n",
        "  - {corner: [-9, -1, 2], edge_u: [18, 0, 0], edge_v: [0, 0, -18], material: {albedo: [0.6, 0, 0.4, "
        "0]}}\n",
        "  - {corner: [-2, -1, -6], edge_u: [4, 0.1, 0], edge_v: [0, 3, 0.2], material: {albedo: [0, 0, 1, "
        "0]}}\n",
        "  - {corner: [0.5, -0.9, -2], edge_u: [0.7, 0, 0.1], edge_v: [0, 1, 0], material: {albedo: [0, 0, "
        "0, 0.9]}}\n",
        "  - {mesh: box.obj, rotation: [20, 30, 5], translation: [1.2, 0.6, -3.4], material: {albedo: [0.3, "
        "0, 0, 0.7]}}\n",
        "  - {mesh: box.obj, rotation: [7, 3, 50], scale: 0.4, translation: [-0.4, 0.7, -2.3]}\n",
        "  - {mesh: triangle.obj, smooth: true, scale: 0.5, translation: [-0.9, -0.4, -2.6]}\n",
    };
    static const int orders[3][3] = {{0, 1, 2}, {2, 1, 0}, {1, 2, 0}};
    struct image images[3];
    bool good = true;
    for (int k = 0; k < 3; k++) {
        char scene[4096] = "background: {color: [0.2, 0.5, 0.8]}\nlights:\n  - {position: [3, 5, 2]}\n";
        size_t length = strlen(scene);
        for (int kind = 0; kind < 3; kind++) {
            static const char *const keys[3] = {"spheres", "rectangles", "models"};
            length += (size_t)snprintf(scene + length, sizeof scene - length, "%s:\n", keys[kind]);
            for (int i = 0; i < 3; i++)
                length += (size_t)snprintf(scene + length, sizeof scene - length, "%s",
                                           parts[3 * kind + orders[k][i]]);
        }
        struct analytic_picture picture = {
            .name = "order of bodies", .scene = scene, .width = 96, .height = 64, .samples = 2};
        good = analytic_take(a, &picture, &images[k]) && good;
    }
    good = good && picture_variety(&images[0]) > 1000;
    for (int k = 1; k < 3; k++)
        analytic_expect(a, good && picture_differences(&images[0], &images[k], "order of bodies") == 0,
                        "order of bodies", "it shows");
    for (int k = 0; k < 3; k++)
        image_finish(&images[k]);
}

int main(int argc, char **argv) {
    struct analytic a;
    int code = analytic_open(&a, argc, argv);
    if (code)
        return code;
    check_sheets(&a);
    check_globes(&a);
    if (analytic_write(&a, "triangle.obj", triangle_mesh, strlen(triangle_mesh)) &&
        analytic_write(&a, "box.obj", box_mesh, strlen(box_mesh))) {
        check_triangles(&a);
        check_boxes(&a);
        check_ties(&a);
        check_order(&a);
    }
    return analytic_close(&a);
}
