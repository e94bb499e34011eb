// LDR-FLIP: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020, "FLIP: A Difference
// Evaluator for Alternating Images".
//
// Colour: to YCxCz, filtered with the contrast sensitivity of the eye (section 4.1.1), clamped to the colours
// that can be shown, to L*a*b* with the Hunt effect, HyAB distance, redistributed to 0..1 (4.1.2, 4.1.3).
// Features: edges and points of the luminance (4.2). Together: colour^(1 - feature) (4.3). Filters are sums
// of products of one-dimensional filters, so each takes two passes.
#include "core/angle.h"
#include "core/heap.h"
#include "picture/metrics/metrics_internal.h"

#include "core/parallel.h"
#include "core/srgb.h"
#include "core/vec3.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double Q_COLOR = 0.7, P_COLOR = 0.4, P_SHOWN = 0.95; // of equation 6 and its redistribution
static const double FEATURE_WIDTH = 0.082, Q_FEATURE = 0.5;       // degrees; of section 4.2

enum {
    LANES = 3,
    // The filtered Y Cx Cz, two of scratch, the luminance, four of its derivatives.
    PLANE_FILTERED = 0,
    PLANE_SCRATCH = 3,
    PLANE_TERM,
    PLANE_LUMINANCE,
    PLANE_FEATURE, // edge and point strength
    PLANE_COUNT = PLANE_FEATURE + 2,
    PIXELS_A_PIECE = 4096,
};

struct color {
    double c[LANES];
};

// Linear sRGB to XYZ (IEC 61966-2-1's primaries and D65).
static const mat3 TO_XYZ = {{{0.41238656, 0.35759149, 0.18045049},
                             {0.21263682, 0.71518298, 0.07218020},
                             {0.01933062, 0.11919716, 0.95037259}}};

static struct color apply(const mat3 *m, struct color v) {
    struct color r;
    for (int i = 0; i < 3; i++)
        r.c[i] = m->m[i][0] * v.c[0] + m->m[i][1] * v.c[1] + m->m[i][2] * v.c[2];
    return r;
}

static mat3 inverse(const mat3 *a) {
    mat3 out;
    double det = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            out.m[k][i] = a->m[(i + 1) % 3][(k + 1) % 3] * a->m[(i + 2) % 3][(k + 2) % 3] -
                          a->m[(i + 1) % 3][(k + 2) % 3] * a->m[(i + 2) % 3][(k + 1) % 3];
    for (int i = 0; i < 3; i++)
        det += a->m[0][i] * out.m[i][0];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            out.m[i][k] /= det;
    return out;
}

static double white(int i) {
    return TO_XYZ.m[i][0] + TO_XYZ.m[i][1] + TO_XYZ.m[i][2];
}

static struct color to_opponent(const float *displayed) {
    struct color rgb = {{srgb_decode((double)displayed[0]), srgb_decode((double)displayed[1]),
                         srgb_decode((double)displayed[2])}};
    struct color xyz = apply(&TO_XYZ, rgb);
    for (int i = 0; i < 3; i++)
        xyz.c[i] /= white(i);
    return (struct color){{116 * xyz.c[1] - 16, 500 * (xyz.c[0] - xyz.c[1]), 200 * (xyz.c[1] - xyz.c[2])}};
}

static struct color from_opponent(struct color o, const mat3 *from_xyz) {
    const double y = (o.c[0] + 16) / 116;
    struct color xyz = {{(y + o.c[1] / 500) * white(0), y * white(1), (y - o.c[2] / 200) * white(2)}};
    struct color rgb = apply(from_xyz, xyz);
    for (int i = 0; i < 3; i++)
        rgb.c[i] = fmin(fmax(rgb.c[i], 0), 1);
    return rgb;
}

static double lab_curve(double t) {
    const double delta = 6.0 / 29;
    return t > delta * delta * delta ? cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
}

// L* and a*, b* times 0.01 L*: the Hunt effect.
static struct color hunt_lab(struct color rgb) {
    struct color xyz = apply(&TO_XYZ, rgb);
    const double x = lab_curve(xyz.c[0] / white(0)), y = lab_curve(xyz.c[1] / white(1));
    const double z = lab_curve(xyz.c[2] / white(2)), lightness = 116 * y - 16;
    return (struct color){{lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)}};
}

