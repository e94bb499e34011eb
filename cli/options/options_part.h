// The options of render that make a part of a picture, or all of it in bands.
//
// Thread safety: as cli.h.
#ifndef GLINT_CLI_OPTIONS_OPTIONS_PART_H
#define GLINT_CLI_OPTIONS_OPTIONS_PART_H

#include <stdbool.h>
#include <stdint.h>

enum cli_part_option {
    CLI_PART_REGION,
    CLI_PART_TILE,
    CLI_PART_SAMPLES_FROM,
    CLI_PART_SAMPLES_TO,
    CLI_PART_BANDS,
    CLI_PART_RESUME,
    CLI_PART_PARTIAL,
};

struct cli_part {
    int region_arg;     // its place on the command line; 0: not given
    uint32_t region[4]; // x, y, width, height
    int tile_arg;
    uint32_t tile, tiles; // from 1
    int samples_arg;
    int32_t samples_from, samples_to; // samples_to 0: to the last
    int bands_arg, resume_arg, partial_arg;
    bool spreads;      // over several devices
    int32_t band_rows; // 0: as many as take a few seconds
};

struct cli;
// Takes one of them. false: the value is wrong, and the mistake is in cli->sink.
bool cli_part_apply(struct cli *cli, int arg, enum cli_part_option option, const char *value);

#endif
