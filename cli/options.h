// The options of all commands: their values, and the one table that lists them. A row is an option: its name,
// kind, field, range, the commands that take it, one sentence. The parser, --help, man pages, completions and
// "did you mean" walk it.
//
// Errors: false, with the mistake in cli->sink. Ownership: texts are those of argv. Thread safety: as cli.h.
#ifndef GLINT_CLI_OPTIONS_H
#define GLINT_CLI_OPTIONS_H

#include "core/limits.h"
#include "core/strbuf.h"
#include "diag/diag_policy.h"
#include "picture/formats/formats.h"
#include "picture/metrics/compare_report.h"

struct cli;
struct cli_command;

// What --untrusted allows.
#define CLI_UNTRUSTED_SECONDS   600
#define CLI_UNTRUSTED_MEGABYTES 4096

// ---- the values. If an option is not given, numbers are 0 and texts NULL, unless a comment says otherwise;
// cli_option_place tells where it was given.

enum cli_color {
    CLI_COLOR_AUTO,
    CLI_COLOR_ALWAYS,
    CLI_COLOR_NEVER,
};

enum cli_ir {
    CLI_IR_NONE,
    CLI_IR_WRITTEN,
    CLI_IR_EVALUATED,
};

enum cli_stats {
    CLI_STATS_NONE,
    CLI_STATS_TEXT,
    CLI_STATS_JSON,
};

enum cli_space {
    CLI_SPACE_AUTO,
    CLI_SPACE_DISPLAYED,
    CLI_SPACE_LINEAR,
};

// A picture that render is to write.
struct cli_output {
    const char *path; // "-": standard output
    enum image_format format;
    bool is_part; // a file of parts (render/parts), without such a format
    int arg;      // its place on the command line; 0: it was not given
};

struct cli_outputs {
    struct cli_output *items;
    uint32_t count, capacity;
};

struct cli_list {
    str *items;
    uint32_t count, capacity;
};

// PATH=A:B:N or PATH=V,V,...
struct cli_batch_sweep {
    str path;
    struct {
        str *items;
        uint32_t count;
    } values;
    int arg;
};

// Of many pictures from one process (cli/commands/batch).
struct cli_batch {
    bool has_frames;
    bool all_frames; // of the animation: batch_take_all finds them, for one scene
    int32_t first_frame, last_frame, frame_step;
    double fps;
    struct {
        struct cli_batch_sweep *items;
        uint32_t count, capacity;
    } sweeps;
    const char *list;
    bool montage, stops; // stops: --keep-going=no
    bool skip_done;
};

// For a part of a picture, or all of it in bands.
struct cli_part {
    uint32_t region[4];               // x, y, width, height; width 0: not given
    uint32_t tile, tiles;             // from 1
    int32_t samples_from, samples_to; // samples_to 0: to the last
    bool has_samples;                 // either was given
    bool resume, partial;
    bool spreads;      // over several devices
    int32_t band_rows; // 0: as many as take about a second
};

struct cli_farm {
    int32_t tiles, chunk, gpus;
    const char *folder, *sshlogin, *image;
    bool packs;
};

struct cli_test {
    const char *bounds, *only, *html, *junit;
    bool blesses;
};

// For compare and tradeoff, and for render where it chooses settings by them.
struct cli_measure {
    struct measure_bounds bounds;
    bool has_threshold;
    double threshold;
    double pixels_per_degree;
    enum cli_space space;
    struct image_display display; // how linear values are shown
    bool has_display;             // it was given
    const char *heatmap;
    bool heatmap_flip;
    const char *max_error; // METRIC=X as written
    double max_time_ms;
    double budget_s;
    bool allow_resolution;
    uint32_t scale_width,
        scale_height; // size to scale a chosen smaller picture up to; 0: it is not scaled
    double time_s;    // from the program's start to the picture's file
    double noise;     // standard error at which pixels end
};

struct cli_options {
    bool help, version, quiet, verbose;
    const char *output;         // the last that was given
    struct cli_outputs outputs; // all of them, in their order
    int32_t width, height, samples, repeat;
    int32_t depth, quality; // of pictures
    int compression;        // enum image_compression
    uint32_t aovs;          // bits of enum aov
    int32_t sample;         // of a pixel, from 0
    str camera;
    const char *device, *format, *thresholds, *axes, *alternative, *schema, *config;
    const char *as;   // of standard input: "yaml" or "xml"
    const char *base; // folder of standard input
    enum cli_color color;
    struct cli_list sets, asset_paths;
    int32_t frame;              // of --frame, which is among the sets too
    struct cli_list severities; // the codes whose severity was given
    struct limits limits;
    bool limit_help;
    struct diag_policy policy; // what a check reports, over the folder's configuration
    struct cli_measure measure;
    struct cli_part part;
    struct cli_batch batch;
    struct cli_farm farm;
    struct cli_test test;
    enum cli_stats stats;
    bool count_rays;
    bool as_file, no_cache; // of the reference
    bool skip_pixels;       // of images, when checking
    bool audit, has_max_off;
    double max_off;            // share of pixels
    bool check, diff, upgrade; // of what changes files
    bool expanded, list, watch;
    int ir;     // cli_ir
    bool force; // overwrite
    bool trust_record;
    unsigned untrusted_seconds, untrusted_megabytes;
    bool changed;
    const char *baseline, *write_baseline;
    int fix; // enum fix_level
};

// ---- the table

