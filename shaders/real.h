/* The number type of places, directions and distances: kernels compiled with DOUBLE_PRECISION trace in double
   precision, over trees of conservative single-precision boxes; colours stay single. Compiled by GLSL alone.
 */
#ifndef GLINT_SHADERS_REAL_H
#define GLINT_SHADERS_REAL_H

#ifdef DOUBLE_PRECISION
#define REAL  double
#define REAL2 dvec2
#define REAL3 dvec3
#else
#define REAL  float
#define REAL2 vec2
#define REAL3 vec3
#endif

#endif
