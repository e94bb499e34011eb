// PNG bytes of an 8-bit RGB picture, rows from the top.
#ifndef GLINT_MESHGEN_PNG_H
#define GLINT_MESHGEN_PNG_H

#include "core/strbuf.h"

bool png_encode(const unsigned char *rgb, int width, int height, struct strbuf *bytes);

#endif
