// Hostile inputs against the whole program: each must end in a clear error at the right place, within a
// second of processor time and 256 MB of memory, with nothing overwritten.
//
// Usage: run_hostile GLINT WORK_FOLDER. The inputs are made here (hostile_inputs.c), none is stored.
#include "hostile_inputs.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum {
    ARGUMENTS_MAX = 12,
    MEMORY_MAX_KB = 256 * 1024,
    SECONDS_MAX = 20,       // of processor time: what is worse than linear would take minutes
    WAIT_SECONDS_MAX = 600, // for what waits for ever, however busy the machine is
    TEXT_MAX_BYTES = 64 * 1024,
};

struct hostile_case {
    const char *name;
    int exit_status;
    const char *expected; // a part of standard error: the place and the code
    const char *code;
    const char *arguments[ARGUMENTS_MAX];
};

static const struct hostile_case cases[] = {
    {"alias bomb", 1, "bomb.yaml:", "[E501]", {"check", "bomb.yaml"}},
    {"200 000 brackets", 1, "brackets.yaml:2:", "[E501]", {"check", "brackets.yaml"}},
    {"100 000 XML levels", 1, "levels.xml:", "[E501]", {"check", "levels.xml"}},
    {"entity bomb", 1, "entities.xml:2:1: error", "[E111]", {"check", "entities.xml"}},
    {"10 MB scalar, YAML", 1, "scalar.yaml:2:14: error", "[E501]", {"check", "scalar.yaml"}},
    {"10 MB scalar, XML", 1, "scalar.xml:1:", "[E501]", {"check", "scalar.xml"}},
    {"NUL bytes, YAML", 1, "nul.yaml:2:", "[E104]", {"check", "nul.yaml"}},
    {"NUL bytes, XML", 1, "nul.xml:2:", "[E104]", {"check", "nul.xml"}},
    {"invalid UTF-8, YAML", 1, "utf8.yaml:3:", "[E103]", {"check", "utf8.yaml"}},
    {"invalid UTF-8, XML", 1, "utf8.xml:3:", "[E103]", {"check", "utf8.xml"}},
    {"100 000 mistakes",
     1,
     "mistakes.yaml:2:1: error",
     "more messages not shown",
     {"check", "mistakes.yaml"}},
    {"100 000 merge conflicts", 1, "conflicts.yaml:2:1: error", "[E125]", {"check", "conflicts.yaml"}},
    {"PNG of 65535x65535", 1, "huge-png.yaml:2:", "[E501]", {"check", "huge-png.yaml"}},
    {"PNG that decodes to 2 GB",
     1,
     "wide-png.yaml:2:",
     "[E501]",
     {"render", "wide-png.yaml", "-o", "wide.png"}},
    {"1x1 PNG that inflates to 256 MB",
     1,
     "inflates.png:1:1: error",
     "[E620]",
     {"render", "inflates.yaml", "-o", "inflates-out.png"}},
    {"mesh is /dev/zero", 1, "zero.yaml:2:", "[E60", {"check", "zero.yaml", "--asset-path", "/dev"}},
    {"mesh is a link to /dev/zero", 1, "link.yaml:2:", "[E60", {"check", "link.yaml"}},
    {"mesh is a folder", 1, "folder.yaml:2:", "[E603]", {"check", "folder.yaml"}},
    {"mesh is a pipe", 1, "pipe.yaml:2:", "[E603]", {"check", "pipe.yaml"}},
    {"scene is a folder", 3, "folder.obj:1:1: error", "[E603]", {"inspect", "folder.obj"}},
    {"scene is a pipe", 3, "pipe.obj:1:1: error", "[E603]", {"check", "pipe.obj"}},
    {"scene is /dev/zero", 3, "/dev/zero:1:1: error", "[E603]", {"check", "/dev/zero"}},
    {"output on a full disk",
     3,
     "/dev/full:1:1: error",
     "[E802]",
     {"render", "good.yaml", "-o", "/dev/full"}},
    {"output that may not grow",
     3,
     "kept.png:1:1: error",
     "[E802]",
     {"render", "good.yaml", "-o", "kept.png"}},
    {"output in no folder",
     3,
     "nowhere/out.png:1:1: error",
     "[E802]",
     {"render", "good.yaml", "-o", "nowhere/out.png"}},
};

