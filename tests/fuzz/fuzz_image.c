// libFuzzer entry: any bytes as an image file.
#include "picture/metrics/picture_file.h"
#include "picture/read/picture_read.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    PIXELS_MAX = 1 << 18
};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(bool holds, const char *what) {
    if (holds)
        return;
    fprintf(stderr, "the image reader broke its promise: %s\n", what);
    abort();
}

static void check_floats(const struct picture *picture) {
    for (size_t i = 0; i < (size_t)picture->width * picture->height; i++)
        for (size_t c = 0; c < 3; c++)
            require(isfinite(picture_linear(picture, i, c)) && picture_linear(picture, i, c) >= 0,
                    "pixels are finite and not negative");
}

static uint32_t read32(const uint8_t *p) {
    return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
}

// Makes the checksums of a PNG right: else every change would end at them, and never reach the decoder.
static void repair_checksums(uint8_t *data, size_t size) {
    for (size_t at = 8; size >= 8 && size - at >= 12;) {
        uint32_t length = read32(data + at);
        if (length > size - at - 12)
            return;
        uint32_t crc = UINT32_MAX;
        for (size_t i = at + 4; i < at + 8 + length; i++) {
            crc ^= data[i];
            for (int bit = 0; bit < 8; bit++)
                crc = crc & 1 ? UINT32_C(0xEDB88320) ^ crc >> 1 : crc >> 1;
        }
        at += 8 + (size_t)length;
        for (int i = 0; i < 4; i++)
            data[at++] = (uint8_t)(~crc >> (24 - 8 * i));
    }
}

static void read_image(str bytes) {
    struct picture_header header;
    struct picture picture = {0};
    const char *fault = picture_read_header(bytes, &header);
    if (fault || header.kind == IMAGE_NONE || (uint64_t)header.width * header.height > PIXELS_MAX)
        return;
    const char *checked = picture_check(bytes, &header);
    fault = picture_decode(bytes, &header, &picture);
    require(!checked == !fault && (!fault || strcmp(checked, fault) == 0),
            "the same fault whether pixels are kept or not");
    require(fault ? !picture.pixels : picture.pixels != NULL, "pixels, or a fault");
    if (!fault && picture_is_linear(&picture))
        check_floats(&picture);
    picture_finish(&picture);
}

// As the commands that compare pictures read them: PFM too, and all as floats.
static void read_finished(str bytes) {
    struct picture_file picture = {0};
    bool unknown = false;
    const char *fault = picture_file_decode(bytes, PIXELS_MAX * 3 * sizeof(float), &picture, &unknown);
    require(fault || unknown || (picture.rgb && picture.width && picture.height && picture.kind),
            "a finished picture, or a fault");
    const size_t floats = picture.rgb ? (size_t)picture.width * picture.height * 3 : 0;
    volatile float seen = 0; // a sanitizer sees each float being read
    for (size_t i = 0; i < floats; i++)
        seen = picture.rgb[i];
    (void)seen;
    picture_file_finish(&picture);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    uint8_t *copy = malloc(size ? size : 1);
    if (!copy)
        abort();
    if (size)
        memcpy(copy, data, size);
    read_image((str){(const char *)copy, size});
    read_finished((str){(const char *)copy, size});
    repair_checksums(copy, size);
    read_image((str){(const char *)copy, size});
    read_finished((str){(const char *)copy, size});
    free(copy);
    return 0;
}
