// Binding: a neutral tree to the IR of one file, by walking the schema table. Private to parser/.
//
// The binder knows kinds of rows and never an element's name. Every mistake is reported once; a row whose
// value fails keeps its default and is marked in ir_head.poisoned. Nodes that the reader has reported
// (TREE_BAD) poison their row silently.
// Ownership: IR, text and places go into `arena`; `scratch` lives until the file is bound.
// Thread safety: one context belongs to one thread.
#ifndef GLINT_PARSER_BIND_BIND_H
#define GLINT_PARSER_BIND_BIND_H

#include "core/limits.h"
#include "core/str_map.h"
#include "diag/diag.h"
#include "grammar/ir_origin.h"
#include "grammar/ir_value.h"
#include "grammar/schema_index.h"
#include "parser/tree/tree.h"

struct ir_scene;

// Recently copied strings: consecutive entries name the same meshes and materials.
enum {
    BIND_TEXTS = 256
};
struct bind_texts {
    str items[BIND_TEXTS];
};

// The keys of one list's entries.
struct bind_list_keys {
    const void *list;
    uint32_t count;     // how many of its entries are in the map
    struct str_map map; // 1 + index
};

struct bind_context {
    struct bind_list_keys keys;
    struct diag_sink *sink;
    const struct source_set *sources;
    const struct limits *limits;
    struct ir_origin *origin;
    struct arena *arena;
    struct arena *scratch;
    struct ir_scene *scene; // takes the anonymous elements of references; NULL before bind_file, or where
                            // entries were taken beforehand
    const struct schema_index *index;
    struct bind_texts *texts; // in `arena`
    const struct tree *tree;
    bool plain;         // nothing may be computed: an expression is a mistake
    bool other_version; // the file says that it is written in a version that this program does not know
};

// One element while it is being bound, and the way to it.
struct bind_frame {
    const struct bind_frame *parent; // NULL: the scene
    const struct schema_element *schema;
    const struct schema_row *via; // the parent's row that holds it; NULL: the scene
    void *memory;                 // the element's struct, with its defaults before anything is bound
    str name;                     // as written; empty: none
    span label;                   // what a diagnostic about the element points at
    span comments;                // before an entry of a list
    bool bare;                    // its value is written without the name of the short row
    uint64_t seen;                // rows that are given, right or wrong
    uint64_t guessed;             // rows that an unknown name was probably meant to be
};

// Where a row's value comes from.
struct bind_given {
    tree_index key; // 0: none (an option); XML lists are gathered from here
    span key_span;
    span comments;
    tree_index value;
};

// A value's place in the language, for messages: 'colors[1].r' of ...
struct bind_subject {
    const struct bind_frame *frame;
    const struct schema_row *row; // NULL: the element itself
    int index;                    // SCHEMA_FIXED: which; -1: none
    const char *component;        // "x"; NULL: the whole
};

static inline struct ir_head *bind_head(const struct bind_frame *frame) {
    return frame->memory;
}
static inline uint64_t bind_bit(uint32_t row) {
    return (uint64_t)1 << row;
}
static inline void bind_poison(struct bind_frame *frame, uint32_t row) {
    bind_head(frame)->poisoned |= bind_bit(row);
}
// Whether a text is not longer than an expression may be; else that is reported.
bool bind_fits(const struct bind_context *context, str text, span at);
// A row of an element, or the element itself if `row` is NULL.
static inline struct bind_subject bind_subject(const struct bind_frame *frame, const struct schema_row *row) {
    return (struct bind_subject){.frame = frame, .row = row, .index = -1};
}
static inline bool bind_is_bad(const struct bind_context *context, tree_index node) {
    return (tree_node(context->tree, node)->flags & TREE_BAD) != 0;
}
// Whether the reader has reported the node, or broke off in it, so that its value cannot be judged.
static inline bool bind_is_known(const struct bind_context *context, tree_index node) {
    return (tree_node(context->tree, node)->flags & (TREE_BAD | TREE_CUT)) != 0;
}
// Whether a pair of `map` cannot be judged: the reader has reported it, or the file broke off inside it.
static inline bool bind_is_bad_pair(const struct bind_context *context, tree_index map, tree_index key) {
    const struct tree *tree = context->tree;
    bool cut = (tree_node(tree, map)->flags & TREE_CUT) && !tree_next_key(tree, key) &&
               tree_node(tree, tree_value(tree, key))->kind == TREE_NULL;
    return cut || bind_is_bad(context, key);
}
static inline enum tree_kind bind_kind(const struct bind_context *context, tree_index node) {
    return tree_node(context->tree, node)->kind;
}

// The rows of an element's first keys, which are asked for twice.
struct bind_key_rows {
    uint32_t count;
    struct {
        int row;
        bool single;
    } items[16];
};

// The values of one row, one after the other.
struct bind_values {
    bool repeated; // XML
    bool named;    // a YAML map
    uint32_t row;
    tree_index at; // a key if repeated or named, else an item; 0: no more
};

