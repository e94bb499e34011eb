// bench_cones: how far a pixel's footprint by a ray's cone and by its differentials err, on a floor and in a
// ball that mirrors it, and what each takes.
//
// Cones as docs/language.md says ("Paint"); differentials after Igehy 1999 ("Tracing Ray Differentials"),
// with the axes of the ellipse that they span. Both look up the same levels in the same way. The picture of
// 256 samples without a filter is what is right.
#include "core/clock.h"
#include "core/vec3.h"
#include "picture/metrics/metrics.h"
#include "scene/view.h"

#include <stdio.h>
#include <stdlib.h>

enum {
    WIDTH = 240,
    HEIGHT = 180,
    SIDE = 64, // of the image
    LEVELS = 7,
    TAPS_MAX = 15,
    EXACT = 256, // samples
    ROUNDS = 7,
};

static const double REPEAT = 4; // images for each unit of the floor
static const vec3 SKY = {0.6, 0.7, 0.8};
static float texels[LEVELS][SIDE * SIDE][3];

// ---- the image

static void make_image(void) {
    for (int i = 0; i < SIDE * SIDE; i++)
        for (int k = 0; k < 3; k++) {
            const int x = i % SIDE, y = i / SIDE;
            const double odd = 0.9 - 0.1 * k, even = 0.1 + 0.15 * k + 0.2 * (x % 16) / 16;
            texels[0][i][k] = (float)((x / 16 + y / 16) % 2 ? odd : even);
        }
    for (int level = 1; level < LEVELS; level++) {
        const int side = SIDE >> level, before = 2 * side;
        for (int i = 0; i < side * side; i++)
            for (int k = 0; k < 3; k++) {
                float sum = 0;
                for (int j = 0; j < 4; j++)
                    sum += texels[level - 1][(2 * (i / side) + j / 2) * before + 2 * (i % side) + j % 2][k];
                texels[level][i][k] = sum / 4;
            }
    }
}

static vec3 texel(int level, int x, int y) {
    const int side = SIDE >> level;
    const float *t = texels[level][(y & (side - 1)) * side + (x & (side - 1))];
    return (vec3){(double)t[0], (double)t[1], (double)t[2]};
}

static vec3 mixed(vec3 a, vec3 b, double share) {
    return vec3_add(vec3_mul(a, 1 - share), vec3_mul(b, share));
}

static vec3 bilinear(int level, double u, double v) {
    const double x = (u - floor(u)) * (SIDE >> level) - 0.5, y = (v - floor(v)) * (SIDE >> level) - 0.5;
    const int i = (int)floor(x), j = (int)floor(y);
    return mixed(mixed(texel(level, i, j), texel(level, i + 1, j), x - i),
                 mixed(texel(level, i, j + 1), texel(level, i + 1, j + 1), x - i), y - j);
}

// Conjugate radii in images; as reference/paint.c.
static vec3 filtered(double u, double v, const double a[2], const double b[2]) {
    const double xx = a[0] * a[0] + b[0] * b[0], yy = a[1] * a[1] + b[1] * b[1],
                 xy = a[0] * a[1] + b[0] * b[1];
    const double part = (xx - yy) / 2, root = hypot(part, xy), longer = sqrt((xx + yy) / 2 + root),
                 shorter = fabs(a[0] * b[1] - a[1] * b[0]) / longer;
    const double way[2] = {part >= 0 ? root + part : xy, part >= 0 ? xy : root - part},
                 size = hypot(way[0], way[1]);
    const double parts = fmin(fmax(SIDE * longer / fmax(SIDE * shorter, 1), 1), TAPS_MAX);
    const int pairs = (int)ceil((parts - 1) / 2);
    const double end = pairs ? (parts - 2 * pairs + 1) / 2 : 1;
    const double pixels = SIDE * fmax(longer / TAPS_MAX, shorter),
                 level = pixels > 1 ? fmin(log2(pixels), LEVELS - 1) : 0;
    const int below = (int)level, above = below + 1 < LEVELS ? below + 1 : below;
    vec3 sum = {0, 0, 0};
    for (int i = -pairs; i <= pairs; i++) {
        const bool is_end = abs(i) == pairs;
        const double from_middle = is_end && i ? i + (i > 0 ? end - 1 : 1 - end) / 2 : i;
        const double at = size > 0 ? from_middle / parts * longer / size : 0;
        const double s = u + at * way[0], t = v + at * way[1];
        sum = vec3_add(sum, vec3_mul(mixed(bilinear(below, s, t), bilinear(above, s, t), level - below),
                                     is_end ? end : 1));
    }
    return vec3_mul(sum, 1 / parts);
}

