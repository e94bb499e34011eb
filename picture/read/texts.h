// The lines of text in the head of a picture file: PNG (tEXt, iTXt), JPEG (comments), OpenEXR (attributes),
// Radiance HDR (comments). picture/write/image.h says how glint files them.
//
// Input: a whole file in memory, of any content; a file that ends early gives the texts before its end. PNG
// checksums are not checked. Errors: none. Ownership: results point into the bytes. Thread safety: pure.
#ifndef GLINT_PICTURE_READ_TEXTS_H
#define GLINT_PICTURE_READ_TEXTS_H

#include "core/str.h"

#include <stdint.h>

struct picture_text {
    str keyword, text;
};

// At most `most` of them, in their order; returns how many.
uint32_t picture_texts(str bytes, struct picture_text *out, uint32_t most);
// Whether two keywords are the same, ignoring spaces and letter case ("Scene hash", sceneHash).
bool picture_keyword_is(str keyword, str other);

#endif
