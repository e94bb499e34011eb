#include "render/parts/bands.h"

#include "core/heap.h"
#include "core/xxh64.h"
#include "render/parts/parts.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    SEAL_BYTES = 8,
    READ_BYTES = 1 << 20, // at a time, when bands are judged
};

static const char kind[] = "checkpoint";

static size_t row_bytes(const struct bands *bands) {
    return heap_times(bands->part.region.width, 3 * sizeof(float));
}

// Where a band begins; for bands->count, the most where the last one can end.
static uint64_t place_of(const struct bands *bands, uint32_t band) {
    const uint64_t bytes = (uint64_t)row_bytes(bands) * bands->rows + sizeof *bands->faults + SEAL_BYTES;
    return BANDS_HEAD_BYTES + band * bytes;
}

uint32_t bands_begin(const struct bands *bands, uint32_t band) {
    return band * bands->rows;
}

uint32_t bands_rows(const struct bands *bands, uint32_t band) {
    const uint32_t left = bands->part.region.height - bands_begin(bands, band);
    return left < bands->rows ? left : bands->rows;
}

static bool prepare(struct bands *bands, uint32_t rows) {
    const uint32_t height = bands->part.region.height;
    bands->rows = rows < height ? rows : height;
    bands->count = (height + bands->rows - 1) / bands->rows;
    bands->done = heap_zeroed(bands->count, sizeof *bands->done);
    bands->faults = heap_zeroed(bands->count, sizeof *bands->faults);
    return bands->done && bands->faults;
}

static void put_head(const struct bands *bands, struct strbuf *out) {
    part_put_head(&bands->part, kind, out);
    strbuf_format(out, "bands %u\n", bands->rows);
    strbuf_format(out, "seal %016" PRIx64 "\n", out->failed ? 0 : xxh64_of(out->data, out->len, 0));
    while (out->len < BANDS_HEAD_BYTES && !out->failed)
        strbuf_char(out, '\n');
}

bool bands_create(struct bands *bands, const char *path, const struct part *part, uint32_t rows,
                  struct strbuf *error) {
    struct strbuf head;
    *bands = (struct bands){.part = *part, .is_judged = true, .spool.fd = -1};
    bands->part.rgb = NULL;
    strbuf_init(&head);
    bool made = prepare(bands, rows);
    if (made)
        put_head(bands, &head);
    made = made && !head.failed;
    if (made && !spool_create(&bands->spool, path, head.data, head.len)) {
        strbuf_format(error, "cannot be written: %s", strerror(bands->spool.error));
        made = false;
    }
    strbuf_finish(&head);
    if (!made)
        bands_finish(bands);
    return made;
}

// ---- a file that is there

static bool take_head(struct bands *bands, char *text) {
    char *at = text, *seal;
    uint32_t rows;
    uint64_t sum;
    struct strbuf again;
    if (!part_take_head(&at, kind, &bands->part) || !part_take_numbers(&at, "bands", &rows, 1) || rows == 0)
        return false;
    seal = part_take_line(&at, "seal");
    if (!seal || sscanf(seal, "%16" SCNx64, &sum) != 1 || !prepare(bands, rows))
        return false;
    // Reading has changed the text, so what was read is written again to check the seal.
    strbuf_init(&again);
    part_put_head(&bands->part, kind, &again);
    strbuf_format(&again, "bands %u\n", rows);
    const bool good = !again.failed && xxh64_of(again.data, again.len, 0) == sum;
    strbuf_finish(&again);
    return good;
}

// Whether a band is whole; if so, *faults gets its faults.
static bool is_whole(struct bands *bands, uint32_t band, void *buffer, struct bands_faults *faults) {
    uint64_t at = place_of(bands, band), sum;
    size_t left = row_bytes(bands) * bands_rows(bands, band);
    struct xxh64 hash;
    xxh64_begin(&hash, band);
    while (left) {
        const size_t count = left < READ_BYTES ? left : READ_BYTES;
        if (!spool_take(&bands->spool, at, buffer, count))
            return false;
        xxh64_add(&hash, buffer, count);
        at += count;
        left -= count;
    }
    if (!spool_take(&bands->spool, at, faults, sizeof *faults) ||
        !spool_take(&bands->spool, at + sizeof *faults, &sum, sizeof sum))
        return false;
    xxh64_add(&hash, faults, sizeof *faults);
    return xxh64_end(&hash) == sum;
}