// ---- rays

enum way {
    PLAIN,
    CONE,
    DIFFERENTIALS,
    WAYS
};

static const char *const way_names[] = {"no filter", "cone", "differentials"};

struct footprint {
    double width, spread;  // of a cone
    vec3 at[2], toward[2]; // derivatives of place and direction, for a pixel to the right and one up
};

struct stage {
    bool has_ball;
    struct view_camera camera;
};

static const vec3 BALL = {0, 1, 0};

// To a surface of normal n: the place moves in it.
static void transfer(struct footprint *f, vec3 d, double t, vec3 n) {
    f->width += f->spread * t;
    for (int k = 0; k < 2; k++) {
        const vec3 moved = vec3_add(f->at[k], vec3_mul(f->toward[k], t));
        f->at[k] = vec3_sub(moved, vec3_mul(d, vec3_dot(moved, n) / vec3_dot(d, n)));
    }
}

// Off a ball of radius 1.
static void mirror(struct footprint *f, vec3 d, vec3 n) {
    f->spread += 2 * f->width;
    for (int k = 0; k < 2; k++) {
        const double turned = vec3_dot(f->toward[k], n) + vec3_dot(d, f->at[k]);
        f->toward[k] = vec3_sub(
            f->toward[k], vec3_mul(vec3_add(vec3_mul(f->at[k], vec3_dot(d, n)), vec3_mul(n, turned)), 2));
    }
}

static void cone_axes(const struct footprint *f, vec3 d, double a[2], double b[2]) {
    const double flat = hypot(d.x, d.z), w = fabs(f->width) * REPEAT, facing = fmax(-d.y, 1e-6);
    const double x = flat > 0 ? d.x / flat : 1, z = flat > 0 ? d.z / flat : 0;
    a[0] = x * w / facing, a[1] = z * w / facing;
    b[0] = -z * w, b[1] = x * w;
}

// The ellipse's own axes, by the eigenvectors of J times its transpose.
static void ellipse_axes(const struct footprint *f, double a[2], double b[2]) {
    const vec3 p = vec3_mul(f->at[0], REPEAT), q = vec3_mul(f->at[1], REPEAT);
    const double xx = p.x * p.x + q.x * q.x, xz = p.x * p.z + q.x * q.z, zz = p.z * p.z + q.z * q.z;
    const double middle = (xx + zz) / 2, half = hypot((xx - zz) / 2, xz),
                 angle = 0.5 * atan2(2 * xz, xx - zz);
    const double longer = sqrt(middle + half), shorter = sqrt(fmax(middle - half, 0));
    a[0] = longer * cos(angle), a[1] = longer * sin(angle);
    b[0] = -shorter * sin(angle), b[1] = shorter * cos(angle);
}

