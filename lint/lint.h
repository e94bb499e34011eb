// Rules about light that a grammar cannot express: a scene may keep every rule of the language and still not
// show what its author meant. Each rule has a code of the family W4xx (docs/lint.md has a page for each).
//
// Input: a scene without errors, with its meshes; neither pixels of images nor a device. Output: warnings in
// the sink, placed in the scene, with notes at lines of mesh files. A rule reports only what is certain:
// where it cannot know (mirrors may show what no camera sees) it is silent. Ownership: only diagnostics and
// sources remain. Errors: where memory runs out, E502 says that rules are missing. Thread safety: the thread
// of the sink; the rules use all processors.
#ifndef GLINT_LINT_LINT_H
#define GLINT_LINT_LINT_H

#include "scene/scene.h"

struct ir_image;

enum lint_level {
    LINT_NONE,
    LINT_CHEAP, // rules that look only at the scene's entries, and whose findings spoil the picture
    LINT_ALL,
};

struct lint_input {
    const struct scene *scene;
    const struct assets_input *files; // as they were loaded; the rules add to sink and sources
    const struct ir_image *image;     // the size and samples that will be rendered
};

void lint_run(const struct lint_input *input, enum lint_level level);

#endif
