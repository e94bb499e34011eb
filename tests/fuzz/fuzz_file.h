// Any bytes as a file on the disk, for readers that take a path.
#ifndef GLINT_TESTS_FUZZ_FUZZ_FILE_H
#define GLINT_TESTS_FUZZ_FUZZ_FILE_H

#include <stddef.h>
#include <stdint.h>

// The path of a file of this process that holds the bytes until the next call: in memory, where the system
// can.
const char *fuzz_file(const uint8_t *data, size_t size);

#endif