static vec3 seen(const struct stage *scene, enum way way, double x, double y) {
    const struct view_camera *c = &scene->camera;
    const double pixel = 2 * c->tan_half_fov / HEIGHT;
    const vec3 v = vec3_add(c->forward, vec3_add(vec3_mul(c->right, (x - 0.5 * WIDTH) * pixel),
                                                 vec3_mul(c->up, (0.5 * HEIGHT - y) * pixel)));
    const double length = vec3_length(v);
    vec3 o = c->position, d = vec3_mul(v, 1 / length);
    struct footprint f = {.spread = pixel * vec3_dot(d, c->forward)};
    const vec3 steps[2] = {vec3_mul(c->right, pixel), vec3_mul(c->up, pixel)};
    for (int k = 0; way == DIFFERENTIALS && k < 2; k++)
        f.toward[k] = vec3_mul(vec3_sub(steps[k], vec3_mul(d, vec3_dot(d, steps[k]))), 1 / length);
    const vec3 to = vec3_sub(o, BALL);
    const double along = vec3_dot(to, d), root = along * along - (vec3_dot(to, to) - 1);
    if (scene->has_ball && root > 0 && -along - sqrt(root) > 0) {
        const double t = -along - sqrt(root);
        o = vec3_add(o, vec3_mul(d, t));
        const vec3 n = vec3_sub(o, BALL);
        if (way == DIFFERENTIALS) {
            transfer(&f, d, t, n);
            mirror(&f, d, n);
        } else if (way == CONE) {
            f.width += f.spread * t;
            f.spread += 2 * f.width;
        }
        d = vec3_sub(d, vec3_mul(n, 2 * vec3_dot(d, n)));
    } else if (scene->has_ball) {
        return SKY; // what is measured is the mirror's picture
    }
    if (!(d.y < -1e-9))
        return SKY;
    const double t = -o.y / d.y;
    const vec3 p = vec3_add(o, vec3_mul(d, t));
    double a[2], b[2];
    if (way == PLAIN)
        return bilinear(0, p.x * REPEAT, p.z * REPEAT);
    if (way == CONE) {
        f.width += f.spread * t;
        cone_axes(&f, d, a, b);
    } else {
        transfer(&f, d, t, (vec3){0, 1, 0});
        ellipse_axes(&f, a, b);
    }
    return filtered(p.x * REPEAT, p.z * REPEAT, a, b);
}

static void draw(const struct stage *scene, enum way way, uint32_t samples, float *rgb) {
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        vec3 sum = {0, 0, 0};
        for (uint32_t n = 0; n < samples; n++) {
            double x, y;
            view_sample_offset(n, &x, &y);
            sum = vec3_add(sum, seen(scene, way, i % WIDTH + x, i / WIDTH + y));
        }
        rgb[3 * i] = (float)(sum.x / samples);
        rgb[3 * i + 1] = (float)(sum.y / samples);
        rgb[3 * i + 2] = (float)(sum.z / samples);
    }
}

static double flip_of(const float *picture, const float *exact) {
    const struct measure_options options = measure_options_default();
    struct measure_result result;
    const bool good = measure_pictures(WIDTH, HEIGHT, picture, exact, &options, &result, NULL, NULL);
    return good ? metric_error(METRIC_FLIP, result.value[METRIC_FLIP]) : INFINITY;
}

static void report(const char *name, const struct stage *scene, float *picture, float *exact) {
    double best[WAYS] = {INFINITY, INFINITY, INFINITY}, flip[WAYS];
    draw(scene, PLAIN, EXACT, exact);
    for (int round = 0; round < ROUNDS; round++)
        for (int way = 0; way < WAYS; way++) {
            const double start = clock_seconds();
            draw(scene, (enum way)way, 1, picture);
            best[way] = fmin(best[way], clock_seconds() - start);
            flip[way] = flip_of(picture, exact);
        }
    for (int way = 0; way < WAYS; way++)
        printf("%-6s %-14s FLIP %.4f  %6.0f ns a pixel\n", name, way_names[way], flip[way],
               best[way] * 1e9 / (WIDTH * HEIGHT));
}

int main(void) {
    const size_t bytes = (size_t)WIDTH * HEIGHT * 3 * sizeof(float);
    float *picture = malloc(bytes), *exact = malloc(bytes);
    const vec3 right = {1, 0, 0};
    const struct stage ground = {false,
                                 {.position = {0.3, 1.2, 4},
                                  .right = right,
                                  .up = {0, 0.99, -0.14},
                                  .forward = {0, -0.14, -0.99},
                                  .tan_half_fov = 0.5}};
    const struct stage ball = {true,
                               {.position = {0.2, 1.5, 4},
                                .right = right,
                                .up = {0, 0.99, -0.14},
                                .forward = {0, -0.14, -0.99},
                                .tan_half_fov = 0.27}};
    if (!picture || !exact)
        return 1;
    make_image();
    report("floor", &ground, picture, exact);
    report("mirror", &ball, picture, exact);
    free(picture);
    free(exact);
    return 0;
}
