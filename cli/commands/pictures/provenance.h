// What the pictures that glint writes say of how they were made (render/record).
//
// Ownership: text lies in cli->arena. Thread safety: as cli.h; session and device are only read.
#ifndef GLINT_CLI_COMMANDS_PICTURES_PROVENANCE_H
#define GLINT_CLI_COMMANDS_PICTURES_PROVENANCE_H

#include "cli/cli.h"
#include "tracer/gpu/gpu.h"

struct provenance {
    const struct session *session; // the background's pixels are there
    const struct gpu *gpu;         // NULL: the reference
    uint32_t camera;
    bool is_double;
    bool audits;                          // the picture's note says what an audit found
    uint32_t scaled_width, scaled_height; // 0: the picture was not scaled up
    enum image_format format;
    struct image_coding coding; // render_coding of it
};

// The texts for the head of its file; none for a format without a place, and for a picture that no command
// makes again.
struct image_texts provenance_texts(struct cli *cli, const struct provenance *made);
// The texts of a whole picture as a line for its parts, which do not know the format; empty: there are none,
// or they need more than `size` bytes. And back, for the picture that parts make.
void provenance_line(struct cli *cli, const struct provenance *made, char *line, size_t size);
struct image_texts provenance_of_line(struct cli *cli, const char *line, enum image_format format,
                                      struct image_coding coding);

#endif