struct result {
    int exit_status; // -1: ended by a signal
    double cpu_seconds;
    long memory_kb;
    size_t length;
    char text[TEXT_MAX_BYTES + 1];
};

static void child(const char *glint, const struct hostile_case *c, int error_fd, bool small_files) {
    char *argv[ARGUMENTS_MAX + 2] = {(char *)(uintptr_t)glint};
    for (int i = 0; i < ARGUMENTS_MAX && c->arguments[i]; i++)
        argv[i + 1] = (char *)(uintptr_t)c->arguments[i];
    int null = open("/dev/null", O_WRONLY);
    dup2(null, STDOUT_FILENO);
    dup2(error_fd, STDERR_FILENO);
    if (small_files) {
        struct rlimit limit = {1024, 1024};
        signal(SIGXFSZ, SIG_IGN);
        setrlimit(RLIMIT_FSIZE, &limit);
        setenv("MESA_SHADER_CACHE_DISABLE", "1", 1);
    }
    alarm(WAIT_SECONDS_MAX);
    execv(glint, argv);
    _exit(127);
}

static void run(const char *glint, const struct hostile_case *c, struct result *result) {
    int ends[2];
    *result = (struct result){.exit_status = -1};
    if (pipe(ends) != 0)
        return;
    bool small_files = strstr(c->expected, "kept.png") != NULL;
    pid_t pid = fork();
    if (pid == 0)
        child(glint, c, ends[1], small_files);
    close(ends[1]);
    char chunk[4096];
    ssize_t n;
    while ((n = read(ends[0], chunk, sizeof chunk)) > 0) {
        size_t room = TEXT_MAX_BYTES - result->length;
        memcpy(result->text + result->length, chunk, (size_t)n < room ? (size_t)n : room);
        result->length += (size_t)n < room ? (size_t)n : room;
    }
    close(ends[0]);
    struct rusage usage;
    int status;
    wait4(pid, &status, 0, &usage);
    if (WIFEXITED(status))
        result->exit_status = WEXITSTATUS(status);
    result->cpu_seconds = (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                          1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
    result->memory_kb = usage.ru_maxrss;
}

static bool judge(const struct hostile_case *c, const struct result *r) {
    bool renders = strcmp(c->arguments[0], "render") == 0;
    bool good = r->exit_status == c->exit_status && strstr(r->text, c->expected) &&
                strstr(r->text, c->code) && r->length < TEXT_MAX_BYTES && r->memory_kb < MEMORY_MAX_KB &&
                (renders || r->cpu_seconds < SECONDS_MAX);
    printf("%s %-32s exit %d, %.2f s, %ld MB\n", good ? "ok  " : "FAIL", c->name, r->exit_status,
           r->cpu_seconds, r->memory_kb / 1024);
    if (!good)
        printf("     expected exit %d with '%s' and '%s'; got:\n%.2000s\n", c->exit_status, c->expected,
               c->code, r->text);
    return good;
}

// The picture that was there before a failed run is there after it, and no temporary file is left.
static bool kept_is_intact(void) {
    char text[16] = {0};
    FILE *file = fopen("kept.png", "rb");
    if (file) {
        if (fread(text, 1, sizeof text - 1, file) == 0)
            text[0] = '\0';
        fclose(file);
    }
    bool good = strcmp(text, HOSTILE_KEPT_TEXT) == 0 && system("ls kept.png.* >/dev/null 2>&1") != 0;
    printf("%s the old picture is intact\n", good ? "ok  " : "FAIL");
    return good;
}

int main(int argc, char **argv) {
    static struct result result;
    if (argc != 3)
        return 2;
    char *glint = realpath(argv[1], NULL);
    if (!glint || chdir(argv[2]) != 0 || !hostile_make_inputs()) {
        fprintf(stderr, "run_hostile: %s\n", strerror(errno));
        return 2;
    }
    int failed = 0;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        run(glint, &cases[i], &result);
        failed += !judge(&cases[i], &result);
    }
    failed += !kept_is_intact();
    free(glint);
    return failed ? 1 : 0;
}
