// What glint says about a file outside the folders that a scene may read.
#ifndef GLINT_DIAG_DIAG_OUTSIDE_H
#define GLINT_DIAG_DIAG_OUTSIDE_H

#include "diag/diag.h"
#include "files/files.h"

// Adds help, and a fix if there is one, to the diagnostic added last: the scene names `path`, which led to
// `target`.
void diag_outside(struct diag_sink *sink, struct files *files, str path, str target);

#endif
