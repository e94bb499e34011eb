#include "assets/made/plane.h"

#include "core/vec3.h"

enum {
    PRODUCTS = 6,
};

// Relative rounding of the two products and their difference: (3 + 16 e) e, where e is 2^-53.
#define FILTER 3.3306690738754716e-16

double plane_distance(struct ir_pair a, struct ir_pair b) {
    return vec3_length((vec3){b.u - a.u, b.v - a.v, 0});
}

struct ir_pair plane_direction(struct ir_pair a, struct ir_pair b) {
    const vec3 unit = vec3_unit((vec3){b.u - a.u, b.v - a.v, 0});
    return (struct ir_pair){unit.x, unit.y};
}

// Adds a number to a sum of `count` numbers that do not overlap, the smallest first; the result is exact and
// has one number more.
static void grow(double *sum, int count, double value) {
    for (int i = 0; i < count; i++) {
        const double total = value + sum[i];
        const double part = total - value;
        sum[i] = (value - (total - part)) + (sum[i] - part);
        value = total;
    }
    sum[count] = value;
}

static int exact_side(struct ir_pair a, struct ir_pair b, struct ir_pair c) {
    const double factors[PRODUCTS][2] = {{a.u, b.v},  {-a.v, b.u}, {b.u, c.v},
                                         {-b.v, c.u}, {c.u, a.v},  {-c.v, a.u}};
    double sum[2 * PRODUCTS];
    int count = 0;
    for (int i = 0; i < PRODUCTS; i++) {
        const double product = factors[i][0] * factors[i][1];
        grow(sum, count++, fma(factors[i][0], factors[i][1], -product));
        grow(sum, count++, product);
    }
    while (count > 0 && sum[count - 1] == 0)
        count--;
    return count == 0 ? 0 : sum[count - 1] > 0 ? 1 : -1;
}

int plane_side(struct ir_pair a, struct ir_pair b, struct ir_pair c) {
    const double left = (a.u - c.u) * (b.v - c.v);
    const double right = (a.v - c.v) * (b.u - c.u);
    const double area = left - right;
    if (fabs(area) > FILTER * (fabs(left) + fabs(right)))
        return area > 0 ? 1 : -1;
    return exact_side(a, b, c);
}

struct ir_pair plane_crossing(struct ir_pair a, struct ir_pair b, struct ir_pair c, struct ir_pair d) {
    const struct ir_pair along = plane_sub(b, a);
    const struct ir_pair other = plane_sub(d, c);
    const double across = plane_cross(along, other);
    const double share = across != 0 ? plane_cross(plane_sub(c, a), other) / across : 0;
    return plane_mix(a, b, fmin(fmax(share, 0), 1));
}
