// A baseline: the known findings of a check, so only new ones are reported.
//
// A finding is recognised by its file, its code, the words of its message and the text of its line. Numbers
// in the message and the line number do not count, so text added above does not make it new. For findings
// equal in all of these the baseline holds their number in one scene. It holds errors and warnings in files,
// but not those of settings and options, nor that memory ran out, that a file cannot be read, or that an
// include is missing or refused.
//
// The file is text, sorted, one entry a line: path (relative to the baseline's folder), code, number,
// message, line and, if the finding is not in the scene itself, the scene that reads the file; separated by
// tabs. What would be a tab or a line end, or is not text, is a backslash sequence.
//
// Errors: in the sink. Ownership: what is read is in the given arena, which must live as long as the sources;
// baseline_found_finish frees what was found. Thread safety: a baseline that was read may be used by many
// threads at a time; a list of what was found belongs to one.
#ifndef GLINT_LOAD_SCOPE_BASELINE_H
#define GLINT_LOAD_SCOPE_BASELINE_H

#include "core/str_map.h"
#include "core/strbuf.h"
#include "load/session.h"

#include <stdatomic.h>

struct baseline_entry {
    str key; // path, code, message and line as in the file
    str via; // the scene that reads the path
    uint32_t count;
    uint32_t line; // in the baseline
};

struct baseline {
    struct arena *arena;
    const char *path;
    str folder; // absolute
    struct {
        struct baseline_entry *items;
        uint32_t count, capacity;
    } entries;
    struct str_map keys;    // 1 + index of the entry
    struct str_map scenes;  // each `via`: 1 + index in `checked`
    _Atomic uint32_t *used; // by entry: how many a scene had
    _Atomic bool *checked;  // scenes whose findings are all known
};

// What was found, to be written.
struct baseline_found {
    struct arena arena;
    str folder; // of the baseline that will be written; absolute
    struct {
        struct baseline_entry *items;
        uint32_t count, capacity;
    } entries;
    struct str_map keys;
    uint32_t dropped; // findings that the sink did not keep
};

// The folder of a baseline, absolute, in the arena.
str baseline_folder(struct arena *arena, const char *path);
// false: it cannot be read, or is not one; the sink says why.
bool baseline_read(struct baseline *baseline, const char *path, struct arena *arena,
                   struct source_set *sources, struct diag_sink *sink);
// How many of its entries no longer occur in the scenes that were checked, and their lines, as a sentence
// with a line end; nothing if there are none. Scenes with errors do not count: the rules may not have run.
void baseline_put_stale(const struct baseline *baseline, struct strbuf *out);

void baseline_found_init(struct baseline_found *found, str folder);
void baseline_found_finish(struct baseline_found *found);
// Writes the baseline of what was found in all scenes; returns the number of findings. `arena`: for temporary
// data.
uint32_t baseline_put(const struct baseline_found *const *found, uint32_t count, struct arena *arena,
                      struct strbuf *out);

// Removes from a session's findings (check_scene) those that `known` holds; if `found` is not NULL, moves all
// that a baseline can hold to it instead. Returns how many. Updates the sink and its counts.
uint32_t baseline_take(struct session *session, const struct baseline *known, struct baseline_found *found);

#endif
