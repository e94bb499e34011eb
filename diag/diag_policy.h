// What a user wants to see: severities by code, codes and paths to leave out, and what makes a run fail.
//
// Errors always stay errors and are always reported: a policy changes only warnings and notes. Codes are
// written W401, or W4xx for a family. Ownership: lists live in the given arena. Thread safety: a value; set
// it up first.
#ifndef GLINT_DIAG_DIAG_POLICY_H
#define GLINT_DIAG_DIAG_POLICY_H

#include "core/arena.h"
#include "diag/diag.h"

enum diag_level {
    DIAG_LEVEL_STANDARD, // the code's own
    DIAG_LEVEL_ERROR,
    DIAG_LEVEL_WARNING,
    DIAG_LEVEL_NOTE,
    DIAG_LEVEL_OFF,
};

struct diag_ignored_path {
    str folder;  // absolute: what the pattern is relative to
    str pattern; // files/glob.h
};

struct diag_policy {
    uint8_t level[DIAG_CODE_COUNT]; // diag_level
    bool has_only;
    bool only[DIAG_CODE_COUNT];
    enum {
        DIAG_FAIL_STANDARD, // on errors
        DIAG_FAIL_ON_ERROR,
        DIAG_FAIL_ON_WARNING,
    } fail_on;
    struct {
        struct diag_ignored_path *items;
        uint32_t count, capacity;
    } ignored;
};

enum diag_policy_status {
    DIAG_POLICY_SET,
    DIAG_POLICY_UNKNOWN_CODE,
    DIAG_POLICY_ERROR_CODE, // names only errors, which cannot be changed
    DIAG_POLICY_BAD_WORD,   // neither error, warning, note nor off
};

// The words for levels, NULL at the end: [0] is "error" (DIAG_LEVEL_ERROR).
extern const char *const diag_level_words[];
// The words for what makes a run fail: [0] is "error" (DIAG_FAIL_ON_ERROR).
extern const char *const diag_fail_words[];

// Whether the text has the form of a code or family: a letter E, W or N, and three digits or a digit and
// "xx".
bool diag_is_code_text(str text);
// Whether `text` names `code` or its family.
bool diag_code_matches(diag_code code, str text);

enum diag_policy_status diag_policy_level(struct diag_policy *policy, str codes, str word);
// Adds codes to the list of the only ones reported.
enum diag_policy_status diag_policy_only(struct diag_policy *policy, str codes);
enum diag_policy_status diag_policy_fail_on(struct diag_policy *policy, str word);
void diag_policy_ignore_path(struct diag_policy *policy, struct arena *arena, str folder, str pattern);
// Applies `over` on top: what it sets takes effect, the rest stays.
void diag_policy_overlay(struct diag_policy *policy, struct arena *arena, const struct diag_policy *over);

// Whether the file with this absolute path is left out.
bool diag_policy_ignores(const struct diag_policy *policy, str path);
// Applies the policy to one diagnostic: sets its severity; false: it must not be reported. `ignored`: it is
// in a file that is left out.
bool diag_policy_keeps(const struct diag_policy *policy, struct diag *item, bool ignored);
// Whether the run fails, given a sink filtered by the above.
bool diag_policy_fails(const struct diag_policy *policy, const struct diag_sink *sink);

#endif
