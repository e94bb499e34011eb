// Which warnings and notes of a session are reported: comments (`glint: allow W401`) and policy remove some.
//
// Ownership: the session's. Thread safety: one call belongs to one thread.
#ifndef GLINT_LOAD_CHECK_ALLOW_H
#define GLINT_LOAD_CHECK_ALLOW_H

#include "load/session.h"

// Removes what comments in the scene files allow; with `report`, comments that allow nothing are findings
// themselves (W801, W802).
void check_allow(struct session *session, bool report);
// For commands other than check: removes the warnings and notes of a loaded session that comments allow or
// the configuration switches off.
void check_silence(struct session *session);

#endif
