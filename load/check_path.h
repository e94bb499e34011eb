// From a place in a file to its path in the scene. Ownership: the path is in `arena`, whose guard must be
// set. Thread safety: one call belongs to one thread.
#ifndef GLINT_LOAD_CHECK_PATH_H
#define GLINT_LOAD_CHECK_PATH_H

#include "load/session.h"

// The scene path of a place: "models[2].material", as --set accepts it. Empty: the place has none.
str check_scene_path(const struct session *session, struct arena *arena, span at);

#endif
