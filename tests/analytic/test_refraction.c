// Snell's law: spheres, a slab and a prism seen by where their rays end, total reflection at the critical
// angle, panes, and bodies of index 1 (docs/language.md, "Hit" and "Media").
#include "analytic_kit.h"
#include "core/angle.h"

#include <stdio.h>
#include <string.h>

// ---- a sphere: every ray followed to its end

struct ball {
    vec3 center;
    double radius, index, reflection, refraction;
    int max_depth;
};

// Sum over both branches; false where a ray passes the rim, or the critical angle, too near to tell.
static bool follow(const struct ball *ball, vec3 origin, vec3 direction, int depth, double weight,
                   double rgb[3]) {
    vec3 f = vec3_sub(ball->center, origin);
    double ahead = vec3_dot(f, direction);
    double rim = vec3_length(vec3_sub(f, vec3_mul(direction, ahead))) / ball->radius;
    bool starts_on = fabs(vec3_length(f) - ball->radius) < 1e-9;
    double t = analytic_sphere(origin, direction, ball->center, ball->radius, 1e-9);
    if (rim > 0.98 && rim < 1.02)
        return false;
    if (depth > ball->max_depth || t < 0 || (starts_on && ahead <= 0)) {
        // Beyond the depth a ray sees the background, which is black here.
        double sky[3] = {0, 0, 0};
        if (depth <= ball->max_depth)
            analytic_sky(origin, direction, sky);
        for (int i = 0; i < 3; i++)
            rgb[i] += weight * sky[i];
        return true;
    }
    vec3 p = analytic_at(origin, direction, t);
    vec3 n = vec3_mul(vec3_sub(p, ball->center), 1 / ball->radius);
    bool enters = vec3_dot(n, direction) < 0;
    double eta = enters ? 1 / ball->index : ball->index;
    n = enters ? n : vec3_neg(n);
    double c = -vec3_dot(direction, n), k = 1 - eta * eta * (1 - c * c);
    vec3 bent;
    if (fabs(k) < 0.01)
        return false;
    bool passes = analytic_refracted(direction, n, eta, &bent);
    double back = ball->reflection + (passes ? 0 : ball->refraction);
    return (back == 0 || follow(ball, p, analytic_mirrored(direction, n), depth + 1, weight * back, rgb)) &&
           (!passes || follow(ball, p, bent, depth + 1, weight * ball->refraction, rgb));
}

static bool ball_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    return follow(context, origin, direction, 0, 1, rgb);
}

static void check_ball(struct analytic *a, struct ball ball) {
    char scene[2048], name[256];
    snprintf(name, sizeof name, "a sphere of index %g, reflection %g, refraction %g, depth %d", ball.index,
             ball.reflection, ball.refraction, ball.max_depth);
    snprintf(scene, sizeof scene,
             "trace: {shadows: false, min_weight: 0, max_depth: %d}\n%sspheres:\n%s"
             "  - center: [%.17g, %.17g, %.17g]\n    radius: %.17g\n"
             "    material: {albedo: [0, 0, %.17g, %.17g], refractive_index: %.17g}\n",
             ball.max_depth, analytic_sky_lights, analytic_sky_sphere, ball.center.x, ball.center.y,
             ball.center.z, ball.radius, ball.reflection, ball.refraction, ball.index);
    struct analytic_picture picture = {.name = name,
                                       .scene = scene,
                                       .camera = {.position = {0.5, 1, 2}, .fov = 50},
                                       .color = ball_color,
                                       .context = &ball,
                                       .tolerance = 1e-5,
                                       .most_beside = 0.15};
    analytic_check(a, &picture);
}

