#include "files/git_run.h"

#include "files/spawn.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

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

static void run_between(struct git_answer *answer, const char *const *words, const struct sandbox *limits,
                        const int *out, const int *err) {
    pid_t child = 0;
    const struct spawn_streams streams = {-1, out[1], err[1]};
    answer->error =
        limits ? spawn_reader(&child, words, &streams, limits) : spawn(&child, words, &streams, false);
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

void git_run(struct git_answer *answer, const char *const *words, const struct sandbox *limits) {
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
        // Descriptors that git's own children inherit must not keep open the ends that are read here.
        fcntl(out[i], F_SETFD, FD_CLOEXEC);
        fcntl(err[i], F_SETFD, FD_CLOEXEC);
    }
    run_between(answer, words, limits, out, err);
    close(out[0]);
    close(err[0]);
}
