// Judging a scene: everything that `glint check` reports about one file.
//
// Loads it, finds what replaces a missing camera or light, runs the rules for scenes, and then judges all
// findings: comments (`glint: allow W401`) and the policy of configuration and options remove some or change
// their severity. Ownership: as session_load. Thread safety: one call belongs to one thread; so does the
// store.
#ifndef GLINT_LOAD_CHECK_H
#define GLINT_LOAD_CHECK_H

#include "diag/diag_report.h"
#include "load/session.h"

// The session's sink then holds the findings, sorted. Whatever the result, session_finish accepts
// it.
enum session_state check_scene(struct session *session, const struct session_options *options,
                               struct asset_store *store);
// Whether a scene only holds things for others to use: neither a body nor a background, but materials,
// cameras or lights.
bool check_is_library(const struct ir_scene *scene);
// Whether the findings make the run fail.
bool check_failed(const struct session *session);

// Copies the findings and what is known of the scene into a record, with paths relative to `root`.
// false: no memory.
bool check_report(struct report_scene *out, struct session *session, const char *root);

#endif