static void check_balls(struct analytic *a) {
    const vec3 center = {0.25, 1, -2};
    check_ball(a, (struct ball){center, 1, 1.5, 0, 1, 16});
    check_ball(a, (struct ball){center, 1, 1.5, 0.25, 0.75, 4});
    check_ball(a, (struct ball){center, 1.25, 2.42, 0.5, 0.5, 3});
    check_ball(a, (struct ball){center, 1, 0.75, 0, 0.5, 16});   // the outside is denser
    check_ball(a, (struct ball){center, 1, 0.5, 0.25, 0.5, 16}); // its rim reflects totally
    check_ball(a, (struct ball){center, 1, 1, 0, 1, 16});
    check_ball(a, (struct ball){{0.5, 1, 2.25}, 1, 1.5, 0, 1, 16}); // the camera is inside
}

// ---- bodies with flat faces

static const char slab_mesh[] = "v -40 -40 0\nv 40 -40 0\nv 40 40 0\nv -40 40 0\n"
                                "v -40 -40 -1\nv 40 -40 -1\nv 40 40 -1\nv -40 40 -1\n"
                                "f 1 2 3 4\nf 6 5 8 7\nf 5 1 4 8\nf 2 6 7 3\nf 4 3 7 8\nf 5 6 2 1\n";
// Triangle with its edge at the top, symmetric about x = 0; base 2, height 2.
static const char prism_mesh[] = "v -1 -1 50\nv 1 -1 50\nv 0 1 50\nv -1 -1 -50\nv 1 -1 -50\nv 0 1 -50\n"
                                 "f 1 2 3\nf 5 4 6\nf 4 5 2 1\nf 2 5 6 3\nf 4 1 3 6\n";

struct slab {
    double index, front; // z of the front face; it is 1 thick
};

static bool slab_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct slab *slab = context;
    vec3 p = analytic_at(origin, direction, (slab->front - origin.z) / direction.z), inside;
    if (!analytic_refracted(direction, (vec3){0, 0, 1}, 1 / slab->index, &inside))
        return false;
    // The ray leaves parallel to how it came, displaced.
    analytic_sky(analytic_at(p, inside, -1 / inside.z), direction, rgb);
    return true;
}

static void check_slab(struct analytic *a, double index) {
    struct slab slab = {index, -2};
    char scene[2048];
    snprintf(scene, sizeof scene,
             "trace: {shadows: false}\n%sspheres:\n%smodels:\n"
             "  - mesh: slab.obj\n    translation: [0, 0, -2]\n"
             "    material: {albedo: [0, 0, 0, 1], refractive_index: %.17g}\n",
             analytic_sky_lights, analytic_sky_sphere, index);
    struct analytic_picture picture = {
        .name = "a slab",
        .scene = scene,
        .camera = {.position = {1, 2, 3}, .forward = {0.3, -0.2, -1}, .fov = 70},
        .color = slab_color,
        .context = &slab,
        .tolerance = 1e-5};
    analytic_check(a, &picture);
}

// Through the left face, then the right one; rays that meet the base inside are beside.
static bool prism_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const double index = *(const double *)context;
    const vec3 left = vec3_unit((vec3){-2, 1, 0}), right = vec3_unit((vec3){2, 1, 0}), top = {0, 1, 0};
    vec3 inside, out;
    double t = analytic_plane(origin, direction, top, left);
    vec3 p = analytic_at(origin, direction, t);
    if (fabs(p.y - 1) < 1e-3 || fabs(p.y + 1) < 1e-3)
        return false;
    if (t < 0 || fabs(p.y) > 1) {
        // Beside the left face: below or above the prism, since the camera stands far to the left of it.
        if (p.y < -1 &&
            analytic_at(origin, direction, analytic_plane(origin, direction, (vec3){0, -1, 0}, top)).x < 1.1)
            return false;
        analytic_sky(origin, direction, rgb);
        return true;
    }
    if (!analytic_refracted(direction, left, 1 / index, &inside))
        return false;
    t = analytic_plane(p, inside, top, right);
    p = analytic_at(p, inside, t);
    if (t < 0 || p.y < -0.999 || p.y > 0.999 || !analytic_refracted(inside, vec3_neg(right), index, &out))
        return false;
    analytic_sky(p, out, rgb);
    return true;
}

