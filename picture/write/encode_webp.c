// WebP through libwebp: lossy below the best quality, by its default method, on one thread, so its bytes are
// always the same.
#include "core/heap.h"
#include "picture/write/encode_internal.h"
#include "picture/write/image.h"

#include <webp/encode.h>

static int on_write(const uint8_t *bytes, size_t count, const WebPPicture *picture) {
    struct strbuf *out = picture->custom_ptr;
    strbuf_add(out, bytes, count);
    return !out->failed;
}

void encode_webp(uint32_t width, uint32_t height, const uint8_t *rgb, unsigned quality, struct strbuf *out) {
    WebPConfig config;
    WebPPicture picture;
    if (!WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, (float)quality) || !WebPPictureInit(&picture)) {
        out->failed = true;
        return;
    }
    config.lossless = quality == IMAGE_QUALITY_MOST;
    config.exact = 1;
    picture.use_argb = config.lossless;
    picture.width = (int)width;
    picture.height = (int)height;
    picture.writer = on_write;
    picture.custom_ptr = out;
    if (!WebPPictureImportRGB(&picture, rgb, 3 * (int)width) || !WebPEncode(&config, &picture)) {
        if (picture.error_code == VP8_ENC_ERROR_OUT_OF_MEMORY ||
            picture.error_code == VP8_ENC_ERROR_BITSTREAM_OUT_OF_MEMORY)
            heap_exhausted(0);
        out->failed = true;
    }
    WebPPictureFree(&picture);
}
