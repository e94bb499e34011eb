// glint check SCENE...: every mistake of every file, in the order of the command line.
#include "cli/cli.h"

static int check_one(struct cli *cli, struct asset_store *store, const char *path) {
    struct session session;
    struct session_options options = cli_session_options(cli, path);
    options.skip_pixels = true;
    session_load(&session, &options, store);
    // The notes about what stands in for a camera or a light that is not written.
    struct view view;
    if (cli->options.verbose && session.state == SESSION_LOADED && session.sink.errors == 0)
        session_view(&session, 0, &view);
    int status = cli_report(cli, &session, cli->options.verbose);
    session_finish(&session);
    return status;
}

int cmd_check(struct cli *cli) {
    int worst = CLI_OK;
    struct asset_store *store = asset_store_create();
    for (int i = 0; i < cli->operand_count; i++) {
        int status = check_one(cli, store, cli->operands[i]);
        worst = status > worst ? status : worst;
    }
    asset_store_destroy(store);
    return worst;
}