static void check_prism(struct analytic *a, double index) {
    char scene[2048];
    snprintf(scene, sizeof scene,
             "trace: {shadows: false}\n%sspheres:\n%smodels:\n"
             "  - {mesh: prism.obj, material: {albedo: [0, 0, 0, 1], refractive_index: %.17g}}\n",
             analytic_sky_lights, analytic_sky_sphere, index);
    struct analytic_picture picture = {.name = "a prism",
                                       .scene = scene,
                                       .camera = {{-6, -0.5, 0.5}, {1, 0.05, 0}, {0, 1, 0}, 25},
                                       .color = prism_color,
                                       .context = &index,
                                       .tolerance = 2e-5,
                                       .most_beside = 0.7};
    analytic_check(a, &picture);
}

// ---- total reflection

struct critical {
    double index, reflection, refraction;
};

// White from 45 degrees up, black from 45 degrees down, linear between: two rows.
static double two_rows(vec3 d) {
    double v = acos(d.y) / PI;
    return fmin(1, fmax(0, 1 - (v - 0.25) * 2));
}

static bool critical_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct critical *c = context;
    const vec3 down = {0, -1, 0};
    vec3 out;
    (void)origin;
    double seen = two_rows(analytic_mirrored(direction, down));
    double value = analytic_refracted(direction, down, c->index, &out)
                       ? c->reflection * seen + c->refraction * two_rows(out)
                       : (c->reflection + c->refraction) * seen;
    rgb[0] = rgb[1] = rgb[2] = value;
    return true;
}

static void check_critical(struct analytic *a, double index) {
    static const double offsets[] = {-0.1, -1e-3, -1e-4, -1e-5, 1e-5, 1e-4, 1e-3, 0.1};
    struct critical c = {index, 0.25, 0.5};
    char scene[1024], name[128];
    for (size_t i = 0; i < sizeof offsets / sizeof offsets[0]; i++) {
        double angle = asin(1 / index) + offsets[i];
        snprintf(name, sizeof name, "index %g, %g rad from the critical angle", index, offsets[i]);
        snprintf(scene, sizeof scene,
                 "trace: {max_depth: 0}\nbackground: {image: rows.png}\nmodels:\n"
                 "  - mesh: slab.obj\n    rotation: [-90, 0, 0]\n    translation: [0, 0.5, 0]\n"
                 "    material: {albedo: [0, 0, %.17g, %.17g], refractive_index: %.17g}\n",
                 c.reflection, c.refraction, index);
        // The camera stands within the slab, whose top is half a unit above; one direction for all pixels.
        struct analytic_picture picture = {
            .name = name,
            .scene = scene,
            .camera = {{0, 0, 0}, {sin(angle), cos(angle), 0}, {0, 1, 0}, 1e-5},
            .width = 8,
            .height = 8,
            .color = critical_color,
            .context = &c,
            // One rounding of the direction moves the ray that skims the surface by 1 % of its angle.
            .tolerance = 3e-5};
        analytic_check(a, &picture);
    }
}

// ---- normals that bend far from the face: where a ray would end on the wrong side, the face's own normal

struct bent {
    vec3 normal; // of the face z = 0, whose own is +z
    double index, reflection, refraction;
};

static bool bent_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct bent *b = context;
    const bool enters = direction.z < 0;
    const vec3 face = {0, 0, enters ? 1 : -1};
    vec3 n = vec3_unit(enters ? b->normal : vec3_neg(b->normal)), mirrored = analytic_mirrored(direction, n);
    double c = -vec3_dot(direction, n), eta = enters ? 1 / b->index : b->index;
    bool near = fabs(c) < 1e-3 || fabs(vec3_dot(mirrored, face)) < 1e-4;
    (void)origin;
    if (vec3_dot(mirrored, face) <= 0)
        mirrored = analytic_mirrored(direction, face);
    vec3 used = c <= 0 ? face : n, out;
    c = -vec3_dot(direction, used);
    near = near || fabs(1 - eta * eta * (1 - c * c)) < 1e-3;
    bool passes = analytic_refracted(direction, used, eta, &out);
    near = near || (passes && fabs(vec3_dot(out, face)) < 1e-4);
    if (passes && vec3_dot(out, face) >= 0) {
        near = near || fabs(1 - eta * eta * (1 - direction.z * direction.z)) < 1e-3;
        passes = analytic_refracted(direction, face, eta, &out);
    }
    rgb[0] = rgb[1] = rgb[2] = (b->reflection + (passes ? 0 : b->refraction)) * two_rows(mirrored) +
                               (passes ? b->refraction * two_rows(out) : 0);
    return !near;
}

