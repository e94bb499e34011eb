// From a scene file to the IR: read, bind, resolve, validate. All diagnostics of all stages in one run.
//
// Ownership: IR and places live in `arena`; sources keep the texts. The caller owns everything in
// struct parser_input, and has added the scene's root to `files`.
// Thread safety: one call belongs to one thread.
#ifndef GLINT_PARSER_PARSER_H
#define GLINT_PARSER_PARSER_H

#include "core/limits.h"
#include "diag/diag.h"
#include "files/files.h"
#include "grammar/ir_origin.h"

struct ir_scene;

struct parser_input {
    struct source_set *sources;
    struct files *files;
    struct diag_sink *sink;
    const struct limits *limits;
    struct arena *arena; // guarded inside parser_load
    const str *sets;     // --set options, "PATH=VALUE", in order
    uint32_t set_count;
    bool whole; // nothing is bound before its file is read: slower, and the same result
};

struct parser_output {
    struct ir_scene *scene;  // merged, resolved; with every poisoned value at its default
    struct ir_origin origin; // origin.files[0].scene is the main file alone
};

// Loads the source `main_source` (already read) and all that it includes.
// false: there is no scene at all (the sink says why). true does not mean that there were no errors:
// ask the sink.
bool parser_load(const struct parser_input *input, uint32_t main_source, struct parser_output *output);

// One file alone, without its includes, overrides and rules between files: what `convert` writes.
bool parser_load_file(const struct parser_input *input, uint32_t source, struct parser_output *output);

#endif
