#include "judge.h"

#include "folder.h"

#include <string.h>
#include <sys/wait.h>

enum {
    EXIT_FILE = 3,
    EXIT_DEVICE = 4,
    HOST_MEMORY = -1, // VK_ERROR_OUT_OF_HOST_MEMORY
    NO_DRIVER = -9,   // VK_ERROR_INCOMPATIBLE_DRIVER
};

const char *const verdict_names[VERDICT_COUNT] = {"same result",   "out of memory", "told",        "crashes",
                                                  "lost findings", "wrong reasons", "torn outputs"};

static bool is_start(const struct bytes *start, size_t size, const struct bytes *all) {
    return size <= all->size && memcmp(start->data, all->data, size) == 0;
}

static bool is_equal(const struct bytes *a, const struct bytes *b) {
    return a->size == b->size && is_start(a, a->size, b);
}

// Standard output: nothing, all of it, or whole messages. What cannot read a file may say what it knows:
// whole lines.
static bool is_whole(const struct task *task, const struct faults *plan, const struct bytes *got,
                     const struct bytes *wanted) {
    if (got->size == 0 || is_equal(got, wanted) || task->marks & TIMED)
        return true;
    if (plan->kind == FAULTS_FILES)
        return task->marks & LSP || got->data[got->size - 1] == '\n';
    return task->marks & LSP && is_start(got, got->size, wanted) &&
           strncmp(wanted->data + got->size, "Content-Length", 14) == 0;
}

static bool is_torn(const struct stage *stage, const struct task *task, const struct outcome *good,
                    const struct outcome *outcome) {
    const char *now = outcome->folder.data;
    if (task->marks & (PARTS | TIMED))
        return !is_mix(now, stage->before.data, good->folder.data) &&
               !(task->marks & TIMED && good->status == outcome->status);
    return strcmp(now, stage->before.data) != 0 && strcmp(now, good->folder.data) != 0;
}

// The message is the last line; before it there is what a good run says.
static bool says_memory(const struct outcome *good, const struct outcome *outcome) {
    static const char message[] = "glint: out of memory";
    const struct bytes *text = &outcome->error;
    size_t line = text->size;
    while (line > 0 && (line == text->size || text->data[line - 1] != '\n'))
        line--;
    return strncmp(text->data + line, message, sizeof message - 1) == 0 && is_start(text, line, &good->error);
}

// The text without the lines that only help: a hint that is looked for in a folder is not a finding.
static size_t next_line(const struct bytes *text, size_t at) {
    static const char help[] = "       = help: ";
    for (;;) {
        size_t end = at + strcspn(text->data + at, "\n") + 1;
        if (end > text->size || strncmp(text->data + at, help, sizeof help - 1) != 0)
            return at;
        at = end;
    }
}

static bool is_equal_without_help(const struct bytes *a, const struct bytes *b) {
    size_t at = next_line(a, 0), other = next_line(b, 0);
    while (at < a->size && other < b->size) {
        size_t length = strcspn(a->data + at, "\n") + 1;
        if (strncmp(a->data + at, b->data + other, length) != 0)
            return false;
        at = next_line(a, at + length);
        other = next_line(b, other + length);
    }
    return at >= a->size && other >= b->size;
}

static bool is_of_folder(const struct outcome *outcome) {
    return strcmp(outcome->call, "opendir") == 0 || strcmp(outcome->call, "readdir") == 0;
}

static bool is_same(const struct task *task, const struct outcome *good, const struct outcome *outcome,
                    bool silenced) {
    bool timed = task->marks & TIMED;
    return outcome->status == good->status && (timed || is_equal(&outcome->out, &good->out)) &&
           (silenced || is_equal(&outcome->error, &good->error) ||
            (is_of_folder(outcome) && is_equal_without_help(&outcome->error, &good->error))) &&
           (timed || is_equal(&outcome->folder, &good->folder));
}

static bool ends_with(const struct outcome *outcome, int status) {
    return WIFEXITED(outcome->status) && WEXITSTATUS(outcome->status) == status;
}