static void check_bent(struct analytic *a, struct bent b, bool inside) {
    char scene[1024], mesh[1024], name[128];
    // The slab with one normal at the corners of its front.
    int length = snprintf(mesh, sizeof mesh,
                          "v -40 -40 0\nv 40 -40 0\nv 40 40 0\nv -40 40 0\n"
                          "v -40 -40 -9\nv 40 -40 -9\nv 40 40 -9\nv -40 40 -9\n"
                          "vn %.17g %.17g %.17g\nvn 0 0 -1\nvn -1 0 0\nvn 1 0 0\nvn 0 1 0\nvn 0 -1 0\n"
                          "f 1//1 2//1 3//1 4//1\nf 6//2 5//2 8//2 7//2\nf 5//3 1//3 4//3 8//3\n"
                          "f 2//4 6//4 7//4 3//4\nf 4//5 3//5 7//5 8//5\nf 5//6 6//6 2//6 1//6\n",
                          b.normal.x, b.normal.y, b.normal.z);
    snprintf(name, sizeof name, "normals %g %g %g, index %g, seen from %s", b.normal.x, b.normal.y,
             b.normal.z, b.index, inside ? "inside" : "outside");
    snprintf(scene, sizeof scene,
             "trace: {max_depth: 0}\nbackground: {image: rows.png}\nmodels:\n  - mesh: bent.obj\n"
             "    smooth: true\n    material: {albedo: [0, 0, %.17g, %.17g], refractive_index: %.17g}\n",
             b.reflection, b.refraction, b.index);
    struct analytic_picture picture = {
        .name = name,
        .scene = scene,
        .camera = {{0, 0, inside ? -3 : 3}, {0.1, 0.2, inside ? 1 : -1}, {0, 1, 0}, 120},
        .color = bent_color,
        .context = &b,
        .tolerance = 2e-5,
        .most_beside = 0.05};
    if (analytic_write(a, "bent.obj", mesh, (size_t)length))
        analytic_check(a, &picture);
}

static void check_all_bent(struct analytic *a) {
    static const vec3 bends[] = {{0, 0, 1}, {0, 0.5, 1}, {0.5, -2, 1}, {0, 5, 1}, {1, 0.3, 0.1}};
    for (size_t i = 0; i < sizeof bends / sizeof bends[0]; i++)
        for (int inside = 0; inside < 2; inside++) {
            check_bent(a, (struct bent){bends[i], 1.5, 0.25, 0.5}, inside);
            check_bent(a, (struct bent){bends[i], 0.7, 0.5, 0.25}, inside);
        }
}

// ---- what is not bent

// A picture with these bodies is `factor` times the one without, bit for bit.
static void check_straight(struct analytic *a, const char *name, const char *bodies, float factor) {
    struct image with, without;
    struct analytic_picture picture = {
        .name = name,
        .scene = "background: {image: noise.png, intensity: 0.75}\n",
        .camera = {.position = {0.3, 0.2, 4}, .forward = {-0.05, -0.04, -1}, .fov = 50}};
    char scene[2048];
    bool good = analytic_take(a, &picture, &without);
    snprintf(scene, sizeof scene, "%strace: {min_weight: 0}\n%s", picture.scene, bodies);
    picture.scene = scene;
    good = analytic_take(a, &picture, &with) && good;
    for (size_t i = 0; good && i < (size_t)without.width * without.height * 3; i++)
        without.rgb[i] *= factor;
    good = good && picture_variety(&with) > 1000;
    analytic_expect(a, good && picture_differences(&with, &without, name) == 0, name,
                    "not the picture without");
    image_finish(&with);
    image_finish(&without);
}

