// Work cut into pieces of a fixed size, so that results never depend on the number of threads.
#ifndef GLINT_CORE_PARALLEL_H
#define GLINT_CORE_PARALLEL_H

#include <stddef.h>

typedef void parallel_body(void *context, size_t begin, size_t end);

// Calls `body` for [0, count) in pieces of `piece` items (the last may be smaller), on all processors;
// returns when all are done. Pieces run in any order and at the same time: `body` writes only what
// belongs to its items. `piece` is at least 1. An arena is not shared: a guard belongs to the
// thread that runs the work. Calls inside `body` share the processors: threads do not multiply. Falls back to
// the calling thread if none can be made.
void parallel_for(size_t count, size_t piece, parallel_body *body, void *context);
// Processors that this process may use, at least 1.
unsigned parallel_processors(void);

#endif
