// Reading the IR through the table, for code that knows no element's name.
//
// Thread safety: pure functions. Ownership: all pointers point into the scene.
#ifndef GLINT_GRAMMAR_IR_WALK_H
#define GLINT_GRAMMAR_IR_WALK_H

#include "core/arena.h"

struct ir_head;
struct ir_reference;
struct ir_scene;
struct schema_element;
struct schema_row;

// Every list of the IR begins like this.
struct ir_any_list {
    void *items;
    uint32_t count, capacity;
};

// The list of a SCHEMA_LIST row, and one of its items. Other kinds have the empty list.
struct ir_any_list ir_walk_list(const struct schema_row *row, const void *element);
void *ir_walk_item(const struct schema_row *row, struct ir_any_list list, uint32_t i);
// Appends a copy of `item` to the list; returns its index. May move the list.
uint32_t ir_walk_append(struct arena *arena, const struct schema_row *row, void *element, const void *item);
// Whether a list item has no name: it is then written where it is used, not in the list.
bool ir_walk_is_anonymous(const struct schema_element *schema, const void *item);

// The text of the element's key row (a name); empty if it has none.
str ir_walk_key(const struct schema_element *schema, const void *element);
// The list of such things; NULL: the owner has none.
const struct schema_row *ir_walk_list_of(const struct schema_element *owner,
                                         const struct schema_element *child);
// The name of a thing, its key or another row; empty if it has none.
str ir_walk_name(const struct schema_element *schema, const void *element);
// The scene's list that references to `target` point into; NULL if there is none.
const struct schema_row *ir_walk_pool(const struct schema_element *target);
// What a SCHEMA_REFERENCE row refers to: NULL if nothing was written or found.
const void *ir_walk_referent(const struct ir_scene *scene, const struct schema_row *row,
                             const struct ir_reference *reference);
// Whether the reference is a body written in place, not a name.
bool ir_walk_is_inline(const struct ir_scene *scene, const struct schema_row *row,
                       const struct ir_reference *reference);

// Whether the file gave row `i`. Lists: whether they have an item to show. Keys: whether there is a key.
bool ir_walk_written(const struct schema_element *schema, uint32_t i, const void *element);
// Whether a row of a choice is the one that the element's tag names; true for rows outside choices.
bool ir_walk_taken(const struct schema_element *schema, const struct schema_row *row, const void *element);
// Index of the short row if nothing else but the key was written, and it has no body in place: then its value
// can replace the element. -1 otherwise.
int ir_walk_short(const struct ir_scene *scene, const struct schema_element *schema, const void *element);
// The components of a vector, colour or weights; returns their number, 0 for other kinds.
uint32_t ir_walk_components(const struct schema_row *row, const void *field, double out[4]);

// The path of a file that this row of an element holds, written or not; NULL: it holds none. A reference has
// one if the row may name a file and the text is not a name, but has a point or a slash.
const str *ir_walk_path(const struct schema_row *row, const void *element);

// Calls `visit`, which may change it, for each file path in the scene.
typedef void ir_walk_visit_path(void *context, const struct schema_element *schema, void *element,
                                const struct schema_row *row, str *path);
void ir_walk_paths(struct ir_scene *scene, ir_walk_visit_path *visit, void *context);

// Calls `visit` for each reference in the scene, found or not.
typedef void ir_walk_visit_reference(void *context, const struct schema_row *row,
                                     const struct ir_reference *reference);
void ir_walk_references(const struct ir_scene *scene, ir_walk_visit_reference *visit, void *context);

static inline const struct ir_head *ir_walk_head(const void *element) {
    return element;
}

#endif
