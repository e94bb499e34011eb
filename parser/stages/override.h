// `--set PATH=VALUE`: one option's path as steps, and where it leads in the merged scene. Private to parser/.
// Thread safety: one thread.
#ifndef GLINT_PARSER_STAGES_OVERRIDE_H
#define GLINT_PARSER_STAGES_OVERRIDE_H

#include "core/str_map.h"
#include "parser/bind/bind.h"
#include "parser/stages/loader.h"

enum override_step_kind {
    OVERRIDE_KEY,   // a key after a point, or the first
    OVERRIDE_INDEX, // [0]
    OVERRIDE_NAME,  // [name]
};

struct override_step {
    enum override_step_kind kind;
    str text;
    uint32_t index;
    size_t begin, end; // in the path's text
    span at;
};

enum {
    OVERRIDE_STEPS_MAX = 16
};

// Shared by many paths into one scene, which does not change meanwhile: entries by their names, indexed per
// list when first asked for.
struct override_names {
    const void *list;
    struct str_map entries; // 1 + index
    struct override_names *next;
};
struct override_index {
    struct override_names *lists; // in the loader's scratch
    uint32_t searches;            // searches through a whole list, for messages
};

struct override {
    struct loader *loader;
    struct ir_scene *scene;
    struct bind_context context;
    uint32_t source; // the option's text
    str text;
    struct override_index *index; // for a track's path; NULL: the scene changes from path to path
    bool is_track;                // the path is a track's, without '=': findings are about the track
    span track;                   // its text in the file
    uint32_t value_begin;         // after '='
    span path;                    // all of it
    struct override_step steps[OVERRIDE_STEPS_MAX];
    uint32_t step_count;
    uint32_t entry; // of the first list on the way, once it was followed
};

// The target of a path.
enum override_target_kind {
    OVERRIDE_ROW,       // a row of an element
    OVERRIDE_ENTRY,     // an entry of a list or named map
    OVERRIDE_COMPONENT, // of a vector, colour or weights
};

struct override_target {
    enum override_target_kind kind;
    struct bind_frame *frame; // the element that holds the row
    uint32_t row;
    uint32_t entry;     // OVERRIDE_ENTRY: its index; the list's length for a new entry of a named map
    str name;           // OVERRIDE_ENTRY in a named map: its key
    int slot;           // OVERRIDE_COMPONENT in one of a fixed number of values; -1: none
    uint32_t component; // OVERRIDE_COMPONENT: 3 and less; COMPONENT_ALL: the whole slot
};
enum {
    OVERRIDE_WHOLE_SLOT = UINT32_MAX
};

// override_path.c
// Splits the option; false: reported (E219).
bool override_parse(struct override *o);
// Splits a path without a value. false: reported.
bool override_parse_path(struct override *o);
// The code of a finding about the path: this one, or the one for tracks.
diag_code override_code(const struct override *o, diag_code code);

// override.c
// The element and all that contain it count as written, with places of their own at the path.
void override_mark(struct override *o, struct bind_frame *frame);

// override_walk.c
// Follows the steps; false: reported (E220, E221).
bool override_walk(struct override *o, struct override_target *target);
// The element of a target that is an entry.
struct bind_frame *override_enter(struct override *o, const struct override_target *target);

#endif
