// A finished picture: linear floats, converted to displayed bytes and files in memory.
//
// tone.c is the one place where tone, transfer and rounding to 8 bits happen (docs/language.md, "Output"):
// mean -> tone -> transfer -> floor(255 * clamp(c) + 1/2). The float formats hold the mean before these
// steps. A pixel with a channel that is not a number is a fault of the renderer, and marked: magenta in bytes
// (whatever tone and transfer) and in HDR; PFM keeps it.
// Ownership: image_finish frees the pixels. Errors: writers set out->failed when memory runs out.
// Thread safety: an image is plain data; writers work on as many threads as there are processors.
#ifndef GLINT_PICTURE_WRITE_IMAGE_H
#define GLINT_PICTURE_WRITE_IMAGE_H

#include "core/strbuf.h"
#include "grammar/ir_value.h"
#include "picture/formats/formats.h"

#include <math.h>

enum image_compression {
    IMAGE_ZIP,
    IMAGE_PIZ,
    IMAGE_UNCOMPRESSED,
};

// How a file is coded where its format leaves a choice; 0: the default.
struct image_coding {
    unsigned bits;        // per channel: PNG 8 or 16, OpenEXR 16 or 32; 0: 8, and 32
    unsigned quality;     // 1 to 100, for JPEG and WebP (100: lossless WebP); 0: IMAGE_QUALITY
    unsigned compression; // enum image_compression, for OpenEXR
};

enum {
    IMAGE_QUALITY = 90,
    IMAGE_QUALITY_MOST = 100,
};

// A line for the file's head, UTF-8 without control characters.
struct image_text {
    const char *keyword; // ASCII: letters, and single spaces between words
    const char *text;
};

struct image_texts {
    const struct image_text *items; // not owned
    uint32_t count;
};

enum {
    IMAGE_TEXTS_MOST = 15,
};

struct image_layers; // exr_file.h
struct image {
    uint32_t width, height;
    float *rgb;       // three per pixel, row 0 on top
    const char *note; // a line of ASCII for the file's head, filed under IMAGE_NOTE_KEYWORD; not owned; NULL:
                      // none
    struct image_texts texts; // more lines, at most IMAGE_TEXTS_MOST
    struct image_coding coding;
    const struct image_layers *layers; // in OpenEXR (exr_file.h) beside its colours; not owned; NULL: none
};

// How linear values are displayed: the words of the scene's image element.
struct image_display {
    unsigned tone;     // ir_tone
    unsigned transfer; // ir_transfer
    double exposure;   // stops
};
// As a scene's image element says.
struct ir_image;
struct image_display image_display_of(const struct ir_image *image);

// Black; false: no memory. width and height are at least 1.
bool image_init(struct image *image, uint32_t width, uint32_t height);
// The same for an existing image, which is kept if it already has this size; its pixels are then not black.
bool image_fit(struct image *image, uint32_t width, uint32_t height);
void image_finish(struct image *image);

// Whether a pixel's three channels mark a fault: one of them is not a number.
static inline bool image_is_marked(const float rgb[3]) {
    return isnan(rgb[0]) || isnan(rgb[1]) || isnan(rgb[2]);
}

// `bytes` has room for 3 * width * height.
void image_to_bytes(const struct image *image, struct image_display display, uint8_t *bytes);
// The same rounded to 16 bits, the higher byte first: 6 * width * height.
void image_to_words(const struct image *image, struct image_display display, uint8_t *bytes);
// The same before rounding: 0..1, NaN is 0. `displayed` may be `linear`.
void image_to_displayed(const float *linear, size_t pixels, struct image_display display, float *displayed);

// Of the pixels, the share of which a channel is cut off, being brighter than 1 by more than a byte's step,
// and the exposure at which 99.5 % are not cut off. 0, with `exposure` as it was: it is at most `least`
// (0.005 or more), the tone cuts nothing off, the pixels are not in memory (rgb is NULL), or none can be
// allocated.
double image_clipped(const struct image *image, struct image_display display, double least, double *exposure);

// Texts are text chunks of a PNG, comments of a JPEG and in the head of an HDR, and attributes of an OpenEXR
// ("Scene hash": sceneHash). A WebP does not have them, and a PFM has no room for them; a JPEG leaves out a
// text of more than 64 KiB.
#define IMAGE_NOTE_KEYWORD "Accuracy"
// Appends the whole file to `out`; IMAGE_WRITTEN, and not image_format_missing. `display` is for formats of
// displayed values.
void image_encode(const struct image *image, enum image_format format, struct image_display display,
                  struct strbuf *out);

#endif
