// Media: the bodies that a ray can be inside, and which of them surround a point (docs/language.md, "Media").
//
// A medium is a sphere or closed mesh of which something refracts. Input: a built scene, or one whose bodies
// were moved since (scene_body_place). Ownership: nothing is kept. Errors: as the functions say. Thread
// safety: pure functions.
#ifndef GLINT_SCENE_MEDIA_H
#define GLINT_SCENE_MEDIA_H

#include "scene/scene.h"

#define SCENE_PRIORITY_MAX 1000

// Most media that a ray can be inside at once.
#define SCENE_MEDIA_MOST 8

// The media around a point, in the order in which a ray enters them that comes from outside.
struct scene_inside {
    uint32_t bodies[SCENE_MEDIA_MOST]; // in IR order
    uint32_t count;
    bool is_over; // there are more: `bodies` holds the outermost ones
};

// Where that ray comes from, unit: from above, but along nothing that edges and faces usually follow.
vec3 scene_inside_direction(void);

bool scene_is_medium(const struct scene *scene, const struct scene_body *body);
// The material that fills a medium: the first of its groups' that refracts.
uint32_t scene_medium_material(const struct scene *scene, const struct scene_body *body);
// An order of materials by all that light knows of them. 0: they are alike, and bodies of them are one where
// they overlap.
int scene_compare_media(const struct scene_material *a, const struct scene_material *b);

enum scene_media_need {
    SCENE_MEDIA_APART,       // no two media can have a place in common, and none is coloured
    SCENE_MEDIA_OVERLAP,     // bodies a and b may have one
    SCENE_MEDIA_ATTENUATION, // body a is coloured
    SCENE_MEDIA_MANY,        // there are too many to compare
};
struct scene_media_reason {
    enum scene_media_need need;
    uint32_t a, b; // in IR order
};
// Whether rays must know what they are inside: else the side of a surface says it. false: no memory.
bool scene_media_need(const struct scene *scene, struct scene_media_reason *out);

// What surrounds the point.
void scene_media_at(const struct scene *scene, vec3 point, struct scene_inside *out);

#endif
