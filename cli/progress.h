// A progress bar with the time left on a terminal, plain lines elsewhere, and handling of Ctrl-C.
#ifndef GLINT_CLI_PROGRESS_H
#define GLINT_CLI_PROGRESS_H

#include "tracer/render/render.h"

struct progress {
    bool terminal, quiet;
    double start, last; // seconds
    double base, share; // this frame's part of the whole: base + share * fraction
    bool shown;
    const char *what; // what is under way; NULL: there is only one kind of work
    double patience;  // seconds that a frame under way may go on after a signal; 0: it ends at once
    double end;       // clock: end of that time; 0: no signal came
};

// After a signal a frame under way may finish, within this time: Slurm kills 30 s after its signal.
#define PROGRESS_PATIENCE 10.0

void progress_begin(struct progress *progress, bool quiet);
// The callback of renderer_render; false after a signal, once the patience is over.
struct render_progress progress_callback(struct progress *progress);
// Erases the bar.
void progress_end(struct progress *progress);

// From now on SIGINT and SIGTERM end the work at the next dispatch; a second one ends the process at once.
void interrupt_catch(void);
// 0, or the signal that came.
int interrupt_signal(void);

#endif
