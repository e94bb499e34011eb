// In place of exr_file.c where glint is built without OpenEXR: nobody asks for it there.
#include "picture/write/exr_file.h"

void exr_file_write(const struct exr_file *file, struct strbuf *out) {
    (void)file;
    out->failed = true;
}
