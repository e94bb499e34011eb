// glint inspect: what a scene contains and requires, what a picture says of how it was made.
//
// Thread safety: as cli.h.
#ifndef GLINT_CLI_COMMANDS_INSPECT_INSPECT_H
#define GLINT_CLI_COMMANDS_INSPECT_INSPECT_H

#include "cli/cli.h"
#include "grammar/ir_features.h"
#include "load/session_precision.h"
#include "tracer/flatten/flatten.h"

enum {
    INSPECT_BUFFERS = 16
};

// A scene as it would be rendered: what the report is about, as text and as JSON.
struct inspected_scene {
    struct session *session;
    struct flat_scene flat;
    struct precision_choice precision;
    struct ir_feature_reasons reasons;
};

struct inspect_buffer {
    const char *name;
    uint64_t bytes;
};

// Puts the buffers that are not empty into `out`, INSPECT_BUFFERS long; returns how many.
uint32_t inspect_buffers(const struct flat_scene *flat, struct inspect_buffer *out);
// How many materials have a name.
uint32_t inspect_named_materials(const struct ir_scene *scene);
// Why a feature is on: returns the place that switches it on, or SPAN_NONE, and appends the words.
span inspect_feature(const struct inspected_scene *scene, uint64_t bit, struct strbuf *words);
// Why models have copies of a mesh that they could share; appended to `words`.
void inspect_copies(const struct flat_use *use, struct strbuf *words);

void inspect_scene_text(const struct inspected_scene *scene, struct strbuf *out);
void inspect_scene_json(const struct inspected_scene *scene, struct strbuf *out);

// Whether the path ends as a picture does, whatever its case.
bool inspect_is_picture(const char *path);
// Reads and reports the picture that is the first operand; an exit code.
int inspect_picture(struct cli *cli);

#endif
