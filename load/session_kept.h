// The text of a scene, read and merged once, for sessions that differ in their --set options and in the frame
// of the animation: for films and sweeps, whose pictures would all read it again.
//
// Only text without findings is kept: other text is read each time, for its findings. Ownership:
// reference-counted; sessions loaded from it hold a reference until session_finish. Errors: none; NULL if it
// cannot be kept. Thread safety: several threads may load and finish sessions of it at once.
#ifndef GLINT_LOAD_SESSION_KEPT_H
#define GLINT_LOAD_SESSION_KEPT_H

#include "load/session.h"

struct session_kept;

// Reads and keeps the scene that the options name, without their sets. NULL: no memory, or it cannot be kept:
// it has findings, or is a mesh or a text from memory.
struct session_kept *session_keep(const struct session_options *options);
// Whether a session with these options would read the same again: none of its files has changed.
bool session_kept_fits(const struct session_kept *kept, const struct session_options *options);
void session_kept_release(struct session_kept *kept); // NULL does nothing

#endif
