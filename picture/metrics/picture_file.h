// A finished picture read back from a file: PNG and JPEG (displayed values), PFM and HDR (linear floats).
//
// Ownership: picture_file_finish frees the pixels; NULL and zeroed ones are fine. Errors: a sentence.
// Thread safety: pure.
#ifndef GLINT_PICTURE_METRICS_PICTURE_FILE_H
#define GLINT_PICTURE_METRICS_PICTURE_FILE_H

#include "core/str.h"
#include "picture/metrics/metrics.h"

struct picture_file {
    uint32_t width, height;
    const char *kind; // "PNG"
    enum measure_space space;
    float *rgb; // three a pixel, rows from the top
};

// `most_pixels` is a cap; NULL, or what is wrong with the file. A file of another kind: *unknown.
const char *picture_file_decode(str bytes, uint64_t most_pixels, struct picture_file *out, bool *unknown);
void picture_file_finish(struct picture_file *picture);

// Portable float maps ("PF" colour, "Pf" grey, either byte order); the scale's size is ignored, as other
// readers do. Fills all of `out` but the kind.
const char *pfm_decode(str bytes, uint64_t most_pixels, struct picture_file *out);

#endif
