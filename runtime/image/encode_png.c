// PNG by stb_image_write, alone in this file so that its code and globals stay here.
#include "runtime/image/encode_parts.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
// The header declares what it then leaves out; found unused at the end of the file.
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>

static void append(void *context, void *data, int size) {
    strbuf_add(context, data, (size_t)size);
}

void encode_png(uint32_t width, uint32_t height, const uint8_t *rgb, struct strbuf *out) {
    if (!stbi_write_png_to_func(append, out, (int)width, (int)height, 3, rgb, (int)width * 3))
        out->failed = true;
}
