// A study of a loaded scene's settings: tradeoff reports it, and render chooses by it.
//
// Thread safety: as cli.h.
#ifndef GLINT_CLI_COMMANDS_STUDY_H
#define GLINT_CLI_COMMANDS_STUDY_H

#include "cli/cli.h"
#include "measure/tradeoff/tradeoff.h"

// Whether --max-error or --max-time was given.
static inline bool cli_has_study(const struct cli *cli) {
    return cli->options.measure.max_error || cli->options.measure.max_time_ms > 0;
}
// Reads --max-error METRIC=X into `options`, and the rest of what the command line says about studies. false:
// a mistake is in cli->sink.
bool cli_study_options(struct cli *cli, struct tradeoff_options *options);
// Studies the camera that the command line names, on its device. The caller finishes `study` in any case, and
// *gpu, which is NULL before. Returns an exit code, errors printed.
int cli_study(struct cli *cli, struct session *session, const struct tradeoff_options *options,
              struct gpu **gpu, struct tradeoff *study);
// render: studies the scene, and adds the chosen settings to the command line's --set options. CLI_SCENE with
// an error printed if nothing fits. `levels`: steps of the format that is written, between black and white;
// 0: its values are not rounded. *gpu, NULL before, becomes the device if it was opened; it is the caller's.
int cli_choose_settings(struct cli *cli, double levels, struct asset_store *store, struct gpu **gpu);

#endif