static void check_all_straight(struct analytic *a) {
    check_straight(a, "nothing", "", 1);
    check_straight(a, "a sphere of index 1",
                   "spheres:\n  - {center: [0, 0, 0], radius: 9, material: {albedo: [0, 0, 0, 1]}}\n"
                   "  - {center: [0, 0, 0], radius: 1, material: {albedo: [0, 0, 0, 1]}}\n",
                   1);
    check_straight(a, "a slab of index 1",
                   "models:\n  - {mesh: slab.obj, smooth: true, rotation: [5, 7, 11],"
                   " material: {albedo: [0, 0, 0, 1]}}\n",
                   1);
    check_straight(a, "a pane",
                   "rectangles:\n  - {corner: [-50, -50, -15], edge_u: [100, 0, 20], edge_v: [0, 100, 10],"
                   " material: {albedo: [0, 0, 0, 0.5], refractive_index: 1.5}}\n",
                   0.5f);
    check_straight(
        a, "three panes",
        "materials:\n  glass: {albedo: [0, 0, 0, 0.5], refractive_index: 2}\nrectangles:\n"
        "  - {corner: [-50, -50, -5], edge_u: [100, 0, 0], edge_v: [0, 100, 9], material: glass}\n"
        "  - {corner: [-50, -50, -6], edge_u: [100, 0, 0], edge_v: [0, 100, 9], material: glass}\n"
        "  - {corner: [-50, -50, -8], edge_u: [0, 100, 0], edge_v: [100, 0, 0], material: glass}\n",
        0.125f);
    check_straight(a, "an open mesh",
                   "models:\n  - {mesh: open.obj, smooth: true,"
                   " material: {albedo: [0, 0, 0, 0.5], refractive_index: 1.5}}\n",
                   0.5f);
}

static bool write_pictures(struct analytic *a) {
    static const uint8_t gray[2] = {255, 0};
    uint32_t state = 7;
    struct image image;
    struct strbuf bytes;
    bool good = true;
    for (int k = 0; k < 2; k++) {
        if (!image_init(&image, k ? 16 : 1, k ? 16 : 2))
            return false;
        for (uint32_t i = 0; i < image.width * image.height * 3; i++) {
            state = state * 1664525u + 1013904223u;
            image.rgb[i] = (k ? (float)(state >> 24) : (float)gray[i / 3]) / 255;
        }
        strbuf_init(&bytes);
        image_encode(&image, IMAGE_PNG,
                     (struct image_display){.tone = IR_TONE_CLIP, .transfer = IR_TRANSFER_NONE}, &bytes);
        str text = strbuf_view(&bytes);
        good = !bytes.failed && analytic_write(a, k ? "noise.png" : "rows.png", text.ptr, text.len) && good;
        strbuf_finish(&bytes);
        image_finish(&image);
    }
    return good;
}

int main(int argc, char **argv) {
    static const char open_mesh[] = "v -50 -50 0\nv 50 -50 5\nv 50 50 0\nv -50 50 0\nf 1 2 3\nf 1 3 4\n";
    struct analytic a;
    int code = analytic_open(&a, argc, argv);
    if (code)
        return code;
    check_balls(&a);
    if (analytic_write(&a, "slab.obj", slab_mesh, strlen(slab_mesh)) &&
        analytic_write(&a, "prism.obj", prism_mesh, strlen(prism_mesh)) &&
        analytic_write(&a, "open.obj", open_mesh, strlen(open_mesh)) && write_pictures(&a)) {
        check_slab(&a, 1.5);
        check_slab(&a, 2.42);
        check_slab(&a, 1);
        check_prism(&a, 1.2);
        check_prism(&a, 1.33);
        check_critical(&a, 1.5);
        check_critical(&a, 1.33);
        check_critical(&a, 2.42);
        check_all_bent(&a);
        check_all_straight(&a);
    }
    return analytic_close(&a);
}
