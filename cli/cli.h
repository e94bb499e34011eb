// What the subcommands share: the command line as a source (so that its mistakes have carets too), the
// parsed options, exit codes, and where diagnostics go (standard error).
#ifndef GLINT_CLI_CLI_H
#define GLINT_CLI_CLI_H

#include "cli/options/options_batch.h"
#include "cli/options/options_farm.h"
#include "cli/options/options_part.h"
#include "cli/options/options_test.h"
#include "cli/options/words.h"
#include "cli/options_measure.h"
#include "core/limits.h"
#include "core/strbuf.h"
#include "diag/diag.h"
#include "diag/diag_policy.h"
#include "load/session.h"
#include "picture/formats/formats.h"
#include "picture/write/image.h"

enum cli_exit {
    CLI_OK = 0,
    CLI_SCENE = 1, // errors in the scene or in a file that it names
    CLI_USAGE = 2,
    CLI_FILE = 3,     // the scene file cannot be read, an output cannot be written, or memory ran out
    CLI_DEVICE = 4,   // no usable device
    CLI_REFUSED = 5,  // what a file named is outside its folder, or --untrusted does not allow what is needed
    CLI_STOPPED = 75, // by a signal, and a checkpoint is there to go on from (EX_TEMPFAIL of sysexits.h)
    CLI_INTERRUPTED = 130,
    CLI_PIPE = 141, // who read standard output has closed it, as if by SIGPIPE
    CLI_TERMINATED = 143,
};

enum cli_color {
    CLI_COLOR_AUTO,
    CLI_COLOR_ALWAYS,
    CLI_COLOR_NEVER,
};

enum cli_stats {
    CLI_STATS_NONE,
    CLI_STATS_TEXT,
    CLI_STATS_JSON,
};

