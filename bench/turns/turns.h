// A system that bench/run measures: it opens a scene, then makes frames when it is asked to, so that several
// programs can take turns frame by frame.
//
// On the command line: SCENE [--assets DIR] [--device NAME|N] [--size WxH] [--samples N] [--set
// PATH=VALUE]...
// [--system NAME]. It writes an object of JSON in one line when it is ready: what opening took and what the
// scene has. Then it reads lines: `frames N` makes N frames and answers with their times in seconds, `picture
// FILE` writes the last one (.png, .pfm), `end`, or the end of the input, ends it. With `--whole OUT` it
// makes one picture as a user's program would, writes it, reports and ends. Errors: one line, or the scene's
// diagnostics, on standard error, and exit status 1; 77 where the system cannot run here, 2 for a wrong
// command line. Ownership: `open` fills the system's own state, `close` frees it, also after `open` failed.
// Thread safety: one thread.
#ifndef GLINT_BENCH_TURNS_TURNS_H
#define GLINT_BENCH_TURNS_TURNS_H

#include "core/json_write.h"
#include "load/session.h"
#include "picture/write/image.h"

enum {
    TURNS_SETS_MOST = 16,
    TURNS_SKIPPED = 77, // exit status: not installed, or the device lacks what it takes
};

struct turns_options {
    const char *scene, *device, *whole; // NULL: not given
    const char *system;                 // the program's own one where none was named
    str assets;
    str sets[TURNS_SETS_MOST];
    uint32_t set_count;
    uint32_t width, height, samples; // 0: the scene's
};

enum turns_status {
    TURNS_DONE,
    TURNS_FAILED, // standard error says why
    TURNS_CANNOT, // and why it cannot run here
};

struct turns_system {
    const char *name;
    // The scene is loaded. Everything up to the first frame.
    enum turns_status (*open)(void *state, const struct turns_options *options, struct session *session);
    // Seconds on a device's own clock, where it has one: else *device is left as it is, 0.
    bool (*frame)(void *state, struct image *image, double *device);
    // Members of the object that says that it is ready, and of that of a whole picture: times in seconds,
    // counts.
    void (*facts)(void *state, struct json_writer *writer);
    void (*close)(void *state);
};

int turns_main(int argc, char **argv, const struct turns_system *system, void *state);
// Prints a line to standard error; for `open`.
enum turns_status turns_say(enum turns_status status, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
