// A finished picture read back from a file: PNG and JPEG (displayed values), PFM, OpenEXR and HDR (linear
// floats).
//
// Ownership: picture_file_finish frees the pixels; it accepts NULL and zeroed ones. Errors: a sentence.
// Thread safety: pure.
#ifndef GLINT_PICTURE_METRICS_PICTURE_FILE_H
#define GLINT_PICTURE_METRICS_PICTURE_FILE_H

#include "core/str.h"
#include "picture/metrics/metrics.h"

struct picture_file {
    uint32_t width, height;
    const char *kind; // "PNG"
    enum measure_space space;
    float *rgb; // three per pixel, rows from the top
};

// `most_bytes` of memory are a cap; NULL, or what is wrong with the file. *unknown is set for another kind of
// file.
const char *picture_file_decode(str bytes, uint64_t most_bytes, struct picture_file *out, bool *unknown);
void picture_file_finish(struct picture_file *picture);

// Portable float maps ("PF" colour, "Pf" grey, either byte order); the scale's size is ignored, as other
// readers do. Fills all of `out` except the kind.
const char *pfm_decode(str bytes, uint64_t most_bytes, struct picture_file *out);

#endif
