#include "picture/formats/formats.h"

static const struct image_format_info table[IMAGE_FORMATS] = {
    [IMAGE_NONE] = {.name = ""},
    [IMAGE_PNG] = {.name = "PNG",
                   .endings = {".png"},
                   .uses = IMAGE_WRITTEN | IMAGE_IN_SCENE | IMAGE_COMPARED,
                   .magic = "\x89PNG",
                   .bits = {8, 16},
                   .words = "PNG",
                   .what = "a PNG picture"},
    [IMAGE_JPEG] = {.name = "JPEG",
                    .endings = {".jpg", ".jpeg"},
                    .uses = IMAGE_WRITTEN | IMAGE_IN_SCENE | IMAGE_COMPARED,
                    .bits = {8},
                    .side_max = 65500,
                    .has_quality = true,
                    .magic = "\xFF\xD8\xFF",
                    .words = "JPEG",
                    .what = "a JPEG picture"},
    [IMAGE_WEBP] = {.name = "WebP",
                    .endings = {".webp"},
                    .uses = IMAGE_WRITTEN,
                    .bits = {8},
                    .side_max = 16383,
                    .has_quality = true,
                    .words = "WebP",
                    .what = "a WebP picture"},
    [IMAGE_EXR] = {.name = "EXR",
                   .endings = {".exr"},
                   .uses = IMAGE_WRITTEN | IMAGE_IN_SCENE | IMAGE_COMPARED,
                   .bits = {32, 16},
                   .is_linear = true,
                   .has_compression = true,
                   .magic = "v/1\x01",
                   .words = "OpenEXR",
                   .what = "an OpenEXR picture"},
    [IMAGE_PFM] = {.name = "PFM",
                   .endings = {".pfm"},
                   .uses = IMAGE_WRITTEN | IMAGE_COMPARED,
                   .bits = {32},
                   .is_linear = true,
                   .magic = "PF\n",
                   .words = "PFM",
                   .what = "a PFM picture"},
    [IMAGE_HDR] = {.name = "HDR",
                   .endings = {".hdr"},
                   .uses = IMAGE_WRITTEN | IMAGE_IN_SCENE | IMAGE_COMPARED,
                   .bits = {8},
                   .is_linear = true,
                   .magic = "#?RADIANCE",
                   .words = "Radiance HDR",
                   .what = "a Radiance picture"},
};

const struct image_format_info *image_format_info(enum image_format format) {
    return &table[format];
}

bool image_format_of_path(str path, enum image_use use, enum image_format *format) {
    for (int i = 0; i < IMAGE_FORMATS; i++)
        for (const char *const *ending = table[i].endings; *ending; ending++)
            if (table[i].uses & use && str_ends_with_nocase(path, *ending)) {
                *format = (enum image_format)i;
                return true;
            }
    return false;
}

const char *image_format_missing(enum image_format format) {
#ifndef GLINT_HAS_EXR
    if (format == IMAGE_EXR)
        return "this glint was built without OpenEXR (Debian's package libopenexr-dev)";
#endif
#ifndef GLINT_HAS_WEBP
    if (format == IMAGE_WEBP)
        return "this glint was built without WebP (Debian's package libwebp-dev)";
#endif
#ifndef GLINT_HAS_JPEG_WRITER
    if (format == IMAGE_JPEG)
        return "this glint was built without a writer of JPEG, to be small (GLINT_JPEG_WRITER=OFF)";
#endif
    (void)format;
    return NULL;
}

const char *const *image_scene_endings(void) {
    static const char *const endings[] = {".png", ".jpg", ".jpeg", ".exr", ".hdr", NULL};
    return endings;
}
