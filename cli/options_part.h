// The options of render that make a part of a picture.
//
// Thread safety: as cli.h.
#ifndef GLINT_CLI_OPTIONS_PART_H
#define GLINT_CLI_OPTIONS_PART_H

#include <stdbool.h>
#include <stdint.h>

enum cli_part_option {
    CLI_PART_REGION,
    CLI_PART_TILE,
    CLI_PART_SAMPLES_FROM,
    CLI_PART_SAMPLES_TO,
};

// Their rows in the table of options; `first` is the number of the first one.
#define CLI_PART_ROWS(first)                                                                                 \
    {(first) + CLI_PART_REGION,                                                                              \
     "region",                                                                                               \
     0,                                                                                                      \
     "X,Y,W,H",                                                                                              \
     "render",                                                                                               \
     "only W x H pixels from X,Y on, which count from 0,0 at the top left: a picture of that size"},         \
        {(first) + CLI_PART_TILE,                                                                            \
         "tile",                                                                                             \
         0,                                                                                                  \
         "I/N",                                                                                              \
         "render",                                                                                           \
         "only part I of N, from 1: rows of pixels; 'glint merge' joins parts that -o NAME.part wrote"},     \
        {(first) + CLI_PART_SAMPLES_FROM,                                                                    \
         "samples-from",                                                                                     \
         0,                                                                                                  \
         "A",                                                                                                \
         "render",                                                                                           \
         "only samples from number A on, counted from 0, into -o NAME.part"},                                \
        {(first) + CLI_PART_SAMPLES_TO,                                                                      \
         "samples-to",                                                                                       \
         0,                                                                                                  \
         "B",                                                                                                \
         "render",                                                                                           \
         "only samples before number B, into -o NAME.part"},

struct cli_part {
    int region_arg;     // its place on the command line; 0: not given
    uint32_t region[4]; // x, y, width, height
    int tile_arg;
    uint32_t tile, tiles; // from 1
    int samples_arg;
    int32_t samples_from, samples_to; // samples_to 0: to the last
};

struct cli;
// Takes one of them. false: the value is wrong, and the mistake is in cli->sink.
bool cli_part_apply(struct cli *cli, int arg, enum cli_part_option option, const char *value);

#endif
