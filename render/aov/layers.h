// What is known of a picture's pixels besides colour, made by the tracer that made the picture: planes
// (aov.h), names (names.h), and, for OpenEXR, layers of the picture with mattes (matte.h) among them.
//
// Errors: enum shot_status; SHOT_NO_MEMORY leaves nothing in the sink. Ownership: layers_finish frees all but
// texts, which lie in the given arena, whose guard the caller sets; it accepts zeroed ones. Thread safety:
// the gpu's thread.
#ifndef GLINT_RENDER_AOV_LAYERS_H
#define GLINT_RENDER_AOV_LAYERS_H

#include "picture/write/exr_file.h"
#include "render/aov/aov.h"
#include "render/aov/matte.h"
#include "render/aov/names.h"
#include "render/reference_shot.h"

enum {
    LAYERS_MATTES = 2, // of bodies, of materials
    LAYERS_MATTE_CHANNELS = 2 * MATTE_RANKS,
    LAYERS_MATTE_ATTRIBUTES = 4,
    LAYERS_CHANNELS_MOST = AOVS * AOV_CHANNELS_MOST + LAYERS_MATTES * LAYERS_MATTE_CHANNELS,
};

struct layers_wish {
    struct shot *shot;                      // that made the picture; NULL: the reference
    struct reference_shot *reference;       // that made it, if `shot` is NULL
    const struct render_estimate *estimate; // where pixels ended; NULL: all have the session's samples
    uint32_t width, height;
    uint32_t wanted; // bits of enum aov
    bool in_picture; // `layers` are made, with mattes
};

struct layers {
    struct layers_wish wish;
    struct session *session;
    struct arena *arena;
    struct aov_planes planes;
    struct aov_names names;
    struct matte mattes[LAYERS_MATTES];
    struct hit_pixel *hits;
    struct exr_channel channels[LAYERS_CHANNELS_MOST];
    struct exr_attribute attributes[LAYERS_MATTES * LAYERS_MATTE_ATTRIBUTES];
    struct strbuf manifests[LAYERS_MATTES];
    struct image_layers layers;
};

bool layers_have(const struct layers *layers, enum aov aov);
enum shot_status layers_make(struct layers *layers, struct session *session, const struct layers_wish *wish,
                             const struct render_progress *progress, struct arena *arena);
// One plane as a picture of three channels, owned by the caller. false: no memory.
bool layers_plane(const struct layers *layers, enum aov aov, struct image *image);
void layers_finish(struct layers *layers);

#endif
