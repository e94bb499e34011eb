// Huffman codes as deflate wants them (RFC 1951, section 3.2). Private to runtime/image.
#ifndef GLINT_RUNTIME_IMAGE_HUFFMAN_H
#define GLINT_RUNTIME_IMAGE_HUFFMAN_H

#include <stdint.h>

enum {
    HUFFMAN_SYMBOLS_MAX = 288,
    HUFFMAN_BITS_MAX = 15
};

struct huffman {
    uint8_t bits[HUFFMAN_SYMBOLS_MAX];  // length of each symbol's code; 0: it does not occur
    uint16_t code[HUFFMAN_SYMBOLS_MAX]; // its first bit lowest
};

// Codes of at most `bits_max` bits for symbols that occur `counts[i]` times; `symbols` is at most
// HUFFMAN_SYMBOLS_MAX and at most 2^bits_max. A single symbol gets one bit. Thread safety: pure.
void huffman_make(const uint32_t *counts, uint32_t symbols, uint32_t bits_max, struct huffman *out);

#endif
