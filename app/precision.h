// The precision that a shot is traced in: the scene's setting, what its numbers need, what the device has.
//
// Ownership: nothing is kept. Thread safety: as the session.
#ifndef GLINT_APP_PRECISION_H
#define GLINT_APP_PRECISION_H

#include "app/session.h"
#include "core/strbuf.h"
#include "precision/precision.h"

// The input of flattening for a session seen in this view; `view` must outlive it.
struct flat_input precision_input(struct session *session, const struct view *view);

// Sets input->is_double. Pixels of the scene are tried if its setting is auto. `has_double`: the device can.
// The session's sink gets the error E707, or the warning W701. false: an error, or no memory.
bool precision_choose(struct session *session, struct flat_input *input, bool has_double);
// Warns (W417) if the scene asks for single precision and needs double. The session's arena must be
// guarded.
void precision_check(struct session *session);
// What was measured, what it means, and which body decides: lines of `glint inspect`.
void precision_words(const struct session *session, const struct precision_choice *choice,
                     struct strbuf *out);

#endif
