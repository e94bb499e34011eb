// The options of many pictures from one process (cli/commands/batch).
//
// Thread safety: as cli.h.
#ifndef GLINT_CLI_OPTIONS_OPTIONS_BATCH_H
#define GLINT_CLI_OPTIONS_OPTIONS_BATCH_H

#include "core/str.h"

#include <stdbool.h>

enum cli_batch_option {
    CLI_BATCH_FRAMES,
    CLI_BATCH_FRAME,
    CLI_BATCH_FPS,
    CLI_BATCH_SWEEP,
    CLI_BATCH_LIST,
    CLI_BATCH_MONTAGE,
    CLI_BATCH_KEEP_GOING,
    CLI_BATCH_SKIP_DONE,
};

struct cli_batch_values {
    str *items;
    uint32_t count;
};

// PATH=A:B:N or PATH=V,V,...
struct cli_batch_sweep {
    str path;
    struct cli_batch_values values;
    int arg;
};

struct cli_batch {
    bool has_frames;
    bool all_frames; // of the animation: batch_take_all says which, for one scene
    int32_t first_frame, last_frame, frame_step;
    int frames_arg;
    double fps; // 0: not given
    struct {
        struct cli_batch_sweep *items;
        uint32_t count, capacity;
    } sweeps;
    const char *list; // NULL: not given
    int list_arg;
    bool montage, stops; // stops: --keep-going=no
    bool skip_done;
    int montage_arg;
};

struct cli;
// Takes one of them. false: the value is wrong, and the mistake is in cli->sink.
bool cli_batch_apply(struct cli *cli, int arg, enum cli_batch_option option, const char *value);

#endif
