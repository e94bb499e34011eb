// Rules about light that a grammar cannot hold: what is a scene by every rule of the language, and will still
// not show what its author meant. Each rule has a code of the family W4xx (docs/lint.md has a page for each).
//
// Input: a scene without errors, with its meshes; neither pixels of images nor a device. Output: warnings in
// the sink, placed in the scene, with notes at lines of mesh files. A rule says what is certain: where it
// cannot know (mirrors that may show what no camera sees) it is silent. Ownership: nothing stays but
// diagnostics and sources. Errors: where memory ends, E502 says that rules are missing. Thread safety: the
// thread of the sink; the rules use all processors.
#ifndef GLINT_LINT_LINT_H
#define GLINT_LINT_LINT_H

#include "assets/assets.h"

struct ir_image;

enum lint_level {
    LINT_NONE,
    LINT_CHEAP, // rules that look at entries of the scene alone, and whose findings spoil the picture
    LINT_ALL,
};

struct lint_input {
    const struct assets_input *scene; // as the assets were loaded; sink and sources are added to
    const struct assets *assets;
    const struct ir_image *image; // the size and samples that will be rendered
};

void lint_run(const struct lint_input *input, enum lint_level level);

// The table of rules, for documents and tests.
struct lint_rule_info {
    enum diag_code code;
    const char *name;
    enum lint_level level; // the least one that runs it
};
unsigned lint_rule_count(void);
struct lint_rule_info lint_rule(unsigned index);

#endif
