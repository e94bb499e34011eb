// What the pictures that glint writes say of how they were made (app/record).
//
// Ownership: text lies in cli->arena. Thread safety: as cli.h; session and device are only read.
#ifndef GLINT_CLI_PICTURES_PROVENANCE_H
#define GLINT_CLI_PICTURES_PROVENANCE_H

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
};

// The texts for the head of its file; none for a format without a place, and for a picture that no command
// makes again.
struct image_texts provenance_texts(struct cli *cli, const struct provenance *made);
// The device as files name it.
str provenance_device(struct arena *arena, const struct gpu *gpu);

#endif
