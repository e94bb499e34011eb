// Numbers of angles, which C's own headers do not promise.
#ifndef GLINT_CORE_ANGLE_H
#define GLINT_CORE_ANGLE_H

#define PI      3.14159265358979323846
#define RADIANS (PI / 180) // of a degree

#endif
