// Numbers with twice the digits of REAL, for the few decisions that REAL leaves open: double if it is available
// in single precision, else the unevaluated sum of two REALs.
//
// Dekker 1971, "A Floating-Point Technique for Extending the Available Precision", and Knuth 1997, section 4.2.2:
// exact sums and products by operations that must be neither fused nor reordered (tools/spirv_exact).
#if defined(DOUBLE_PRECISION) || defined(NO_DOUBLES)
struct WIDE {
    REAL high, low; // |low| is at most half a unit in the last place of high
};

#ifdef DOUBLE_PRECISION
const REAL WIDE_SPLIT = 134217729.0lf; // 2^27 + 1
#else
const REAL WIDE_SPLIT = 4097.0; // 2^12 + 1
#endif

// Requires |a| >= |b|, or a = 0.
WIDE wide_ordered(REAL a, REAL b) {
    REAL sum = a + b;
    return WIDE(sum, b - (sum - a));
}

WIDE wide_sum(REAL a, REAL b) {
    REAL sum = a + b, b_part = sum - a;
    return WIDE(sum, (a - (sum - b_part)) + (b - b_part));
}

WIDE wide_product(REAL a, REAL b) {
    REAL product = a * b;
    REAL a_shifted = WIDE_SPLIT * a, b_shifted = WIDE_SPLIT * b;
    REAL a_high = a_shifted - (a_shifted - a), b_high = b_shifted - (b_shifted - b);
    REAL a_low = a - a_high, b_low = b - b_high;
    return WIDE(product, a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low));
}

WIDE wide(REAL x) { return WIDE(x, 0.0); }
REAL narrow(WIDE x) { return x.high; }
bool is_positive(WIDE x) { return x.high > 0.0; }
WIDE minus(WIDE x) { return WIDE(-x.high, -x.low); }

WIDE plus(WIDE a, WIDE b) {
    WIDE sum = wide_sum(a.high, b.high);
    return wide_ordered(sum.high, sum.low + (a.low + b.low));
}

WIDE times(WIDE a, WIDE b) {
    WIDE product = wide_product(a.high, b.high);
    return wide_ordered(product.high, product.low + (a.high * b.low + a.low * b.high));
}

// Newton's correction of the quotient of REAL.
WIDE over(WIDE a, WIDE b) {
    REAL quotient = a.high / b.high;
    WIDE product = times(wide(quotient), b);
    REAL rest = ((a.high - product.high) - product.low) + a.low;
    return wide_ordered(quotient, rest / b.high);
}
#else
#define WIDE double
WIDE wide(REAL x) { return double(x); }
REAL narrow(WIDE x) { return float(x); }
bool is_positive(WIDE x) { return x > 0.0lf; }
WIDE minus(WIDE x) { return -x; }
WIDE plus(WIDE a, WIDE b) { return a + b; }
WIDE times(WIDE a, WIDE b) { return a * b; }
WIDE over(WIDE a, WIDE b) { return a / b; }
#endif

struct WIDE3 {
    WIDE x, y, z;
};

WIDE3 wide3(REAL3 v) { return WIDE3(wide(v.x), wide(v.y), wide(v.z)); }
REAL3 narrow3(WIDE3 v) { return REAL3(narrow(v.x), narrow(v.y), narrow(v.z)); }
WIDE3 plus3(WIDE3 a, WIDE3 b) { return WIDE3(plus(a.x, b.x), plus(a.y, b.y), plus(a.z, b.z)); }
WIDE3 minus3(WIDE3 a, WIDE3 b) {
    return WIDE3(plus(a.x, minus(b.x)), plus(a.y, minus(b.y)), plus(a.z, minus(b.z)));
}
WIDE3 times3(WIDE3 v, WIDE factor) { return WIDE3(times(v.x, factor), times(v.y, factor), times(v.z, factor)); }
WIDE wide_dot(WIDE3 a, WIDE3 b) { return plus(plus(times(a.x, b.x), times(a.y, b.y)), times(a.z, b.z)); }
WIDE wide_difference(WIDE a, WIDE b, WIDE c, WIDE d) { return plus(times(a, b), minus(times(c, d))); }
WIDE3 wide_cross(WIDE3 a, WIDE3 b) {
    return WIDE3(wide_difference(a.y, b.z, a.z, b.y), wide_difference(a.z, b.x, a.x, b.z),
                 wide_difference(a.x, b.y, a.y, b.x));
}
