// What a scene's own animation says of frames.
#include "cli/commands/batch/batch_job.h"
#include "grammar/ir.h"

struct batch_motion batch_motion_of(struct cli *cli, const char *scene, const str *sets, uint32_t set_count) {
    struct session session;
    struct session_options options = cli_session_options(cli, scene);
    struct asset_store *store = asset_store_create();
    struct batch_motion motion = {0};
    options.text_only = true;
    options.sets = sets;
    options.set_count = set_count;
    session_load(&session, &options, store);
    motion.is_good = session.sink.errors == 0 && session.scene;
    if (motion.is_good && session.origin.motion.frames) {
        motion.is_animated = true;
        motion.frames = session.origin.motion.frames;
        motion.rate = session.origin.motion.rate;
    }
    session_finish(&session);
    asset_store_destroy(store);
    return motion;
}

int batch_judge_file(struct cli *cli, const char *scene) {
    struct session session;
    struct session_options options = cli_session_options(cli, scene);
    options.text_only = true;
    options.set_count = 0;
    session_load(&session, &options, NULL);
    const int status = cli_session_status(&session);
    if (status != CLI_OK)
        cli_report(cli, &session, false);
    session_finish(&session);
    return status;
}

int batch_no_animation(struct cli *cli, const char *scene) {
    cli_usage(cli, cli_option_place(cli, "frames"), "'%s' has no animation, and 'all' are its frames", scene);
    diag_help(&cli->sink, "say which frames: --frames 0..99");
    return CLI_USAGE;
}

int batch_take_all(struct cli *cli, const char *scene) {
    struct cli_batch *b = &cli->options.batch;
    if (!b->all_frames)
        return CLI_OK;
    const struct batch_motion motion =
        batch_motion_of(cli, scene, cli->options.sets.items, cli->options.sets.count);
    const int status = motion.is_good ? CLI_OK : batch_judge_file(cli, scene);
    if (status != CLI_OK)
        return status;
    if (!motion.is_animated && motion.is_good)
        return batch_no_animation(cli, scene);
    b->all_frames = false;
    b->last_frame = motion.is_animated ? motion.frames - 1 : 0; // rendering reports its mistakes
    return CLI_OK;
}
