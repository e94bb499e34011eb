// Which inputs a costly comparison is made for: in a replay all, while fuzzing a part, so that inputs a
// second count. An input that was found is chosen each time: its bytes decide.
//
// Thread safety: any.
#ifndef GLINT_TESTS_FUZZ_FUZZ_SAMPLE_H
#define GLINT_TESTS_FUZZ_FUZZ_SAMPLE_H

#include "core/str.h"

// Whether the bytes fall into part `part` of `parts`, a power of two.
static inline bool fuzz_is_chosen(str bytes, unsigned part, unsigned parts) {
#ifdef FUZZ_REPLAY
    (void)bytes, (void)part, (void)parts;
    return true;
#else
    return ((str_hash(bytes) >> 16) & (parts - 1)) == part;
#endif
}

#endif
