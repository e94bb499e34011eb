// Where each part of the IR is in the files, kept outside the IR. Equality, dump and diff of meaning ignore
// it.
//
// For each element its span; for each row that the file gave, the spans of key and value and of the
// comments before it; for each file its schema line and its own list of includes (for `convert`).
// Ownership: the arena of the scene. Thread safety: immutable once the scene is loaded.
#ifndef GLINT_GRAMMAR_IR_ORIGIN_H
#define GLINT_GRAMMAR_IR_ORIGIN_H

#include "core/arena.h"
#include "diag/source.h"

struct ir_copies;
struct ir_formulas;
struct ir_head;
struct ir_scene;
struct schema_element;

struct ir_row_origin {
    uint32_t row;      // index in the element's schema
    span key;          // the key, attribute name or child's tag name
    span value;        // the value; a child element's whole extent
    uint32_t comments; // before it, in ir_origin.comments; 0: none
    uint32_t next;     // in ir_origin.rows, in the order of the calls; 0: none
};

struct ir_element_origin {
    span at;           // the whole element (an entry of a list: its value)
    span label;        // what to point at: the name, the key or the tag name
    uint32_t comments; // before an entry of a list, in ir_origin.comments; 0: none
    uint32_t rows;     // the first in ir_origin.rows; 0: none
};

struct ir_file_origin {
    uint32_t source;
    bool is_xml;
    span included_at;       // the path in the file that includes it; the main file: SPAN_NONE
    span schema_line;       // the editor's line: `# yaml-language-server: ...` or `<?xml-model ...?>`
    str xsi_attributes;     // schema attributes of <Scene>, kept as text; empty: none
    struct ir_scene *scene; // only this file, before merging
    span closing_comments;  // comments after the last entry
};

struct ir_origin {
    struct arena *arena;
    struct ir_formulas *formulas;   // of all files
    struct ir_copies *copies;       // of the loaded scene; NULL: there are none
    const struct ir_scene *written; // it before values were computed; NULL: none are, or nobody asked for it
    struct {
        struct ir_element_origin *items;
        uint32_t count, capacity;
    } elements; // [0] is "no place"
    struct {
        struct ir_row_origin *items;
        uint32_t count, capacity;
    } rows; // of all elements; [0] is none
    struct {
        span *items;
        uint32_t count, capacity;
    } comments; // each from the first to the last comment before something; [0] is SPAN_NONE
    struct {
        struct ir_file_origin *items;
        uint32_t count, capacity;
    } files; // [0] is the main scene's
    struct {
        span *items;
        uint32_t count, capacity;
    } directives; // comments to glint itself ("glint: allow W401"), file by file
    struct {
        int32_t frames; // 0: nothing moves
        double rate;
    } motion; // the animation's settings, kept after a frame is taken
};

void ir_origin_init(struct ir_origin *origin, struct arena *arena);
// A new element; returns the id for ir_head.origin.
uint32_t ir_origin_add(struct ir_origin *origin, struct ir_element_origin element);
// For the two before: what ir_origin.comments has the place as; SPAN_NONE: 0.
uint32_t ir_origin_add_comments(struct ir_origin *origin, span comments);
// Adds the row's places, kept in the order of the calls; adding a row again replaces its places.
void ir_origin_add_row(struct ir_origin *origin, uint32_t element, struct ir_row_origin row);
// Forgets the row's places, if it has any.
void ir_origin_remove_row(struct ir_origin *origin, uint32_t element, uint32_t row);

// NULL if the row has no place. Valid until something is added.
const struct ir_row_origin *ir_origin_row(const struct ir_origin *origin, const struct ir_head *head,
                                          uint32_t row);
// The span to show for a row: its value if it has a place, else the element's label. `row_name` must exist in
// the schema.
span ir_place_value(const struct ir_origin *origin, const struct ir_head *head,
                    const struct schema_element *schema, const char *row_name);
span ir_place_key(const struct ir_origin *origin, const struct ir_head *head,
                  const struct schema_element *schema, const char *row_name);
span ir_place_label(const struct ir_origin *origin, const struct ir_head *head);
// Whether a source is a file of the scene that is written in XML.
bool ir_origin_is_xml(const struct ir_origin *origin, uint32_t source);

#endif
