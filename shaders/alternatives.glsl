// Methods of other tracers, to compare with glint's own (docs/accuracy.md, "Alternatives"); compiled only with
// ALTERNATIVES, never into the kernels that make pictures.
//
// Offset: a ray leaves a surface from o + t d, moved along the geometric normal by a chosen length, and every
// hit at t > 0 counts. Cut: the triangle test of Moeller and Trumbore 1997, which rejects triangles with a
// small determinant.

// Flat; 0: glint's own starts.
layout(constant_id = CONSTANT_ALTERNATIVE_OFFSET) const float ALTERNATIVE_OFFSET = 0.0;
// As a fraction of the ray's length.
layout(constant_id = CONSTANT_ALTERNATIVE_DISTANCE) const float ALTERNATIVE_DISTANCE = 0.0;
// Flat, squared; 0: glint's own test.
layout(constant_id = CONSTANT_ALTERNATIVE_CUT) const float ALTERNATIVE_CUT = 0.0;
// 1: every hit at t > 0 counts, from glint's own starts; tests see what that lets through.
layout(constant_id = CONSTANT_ALTERNATIVE_START) const uint ALTERNATIVE_START = 0u;

bool alternative_moves() { return ALTERNATIVE_OFFSET > 0.0; }
bool alternative_cuts() { return ALTERNATIVE_CUT > 0.0; }
float alternative_offset(float t) { return max(ALTERNATIVE_OFFSET, ALTERNATIVE_DISTANCE * t); }
