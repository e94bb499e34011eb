// Constants for angles, which C's own headers do not guarantee.
#ifndef GLINT_CORE_ANGLE_H
#define GLINT_CORE_ANGLE_H

#define PI      3.14159265358979323846
#define RADIANS (PI / 180) // per degree

#endif
