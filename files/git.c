#include "files/git.h"

#include "core/strbuf.h"
#include "files/files.h"
#include "files/files_walk.h"
#include "files/git_run.h"
#include "files/sandbox.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#define NO_NAMES "git ended with status 1" // ended so without a message

// For an untrusted repository.
static struct sandbox limits;
static bool distrusts;

struct words {
    const char **items;
    uint32_t count, capacity;
};

void git_distrust(unsigned seconds, uint64_t memory_bytes) {
    // The system's settings may name programs, too; only GIT_ALLOW_PROTOCOL overrides the repository's.
    static const char *const variables[][2] = {{"GIT_CONFIG_NOSYSTEM", "1"}, {"GIT_ATTR_NOSYSTEM", "1"},
                                               {"GIT_OPTIONAL_LOCKS", "0"},  {"GIT_ALLOW_PROTOCOL", "none"},
                                               {"GIT_NO_LAZY_FETCH", "1"},   {"GIT_TERMINAL_PROMPT", "0"}};
    for (size_t i = 0; i < sizeof variables / sizeof *variables; i++)
        setenv(variables[i][0], variables[i][1], 1);
    limits = (struct sandbox){NULL, 0, seconds, memory_bytes};
    distrusts = true;
}

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

static void add_words(struct words *words, struct arena *arena, const char *const *more) {
    for (; *more; more++)
        *ARENA_PUSH(arena, words) = *more;
}

// Settings that override the repository's wherever these could name a program.
static const char *const no_programs[] = {
    "--no-optional-locks", "-c", "core.fsmonitor=false",       "-c", "core.hooksPath=/dev/null", "-c",
    "diff.external=",      "-c", "diff.autoRefreshIndex=true", "-c", "submodule.recurse=false",  NULL};

