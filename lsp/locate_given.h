// What parameters of objects come to in the instances that the evaluated scene has.
//
// Ownership: the arenas that are given, which must be guarded. Thread safety: as of locate.h.
#ifndef GLINT_LSP_LOCATE_GIVEN_H
#define GLINT_LSP_LOCATE_GIVEN_H

#include "grammar/ir_formula.h"
#include "lsp/locate.h"

struct located_copies {
    const struct session *session;
    struct arena *arena;
    const struct located_scope **instances; // by origin: those that are written
    uint32_t count;
};
struct located_copies locate_copies_begin(const struct session *session, struct arena *arena);
// What the written instance sees that one of the evaluated scene comes from; NULL: it is not known.
const struct located_scope *locate_made(const struct located_copies *copies, uint32_t instance);

// The value of a text in `with` of an instance of the evaluated scene. false: it has none.
bool locate_given(struct located_copies *copies, struct arena *arena, uint32_t instance, str text,
                  struct ir_result *result);
// The value of a parameter of the object that the instance shows. `scope`: where it is written.
bool locate_argument(struct located_copies *copies, struct arena *arena, uint32_t instance,
                     const struct located_scope *scope, const struct ir_parameter *parameter,
                     struct ir_result *result);

#endif
