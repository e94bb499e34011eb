// In place of commands that a build leaves out: a module of WebAssembly those that a page has no use for, a
// build without devices those that measure them.
#include "cli/commands/commands.h"
#include "cli/commands/study.h"
#include "cli/device.h"

#ifdef __EMSCRIPTEN__
static int refuse(struct cli *cli, const char *what, const char *help) {
    const int status = cli_usage(cli, 1, "a module of WebAssembly %s", what);
    diag_help(&cli->sink, "%s", help);
    return status;
}

int cmd_batch(struct cli *cli) {
    return refuse(cli, "renders one picture, and no films",
                  "'glint render' of the installed glint renders many: docs/films.md");
}

int cmd_farm(struct cli *cli) {
    return refuse(cli, "does not write scripts for other machines",
                  "'glint farm' of the installed glint does: docs/install.md");
}

int cmd_manual(struct cli *cli) {
    return refuse(cli, "has no pages and completions to install",
                  "'glint manual' of the installed glint does: docs/install.md");
}

int cmd_merge(struct cli *cli) {
    return refuse(cli, "does not join parts of pictures",
                  "'glint merge' of the installed glint does: docs/install.md");
}

int cmd_test(struct cli *cli) {
    return refuse(cli, "does not test folders of pictures",
                  "'glint test' of the installed glint does: docs/install.md");
}

int cmd_verify(struct cli *cli) {
    return refuse(cli, "does not render pictures again",
                  "'glint verify' of the installed glint does: docs/install.md");
}
#endif

#if !GLINT_DEVICE
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
#endif
