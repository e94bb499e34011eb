// Whether a picture or part that must be written is there already: --skip-done.
//
// A file counts if it is whole and says of itself what the new one would say (render/record): the same scene
// by its hash, version of glint, device, settings and size; of a part also the same pixels. Anything else, a
// file that cannot be read included, is rendered again. Ownership: text lies in cli->arena. Thread safety: as
// cli.h.
#ifndef GLINT_CLI_COMMANDS_PICTURES_DONE_H
#define GLINT_CLI_COMMANDS_PICTURES_DONE_H

#include "cli/cli.h"
#include "render/parts/part_file.h"
#include "tracer/gpu/gpu.h"

// What would be rendered.
struct done_wish {
    const struct session *session; // the background's pixels are there
    const struct gpu *gpu;         // NULL: the reference
    uint32_t camera;
    const struct part *part; // its size, region, samples and display; NULL: a whole picture
};

// Whether the file at `path` is what `output` would be.
bool done_is_there(struct cli *cli, const struct cli_output *output, const char *path,
                   const struct done_wish *wish);
// Whether a whole picture with these texts is there.
bool done_picture(struct cli *cli, const char *path, const struct image_texts *texts);

#endif
