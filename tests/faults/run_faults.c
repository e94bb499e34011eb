// Makes the calls of glint fail, one at a time, and all from one on, in each command: allocations, calls that
// reach files, calls of Vulkan. It must give the same result, or say what failed, and leave nothing
// half-written.
//
// Usage: run_faults GLINT SHIM SOURCES WORK memory|files|vulkan [spread|whole] [TASK]...
//   spread   (what the suite runs) each place that calls, a spread where one run takes long; `whole`: every
//   call
#define _POSIX_C_SOURCE 200809L

#include "judge.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <vulkan/vulkan_core.h>

enum {
    SPREAD_RUNS = 12, // faults of one kind in a task that takes long
    SPREAD_RUNS_RARE = 4,
    SHOWN_MOST = 8,    // bad outcomes of a task that are shown
    SHOWN_BYTES = 600, // of the standard error
    EXIT_FILE = 3,
    EXIT_NO_DEVICE = 4,
    EXIT_SKIPPED = 77,
};

struct tally {
    unsigned runs, verdicts[VERDICT_COUNT], tasks, skipped, bad_tasks;
};

struct trial {
    struct stage *stage;
    const struct task *task;
    struct outcome good;
    struct tally *tally;
    bool whole;
    unsigned bad;
};

static const char *error_name(const struct faults *plan) {
    static char text[32];
    if (plan->kind == FAULTS_MEMORY)
        return "";
    if (plan->kind == FAULTS_FILES)
        return plan->error == FAULTS_SHORT ? "short" : strerror(plan->error);
    snprintf(text, sizeof text, "VkResult %d", plan->error);
    return text;
}

// Where the text stops being that of a good run: the start of the first line that differs.
static size_t first_other(const struct bytes *good, const struct bytes *text) {
    size_t at = 0, line = 0;
    for (; at < text->size && at < good->size && text->data[at] == good->data[at]; at++)
        if (text->data[at] == '\n')
            line = at + 1;
    return line;
}

static void show(const struct trial *t, const struct faults *plan, const struct outcome *outcome,
                 enum verdict verdict) {
    const int status = outcome->status;
    if (t->bad > SHOWN_MOST)
        return;
    const size_t at = first_other(&t->good.error, &outcome->error);
    printf("%s: %s: call %u%s, %s %s: %s %d, not %d; from byte %zu of its messages\n%.*s\nwhere a good run "
           "says\n%.*s\n",
           t->task->name, verdict_names[verdict], plan->number, plan->onward ? " and all after it" : "",
           outcome->call, error_name(plan), WIFEXITED(status) ? "exit" : "signal",
           WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status), WEXITSTATUS(t->good.status), at,
           SHOWN_BYTES, outcome->error.data + at, SHOWN_BYTES, t->good.error.data + at);
    if (verdict == VERDICT_TORN)
        printf("%s---\n%s\n", outcome->folder.data, t->good.folder.data);
    fflush(stdout);
}

static void try(struct trial *t, const struct faults *plan) {
    stage_reset(t->stage, t->task);
    struct outcome outcome = stage_run(t->stage, t->task, plan);
    if (outcome.failed) {
        const enum verdict verdict = judge(t->stage, t->task, plan, &t->good, &outcome);
        t->tally->runs++;
        t->tally->verdicts[verdict]++;
        if (!VERDICT_GOOD(verdict)) {
            t->bad++;
            show(t, plan, &outcome, verdict);
        }
    }
    outcome_finish(&outcome);
}

// A run without a fault; how many calls there are to fail.
static uint32_t count(struct trial *t, struct faults plan) {
    stage_reset(t->stage, t->task);
    plan.number = 0;
    struct outcome outcome = stage_run(t->stage, t->task, &plan);
    const uint32_t seen = outcome.seen;
    if (!t->good.folder.data)
        t->good = outcome;
    else
        outcome_finish(&outcome);
    return seen;
}

