// Scene files changed at random: what an editor, a merge, another system or an attacker makes of them.
//
// Line ends of every kind (CR, NEL, LS, PS), marks of comments and of values in either spelling, bytes that
// vanish, come twice or come from elsewhere in the text. The same state gives the same text, on every
// machine. Output: the changed text, in place of what `out` holds. Errors: out->failed. Ownership: the
// caller's. Thread safety: one state belongs to one thread.
#ifndef GLINT_TESTS_GENERATE_MUTATE_H
#define GLINT_TESTS_GENERATE_MUTATE_H

#include "core/strbuf.h"

#include <stdint.h>

// One to four changes of `text`, which must not lie in `out`.
void mutate_text(uint64_t *state, str text, struct strbuf *out);

#endif
