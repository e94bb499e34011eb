// The commands: each takes the command line as main.c has read it, and returns an exit status (enum
// cli_exit).
//
// Thread safety: as cli.h.
#ifndef GLINT_CLI_COMMANDS_COMMANDS_H
#define GLINT_CLI_COMMANDS_COMMANDS_H

#include "cli/cli.h"

int cmd_render(struct cli *cli);
int cmd_view(struct cli *cli);
int cmd_watch(struct cli *cli); // render with --watch
int cmd_batch(struct cli *cli); // render of many pictures, or a film
// Whether the command line asks for that.
bool batch_is_wanted(const struct cli *cli);
int cmd_check(struct cli *cli);
int cmd_inspect(struct cli *cli);
int cmd_convert(struct cli *cli);
int cmd_import(struct cli *cli);
int cmd_format(struct cli *cli);
int cmd_diff(struct cli *cli);
int cmd_schema(struct cli *cli);
int cmd_explain(struct cli *cli);
int cmd_compare(struct cli *cli);
int cmd_merge(struct cli *cli);
int cmd_farm(struct cli *cli);
int cmd_tradeoff(struct cli *cli);
int cmd_verify(struct cli *cli);
int cmd_test(struct cli *cli);
int cmd_pick(struct cli *cli);
int cmd_extremes(struct cli *cli);
int cmd_deps(struct cli *cli);
int cmd_pack(struct cli *cli);
int cmd_lsp(struct cli *cli);
int cmd_manual(struct cli *cli);
int cmd_version(struct cli *cli); // --version

#endif
