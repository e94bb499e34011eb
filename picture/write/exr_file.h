// An OpenEXR file in memory, by OpenEXRCore: channels of floats and whole numbers, and attributes of text.
//
// Chunks of rows are compressed on all processors; the bytes do not depend on how many there are. Errors:
// exr_file_write sets out->failed when memory runs out; where glint is built without the library it does so
// too, and image_format_missing(IMAGE_EXR) says why. Ownership: all is the caller's. Thread safety: plain
// data.
#ifndef GLINT_PICTURE_WRITE_EXR_FILE_H
#define GLINT_PICTURE_WRITE_EXR_FILE_H

#include "core/strbuf.h"

#include <stdint.h>

enum exr_type {
    EXR_TYPE_UINT, // uint32_t
    EXR_TYPE_HALF, // float in memory, half in the file
    EXR_TYPE_FLOAT,
};

struct image_rows; // rows.h
struct image_sink;

struct exr_channel {
    const char *name; // "R", "normal.X"
    enum exr_type type;
    const void *first;  // of row 0, which is on top; four bytes each
    int32_t step_bytes; // from pixel to pixel
};

struct exr_attribute {
    const char *name, *text;
};

struct exr_file {
    uint32_t width, height;
    unsigned compression; // enum image_compression
    const struct exr_channel *channels;
    uint32_t channel_count;
    const struct exr_attribute *attributes;
    uint32_t attribute_count;
    // Where rows of three floats come from, some at a time, and where the file goes: `first` of channels then
    // points into one pixel, whose first value is that of the first channel. NULL: channels are in memory,
    // and so is the file.
    const struct image_rows *rows;
    const struct image_sink *sink;
};

// What an OpenEXR picture holds beside its channels R, G and B.
struct image_layers {
    const struct exr_channel *channels;
    uint32_t channel_count;
    const struct exr_attribute *attributes;
    uint32_t attribute_count;
};

// Appends the whole file to `out`, which is empty, or writes it to the sink: then `out` only takes `failed`.
void exr_file_write(const struct exr_file *file, struct strbuf *out);

#endif
