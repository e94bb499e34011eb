// Standard input as a scene: the operand '-', with --as and --base.
#include "cli/cli.h"

#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "files/files.h"
#include "files/stream.h"

#include <string.h>
#include <unistd.h>

str cli_stream_name(struct cli *cli) {
    const char *spelling = cli->options.as;
    return arena_format(&cli->arena, "standard input%s%s", spelling ? "." : "", spelling ? spelling : "");
}

int cli_read_stream(struct cli *cli, struct strbuf *text) {
    int error = stream_read(STDIN_FILENO, limits_size(&cli->options.limits, LIMIT_SCENE_BYTES), text);
    if (!error && !text->failed)
        return CLI_OK;
    if (error)
        cli_error(cli, DIAG_FILE_UNREADABLE, "standard input", NULL, "standard input cannot be read: %s",
                  strerror(error));
    else
        cli_error(cli, DIAG_LIMIT, "standard input", NULL,
                  "standard input is larger than the limit scene-bytes");
    return CLI_FILE;
}

// The text takes the place of a file in the folder that its paths are relative to.
static void take(struct cli *cli, str text) {
    struct cli_stream *stream = &cli->stream;
    struct files files;
    files_init(&files, &cli->arena);
    str folder = cli->options.base ? str_from(cli->options.base) : STR(".");
    stream->path = path_join(&cli->arena, folder, cli_stream_name(cli));
    stream->overlay.path = path_join(&cli->arena, files_canonical(&files, folder), cli_stream_name(cli));
    stream->overlay.text = arena_copy(&cli->arena, text);
}

static bool is_stream(const struct cli *cli, int operand) {
    return strcmp(cli->operands[operand], "-") == 0;
}

static int refuse_options(struct cli *cli) {
    static const char why[] = "it is about standard input, and no argument is '-'";
    return cli_has_no_effect(cli, "as", why) || cli_has_no_effect(cli, "base", why) ? CLI_USAGE : CLI_OK;
}

int cli_take_stream(struct cli *cli, const struct cli_command *command) {
    bool takes = cli_has_option(command, "base");
    // Where any number is allowed, all operands are scenes; else those that follow are OUT of convert, or a
    // pixel.
    bool all = command->most_operands < 0 || strcmp(command->name, "diff") == 0;
    int count = 0, last = 0;
    for (int i = 0; i < cli->operand_count && (i == 0 || all); i++)
        if (is_stream(cli, i)) {
            count++;
            last = i;
        }
    if (count == 0)
        return refuse_options(cli);
    if (!takes)
        return CLI_OK;
    if (count > 1)
        return cli_usage(cli, cli_operand_place(cli, last), "standard input can be read only once");
    struct strbuf text;
    strbuf_init(&text);
    int status = cli_read_stream(cli, &text);
    if (status == CLI_OK) {
        take(cli, strbuf_view(&text));
        cli->operands[last] = (char *)cli->stream.path.ptr;
    }
    strbuf_finish(&text);
    return status;
}
