// Names of files with the number of a frame: '%d' is the number, '%04d' the same with zeros in front, '%%' a
// percent sign.
//
// Thread safety: pure.
#ifndef GLINT_RENDER_FRAMES_FRAME_NAME_H
#define GLINT_RENDER_FRAMES_FRAME_NAME_H

#include "core/strbuf.h"

// What is after a '%': appends the number and returns what follows the word; NULL: it is not such a word.
const char *frame_name_number(const char *word, int32_t number, struct strbuf *out);
// Appends the whole name. false: a '%' is followed by something else.
bool frame_name(const char *pattern, int32_t frame, struct strbuf *out);

#endif
