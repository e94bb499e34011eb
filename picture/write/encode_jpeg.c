// JPEG through libjpeg-turbo: baseline, with halved chroma below the quality at which that is visible.
#include "picture/write/encode_internal.h"
#include "picture/write/image.h"

#include "core/heap.h"

#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>

enum {
    FULL_CHROMA_FROM = 90,
    CHANNELS = 3,
    COMMENT_MOST = 65533,
};

struct encoder {
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr errors;
    jmp_buf end;
    unsigned char *bytes; // from malloc, by the library
    unsigned long count;
};

static void on_error(j_common_ptr jpeg) {
    struct encoder *e = jpeg->client_data;
    longjmp(e->end, 1);
}

static void on_message(j_common_ptr jpeg) {
    (void)jpeg;
}

static void set_up(struct encoder *e, uint32_t width, uint32_t height, unsigned quality) {
    struct jpeg_compress_struct *jpeg = &e->jpeg;
    jpeg_mem_dest(jpeg, &e->bytes, &e->count);
    jpeg->image_width = width;
    jpeg->image_height = height;
    jpeg->input_components = CHANNELS;
    jpeg->in_color_space = JCS_RGB;
    jpeg_set_defaults(jpeg);
    jpeg_set_quality(jpeg, (int)quality, TRUE);
    jpeg->optimize_coding = TRUE;
    jpeg->dct_method = JDCT_ISLOW;
    if (quality >= FULL_CHROMA_FROM)
        jpeg->comp_info[0].h_samp_factor = jpeg->comp_info[0].v_samp_factor = 1;
}

static void write_part(struct encoder *e, const char *part) {
    for (; *part; part++)
        jpeg_write_m_byte(&e->jpeg, (unsigned char)*part);
}

// A comment: "Accuracy: at most ...".
static void write_text(struct encoder *e, const struct image_text *text) {
    static const char joint[] = ": ";
    const size_t length = strlen(text->keyword) + sizeof joint - 1 + strlen(text->text);
    if (length > COMMENT_MOST)
        return;
    jpeg_write_m_header(&e->jpeg, JPEG_COM, (unsigned)length);
    write_part(e, text->keyword);
    write_part(e, joint);
    write_part(e, text->text);
}

static void write_rows(struct encoder *e, uint32_t width, const uint8_t *rgb,
                       const struct image_texts *texts) {
    jpeg_start_compress(&e->jpeg, TRUE);
    for (uint32_t i = 0; texts && i < texts->count; i++)
        write_text(e, &texts->items[i]);
    while (e->jpeg.next_scanline < e->jpeg.image_height) {
        JSAMPROW row = (JSAMPROW)(rgb + (size_t)e->jpeg.next_scanline * CHANNELS * width);
        jpeg_write_scanlines(&e->jpeg, &row, 1);
    }
    jpeg_finish_compress(&e->jpeg);
}

// The encoder is outside the function that calls setjmp, so that it is defined after a jump.
static bool write_guarded(struct encoder *e, uint32_t width, uint32_t height, const uint8_t *rgb,
                          const struct image_texts *texts, unsigned quality) {
    if (setjmp(e->end))
        return false;
    jpeg_create_compress(&e->jpeg);
    e->jpeg.client_data = e;
    set_up(e, width, height, quality);
    write_rows(e, width, rgb, texts);
    return true;
}

void encode_jpeg(uint32_t width, uint32_t height, const uint8_t *rgb, const struct image_texts *texts,
                 unsigned quality, struct strbuf *out) {
    struct encoder e = {0};
    e.jpeg.err = jpeg_std_error(&e.errors);
    e.errors.error_exit = on_error;
    e.errors.output_message = on_message;
    e.jpeg.client_data = &e;
    if (write_guarded(&e, width, height, rgb, texts, quality)) {
        strbuf_add(out, e.bytes, e.count);
    } else {
        heap_exhausted(0); // sizes were checked: nothing else fails
        out->failed = true;
    }
    jpeg_destroy_compress(&e.jpeg);
    free(e.bytes);
}
