// Files with seeded mistakes: bytes changed, left out, doubled or cut off; numbers of text replaced.
//
// Input: any bytes. Output: a mutant, the same for the same seed in every run. Ownership: the caller's
// buffer. Thread safety: pure.
#ifndef GLINT_TESTS_AGREE_MUTATE_H
#define GLINT_TESTS_AGREE_MUTATE_H

#include "core/strbuf.h"

// `is_text`: numbers are replaced too, by ones that are hard to take.
void mutate(str bytes, uint64_t seed, bool is_text, struct strbuf *out);
// Makes the checksums of a PNG right, so that a mutant is decoded and not refused at once; other files, and
// chunks that do not fit, stay as they are.
void mutate_repair_png(struct strbuf *file);

#endif
