// glint farm: what is rendered by which task, and the script for the engine that runs them. Private to
// cli/farm.
//
// A task is some frames of one tile: task N, from 0, renders tile N % tiles + 1 of the `chunk` frames that
// begin at number N / tiles * chunk of all frames. Ownership: text lies in cli->arena. Thread safety: as
// cli.h.
#ifndef GLINT_CLI_COMMANDS_FARM_FARM_H
#define GLINT_CLI_COMMANDS_FARM_FARM_H

#include "cli/cli.h"
#include "files/temporary.h"

enum farm_engine {
    FARM_SLURM,
    FARM_PARALLEL,
    FARM_K8S,
};
extern const char *const farm_engines[]; // NULL ends them

struct farm_pilot {
    uint32_t frames, width, height; // that were measured, and their size in pixels
    double start_s;                 // from the start of the program to the first scene
    double load_s;                  // per frame, before it is traced
    double picture_s;               // tracing the whole picture
};

struct farm_plan {
    enum farm_engine engine;
    bool has_frames;
    int32_t first, last, step; // 0, 0, 1 without frames
    uint32_t frames, tiles, chunk, tasks;
    const char *root;   // absolute: the folder that the other paths are relative to
    const char *scene;  // that tasks render
    const char *output; // pattern of pictures' names, for frame_name if there are frames
    const char *part;   // a part's name before the tile's number and ".part"; NULL: one tile
    const char *folder; // of plan, script and logs; NULL: the script goes to standard output
    struct farm_pilot pilot;
    bool is_measured;
    struct temporary made; // the folder, if farm_begin made it
};

// farm_plan.c: the plan that the command line asks for, but for its chunk. CLI_OK, or an exit code with
// the mistake reported.
int farm_plan_make(struct cli *cli, struct farm_plan *plan);
// farm_file.c: whether the folder can take the plan; makes it. An exit code.
int farm_begin(struct cli *cli, struct farm_plan *plan);
// Whether the tasks' logs may be written, once it is known how many there are. An exit code.
int farm_judge_logs(struct cli *cli, const struct farm_plan *plan);
// Keeps the folder or, after an error, removes it if farm_begin made it. The plan must not be moved between
// the two calls.
void farm_end(struct farm_plan *plan, int status);
// farm_pilot.c: whether the scene can be rendered this way, checked without a device. An exit code.
int farm_check(struct cli *cli, struct farm_plan *plan);
// Renders small pictures of some frames, and chooses the chunk. An exit code.
int farm_measure(struct cli *cli, struct farm_plan *plan);
// farm_script.c: the shell's parts of a script, from the templates beside it (*.sh.in): what a task and the
// merge do, the same for all engines; and how Slurm or GNU parallel start them.
void farm_write_tasks(const struct cli_options *options, const struct farm_plan *plan, struct strbuf *out);
void farm_write_engine(const struct cli_options *options, const struct farm_plan *plan, struct strbuf *out);
// A word for a shell of POSIX, in quotes. It has no control characters.
void farm_quote(struct strbuf *out, const char *word);
// farm_engine.c: the whole script.
void farm_write_script(struct cli *cli, const struct farm_plan *plan, struct strbuf *out);
const char *farm_script_name(enum farm_engine engine);
// farm_file.c: the plan as a file of the folder, and back.
int farm_save(struct cli *cli, const struct farm_plan *plan, str script);
int farm_load(struct cli *cli, const char *folder, struct farm_plan *plan);
// farm_read.c: a plan from the text of its file, in which its strings lie and which is changed; false if
// farm_save did not write it.
#define FARM_PLAN_HEAD "glint farm 1\n"
bool farm_plan_read(char *text, struct farm_plan *plan);
// The name of a frame's picture, and that of a part.
const char *farm_picture(struct cli *cli, const struct farm_plan *plan, int32_t frame);
const char *farm_part(struct cli *cli, const struct farm_plan *plan, int32_t frame, uint32_t tile);
// farm_status.c
int farm_status(struct cli *cli, const char *folder);

#endif
