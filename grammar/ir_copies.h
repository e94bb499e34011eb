// Which bodies and lights of a scene are copies, and of what: `for` and `if` have been carried out.
//
// Ownership: the arena of the scene. Thread safety: immutable once the scene is loaded.
#ifndef GLINT_GRAMMAR_IR_COPIES_H
#define GLINT_GRAMMAR_IR_COPIES_H

#include "core/strbuf.h"
#include "diag/source.h"

#include <stdbool.h>
#include <stdint.h>

struct ir_instances;
struct ir_scene;
struct schema_row;

enum {
    IR_VARIABLES_MOST = 16 // of one entry
};

struct ir_copy {
    uint32_t entry;  // in the list as it is written, of the scene or of the object
    uint32_t places; // in ir_copies.places: how many, and each variable's; 0: the entry itself
    uint32_t
        instance; // 1 + the scene's instance, each copy of one, in whose object the entry is; 0: in no object
};
// An entry that is written with 'for' or 'if'.
struct ir_copied {
    const struct schema_row *list; // of the scene
    uint32_t entry;                // in the list as it is written
    uint32_t count;                // of copies
    str name;                      // empty: none
    span at;
};
// An object that the scene describes, and how many instances show it, copies counted.
struct ir_shown {
    str name;
    uint32_t instances;
    span at;
};
struct ir_copies {
    struct ir_copy **lists; // by row of the scene, as long as the scene's list; NULL: it is as written
    uint32_t *places;
    struct {
        struct ir_copied *items;
        uint32_t count, capacity;
    } entries;
    struct {
        struct ir_shown *items;
        uint32_t count, capacity;
    } objects;                            // with names, in their order
    const struct ir_instances *instances; // of the scene
    const struct ir_scene *document;      // objects and instances as they are written, and nothing else
};

// What an item of a list of the scene is called if it has no name: spheres[2], spheres[2][3],
// chairs[3]/boxes[1]. `copies` may be NULL.
void ir_copies_label(const struct ir_copies *copies, const struct schema_row *list, uint32_t index,
                     struct strbuf *out);
// The same without the list: [2], [2][3].
void ir_copies_index(const struct ir_copies *copies, const struct schema_row *list, uint32_t index,
                     struct strbuf *out);
// The places of an item in the ranges of its variables, after the number of them; NULL: it is not a copy.
const uint32_t *ir_copies_at(const struct ir_copies *copies, const struct schema_row *list, uint32_t index);
// 1 + the instance in whose object the item is; 0: in none.
uint32_t ir_copies_instance(const struct ir_copies *copies, const struct schema_row *list, uint32_t index);
// Whether two such instances, of two scenes, are called the same; 0 is none.
bool ir_copies_are_same(const struct ir_copies *a, uint32_t instance_a, const struct ir_copies *b,
                        uint32_t instance_b);
// What an instance is called, with those around it: chairs[3]/legs[0]. `instance`: from 0.
void ir_copies_instance_name(const struct ir_copies *copies, uint32_t instance, struct strbuf *out);
// The same without the places of copies: what all copies of the entry share.
void ir_copies_entry_label(const struct ir_copies *copies, const struct schema_row *list, uint32_t index,
                           str name, struct strbuf *out);
// The entry in the list as it is written that an item of a scene's list comes from. Any other row: `index`.
uint32_t ir_copies_entry(const struct ir_copies *copies, const struct schema_row *list, uint32_t index);
// A name without its places: pawn of pawn[3].
str ir_copies_base(str name);

#endif
