// The options of glint farm.
#include "cli/cli.h"

enum {
    TILES_MOST = 2048, // a picture has as many parts of 8 rows
    CHUNK_MOST = 1000000,
    GPUS_MOST = 64,
};

bool cli_farm_apply(struct cli *cli, int arg, enum cli_farm_option option, const char *value) {
    struct cli_farm *farm = &cli->options.farm;
    switch (option) {
    case CLI_FARM_TILES:
        return cli_read_count(cli, arg, "tiles", value, 1, TILES_MOST, &farm->tiles);
    case CLI_FARM_CHUNK:
        return cli_read_count(cli, arg, "chunk", value, 1, CHUNK_MOST, &farm->chunk);
    case CLI_FARM_GPUS:
        farm->gpus = 1;
        return !value || cli_read_count(cli, arg, "gpus", value, 1, GPUS_MOST, &farm->gpus);
    case CLI_FARM_FOLDER:
        farm->folder = value;
        return true;
    case CLI_FARM_PACK:
        return farm->packs = true;
    case CLI_FARM_SSHLOGIN:
        farm->sshlogin = value;
        return true;
    case CLI_FARM_IMAGE:
        farm->image = value;
        return true;
    }
    return false;
}
