#include "tools/meshgen/png.h"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

static void append(void *context, void *data, int size) {
    strbuf_add(context, data, (size_t)size);
}

bool png_encode(const unsigned char *rgb, int width, int height, struct strbuf *bytes) {
    // Speed over size: the file is made at build time and never travels.
    stbi_write_png_compression_level = 5;
    return stbi_write_png_to_func(append, bytes, width, height, 3, rgb, 3 * width) != 0 && !bytes->failed;
}
