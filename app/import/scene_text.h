// The scene that a glTF file is by itself, as text: what `glint render file.glb` loads, with the materials
// left in the file.
//
// Output: appended to `text`. Errors: false where the file cannot be read; loading it as a mesh reports why.
// What lights lose is told where the input's sink is. Thread safety: one thread.
#ifndef GLINT_APP_IMPORT_SCENE_TEXT_H
#define GLINT_APP_IMPORT_SCENE_TEXT_H

#include "assets/file/asset_input.h"
#include "core/strbuf.h"

bool import_scene_text(const struct assets_input *input, str path, struct strbuf *text);

#endif
