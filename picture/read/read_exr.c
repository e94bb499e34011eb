#include "picture/read/read_exr.h"

#include "core/heap.h"

#include <OpenEXR/openexr.h>
#include <math.h>
#include <stdlib.h>

enum {
    CHANNELS_MAX = 1024,
    SIDE_MAX = 1 << 24,
    COLORS = 3,
    BUFFERS = 4, // the library's buffers for a chunk: packed, unpacked and two for its work
    MEMORY_SLACK = 1 << 20,
    OFFSET_BYTES = 8, // of a chunk in the file's table
};

static const char damaged_header[] = "its header is damaged, or the file ends within it";
static const char damaged_pixels[] = "its pixels are damaged, or some are missing";

// ---- the library's access to the file and to memory

static int64_t on_read(exr_const_context_t context, void *user, void *to, uint64_t count, uint64_t at,
                       exr_stream_error_func_ptr_t on_error) {
    const str *bytes = user;
    (void)context;
    (void)on_error;
    if (at >= bytes->len)
        return 0;
    const uint64_t there = count < bytes->len - at ? count : bytes->len - at;
    memcpy(to, bytes->ptr + at, (size_t)there);
    return (int64_t)there;
}

static int64_t on_size(exr_const_context_t context, void *user) {
    (void)context;
    return (int64_t)((const str *)user)->len;
}

static void on_error(exr_const_context_t context, exr_result_t code, const char *message) {
    (void)context;
    (void)code;
    (void)message;
}

// Damaged chunks may not fill the memory that they are decoded into: the rest must not come from another
// file.
static void *on_alloc(size_t count) {
    return heap_zeroed(1, count);
}

static const char *fault_of(exr_result_t result, const char *damaged) {
    return result == EXR_ERR_SUCCESS ? NULL : result == EXR_ERR_OUT_OF_MEMORY ? picture_no_memory : damaged;
}

static const char *open_file(str *bytes, exr_context_t *out) {
    exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
    init.error_handler_fn = on_error;
    init.alloc_fn = on_alloc;
    init.free_fn = free;
    init.user_data = bytes;
    init.read_fn = on_read;
    init.size_fn = on_size;
    init.max_image_width = SIDE_MAX;
    init.max_image_height = SIDE_MAX;
    init.flags = EXR_CONTEXT_FLAG_SILENT_HEADER_PARSE | EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    *out = NULL;
    return fault_of(exr_start_read(out, "picture", &init), damaged_header);
}

// ---- the header

struct facts {
    exr_attr_box2i_t window;
    const exr_attr_chlist_t *channels;
    int color[COLORS]; // which channels they are
    int32_t lines;     // of a chunk
    uint64_t pixel_bytes;
};

static int channel_named(const exr_attr_chlist_t *channels, const char *name) {
    for (int i = 0; i < channels->num_channels; i++)
        if (strcmp(channels->entries[i].name.str, name) == 0)
            return i;
    return -1;
}

// R, G and B, or Y for all three.
static const char *find_colors(struct facts *facts) {
    static const char *const names[COLORS] = {"R", "G", "B"};
    const exr_attr_chlist_t *channels = facts->channels;
    const int grey = channel_named(channels, "Y");
    if (channels->num_channels > CHANNELS_MAX)
        return "it has more than 1024 channels";
    for (int k = 0; k < COLORS; k++) {
        const int named = channel_named(channels, names[k]);
        facts->color[k] = named >= 0 ? named : grey;
        if (facts->color[k] < 0)
            return "it has no channels R, G and B, and no channel Y";
    }
    if (facts->color[0] != grey && (facts->color[1] == grey || facts->color[2] == grey))
        return "it has no channels R, G and B, and no channel Y";
    facts->pixel_bytes = 0;
    for (int i = 0; i < channels->num_channels; i++) {
        const exr_attr_chlist_entry_t *c = &channels->entries[i];
        if (c->x_sampling != 1 || c->y_sampling != 1)
            return "it has channels of fewer samples than pixels, which are not supported";
        facts->pixel_bytes += c->pixel_type == EXR_PIXEL_HALF ? 2 : 4;
    }
    for (int k = 0; k < COLORS; k++)
        if (channels->entries[facts->color[k]].pixel_type == EXR_PIXEL_UINT)
            return "its colours are whole numbers; half and float are read";
    return NULL;
}

