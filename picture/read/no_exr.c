// In place of read_exr.c where glint is built without OpenEXR.
#include "picture/read/read_exr.h"

const char *picture_exr_header(str bytes, struct picture_header *out) {
    (void)bytes;
    (void)out;
    return image_format_missing(IMAGE_EXR);
}

const char *picture_exr_rows(str bytes, struct picture_header *header, struct picture_rows rows) {
    (void)bytes;
    (void)header;
    (void)rows;
    return image_format_missing(IMAGE_EXR);
}
