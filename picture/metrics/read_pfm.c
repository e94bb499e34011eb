// Portable float maps: "PF", width, height, scale whose sign gives the byte order, then rows from the bottom.
#include "core/float_bits.h"
#include "core/heap.h"
#include "core/number.h"
#include "picture/metrics/picture_file.h"

enum {
    FLOAT_BYTES = 4,
    SIDE_MAX = 1 << 24,
};

// The next word of the header; only one space after the last separates it from the pixels.
static str next_word(str bytes, size_t *at) {
    while (*at < bytes.len && char_is_space(bytes.ptr[*at]))
        ++*at;
    const size_t begin = *at;
    while (*at < bytes.len && !char_is_space(bytes.ptr[*at]))
        ++*at;
    return str_slice(bytes, begin, *at);
}

static bool read_side(str word, uint32_t *side) {
    int64_t value = 0;
    if (number_parse_integer(word, &value) != NUMBER_OK || value < 1 || value > SIDE_MAX)
        return false;
    *side = (uint32_t)value;
    return true;
}

static float read_float(const unsigned char *p, bool little) {
    uint32_t bits = 0;
    for (int k = 0; k < FLOAT_BYTES; k++)
        bits |= (uint32_t)p[k] << (8 * (little ? k : FLOAT_BYTES - 1 - k));
    return float_of_bits(bits);
}

const char *pfm_decode(str bytes, uint64_t most_bytes, struct picture_file *out) {
    size_t at = 2;
    const size_t channels = bytes.ptr[1] == 'F' ? 3 : 1;
    double scale = 0;
    if (bytes.len < 3 || !char_is_space(bytes.ptr[2]) || !read_side(next_word(bytes, &at), &out->width) ||
        !read_side(next_word(bytes, &at), &out->height))
        return "its width or height is not a whole number from 1 to 16777216";
    if (number_parse(next_word(bytes, &at), &scale) != NUMBER_OK || scale == 0)
        return "its scale, whose sign shows the byte order, is not a number";
    const uint64_t pixels = (uint64_t)out->width * out->height;
    if (3 * pixels * sizeof *out->rgb > most_bytes)
        return "it takes more memory than the limit image-memory";
    if (at >= bytes.len || (bytes.len - at - 1) / (FLOAT_BYTES * channels) < pixels)
        return "the file ends before its last pixel";
    out->space = MEASURE_LINEAR;
    out->rgb = heap_array(heap_times(3, pixels), sizeof *out->rgb);
    if (!out->rgb)
        return "there is not enough memory";
    const unsigned char *data = (const unsigned char *)bytes.ptr + at + 1;
    for (size_t i = 0; i < pixels; i++) {
        const size_t row = out->height - 1 - i / out->width, to = row * out->width + i % out->width;
        for (size_t k = 0; k < 3; k++)
            out->rgb[3 * to + k] =
                read_float(data + FLOAT_BYTES * (channels * i + (channels == 3 ? k : 0)), scale < 0);
    }
    return NULL;
}
