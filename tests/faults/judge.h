// Whether what glint did with a fault is what it promises.
#ifndef GLINT_TESTS_FAULTS_JUDGE_H
#define GLINT_TESTS_FAULTS_JUDGE_H

#include "task.h"

enum verdict {
    VERDICT_SAME,   // the result that it gives without a fault
    VERDICT_MEMORY, // "out of memory", exit status 3, nothing half-written
    VERDICT_TOLD,   // an error that names what failed, with its exit status; nothing half-written
    VERDICT_CRASH,
    VERDICT_LOST,  // the exit status of a good run, and not its result
    VERDICT_WRONG, // another reason than the fault, or no reason
    VERDICT_TORN,  // a file that is neither the old nor the new one, or one too many
    VERDICT_COUNT,
};
#define VERDICT_GOOD(verdict) ((verdict) <= VERDICT_TOLD)

extern const char *const verdict_names[VERDICT_COUNT];

// `good`: the same task without a fault.
enum verdict judge(const struct stage *stage, const struct task *task, const struct faults *plan,
                   const struct outcome *good, const struct outcome *outcome);

#endif
