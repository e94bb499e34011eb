// Random scenes of families that are hard for a tracer: text, made from a seed and a number.
//
// The same seed, family and number give the same text on every machine whose libm gives the same numbers; a
// scene does not depend on how many others are made. Output: a scene in YAML and the meshes that it names, to
// be read as files beside it. Ownership: sweep_scene_finish frees the text. Errors: a text whose `failed` is
// set where memory ended. Thread safety: pure.
#ifndef GLINT_TESTS_SWEEP_SWEEP_SCENE_H
#define GLINT_TESTS_SWEEP_SWEEP_SCENE_H

#include "core/strbuf.h"

#include <stdint.h>

enum sweep_family {
#define X(NAME, name, title) SWEEP_##NAME,
#include "tests/sweep/families.def"
#undef X
    SWEEP_FAMILIES,
};

struct sweep_family_info {
    const char *name;  // "corridor"
    const char *title; // what its scenes show
};
extern const struct sweep_family_info sweep_families[SWEEP_FAMILIES];

enum {
    SWEEP_MESHES = 12,
    SWEEP_NAME_BYTES = 64,
};

// Or an image.
struct sweep_mesh {
    char name[SWEEP_NAME_BYTES]; // "pipe-17-0.obj"
    struct strbuf text;
};

struct sweep_scene {
    enum sweep_family family;
    uint32_t number;             // among those of its family, from 0
    char name[SWEEP_NAME_BYTES]; // "pipe-17.glint.yaml"
    struct strbuf text;
    struct sweep_mesh meshes[SWEEP_MESHES];
    uint32_t mesh_count;
    // The camera is inside a closed room whose background is brighter than SWEEP_BRIGHT, and nothing else is:
    // a pixel as bright has seen it, however often its ray was mirrored.
    bool closed;
};
#define SWEEP_BRIGHT 20.0

void sweep_scene_make(struct sweep_scene *scene, uint64_t seed, enum sweep_family family, uint32_t number);
void sweep_scene_finish(struct sweep_scene *scene);

#endif
