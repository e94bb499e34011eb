// What differs in meaning between two scenes, found by walking the table over both.
//
// A value that was written and a default are the same if they are equal; comments, spelling, order of keys
// and of named things are not part of the meaning. Entries of lists are matched by name, else by equal
// content, else by the most equal attributes; entries that are elsewhere in the list are reported as moved
// (of two surfaces at one place the earlier one is seen). Ownership: everything is made in the given arena,
// which must be guarded; spans point into the sources of their side. Errors: only lack of memory.
// Thread safety: pure except for the arena and the callbacks.
#ifndef GLINT_GRAMMAR_PRINT_IR_DIFF_H
#define GLINT_GRAMMAR_PRINT_IR_DIFF_H

#include "core/arena.h"
#include "grammar/ir_origin.h"

struct ir_scene;

enum ir_change_kind {
    IR_CHANGED,
    IR_ADDED,
    IR_REMOVED,
    IR_MOVED,
    IR_RENAMED,
};

struct ir_change {
    enum ir_change_kind kind;
    str path_before, path_after; // as --set accepts them; empty: it is not there
    span before, after;          // SPAN_NONE: no place
    str value_before,
        value_after; // scene text, as YAML on one line; empty: it is not there, or did not change
    bool default_before, default_after; // nobody wrote the value
};

struct ir_changes {
    struct ir_change *items;
    uint32_t count, capacity;
};

struct ir_diff_side {
    const struct ir_scene *scene; // merged and without errors
    const struct ir_origin *origin;
    // The file that a path names, in a form that is the same for all paths to one file; `at` is where the
    // path is written.
    str (*file)(void *context, struct arena *arena, span at, str path);
    void *context;
};

void ir_diff(const struct ir_diff_side *before, const struct ir_diff_side *after, struct arena *arena,
             struct ir_changes *changes);

#endif