static bool has(const struct outcome *outcome, const char *text) {
    return strstr(outcome->error.data, text) != NULL;
}

// Every line of a good run, in its order, and others between: a scene of which nobody could tell whether it
// reads what changed is checked too.
static bool says_more(const struct outcome *good, const struct outcome *outcome) {
    size_t at = 0;
    for (size_t line = 0; line < good->error.size;) {
        const size_t length = strcspn(good->error.data + line, "\n") + 1;
        while (at < outcome->error.size &&
               strncmp(outcome->error.data + at, good->error.data + line, length) != 0)
            at += strcspn(outcome->error.data + at, "\n") + 1;
        if (at >= outcome->error.size)
            return false;
        at += length;
        line += length;
    }
    return outcome->status == good->status && is_equal(&outcome->out, &good->out) &&
           is_equal(&outcome->folder, &good->folder);
}

// A report is whole and tells the error itself.
static bool reports_file(const struct task *task, const struct faults *plan, const struct outcome *outcome) {
    static const char end[] = "}\n";
    const struct bytes *report = &outcome->report;
    return task->marks & REPORT && report->size > sizeof end &&
           strcmp(report->data + report->size - sizeof end + 1, end) == 0 &&
           strstr(report->data, strerror(plan->error)) != NULL;
}

// The system's words for the error; a stream that cannot be written cannot say why.
static bool tells_file(const struct faults *plan, const struct outcome *outcome, bool silenced) {
    int status = WIFEXITED(outcome->status) ? WEXITSTATUS(outcome->status) : 0;
    return status >= 1 && status <= EXIT_DEVICE && (silenced || has(outcome, strerror(plan->error)));
}

// The language server tells a file that cannot be read as a finding, and offers no names of a folder that
// cannot.
static bool serves_on(const struct faults *plan, const struct outcome *good, const struct outcome *outcome) {
    return outcome->status == good->status && outcome->error.size == 0 &&
           (is_of_folder(outcome) || strstr(outcome->out.data, strerror(plan->error)));
}

// The call that failed.
static bool tells_device(const struct faults *plan, const struct outcome *outcome) {
    return ends_with(outcome, EXIT_DEVICE) &&
           has(outcome, plan->error == NO_DRIVER ? "no Vulkan driver is installed" : outcome->call);
}

enum verdict judge(const struct stage *stage, const struct task *task, const struct faults *plan,
                   const struct outcome *good, const struct outcome *outcome) {
    bool silenced = strcmp(outcome->call, "write 2") == 0; // the standard error
    bool cut = strcmp(outcome->call, "write 1") == 0;
    if (!WIFEXITED(outcome->status))
        return VERDICT_CRASH;
    if (is_same(task, good, outcome, silenced))
        return VERDICT_SAME;
    if (plan->kind == FAULTS_FILES && task->marks & LSP && serves_on(plan, good, outcome))
        return VERDICT_TOLD;
    if (plan->kind == FAULTS_FILES && task->marks & SCOPED && says_more(good, outcome))
        return VERDICT_SAME;
    if (plan->kind == FAULTS_FILES && reports_file(task, plan, outcome))
        return VERDICT_TOLD;
    if (is_torn(stage, task, good, outcome))
        return VERDICT_TORN;
    bool whole = cut || is_whole(task, plan, &outcome->out, &good->out);
    bool memory = plan->kind == FAULTS_MEMORY || (plan->kind == FAULTS_VULKAN && plan->error == HOST_MEMORY);
    if (memory && whole && ends_with(outcome, EXIT_FILE) && says_memory(good, outcome))
        return VERDICT_MEMORY;
    if (plan->kind == FAULTS_FILES && whole && tells_file(plan, outcome, silenced))
        return VERDICT_TOLD;
    if (plan->kind == FAULTS_VULKAN && !memory && whole && tells_device(plan, outcome))
        return VERDICT_TOLD;
    return outcome->status == good->status ? VERDICT_LOST : VERDICT_WRONG;
}
