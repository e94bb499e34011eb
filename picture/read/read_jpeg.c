#include "picture/read/read_jpeg.h"

#include "core/heap.h"
#include "picture/read/jpeg_blocks.h"

#include <errno.h>
#include <limits.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#include <jerror.h>

enum marker {
    MARKER_SOF0 = 0xC0,
    MARKER_SOF2 = 0xC2,
    MARKER_DHT = 0xC4,
    MARKER_JPG = 0xC8,
    MARKER_DAC = 0xCC,
    MARKER_SOF15 = 0xCF,
    MARKER_RST0 = 0xD0,
    MARKER_RST7 = 0xD7,
    MARKER_SOI = 0xD8,
    MARKER_EOI = 0xD9,
    MARKER_SOS = 0xDA,
    MARKER_APP2 = 0xE2,
};

enum {
    COMPONENTS_MAX = 4,
    SCANS_MAX = 500, // each scan passes over the whole picture, however few bytes it has
    FACTOR_MAX = 4,  // of sampling
    BLOCK = 8,       // samples along its side
    BLOCK_BYTES = BLOCK * BLOCK * 2,
    BUDGET_SLACK = 16 << 20,
};

// ---- segments: all are there, and the frame's header has the size

struct walk {
    const unsigned char *data;
    size_t size;
    size_t at;
    unsigned scans;
    bool profile;
    uint32_t width, height; // 0: no frame yet
    bool progressive;
    struct {
        unsigned across, down; // samples of a component in a unit of them
    } factors[COMPONENTS_MAX];
    unsigned components;
    bool parted; // no scan has all components
};

struct segment {
    const unsigned char *data; // after the length
    size_t size;
};

static const char *read_frame(struct walk *w, struct segment s, unsigned marker) {
    if (marker > MARKER_SOF2)
        return "it is lossless, hierarchical or arithmetically coded; save it as baseline or progressive";
    if (w->width)
        return "it has two frames";
    if (s.size < 6 || s.size != 6 + 3 * (size_t)s.data[5])
        return "its frame header is damaged";
    if (s.data[0] != 8)
        return "it does not have 8 bits per channel";
    w->height = (uint32_t)s.data[1] << 8 | s.data[2];
    w->width = (uint32_t)s.data[3] << 8 | s.data[4];
    if (w->width == 0 || w->height == 0)
        return "its width or height is 0";
    w->components = s.data[5];
    if (w->components < 1 || w->components > COMPONENTS_MAX)
        return "it does not have 1 to 4 channels";
    for (unsigned i = 0; i < w->components; i++) {
        w->factors[i].across = s.data[7 + 3 * i] >> 4;
        w->factors[i].down = s.data[7 + 3 * i] & 15;
        if (w->factors[i].across < 1 || w->factors[i].across > FACTOR_MAX || w->factors[i].down < 1 ||
            w->factors[i].down > FACTOR_MAX)
            return "its frame header is damaged";
    }
    w->progressive = marker == MARKER_SOF2;
    return NULL;
}

// Moves to the marker after a scan's data; restart markers belong to the data, and 0 after 0xFF is not a
// marker.
static bool skip_scan_data(struct walk *w) {
    while (w->at + 1 < w->size) {
        const unsigned char *mark = memchr(w->data + w->at, 0xFF, w->size - 1 - w->at);
        if (!mark)
            return false;
        w->at = (size_t)(mark - w->data);
        if (mark[1] != 0 && mark[1] != 0xFF && !(mark[1] >= MARKER_RST0 && mark[1] <= MARKER_RST7))
            return true;
        w->at += mark[1] == 0xFF ? 1 : 2;
    }
    return false;
}

static const char *read_segment(struct walk *w, unsigned marker, struct segment s) {
    bool is_frame = marker >= MARKER_SOF0 && marker <= MARKER_SOF15 && marker != MARKER_DHT &&
                    marker != MARKER_JPG && marker != MARKER_DAC;
    if (is_frame)
        return read_frame(w, s, marker);
    if (marker == MARKER_SOS && w->width == 0)
        return "it has no frame header";
    if (marker == MARKER_SOS && ++w->scans > SCANS_MAX)
        return "it has more than 500 scans";
    if (marker == MARKER_SOS && w->scans == 1)
        w->parted = s.size > 0 && s.data[0] < w->components;
    w->profile |= marker == MARKER_APP2 && s.size >= 12 && memcmp(s.data, "ICC_PROFILE", 12) == 0;
    return NULL;
}

