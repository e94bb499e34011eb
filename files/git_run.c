#include "files/git_run.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

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
static void read_both(struct git_answer *answer, const int *ends) {
    struct pollfd waits[2] = {{.fd = ends[GIT_OUT], .events = POLLIN},
                              {.fd = ends[GIT_ERR], .events = POLLIN}};
    char buffer[4096];
    while (waits[GIT_OUT].fd >= 0 || waits[GIT_ERR].fd >= 0) {
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

static void run_between(struct git_answer *answer, const char *const *words, const int *out, const int *err) {
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

void git_run(struct git_answer *answer, const char *const *words) {
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