static void judge(struct bands *bands, void *buffer, bool (*goes_on)(void *context), void *context) {
    uint32_t i = 0;
    for (; i < bands->count && (!goes_on || goes_on(context)); i++) {
        bands->done[i] = is_whole(bands, i, buffer, &bands->faults[i]);
        bands->done_count += bands->done[i];
        if (!bands->done[i])
            bands->faults[i] = (struct bands_faults){0};
    }
    bands->is_judged = i == bands->count;
}

bool bands_open(struct bands *bands, const char *path, bool (*goes_on)(void *context), void *context,
                bool *missing, struct strbuf *error) {
    *bands = (struct bands){.spool.fd = -1};
    *missing = false;
    if (!spool_open(&bands->spool, path)) {
        *missing = bands->spool.error == ENOENT;
        strbuf_format(error, "cannot be read: %s", strerror(bands->spool.error));
        return false;
    }
    char *buffer = heap_alloc(READ_BYTES);
    bool good = buffer != NULL;
    if (good) {
        buffer[BANDS_HEAD_BYTES] = '\0';
        good = spool_take(&bands->spool, 0, buffer, BANDS_HEAD_BYTES) && take_head(bands, buffer);
        if (good)
            judge(bands, buffer, goes_on, context);
        else if (bands->spool.error)
            strbuf_format(error, "cannot be read: %s", strerror(bands->spool.error));
        else
            strbuf_cstr(error, "is not a checkpoint of this version of glint");
    }
    free(buffer);
    if (!good)
        bands_finish(bands);
    return good;
}

const char *bands_difference(const struct bands *bands, const struct part *part) {
    const struct part_region *a = &bands->part.region, *b = &part->region;
    const char *words = parts_difference(&bands->part, part);
    if (words)
        return words;
    if (a->x != b->x || a->y != b->y || a->width != b->width || a->height != b->height)
        return "is of another part of the picture than";
    return NULL;
}

// ---- bands

bool bands_put(struct bands *bands, uint32_t band, const float *rgb, const struct bands_faults *faults) {
    const size_t count = row_bytes(bands) * bands_rows(bands, band);
    const uint64_t at = place_of(bands, band);
    struct xxh64 hash;
    xxh64_begin(&hash, band);
    xxh64_add(&hash, rgb, count);
    xxh64_add(&hash, faults, sizeof *faults);
    const uint64_t sum = xxh64_end(&hash);
    if (!spool_put(&bands->spool, at, rgb, count) ||
        !spool_put(&bands->spool, at + count, faults, sizeof *faults) ||
        !spool_put(&bands->spool, at + count + sizeof *faults, &sum, sizeof sum))
        return false;
    bands->faults[band] = *faults;
    bands->done_count += !bands->done[band];
    bands->done[band] = true;
    return true;
}

bool bands_take(struct bands *bands, uint32_t y, uint32_t count, float *rgb) {
    const size_t row = row_bytes(bands);
    for (uint32_t end = y + count; y < end;) {
        const uint32_t band = y / bands->rows, into = y - bands_begin(bands, band);
        const uint32_t left = bands_rows(bands, band) - into, some = left < end - y ? left : end - y;
        if (!bands->done[band])
            memset(rgb, 0, some * row);
        else if (!spool_take(&bands->spool, place_of(bands, band) + into * row, rgb, some * row))
            return false;
        rgb += some * row / sizeof *rgb;
        y += some;
    }
    return true;
}

void bands_finish(struct bands *bands) {
    spool_close(&bands->spool);
    free(bands->done);
    free(bands->faults);
    bands->done = NULL;
    bands->faults = NULL;
}

void bands_remove(struct bands *bands) {
    spool_remove(&bands->spool);
    bands_finish(bands);
}