// Entries that are recognised despite a mistake.
struct bind_found {
    str name; // empty: none
    struct bind_given given;
};
struct bind_entries {
    struct bind_found *items;
    uint32_t count, capacity;
};

// The probable meaning of a name that the element does not have, if that is clear.
struct bind_meant {
    enum {
        BIND_MEANT_NOTHING,
        BIND_MEANT_ROW,     // `row`, in another style
        BIND_MEANT_ITSELF,  // the element, around its own rows once more
        BIND_MEANT_ENTRIES, // a list, around entries that are written without one
    } what;
    uint32_t row;
};

// bind_file.c
// A scene at its defaults.
struct ir_scene *bind_new_scene(struct bind_context *context);
// The scene of only this tree; NULL if the tree is not a scene, or one of another version (reported).
struct ir_scene *bind_file(struct bind_context *context);

// bind_element.c: the only recursive file of the binder; it calls the files below, and none of them calls it.
// Binds all rows of `node` into frame->memory, and checks that required ones exist. false: the node does not
// have the shape of the element (reported, or known to the reader).
bool bind_element(struct bind_context *context, struct bind_frame *frame, tree_index node);
// Binds all pairs of a map as rows of the element: names first, so that messages can use them.
void bind_pairs(struct bind_context *context, struct bind_frame *frame, tree_index node);
// The rows that come first, or the others.
void bind_keys(struct bind_context *context, struct bind_frame *frame, tree_index node, bool first,
               struct bind_key_rows *known);
// Binds one row; `single` as schema_find_yaml returns it.
void bind_row(struct bind_context *context, struct bind_frame *frame, uint32_t row, bool single,
              struct bind_given given);
// An entry of a list, bound into memory of its own and appended to the parent's row; `name`: its key.
// false: no entry was added.
bool bind_entry(struct bind_context *context, struct bind_frame *parent, const struct schema_row *row,
                str name, struct bind_given given);
// Binds an entry into memory that it has already (an override of a whole entry).
bool bind_entry_into(struct bind_context *context, struct bind_frame *child, struct bind_given given);

// bind_row.c
// The row that a key names at its place, or -1. The key of a named map's entry is not a row.
int bind_find_row(const struct bind_context *context, const struct schema_element *schema, tree_index key,
                  bool *is_single);
// Where a key's value comes from.
struct bind_given bind_given_by(const struct bind_context *context, tree_index key);
// Records the places of a row that was given.
void bind_note_row(struct bind_context *context, struct bind_frame *frame, uint32_t row,
                   struct bind_given given);
void bind_report_twice(struct bind_context *context, struct bind_frame *frame, uint32_t row,
                       struct bind_given given);
// A copy in the scene's arena, shared by equal strings.
str bind_copy_once(struct bind_context *context, str text);
// A frame for values that cannot be kept, yet may have mistakes of their own.
struct bind_frame bind_aside(struct bind_context *context, const struct bind_frame *frame);

// bind_missing.c
// Reports required rows and choices that are not there; `silent`: only marks them.
void bind_missing(struct bind_context *context, struct bind_frame *frame, bool silent);

// bind_fixed.c
// The value after values->at; 0: it was the last.
tree_index bind_next_value(const struct bind_context *context, const struct bind_frame *frame,
                           const struct bind_values *values);
// A row with a fixed number of values. `may_be_cut`: the file broke off, so that some may be missing.
void bind_fixed(struct bind_context *context, struct bind_frame *frame, uint32_t row, struct bind_given given,
                struct bind_values values, bool may_be_cut);

// bind_loose.c: values recognised despite a reported mistake are still read, so that their own mistakes show
// in the same run and names in them are known. Rows touched are poisoned by the caller.
// The entries in a value of the wrong shape, in scratch; replaces the last diagnostic's help if there is a
// better one than an example (`reported`).
struct bind_entries bind_loose_entries(struct bind_context *context, const struct schema_row *row,
                                       tree_index value, bool reported);
// Keys after `key` that belong in its value, one column further right: `outer` (NULL: none) does not have
// them, but the elements of `row` do. Reports and marks them, and the element that lacks them.
void bind_loose_columns(struct bind_context *context, const struct bind_frame *outer,
                        const struct schema_row *row, tree_index key);
// {position: 0, 0, 0}: in a flow map the commas turn all numbers but the first into keys. true: that was so;
// it is reported with the meant list, and the keys are marked as known.
bool bind_loose_numbers(struct bind_context *context, struct bind_frame *frame, uint32_t row, tree_index map,
                        tree_index key);
// Whether a list has numbers where it should have lists of numbers, as a matrix in one line (reported).
bool bind_flat_numbers(struct bind_context *context, struct bind_subject subject, tree_index list);
// The same for rows of a matrix of three numbers each.
bool bind_short_rows(struct bind_context *context, struct bind_subject subject, tree_index list);

