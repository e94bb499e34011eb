// The precision that a shot is traced in: from the scene's setting, what its numbers need, and what the
// device has.
//
// Ownership: nothing is kept. Thread safety: as the session.
#ifndef GLINT_LOAD_SESSION_PRECISION_H
#define GLINT_LOAD_SESSION_PRECISION_H

#include "core/strbuf.h"
#include "load/session.h"
#include "measure/precision.h"

// The input of flattening for a session seen in this view; `view` must outlive it.
struct flat_input precision_input(struct session *session, const struct view *view);

// What a trial leaves and waits for: members of struct precision_trial.
struct precision_wish {
    struct reference **reference;
    bool (*ready)(void *context);
    void *ready_context;
    struct precision_choice *choice; // takes what a trial found; NULL: not asked
};

// Sets input->is_double: the scene's setting or, for auto, the result of a trial on the device. The trial
// fills *gains (may be NULL; zeroed if it leaves nothing). `has_double`: the device supports double. The
// session's sink gets the error E707, the warning W701, or that there is no memory.
enum precision_status precision_choose(struct session *session, struct flat_input *input, struct gpu *gpu,
                                       bool has_double, struct precision_wish wish,
                                       struct precision_gains *gains);
// What a trial without a device finds. false: no memory; the sink has it.
bool precision_forecast(struct session *session, const struct flat_input *input,
                        struct precision_choice *out);
// Warns (W417) if the scene asks for single precision and needs double. The session's arena must be
// guarded.
void precision_check(struct session *session);
// "shortest edge"
const char *precision_feature_words(enum precision_feature feature);
// "auto", of enum ir_precision.
const char *precision_setting_word(unsigned setting);
// What was measured, what it means, and which body decides: lines of `glint inspect`.
void precision_words(const struct session *session, const struct precision_choice *choice,
                     struct strbuf *out);

#endif
