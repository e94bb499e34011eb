// The small YAML files beside scenes: each is a map of settings, bounds or tests.
//
// They share the reader of scenes. Its messages about an empty file, or one that is not a map, speak of
// scenes and are replaced here. Ownership: the arena's. Thread safety: one call belongs to one thread.
#ifndef GLINT_LOAD_SETTINGS_SETTINGS_FILE_H
#define GLINT_LOAD_SETTINGS_SETTINGS_FILE_H

#include "parser/tree/reader.h"

struct settings_words {
    const char *not_a_map; // the message about a file that is something else
    const char *help;
};

// Takes one key of the map, and its value, from the tree, which lives as long as the call.
typedef void settings_take(void *binder, const struct tree *tree, tree_index key);

// Reads a source that is in the set, reports what is wrong with it as YAML, and hands on each key, in order.
// An empty file has none. Returns the fault that the arena raised, in here or in `take`.
enum arena_fault settings_read(const struct reader_context *reader, uint32_t source,
                               const struct settings_words *words, settings_take *take, void *binder);

#endif
