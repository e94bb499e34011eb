// The damaged images that `check` once passed and `render` refused, each made here byte by byte.
//
// Ownership: the caller's buffer. Thread safety: pure.
#ifndef GLINT_TESTS_AGREE_DAMAGED_H
#define GLINT_TESTS_AGREE_DAMAGED_H

#include "core/strbuf.h"

struct damaged {
    const char *what;
    const char *message; // a part of what must be said; NULL: it is whole
    void (*make)(struct strbuf *out);
};

extern const struct damaged damaged_images[];
extern const int damaged_count;

#endif
