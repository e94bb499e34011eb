#include "picture/write/png_data.h"

#include "core/heap.h"
#include "core/parallel.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <zlib.h>

enum {
    PIECE = PNG_PIECE,
    WINDOW = PNG_WINDOW,
    LEVEL = 4,  // with the settings below; docs/decisions/png.md
    MEMORY = 9, // zlib's own settings: the most,
    RAW = -15,  // and a stream without header
    FLUSH = 16, // more bytes than the end of a piece takes
};

// How deflate looks for matches (zlib.h, deflateTune).
enum {
    GOOD = 8,
    LAZY = 8,
    NICE = 258,
    CHAIN = 16
};

struct deflating {
    const uint8_t *filtered;
    struct png_data *data;
    bool is_last; // the stream ends with them
    atomic_bool failed;
};

static voidpf on_alloc(voidpf opaque, uInt count, uInt size) {
    (void)opaque;
    return heap_array(count, size);
}

static void on_free(voidpf opaque, voidpf memory) {
    (void)opaque;
    free(memory);
}

// The stream is open.
static bool deflate_piece(z_stream *stream, const uint8_t *filtered, bool is_last, struct png_piece *piece) {
    const size_t count = piece->end - piece->from, before = piece->from < WINDOW ? piece->from : WINDOW;
    const size_t room = deflateBound(stream, count) + FLUSH;
    piece->bytes = heap_alloc(room);
    if (!piece->bytes || deflateTune(stream, GOOD, LAZY, NICE, CHAIN) != Z_OK ||
        (before && deflateSetDictionary(stream, filtered + piece->from - before, (uInt)before) != Z_OK))
        return false;
    stream->next_in = (Bytef *)(filtered + piece->from);
    stream->avail_in = (uInt)count;
    stream->next_out = piece->bytes;
    stream->avail_out = (uInt)room;
    const int status = deflate(stream, is_last ? Z_FINISH : Z_SYNC_FLUSH);
    piece->count = room - stream->avail_out;
    piece->sum = adler32(1, filtered + piece->from, (uInt)count);
    return is_last ? status == Z_STREAM_END : status == Z_OK && stream->avail_out > 0;
}

static void deflate_pieces(void *context, size_t begin, size_t end) {
    struct deflating *d = context;
    for (size_t i = begin; i < end; i++) {
        z_stream stream = {.zalloc = on_alloc, .zfree = on_free};
        if (deflateInit2(&stream, LEVEL, Z_DEFLATED, RAW, MEMORY, Z_FILTERED) != Z_OK) {
            d->failed = true;
            return;
        }
        if (!deflate_piece(&stream, d->filtered, d->is_last && i + 1 == d->data->count, &d->data->pieces[i]))
            d->failed = true;
        deflateEnd(&stream);
    }
}

bool png_data_deflate(const uint8_t *filtered, size_t before, size_t size, bool is_last,
                      struct png_data *out) {
    const size_t count = (size + PIECE - 1) / PIECE;
    *out = (struct png_data){0};
    out->pieces = heap_zeroed(count, sizeof *out->pieces);
    if (!out->pieces)
        return false;
    out->count = count;
    for (size_t i = 0; i < count; i++) {
        out->pieces[i].from = before + i * PIECE;
        out->pieces[i].end = before + (i + 1 < count ? (i + 1) * PIECE : size);
    }
    struct deflating d = {.filtered = filtered, .data = out, .is_last = is_last};
    parallel_for(count, 1, deflate_pieces, &d);
    return !d.failed;
}

bool png_data_make(uint32_t width, uint32_t height, uint32_t pixel, const uint8_t *rgb,
                   struct png_data *out) {
    *out = (struct png_data){0};
    const size_t size = heap_times(heap_times(pixel, width) + 1, height);
    uint8_t *filtered = heap_alloc(size);
    const bool made = filtered && png_filter_rows(width, height, pixel, rgb, NULL, filtered) &&
                      png_data_deflate(filtered, 0, size, true, out);
    free(filtered);
    return made;
}

void png_data_finish(struct png_data *data) {
    for (size_t i = 0; i < data->count; i++)
        free(data->pieces[i].bytes);
    free(data->pieces);
    *data = (struct png_data){0};
}
