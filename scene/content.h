// The hash of everything that makes up a scene: its IR and the decoded contents of the files that it names.
//
// Two spellings of a scene have the same hash, and so does a scene that was moved with its files. Not
// included: comments, the order of keys, where something is in a file. The pixels of images must be there
// (session_settle). Thread safety: pure.
#ifndef GLINT_SCENE_CONTENT_H
#define GLINT_SCENE_CONTENT_H

#include "core/hash128.h"
#include "scene/scene.h"

enum {
    SCENE_CONTENT_TEXT = 33 // characters of a hash as text, with the NUL
};

void scene_content(struct hash128 *hash, const struct scene *scene);
// As 32 hexadecimal digits.
void scene_content_text(const struct scene *scene, char text[SCENE_CONTENT_TEXT]);

#endif
