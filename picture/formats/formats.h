// The table of picture formats: the only place that knows which exist.
//
// Input: a path, or an enum image_format. Output: rows of a constant table, and words made from it, which are
// constants too so that documentation and messages can hold them (unit/formats keeps them true to the table).
// Errors: a path of no known ending gives false. Ownership: all is constant. Thread safety: constant data.
#ifndef GLINT_PICTURE_FORMATS_FORMATS_H
#define GLINT_PICTURE_FORMATS_FORMATS_H

#include "core/str.h"

enum image_format {
    IMAGE_NONE, // not a picture that glint knows
    IMAGE_PNG,
    IMAGE_JPEG,
    IMAGE_WEBP,
    IMAGE_EXR,
    IMAGE_PFM,
    IMAGE_HDR,
    IMAGE_FORMATS,
};

// What files of a format are used for.
enum image_use {
    IMAGE_WRITTEN = 1,  // by glint render -o
    IMAGE_IN_SCENE = 2, // an image that a scene names
    IMAGE_COMPARED = 4, // by glint compare
};

struct image_format_info {
    const char *name;       // "PNG"
    const char *endings[3]; // {".png"}; NULL after the last
    unsigned uses;          // bits of enum image_use
    unsigned bits[3];       // bits per channel that can be written, the default first; 0 after the last
    unsigned side_max;      // most pixels of a side; 0: as many as glint renders
    bool is_linear;         // holds colours as they were rendered, before tone and transfer
    bool has_quality;       // lossy, with a quality setting
    bool has_compression;   // has several kinds of compression
    const char *magic;      // the first bytes of a file; NULL: there are none
    const char *words;      // "Radiance HDR", in lists for people
    const char *what;       // as in "this is a PNG picture"
};

// Of each use, in the order of the table.
#define IMAGE_WRITTEN_ENDINGS ".png, .jpg, .jpeg, .webp, .exr, .pfm or .hdr"
#define IMAGE_IN_SCENE_NAMES  "PNG, JPEG, OpenEXR or Radiance HDR"
#define IMAGE_COMPARED_NAMES  "PNG, JPEG, OpenEXR, PFM or Radiance HDR"

// Accepts IMAGE_NONE, which has an empty name and no endings.
const struct image_format_info *image_format_info(enum image_format format);
// Finds the format by a path's ending, ignoring case; false: no format of this use has it.
bool image_format_of_path(str path, enum image_use use, enum image_format *format);
// Why files of a format can be neither read nor written: a library that glint was built without; NULL: they
// can.
const char *image_format_missing(enum image_format format);
// The endings of images in scenes; NULL after the last.
const char *const *image_scene_endings(void);

#endif
