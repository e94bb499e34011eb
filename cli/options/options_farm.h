// The options of glint farm (cli/commands/farm).
//
// Thread safety: as cli.h.
#ifndef GLINT_CLI_OPTIONS_OPTIONS_FARM_H
#define GLINT_CLI_OPTIONS_OPTIONS_FARM_H

#include <stdbool.h>
#include <stdint.h>

enum cli_farm_option {
    CLI_FARM_TILES,
    CLI_FARM_CHUNK,
    CLI_FARM_GPUS,
    CLI_FARM_FOLDER,
    CLI_FARM_PACK,
    CLI_FARM_SSHLOGIN,
    CLI_FARM_IMAGE,
};

struct cli_farm {
    int32_t tiles, chunk, gpus; // 0: not given
    const char *folder, *sshlogin, *image;
    bool packs;
};

struct cli;
// Takes one of them. false: the value is wrong, and the mistake is in cli->sink.
bool cli_farm_apply(struct cli *cli, int arg, enum cli_farm_option option, const char *value);

#endif
