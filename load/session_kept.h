// The text of a scene, read and merged once, for sessions that differ in their --set options and in the frame
// of the animation: for films and sweeps, whose pictures would all read it again.
//
// Only of text without findings: who loads others gets their findings each time. Ownership: counted; sessions
// that were loaded of it hold it too, until session_finish. Errors: none; NULL where it cannot be kept.
// Thread safety: sessions of it may be loaded and finished by several threads at once.
#ifndef GLINT_LOAD_SESSION_KEPT_H
#define GLINT_LOAD_SESSION_KEPT_H

#include "load/session.h"

struct session_kept;

// What the options name, but for their sets. NULL: no memory, or it cannot be kept: it has findings, or is a
// mesh or a text from memory.
struct session_kept *session_keep(const struct session_options *options);
// Whether a session with these options would read the same again: none of its files has changed.
bool session_kept_fits(const struct session_kept *kept, const struct session_options *options);
void session_kept_release(struct session_kept *kept); // NULL does nothing

#endif
