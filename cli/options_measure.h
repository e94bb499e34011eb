// The options of compare and tradeoff, and those of render that choose settings by them.
//
// Thread safety: as cli.h.
#ifndef GLINT_CLI_OPTIONS_MEASURE_H
#define GLINT_CLI_OPTIONS_MEASURE_H

#include "picture/metrics/compare_report.h"

enum cli_measure_option {
    CLI_MEASURE_BOUND, // and enum metric after it
    CLI_MEASURE_NOT_FINITE = CLI_MEASURE_BOUND + METRIC_COUNT,
    CLI_MEASURE_THRESHOLD,
    CLI_MEASURE_PPD,
    CLI_MEASURE_SPACE,
    CLI_MEASURE_TONE,
    CLI_MEASURE_TRANSFER,
    CLI_MEASURE_HEATMAP,
    CLI_MEASURE_HEATMAP_OF,
    CLI_MEASURE_MAX_ERROR,
    CLI_MEASURE_MAX_TIME,
    CLI_MEASURE_BUDGET,
    CLI_MEASURE_TIME,
    CLI_MEASURE_NOISE,
    CLI_MEASURE_MAX_OFF,
};

enum cli_space {
    CLI_SPACE_AUTO,
    CLI_SPACE_DISPLAYED,
    CLI_SPACE_LINEAR,
};

struct cli_measure {
    struct measure_bounds bounds;
    bool has_threshold;
    double threshold;
    double pixels_per_degree; // 0: not given
    enum cli_space space;
    int space_arg;
    struct image_display display; // how linear values are shown
    bool has_display;             // it was given
    const char *heatmap;          // NULL: none
    bool heatmap_flip;
    const char *max_error; // METRIC=X as written; NULL: not given
    int max_error_arg;
    double max_time_ms; // 0: not given
    double budget_s;    // 0: not given
    bool allow_resolution;
    int allow_resolution_arg;
    uint32_t scale_width,
        scale_height; // to which a smaller picture that was chosen is scaled up; 0: it is not
    double time_s;    // from the program's start to the picture's file; 0: not given
    int time_arg;
    double noise; // standard error at which pixels end; 0: not given
    int noise_arg;
};

struct cli;
// Takes one of them. false: the value is wrong, and the mistake is in cli->sink.
bool cli_measure_apply(struct cli *cli, int arg, enum cli_measure_option option, const char *name,
                       const char *value);

#endif