static const char *walk_file(struct walk *w) {
    for (;;) {
        while (w->at + 1 < w->size && w->data[w->at] == 0xFF && w->data[w->at + 1] == 0xFF)
            w->at++; // fill bytes
        if (w->size - w->at < 2)
            return w->scans ? "the file ends within the picture" : "the file ends before the picture";
        unsigned marker = w->data[w->at + 1];
        if (w->data[w->at] != 0xFF || marker == 0 || marker == MARKER_SOI)
            return "a marker is missing";
        if (marker == MARKER_EOI)
            return w->scans ? NULL : "it contains no picture";
        w->at += 2;
        if (w->size - w->at < 2)
            return "the file ends within a segment";
        size_t length = (size_t)w->data[w->at] << 8 | w->data[w->at + 1];
        if (length < 2 || length > w->size - w->at)
            return "the file ends within a segment";
        const char *fault = read_segment(w, marker, (struct segment){w->data + w->at + 2, length - 2});
        if (fault)
            return fault;
        w->at += length;
        if (marker == MARKER_SOS && !skip_scan_data(w))
            return "the file ends within the picture";
    }
}

static uint64_t rounded_up(uint64_t value, uint64_t step) {
    return (value + step - 1) / step * step;
}

// The size of all coefficients of a frame, two bytes each: kept for files whose scans have only a part of
// them. Counted in whole units of blocks, as the library does.
static uint64_t coefficient_bytes(const struct walk *w) {
    unsigned across_most = 1, down_most = 1;
    for (unsigned i = 0; i < w->components; i++) {
        across_most = w->factors[i].across > across_most ? w->factors[i].across : across_most;
        down_most = w->factors[i].down > down_most ? w->factors[i].down : down_most;
    }
    const uint64_t units_x = rounded_up(w->width, (uint64_t)across_most * BLOCK) / (across_most * BLOCK);
    const uint64_t units_y = rounded_up(w->height, (uint64_t)down_most * BLOCK) / (down_most * BLOCK);
    uint64_t bytes = 0;
    for (unsigned i = 0; i < w->components; i++)
        bytes += units_x * w->factors[i].across * units_y * w->factors[i].down * BLOCK_BYTES;
    return bytes;
}

const char *picture_jpeg_header(str bytes, struct picture_header *out) {
    struct walk w = {.data = (const unsigned char *)bytes.ptr, .size = bytes.len, .at = 2};
    const char *fault = walk_file(&w);
    out->width = w.width;
    out->height = w.height;
    out->ignored = w.profile ? "colour profile is" : NULL;
    out->decoder_bytes = BUDGET_SLACK + (w.progressive || w.parted ? coefficient_bytes(&w) : 0);
    return fault;
}

// ---- pixels, by libjpeg-turbo

struct job {
    struct jpeg_blocks blocks; // first: the decoder's client_data points to both
    struct jpeg_decompress_struct decoder;
    struct jpeg_error_mgr errors;
    jmp_buf jump;
    const struct picture_header *header;
    struct picture_rows rows;
    uint8_t *inks;     // a row of four channels, where the file has them
    const char *fault; // NULL: all went well
};

// Faults of a file that can be described better than as damage.
static const struct {
    int code;
    const char *fault;
} faults[] = {
    {JERR_OUT_OF_MEMORY, picture_no_memory},
    {JERR_NO_BACKING_STORE, "it has more data than a picture of its size needs"},
    {JERR_IMAGE_TOO_BIG, "its width or height is above 65500"},
    {JERR_CONVERSION_NOTIMPL, "it has two channels; save it with one or three"},
    {JERR_DHT_INDEX, "a Huffman table is damaged"},
    {JERR_BAD_HUFF_TABLE, "a Huffman table is damaged"},
    {JERR_DQT_INDEX, "a quantization table is damaged"},
    {JERR_BAD_LENGTH, "a segment has the wrong length"},
    {JERR_BAD_SAMPLING, "its frame header is damaged"},
    {JERR_BAD_COMPONENT_ID, "a scan header is damaged"},
    {JERR_BAD_PROGRESSION, "a scan header is damaged"},
    {JERR_NO_HUFF_TABLE, "a scan uses a table that the file does not have"},
    {JERR_NO_QUANT_TABLE, "a scan uses a table that the file does not have"},
    {JWRN_HIT_MARKER, "the data of a scan end too early"},
};

_Noreturn static void on_error(j_common_ptr decoder) {
    struct job *job = decoder->client_data;
    // The library also reports this for files that are too large for it.
    if (decoder->err->msg_code == JERR_OUT_OF_MEMORY && errno == ENOMEM)
        heap_exhausted(0);
    job->fault = "its pixels are damaged, or some are missing";
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++)
        if (faults[i].code == decoder->err->msg_code)
            job->fault = faults[i].fault;
    longjmp(job->jump, 1);
}

