// What is at a place of the text: element, attribute, name or reference; and where a name is defined and
// used. Walks the table and the places beside the IR; knows no element's name.
// Thread safety: pure except for the sessions' line maps.
#ifndef GLINT_LSP_LOCATE_H
#define GLINT_LSP_LOCATE_H

#include "core/strbuf.h"
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

// ---- locate_walk.c

// The scene as it is written; session->scene has the copies that `for` and `if` make.
const struct ir_scene *locate_scene(const struct session *session);

// Where an element's name is written: in a map of YAML as the key, elsewhere as the key row's value.
span locate_name_place(const struct session *session, const struct schema_element *schema,
                       const void *element);

// Calls `visit` for every element of the scene: also included ones, and materials written in place.
typedef void locate_visit(void *context, const struct schema_element *schema, const void *element);
void locate_walk(const struct schema_element *schema, const void *element, locate_visit *visit,
                 void *context);

// The names that an element's expressions see before those of the scene: variables of the entry that it is
// in, or is, parameters of the object that it is in, and, where that is in place, what its instance sees.
struct located_scope {
    const struct schema_row
        *list; // of the entry, in the scene or in an object; NULL: it is in none that can have variables
    const void *entry;
    uint32_t reach;                     // so many of the variables: in what makes a variable, those before it
    const struct ir_object *object;     // NULL: it is in none
    const struct located_scope *around; // NULL: only the scene's parameters
};
// All variables of the entry.
struct ir_variables locate_variables(const struct located_scope *scope);
// The same walk through the scene as it is written, but for the scene itself. Scopes are in `arena`.
typedef void locate_visit_scoped(void *context, const struct schema_element *schema, const void *element,
                                 const struct located_scope *scope);
void locate_walk_scoped(const struct session *session, struct arena *arena, locate_visit_scoped *visit,
                        void *context);
// Whether a row of the table is a list of entries that can have variables.
bool locate_has_entries(const struct schema_row *row);
// The object that an instance shows, in the scene as it is written; NULL: none that is known.
const struct ir_object *locate_shown(const struct session *session, const struct ir_instance *instance);
// Whether the element is a parameter of an object.
bool locate_is_argument(const struct schema_element *schema, const struct located_scope *scope);

// ---- names

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
    struct located_scope scope; // of a variable, and of an object's parameter: where it is written
    bool is_shared;             // a place in `uses` is also another's, through an anchor
};
// The name at a located place, in a definition or a reference. Uses are in `arena`, which must be guarded.
// false: there is no name, or nothing has it.
bool locate_name(struct session *session, const struct located *at, struct arena *arena,
                 struct located_name *out);

// ---- locate_paths.c: names in targets of tracks, and in whole names of bodies

// Calls `visit` for each of them that names something: what, and the place of the name.
typedef void locate_visit_named(void *context, const struct schema_element *schema, const void *element,
                                span at);
void locate_named(const struct session *session, locate_visit_named *visit, void *context);

// ---- locate_words.c: names in expressions, of parameters and variables

// The entry around an element of the written scene.
struct located_scope locate_scope(const struct session *session, const void *element, struct arena *arena);
// What the name at a place in an expression means: its schema, element, place and scope. false: nothing.
bool locate_word(const struct session *session, const struct located *at, struct arena *arena,
                 struct located_name *out);
// Adds the places in expressions where a parameter or variable is used.
void locate_word_uses(const struct session *session, struct arena *arena, struct located_name *name);
// Why it cannot have another name, as `text` would then mean something else somewhere; NULL: it can.
const char *locate_word_conflict(const struct session *session, struct arena *arena,
                                 const struct located_name *name, str text);

// ---- locate_values.c: what is computed

// Appends what a variable is in the copies: "0 to 11", "one of 2 values: -4, 3"; nothing if no copy is known.
void locate_print_variable(const struct session *session, const struct located_scope *scope,
                           const struct ir_variable *variable, struct strbuf *out);
// Whether a row is `for` or `if`.
bool locate_is_of_copies(const struct schema_row *row);
// The number of copies that an entry makes.
uint32_t locate_copies(const struct session *session, const struct located_scope *scope);
// Appends what is computed at a place, also in all copies: "center.x = 3", "radius = 0.2 to 2.4 in 12
// copies". false: what is there is not computed, or has no value.
bool locate_print_value(const struct session *session, const struct located *at, struct arena *arena,
                        struct strbuf *out);
// The number of instances that show an object, each copy of one.
uint32_t locate_instances(const struct session *session, const struct ir_object *object, struct arena *arena);
// Appends what a parameter of an object comes to in the instances that show it: "2 to 3 in 12 instances".
// false: in none.
bool locate_print_argument(const struct session *session, const struct located_scope *scope,
                           const struct ir_parameter *parameter, struct arena *arena, struct strbuf *out);
// The same of what an instance gives a parameter. `scope`: of that place.
bool locate_print_given(const struct session *session, const struct located_scope *scope,
                        const struct ir_with *with, struct arena *arena, struct strbuf *out);

#endif
