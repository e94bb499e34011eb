// What other tracers do, to be measured beside glint's own ways (docs/accuracy.md, "Study variants"); compiled
// only with STUDY, never into the kernels that make pictures.
//
// Offset: a ray leaves a surface from o + t d, moved along the geometric normal by a length that is chosen, and
// a hit counts from t > 0 on. Cut: the triangle test of Moeller and Trumbore 1997, which refuses triangles of a
// small determinant.
layout(constant_id = CONSTANT_STUDY_OFFSET) const float STUDY_OFFSET = 0.0;     // flat; 0: glint's own starts
layout(constant_id = CONSTANT_STUDY_DISTANCE) const float STUDY_DISTANCE = 0.0; // of the way that the ray came
layout(constant_id = CONSTANT_STUDY_CUT) const float STUDY_CUT = 0.0; // flat, squared; 0: glint's own test

bool study_moves() { return STUDY_OFFSET > 0.0; }
bool study_cuts() { return STUDY_CUT > 0.0; }
float study_offset(float t) { return max(STUDY_OFFSET, STUDY_DISTANCE * t); }
