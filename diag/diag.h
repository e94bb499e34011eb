// Diagnostics are data: a code, a place, a message, notes with places of their own, a help line and, if the
// right text is known, a fix. Text is made at the edge (diag/diag_text.h).
//
// Stages collect into one sink per job and go on. Ownership: everything is in the sink's own arena,
// freed by `diag_sink_finish`; spans point into the sources. When the sink's memory runs out, further
// diagnostics are counted and not kept. Thread safety: one sink belongs to one thread; jobs that run
// at the same time have a sink each, merged with `diag_merge`.
#ifndef GLINT_DIAG_DIAG_H
#define GLINT_DIAG_DIAG_H

#include "core/arena.h"
#include "core/str.h"
#include "diag/source.h"

enum diag_severity {
    DIAG_ERROR,
    DIAG_WARNING,
    DIAG_NOTE,
};

// Where a code can occur; the invalid corpus has a case for each.
enum diag_where {
    DIAG_IN_YAML = 1,
    DIAG_IN_XML = 2,
    DIAG_IN_BOTH = 3,
    DIAG_IN_MESH = 4,
    DIAG_IN_IMAGE = 8,
    DIAG_IN_COMMAND = 16, // needs an option, a device or a file outside the scene
};

// A code: those of a family follow each other from its first digit times DIAG_FAMILY on (diag/codes/).
// The numbers between families are not codes: diag_next goes from code to code.
typedef int diag_code;
enum {
    DIAG_FAMILY = 128,
    DIAG_CODE_COUNT = 9 * DIAG_FAMILY, // all codes are less
};

struct diag_info {
    const char *name; // "UNKNOWN_KEY"
    const char *code; // "E203"
    enum diag_severity severity;
    unsigned where; // diag_where, or-ed
    const char *title;
    const char *meaning; // one paragraph
    const char *remedy;  // one paragraph
};

struct diag_related {
    span at; // SPAN_NONE: no place
    str message;
    struct diag_related *next;
};

// A name in reach with its value, which a message about a copy gives.
struct diag_value {
    str name;
    str value; // as expressions write it: 3, true, [1, 2, 3], #c08050
    struct diag_value *next;
};

struct diag {
    diag_code code;
    enum diag_severity severity; // the code's own, unless a policy changed it (diag/diag_policy.h)
    span at;
    str message;
    struct diag_related *notes; // in the order they were added
    str help;                   // empty: none
    uint32_t repeats;           // further ones like it, in copies of what it is about
    uint32_t copies;            // so many have it, after diag_sort; 0: it is about none
    struct diag_value *with;    // in the first of them
    bool has_fix;
    bool fix_is_safe; // the only possible meaning; else a suggestion
    span fix_at;
    str fix_text;
    str fix_file; // if not empty: a missing file that the fix creates with fix_text; has_fix
                  // is false then
};

struct diag_sink {
    struct arena arena;
    struct diag *items;
    uint32_t count;
    uint32_t capacity;
    uint32_t kept_max; // further ones are counted as dropped: DIAG_KEPT_MAX, unless diag_sink_keep raised it
    uint32_t errors;
    uint32_t warnings;
    uint32_t notes;
    uint32_t dropped; // did not fit into the sink; counted above too
    uint32_t dropped_of[DIAG_CODE_COUNT];
    struct {
        span *items;
        uint32_t count, capacity;
        bool is_sorted;
    } repeated;           // of which there are copies: diag_repeats
    uint32_t settled;     // so many of the first items do not count what repeats them
    uint64_t search_left; // what searching for suggestions may still cost (core/nearest.h)
    struct diag spare;    // stands for a diagnostic that was dropped
    bool last_kept;       // whether notes, help and fix have a diagnostic to belong to
};

// A sink keeps this many diagnostics by itself.
enum {
    DIAG_KEPT_MAX = 10000,
};

void diag_sink_init(struct diag_sink *sink);
void diag_sink_finish(struct diag_sink *sink);
// Makes room for `most` diagnostics, if that is more than it keeps by itself.
void diag_sink_keep(struct diag_sink *sink, uint32_t most);

// Adds a diagnostic and returns it for the calls below, valid until the next diag_add; never NULL. Texts
// longer than 2000 bytes are cut.
struct diag *diag_add(struct diag_sink *sink, diag_code code, span at, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
// There are several of what is at this place in a file: what is said of it by one code at one place is kept
// once, and the others counted there. After all that are before it.
void diag_repeats(struct diag_sink *sink, span at);
// Whether diag_add would count only.
bool diag_is_repeat(struct diag_sink *sink, diag_code code, span at);
// Whether diag_add only counts from now on: then callers can skip what takes time to find, such as a
// suggestion.
bool diag_is_full(const struct diag_sink *sink);
// Each of these adds to the diagnostic that was added last, or does nothing if that was dropped.
void diag_note(struct diag_sink *sink, span at, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
// As diag_note, for a diagnostic that was added before.
void diag_note_to(struct diag_sink *sink, struct diag *item, span at, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
// It is about a copy, and one of the values with which it is.
void diag_with(struct diag_sink *sink, str name, str value);
void diag_help(struct diag_sink *sink, const char *format, ...) __attribute__((format(printf, 2, 3)));
void diag_fix(struct diag_sink *sink, bool safe, span at, str replacement);
// Another fix: a file that is created.
void diag_fix_file(struct diag_sink *sink, bool safe, str path, str text);
// As diag_fix, for the first place where `old` occurs in the text that the diagnostic is about; does nothing
// if it does not occur there literally.
void diag_fix_part(struct diag_sink *sink, const struct source_set *sources, bool safe, str old,
                   str replacement);

const struct diag_info *diag_info(diag_code code);
// The stage given by a code's first digit: "syntax", "binding", ...
const char *diag_stage(diag_code code);
// The code after this one, -1 for the first; DIAG_CODE_COUNT after the last.
diag_code diag_next(diag_code code);
// The code whose text is `code` ("E203"), case ignored; DIAG_CODE_COUNT if there is none.
diag_code diag_find(str code);

// Sorts by source, place and order of report; drops exact repeats (same code, place and message). If memory
// for sorting is lacking, the order of report stays.
void diag_sort(struct diag_sink *sink);
// Removes what `keep` refuses, in order; the counts follow the remaining diagnostics and their present
// severities. Diagnostics that were dropped are kept in the counts.
typedef bool diag_keep(void *context, struct diag *item);
void diag_filter(struct diag_sink *sink, diag_keep *keep, void *context);
// Adds a copy of all of `from` after those of `into`, the counts of dropped ones included.
void diag_merge(struct diag_sink *into, const struct diag_sink *from);

#endif