// bind_entry.c
// An entry at its defaults, in scratch.
struct bind_frame bind_entry_begin(struct bind_context *context, const struct bind_frame *parent,
                                   const struct schema_row *row, str name, struct bind_given given);
// Gives an entry of a named map the key that precedes it.
void bind_entry_key(struct bind_context *context, struct bind_frame *child, struct bind_given given);
// Gives an element that has no key the standard one of its list, if that has one.
void bind_default_key(struct bind_context *context, struct bind_frame *child);
// Whether the parent's list has an entry of this key already; reports it. (Names of the scene's own things
// are compared across all files later.)
bool bind_is_second(struct bind_context *context, const struct bind_frame *parent,
                    const struct bind_frame *child);

// bind_list.c
// Appends a copy of `item` to the list in `field`, whose items have `size` bytes and may move; returns its
// index.
uint32_t bind_list_push(struct arena *arena, void *field, const void *item, uint32_t size);
void *bind_list_item(void *field, uint32_t index, uint32_t size);
uint32_t bind_list_count(const void *field);
// Forgets all items; a large list's memory is free again.
void bind_list_give_back(struct arena *arena, void *field, uint32_t size);
void bind_list_remove(void *field, uint32_t index, uint32_t size);
// Keeps the first `count` items.
void bind_list_cut(void *field, uint32_t count);
// Puts a row back to its default and forgets that it was written.
void bind_clear_row(struct arena *scratch, struct ir_origin *origin, const struct schema_element *schema,
                    void *memory, uint32_t row);
// The scene's row whose list holds elements of this schema; never -1 for the child of a reference.
uint32_t bind_home_row(const struct schema_element *schema);

// bind_composite.c: one value of a row that holds neither elements nor lists. false: reported or known.
bool bind_value(struct bind_context *context, struct bind_subject subject, tree_index node, void *out);

// bind_scalar.c: a value that is not a vector, colour or weights.
bool bind_scalar(struct bind_context *context, struct bind_subject subject, tree_index node, void *out);
bool bind_number(struct bind_context *context, struct bind_subject subject, tree_index node, double *out);
bool bind_name_text(struct bind_context *context, struct bind_subject subject, str text, span at);
// Reports a value of the wrong shape, unless the reader has reported the node. Always false.
bool bind_wrong_shape(struct bind_context *context, struct bind_subject subject, tree_index node);
// Adds an example of the value to the diagnostic that was reported last.
void bind_help_example(struct bind_context *context, struct bind_subject subject);
// Adds how the value must be written: with the author's own numbers if they can be told apart, else with an
// example.
void bind_help_shape(struct bind_context *context, struct bind_subject subject, tree_index node);
// The same, but adds nothing if they cannot be told apart. For a list its text is used. false: nothing was
// added.
bool bind_help_numbers(struct bind_context *context, struct bind_subject subject, tree_index node);

// bind_formula.c
// Takes text as an expression, if the row may be computed and the text can be meant as one. false: it
// cannot, and nothing is reported.
bool bind_formula(struct bind_context *context, struct bind_subject subject, tree_index node);
// An expression that YAML has cut into items at its commas: takes all of them. The last of them, or 0: `item`
// does not begin one.
tree_index bind_torn_item(struct bind_context *context, struct bind_subject subject, tree_index item);
// The same in a map in braces, where the pieces became keys: reports it, with quotes as the fix, and marks
// the keys as known. false: it is not so.
bool bind_torn_pair(struct bind_context *context, struct bind_frame *frame, uint32_t row, tree_index map,
                    tree_index key);

// bind_values.c: text of SCHEMA_TEXT_VALUES. false: reported or known.
bool bind_values(struct bind_context *context, struct bind_subject subject, tree_index node, str *out);

// bind_color.c
// A colour from text: #rrggbb, or one number.
bool bind_color_text(struct bind_context *context, struct bind_subject subject, tree_index node,
                     struct ir_color *out);
// Reports text that is not a colour, with the colour that other programs would read. Always false.
bool bind_bad_color(struct bind_context *context, struct bind_subject subject, tree_index node);
// Asks whether three numbers are bytes.
void bind_check_bytes(struct bind_context *context, struct bind_subject subject, tree_index node,
                      const double rgb[3]);

// bind_child.c
// Proposes `child`, an element, in place of the attribute with this value.
void bind_fix_as_child(struct bind_context *context, tree_index value, str child);

// bind_names.c
// The row that a key names in another style ('LookAt', 'lookAt', 'look-at'), or in the plural if one is
// meant; -1: none.
int bind_find_style(struct bind_context *context, const struct bind_frame *frame, tree_index key);
// Proposes another name for an element of XML, in its end tag too.
void bind_fix_tag(struct bind_context *context, span at, tree_index element, bool safe, str right);
// Reports a name that the element does not have, with what may have been meant.
struct bind_meant bind_unknown_name(struct bind_context *context, struct bind_frame *frame, tree_index key);

#endif
