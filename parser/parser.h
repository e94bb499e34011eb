// From a scene file to the IR. All diagnostics of all stages in one run.
//
// There are nine stages (stages/parser.c). After each, its line below and those before it hold:
// 1 read      The file is a tree of its tokens, each with its place. No name of the language was looked up.
//             What is wrong in the syntax is reported, and marked TREE_BAD or TREE_CUT.
// 2 bind      The file is an IR of its own. Each value is valid by its row of the table; else it is reported,
//             marked in ir_head.poisoned, and has its default.
// 3 resolve   Every file that is included is read and bound, once. loader->order has each before the one that
//             includes it; if one cannot be read, output->unread says where.
// 4 merge     There is one scene. Lists are joined; for elements that occur once, the including file's
//             attributes win. The IR of each file stays in origin.files.
// 5 override  The --set options are applied, in their order, and bound by the same rules.
// 6 names     No two things share a name, and each reference has its index; else it is reported.
// 7 animate   Parameters and expressions have their values, and what 'for' and 'if' make of an entry stands
// in its
//             list. Where a frame of the animation is asked for, the values are those of that frame, and the
//             scene has no animation; else all of its frames were looked at.
// 8 compact   Anonymous elements that no reference uses are gone. The IR no longer changes.
// 9 validate  The rules that a table cannot say hold; else it is reported.
// Objects that nothing shows then go through stages 7 to 9 in a scene of their own.
// Diagnostics about an included file then say where it is included. parser_load_file runs the first two.
//
// Ownership: IR and places live in `arena`; sources keep the text. The caller owns everything in
// struct parser_input, and has added the scene's root to `files`.
// Thread safety: one call belongs to one thread.
#ifndef GLINT_PARSER_PARSER_H
#define GLINT_PARSER_PARSER_H

#include "core/limits.h"
#include "diag/diag.h"
#include "files/files.h"
#include "grammar/ir_origin.h"

struct ir_scene;
struct timeline;

struct parser_input {
    struct source_set *sources;
    struct files *files;
    struct diag_sink *sink;
    const struct limits *limits;
    struct arena *arena; // guarded inside parser_load
    const str *sets;     // --set options, "PATH=VALUE", in order
    uint32_t set_count;
    bool keeps_written;        // origin.written is the scene as it is written
    bool judges_objects;       // also those that nothing shows: output->unshown
    bool whole;                // nothing is bound before its file is read: slower, with the same result
    struct timeline *timeline; // may be NULL
};

struct parser_output {
    struct ir_scene *scene;  // merged, resolved; with every poisoned value at its default
    struct ir_origin origin; // origin.files[0].scene is only the main file
    span unread;             // the first include that could not be read; SPAN_NONE: all were
    // A scene of the objects that nothing shows, an instance of each; NULL: there are none, or nobody asked.
    struct parser_output *unshown;
};

// Loads the source `main_source` (already read) and all that it includes.
// false: there is no scene at all (the sink says why). true does not mean that there were no errors: check
// the sink.
bool parser_load(const struct parser_input *input, uint32_t main_source, struct parser_output *output);

// A scene after stage 4, from which many are made that differ in their --set options and in the frame of
// their animation.
struct parser_kept;
// Runs the first four stages. `input` is copied; what it points to, except its sets, must outlive the kept
// scene. NULL: there is no scene, or anything was reported.
struct parser_kept *parser_keep(const struct parser_input *input, uint32_t main_source);
void parser_drop(struct parser_kept *kept); // NULL does nothing
// Runs the other stages, as parser_load does, for a copy of the scene. input->sources begins with those of
// the kept scene. May run several times at once.
bool parser_load_kept(const struct parser_kept *kept, const struct parser_input *input,
                      struct parser_output *output);

// Only one file, without its includes, overrides and rules between files: what `convert` writes.
bool parser_load_file(const struct parser_input *input, uint32_t source, struct parser_output *output);

#endif
