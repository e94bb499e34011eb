// Sine and cosine of an angle in degrees, with the same bits on every platform: the C library's differ
// between systems in the last place.
//
// Input: any finite angle, in degrees. Output: within 0.6 units in the last place of the true values; quarter
// turns give exactly 0 and 1 or -1 (never -0), and turn_sine(30) is exactly 0.5. NaN for what is not finite.
// Thread safety: pure.
#ifndef GLINT_CORE_TURN_H
#define GLINT_CORE_TURN_H

double turn_sine(double degrees);
double turn_cosine(double degrees);

#endif
