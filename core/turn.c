// The angle is reduced to -45..45 degrees without rounding, turned into radians as the sum of two doubles,
// and put into Taylor's series. The first terms, which decide the last place, are sums of two doubles too:
// by Dekker's product and Knuth's sum (T. J. Dekker, "A floating-point technique for extending the available
// precision", 1971). Only additions, multiplications and fmod, all of them exact or rounded by IEEE 754.
#include "core/turn.h"

#include <math.h>

// The sum of two doubles, the second below the last place of the first.
struct pair {
    double high, low;
};

static struct pair sum(double a, double b) {
    const double s = a + b, of_b = s - a;
    return (struct pair){s, (a - (s - of_b)) + (b - of_b)};
}

static struct pair halves(double a) {
    const double shifted = a * 134217729; // 2^27 + 1
    const double high = shifted - (shifted - a);
    return (struct pair){high, a - high};
}

static struct pair product(double a, double b) {
    const struct pair x = halves(a), y = halves(b);
    const double p = a * b;
    return (struct pair){p, ((x.high * y.high - p) + x.high * y.low + x.low * y.high) + x.low * y.low};
}

static struct pair times(struct pair a, struct pair b) {
    struct pair p = product(a.high, b.high);
    p.low += a.high * b.low + a.low * b.high;
    return sum(p.high, p.low);
}

// pi / 180
static const struct pair RADIAN = {0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62};

// Both of at most 45 degrees.
static double near_sine(double degrees) {
    const struct pair a = times((struct pair){degrees, 0}, RADIAN), squared = times(a, a);
    const struct pair cubed =
        times(times(a, squared), (struct pair){-0x1.5555555555555p-3, -0x1.5555555555555p-57});
    const double z = squared.high;
    // 1/5! - z/7! + ...
    const double rest = 0x1.1111111111111p-7 +
                        z * (-0x1.a01a01a01a01ap-13 +
                             z * (0x1.71de3a556c734p-19 +
                                  z * (-0x1.ae64567f544e4p-26 +
                                       z * (0x1.6124613a86d09p-33 +
                                            z * (-0x1.ae7f3e733b81fp-41 + z * 0x1.952c77030ad4ap-49)))));
    const struct pair first = sum(a.high, cubed.high);
    return first.high + (first.low + (a.low + cubed.low + a.high * z * z * rest));
}

static double near_cosine(double degrees) {
    const struct pair a = times((struct pair){degrees, 0}, RADIAN), squared = times(a, a);
    const double z = squared.high;
    // 1/4! - z/6! + ...
    const double rest = 0x1.5555555555555p-5 +
                        z * (-0x1.6c16c16c16c17p-10 +
                             z * (0x1.a01a01a01a01ap-16 +
                                  z * (-0x1.27e4fb7789f5cp-22 +
                                       z * (0x1.1eed8eff8d898p-29 +
                                            z * (-0x1.93974a8c07c9dp-37 + z * 0x1.ae7f3e733b81fp-45)))));
    const struct pair first = sum(1, -0.5 * squared.high);
    return first.high + (first.low + (-0.5 * squared.low + z * z * rest));
}

// `quarters` quarter turns later.
static double sine_later(double degrees, int quarters) {
    double rest = fmod(degrees, 360);
    const int nearest = rest < 0 ? (int)(rest / 90 - 0.5) : (int)(rest / 90 + 0.5);
    rest -= 90 * nearest;
    const int quarter = (nearest + quarters) & 3;
    const double value = quarter & 1 ? near_cosine(rest) : near_sine(rest);
    return (quarter & 2 ? -value : value) + 0.0; // no -0
}

double turn_sine(double degrees) {
    return isfinite(degrees) ? sine_later(degrees, 0) : NAN;
}

double turn_cosine(double degrees) {
    return isfinite(degrees) ? sine_later(degrees, 1) : NAN;
}