// Errors that the library would accept, with grey in place of lost data, are faults here. Not faults: bytes
// after a scan's data, and errors that do not affect a pixel.
static void on_message(j_common_ptr decoder, int level) {
    int code = decoder->err->msg_code;
    bool harmless = code == JWRN_EXTRANEOUS_DATA || code == JWRN_JFIF_MAJOR || code == JWRN_ADOBE_XFORM ||
                    code == JWRN_NOT_SEQUENTIAL;
    if (level < 0 && !harmless)
        on_error(decoder);
}

// Nothing is counted.
static void on_reset(j_common_ptr decoder) {
    decoder->err->msg_code = 0;
}

// Four channels come out as C, M, Y, K, which Adobe's programs store inverted; a file without their mark has
// Y, Cb, Cr and a fourth one that is ignored.
static bool choose_colors(j_decompress_ptr decoder) {
    bool inks = decoder->saw_Adobe_marker && (decoder->Adobe_transform == 0 || decoder->Adobe_transform == 2);
    decoder->out_color_space = JCS_EXT_RGB;
    if (decoder->num_components < 4)
        return false;
    decoder->out_color_space = JCS_CMYK;
    if (!inks)
        decoder->jpeg_color_space = JCS_YCCK;
    return inks;
}

// a * b / 255, rounded (Blinn 1995, "Three wrongs make a right").
static uint8_t product(unsigned a, unsigned b) {
    unsigned t = a * b + 128;
    return (uint8_t)((t + (t >> 8)) >> 8);
}

static void rgb_of_four(const uint8_t *row, uint32_t width, bool inks, uint8_t *to) {
    for (const uint8_t *p = row, *end = row + 4 * (size_t)width; p < end; p += 4, to += 3)
        for (int c = 0; c < 3; c++)
            to[c] = inks ? product(p[c], p[3]) : 255 - p[c];
}

// The library uses the standard tables if a file has none; but a damaged file must not become a picture.
static bool has_tables(j_decompress_ptr decoder) {
    for (int i = 0; i < decoder->comps_in_scan && !decoder->progressive_mode; i++) {
        int dc = decoder->cur_comp_info[i]->dc_tbl_no;
        int ac = decoder->cur_comp_info[i]->ac_tbl_no;
        if (dc >= NUM_HUFF_TBLS || ac >= NUM_HUFF_TBLS || !decoder->dc_huff_tbl_ptrs[dc] ||
            !decoder->ac_huff_tbl_ptrs[ac])
            return false;
    }
    return true;
}

// Returns normally, or through on_error's jump to the caller's setjmp.
static void read_rows(str bytes, struct job *job) {
    j_decompress_ptr decoder = &job->decoder;
    const struct picture_header *header = job->header;
    jpeg_create_decompress(decoder);
    jpeg_blocks_use(decoder, &job->blocks);
    jpeg_mem_src(decoder, (const unsigned char *)bytes.ptr, bytes.len);
    // No header can make the library keep more memory than was counted.
    decoder->mem->max_memory_to_use =
        header->decoder_bytes < LONG_MAX ? (long)header->decoder_bytes : LONG_MAX;
    jpeg_read_header(decoder, TRUE);
    if (decoder->image_width != header->width || decoder->image_height != header->height) {
        job->fault = "its parts contradict each other about its size";
        return;
    }
    if (!has_tables(decoder)) {
        job->fault = "a scan uses a table that the file does not have";
        return;
    }
    bool inks = choose_colors(decoder);
    const bool is_four = decoder->num_components == 4;
    jpeg_start_decompress(decoder);
    for (uint32_t y = 0; y < header->height; y++) {
        uint8_t *row = is_four ? job->inks : picture_row(&job->rows, y);
        jpeg_read_scanlines(decoder, &row, 1);
        if (is_four)
            rgb_of_four(row, header->width, inks, picture_row(&job->rows, y));
    }
    jpeg_finish_decompress(decoder);
}

// The job is outside the function that calls setjmp, so that it is defined after a jump.
static void read_guarded(str bytes, struct job *job) {
    if (setjmp(job->jump) == 0)
        read_rows(bytes, job);
}

const char *picture_jpeg_rows(str bytes, const struct picture_header *header, struct picture_rows rows) {
    struct job job = {.header = header, .rows = rows, .inks = heap_array(4, header->width)};
    if (!job.inks)
        return picture_no_memory;
    job.decoder.err = &job.errors;
    job.decoder.client_data = &job;
    // Error callbacks; the library's own would link in the text of its messages.
    job.errors.error_exit = on_error;
    job.errors.emit_message = on_message;
    job.errors.reset_error_mgr = on_reset;
    errno = 0;
    read_guarded(bytes, &job);
    jpeg_destroy_decompress(&job.decoder);
    jpeg_blocks_finish(&job.blocks);
    free(job.inks);
    return job.fault;
}
