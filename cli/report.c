// Diagnostics on standard error, data on standard output, and the exit codes that follow.
#include "cli/cli.h"
#include "cli/made.h"

#include "cli/progress.h"
#include "diag/codes/binding.h"
#include "diag/codes/command.h"
#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "diag/codes/reference.h"
#include "diag/diag_text.h"
#include "files/output.h"

#include <errno.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool cli_is_stream(const struct cli *cli, const char *path) {
    return cli->stream.path.len && str_equal_cstr(cli->stream.path, path);
}

bool cli_has_color(const struct cli *cli, int fd) {
    const char *never = getenv("NO_COLOR");
    const char *always = getenv("CLICOLOR_FORCE");
    if (cli->options.color != CLI_COLOR_AUTO)
        return cli->options.color == CLI_COLOR_ALWAYS;
    if (never && never[0])
        return false;
    return (always && always[0] && strcmp(always, "0") != 0) || isatty(fd);
}

span cli_place(const struct cli *cli, int arg) {
    if (arg < 0 || arg >= cli->argc)
        return (span){1, 0, 0};
    uint32_t begin = cli->arg_begin[arg];
    return (span){1, begin, begin + (uint32_t)strlen(cli->argv[arg])};
}

int cli_operand_place(const struct cli *cli, int index) {
    for (int i = 0; i < cli->argc && index < cli->operand_count; i++)
        if (cli->argv[i] == cli->operands[index] ||
            (cli_is_stream(cli, cli->operands[index]) && strcmp(cli->argv[i], "-") == 0))
            return i;
    return cli->argc - 1;
}

int cli_usage(struct cli *cli, int arg, const char *format, ...) {
    va_list args;
    char fixed[1024];
    va_start(args, format);
    vsnprintf(fixed, sizeof fixed, format, args);
    va_end(args);
    diag_add(&cli->sink, DIAG_USAGE, cli_place(cli, arg), "%s", fixed);
    return CLI_USAGE;
}

void cli_did_you_mean(struct cli *cli, const struct nearest *search, const char *otherwise) {
    const str best = nearest_best(search);
    if (best.len)
        diag_help(&cli->sink, "did you mean '%.*s'?", STR_ARG(best));
    else if (otherwise)
        diag_help(&cli->sink, "%s", otherwise);
}

void cli_write_error(str text) {
    fwrite(text.ptr, 1, text.len, stderr);
}

uint32_t cli_text_alike(const struct limits *limits) {
    return limits->given >> LIMIT_MESSAGES & 1 ? 0 : DIAG_TEXT_ALIKE;
}

static void print(struct cli *cli, const struct diag_sink *sink, struct source_set *sources, bool notes) {
    struct strbuf text;
    strbuf_init(&text);
    struct diag_text_options options = {.color = cli->color,
                                        .notes = notes,
                                        .most = (uint32_t)cli->options.limits.value[LIMIT_MESSAGES],
                                        .alike = cli_text_alike(&cli->options.limits)};
    diag_text(&text, sink, sources, options);
    cli_write_error(strbuf_view(&text));
    strbuf_finish(&text);
}

void cli_print_sink(struct cli *cli, const struct diag_sink *sink) {
    print(cli, sink, &cli->sources, true);
}

static bool has_code(const struct diag_sink *sink, diag_code code) {
    for (uint32_t i = 0; i < sink->count; i++)
        if (sink->items[i].code == code)
            return true;
    return false;
}

int cli_session_status(const struct session *session) {
    if (session->options.named_in.len && has_code(&session->sink, DIAG_FILE_OUTSIDE) &&
        session->state == SESSION_UNREADABLE)
        return CLI_REFUSED;
    if (session->state == SESSION_UNREADABLE)
        return has_code(&session->sink, DIAG_USAGE) ? CLI_USAGE : CLI_FILE;
    if (session->config_failed)
        return CLI_USAGE;
    if (session->sink.errors == 0)
        return CLI_OK;
    return has_code(&session->sink, DIAG_UNKNOWN_CAMERA) || has_code(&session->sink, DIAG_SET_SYNTAX)
               ? CLI_USAGE
               : CLI_SCENE;
}

int cli_report(struct cli *cli, struct session *session, bool notes) {
    diag_sort(&session->sink);
    print(cli, &session->sink, &session->sources, notes);
    return cli_session_status(session);
}

