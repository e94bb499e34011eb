// Whether a command line asks for many pictures, or for a film.
#include "cli/commands/batch/batch_job.h"
#include "cli/commands/commands.h"

#include <string.h>

enum batch_film batch_film_of(const char *path) {
    static const struct {
        const char *ending;
        enum batch_film film;
    } rows[] = {{".y4m", BATCH_Y4M}, {".mp4", BATCH_FFMPEG}, {".webm", BATCH_FFMPEG}, {".gif", BATCH_FFMPEG}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (str_ends_with_nocase(str_from(path), rows[i].ending))
            return rows[i].film;
    return strcmp(path, "-") == 0 ? BATCH_Y4M : BATCH_NO_FILM;
}

bool batch_is_wanted(const struct cli *cli) {
    const struct cli_batch *b = &cli->options.batch;
    bool film = false;
    for (uint32_t i = 0; i < cli->options.outputs.count; i++)
        film |= strcmp(cli->options.outputs.items[i].path, "-") != 0 &&
                batch_film_of(cli->options.outputs.items[i].path) != BATCH_NO_FILM;
    // If cameras were rendered one by one, another process that goes on would not know which are done.
    film |= cli->options.part.resume && str_equal(cli->options.camera, STR("all"));
    return b->has_frames || b->sweeps.count || b->list || b->montage || cli->operand_count > 1 || film;
}