// Runs git in a folder; its output goes into the arena. false: changes->why. `settings`: put before the
// command if the repository is untrusted.
static bool ask_with(struct git_changes *changes, struct arena *arena, str folder,
                     const struct words *settings, const char *const *question, str *out) {
    const char *const begin[] = {"git", "-C", arena_copy(arena, folder).ptr, NULL};
    struct words words = {0};
    add_words(&words, arena, begin);
    if (distrusts)
        add_words(&words, arena, no_programs);
    for (uint32_t i = 0; settings && i < settings->count; i++)
        *ARENA_PUSH(arena, &words) = settings->items[i];
    add_words(&words, arena, question);
    *ARENA_PUSH(arena, &words) = NULL;
    struct git_answer answer = {.error = 0};
    strbuf_init(&answer.text[GIT_OUT]);
    strbuf_init(&answer.text[GIT_ERR]);
    if (sandbox_entered()) {
        sandbox_refuse();
        answer.error = EPERM;
    } else {
        git_run(&answer, words.items, distrusts ? &limits : NULL);
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

static bool ask(struct git_changes *changes, struct arena *arena, str folder, const char *const *question,
                str *out) {
    return ask_with(changes, arena, folder, NULL, question, out);
}

// The next item of a list whose items end with a zero byte; false: there is none.
static bool next_of(str list, size_t *at, str *item) {
    while (*at < list.len && list.ptr[*at] == '\0')
        ++*at;
    const size_t begin = *at;
    while (*at < list.len && list.ptr[*at] != '\0')
        ++*at;
    *item = str_slice(list, begin, *at);
    return item->len > 0;
}

static void take_paths(struct git_changes *changes, struct arena *arena, str list) {
    str path;
    for (size_t at = 0; next_of(list, &at, &path);)
        *ARENA_PUSH(arena, &changes->paths) = path_join(arena, changes->top, path);
}

// ---- an untrusted repository

// Settings that turn off filter programs: git hashes files as they are.
static bool add_no_filters(struct git_changes *changes, struct arena *arena, struct words *settings) {
    static const char *const list[] = {"config", "-z", "--name-only", "--get-regexp", "^filter\\.", NULL};
    static const char *const off[] = {"clean=", "smudge=", "process=", "required=false", NULL};
    str names, name;
    const bool found = ask(changes, arena, changes->top, list, &names);
    if (!found && (names.len || !str_equal_cstr(changes->why, NO_NAMES)))
        return false;
    changes->why = STR("");
    for (size_t at = 0; next_of(names, &at, &name);) {
        if (memchr(name.ptr, '=', name.len)) {
            changes->why = arena_format(arena,
                                        "the repository has a filter whose name cannot be put into words: "
                                        "%.*s",
                                        STR_ARG(name));
            return false;
        }
        while (name.ptr[name.len - 1] != '.')
            name.len--;
        for (const char *const *word = off; *word; word++) {
            *ARENA_PUSH(arena, settings) = "-c";
            *ARENA_PUSH(arena, settings) = arena_format(arena, "%.*s%s", STR_ARG(name), *word).ptr;
        }
    }
    return true;
}

// A repository's settings may say that its files are elsewhere: in the home folder of whoever checks it.
static bool judge_top(struct git_changes *changes, struct arena *arena) {
    struct files files;
    if (getenv("GIT_DIR") || getenv("GIT_WORK_TREE"))
        return true;
    files_init(&files, arena);
    str at = files_canonical(&files, STR("."));
    while (at.len > 1 && !files_exist(path_join(arena, at, STR(".git"))))
        at = path_folder(at);
    if (str_equal(at, files_canonical(&files, changes->top)))
        return true;
    changes->why = arena_format(arena, "the repository says that its files are elsewhere, in '%.*s'",
                                STR_ARG(changes->top));
    return false;
}

// Only git itself, run in it, knows what a submodule has: all of it counts as changed.
static void take_submodules(struct git_changes *changes, struct arena *arena, str list) {
    str line;
    for (size_t at = 0; next_of(list, &at, &line);) {
        const char *tab = memchr(line.ptr, '\t', line.len);
        if (tab && str_starts_with(line, STR("160000 ")))
            *ARENA_PUSH(arena, &changes->paths) =
                path_join(arena, changes->top, str_slice(line, (size_t)(tab - line.ptr) + 1, line.len));
    }
}

// Questions asked of any repository beforehand.
static bool prepare(struct git_changes *changes, struct arena *arena, struct words *settings) {
    static const char *const staged[] = {"ls-files", "-z", "--stage", NULL};
    str list;
    if (!distrusts)
        return true;
    if (!judge_top(changes, arena) || !add_no_filters(changes, arena, settings) ||
        !ask_with(changes, arena, changes->top, settings, staged, &list))
        return false;
    take_submodules(changes, arena, list);
    return true;
}

// ---- the question

bool git_changed_since(struct git_changes *changes, struct arena *arena, str revision) {
    static const char *const find_top[] = {"rev-parse", "--show-toplevel", NULL};
    static const char *const find_head[] = {"rev-parse", "--verify", "--quiet", "HEAD", NULL};
    static const char *const untracked[] = {"ls-files", "-z", "--others", "--exclude-standard", NULL};
    static const char *const all[] = {"ls-files", "-z", "--cached", NULL};
    const char *since[] = {"diff",
                           "--name-only",
                           "-z",
                           "--no-renames",
                           "--no-ext-diff",
                           "--no-textconv",
                           distrusts ? "--ignore-submodules=dirty" : "--no-color",
                           arena_copy(arena, revision).ptr,
                           "--",
                           NULL};
    struct words settings = {0};
    str out;
    *changes = (struct git_changes){0};
    if (!ask(changes, arena, STR("."), find_top, &out))
        return false;
    size_t end = out.len;
    while (end > 0 && (out.ptr[end - 1] == '\n' || out.ptr[end - 1] == '\r'))
        end--;
    changes->top = arena_copy(arena, str_slice(out, 0, end));
    if (!prepare(changes, arena, &settings))
        return false;
    bool no_commit = str_equal_cstr(revision, "HEAD") && !ask(changes, arena, changes->top, find_head, &out);
    if (!ask_with(changes, arena, changes->top, &settings, no_commit ? all : since, &out))
        return false;
    take_paths(changes, arena, out);
    if (!ask_with(changes, arena, changes->top, &settings, untracked, &out))
        return false;
    take_paths(changes, arena, out);
    return true;
}