static const char *check_form(exr_const_context_t file) {
    int parts = 0;
    exr_storage_t storage = EXR_STORAGE_LAST_TYPE;
    exr_compression_t compression = EXR_COMPRESSION_LAST_TYPE;
    if (exr_get_count(file, &parts) != EXR_ERR_SUCCESS || parts < 1 ||
        exr_get_storage(file, 0, &storage) != EXR_ERR_SUCCESS ||
        exr_get_compression(file, 0, &compression) != EXR_ERR_SUCCESS)
        return damaged_header;
    return parts > 1                         ? "it has several parts; one is read"
           : storage == EXR_STORAGE_TILED    ? "it is tiled; save it with scan lines"
           : storage != EXR_STORAGE_SCANLINE ? "it is deep; flatten it, and save it with scan lines"
           : compression > EXR_COMPRESSION_PIZ
               ? "its compression is none of those that are read: none, RLE, ZIP and PIZ"
               : NULL;
}

static const char *read_window(exr_const_context_t file, struct facts *facts, struct picture_header *out) {
    const exr_attr_box2i_t *w = &facts->window;
    if (exr_get_data_window(file, 0, &facts->window) != EXR_ERR_SUCCESS || w->max.x < w->min.x ||
        w->max.y < w->min.y)
        return damaged_header;
    const int64_t width = (int64_t)w->max.x - w->min.x + 1, height = (int64_t)w->max.y - w->min.y + 1;
    if (width > SIDE_MAX || height > SIDE_MAX)
        return "its width or height is beyond 16777216";
    out->width = (uint32_t)width;
    out->height = (uint32_t)height;
    return NULL;
}

static const char *name_ignored(bool channels, bool attributes, bool negative) {
    static const char *const names[] = {
        NULL,
        "channels other than its colours are",
        "display window or chromaticities are",
        "display window or chromaticities, and other channels are",
        "negative values are",
        "negative values, and channels other than its colours are",
        "negative values, and display window or chromaticities are",
        "negative values, display window or chromaticities, and other channels are"};
    return names[channels | attributes << 1 | negative << 2];
}

static bool has_more_attributes(exr_const_context_t file, const struct facts *facts) {
    exr_attr_box2i_t display;
    const exr_attribute_t *found = NULL;
    const bool same = exr_get_display_window(file, 0, &display) == EXR_ERR_SUCCESS &&
                      memcmp(&display, &facts->window, sizeof display) == 0;
    return !same || exr_get_attribute_by_name(file, 0, "chromaticities", &found) == EXR_ERR_SUCCESS;
}

// Every chunk of rows is within the file.
static const char *check_chunks(exr_const_context_t file, str bytes, const struct facts *facts) {
    const int64_t height = (int64_t)facts->window.max.y - facts->window.min.y + 1;
    if ((uint64_t)((height + facts->lines - 1) / facts->lines) > bytes.len / OFFSET_BYTES)
        return "the file ends before its last pixel";
    for (int64_t y = facts->window.min.y; y <= facts->window.max.y; y += facts->lines) {
        exr_chunk_info_t chunk;
        const exr_result_t result = exr_read_scanline_chunk_info(file, 0, (int)y, &chunk);
        if (result != EXR_ERR_SUCCESS)
            return fault_of(result, damaged_pixels);
        if (chunk.data_offset > bytes.len || chunk.packed_size > bytes.len - chunk.data_offset)
            return "the file ends before its last pixel";
    }
    return NULL;
}

static const char *read_facts(exr_const_context_t file, struct facts *facts, struct picture_header *out) {
    const char *fault = check_form(file);
    if (!fault)
        fault = read_window(file, facts, out);
    if (!fault &&
        (exr_get_channels(file, 0, &facts->channels) != EXR_ERR_SUCCESS ||
         exr_get_scanlines_per_chunk(file, 0, &facts->lines) != EXR_ERR_SUCCESS || facts->lines < 1))
        fault = damaged_header;
    return fault ? fault : find_colors(facts);
}

