// The door to stb_image, which decodes PNG and JPEG (stb_decode.c is the only file that sees it).
//
// Thread safety: calls are independent of each other; the budget belongs to the calling thread.
#ifndef GLINT_PICTURE_READ_STB_DECODE_H
#define GLINT_PICTURE_READ_STB_DECODE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct stb_job {
    const void *bytes;
    size_t count;
    bool is_16_bit;         // uint16_t a channel, else uint8_t
    size_t budget_bytes;    // never more than this is allocated at a time
    uint32_t width, height; // that the result must have
};

// RGBA pixels, to be freed with stb_free. NULL: *why tells what is wrong.
void *stb_decode(const struct stb_job *job, const char **why);
void stb_free(void *pixels);

#endif