// A picture that render is to write.
struct cli_output {
    const char *path; // "-": standard output
    enum image_format format;
    bool is_part; // a file of parts (render/parts), of no such format
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

struct cli_options {
    const char *output;                     // the last that was given; NULL: none
    struct cli_outputs outputs;             // all of them, in their order
    int32_t width, height, samples, repeat; // 0: not given
    int32_t depth, quality;                 // of pictures; 0: not given
    int compression;                        // enum image_compression
    uint32_t aovs;                          // bits of enum aov
    int aov_arg;
    int32_t sample; // of a pixel, from 0
    int sample_arg;
    str camera;
    const char *device;     // NULL: not given
    const char *format;     // NULL: not given
    const char *thresholds; // NULL: not given
    const char *axes;       // NULL: not given
    int axes_arg;
    const char *alternative; // NULL: not given
    int alternative_arg;
    const char *schema; // NULL: not given
    const char *as;     // of standard input: "yaml" or "xml"; NULL: not given
    const char *base;   // folder of standard input; NULL: not given
    enum cli_color color;
    const char *config; // NULL: not given
    int format_arg;
    struct cli_list sets, asset_paths;
    struct cli_list severities; // the codes whose severity was given
    struct limits limits;
    struct diag_policy policy; // what a check reports, over the folder's configuration
    struct cli_measure measure;
    struct cli_part part;
    struct cli_batch batch;
    struct cli_farm farm;
    struct cli_test test;
    enum cli_stats stats;
    bool quiet, verbose, ir, help, limit_help, version;
    bool as_file, no_cache; // of the reference
    bool skip_pixels;       // of images, when checking
    bool audit, has_max_off;
    double max_off;            // share of pixels
    int audit_arg;             // the place of either
    bool check, diff, upgrade; // of what changes files
    bool list;
    bool watch;
    bool force; // overwrite
    bool trust_record;
    unsigned untrusted_seconds, untrusted_megabytes; // 0 seconds: not given
    bool changed;
    int changed_arg;            // as output_arg
    const char *baseline;       // NULL: not given
    const char *write_baseline; // NULL: not given
    int write_baseline_arg;
    int fix; // enum fix_level
    int fix_arg;
    int output_arg;  // its place on the command line; 0: not given
    int as_file_arg; // as output_arg
};

// Standard input that an operand '-' names.
struct cli_stream {
    str path; // as shown: what it would have as a file; empty: no operand names it
    struct file_overlay overlay;
};

struct cli {
    int argc;
    char **argv;
    const struct cli_command *commands; // a row without a name at the end
    struct arena arena;
    struct source_set sources; // [1] is the command line
    struct diag_sink sink;     // of the command line itself
    uint32_t *arg_begin;       // byte offset of each argument in the command line's text
    double begun;              // clock: when the program started
    bool color;                // standard error accepts colours
    bool stuck;                // a device may still be at work
    struct cli_options options;
    int *option_places; // by row of the table: the argument that gave it last; 0: not given
    char **operands;    // what is left after the options
    int operand_count;
    struct cli_stream stream;
    const struct cli_command *command; // that runs
    struct cli_list fixed;             // files whose fixes were shown
    str named_in; // the folder of a file that names what is read: nothing outside is; empty: there is none
    bool names_scene;           // it names the scene, too
    uint32_t named_asset_paths; // how many of the last of options.asset_paths it names
};

struct cli_command {
    const char *name;
    const char *operands; // for the usage line: "SCENE"
    const char *summary;
    const char *details;               // paragraphs and examples for --help
    int least_operands, most_operands; // most: -1 means any number
    int (*run)(struct cli *cli);
};

// Reads argv into cli->options and cli->operands; mistakes go to cli->sink. `command` NULL: the program's
// own options only.
bool cli_parse_options(struct cli *cli, const struct cli_command *command, int first);
// What --format asks for: its index in `kinds`, which NULL ends; the first if it was not given. false: it is
// not one of them, and the mistake is in cli->sink.
bool cli_format(struct cli *cli, const char *const *kinds, int *kind);
enum cli_policy_option {
    CLI_POLICY_SEVERITY,
    CLI_POLICY_IGNORE,
    CLI_POLICY_ONLY,
    CLI_POLICY_FAIL_ON,
};
// One of these options; false: a mistake went to cli->sink.
bool cli_policy_apply(struct cli *cli, int arg, enum cli_policy_option option, const char *value);
// Reads the settings that --config names, and lays the other options over them. false: a mistake in the file
// went to cli->sink.
bool cli_take_config(struct cli *cli);
// Values of options; false: a mistake went to cli->sink.
bool cli_read_count(struct cli *cli, int arg, const char *name, const char *text, int64_t least, int64_t most,
                    int32_t *out);
bool cli_read_aovs(struct cli *cli, int arg, const char *text);
bool cli_read_depth(struct cli *cli, int arg, const char *text);
bool cli_read_compression(struct cli *cli, int arg, const char *text);
bool cli_read_size(struct cli *cli, int arg, const char *text);
bool cli_read_limit(struct cli *cli, int arg, const char *text);
bool cli_read_max_messages(struct cli *cli, int arg, const char *text);
bool cli_read_folder(struct cli *cli, int arg, const char *name, const char *text);
// "60,2048": seconds and megabytes; NULL: the defaults.
bool cli_read_untrusted(struct cli *cli, int arg, const char *text);
// The index of `text` among `words`, which NULL ends; -1: it is not one of them, and the mistake is in
// cli->sink.
int cli_read_word(struct cli *cli, int arg, const char *name, const char *text, const char *const *words);
// The options of a command (NULL: of the program), one line each.
void cli_option_help(struct strbuf *out, const struct cli_command *command);
// An option as --help shows it.
struct cli_option_text {
    const char *name;
    const char *argument; // NULL: none; "[=X]": optional; "a|b": one of these words
    const char *doc;
    char letter; // 0: none
};
// The option of a command (NULL: of the program) at number `at` or the next one; returns the number after it,
// 0 if there is none.
int cli_next_option(const struct cli_command *command, int at, struct cli_option_text *option);

// Whether a command takes an option.
bool cli_has_option(const struct cli_command *command, const char *name);
// The argument that gives an option; 0: it is not given.
int cli_option_place(const struct cli *cli, const char *name);
// For an option that goes together with another one, or does not: true, with a mistake in cli->sink, if it
// was given all the same.
bool cli_has_no_effect(struct cli *cli, const char *name, const char *why);

// Reads standard input if an operand of the command names it as a scene; the operand becomes its path, which
// cli_session_options knows. CLI_OK, or an exit code with the mistake reported.
int cli_take_stream(struct cli *cli, const struct cli_command *command);
bool cli_is_stream(const struct cli *cli, const char *path);
// Its name in messages.
str cli_stream_name(struct cli *cli);
// All of it; CLI_OK, or CLI_FILE with an error printed.
int cli_read_stream(struct cli *cli, struct strbuf *text);

// Whether text for this descriptor has colours: --color, then NO_COLOR, then CLICOLOR_FORCE, then a terminal.
bool cli_has_color(const struct cli *cli, int fd);

// The place of an argument on the command line.
span cli_place(const struct cli *cli, int arg);
// The argument that is operand number `index`, from 0.
int cli_operand_place(const struct cli *cli, int index);
// Reports one error of the command line and returns CLI_USAGE.
int cli_usage(struct cli *cli, int arg, const char *format, ...) __attribute__((format(printf, 3, 4)));
// Prints diagnostics of the command line and of files in cli->sources.
void cli_print_sink(struct cli *cli, const struct diag_sink *sink);
// Prints a session's diagnostics, notes too unless `quiet`; returns their exit code.
int cli_report(struct cli *cli, struct session *session, bool notes);
// Only the exit code.
int cli_session_status(const struct session *session);
// How many findings that are alike are shown (diag/diag_text.h): who names a number of messages gets as many.
uint32_t cli_text_alike(const struct limits *limits);
// Text for people, to standard error.
void cli_write_error(str text);
// One error with the place 1:1 of `path`, printed at once.
void cli_error(struct cli *cli, enum diag_code code, const char *path, const char *help, const char *format,
               ...) __attribute__((format(printf, 5, 6)));
// Reports that a signal ended the work (progress.h); returns its exit code.
int cli_interrupted(struct cli *cli);
// Whether a scene's file can be opened: CLI_OK, or CLI_FILE with an error printed. For who opens a device or
// a window first.
int cli_try_scene(struct cli *cli, const char *path);
struct session_options cli_session_options(const struct cli *cli, const char *path);
// Where render writes without -o: the scene's name without its endings, in the current folder:
// showcase.glint.yaml becomes showcase.png. In cli->arena.
const char *cli_default_picture(struct cli *cli, const char *scene);
// Writes `text` to standard output; CLI_OK or CLI_FILE with an error printed.
int cli_print(struct cli *cli, str text);
// Writes a whole file (or "-"); CLI_OK or CLI_FILE with an error printed.
int cli_write(struct cli *cli, const char *path, str bytes);
// Whether an output whose name is the scene's, and that the user has not named, stays below the current
// folder: a link of a stranger may lead anywhere. CLI_REFUSED with an error printed if it does not.
int cli_judge_default(struct cli *cli, const char *path);
// Reports that, and returns its exit code: CLI_FILE, or CLI_PIPE for a standard output that nobody reads.
int cli_not_written(struct cli *cli, const char *path, int error);
// The same as cli_write for what was made in memory, called `what` in messages: if memory ran out, CLI_FILE
// with an error printed.
int cli_write_made(struct cli *cli, const char *path, const struct strbuf *made, const char *what);
// The same for a file that something other than the user has named: below a root (files.h). CLI_REFUSED
// otherwise.
int cli_write_named(struct cli *cli, struct files *files, str path, str bytes);
// Whether the output can be made at all, which is better known before long work than after it: CLI_OK, or
// CLI_FILE with an error printed. NULL: there is none.
int cli_try_output(struct cli *cli, const char *path);

#endif