// The first few and a spread of the rest.
static uint32_t after(const struct trial *t, uint32_t number, uint32_t most) {
    const uint32_t runs = t->task->marks & RARE ? SPREAD_RUNS_RARE : SPREAD_RUNS;
    const bool all = t->whole || most <= runs || number < runs / 3;
    return number + (all ? 1 : most / (runs - runs / 3) + 1);
}

static void try_spread(struct trial *t, struct faults plan, uint32_t most) {
    for (plan.number = 1; plan.number <= most; plan.number = after(t, plan.number, most))
        try(t, &plan);
}

// How often a line is among those before `end`.
static unsigned times(const char *lines, const char *end, const char *line, size_t length) {
    unsigned times = 0;
    for (const char *at = lines; at < end; at = strchr(at, '\n') + 1)
        times += strncmp(at, line, length + 1) == 0;
    return times;
}

// The first and the last of those that are listed alike.
static bool is_chosen(const struct trial *t, const char *lines, const char *line, size_t length) {
    const char *end = lines + strlen(lines), *next = line + length + 1;
    return t->whole || times(lines, line, line, length) == 0 || times(next, end, line, length) == 0;
}

// Calls `each` for the calls of the plan's kind that are chosen, with their numbers and with what they are
// listed as.
static void for_chosen(struct trial *t, struct faults plan,
                       void (*each)(struct trial *, struct faults, const char *)) {
    stage_reset(t->stage, t->task);
    plan.lists = true;
    struct outcome calls = stage_run(t->stage, t->task, &plan);
    plan.lists = false;
    for (char *line = calls.error.data, *end; (end = strchr(line, '\n')); line = end + 1) {
        char call[96];
        const size_t length = (size_t)(end - line);
        if (strncmp(line, FAULTS_LISTED, strlen(FAULTS_LISTED)) != 0 || length >= sizeof call)
            continue;
        plan.number++;
        memcpy(call, line, length);
        call[length] = '\0';
        if (is_chosen(t, calls.error.data, line, length))
            each(t, plan, call + strlen(FAULTS_LISTED));
    }
    outcome_finish(&calls);
}

static void try_one(struct trial *t, struct faults plan, const char *call) {
    (void)call;
    try(t, &plan);
}

// What fails once fails in its own way at every place that calls; where all that come after it fail too, the
// way out is the same from everywhere: of that the suite takes a spread.
static void try_all(struct trial *t, struct faults plan, bool onward) {
    const uint32_t most = count(t, plan);
    if (t->whole || t->task->marks & SPREAD)
        try_spread(t, plan, most);
    else
        for_chosen(t, plan, try_one);
    plan.onward = true;
    if (onward)
        try_spread(t, plan, most);
}

static void try_memory(struct trial *t) {
    try_all(t, (struct faults){.kind = FAULTS_MEMORY}, true);
}

static void try_files(struct trial *t) {
    static const int errors[] = {EIO, ENOSPC, EINTR, FAULTS_SHORT};
    for (size_t i = 0; i < sizeof errors / sizeof *errors; i++)
        try_all(t, (struct faults){.kind = FAULTS_FILES, .error = errors[i]},
                errors[i] == EIO || errors[i] == ENOSPC);
}

// ---- Vulkan: each call with the errors that it may give