const char *picture_exr_header(str bytes, struct picture_header *out) {
    exr_context_t file;
    struct facts facts;
    const char *fault = open_file(&bytes, &file);
    if (!fault)
        fault = read_facts(file, &facts, out);
    if (!fault) {
        const uint64_t chunk =
            (uint64_t)facts.lines * out->width * (facts.pixel_bytes + COLORS * sizeof(float));
        out->decoder_bytes = BUFFERS * chunk + MEMORY_SLACK;
        out->ignored =
            name_ignored(facts.channels->num_channels > (facts.color[0] == facts.color[1] ? 1 : COLORS),
                         has_more_attributes(file, &facts), false);
        fault = check_chunks(file, bytes, &facts);
    }
    exr_finish(&file);
    return fault;
}

// ---- pixels

struct decoding {
    exr_context_t file;
    struct facts facts;
    uint32_t width;
    float *lines; // of one chunk
    bool is_negative;
};

static void place_channels(const struct decoding *d, exr_decode_pipeline_t *pipeline) {
    for (int16_t i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *c = &pipeline->channels[i];
        c->decode_to_ptr = NULL;
        for (int k = COLORS - 1; k >= 0; k--)
            if (d->facts.color[k] == i) {
                c->decode_to_ptr = (uint8_t *)(d->lines + k);
                c->user_bytes_per_element = sizeof(float);
                c->user_data_type = EXR_PIXEL_FLOAT;
                c->user_pixel_stride = COLORS * sizeof(float);
                c->user_line_stride = (int32_t)(d->width * COLORS * sizeof(float));
            }
    }
}

static const char *decode_chunk(struct decoding *d, int y) {
    exr_chunk_info_t chunk;
    exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
    exr_result_t result = exr_read_scanline_chunk_info(d->file, 0, y, &chunk);
    if (result == EXR_ERR_SUCCESS)
        result = exr_decoding_initialize(d->file, 0, &chunk, &pipeline);
    if (result != EXR_ERR_SUCCESS)
        return fault_of(result, damaged_pixels);
    place_channels(d, &pipeline);
    memset(d->lines, 0, (size_t)d->facts.lines * d->width * COLORS * sizeof *d->lines);
    result = exr_decoding_choose_default_routines(d->file, 0, &pipeline);
    if (result == EXR_ERR_SUCCESS)
        result = exr_decoding_run(d->file, 0, &pipeline);
    exr_decoding_destroy(d->file, &pipeline);
    return fault_of(result, damaged_pixels);
}

// Copies one row of a chunk to where it is kept.
static const char *take_row(struct decoding *d, const float *from, unsigned char *to) {
    const bool is_grey = d->facts.color[0] == d->facts.color[1];
    for (size_t i = 0; i < (size_t)COLORS * d->width; i++) {
        float value = from[is_grey ? i - i % COLORS : i];
        if (!isfinite(value))
            return "a pixel of it is infinite or not a number";
        d->is_negative |= value < 0;
        value = value > 0 ? value : 0;
        memcpy(to + i * sizeof value, &value, sizeof value);
    }
    return NULL;
}

static const char *decode_all(struct decoding *d, struct picture_rows rows) {
    const exr_attr_box2i_t *w = &d->facts.window;
    const char *fault = NULL;
    for (int64_t y = w->min.y; y <= w->max.y && !fault; y += d->facts.lines) {
        fault = decode_chunk(d, (int)y);
        for (int64_t k = 0; k < d->facts.lines && y + k <= w->max.y && !fault; k++)
            fault = take_row(d, d->lines + (size_t)k * COLORS * d->width,
                             picture_row(&rows, (uint32_t)(y + k - w->min.y)));
    }
    return fault;
}

const char *picture_exr_rows(str bytes, struct picture_header *header, struct picture_rows rows) {
    struct decoding d = {0};
    struct picture_header again = {0};
    const char *fault = open_file(&bytes, &d.file);
    if (!fault)
        fault = read_facts(d.file, &d.facts, &again);
    if (!fault) {
        d.width = again.width;
        d.lines = heap_zeroed(heap_times((uint32_t)d.facts.lines, d.width), sizeof(float[COLORS]));
        fault = d.lines ? decode_all(&d, rows) : picture_no_memory;
    }
    if (!fault && d.is_negative)
        header->ignored =
            name_ignored(d.facts.channels->num_channels > (d.facts.color[0] == d.facts.color[1] ? 1 : COLORS),
                         has_more_attributes(d.file, &d.facts), true);
    free(d.lines);
    exr_finish(&d.file);
    return fault;
}
