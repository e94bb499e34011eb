#include "picture/write/exr_file.h"

#include "core/heap.h"
#include "core/parallel.h"
#include "picture/write/image.h"

#include <OpenEXR/openexr.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum {
    ZIP_LEVEL = 4,
};

// ---- the library's way to the file

static int64_t on_write(exr_const_context_t context, void *user, const void *bytes, uint64_t count,
                        uint64_t at, exr_stream_error_func_ptr_t on_error) {
    struct strbuf *out = user;
    (void)context;
    (void)on_error;
    while (out->len < at && !out->failed)
        strbuf_char(out, '\0');
    if (out->failed)
        return -1;
    // The table of chunks is written again once it is known.
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
    struct chunk *chunks;
    atomic_bool failed;
};

static const struct exr_channel *channel_named(const struct exr_file *file, const char *name) {
    for (uint32_t i = 0; i < file->channel_count; i++)
        if (strcmp(file->channels[i].name, name) == 0)
            return &file->channels[i];
    return NULL;
}

static void place_channels(const struct exr_file *file, exr_encode_pipeline_t *pipeline) {
    for (int16_t i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *c = &pipeline->channels[i];
        const struct exr_channel *from = channel_named(file, c->channel_name);
        c->user_bytes_per_element = 4;
        c->user_data_type = from->type == EXR_TYPE_UINT ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT;
        c->user_pixel_stride = from->step_bytes;
        c->user_line_stride = (int32_t)file->width * from->step_bytes;
        c->encode_from_ptr = (const uint8_t *)from->first +
                             (size_t)pipeline->chunk.start_y * file->width * (size_t)from->step_bytes;
    }
}

// Called when a chunk is compressed and is to wait for those before it: it is kept and its pipeline ended,
// and all are written in their order later.
static exr_result_t keep(exr_encode_pipeline_t *pipeline) {
    struct chunk *chunk = pipeline->encoding_user_data;
    chunk->count = pipeline->compressed_bytes;
    chunk->bytes = heap_alloc(chunk->count ? chunk->count : 1);
    if (chunk->bytes)
        memcpy(chunk->bytes, pipeline->compressed_buffer, chunk->count);
    return EXR_ERR_UNKNOWN;
}

// The library says it only of the chunk that is to be written next.
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
    place_channels(e->file, &pipeline);
    result = exr_encoding_choose_default_routines(e->context, 0, &pipeline);
    pipeline.encoding_user_data = &e->chunks[i];
    pipeline.yield_until_ready_fn = keep;
    if (result == EXR_ERR_SUCCESS)
        exr_encoding_run(e->context, 0, &pipeline);
    exr_encoding_destroy(e->context, &pipeline);
    return e->chunks[i].bytes != NULL;
}

static void encode_chunks(void *context, size_t begin, size_t end) {
    struct encoding *e = context;
    for (size_t i = begin; i < end; i++)
        if (!encode_chunk(e, i))
            e->failed = true;
}

static bool write_chunks(struct encoding *e) {
    const size_t count = (e->file->height + (uint32_t)e->lines - 1) / (uint32_t)e->lines;
    e->chunks = heap_zeroed(count, sizeof *e->chunks);
    if (!e->chunks || exr_write_scanline_chunk_info(e->context, 0, 0, &e->first) != EXR_ERR_SUCCESS) {
        free(e->chunks);
        return false;
    }
    parallel_for(count, 1, encode_chunks, e);
    bool good = !e->failed;
    for (size_t i = 0; i < count; i++) {
        good = good && exr_write_scanline_chunk(e->context, 0, (int)i * e->lines, e->chunks[i].bytes,
                                                e->chunks[i].count) == EXR_ERR_SUCCESS;
        free(e->chunks[i].bytes);
    }
    free(e->chunks);
    return good;
}

void exr_file_write(const struct exr_file *file, struct strbuf *out) {
    exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
    struct encoding e = {.file = file};
    init.error_handler_fn = on_error;
    init.alloc_fn = heap_alloc;
    init.free_fn = free;
    init.user_data = out;
    init.write_fn = on_write;
    init.zip_level = ZIP_LEVEL;
    const bool begun =
        exr_start_write(&e.context, "picture", EXR_WRITE_FILE_DIRECTLY, &init) == EXR_ERR_SUCCESS;
    const bool written = begun && write_head(e.context, file) == EXR_ERR_SUCCESS &&
                         exr_get_scanlines_per_chunk(e.context, 0, &e.lines) == EXR_ERR_SUCCESS &&
                         write_chunks(&e);
    const bool ended = begun && exr_finish(&e.context) == EXR_ERR_SUCCESS;
    if (!written || !ended)
        heap_exhausted(0); // all else is right: what the library asks of zlib and the system has failed
    out->failed |= !written || !ended;
}
