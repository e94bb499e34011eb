#include "diag/diag_policy.h"

#include "files/files.h"
#include "files/glob.h"

const char *const diag_level_words[] = {"error", "warning", "note", "off", NULL};
const char *const diag_fail_words[] = {"error", "warning", NULL};

static char upper(char c) {
    return c >= 'a' && c <= 'z' ? (char)(c - 'a' + 'A') : c;
}

bool diag_is_code_text(str text) {
    if (text.len != 4)
        return false;
    char letter = upper(text.ptr[0]);
    bool family = upper(text.ptr[2]) == 'X' && upper(text.ptr[3]) == 'X';
    bool digits = char_is_digit(text.ptr[2]) && char_is_digit(text.ptr[3]);
    return (letter == 'E' || letter == 'W' || letter == 'N') && char_is_digit(text.ptr[1]) &&
           (family || digits);
}

bool diag_code_matches(diag_code code, str text) {
    const char *own = diag_info(code)->code;
    if (!diag_is_code_text(text))
        return false;
    for (size_t i = 0; i < text.len; i++)
        if (upper(text.ptr[i]) != own[i] && upper(text.ptr[i]) != 'X')
            return false;
    return true;
}

static int word_index(const char *const *words, str word) {
    for (int i = 0; words[i]; i++)
        if (str_equal_cstr(word, words[i]))
            return i;
    return -1;
}

enum diag_policy_status diag_policy_level(struct diag_policy *policy, str codes, str word) {
    int level = word_index(diag_level_words, word);
    enum diag_policy_status status = DIAG_POLICY_UNKNOWN_CODE;
    if (level < 0)
        return DIAG_POLICY_BAD_WORD;
    for (diag_code i = diag_next(-1); i < DIAG_CODE_COUNT; i = diag_next(i)) {
        if (!diag_code_matches(i, codes))
            continue;
        if (diag_info(i)->severity == DIAG_ERROR)
            return DIAG_POLICY_ERROR_CODE;
        policy->level[i] = (uint8_t)(level + DIAG_LEVEL_ERROR);
        status = DIAG_POLICY_SET;
    }
    return status;
}

enum diag_policy_status diag_policy_only(struct diag_policy *policy, str codes) {
    enum diag_policy_status status = DIAG_POLICY_UNKNOWN_CODE;
    for (diag_code i = diag_next(-1); i < DIAG_CODE_COUNT; i = diag_next(i)) {
        if (!diag_code_matches(i, codes))
            continue;
        policy->only[i] = true;
        policy->has_only = true;
        status = DIAG_POLICY_SET;
    }
    return status;
}

enum diag_policy_status diag_policy_fail_on(struct diag_policy *policy, str word) {
    int found = word_index(diag_fail_words, word);
    if (found < 0)
        return DIAG_POLICY_BAD_WORD;
    policy->fail_on = found == 0 ? DIAG_FAIL_ON_ERROR : DIAG_FAIL_ON_WARNING;
    return DIAG_POLICY_SET;
}

void diag_policy_ignore_path(struct diag_policy *policy, struct arena *arena, str folder, str pattern) {
    struct diag_ignored_path *ignored = ARENA_PUSH(arena, &policy->ignored);
    *ignored = (struct diag_ignored_path){arena_copy(arena, folder), arena_copy(arena, pattern)};
}

void diag_policy_overlay(struct diag_policy *policy, struct arena *arena, const struct diag_policy *over) {
    for (diag_code i = diag_next(-1); i < DIAG_CODE_COUNT; i = diag_next(i)) {
        if (over->level[i] != DIAG_LEVEL_STANDARD)
            policy->level[i] = over->level[i];
        if (over->has_only)
            policy->only[i] = over->only[i];
    }
    policy->has_only = policy->has_only || over->has_only;
    if (over->fail_on != DIAG_FAIL_STANDARD)
        policy->fail_on = over->fail_on;
    for (uint32_t i = 0; i < over->ignored.count; i++)
        *ARENA_PUSH(arena, &policy->ignored) = over->ignored.items[i];
}

bool diag_policy_ignores(const struct diag_policy *policy, str path) {
    for (uint32_t i = 0; i < policy->ignored.count; i++) {
        const struct diag_ignored_path *ignored = &policy->ignored.items[i];
        str rest;
        if (path_is_below(path, ignored->folder, &rest) && rest.len && glob_match(ignored->pattern, rest))
            return true;
    }
    return false;
}

bool diag_policy_keeps(const struct diag_policy *policy, struct diag *item, bool ignored) {
    if (diag_info(item->code)->severity == DIAG_ERROR)
        return true;
    enum diag_level level = policy->level[item->code];
    if (level == DIAG_LEVEL_OFF || ignored || (policy->has_only && !policy->only[item->code]))
        return false;
    if (level == DIAG_LEVEL_ERROR)
        item->severity = DIAG_ERROR;
    else if (level == DIAG_LEVEL_WARNING)
        item->severity = DIAG_WARNING;
    else if (level == DIAG_LEVEL_NOTE)
        item->severity = DIAG_NOTE;
    return true;
}

bool diag_policy_fails(const struct diag_policy *policy, const struct diag_sink *sink) {
    return sink->errors > 0 || (policy->fail_on == DIAG_FAIL_ON_WARNING && sink->warnings > 0);
}
