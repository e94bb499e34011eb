// What the peer on Embree traces: the bodies, materials, lights and background of scene/, in floats about the
// same origin as glint's, with the vertices rounded as flattening rounds them. Whitted's recursion by the
// language's rules (docs/language.md), so that both send about the same rays.
//
// Ownership: peer_finish frees everything; it takes a zeroed peer. The scene, the view and what they point to
// must outlive it. Errors: NULL from peer_error is none. Thread safety: immutable once made; peer_render
// works on all processors.
#ifndef GLINT_BENCH_EMBREE_PEER_H
#define GLINT_BENCH_EMBREE_PEER_H

#include "bench/embree/float3.h"
#include "scene/view.h"

struct RTCDeviceTy; // Embree's; its header is included where it is called
struct RTCSceneTy;
struct RTCRayHit;

struct peer_material {
    float3 diffuse[2], specular; // times their weights
    bool checker;
    float cell, exponent, reflection, refraction, index;
};

struct peer_body {
    const struct scene_body *is;
    const float3 *positions; // world space; of an instance the mesh's own
    const uint32_t *corners; // three a triangle, `stride` numbers apart
    uint32_t stride;
    bool instance;            // positions go through `to_world`
    float34 to_world, to_own; // `to_own`: to the coordinates of a checker
    float34 normal_map;       // of smooth instances; no offset
    const float3
        *normals;         // three a triangle: unit, in world space; of an instance the mesh's own; NULL: flat
    float edge_u, edge_v; // of a parallelogram: lengths
};

struct peer_sphere {
    float3 center;
    float radius;
    uint32_t body;
};

struct peer_light {
    bool directional, inverse_square;
    float3 place, emission; // to the light, where directional
};

struct peer_counts {
    uint64_t primary, reflected, refracted, shadow;
};

struct peer {
    const struct scene *scene;
    struct arena arena;
    struct RTCDeviceTy *device;
    struct RTCSceneTy *top;
    bool robust, instances;
    struct peer_body *bodies;
    struct peer_sphere *spheres;
    uint32_t sphere_count;
    struct peer_material *materials;
    struct peer_light *lights;
    uint32_t light_count;
    float *decoded; // of the background, by stored value
    float3 position, forward, right, up;
    float3 background;
    uint32_t triangles, max_depth; // triangles: instances counted each
    float min_weight;
    bool shadows, cut_sees_background;
    double flatten_seconds, build_seconds;
};

struct peer_wish {
    const struct scene *scene;
    const struct view *view;
    vec3 origin;
    uint32_t width, height;
    bool robust, instances; // instances: models of a mesh share one tree
};

// false: peer_error says why, and the peer can only be finished.
bool peer_make(struct peer *peer, const struct peer_wish *wish);
void peer_finish(struct peer *peer);
const char *peer_error(const struct peer *peer);
// Builds Embree's trees; part of peer_make.
bool peer_build(struct peer *peer);
// width * height * 3 floats, the mean of the samples; adds to the counts. false: no memory.
bool peer_render(const struct peer *peer, uint32_t width, uint32_t height, uint32_t samples, float *rgb,
                 struct peer_counts *counts);

// ---- surface.c

struct peer_surface {
    float3 point, error;       // `error`: how far its coordinates may be off
    float3 geometric, shading; // unit, towards the ray
    bool enters, solid;
    float3 diffuse, specular;
    float exponent, reflection, refraction, index;
};

void peer_surface(const struct peer *peer, const struct RTCRayHit *found, struct peer_surface *out);
// Where a ray starts that leaves on that side.
float3 peer_leave(const struct peer_surface *s, float3 side);
float3 peer_mirrored(const struct peer_surface *s, float3 direction);
// false: total reflection.
bool peer_bent(const struct peer_surface *s, float3 direction, float3 *out);

// ---- light.c

// What a light adds where nothing blocks it, and the ray to it: it ends at *far.
float3 peer_light(const struct peer_light *light, const struct peer_surface *s, float3 start,
                  float3 direction, float3 *way, float *far);
float3 peer_background(const struct peer *peer, float3 direction);

#endif