void cli_error(struct cli *cli, diag_code code, const char *path, const char *help, const char *format, ...) {
    struct diag_sink sink;
    char fixed[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(fixed, sizeof fixed, format, args);
    va_end(args);
    diag_sink_init(&sink);
    uint32_t source = source_add(&cli->sources, SOURCE_KIND_FILE, str_from(path), STR(""));
    diag_add(&sink, code, (span){source, 0, 0}, "%s", fixed);
    if (help)
        diag_help(&sink, "%s", help);
    cli_print_sink(cli, &sink);
    diag_sink_finish(&sink);
}

int cli_try_scene(struct cli *cli, const char *path) {
    struct files files;
    str nothing;
    if (cli_is_stream(cli, path))
        return CLI_OK;
    files_init(&files, &cli->arena);
    const enum file_status status = files_read_given(&files, str_from(path), 0, &cli->arena, &nothing);
    if (status == FILE_OK || status == FILE_TOO_LARGE)
        return CLI_OK;
    cli_error(cli, session_file_code(status), path, NULL, "the scene file %s",
              file_status_text(&files, status));
    return CLI_FILE;
}

int cli_interrupted(struct cli *cli) {
    const int signal_number = interrupt_signal();
    cli_error(cli, DIAG_INTERRUPTED, cli->operands[0], NULL, "interrupted; nothing was written");
    if (cli->options.part.resume) // finished work stays, and the same command goes on
        return CLI_STOPPED;
    return signal_number == SIGTERM ? CLI_TERMINATED : CLI_INTERRUPTED;
}

// --time and the searches set the number of samples themselves: then all pixels have the same number.
static double error_of(const struct cli_options *options) {
    const struct cli_measure *m = &options->measure;
    return m->time_s > 0 || m->max_error || m->max_time_ms > 0 ? -1 : m->noise;
}

struct session_options cli_session_options(const struct cli *cli, const char *path) {
    const struct cli_options *o = &cli->options;
    return (struct session_options){.path = str_from(path),
                                    .overlays = &cli->stream.overlay,
                                    .overlay_count = cli_is_stream(cli, path),
                                    .asset_paths = o->asset_paths.items,
                                    .asset_path_count = o->asset_paths.count,
                                    .named_asset_path_count = cli->named_asset_paths,
                                    .named_in = cli->named_in,
                                    .names_scene = cli->names_scene,
                                    .sets = o->sets.items,
                                    .set_count = o->sets.count,
                                    .limits = o->limits,
                                    .policy = &o->policy,
                                    .width = o->width,
                                    .height = o->height,
                                    .samples = o->samples,
                                    .error = error_of(o),
                                    .pixels = o->skip_pixels ? ASSETS_SKIP_PIXELS : ASSETS_KEEP_PIXELS};
}

int cli_not_written(struct cli *cli, const char *path, int error) {
    const bool is_stdout = strcmp(path, "-") == 0;
    if (error == EPIPE && is_stdout)
        return CLI_PIPE; // 'glint ... | head' is not a mistake
    cli_error(cli, DIAG_OUTPUT, is_stdout ? "standard output" : path, NULL, "cannot be written: %s",
              strerror(error));
    return CLI_FILE;
}

int cli_write(struct cli *cli, const char *path, str bytes) {
    const int error = cli_put_output(cli, path, bytes);
    return error ? cli_not_written(cli, path, error) : CLI_OK;
}

int cli_write_named(struct cli *cli, struct files *files, str path, str bytes) {
    struct output output;
    const enum file_status status = files_write(files, path, &output);
    if (status == FILE_OK) {
        output_write(&output, bytes.ptr, bytes.len);
        if (output_commit(&output))
            return CLI_OK;
    }
    const char *name = arena_copy(&cli->arena, path).ptr;
    if (status != FILE_OUTSIDE && status != FILE_NOT_REGULAR)
        return cli_not_written(cli, name, output.error ? output.error : files->system_error);
    cli_error(cli, session_file_code(status), name, NULL, "is not written: it %s",
              status == FILE_OUTSIDE ? "leads out of the folder" : file_status_text(files, status));
    return CLI_REFUSED;
}

int cli_try_output(struct cli *cli, const char *path) {
    struct output probe;
    if (!path || strcmp(path, "-") == 0)
        return CLI_OK;
    if (cli_open_output(cli, &probe, path)) {
        output_abandon(&probe);
        return CLI_OK;
    }
    return cli_not_written(cli, path, probe.error);
}

int cli_write_made(struct cli *cli, const char *path, const struct strbuf *made, const char *what) {
    if (!made->failed)
        return cli_write(cli, path, strbuf_view(made));
    cli_error(cli, DIAG_OUT_OF_MEMORY, strcmp(path, "-") == 0 ? "standard output" : path, NULL,
              "not enough memory for %s", what);
    return CLI_FILE;
}

int cli_print(struct cli *cli, str text) {
    return cli_write(cli, "-", text);
}

const char *cli_default_picture(struct cli *cli, const char *scene) {
    str base = path_base(str_from(scene));
    size_t end = 1;
    while (end < base.len && base.ptr[end] != '.')
        end++;
    return arena_format(&cli->arena, "%.*s.png", STR_ARG(str_slice(base, 0, end))).ptr;
}
