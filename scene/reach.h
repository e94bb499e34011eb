// Whether the transforms of models keep them within the coordinates that the language allows.
#ifndef GLINT_SCENE_REACH_H
#define GLINT_SCENE_REACH_H

#include "assets/assets.h"

// Adds an error (E409) for each model whose box, transformed, has a coordinate beyond the range.
void scene_check_reach(const struct ir_scene *scene, const struct assets *assets, struct diag_sink *sink);

#endif
