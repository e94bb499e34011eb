// What every reader's tree must hold to, whatever the text.
//
// Thread safety: one call at a time.
#ifndef GLINT_TESTS_FUZZ_FUZZ_READER_H
#define GLINT_TESTS_FUZZ_FUZZ_READER_H

#include "parser/tree/reader.h"

typedef bool fuzz_reader(const struct reader_context *context, uint32_t source, struct tree *tree);

// Reads the bytes with small limits and aborts where the tree, a place or a diagnostic cannot be, or where
// reading `entries` one by one gives others.
void fuzz_reader_run(fuzz_reader *read, bool entries, const uint8_t *data, size_t size);

#endif
