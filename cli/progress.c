#include "cli/progress.h"

#include "core/clock.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

enum {
    WHAT_CELLS = 24,
    LINE_CELLS = 79,
};

static volatile sig_atomic_t caught;

static void on_signal(int number) {
    caught = number;
}

void interrupt_catch(void) {
    struct sigaction action = {.sa_handler = on_signal, .sa_flags = (int)SA_RESETHAND};
    caught = 0;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

int interrupt_signal(void) {
    return caught;
}

void progress_begin(struct progress *progress, bool quiet) {
    double now = clock_seconds();
    *progress = (struct progress){
        .terminal = isatty(STDERR_FILENO), .quiet = quiet, .start = now, .last = now, .base = 0, .share = 1};
}

static void bar(double done, double left, const char *what) {
    enum {
        CELLS = 30
    };
    char cells[CELLS + 1];
    for (int i = 0; i < CELLS; i++)
        cells[i] = i < (int)(done * CELLS) ? '#' : '.';
    cells[CELLS] = '\0';
    fprintf(stderr, "\r[%s] %3.0f %% ", cells, 100 * done);
    if (isfinite(left))
        fprintf(stderr, " %.0f s left ", left);
    if (what)
        fprintf(stderr, " %-*.*s", WHAT_CELLS, WHAT_CELLS, what);
    fflush(stderr);
}

static void line(double done, double left, const char *what) {
    fprintf(stderr, "glint: %.0f %% done", 100 * done);
    if (isfinite(left))
        fprintf(stderr, ", %.0f s left", left);
    if (what)
        fprintf(stderr, "; under way: %s", what);
    fputc('\n', stderr);
}

static bool report(void *context, double fraction) {
    enum {
        LINE_SECONDS = 10
    };
    struct progress *p = context;
    double now = clock_seconds();
    double done = fmin(p->base + p->share * fraction, 0.99); // never 1 before the end
    // The first half second shows nothing: most pictures are done by then.
    if (!p->quiet && now - p->start > 0.5 && now - p->last > (p->terminal ? 0.1 : LINE_SECONDS)) {
        // Before anything is done, the time left is unknown.
        double left = done > 0 ? (now - p->start) * (1 - done) / done : INFINITY;
        if (p->terminal)
            bar(done, left, p->what);
        else
            line(done, left, p->what);
        p->shown = true;
        p->last = now;
    }
    if (caught == 0)
        return true;
    p->end = p->end > 0 ? p->end : now + p->patience;
    return now < p->end;
}

struct render_progress progress_callback(struct progress *progress) {
    return (struct render_progress){.report = report, .context = progress};
}

void progress_end(struct progress *progress) {
    if (progress->shown && progress->terminal)
        fprintf(stderr, "\r%*s\r", LINE_CELLS, "");
    progress->shown = false;
}
