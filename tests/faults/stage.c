#define _GNU_SOURCE

#include "folder.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum {
    PATH_BYTES = 4096 + 64,
    SECONDS_MAX = 30, // of processor time: a run takes less than one
};

// Beside the run's folder.
static const char *beside(const struct stage *stage, const char *name) {
    static char paths[4][PATH_BYTES];
    static unsigned next;
    char *path = paths[next++ % 4];
    snprintf(path, PATH_BYTES, "%s.%s", stage->folder, name);
    return path;
}

// ---- the folder

static void add(const struct stage *stage, const char *from, const char *name) {
    char source[PATH_BYTES], target[PATH_BYTES];
    snprintf(source, sizeof source, "%s/%s", stage->root, from);
    snprintf(target, sizeof target, "%s/%s", beside(stage, "first"), name);
    copy_file(source, target);
}

// The messages of session.lsp, a line each, as a client sends them; '@' is the folder.
static void write_session(const struct stage *stage) {
    char path[PATH_BYTES];
    snprintf(path, sizeof path, "%s/session.lsp", beside(stage, "first"));
    struct bytes lines = read_whole(path);
    FILE *out = fopen(beside(stage, "lsp"), "wb");
    if (!out)
        die(path);
    for (char *rest = lines.data, *line = strsep(&rest, "\n"); line; line = strsep(&rest, "\n")) {
        char *at = strchr(line, '@');
        size_t size = strlen(line) + (at ? strlen(stage->folder) - 1 : 0);
        if (*line)
            fprintf(out, "Content-Length: %zu\r\n\r\n%.*s%s%s", size,
                    (int)(at ? at - line : (ptrdiff_t)strlen(line)), line, at ? stage->folder : "",
                    at ? at + 1 : "");
    }
    fclose(out);
    free(lines.data);
}

void stage_open(struct stage *stage, const char *glint, const char *shim, const char *root,
                const char *work) {
    char data[PATH_BYTES];
    *stage = (struct stage){.glint = glint, .shim = shim, .root = root};
    if (mkdir(work, 0777) != 0 && errno != EEXIST)
        die(work);
    if (snprintf(stage->folder, sizeof stage->folder, "%s/run", work) >= (int)sizeof stage->folder)
        die(work);
    remove_folder(beside(stage, "first"));
    snprintf(data, sizeof data, "%s/tests/faults/data", root);
    copy_folder(data, beside(stage, "first"));
    add(stage, "tests/data/image/palette.png", "more/sky.png");
    add(stage, "tests/data/image/progressive.jpg", "more/progressive.jpg");
    add(stage, "tests/fuzz/seeds/image/runs.hdr", "more/runs.hdr");
    add(stage, "tests/fuzz/seeds/image/half.exr", "more/half.exr");
    add(stage, "scenes/elements/letters.ttf", "more/letters.ttf");
    add(stage, "tests/golden/minimal.png", "a.png");
    add(stage, "tests/golden/spheres.png", "b.png");
    write_session(stage);
    stage->before = tell_folder(beside(stage, "first"));
}

void stage_close(struct stage *stage) {
    free(stage->before.data);
    remove_folder(beside(stage, "first"));
    remove_folder(beside(stage, "cache"));
    remove_folder(stage->folder);
}

void stage_reset(struct stage *stage, const struct task *task) {
    struct stat info;
    if (task->marks & CACHE)
        remove_folder(beside(stage, "cache"));
    if (stat(stage->folder, &info) == 0) {
        struct bytes now = tell_folder(stage->folder);
        bool same = strcmp(now.data, stage->before.data) == 0;
        free(now.data);
        if (same)
            return;
    }
    remove_folder(stage->folder);
    copy_folder(beside(stage, "first"), stage->folder);
}

// ---- the run

static void redirect(const char *path, int flags, int to) {
    int file = open(path, flags, 0666);
    if (file < 0 || dup2(file, to) < 0)
        _exit(126);
    close(file);
}

static void become(const struct stage *stage, const struct task *task) {
    const char *arguments[TASK_ARGUMENTS_MAX + 2] = {stage->glint};
    const struct rlimit time = {SECONDS_MAX, SECONDS_MAX + 5}, no_core = {0, 0};
    char messy[PATH_BYTES];
    memcpy(arguments + 1, task->arguments, sizeof task->arguments);
    setrlimit(RLIMIT_CPU, &time);
    setrlimit(RLIMIT_CORE, &no_core);
    snprintf(messy, sizeof messy, "%s/messy.glint.yaml", stage->folder);
    redirect(task->marks & LSP      ? beside(stage, "lsp")
             : task->marks & STREAM ? messy
                                    : "/dev/null",
             O_RDONLY, STDIN_FILENO);
    redirect(beside(stage, "out"), O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    redirect(beside(stage, "error"), O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
    setenv("XDG_CACHE_HOME", beside(stage, "cache"), 1);
    setenv(FAULTS_VARIABLE, beside(stage, "plan"), 1);
    setenv("LD_PRELOAD", stage->shim, 1);
    if (chdir(stage->folder) == 0)
        execv(stage->glint, (char **)arguments);
    _exit(126);
}

static struct faults *share(const struct stage *stage, const struct faults *plan) {
    int file = open(beside(stage, "plan"), O_RDWR | O_CREAT | O_TRUNC, 0666);
    if (file < 0 || ftruncate(file, sizeof *plan) != 0)
        die("plan");
    struct faults *shared = mmap(NULL, sizeof *plan, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    close(file);
    if (shared == MAP_FAILED)
        die("plan");
    memcpy(shared, plan, sizeof *plan);
    return shared;
}

static struct bytes read_report(const struct stage *stage) {
    char path[PATH_BYTES];
    snprintf(path, sizeof path, "%s/report.sarif", stage->folder);
    return access(path, F_OK) == 0 ? read_whole(path) : (struct bytes){0};
}

struct outcome stage_run(const struct stage *stage, const struct task *task, const struct faults *plan) {
    struct faults *shared = share(stage, plan);
    struct outcome outcome = {0};
    pid_t child = fork();
    if (child == 0)
        become(stage, task);
    if (child < 0 || waitpid(child, &outcome.status, 0) != child)
        die("fork");
    outcome.seen = atomic_load(&shared->seen);
    outcome.failed = atomic_load(&shared->failed);
    memcpy(outcome.call, shared->call, sizeof outcome.call);
    munmap(shared, sizeof *shared);
    outcome.out = read_whole(beside(stage, "out"));
    outcome.error = read_whole(beside(stage, "error"));
    outcome.folder = tell_folder(stage->folder);
    if (task->marks & REPORT)
        outcome.report = read_report(stage);
    return outcome;
}

void outcome_finish(struct outcome *outcome) {
    free(outcome->out.data);
    free(outcome->error.data);
    free(outcome->folder.data);
    free(outcome->report.data);
    *outcome = (struct outcome){0};
}
