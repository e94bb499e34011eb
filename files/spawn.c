#include "files/spawn.h"

#include "files/sandbox.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

static int set_streams(posix_spawn_file_actions_t *actions, const struct spawn_streams *streams) {
    const int from[] = {streams->in, streams->out, streams->err};
    const int to[] = {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO};
    int error = 0;
    for (int i = 0; i < 3 && !error; i++)
        if (from[i] >= 0)
            error = posix_spawn_file_actions_adddup2(actions, from[i], to[i]);
    return error;
}

static int start(pid_t *child, const char *const *words, const posix_spawn_file_actions_t *actions,
                 bool own_group) {
    posix_spawnattr_t attributes;
    sigset_t defaults;
    int error = posix_spawnattr_init(&attributes);
    if (error)
        return error;
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGPIPE);
    sigaddset(&defaults, SIGXFSZ);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes,
                             (short)(POSIX_SPAWN_SETSIGDEF | (own_group ? POSIX_SPAWN_SETPGROUP : 0)));
    error = posix_spawnp(child, words[0], actions, &attributes, (char *const *)words, environ);
    posix_spawnattr_destroy(&attributes);
    return error;
}

int spawn(pid_t *child, const char *const *words, const struct spawn_streams *streams, bool own_group) {
    posix_spawn_file_actions_t actions;
    *child = 0;
    if (sandbox_entered()) {
        sandbox_refuse();
        return EPERM;
    }
    int error = posix_spawn_file_actions_init(&actions);
    if (error)
        return error;
    error = set_streams(&actions, streams);
    if (!error)
        error = start(child, words, &actions, own_group);
    if (error)
        *child = 0;
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

// The forked child, to its end: it becomes another program, or says why it did not.
static void become(const char *const *words, const struct spawn_streams *streams,
                   const struct sandbox *limits, int tell) {
    const int from[] = {streams->in, streams->out, streams->err};
    const int to[] = {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO};
    bool good = true;
    for (int i = 0; i < 3; i++)
        good = good && (from[i] < 0 || dup2(from[i], to[i]) >= 0);
    signal(SIGPIPE, SIG_DFL);
    signal(SIGXFSZ, SIG_DFL);
    if (good) {
        sandbox_only_read(limits);
        execvp(words[0], (char *const *)words);
    }
    const int error = errno;
    if (write(tell, &error, sizeof error) < 0)
        _exit(126);
    _exit(127);
}

int spawn_reader(pid_t *child, const char *const *words, const struct spawn_streams *streams,
                 const struct sandbox *limits) {
    int ends[2], error = 0;
    *child = 0;
    if (pipe(ends) != 0)
        return errno;
    fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);
    const pid_t made = fork();
    if (made == 0)
        become(words, streams, limits, ends[1]);
    if (made < 0)
        error = errno;
    close(ends[1]);
    ssize_t count = 0;
    // Nothing arrives if the child has become the program.
    do
        count = made < 0 ? 0 : read(ends[0], &error, sizeof error);
    while (count < 0 && errno == EINTR);
    close(ends[0]);
    if (made > 0 && error)
        waitpid(made, NULL, 0);
    *child = error ? 0 : made;
    return error;
}
