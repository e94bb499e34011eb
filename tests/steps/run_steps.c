// Every command over every construct (constructs.c), with n and with 4n of it: at most five times the steps.
//
// Usage: run_steps GLINT QUADRATIC WORK_FOLDER [PART_OF_A_NAME]. GLINT counts its steps (count_steps.c), and
// so does QUADRATIC, which shows that the count tells what grows with the square.
#define _GNU_SOURCE
#include "tests/steps/constructs.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <sched.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum {
    ARGUMENTS_MAX = 8,
    SECONDS_MAX = 60, // of processor time of one run: what takes longer has failed
    TIMES = 4,        // as many of the construct
    RATIO = 5,        // as many steps, at most
};

// SCENE stands for the construct's scene.
#define SCENE "\1"
static const char *const commands[][ARGUMENTS_MAX] = {
    {"check", SCENE, "--max-messages", "1000000"},
    {"check", SCENE, "--format", "sarif", "-v"},
    {"check", SCENE, "--fix=all", "--diff"},
    {"format", "--diff", SCENE},
    {"convert", SCENE, "-"},
    {"diff", SCENE, SCENE},
    // Of a picture so small that the rays of its forecast do not count.
    {"inspect", "--size", "4x3", SCENE},
    {"deps", "--format", "json", SCENE},
};

// ---- making the files

static void put_each(FILE *file, const char *each, unsigned i) {
    for (const char *c = each; *c; c++) {
        if (*c == '@')
            fprintf(file, "%u", i);
        else if (*c == '^') // of one length, and not near each other
            fprintf(file, "%08" PRIx32, (uint32_t)(i + 1) * UINT32_C(2654435769));
        else
            fputc(*c, file);
    }
}

static bool make_files(const struct construct *construct, unsigned n) {
    FILE *file = NULL;
    bool good = true;
    for (unsigned p = 0; p < PIECES_MAX && construct->pieces[p].once; p++) {
        const struct piece *piece = &construct->pieces[p];
        if (piece->file && file)
            good = fclose(file) == 0 && good;
        if (piece->file)
            file = fopen(piece->file, "wb");
        if (!file)
            return false;
        fputs(piece->once, file);
        for (unsigned i = 0; i < n && piece->each; i++)
            put_each(file, piece->each, i);
    }
    return file && fclose(file) == 0 && good;
}

static void remove_files(const struct construct *construct) {
    for (unsigned p = 0; p < PIECES_MAX && construct->pieces[p].once; p++)
        if (construct->pieces[p].file)
            unlink(construct->pieces[p].file);
}

// ---- counting

static void become(const char *const *argv) {
    cpu_set_t one;
    struct rlimit limit = {SECONDS_MAX, SECONDS_MAX};
    int null = open("/dev/null", O_RDWR);
    CPU_ZERO(&one);
    CPU_SET((unsigned)sched_getcpu(), &one);
    sched_setaffinity(0, sizeof one, &one);
    setrlimit(RLIMIT_CPU, &limit);
    dup2(null, STDIN_FILENO);
    dup2(null, STDOUT_FILENO);
    dup2(null, STDERR_FILENO);
    execv(argv[0], (char *const *)(uintptr_t)argv);
    _exit(127);
}

// The steps of one run; 0: it did not end by itself.
static uint64_t count(const char *const *argv) {
    uint64_t steps = 0;
    int status = 0;
    unlink("steps.txt");
    pid_t pid = fork();
    if (pid == 0)
        become(argv);
    if (pid < 0 || waitpid(pid, &status, 0) != pid || !WIFEXITED(status) || WEXITSTATUS(status) > 3)
        return 0;
    FILE *file = fopen("steps.txt", "r");
    if (!file)
        return 0;
    bool found = fscanf(file, "%" SCNu64, &steps) == 1;
    fclose(file);
    return found ? steps : 0;
}

static uint64_t run(const char *glint, const char *const *command, const char *scene) {
    const char *argv[ARGUMENTS_MAX + 2] = {glint};
    for (int i = 0; i < ARGUMENTS_MAX && command[i]; i++)
        argv[i + 1] = strcmp(command[i], SCENE) == 0 ? scene : command[i];
    return count(argv);
}

static bool judge(const char *what, const char *how, uint64_t few, uint64_t many, bool all) {
    bool good = few > 0 && many > 0 && many <= RATIO * few;
    if (!good || all)
        printf("%s %s, %s: %" PRIu64 " and %" PRIu64 " steps, x%.2f\n", good ? "ok  " : "FAIL", what, how,
               few, many, few ? (double)many / (double)few : 0);
    return good;
}

static unsigned take(const char *glint, const struct construct *construct, bool all) {
    enum {
        COMMANDS = sizeof commands / sizeof *commands
    };
    uint64_t steps[2][COMMANDS];
    unsigned failed = 0;
    for (unsigned k = 0; k < 2; k++) {
        if (!make_files(construct, k ? construct->n * TIMES : construct->n))
            return 1;
        for (unsigned i = 0; i < COMMANDS; i++)
            steps[k][i] = run(glint, commands[i], construct->pieces[0].file);
        remove_files(construct);
    }
    for (unsigned i = 0; i < COMMANDS; i++) {
        char how[64];
        if (construct->constant && commands[i][2] && strcmp(commands[i][2], construct->constant) == 0)
            continue;
        snprintf(how, sizeof how, "%s%s%s", commands[i][0], commands[i][2] ? " " : "",
                 commands[i][2] ? commands[i][2] : "");
        failed += !judge(construct->name, how, steps[0][i], steps[1][i], all);
    }
    return failed;
}

// ---- what the count must tell apart

static unsigned prove(const char *quadratic) {
    static const struct {
        const char *kind;
        bool grows;
    } kinds[] = {{"linear", false}, {"loop", true}, {"library", true}};
    unsigned failed = 0;
    for (unsigned i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const char *few[] = {quadratic, kinds[i].kind, "2000", NULL};
        const char *many[] = {quadratic, kinds[i].kind, "8000", NULL};
        uint64_t a = count(few), b = count(many);
        bool good = a && b && (b > RATIO * a) == kinds[i].grows;
        printf("%s %s work: %" PRIu64 " and %" PRIu64 " steps\n", good ? "ok  " : "FAIL", kinds[i].kind, a,
               b);
        failed += !good;
    }
    return failed;
}

int main(int argc, char **argv) {
    char *glint = argc > 3 ? realpath(argv[1], NULL) : NULL;
    char *quadratic = argc > 3 ? realpath(argv[2], NULL) : NULL;
    const char *part = argc > 4 ? argv[4] : NULL;
    if (!glint || !quadratic || chdir(argv[3]) != 0 || setenv("GLINT_STEPS", "steps.txt", 1) != 0) {
        fprintf(stderr, "run_steps GLINT QUADRATIC WORK_FOLDER [PART]: %s\n", strerror(errno));
        return 2;
    }
    setvbuf(stdout, NULL, _IOLBF, 0);
    unsigned failed = prove(quadratic), taken = 0;
    for (const struct construct *c = constructs; c->name; c++) {
        if (part && !strstr(c->name, part))
            continue;
        failed += take(glint, c, part != NULL);
        taken++;
    }
    printf("%u constructs, %u of what they take grows faster\n", taken, failed);
    free(glint);
    free(quadratic);
    return failed ? 1 : 0;
}
