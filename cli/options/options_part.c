// --region, --tile, --samples-from and --samples-to; --bands, --resume and --partial.
#include "cli/cli.h"

#include <stdlib.h>
#include <string.h>

enum {
    SIDE_MOST = 16384,
    TILES_MOST = 100000,
    SAMPLES_MOST = 4096,
};

// Whole numbers with `mark` between them, and nothing else.
static bool read_numbers(const char *text, char mark, uint32_t most, uint32_t *out, int count) {
    for (int i = 0; i < count; i++) {
        char *end;
        if (*text < '0' || *text > '9')
            return false;
        const unsigned long value = strtoul(text, &end, 10);
        if (value > most || *end != (i + 1 < count ? mark : '\0'))
            return false;
        out[i] = (uint32_t)value;
        text = end + 1;
    }
    return true;
}

static bool read_region(struct cli *cli, int arg, const char *value) {
    struct cli_part *part = &cli->options.part;
    part->region_arg = arg;
    if (read_numbers(value, ',', SIDE_MOST, part->region, 4) && part->region[2] && part->region[3])
        return true;
    cli_usage(cli, arg, "--region takes X,Y,W,H in pixels, such as 320,200,64,48, not '%s'", value);
    return false;
}

static bool read_tile(struct cli *cli, int arg, const char *value) {
    struct cli_part *part = &cli->options.part;
    uint32_t numbers[2];
    part->tile_arg = arg;
    if (read_numbers(value, '/', TILES_MOST, numbers, 2) && numbers[0] >= 1 && numbers[0] <= numbers[1]) {
        part->tile = numbers[0];
        part->tiles = numbers[1];
        return true;
    }
    cli_usage(cli, arg, "--tile takes I/N, part I of N from 1 to N, such as 3/16, not '%s'", value);
    return false;
}

static bool read_rows(struct cli *cli, int arg, const char *value) {
    struct cli_part *part = &cli->options.part;
    part->bands_arg = arg;
    return !value || cli_read_count(cli, arg, "bands", value, 1, SIDE_MOST, &part->band_rows);
}

bool cli_part_apply(struct cli *cli, int arg, enum cli_part_option option, const char *value) {
    struct cli_part *part = &cli->options.part;
    if (option == CLI_PART_REGION)
        return read_region(cli, arg, value);
    if (option == CLI_PART_TILE)
        return read_tile(cli, arg, value);
    if (option == CLI_PART_BANDS)
        return read_rows(cli, arg, value);
    if (option == CLI_PART_RESUME || option == CLI_PART_PARTIAL) {
        *(option == CLI_PART_RESUME ? &part->resume_arg : &part->partial_arg) = arg;
        return true;
    }
    part->samples_arg = arg;
    if (option == CLI_PART_SAMPLES_FROM)
        return cli_read_count(cli, arg, "samples-from", value, 0, SAMPLES_MOST - 1, &part->samples_from);
    return cli_read_count(cli, arg, "samples-to", value, 1, SAMPLES_MOST, &part->samples_to);
}
