// What a pixel's first ray hits: what both the GPU tracer and the double-precision reference report.
//
// Plain data, no functions. A pixel's first ray is that of sample 0 (scene/view.h). Both tracers name a hit
// by body in IR order and triangle in file order, so that they can be compared without knowing each other.
#ifndef GLINT_SCENE_HITS_H
#define GLINT_SCENE_HITS_H

#include "core/vec3.h"

#include <stdint.h>

#define HIT_NONE UINT32_MAX

struct hit_pixel {
    uint32_t body;       // in IR order (ir.h, ir_body_count); HIT_NONE: the background
    uint32_t triangle;   // of the body, in file order; 0 for spheres and where nothing was hit
    uint32_t considered; // bit i: light i of the view, i < 32, would add to the pixel if nothing were between
    uint32_t lit;        // bit i: it is considered, and nothing is between
    uint32_t reflected;  // body that the mirrored ray hits, where the material reflects; else HIT_NONE
    uint32_t refracted;  // body that the refracted ray hits, where the material refracts; else HIT_NONE
    double distance;     // along the unit ray, scene units; 0 where nothing was hit
    vec3 normal;         // shading normal at the hit, unit; 0 where nothing was hit
    // Diffuse colour times its weight, linear, filtered as in a picture of one sample; 0 where nothing was
    // hit.
    vec3 albedo;
    uint32_t reflects, refracts; // 1: the mirrored, the refracted ray is sent, whether it hits or not
};

#endif
