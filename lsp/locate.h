// What is at a place of the text: element, attribute, name or reference; and where a name is defined and
// used. Walks the table and the places beside the IR; knows no element's name.
// Thread safety: pure except for the sessions' line maps.
#ifndef GLINT_LSP_LOCATE_H
#define GLINT_LSP_LOCATE_H

#include "grammar/ir.h"
#include "grammar/schema.h"
#include "load/session.h"

struct located {
    const struct schema_element *schema; // NULL: nothing
    const void *element;
    const struct schema_row *row; // NULL: only the element
    bool in_value;                // else in the key
    span at;                      // of that key or value, or the element's label
    size_t offset;                // that was asked for
};

// The innermost thing at byte `offset` of the file `path` (canonical).
struct located locate(struct session *session, str path, size_t offset);
// The source of a file that the session read (canonical path), or SOURCE_DEFAULT.
uint32_t locate_source(struct session *session, str path);

// Something with a name that others refer to, and its places.
struct located_name {
    str name;
    const struct schema_element *schema; // of what has the name
    const void *element;
    span here; // the place that was asked about: the name
    span definition;
    struct {
        span *items;
        uint32_t count, capacity;
    } uses;
};
// The name at a located place, in a definition or a reference. Uses are in `arena`, which must be guarded.
// false: there is no name, or nothing has it.
bool locate_name(struct session *session, const struct located *at, struct arena *arena,
                 struct located_name *out);

// ---- locate_parameter.c: names of parameters in expressions

// The parameter whose name is at the place, in an expression; NULL: there is none. *word: the name's place.
const struct ir_parameter *locate_parameter(struct session *session, const struct located *at, span *word);
// Adds the places in expressions where a parameter is used.
void locate_parameter_uses(struct session *session, const struct ir_parameter *parameter, struct arena *arena,
                           struct located_name *out);

// ---- locate_walk.c

// Calls `visit` for every element of the scene: also included ones, and materials written in place.
typedef void locate_visit(void *context, const struct schema_element *schema, const void *element);
void locate_walk(const struct schema_element *schema, const void *element, locate_visit *visit,
                 void *context);

#endif
