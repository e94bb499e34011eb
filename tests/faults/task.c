#include "task.h"

#define KIND(kind)                    (1u << (kind))
#define TASK(name, kinds, marks, ...) {name, kinds, marks, {__VA_ARGS__, NULL}},
const struct task tasks[] = {
#include "tasks.def"
};
const size_t task_count = sizeof tasks / sizeof *tasks;