static size_t errors_of(const char *call, const VkResult **errors) {
#define HOST   VK_ERROR_OUT_OF_HOST_MEMORY
#define DEVICE VK_ERROR_OUT_OF_DEVICE_MEMORY
#define LOST   VK_ERROR_DEVICE_LOST
#define CALL(name, parameters, arguments, ...)                                                               \
    if (strcmp(call, #name) == 0) {                                                                          \
        static const VkResult of_##name[] = {__VA_ARGS__};                                                   \
        *errors = of_##name;                                                                                 \
        return sizeof of_##name / sizeof *of_##name;                                                         \
    }
#include "vulkan_calls.def"
    return 0;
}

// Those after which a device may be at work, which a second failure must not stop from being told.
static bool is_in_flight(const char *call) {
    return strcmp(call, "vkQueueSubmit") == 0 || strcmp(call, "vkWaitForFences") == 0;
}

static void try_call(struct trial *t, struct faults plan, const char *call) {
    const VkResult *errors;
    const size_t most = errors_of(call, &errors);
    for (size_t i = 0; i < most; i++) {
        plan.error = errors[i];
        plan.onward = false;
        try(t, &plan);
        plan.onward = true;
        if (t->whole || is_in_flight(call))
            try(t, &plan);
    }
}

static void try_vulkan(struct trial *t) {
    for_chosen(t, (struct faults){.kind = FAULTS_VULKAN}, try_call);
}

// ---- all

static void run_task(struct stage *stage, const struct task *task, enum faults_kind kind, bool whole,
                     struct tally *tally) {
    static void (*const try_kind[])(struct trial *) = {
        [FAULTS_MEMORY] = try_memory, [FAULTS_FILES] = try_files, [FAULTS_VULKAN] = try_vulkan};
    const unsigned before = tally->runs;
    struct trial trial = {.stage = stage, .task = task, .tally = tally, .whole = whole};
    count(&trial, (struct faults){.kind = kind});
    if (trial.good.status == EXIT_FILE << 8) {
        printf("%-18s fails without a fault:\n%s\n", task->name, trial.good.error.data);
        tally->bad_tasks++;
    } else if (trial.good.status == EXIT_NO_DEVICE << 8) {
        printf("%-18s skipped: there is no device\n", task->name);
        tally->skipped++;
    } else {
        try_kind[kind](&trial);
        tally->tasks++;
        tally->bad_tasks += trial.bad > 0 || tally->runs == before;
        printf("%-18s %5u faults, %u bad%s\n", task->name, tally->runs - before, trial.bad,
               tally->runs == before ? ": no call could be made to fail" : "");
    }
    fflush(stdout);
    outcome_finish(&trial.good);
}

static bool is_asked(const struct task *task, enum faults_kind kind, bool whole, char **names) {
    const bool rare = task->marks & WHOLE || (task->marks & RARE && kind == FAULTS_VULKAN);
    if (!(task->kinds & 1u << kind) || (rare && !whole))
        return false;
    for (char **name = names; *name; name++)
        if (strcmp(*name, task->name) == 0)
            return true;
    return !*names;
}

static int kind_of(const char *name) {
    static const char *const names[] = {
        [FAULTS_MEMORY] = "memory", [FAULTS_FILES] = "files", [FAULTS_VULKAN] = "vulkan"};
    for (int i = 0; i < 3; i++)
        if (strcmp(name, names[i]) == 0)
            return i;
    return -1;
}

int main(int argc, char **argv) {
    const int kind = argc < 6 ? -1 : kind_of(argv[5]);
    if (kind < 0) {
        fprintf(stderr,
                "usage: run_faults GLINT SHIM SOURCES WORK memory|files|vulkan [spread|whole] [TASK]...\n");
        return 2;
    }
    const bool whole = argc > 6 && strcmp(argv[6], "whole") == 0;
    char **names = argv + 6 + (whole || (argc > 6 && strcmp(argv[6], "spread") == 0));
    struct tally tally = {0};
    struct stage stage;
    stage_open(&stage, argv[1], argv[2], argv[3], argv[4]);
    for (size_t i = 0; i < task_count; i++)
        if (is_asked(&tasks[i], (enum faults_kind)kind, whole, names))
            run_task(&stage, &tasks[i], (enum faults_kind)kind, whole, &tally);
    stage_close(&stage);
    printf("%s: %u faults in %u commands:", argv[5], tally.runs, tally.tasks);
    for (int i = 0; i < VERDICT_COUNT; i++)
        printf("%s %s=%u", i ? "," : "", verdict_names[i], tally.verdicts[i]);
    printf("\n");
    if (tally.tasks == 0 && tally.bad_tasks == 0)
        return EXIT_SKIPPED;
    return tally.bad_tasks != 0;
}
