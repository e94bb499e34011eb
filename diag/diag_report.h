// What a run found, as data: one record per scene, with its findings copied out of the sink and the sources,
// so that both can be freed. diag_report_json.c, _sarif.c, _github.c, _gitlab.c and _junit.c turn it into
// text.
//
// Places are as in diag/source.h: lines and columns from 1, columns in code points, the end after the last
// character. Paths of findings are those of the sources, tidied (core/report_path).
// Ownership: everything in a scene's record is in the record's own arena (report_scene_finish). A report
// only points at the records. Thread safety: a record belongs to one thread while it is filled; reports are
// read-only.
#ifndef GLINT_DIAG_DIAG_REPORT_H
#define GLINT_DIAG_DIAG_REPORT_H

#include "core/arena.h"
#include "core/strbuf.h"
#include "diag/diag.h"
#include "diag/diag_share.h"

struct report_place {
    str path; // empty: no place
    uint32_t line, column, end_line, end_column;
};

struct report_note {
    struct report_place at;
    str message;
};

struct report_finding {
    diag_code code;
    enum diag_severity severity;
    struct report_place at;
    str scene_path; // "models[2].material"; empty: none is known
    str message;
    str help;      // empty: none
    str line_text; // the line, trimmed: what a fingerprint relies on when lines move
    struct report_note *notes;
    uint32_t note_count;
    struct diag_value *with; // as in struct diag
    uint32_t copies;
    bool has_fix;
    bool fix_is_safe;
    struct report_place fix_at;
    str fix_text;
};

struct report_file {
    str path;
    uint64_t size_bytes;
};

// The number of entries in a list of the scene.
struct report_count {
    const char *name; // the list's name: "spheres"
    uint32_t count;
};

struct report_assets {
    struct report_count *counts; // in the table's order
    uint32_t count_count;
    uint64_t triangles;
    uint32_t image_width, image_height; // of the background; 0: none
    struct report_file *files;          // every file that was read, the scene first
    uint32_t file_count;
};

enum report_state {
    REPORT_PASSED,
    REPORT_FAILED,     // findings that make the run fail
    REPORT_UNREADABLE, // the scene file could not be read
    REPORT_IGNORED,    // left out by the configuration
};

struct report_scene {
    struct arena arena;
    str path;
    enum report_state state;
    uint32_t errors, warnings, notes; // all findings, including those left out
    struct {
        struct report_finding *items;
        uint32_t count, capacity;
    } findings;
    struct diag_hidden left_out; // findings for which there was no room
    uint32_t in_baseline;        // findings that a baseline knows; not counted above
    bool has_assets;             // there is a scene
    struct report_assets assets;
};

struct report {
    const char *program_version;
    const char *home; // the address at which a reader finds glint and its docs/; empty: not known
    const char *root; // the folder that relative paths begin at; absolute
    struct report_scene *scenes;
    uint32_t scene_count;
    bool notes; // for a format that omits notes by default
};

void report_scene_init(struct report_scene *scene, str path);
void report_scene_finish(struct report_scene *scene);

// The scene path of a place in a file; the empty string if it has none. `context` is the caller's.
typedef str report_find_path(void *context, struct arena *arena, span at);
struct report_input {
    const struct diag_sink *sink; // sorted
    struct source_set *sources;
    const char *root; // absolute: paths below it become relative to it
    uint32_t most;    // findings to keep (diag/diag_share.h); up to the default limit, also within 550
                      // bytes of report each; the first error is always kept
    report_find_path *find_path; // NULL: none
    void *context;
};
// Copies the findings. false: no memory (what was copied stays).
bool report_scene_add(struct report_scene *scene, const struct report_input *input);
// The message limit that keeps all findings of the scene.
uint32_t report_needed(const struct report_scene *scene);
// A path as reports write it: relative to `root` if it is below, without "." and ".." as far as the text
// alone shows it.
str report_path(struct arena *arena, const char *root, str path);

// The findings of all scenes in one list, sorted by scene; a finding that several scenes report about one
// file is listed once. On the heap: free `items`.
struct report_item {
    const struct report_finding *finding;
    uint32_t scene;
    uint64_t fingerprint;
    uint32_t occurrence; // among equal fingerprints, from 1
};
struct report_list {
    struct report_item *items;
    uint32_t count;
};
// false: no memory.
bool report_list_all(const struct report *report, struct report_list *list);

// Text of the whole report. When memory runs out, out->failed is set.
void report_json(struct strbuf *out, const struct report *report);
void report_sarif(struct strbuf *out, const struct report *report);
void report_github(struct strbuf *out, const struct report *report);
void report_gitlab(struct strbuf *out, const struct report *report);
void report_junit(struct strbuf *out, const struct report *report);

#endif
