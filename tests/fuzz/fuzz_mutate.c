// How libFuzzer changes scenes: half the time as it would anyway, half the time as tests/generate/mutate.h
// does, so that comments with line ends of every kind come up without being found by chance.
#include "tests/generate/mutate.h"

#include <stddef.h>
#include <stdint.h>
#include <string.h>

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed);

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed) {
    uint64_t state = seed;
    struct strbuf out;
    if (seed & 1)
        return LLVMFuzzerMutate(data, size, max_size);
    strbuf_init(&out);
    mutate_text(&state, (str){(const char *)data, size}, &out);
    if (!out.failed) {
        size = out.len < max_size ? out.len : max_size;
        memcpy(data, out.data, size);
    }
    strbuf_finish(&out);
    return size;
}