enum option_kind {
    OPTION_AGAIN,   // the option above that has this name, in other words for other commands
    OPTION_FLAG,    // bool
    OPTION_TEXT,    // const char * or str: as it is written
    OPTION_READ,    // const char *: a file that is read
    OPTION_WRITTEN, // const char *: a file that is written
    OPTION_FOLDER,  // const char *, or struct cli_list, to which each adds: a folder that can be read
    OPTION_LIST,    // struct cli_list: each adds to it
    OPTION_WHOLE,   // int32_t, from `least` to `most`
    OPTION_NUMBER,  // double, from `least` to `most`
    OPTION_WORD,    // int or bool: the value of one of `words`
    OPTION_CHOICE,  // const char *: one of `words`
    OPTION_SYNTAX,  // parsed by `read`
};

struct option_word {
    const char *word; // NULL ends a list; "" is an option without a value
    int value;
};

struct option_row {
    const char *name;
    char letter;          // 0: none
    const char *argument; // NULL: none; "[=X]": optional; "a|b": one of these; "X ...": each further one adds
    const char *commands; // separated by spaces; "*": all, "-": the program itself too
    const char *doc;
    enum option_kind kind;
    uint32_t offset, size; // of the field in struct cli_options
    uint32_t given;        // offset of a bool that is set as well; 0: there is none
    double least, most;
    int32_t otherwise; // OPTION_WHOLE: the value of "[=N]" without N
    const struct option_word *words;
    bool (*read)(struct cli *cli, int arg, const struct option_row *row, const char *value);
    const char *needs, *excludes; // an option without which, or with which, this one has no effect
    const char *why;              // words that say so; NULL: there is no such option
};

extern const struct option_row option_rows[];
extern const int option_row_count;

// What `read` may be. value NULL: there is none.
bool cli_read_output(struct cli *cli, int arg, const struct option_row *row, const char *value);
bool cli_read_size(struct cli *cli, int arg, const struct option_row *row, const char *value);
bool cli_read_aovs(struct cli *cli, int arg, const struct option_row *row, const char *value);
bool cli_read_limit(struct cli *cli, int arg, const struct option_row *row, const char *value);
bool cli_read_max_messages(struct cli *cli, int arg, const struct option_row *row, const char *value);
bool cli_read_untrusted(struct cli *cli, int arg, const struct option_row *row, const char *value);
bool cli_read_heatmap(struct cli *cli, int arg, const struct option_row *row, const char *value);
bool cli_read_region(struct cli *cli, int arg, const struct option_row *row, const char *value);
bool cli_read_tile(struct cli *cli, int arg, const struct option_row *row, const char *value);
bool cli_read_frames(struct cli *cli, int arg, const struct option_row *row, const char *value);
bool cli_read_frame(struct cli *cli, int arg, const struct option_row *row, const char *value);
bool cli_read_sweep(struct cli *cli, int arg, const struct option_row *row, const char *value);
bool cli_read_severity(struct cli *cli, int arg, const struct option_row *row, const char *value);
bool cli_read_ignore(struct cli *cli, int arg, const struct option_row *row, const char *value);
bool cli_read_only(struct cli *cli, int arg, const struct option_row *row, const char *value);
bool cli_read_fail_on(struct cli *cli, int arg, const struct option_row *row, const char *value);

// Reports that a value is not a whole number in its range; false.
bool cli_bad_count(struct cli *cli, int arg, const char *name, const char *text, uint64_t least,
                   uint64_t most);

// The row after `row` of a command (NULL: of the program), in the order of --help; begins and ends with NULL.
const struct option_row *cli_next_option(const struct cli_command *command, const struct option_row *row);
// Whether its value may be left out: "[=X]".
bool cli_option_is_optional(const struct option_row *row);
// The options of a command (NULL: of the program), one line each.
void cli_option_help(struct strbuf *out, const struct cli_command *command);

// Reads argv into cli->options and cli->operands. `command` NULL: the program's own options only.
bool cli_parse_options(struct cli *cli, const struct cli_command *command, int first);
// Whether the given options go together, as far as rows say.
bool cli_judge_options(struct cli *cli);
// ---- fill_sets.c: expressions in braces in the values of --set

// Replaces them in one option by their values in a frame; fps: 0: 25. false: reported.
bool cli_fill_set(struct cli *cli, str *set, int32_t frame, double fps, bool *filled);
// In all of them, in the frame of --frame; without it, in frame 0.
bool cli_fill_sets(struct cli *cli);

// Reads the settings that --config names, and lays the other options over them. false: a mistake in the file
// went to cli->sink.
bool cli_take_config(struct cli *cli);
// What --format asks for: its index in `kinds`, which NULL ends; the first if it was not given. false: it is
// not one of them.
bool cli_format(struct cli *cli, const char *const *kinds, int *kind);

// Whether a command takes an option.
bool cli_has_option(const struct cli_command *command, const char *name);
// The argument that gave an option last; 0: it was not given.
int cli_option_place(const struct cli *cli, const char *name);
// For an option that has no effect because of others: true, with a mistake in cli->sink, if it was given.
bool cli_has_no_effect(struct cli *cli, const char *name, const char *why);

struct cli_no_effect {
    const char *option, *why; // why NULL: that of the row before
};
// The same for several; a row without a name ends the list.
bool cli_have_no_effect(struct cli *cli, const struct cli_no_effect *rows);

#endif
