// Image files in memory: what they are, and their pixels.
//
// The size is known and checked before anything is decoded, and decoding has a budget of bytes: no small
// file becomes a large allocation that its header did not announce. picture_check and picture_decode are the
// same decoder, whose rows go either to a single row that is overwritten again and again, or to where they
// are kept: both accept the same files.
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
    uint64_t decoder_bytes; // most memory that decoding takes besides the pixels
    size_t data_at;         // HDR: where the pixels begin
    const char *ignored;    // as in struct picture
    uint64_t clear_pixels;  // likewise
};

// Returned if the system has no memory: not a fault of the file.
extern const char picture_no_memory[];

// Reads only the header. Returns NULL if it is whole, else what is wrong with it; kind is NONE for files that
// are not an image of a supported kind.
const char *picture_read_header(str bytes, struct picture_header *out);
enum picture_depth picture_depth_of(const struct picture_header *header);
// The bytes of memory that a picture with this header takes at most: while it is decoded, its pixels, and
// `more_bytes` for each pixel that the caller makes of them. Never overflows: UINT64_MAX is "beyond all".
uint64_t picture_memory(const struct picture_header *header, uint64_t more_bytes);
// A picture with this header, without its pixels.
struct picture picture_of_header(const struct picture_header *header);
// Decodes every row and keeps none. Returns NULL, or what is wrong. This and picture_decode note unused
// features of the pixels in `ignored` and `clear_pixels` of the header.
const char *picture_check(str bytes, struct picture_header *header);
// Decodes; returns NULL, or what is wrong, and then *out has no pixels. picture_finish frees them.
const char *picture_decode(str bytes, struct picture_header *header, struct picture *out);

#endif
