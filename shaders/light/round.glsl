// Angles, discs and frames in the kernel's precision. Vulkan's own sine and cosine may be off by 2^-11, and there are none
// for doubles.

#ifdef DOUBLE_PRECISION
const REAL HALF_PI = 1.57079632679489661923lf;
#else
const REAL HALF_PI = 1.57079632679489661923;
#endif

// A divisor. Browsers' compilers replace division by a known number with a product with its inverse, which rounds
// differently.
#ifdef WEBGPU
#define BY(number) ((number) + float(OPAQUE_ZERO))
#else
#define BY(number) (number)
#endif

// Cosine and sine of an angle in quarter turns: by Taylor's series of the difference from the nearest whole number, so
// quarter turns are exact. Relative error from cutting off the series: 2e-9, or 1e-16 in double precision.
REAL2 turn_by(REAL quarters) {
    REAL nearest = floor(quarters + 0.5);
    REAL r = (quarters - nearest) * HALF_PI, z = r * r;
#ifdef DOUBLE_PRECISION
    REAL sine = 1.0 - z / 272.0, cosine = 1.0 - z / 240.0;
    sine = 1.0 - z / 210.0 * sine;
    cosine = 1.0 - z / 182.0 * cosine;
    sine = 1.0 - z / 156.0 * sine;
    cosine = 1.0 - z / 132.0 * cosine;
    sine = 1.0 - z / 110.0 * sine;
    cosine = 1.0 - z / 90.0 * cosine;
#else
    REAL sine = 1.0 - z / BY(110.0), cosine = 1.0 - z / BY(90.0);
#endif
    sine = 1.0 - z / BY(72.0) * sine;
    cosine = 1.0 - z / BY(56.0) * cosine;
    sine = 1.0 - z / BY(42.0) * sine;
    cosine = 1.0 - z / BY(30.0) * cosine;
    sine = 1.0 - z / BY(20.0) * sine;
    cosine = 1.0 - z / BY(12.0) * cosine;
    sine = r * (1.0 - z / BY(6.0) * sine);
    cosine = 1.0 - z / BY(2.0) * cosine;
    int turns = int(nearest) & 3;
    REAL2 turned = (turns & 1) == 0 ? REAL2(cosine, sine) : REAL2(-sine, cosine);
    return turns >= 2 ? -turned : turned;
}

// A point of the unit square as one of the unit disc; areas keep their ratios, and the middle is the middle (Shirley and
// Chiu 1997, "A Low Distortion Map Between Disk and Square").
REAL2 disc_point(vec2 point) {
    REAL x = 2.0 * REAL(point.x) - 1.0, y = 2.0 * REAL(point.y) - 1.0;
    bool wide = abs(x) > abs(y);
    REAL radius = wide ? x : y, other = wide ? y : x;
    REAL2 turned = turn_by(radius == 0.0 ? REAL(0.0) : 0.5 * other / radius);
    return (wide ? turned : turned.yx) * radius;
}

// Two unit vectors perpendicular to the unit vector `n` and to each other. They change abruptly only near an
// axis that no scene uses.
void frame_around(REAL3 n, out REAL3 a, out REAL3 b) {
    REAL3 axis = REAL3(9.0, 12.0, 20.0) / 25.0;
    if (abs(dot3(axis, n)) > 0.875)
        axis = REAL3(12.0, -9.0, 20.0) / 25.0;
    a = unit3(cross3(axis, n));
    b = cross3(n, a);
}

// across.x and across.y along the frame's vectors and `along` along n.
REAL3 turned_to(REAL3 n, REAL2 across, REAL along) {
    REAL3 a, b;
    frame_around(n, a, b);
    return a * across.x + b * across.y + n * along;
}
