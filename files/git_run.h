// Runs git and takes what it says. Private to files; a module of WebAssembly, which cannot start a program,
// has JavaScript do so (web/system.c).
#ifndef GLINT_FILES_GIT_RUN_H
#define GLINT_FILES_GIT_RUN_H

#include "core/strbuf.h"

enum {
    GIT_OUT = 0,
    GIT_ERR = 1,
};

struct git_answer {
    struct strbuf text[2]; // standard output and error, of the caller, who frees them
    int error;             // errno of what kept git from running; 0: it ran
    int status;            // its own
};

struct sandbox;
// `words`, the first of which is "git", end with NULL. `limits`: it may only read (sandbox_only_read), as far
// as the system can see to it; NULL: it may what this program may.
void git_run(struct git_answer *answer, const char *const *words, const struct sandbox *limits);

#endif
