// libFuzzer entry: any bytes as a part of a picture and as a checkpoint, with the seals made right, else
// every change would end at them. What is read is within what its head says, and what was read is written as
// it was.
#include "core/xxh64.h"
#include "fuzz_file.h"
#include "render/parts/bands.h"
#include "render/parts/parts.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    SEAL_BYTES = 8,
    FLOATS_MOST = 1 << 16,
};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(bool holds, const char *what) {
    if (holds)
        return;
    fprintf(stderr, "the reader of parts broke its promise: %s\n", what);
    abort();
}

static void check_part(const struct part *part) {
    const struct part_region *r = &part->region;
    require(r->width && r->height && (uint64_t)r->x + r->width <= part->width &&
                (uint64_t)r->y + r->height <= part->height,
            "a region is in its picture");
    require(part->first_sample < part->end_sample && part->end_sample <= part->samples,
            "samples are some of all");
}

static void check_fit(const struct part *part) {
    const struct part both[2] = {*part, *part};
    uint32_t order[2];
    struct parts_fault fault = {0};
    strbuf_init(&fault.text);
    require(!parts_fit(both, 2, order, &fault), "a part twice is no picture");
    const bool is_whole = part->region.width == part->width && part->region.height == part->height &&
                          part->end_sample - part->first_sample == part->samples;
    require(parts_fit(both, 1, order, &fault) == is_whole, "a whole part is a picture");
    strbuf_finish(&fault.text);
}

static void check_same(const struct part *part, const uint8_t *data, size_t size) {
    struct strbuf text;
    strbuf_init(&text);
    part_encode(part, &text);
    require(text.len <= size + 64 && (text.len != size || memcmp(text.data, data, size) == 0),
            "a part is written as it was");
    strbuf_finish(&text);
}

static void read_as_part(const char *path, const uint8_t *data, size_t size) {
    struct part part, head;
    struct strbuf error;
    strbuf_init(&error);
    const bool good = part_read(path, false, &part, &error);
    require(good || error.len, "a part that cannot be read has an error");
    require(good || !part.rgb, "what cannot be read has no floats");
    if (part_read(path, true, &head, &error)) {
        check_part(&head);
        check_fit(&head);
        if (head.end_sample - head.first_sample == head.samples)
            require(part_check(path, &head, &error) == good, "a part is whole either way");
    }
    if (good)
        check_same(&part, data, size);
    part_finish(&part);
    strbuf_finish(&error);
}

static void read_as_bands(const char *path) {
    struct bands bands;
    struct strbuf error;
    bool missing;
    strbuf_init(&error);
    if (bands_open(&bands, path, NULL, NULL, &missing, &error)) {
        check_part(&bands.part);
        require(bands.is_judged && bands.done_count <= bands.count, "bands are judged");
        const size_t row = (size_t)bands.part.region.width * 3;
        float *rgb = row <= FLOATS_MOST ? malloc(row * sizeof *rgb) : NULL;
        for (uint32_t y = 0; rgb && y < bands.part.region.height && y < 64; y++)
            bands_take(&bands, y, 1, rgb);
        free(rgb);
        bands_finish(&bands);
    } else {
        require(error.len > 0, "a checkpoint that cannot be opened has an error");
    }
    strbuf_finish(&error);
}

static uint64_t sum_of(const uint8_t *bytes, size_t size) {
    return xxh64_of(bytes, size, 0);
}

static void as_part(const uint8_t *data, size_t size) {
    uint8_t *copy = malloc(size + SEAL_BYTES);
    if (!copy)
        abort();
    memcpy(copy, data, size);
    for (int i = 0; i < SEAL_BYTES; i++)
        copy[size + (size_t)i] = (uint8_t)(sum_of(data, size) >> (8 * i));
    read_as_part(fuzz_file(copy, size + SEAL_BYTES), copy, size + SEAL_BYTES);
    free(copy);
}

// What is before the first NUL byte is the head, which has a size of its own; what follows are bands.
static void as_bands(const uint8_t *data, size_t size) {
    const uint8_t *nul = memchr(data, 0, size);
    const size_t head = nul ? (size_t)(nul - data) : size, rest = nul ? size - head - 1 : 0;
    char line[32];
    if (head + sizeof line > BANDS_HEAD_BYTES)
        return;
    uint8_t *copy = malloc(BANDS_HEAD_BYTES + rest);
    if (!copy)
        abort();
    memset(copy, '\n', BANDS_HEAD_BYTES);
    memcpy(copy, data, head);
    snprintf(line, sizeof line, "seal %016" PRIx64, sum_of(data, head));
    memcpy(copy + head, line, strlen(line));
    if (rest)
        memcpy(copy + BANDS_HEAD_BYTES, nul + 1, rest);
    read_as_bands(fuzz_file(copy, BANDS_HEAD_BYTES + rest));
    free(copy);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size == 0)
        return 0;
    as_part(data, size);
    as_bands(data, size);
    return 0;
}
