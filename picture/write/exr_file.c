#include "picture/write/exr_file.h"

#include "core/heap.h"
#include "core/parallel.h"
#include "picture/write/rows.h"

#include <OpenEXR/openexr.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum {
    ZIP_LEVEL = 4,
};

// ---- the library's access to the file

struct target {
    struct strbuf *out;
    const struct image_sink *sink; // NULL: memory
    uint64_t written;              // to the sink
    bool failed;                   // the sink failed, or the source of rows did
};

static bool put_zeros(struct target *target, uint64_t end) {
    static const uint8_t zeros[256];
    bool good = true;
    while (good && target->written < end) {
        const uint64_t left = end - target->written, count = left < sizeof zeros ? left : sizeof zeros;
        good = target->sink->put(target->sink->context, zeros, (size_t)count);
        target->written += count;
    }
    return good;
}

// The chunk table is skipped at first, and filled in once it is known.
static int64_t put_to_sink(struct target *target, const void *bytes, uint64_t count, uint64_t at) {
    const struct image_sink *sink = target->sink;
    bool good = put_zeros(target, at);
    const uint64_t over = target->written - at < count ? target->written - at : count;
    if (good && over)
        good = sink->put_over(sink->context, at, bytes, (size_t)over);
    if (good && over < count)
        good = sink->put(sink->context, (const char *)bytes + over, (size_t)(count - over));
    target->written += count - over;
    target->failed |= !good;
    return good ? (int64_t)count : -1;
}

static int64_t on_write(exr_const_context_t context, void *user, const void *bytes, uint64_t count,
                        uint64_t at, exr_stream_error_func_ptr_t on_error) {
    struct target *target = user;
    struct strbuf *out = target->out;
    (void)context;
    (void)on_error;
    if (target->sink)
        return put_to_sink(target, bytes, count, at);
    while (out->len < at && !out->failed)
        strbuf_char(out, '\0');
    if (out->failed)
        return -1;
    // The chunk table is written again once it is known.
    const size_t over = out->len - (size_t)at < count ? out->len - (size_t)at : (size_t)count;
    if (over)
        memcpy(out->data + at, bytes, over);
    strbuf_add(out, (const char *)bytes + over, (size_t)count - over);
    return out->failed ? -1 : (int64_t)count;
}

static void on_error(exr_const_context_t context, exr_result_t code, const char *message) {
    (void)context;
    (void)code;
    (void)message;
}

// ---- the head

