// Single rays through the tracer's own tree, tests and starts on a device, in the precision of a flat scene.
//
// A probe holds the scene on the device. Rays are in flat units; probe_trace rounds them to the precision of
// the scene, as a ray of the tracer would be: aim from probe_round. Ownership: probe_finish frees; the flat
// scene must outlive the probe. A test's state is a probe_fixture, from setup to teardown.
#ifndef GLINT_TESTS_UNIT_PROBE_KIT_H
#define GLINT_TESTS_UNIT_PROBE_KIT_H

#include "core/vec3.h"
#include "device_kit.h"
#include "tracer/flatten/flatten.h"
#include "tracer/gpu/gpu.h"

enum {
    PROBE_RAYS = 1 << 18 // of one probe_trace at most
};

struct probe_ray {
    vec3 origin, direction;
    double end; // hits lie before, in multiples of the direction
    vec3 next;  // direction of a second ray, which leaves the surface that the first one meets
};

struct probe_met {
    bool found;
    double t;        // in multiples of the direction
    uint32_t number; // spheres by body, then triangles
};

struct probe_hit {
    struct probe_met first, second;
    bool any;       // the search for any hit found one too
    bool same_side; // the second ray left on the side that the first one came from
    bool blocked;   // the search for any hit of the second ray found one
};

struct probe {
    struct gpu *gpu;
    const struct flat_scene *flat;
    bool is_double;
    uint32_t *items; // the leaf item of each triangle, by number
    struct gpu_program_source source;
    struct gpu_program *program;
    struct gpu_word *words;
};

// `packed`: keep waiting groups in one word, as for small trees. false: no memory on the device.
bool probe_init(struct probe *probe, struct gpu *gpu, const struct flat_scene *flat, bool packed);
// Ways to search that the tracer does not use, to compare with its own, and to see that a test finds what
// they lose.
enum probe_way {
    PROBE_EXACT,    // the tracer's own
    PROBE_BOUND,    // in single precision: t beyond the bound of its error, for all triangles
    PROBE_POSITIVE, // in single precision: t > 0
    PROBE_WHOLE,    // in double precision: every triangle is tested in it
    PROBE_BOLD,     // in double precision: rejected in single, with no margin for its errors
};
bool probe_init_way(struct probe *probe, struct gpu *gpu, const struct flat_scene *flat, bool packed,
                    enum probe_way way);
void probe_finish(struct probe *probe);
vec3 probe_round(const struct probe *probe, vec3 v);
// A place of the scene in flat units, rounded.
vec3 probe_place(const struct probe *probe, vec3 scene);
// Unit, of a triangle as flattened, by its number among triangles; outward where the mesh is closed.
vec3 probe_normal(const struct probe *probe, uint32_t number);
bool probe_trace(struct probe *probe, const struct probe_ray *rays, uint32_t count, struct probe_hit *hits);

// ---- tests

struct probe_fixture {
    struct device_kit device;
    struct probe_ray *rays; // PROBE_RAYS of each
    struct probe_hit *hits;
    uint64_t sent; // rays, of which the teardown tells
};

int probe_setup(void **state);
int probe_teardown(void **state);
// Skips the test where there is no such device.
struct probe_fixture *probe_need(void **state, bool is_double);

#endif
