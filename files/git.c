#include "files/git.h"

#include "core/strbuf.h"
#include "files/files.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

enum {
    WORDS_MAX = 16,
    OUT = 0,
    ERR = 1,
};

struct answer {
    struct strbuf text[2]; // standard output and error
    int error;             // errno of what kept git from running; 0: it ran
    int status;            // its own
};

// Signals that this program ignores are not ignored by git.
static int start(pid_t *child, const char *const *words, int out, int err) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t defaults;
    int error = posix_spawn_file_actions_init(&actions);
    if (error)
        return error;
    error = posix_spawnattr_init(&attributes);
    if (error) {
        posix_spawn_file_actions_destroy(&actions);
        return error;
    }
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGPIPE);
    sigaddset(&defaults, SIGXFSZ);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    error = posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
    error = error ? error : posix_spawn_file_actions_adddup2(&actions, err, STDERR_FILENO);
    error =
        error ? error : posix_spawnp(child, words[0], &actions, &attributes, (char *const *)words, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

// Both streams are read as they come: git must not wait for one while the other is full.
static void read_both(struct answer *answer, const int *ends) {
    struct pollfd waits[2] = {{.fd = ends[OUT], .events = POLLIN}, {.fd = ends[ERR], .events = POLLIN}};
    char buffer[4096];
    while (waits[OUT].fd >= 0 || waits[ERR].fd >= 0) {
        if (poll(waits, 2, -1) < 0 && errno != EINTR)
            break;
        for (int i = 0; i < 2; i++) {
            if (waits[i].fd < 0 || !waits[i].revents)
                continue;
            ssize_t count = read(waits[i].fd, buffer, sizeof buffer);
            if (count > 0)
                strbuf_add(&answer->text[i], buffer, (size_t)count);
            else if (count == 0 || errno != EINTR)
                waits[i].fd = -1;
        }
    }
}

static void run_between(struct answer *answer, const char *const *words, const int *out, const int *err) {
    pid_t child = 0;
    answer->error = start(&child, words, out[1], err[1]);
    close(out[1]);
    close(err[1]);
    if (answer->error)
        return;
    const int ends[] = {out[0], err[0]};
    read_both(answer, ends);
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) {
            answer->error = errno;
            return;
        }
    answer->status = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

static void run_git(struct answer *answer, const char *const *words) {
    int out[2], err[2];
    if (pipe(out) != 0) {
        answer->error = errno;
        return;
    }
    if (pipe(err) != 0) {
        answer->error = errno;
        close(out[0]);
        close(out[1]);
        return;
    }
    for (int i = 0; i < 2; i++) {
        // What git's own children inherit must not keep the ends open that are read here.
        fcntl(out[i], F_SETFD, FD_CLOEXEC);
        fcntl(err[i], F_SETFD, FD_CLOEXEC);
    }
    run_between(answer, words, out, err);
    close(out[0]);
    close(err[0]);
}

static bool explain(struct git_changes *changes, struct arena *arena, const struct answer *answer) {
    str said = str_trim(strbuf_view(&answer->text[ERR]));
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
    struct answer answer = {.error = 0};
    strbuf_init(&answer.text[OUT]);
    strbuf_init(&answer.text[ERR]);
    run_git(&answer, words);
    bool failed = answer.text[OUT].failed || answer.text[ERR].failed;
    answer.error = failed ? ENOMEM : answer.error;
    bool good = answer.error == 0 && answer.status == 0;
    good = good || explain(changes, arena, &answer);
    str copy = arena_copy(arena, strbuf_view(&answer.text[OUT]));
    strbuf_finish(&answer.text[OUT]);
    strbuf_finish(&answer.text[ERR]);
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
