// Small arithmetic with a fixed order of operations: own versions of dot, cross and the like, because the
// built-in ones may be reordered or fused by a driver. gamma(n) = n u / (1 - n u) with u = 2^-24, or 2^-53 in
// double precision, bounds the relative error of n roundings (Higham 2002, section 3.1).
#ifdef ALTERNATIVES
#include "alternatives.glsl"
#endif

#ifdef DOUBLE_PRECISION
const double GAMMA_1 = 1.1102230246251568e-16lf;
const double GAMMA_2 = 2.2204460492503136e-16lf;
const double GAMMA_3 = 3.3306690738754706e-16lf;
const double GAMMA_4 = 4.4408920985006281e-16lf;
const double GAMMA_5 = 5.5511151231257858e-16lf;
const double GAMMA_6 = 6.6613381477509439e-16lf;
const double GAMMA_7 = 7.7715611723761022e-16lf;
#else
const float GAMMA_1 = 5.9604648e-8;
const float GAMMA_2 = 1.1920930e-7;
const float GAMMA_3 = 1.7881397e-7;
const float GAMMA_4 = 2.3841864e-7;
const float GAMMA_5 = 2.9802331e-7;
const float GAMMA_6 = 3.5762799e-7;
const float GAMMA_7 = 4.1723270e-7;
#endif
const REAL FAR_AWAY = 3.0e38;
const float PI = 3.14159265358979;
#ifdef DOUBLE_PRECISION
const double REAL_PI = 3.14159265358979323846lf;
#else
const float REAL_PI = PI;
#endif

REAL dot3(REAL3 a, REAL3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

REAL3 cross3(REAL3 a, REAL3 b) {
    return REAL3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

REAL3 unit3(REAL3 v) { return v * (1.0 / sqrt(dot3(v, v))); }

// The larger and the smaller number, where neither may be NaN: lavapipe's own take three instructions,
// because of NaN.
#ifdef FETCH_TEXELS
float LARGER(float a, float b) { return a > b ? a : b; }
float SMALLER(float a, float b) { return a < b ? a : b; }
#ifdef DOUBLE_PRECISION
double LARGER(double a, double b) { return a > b ? a : b; }
double SMALLER(double a, double b) { return a < b ? a : b; }
#endif
#else
#define LARGER(a, b)  max(a, b)
#define SMALLER(a, b) min(a, b)
#endif

REAL largest3(REAL3 v) { return max(v.x, max(v.y, v.z)); }

// By bits, because a compiler may assume that NaN and infinity do not occur.
bool is_finite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }
bool is_finite3(vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

// The power of two that takes `x`, positive and normal, to 1 .. 2.
#ifdef DOUBLE_PRECISION
double inverse_power(double x) {
    return packDouble2x32(uvec2(0u, 0x7fe00000u - (unpackDouble2x32(x).y & 0x7ff00000u)));
}
#else
float inverse_power(float x) { return uintBitsToFloat(0x7f000000u - (floatBitsToUint(x) & 0x7f800000u)); }
#endif

// The number next to `x` in the direction of `outward`: up where it is positive, down where negative, `x`
// itself where zero.
#ifdef DOUBLE_PRECISION
double next_real(double x, double outward) {
    uvec2 bits = unpackDouble2x32(x);
    uvec2 away = uvec2(bits.x + 1u, bits.y + (bits.x == 0xffffffffu ? 1u : 0u));
    uvec2 towards = uvec2(bits.x - 1u, bits.y - (bits.x == 0u ? 1u : 0u));
    uvec2 moved = (x > 0.0lf) == (outward > 0.0lf) ? away : towards;
    moved = x == 0.0lf ? uvec2(0u, outward > 0.0lf ? 0x00100000u : 0x80100000u) : moved;
    return outward == 0.0lf ? x : packDouble2x32(moved);
}
#else
float next_real(float x, float outward) {
    int bits = floatBitsToInt(x);
    int away = bits + 1, towards = bits - 1;
    int moved = (x > 0.0) == (outward > 0.0) ? away : towards;
    moved = x == 0.0 ? (outward > 0.0 ? 0x00800000 : int(0x80800000u)) : moved;
    return outward == 0.0 ? x : intBitsToFloat(moved);
}
#endif

// arctan for |x| <= tan(pi/8): a minimax fit of degree 5 in x^2, relative error 6.3e-10.
float arctan_small(float x) {
    float z = x * x;
    float p = -0.060263052378973 * z + 0.105698288108559;
    p = p * z - 0.142395326703701;
    p = p * z + 0.199981830411381;
    p = p * z - 0.333333068930503;
    return x + x * (z * p);
}

// atan2 in -pi..pi; 0 at the origin. Vulkan's own may be off by 4096 units in the last place.
float arctan2(float y, float x) {
    float ax = abs(x), ay = abs(y);
    float big = max(ax, ay), small = min(ax, ay);
    // tan(pi/8) splits 0..1: atan(q) = pi/4 + atan((q - 1)/(q + 1)).
    bool upper = small > 0.414213562 * big;
    float quotient = upper ? (small - big) / (small + big) : small / big;
    quotient = big == 0.0 ? 0.0 : quotient;
    float angle = arctan_small(quotient);
    angle = upper ? angle + 0.785398163397448 : angle;
    angle = ay > ax ? 1.5707963267949 - angle : angle;
    angle = x < 0.0 ? PI - angle : angle;
    return y < 0.0 ? -angle : angle;
}

#ifdef DOUBLE_PRECISION
// arctan for |x| <= tan(pi/8), as twice that of half the angle, by Gregory's series: the truncation error is below
// 2e-17.
double arctan_small(double x) {
    double half_angle = x / (1.0 + sqrt(1.0 + x * x)), z = half_angle * half_angle, sum = 0.0;
    for (int k = 21; k > 0; k -= 2)
        sum = 1.0lf / double(k) - z * sum;
    return 2.0 * half_angle * sum;
}

// As of floats.
double arctan2(double y, double x) {
    double ax = abs(x), ay = abs(y);
    double big = max(ax, ay), small = min(ax, ay);
    bool upper = small > 0.41421356237309505lf * big;
    double quotient = upper ? (small - big) / (small + big) : small / big;
    quotient = big == 0.0 ? 0.0 : quotient;
    double angle = arctan_small(quotient);
    angle = upper ? angle + 0.25 * REAL_PI : angle;
    angle = ay > ax ? 0.5 * REAL_PI - angle : angle;
    angle = x < 0.0 ? REAL_PI - angle : angle;
    return y < 0.0 ? -angle : angle;
}
#endif

// max(0, cosine)^exponent, where cosine = 1 - loss: computed from loss, since 1 - loss lacks the digits that
// large exponents need; 0^0 = 1. ln(1 - x) = -2 artanh(x/(2 - x)), by a minimax fit of degree 4 in the square
// of the argument up to 1/3, relative error 4.1e-9.
float highlight(float loss, float exponent) {
    float s = loss / (2.0 - loss);
    float z = s * s;
    float p = 0.140788891833011 * z + 0.139825788722786;
    p = p * z + 0.200122976153560;
    p = p * z + 0.333331608206900;
    float near_one = -2.88539008177793 * (s + s * (z * p)); // 2/ln 2
    float cosine = max(1.0 - loss, 1.17549435e-38);
    float log2_cosine = loss < 0.5 ? near_one : log2(cosine);
    float power = exp2(max(exponent * log2_cosine, -200.0));
    power = loss < 1.0 ? power : 0.0;
    return exponent == 0.0 ? 1.0 : power;
}
