// Image files in memory: what they are, and their pixels.
//
// The size is known and checked before anything is decoded, and decoding has a budget of bytes: no small
// file becomes a large allocation that its header did not announce. picture_check and picture_decode are one
// decoder whose rows go to one row that is written again and again, or to where they are kept: what one
// accepts the other does.
// Errors: a sentence without its end, or picture_no_memory itself. Ownership: see picture.h.
// Thread safety: calls are independent of each other.
#ifndef GLINT_PICTURE_READ_PICTURE_READ_H
#define GLINT_PICTURE_READ_PICTURE_READ_H

#include "core/str.h"
#include "picture/formats/formats.h"
#include "picture/read/picture.h"

struct picture_header {
    enum image_format kind;
    uint32_t width, height;
    bool is_16_bit;         // PNG
    uint64_t decoder_bytes; // that decoding takes at most besides the pixels
    size_t data_at;         // HDR: where the pixels begin
    const char *ignored;    // as in struct picture
    uint64_t clear_pixels;  // likewise
};

// What is returned where the system has no memory: not a fault of the file.
extern const char picture_no_memory[];

// Reads only the header. NULL if it is whole, else what is wrong with it; kind is NONE for files that are not
// an image of a supported kind.
const char *picture_read_header(str bytes, struct picture_header *out);
enum picture_depth picture_depth_of(const struct picture_header *header);
// The bytes of memory that a picture with this header takes at most: while it is decoded, its pixels, and
// `more_bytes` for each pixel that the caller makes of them. Never overflows: UINT64_MAX is "beyond all".
uint64_t picture_memory(const struct picture_header *header, uint64_t more_bytes);
// What a picture with this header is without its pixels.
struct picture picture_of_header(const struct picture_header *header);
// Decodes every row and keeps none. NULL, or what is wrong. What pixels have that is not used is added to
// `ignored` and `clear_pixels` of the header, in both of these.
const char *picture_check(str bytes, struct picture_header *header);
// Decodes; returns NULL, or what is wrong, and then *out has no pixels. picture_finish frees them.
const char *picture_decode(str bytes, struct picture_header *header, struct picture *out);

#endif
