// What the subcommands share: the command line as a source (so that its mistakes have carets too), the
// parsed options, exit codes, and where diagnostics go (standard error).
#ifndef GLINT_CLI_CLI_H
#define GLINT_CLI_CLI_H

#include "cli/options.h"
#include "cli/words.h"
#include "core/nearest.h"
#include "diag/diag.h"
#include "load/session.h"
#include "picture/write/image.h"

enum cli_exit {
    CLI_OK = 0,
    CLI_SCENE = 1, // errors in the scene or in a file that it names
    CLI_USAGE = 2,
    CLI_FILE = 3,     // the scene file cannot be read, an output cannot be written, or memory ran out
    CLI_DEVICE = 4,   // no usable device
    CLI_REFUSED = 5,  // a file names something outside its folder, or --untrusted forbids what is needed
    CLI_STOPPED = 75, // by a signal, with a checkpoint to go on from (EX_TEMPFAIL of sysexits.h)
    CLI_INTERRUPTED = 130,
    CLI_PIPE = 141, // the reader of standard output has closed it, as if by SIGPIPE
    CLI_TERMINATED = 143,
};

// Standard input, named by an operand '-'.
struct cli_stream {
    str path; // as shown: the path that it would have as a file; empty: no operand names it
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
    str named_in; // the folder of a file that names what is read: nothing outside it is read; empty: there is
                  // none
    bool names_scene;           // that file also names the scene
    uint32_t named_asset_paths; // number of paths at the end of options.asset_paths that it names
    struct cli_made *made;      // names of outputs that were judged (made.h); NULL: none yet
};

struct cli_command {
    const char *name;
    const char *operands; // for the usage line: "SCENE"
    const char *summary;
    const char *details;               // paragraphs and examples for --help
    int least_operands, most_operands; // most: -1 means any number
    int (*run)(struct cli *cli);       // NULL: this build has no such command
};

// Reads standard input if an operand of the command names it as a scene; the operand becomes its path, which
// cli_session_options knows. CLI_OK, or an exit code with the mistake reported.
int cli_take_stream(struct cli *cli, const struct cli_command *command);
bool cli_is_stream(const struct cli *cli, const char *path);
// The stream's name in messages.
str cli_stream_name(struct cli *cli);
// Reads all of it; CLI_OK, or CLI_FILE with an error printed.
int cli_read_stream(struct cli *cli, struct strbuf *text);

// Whether text for this descriptor has colours: --color, then NO_COLOR, then CLICOLOR_FORCE, then a terminal.
bool cli_has_color(const struct cli *cli, int fd);

// The place of an argument on the command line.
span cli_place(const struct cli *cli, int arg);
// The argument that is operand number `index`, from 0.
int cli_operand_place(const struct cli *cli, int index);
// Reports one error of the command line and returns CLI_USAGE.
int cli_usage(struct cli *cli, int arg, const char *format, ...) __attribute__((format(printf, 3, 4)));
// Adds to that error the name that may be meant or else, unless it is NULL, other help.
void cli_did_you_mean(struct cli *cli, const struct nearest *search, const char *otherwise);
// Prints diagnostics of the command line and of files in cli->sources.
void cli_print_sink(struct cli *cli, const struct diag_sink *sink);
// Prints a session's diagnostics, notes too unless `quiet`; returns their exit code.
int cli_report(struct cli *cli, struct session *session, bool notes);
// Only the exit code.
int cli_session_status(const struct session *session);
// How many similar findings are shown (diag/diag_text.h); a number of messages that the user names is
// respected.
uint32_t cli_text_alike(const struct limits *limits);
// Text for people, to standard error.
void cli_write_error(str text);
// One error with the place 1:1 of `path`, printed at once.
void cli_error(struct cli *cli, diag_code code, const char *path, const char *help, const char *format, ...)
    __attribute__((format(printf, 5, 6)));
// Reports that a signal ended the work (progress.h); returns its exit code.
int cli_interrupted(struct cli *cli);
// Whether a scene's file can be opened: CLI_OK, or CLI_FILE with an error printed. For commands that open a
// device or a window first.
int cli_try_scene(struct cli *cli, const char *path);
struct session_options cli_session_options(const struct cli *cli, const char *path);
// Where render writes without -o: the scene's name without its endings, in the current folder:
// showcase.glint.yaml becomes showcase.png. In cli->arena.
const char *cli_default_picture(struct cli *cli, const char *scene);
// Writes `text` to standard output; CLI_OK or CLI_FILE with an error printed.
int cli_print(struct cli *cli, str text);
// Writes a whole file (or "-"); CLI_OK or CLI_FILE with an error printed.
int cli_write(struct cli *cli, const char *path, str bytes);
// Reports a failed write, and returns its exit code: CLI_FILE, or CLI_PIPE for a standard output that nobody
// reads.
int cli_not_written(struct cli *cli, const char *path, int error);
// The same as cli_write for what was made in memory, called `what` in messages: if memory ran out, CLI_FILE
// with an error printed.
int cli_write_made(struct cli *cli, const char *path, const struct strbuf *made, const char *what);
// The same for a file that something other than the user has named: below a root (files.h). CLI_REFUSED
// otherwise.
int cli_write_named(struct cli *cli, struct files *files, str path, str bytes);
// Whether the output can be written at all, to know before long work: CLI_OK, or CLI_FILE with an error
// printed. NULL: there is none.
int cli_try_output(struct cli *cli, const char *path);

#endif
