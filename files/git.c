#include "files/git.h"

#include "core/strbuf.h"
#include "files/files.h"
#include "files/git_run.h"
#include "files/sandbox.h"

#include <errno.h>
#include <string.h>

enum {
    WORDS_MAX = 16,
};

static bool explain(struct git_changes *changes, struct arena *arena, const struct git_answer *answer) {
    str said = str_trim(strbuf_view(&answer->text[GIT_ERR]));
    size_t end = 0;
    while (end < said.len && said.ptr[end] != '\n')
        end++;
    said = str_slice(said, 0, end);
    if (answer->error == ENOENT)
        changes->why = STR("git is not installed, or not in the PATH");
    else if (answer->error)
        changes->why = arena_format(arena, "git cannot be started: %s", strerror(answer->error));
    else if (said.len)
        changes->why = arena_format(arena, "git says: %.*s", STR_ARG(said));
    else
        changes->why = arena_format(arena, "git ended with status %d", answer->status);
    return false;
}

// Runs git in a folder; its output goes into the arena. false: changes->why.
static bool ask(struct git_changes *changes, struct arena *arena, str folder, const char *const *question,
                str *out) {
    const char *words[WORDS_MAX] = {"git", "-C", arena_copy(arena, folder).ptr};
    for (int i = 0; question[i]; i++)
        words[3 + i] = question[i];
    struct git_answer answer = {.error = 0};
    strbuf_init(&answer.text[GIT_OUT]);
    strbuf_init(&answer.text[GIT_ERR]);
    if (sandbox_entered()) {
        sandbox_refuse();
        answer.error = EPERM;
    } else {
        git_run(&answer, words);
    }
    bool failed = answer.text[GIT_OUT].failed || answer.text[GIT_ERR].failed;
    answer.error = failed ? ENOMEM : answer.error;
    bool good = answer.error == 0 && answer.status == 0;
    good = good || explain(changes, arena, &answer);
    str copy = arena_copy(arena, strbuf_view(&answer.text[GIT_OUT]));
    strbuf_finish(&answer.text[GIT_OUT]);
    strbuf_finish(&answer.text[GIT_ERR]);
    *out = copy;
    return good;
}

// The paths of a list, each of which a zero byte ends.
static void take_paths(struct git_changes *changes, struct arena *arena, str list) {
    for (size_t at = 0; at < list.len; at++) {
        size_t begin = at;
        while (at < list.len && list.ptr[at] != '\0')
            at++;
        if (at > begin)
            *ARENA_PUSH(arena, &changes->paths) = path_join(arena, changes->top, str_slice(list, begin, at));
    }
}

bool git_changed_since(struct git_changes *changes, struct arena *arena, str revision) {
    static const char *const find_top[] = {"rev-parse", "--show-toplevel", NULL};
    static const char *const find_head[] = {"rev-parse", "--verify", "--quiet", "HEAD", NULL};
    static const char *const untracked[] = {"ls-files", "-z", "--others", "--exclude-standard", NULL};
    static const char *const all[] = {"ls-files", "-z", "--cached", NULL};
    const char *since[] = {
        "diff", "--name-only", "-z", "--no-renames", "--no-ext-diff", arena_copy(arena, revision).ptr,
        "--",   NULL};
    str out;
    *changes = (struct git_changes){0};
    if (!ask(changes, arena, STR("."), find_top, &out))
        return false;
    size_t end = out.len;
    while (end > 0 && (out.ptr[end - 1] == '\n' || out.ptr[end - 1] == '\r'))
        end--;
    changes->top = arena_copy(arena, str_slice(out, 0, end));
    bool no_commit = str_equal_cstr(revision, "HEAD") && !ask(changes, arena, changes->top, find_head, &out);
    if (!ask(changes, arena, changes->top, no_commit ? all : since, &out))
        return false;
    take_paths(changes, arena, out);
    if (!ask(changes, arena, changes->top, untracked, &out))
        return false;
    take_paths(changes, arena, out);
    return true;
}
