// Objects: their parameters, their entries, and what instances make of them. Private to parser/stages.
#ifndef GLINT_PARSER_STAGES_OBJECTS_H
#define GLINT_PARSER_STAGES_OBJECTS_H

#include "parser/stages/copies.h"

enum object_state {
    OBJECT_NEW,
    OBJECT_DECLARED, // its parameters have types
    OBJECT_READ,     // and its entries are read
};

struct object {
    const struct ir_object *ir;
    enum object_state state;
    const struct copy_entry *owner; // of one in place: the instance that it is written in
    double least;                   // so many things it makes at least, for each instance
    uint32_t waits;                 // for so many instances to be read
    uint32_t uses;                  // instances that show it, as they are written
    uint32_t shown;                 // and with their copies
    struct parameter *parameters;
    uint32_t *order; // of the parameters: each after those that it is computed from
    uint32_t ordered;
    // What is in reach of its entries: of one in place, what is in reach of its owner, then its parameters.
    str *names;
    struct copy_variable *types;
    uint32_t outer, reach;        // how many are the owner's; in all
    struct copy_entry ***entries; // by row of SCHEMA_OBJECT, and place in that list
};

struct objects {
    struct object *items;
    uint32_t count;
    struct object **queue; // to be read
    uint32_t queued;
};

// objects.c
// Reads all objects of the scene, and the entries of the scene's instances.
void objects_read(struct evaluation *e);
// Warns of objects, and of their parameters, that nothing uses.
void objects_tell_unused(const struct evaluation *e);

// objects_with.c
// Gives parameters their types. false: there are too many names.
bool objects_declare(struct evaluation *e, struct object *object);
// Reads what an instance gives to the parameters of its object.
void objects_read_given(struct evaluation *e, struct copy_entry *entry);

// copies_reach.c
// The names that an object's entries see come into reach, without values. NULL: those of the scene's.
void objects_reach(struct evaluation *e, const struct object *object);

// objects_make.c
// Reports if instances would make too many things for certain.
void objects_check_count(struct evaluation *e);
// Adds to the scene's lists what instances make.
void objects_make(struct evaluation *e);
// Lists the objects with names.
void objects_list(const struct evaluation *e, struct ir_copies *copies);

#endif