static exr_result_t add_channels(exr_context_t context, const struct exr_file *file) {
    static const exr_pixel_type_t types[] = {[EXR_TYPE_UINT] = EXR_PIXEL_UINT,
                                             [EXR_TYPE_HALF] = EXR_PIXEL_HALF,
                                             [EXR_TYPE_FLOAT] = EXR_PIXEL_FLOAT};
    exr_result_t result = EXR_ERR_SUCCESS;
    for (uint32_t i = 0; i < file->channel_count && result == EXR_ERR_SUCCESS; i++)
        result = exr_add_channel(context, 0, file->channels[i].name, types[file->channels[i].type],
                                 EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    return result;
}

static exr_result_t write_head(exr_context_t context, const struct exr_file *file) {
    static const exr_compression_t compressions[] = {[IMAGE_ZIP] = EXR_COMPRESSION_ZIP,
                                                     [IMAGE_PIZ] = EXR_COMPRESSION_PIZ,
                                                     [IMAGE_UNCOMPRESSED] = EXR_COMPRESSION_NONE};
    int part = 0;
    exr_result_t result = exr_add_part(context, NULL, EXR_STORAGE_SCANLINE, &part);
    if (result == EXR_ERR_SUCCESS)
        result = exr_initialize_required_attr_simple(context, part, (int32_t)file->width,
                                                     (int32_t)file->height, compressions[file->compression]);
    if (result == EXR_ERR_SUCCESS)
        result = add_channels(context, file);
    for (uint32_t i = 0; i < file->attribute_count && result == EXR_ERR_SUCCESS; i++)
        result = exr_attr_set_string(context, part, file->attributes[i].name, file->attributes[i].text);
    return result == EXR_ERR_SUCCESS ? exr_write_header(context) : result;
}

// ---- chunks of rows

struct chunk {
    void *bytes;
    uint64_t count;
};

struct encoding {
    exr_context_t context;
    const struct exr_file *file;
    int32_t lines;
    exr_chunk_info_t first;
    struct chunk *chunks; // the chunks that are coded at once
    size_t first_chunk;
    float *rgb; // their rows; NULL: channels are in memory
    struct target target;
    atomic_bool failed;
};

static const struct exr_channel *channel_named(const struct exr_file *file, const char *name) {
    for (uint32_t i = 0; i < file->channel_count; i++)
        if (strcmp(file->channels[i].name, name) == 0)
            return &file->channels[i];
    return NULL;
}

// Where the channel's values of the chunk begin.
static const uint8_t *place_of(const struct encoding *e, const struct exr_channel *channel, int32_t row) {
    const size_t stride = e->file->width * (size_t)channel->step_bytes;
    if (!e->rgb)
        return (const uint8_t *)channel->first + (size_t)row * stride;
    const ptrdiff_t place = (const uint8_t *)channel->first - (const uint8_t *)e->file->channels->first;
    return (const uint8_t *)e->rgb + ((size_t)row - e->first_chunk * (size_t)e->lines) * stride + place;
}

static void place_channels(const struct encoding *e, exr_encode_pipeline_t *pipeline) {
    const struct exr_file *file = e->file;
    for (int16_t i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *c = &pipeline->channels[i];
        const struct exr_channel *from = channel_named(file, c->channel_name);
        c->user_bytes_per_element = 4;
        c->user_data_type = from->type == EXR_TYPE_UINT ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT;
        c->user_pixel_stride = from->step_bytes;
        c->user_line_stride = (int32_t)file->width * from->step_bytes;
        c->encode_from_ptr = place_of(e, from, pipeline->chunk.start_y);
    }
}

// Called when a chunk is compressed and must wait for those before it: it is kept, its pipeline ends, and all
// chunks are written in order later.
static exr_result_t keep(exr_encode_pipeline_t *pipeline) {
    struct chunk *chunk = pipeline->encoding_user_data;
    chunk->count = pipeline->compressed_bytes;
    chunk->bytes = heap_alloc(chunk->count ? chunk->count : 1);
    if (chunk->bytes)
        memcpy(chunk->bytes, pipeline->compressed_buffer, chunk->count);
    return EXR_ERR_UNKNOWN;
}

// The library only gives it for the chunk that is written next.
static exr_chunk_info_t info_of(const struct encoding *e, size_t i) {
    exr_chunk_info_t info = e->first;
    const uint32_t begin = (uint32_t)i * (uint32_t)e->lines, left = e->file->height - begin;
    info.idx = (int32_t)i;
    info.start_y = (int32_t)begin;
    info.height = left < (uint32_t)e->lines ? (int32_t)left : e->lines;
    info.unpacked_size = e->first.unpacked_size / (uint32_t)e->first.height * (uint32_t)info.height;
    return info;
}

static bool encode_chunk(struct encoding *e, size_t i) {
    const exr_chunk_info_t info = info_of(e, i);
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_result_t result = exr_encoding_initialize(e->context, 0, &info, &pipeline);
    if (result != EXR_ERR_SUCCESS)
        return false;
    place_channels(e, &pipeline);
    result = exr_encoding_choose_default_routines(e->context, 0, &pipeline);
    struct chunk *chunk = &e->chunks[i - e->first_chunk];
    pipeline.encoding_user_data = chunk;
    pipeline.yield_until_ready_fn = keep;
    if (result == EXR_ERR_SUCCESS)
        exr_encoding_run(e->context, 0, &pipeline);
    exr_encoding_destroy(e->context, &pipeline);
    return chunk->bytes != NULL;
}

static void encode_chunks(void *context, size_t begin, size_t end) {
    struct encoding *e = context;
    for (size_t i = e->first_chunk + begin; i < e->first_chunk + end; i++)
        if (!encode_chunk(e, i))
            e->failed = true;
}

static bool take_rows(struct encoding *e, size_t count) {
    const struct image_rows *rows = e->file->rows;
    const uint32_t y = (uint32_t)e->first_chunk * (uint32_t)e->lines, left = e->file->height - y;
    const uint32_t wanted = (uint32_t)count * (uint32_t)e->lines;
    const bool taken = !rows || rows->take(rows->context, y, wanted < left ? wanted : left, e->rgb);
    e->target.failed |= !taken;
    return taken;
}

// `count` chunks from e->first_chunk on, coded in parallel and written in order.
static bool write_some(struct encoding *e, size_t count) {
    if (!take_rows(e, count))
        return false;
    parallel_for(count, 1, encode_chunks, e);
    bool good = !e->failed;
    for (size_t i = 0; i < count; i++) {
        good = good && exr_write_scanline_chunk(e->context, 0, (int)(e->first_chunk + i) * e->lines,
                                                e->chunks[i].bytes, e->chunks[i].count) == EXR_ERR_SUCCESS;
        free(e->chunks[i].bytes);
        e->chunks[i] = (struct chunk){0};
    }
    return good;
}

// As many chunks as are coded at once.
static size_t chunks_at_once(const struct encoding *e, size_t all) {
    const size_t bytes = (size_t)e->file->width * (size_t)e->lines * 3 * sizeof *e->rgb;
    const size_t fit = bytes < IMAGE_ROWS_BYTES ? IMAGE_ROWS_BYTES / bytes : 1;
    const size_t least = parallel_processors(), some = fit > least ? fit : least;
    return !e->file->rows || some > all ? all : some;
}

static bool write_chunks(struct encoding *e) {
    const size_t count = (e->file->height + (uint32_t)e->lines - 1) / (uint32_t)e->lines;
    const size_t most = chunks_at_once(e, count), rows = heap_times(most, (uint32_t)e->lines);
    e->chunks = heap_zeroed(most, sizeof *e->chunks);
    e->rgb = e->file->rows ? heap_array(heap_times(rows, e->file->width), 3 * sizeof *e->rgb) : NULL;
    bool good = e->chunks && (e->rgb || !e->file->rows) &&
                exr_write_scanline_chunk_info(e->context, 0, 0, &e->first) == EXR_ERR_SUCCESS;
    while (good && e->first_chunk < count) {
        const size_t left = count - e->first_chunk, some = left < most ? left : most;
        good = write_some(e, some);
        e->first_chunk += some;
    }
    free(e->rgb);
    free(e->chunks);
    return good;
}

void exr_file_write(const struct exr_file *file, struct strbuf *out) {
    exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
    struct encoding e = {.file = file, .target = {.out = out, .sink = file->sink}};
    init.error_handler_fn = on_error;
    init.alloc_fn = heap_alloc;
    init.free_fn = free;
    init.user_data = &e.target;
    init.write_fn = on_write;
    init.zip_level = ZIP_LEVEL;
    const bool begun =
        exr_start_write(&e.context, "picture", EXR_WRITE_FILE_DIRECTLY, &init) == EXR_ERR_SUCCESS;
    const bool written = begun && write_head(e.context, file) == EXR_ERR_SUCCESS &&
                         exr_get_scanlines_per_chunk(e.context, 0, &e.lines) == EXR_ERR_SUCCESS &&
                         write_chunks(&e);
    const bool ended = begun && exr_finish(&e.context) == EXR_ERR_SUCCESS;
    if ((!written || !ended) && !e.target.failed)
        heap_exhausted(0); // everything else is valid: an allocation in the library or zlib has failed
    out->failed |= !written || !ended;
}
