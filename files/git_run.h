// Runs git and captures its output. Private to files; a WebAssembly module cannot start a program and has
// JavaScript do so (web/system.c).
#ifndef GLINT_FILES_GIT_RUN_H
#define GLINT_FILES_GIT_RUN_H

#include "core/strbuf.h"

enum {
    GIT_OUT = 0,
    GIT_ERR = 1,
};

struct git_answer {
    struct strbuf text[2]; // standard output and error; the caller frees them
    int error;             // errno if git could not run; 0: it ran
    int status;            // its exit status
};

struct sandbox;
// `words`, the first of which is "git", end with NULL. `limits`: it may only read (sandbox_only_read), as far
// as the system can enforce that; NULL: it has this program's rights.
void git_run(struct git_answer *answer, const char *const *words, const struct sandbox *limits);

#endif
