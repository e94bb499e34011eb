// Media: the bodies that a ray can be inside, and which of them surround a point (docs/language.md, "Media").
//
// A medium is a sphere or closed mesh with a material that refracts. Input: a built scene, or one whose
// bodies were moved since (scene_body_place). Ownership: nothing is kept. Errors: as the functions say.
// Thread safety: pure functions.
#ifndef GLINT_SCENE_MEDIA_H
#define GLINT_SCENE_MEDIA_H

#include "scene/scene.h"

#define SCENE_PRIORITY_MAX 1000

// Most media that a ray can be inside at once.
#define SCENE_MEDIA_MOST 8

// The media around a point, in the order in which a ray from outside enters them.
struct scene_inside {
    uint32_t bodies[SCENE_MEDIA_MOST]; // in IR order
    uint32_t count;
    bool is_over; // there are more: `bodies` holds the outermost ones
};

// The unit direction from which that ray comes: from above, but not along directions that edges and faces
// usually follow.
vec3 scene_inside_direction(void);

bool scene_is_medium(const struct scene *scene, const struct scene_body *body);
// The material that fills a medium: the first refracting one among its groups.
uint32_t scene_medium_material(const struct scene *scene, const struct scene_body *body);
// Orders materials by everything that affects light inside them. 0: they are alike, and overlapping bodies of
// them form one medium.
int scene_compare_media(const struct scene_material *a, const struct scene_material *b);

enum scene_media_need {
    SCENE_MEDIA_APART,       // no two media can share a point, and none is coloured
    SCENE_MEDIA_OVERLAP,     // bodies a and b may share one
    SCENE_MEDIA_ATTENUATION, // body a is coloured
    SCENE_MEDIA_MANY,        // there are too many to compare
};
struct scene_media_reason {
    enum scene_media_need need;
    uint32_t a, b; // in IR order
};
// Whether rays must know what they are inside; otherwise the side of the surface tells. false: no memory.
bool scene_media_need(const struct scene *scene, struct scene_media_reason *out);

// What surrounds the point.
void scene_media_at(const struct scene *scene, vec3 point, struct scene_inside *out);
// How many media surround the point if that is more than a ray can be inside; else 0.
uint32_t scene_media_crowd(const struct scene *scene, vec3 point);

#endif
