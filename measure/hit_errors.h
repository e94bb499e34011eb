// First hits compared with those of the reference: wrong hits, acne, leaks, holes.
//
// A pixel is at a silhouette if one of its eight neighbours hits another body in the reference, or the same
// one at a distance that differs by more than a twentieth. It is at a shadow's edge if a neighbour of the
// same body is lit by other lights. Ownership: the caller's arrays. Thread safety: pure.
#ifndef GLINT_MEASURE_HIT_ERRORS_H
#define GLINT_MEASURE_HIT_ERRORS_H

#include "scene/hits.h"
#include "scene/scene.h"

// Where first hits differ from those of the reference, per million pixels.
struct hit_errors {
    bool known;
    double wrong_inside;  // another face hit, at silhouettes
    double wrong_outside; // and elsewhere
    double silhouette;    // pixels at silhouettes, which reports call the band
    double acne;          // dark although nothing is between hit and light, away from shadows' edges
    double leaks;         // lit although something is between
    double shadow_edge;   // lit differently at shadows' edges
    double holes;         // the background seen where the reference hits a closed body, not at silhouettes
    double wrong_second;  // another body hit by the mirrored or the refracted ray, not at silhouettes
};

// `scene`: the scene whose bodies the hits name; closed bodies cannot be seen through.
void hits_compare(uint32_t width, uint32_t height, const struct hit_pixel *device,
                  const struct hit_pixel *reference, const struct scene *scene, struct hit_errors *out);

// Pixels per million in which the background is seen, although neither the reference's pixel nor one of those
// around it sees any: 3 values per pixel each, the weight of the background in its path (0: not seen; NaN
// counts as seen).
double hits_escapes(uint32_t width, uint32_t height, const float *device, const double *reference);

#endif
