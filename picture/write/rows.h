// A picture that is not in memory as a whole: its rows are asked for some at a time, and its file is written
// as they come. The bytes are those of image_encode.
//
// PNG, Radiance HDR and OpenEXR ask for rows from the top, PFM from the bottom, each once. A JPEG is coded
// with tables made for the whole picture, and a WebP by a library that takes only whole ones: these cannot be
// written this way. Errors: false; the rows' or the sink's context knows why, or memory ran out. Ownership:
// everything is the caller's. Thread safety: rows and sink are called by the caller's thread.
#ifndef GLINT_PICTURE_WRITE_ROWS_H
#define GLINT_PICTURE_WRITE_ROWS_H

#include "picture/write/image.h"

// Where the rows come from.
struct image_rows {
    uint32_t width, height; // pixels, at least 1
    // Puts `count` rows from row `y` on into `rgb`, three floats per pixel. false: there are none, and the
    // file is abandoned.
    bool (*take)(void *context, uint32_t y, uint32_t count, float *rgb);
    void *context;
    struct image_texts texts; // as in struct image
    struct image_coding coding;
};

// Where the bytes go.
struct image_sink {
    bool (*put)(void *context, const void *bytes, size_t count);
    // Overwrites bytes put before, from place `at` on: for formats whose head is known last (OpenEXR).
    bool (*put_over)(void *context, uint64_t at, const void *bytes, size_t count);
    void *context;
};

// Whether a format can be written this way.
bool image_rows_can(enum image_format format);
// Writes the whole file. `display` is for formats of displayed values.
bool image_rows_write(const struct image_rows *rows, enum image_format format, struct image_display display,
                      const struct image_sink *sink);

// ---- shared by its files

enum {
    IMAGE_ROWS_BYTES = 8 << 20, // bytes of floats requested at a time, or one row
};
static inline uint32_t image_rows_at_once(const struct image_rows *rows) {
    const uint32_t fit = IMAGE_ROWS_BYTES / (rows->width * 3 * (uint32_t)sizeof(float));
    return fit < 1 ? 1 : fit < rows->height ? fit : rows->height;
}
bool encode_png_rows(const struct image_rows *rows, struct image_display display,
                     const struct image_sink *sink);
bool encode_exr_rows(const struct image_rows *rows, const struct image_sink *sink);

#endif
