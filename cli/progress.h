// A progress bar with the time left on a terminal, plain lines elsewhere, and the end by Ctrl-C.
#ifndef GLINT_CLI_PROGRESS_H
#define GLINT_CLI_PROGRESS_H

#include "tracer/render/render.h"

struct progress {
    bool terminal, quiet;
    double start, last; // seconds
    double base, share; // this frame's part of the whole: base + share * fraction
    bool shown;
    const char *what; // is under way; NULL: nothing to tell apart
};

void progress_begin(struct progress *progress, bool quiet);
// The callback of renderer_render; false after a signal.
struct render_progress progress_callback(struct progress *progress);
// Erases the bar.
void progress_end(struct progress *progress);

// From now on SIGINT and SIGTERM end the work at the next dispatch; a second one ends the process at once.
void interrupt_catch(void);
// 0, or the signal that came.
int interrupt_signal(void);

#endif
