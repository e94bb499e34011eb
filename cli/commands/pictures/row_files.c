#include "cli/commands/pictures/row_files.h"
#include "diag/codes/limit.h"

#include "cli/made.h"

#include <errno.h>
#include <string.h>

struct writing {
    const struct image_rows *rows;
    struct output output;
    bool ended; // the rows
};

static bool take(void *context, uint32_t y, uint32_t count, float *rgb) {
    struct writing *w = context;
    w->ended = !w->rows->take(w->rows->context, y, count, rgb);
    return !w->ended;
}

static bool put(void *context, const void *bytes, size_t count) {
    struct writing *w = context;
    output_write(&w->output, bytes, count);
    return !w->output.error;
}

static bool put_over(void *context, uint64_t at, const void *bytes, size_t count) {
    struct writing *w = context;
    const uint64_t end = output_place(&w->output);
    output_move(&w->output, at);
    output_write(&w->output, bytes, count);
    output_move(&w->output, end);
    return !w->output.error;
}

static int fail(struct cli *cli, const char *path, int error) {
    if (error)
        return cli_not_written(cli, path, error);
    cli_error(cli, DIAG_OUT_OF_MEMORY, path, NULL, "not enough memory to encode the picture");
    return CLI_FILE;
}

int row_file_write(struct cli *cli, const char *path, const struct image_rows *rows, enum image_format format,
                   struct image_display display, const struct part *part, bool *rows_ended) {
    struct writing w = {.rows = rows};
    struct image_rows through = *rows;
    const struct image_sink sink = {put, put_over, &w};
    through.take = take;
    through.context = &w;
    *rows_ended = false;
    if (!cli_open_output(cli, &w.output, path))
        return fail(cli, path, w.output.error);
    const bool written =
        part ? part_write_rows(part, &through, &sink) : image_rows_write(&through, format, display, &sink);
    if (written && output_commit(&w.output))
        return CLI_OK;
    if (!written)
        output_abandon(&w.output);
    *rows_ended = w.ended;
    return w.ended ? CLI_FILE : fail(cli, path, w.output.error);
}
