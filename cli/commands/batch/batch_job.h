// Many pictures from one process: the command line as a list of jobs, which are rendered one after another.
//
// A job is a scene, settings, a frame and a camera, and the files of its picture, each written under a
// temporary name and renamed. A job's picture has the bytes that a process of its own would give it: nothing
// in it depends on the other jobs. Consecutive jobs that differ only by their camera have the same `load`.
// Ownership: jobs live in cli->arena. Thread safety: as cli.h.
#ifndef GLINT_CLI_COMMANDS_BATCH_BATCH_JOB_H
#define GLINT_CLI_COMMANDS_BATCH_BATCH_JOB_H

#include "cli/cli.h"

struct batch_job {
    const char *scene;
    const str *sets; // --set, with the frame's numbers and the sweep's values in them
    uint32_t set_count;
    str values; // the sweep's values, for names: "1.3_0.5"; empty: there is no sweep
    str camera; // empty: the first
    bool has_frame;
    int32_t frame;
    uint32_t number, load; // from 0
    const char **paths;    // by output of the command line
};

enum batch_film {
    BATCH_NO_FILM,
    BATCH_Y4M,    // written by glint
    BATCH_FFMPEG, // by ffmpeg, which reads it from a pipe
};

struct batch {
    struct cli *cli;
    struct {
        struct batch_job *items;
        uint32_t count, capacity;
    } jobs;
    uint32_t columns; // of a sheet
    double fps;
    enum batch_film film; // of the only output
};

// What a scene says of its frames.
struct batch_motion {
    bool is_animated, is_good; // is_good: it could be read
    int32_t frames;
    double rate; // frames a second
};
// batch_motion.c: reads only text, with the first frame's and the sweep's first values.
struct batch_motion batch_motion_of(struct cli *cli, const char *scene, const str *sets, uint32_t set_count);
// Whether the scene's text is right as it is in the file, without --set: CLI_OK, or an exit code with the
// mistakes reported.
int batch_judge_file(struct cli *cli, const char *scene);
// Reports that there are no frames to be 'all'. An exit code.
int batch_no_animation(struct cli *cli, const char *scene);
// If --frames is 'all', for one scene: puts the frames into the options. An exit code, as batch_plan.
int batch_take_all(struct cli *cli, const char *scene);

// The jobs; CLI_OK, or an exit code with the mistake reported.
int batch_plan(struct batch *batch);
// The names of the jobs' pictures, all different.
int batch_name(struct batch *batch);
// What film a path asks for by its ending; '-' is Y4M.
enum batch_film batch_film_of(const char *path);

#endif
