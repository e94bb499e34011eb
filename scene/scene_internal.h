// What the files of this room share.
#ifndef GLINT_SCENE_SCENE_INTERNAL_H
#define GLINT_SCENE_SCENE_INTERNAL_H

#include "scene/scene.h"

// Fills the bodies; the rest of the scene is complete.
void scene_build_bodies(struct scene *scene, struct arena *arena);

// Fills the places, before the bodies.
void scene_build_places(struct scene *scene, struct arena *arena);
// Moves a body from an object to the world; a round one stays round.
void scene_body_into(struct scene_body *body, const affine3 *place, struct arena *arena);

// The mesh of all boxes: a cube of edge 1 around the origin. Its path is empty.
const struct mesh *scene_box_mesh(void);

// Fills the images of all materials.
void scene_build_textures(struct scene *scene, struct arena *arena);

#endif
