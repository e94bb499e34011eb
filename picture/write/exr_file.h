// An OpenEXR file in memory, by OpenEXRCore: channels of floats and whole numbers, and attributes of text.
//
// Chunks of rows are compressed on all processors; the bytes do not depend on how many there are. Errors:
// exr_file_write sets out->failed when memory runs out; also if glint is built without the library;
// image_format_missing(IMAGE_EXR) says why. Ownership: everything is the caller's. Thread safety: plain data.
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
    const void *first;  // the first value of row 0, the top row; four bytes each
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
    // The source of rows of three floats, some at a time, and the destination of the file: each channel's
    // `first` then points into one pixel, whose first value belongs to the first channel. NULL: channels are
    // in memory, and so is the file.
    const struct image_rows *rows;
    const struct image_sink *sink;
};

// What an OpenEXR picture holds besides its channels R, G and B.
struct image_layers {
    const struct exr_channel *channels;
    uint32_t channel_count;
    const struct exr_attribute *attributes;
    uint32_t attribute_count;
};

// Appends the whole file to `out`, which is empty, or writes it to the sink: then only `out->failed` is used.
void exr_file_write(const struct exr_file *file, struct strbuf *out);

#endif
