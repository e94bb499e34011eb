// What the runner asks glint for, and one run of it.
//
// Ownership: outcomes hold memory until outcome_finish. Errors: what the test itself cannot do ends it with a
// message. Thread safety: one thread.
#ifndef GLINT_TESTS_FAULTS_TASK_H
#define GLINT_TESTS_FAULTS_TASK_H

#include "faults.h"

#include <stddef.h>

enum task_mark {
    PARTS = 1,   // writes several files, each of which is whole or as it was
    TIMED = 2,   // what it reports depends on time: only its exit status and its errors are compared
    LSP = 4,     // its standard input is session.lsp, as messages
    STREAM = 8,  // its standard input is messy.glint.yaml
    CACHE = 16,  // uses the reference's cache, which is empty before
    REPORT = 64, // writes report.sarif
    WHOLE = 256, // one run takes several seconds: only a whole run makes its calls fail
    RARE = 128,  // most of its calls are those of another task: fewer fail, and those of Vulkan only in a
                 // whole run
    SPREAD = 32, // one run takes long: the suite's run makes only a spread of its calls fail
    SCOPED = 512 // what cannot be told to be out of its scope is in it: it may say more than a good run
};

enum {
    TASK_ARGUMENTS_MAX = 20
};

struct task {
    const char *name;
    unsigned kinds; // bits 1 << enum faults_kind
    unsigned marks;
    const char *arguments[TASK_ARGUMENTS_MAX]; // NULL ends them
};

extern const struct task tasks[];
extern const size_t task_count;

struct bytes {
    char *data; // NUL-terminated
    size_t size;
};

struct outcome {
    int status; // as waitpid gives it
    struct bytes out, error;
    struct bytes report; // of a task with that mark
    struct bytes folder; // what the folder holds: a line for each file
    uint32_t seen, failed;
    char call[64];
};

// Where a run happens, and with what.
struct stage {
    const char *glint, *shim;
    const char *root;  // of glint's sources
    char folder[4096]; // the run's; its other files lie beside it
    struct bytes before;
};

void stage_open(struct stage *stage, const char *glint, const char *shim, const char *root, const char *work);
void stage_close(struct stage *stage);
// The folder as it was at first.
void stage_reset(struct stage *stage, const struct task *task);
struct outcome stage_run(const struct stage *stage, const struct task *task, const struct faults *plan);
void outcome_finish(struct outcome *outcome);

_Noreturn void die(const char *what);

#endif
