// In place of studies where the program is built without devices (GLINT_DEVICE=OFF), which all that measures
// needs: studies, and what the commands would do.
#include "cli/device.h"
#include "cli/study.h"

static int no_device(struct cli *cli) {
    struct gpu *gpu = NULL;
    const int status = cli_open_device(cli, &gpu);
    cli_close_device(cli, gpu);
    return status;
}

int cli_choose_settings(struct cli *cli, double levels, struct asset_store *store, struct gpu **gpu) {
    (void)levels;
    (void)store;
    (void)gpu;
    return no_device(cli);
}

int cmd_tradeoff(struct cli *cli) {
    return no_device(cli);
}

int cmd_extremes(struct cli *cli) {
    return no_device(cli);
}