static double hyab(struct color p, struct color q) {
    return fabs(p.c[0] - q.c[0]) + hypot(p.c[1] - q.c[1], p.c[2] - q.c[2]);
}

// A contrast sensitivity function in space: two Gaussians, a * sqrt(pi/b) * exp(-pi^2 r^2 / b), table 1.
struct sensitivity {
    double a[2], b[2];
};
static const struct sensitivity SENSITIVITY[LANES] = {
    {{1, 0}, {0.0047, 1e-5}}, {{1, 0}, {0.0053, 1e-5}}, {{34.1, 13.5}, {0.04, 0.025}}};

static int filter_radius(double degrees, double pixels_per_degree) {
    const double radius = ceil(degrees * pixels_per_degree);
    return radius < FILTER_RADIUS_MAX ? (int)radius : FILTER_RADIUS_MAX;
}

static double gaussian(struct filter *filter, int radius, double b, double pixels_per_degree) {
    double sum = 0;
    filter->radius = radius;
    for (int k = -radius; k <= radius; k++) {
        const double x = k / pixels_per_degree;
        sum += filter->weight[k + radius] = exp(-PI * PI * x * x / b);
    }
    return sum;
}

// One channel, filtered with its sensitivity in place; the filter's weights sum to 1 over the square.
static void filter_channel(struct plane_size size, const struct sensitivity *s, double pixels_per_degree,
                           float *plane, float *planes, struct filter *filter) {
    const size_t count = (size_t)size.width * size.height;
    const int radius = filter_radius(3 * sqrt(0.04 / (2 * PI * PI)), pixels_per_degree);
    float *term = planes + PLANE_TERM * count, *scratch = planes + PLANE_SCRATCH * count;
    double share[2], total = 0;
    for (int k = 0; k < 2; k++) {
        const double sum = s->a[k] > 0 ? gaussian(filter, radius, s->b[k], pixels_per_degree) : 0;
        total += share[k] = s->a[k] * sqrt(PI / s->b[k]) * sum * sum;
    }
    memcpy(term, plane, count * sizeof *term);
    memset(plane, 0, count * sizeof *plane);
    // The second Gaussian filters the original channel: `planes` has room for a copy, which the first
    // Gaussian does not change.
    float *filtered = planes + PLANE_FEATURE * count;
    for (int k = 0; k < 2; k++) {
        if (share[k] == 0)
            continue;
        const double sum = gaussian(filter, radius, s->b[k], pixels_per_degree);
        for (int i = 0; i <= 2 * radius; i++)
            filter->weight[i] /= sum;
        filter_plane(size, term, filter, filter, scratch, filtered);
        for (size_t i = 0; i < count; i++)
            plane[i] += (float)(share[k] / total * (double)filtered[i]);
    }
}

// The first (edges) or second (points) derivative of a Gaussian: positive weights sum to 1, negative to -1.
static void derivative(struct filter *filter, double sigma, int radius, bool second) {
    double positive = 0, negative = 0;
    filter->radius = radius;
    for (int k = -radius; k <= radius; k++) {
        const double g = exp(-k * k / (2 * sigma * sigma));
        const double w = second ? (k * k / (sigma * sigma) - 1) * g : -k * g;
        filter->weight[k + radius] = w;
        *(w > 0 ? &positive : &negative) += fabs(w);
    }
    for (int i = 0; i <= 2 * radius; i++)
        filter->weight[i] /= filter->weight[i] > 0 ? positive : negative;
}

// Strength of edges or points of the luminance: the length of the two derivatives.
static void find_features(struct plane_size size, double pixels_per_degree, bool second, float *planes,
                          struct filter *filters, float *strength) {
    const size_t count = (size_t)size.width * size.height;
    const double sigma = 0.5 * FEATURE_WIDTH * pixels_per_degree;
    const int radius = filter_radius(3 * 0.5 * FEATURE_WIDTH, pixels_per_degree);
    const float *luminance = planes + PLANE_LUMINANCE * count;
    float *scratch = planes + PLANE_SCRATCH * count, *term = planes + PLANE_TERM * count;
    derivative(&filters[0], sigma, radius, second);
    double sum = 0;
    filters[1].radius = radius;
    for (int k = -radius; k <= radius; k++)
        sum += filters[1].weight[k + radius] = exp(-k * k / (2 * sigma * sigma));
    for (int i = 0; i <= 2 * radius; i++)
        filters[1].weight[i] /= sum;
    filter_plane(size, luminance, &filters[0], &filters[1], scratch, term);
    filter_plane(size, luminance, &filters[1], &filters[0], scratch, strength);
    for (size_t i = 0; i < count; i++)
        strength[i] = hypotf(term[i], strength[i]);
}

struct preparing {
    const float *picture;
    float *planes;
    size_t count;
};

static void prepare_pixels(void *context, size_t begin, size_t end) {
    const struct preparing *p = context;
    for (size_t i = begin; i < end; i++) {
        struct color o = to_opponent(p->picture + 3 * i);
        for (size_t k = 0; k < LANES; k++)
            p->planes[(PLANE_FILTERED + k) * p->count + i] = (float)o.c[k];
        p->planes[PLANE_LUMINANCE * p->count + i] = (float)((o.c[0] + 16) / 116);
    }
}

static void prepare(struct plane_size size, const float *picture, double pixels_per_degree,
                    struct filter *filters, float *planes) {
    const size_t count = (size_t)size.width * size.height;
    struct preparing context = {picture, planes, count};
    parallel_for(count, PIXELS_A_PIECE, prepare_pixels, &context);
    for (size_t k = 0; k < LANES; k++)
        filter_channel(size, &SENSITIVITY[k], pixels_per_degree, planes + (PLANE_FILTERED + k) * count,
                       planes, filters);
    for (size_t k = 0; k < 2; k++)
        find_features(size, pixels_per_degree, k == 1, planes, filters, planes + (PLANE_FEATURE + k) * count);
}

// Equation 6 and the piecewise linear redistribution after it.
static double color_error(double distance, double largest) {
    const double error = pow(distance, Q_COLOR), most = pow(largest, Q_COLOR), knee = P_COLOR * most;
    return error < knee ? P_SHOWN / knee * error : P_SHOWN + (error - knee) / (most - knee) * (1 - P_SHOWN);
}

struct comparing {
    const float *a, *b; // planes
    size_t count;
    mat3 from_xyz;
    double largest; // distance of two colours
    float *map;
};

static void compare_pixels(void *context, size_t begin, size_t end) {
    const struct comparing *c = context;
    const float *a = c->a, *b = c->b;
    for (size_t i = begin; i < end; i++) {
        struct color p, q;
        for (size_t k = 0; k < LANES; k++) {
            p.c[k] = (double)a[(PLANE_FILTERED + k) * c->count + i];
            q.c[k] = (double)b[(PLANE_FILTERED + k) * c->count + i];
        }
        p = hunt_lab(from_opponent(p, &c->from_xyz));
        q = hunt_lab(from_opponent(q, &c->from_xyz));
        const size_t edge = PLANE_FEATURE * c->count + i, point = edge + c->count;
        const double feature =
            fmax(fabs((double)a[edge] - (double)b[edge]), fabs((double)a[point] - (double)b[point]));
        c->map[i] =
            (float)pow(color_error(hyab(p, q), c->largest), 1 - fmin(pow(feature / sqrt(2), Q_FEATURE), 1));
    }
}

bool flip_measure(struct plane_size size, const float *picture, const float *reference,
                  double pixels_per_degree, double *mean, float *map) {
    const size_t count = heap_times(size.width, size.height);
    float *planes = heap_array(heap_times(heap_times(2, PLANE_COUNT), count), sizeof *planes);
    struct filter *filters = heap_array(2, sizeof *filters);
    if (planes && filters) {
        struct comparing context = {
            .a = planes, .b = planes + PLANE_COUNT * count, .count = count, .map = map};
        context.largest = hyab(hunt_lab((struct color){{0, 1, 0}}), hunt_lab((struct color){{0, 0, 1}}));
        context.from_xyz = inverse(&TO_XYZ);
        prepare(size, picture, pixels_per_degree, filters, planes);
        prepare(size, reference, pixels_per_degree, filters, planes + PLANE_COUNT * count);
        parallel_for(count, PIXELS_A_PIECE, compare_pixels, &context);
        double sum = 0;
        for (size_t i = 0; i < count; i++)
            sum += (double)map[i];
        *mean = sum / (double)count;
    }
    const bool good = planes && filters;
    free(planes);
    free(filters);
    return good;
}
