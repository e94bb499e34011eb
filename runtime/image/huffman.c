#include "runtime/image/huffman.h"

#include <assert.h>
#include <stdbool.h>
#include <stdlib.h>

enum {
    DEPTH_MAX = 64 // a tree this deep would need more than 2^44 symbols
};

struct entry {
    uint32_t count;
    uint32_t symbol;
};

static int rarer_first(const void *a, const void *b) {
    const struct entry *x = a;
    const struct entry *y = b;
    if (x->count != y->count)
        return x->count < y->count ? -1 : 1;
    return x->symbol < y->symbol ? -1 : 1;
}

// How many leaves the optimal tree has at each depth, from leaves in order of weight: inner nodes, too, are
// made in order of weight (van Leeuwen 1976). `used` is at least 2.
static void count_depths(const struct entry *leaves, uint32_t used, uint32_t at_depth[DEPTH_MAX]) {
    uint64_t weight[HUFFMAN_SYMBOLS_MAX];     // of inner nodes
    uint32_t parent[2 * HUFFMAN_SYMBOLS_MAX]; // of leaves, then of inner nodes
    uint32_t depth[HUFFMAN_SYMBOLS_MAX];      // of inner nodes
    uint32_t leaf = 0;
    uint32_t inner = 0;
    for (uint32_t made = 0; made + 1 < used; made++) {
        weight[made] = 0;
        for (int child = 0; child < 2; child++) {
            bool takes_leaf = leaf < used && (inner >= made || leaves[leaf].count <= weight[inner]);
            weight[made] += takes_leaf ? leaves[leaf].count : weight[inner];
            parent[takes_leaf ? leaf++ : used + inner++] = made;
        }
    }
    uint32_t root = used - 2;
    depth[root] = 0;
    for (uint32_t i = root; i-- > 0;)
        depth[i] = depth[parent[used + i]] + 1;
    for (uint32_t i = 0; i < used; i++) {
        assert(depth[parent[i]] + 1 < DEPTH_MAX);
        at_depth[depth[parent[i]] + 1]++;
    }
}

// Moves leaves up to the greatest depth allowed, then others down until the code is whole again.
static void limit_depths(uint32_t at_depth[DEPTH_MAX], uint32_t bits_max) {
    for (uint32_t depth = bits_max + 1; depth < DEPTH_MAX; depth++) {
        at_depth[bits_max] += at_depth[depth];
        at_depth[depth] = 0;
    }
    uint32_t room = 0; // in leaves of the greatest depth
    for (uint32_t depth = 1; depth <= bits_max; depth++)
        room += at_depth[depth] << (bits_max - depth);
    for (; room > 1u << bits_max; room--) {
        uint32_t depth = bits_max - 1;
        while (!at_depth[depth])
            depth--;
        at_depth[depth]--;
        at_depth[depth + 1] += 2;
        at_depth[bits_max]--;
    }
}

// RFC 1951, section 3.2.2: codes of one length follow each other in the order of the symbols.
static void number_codes(struct huffman *out, uint32_t symbols) {
    uint32_t at_length[HUFFMAN_BITS_MAX + 1] = {0};
    uint32_t next[HUFFMAN_BITS_MAX + 1] = {0};
    for (uint32_t i = 0; i < symbols; i++)
        at_length[out->bits[i]]++;
    at_length[0] = 0;
    for (int bits = 1; bits <= HUFFMAN_BITS_MAX; bits++)
        next[bits] = (next[bits - 1] + at_length[bits - 1]) << 1;
    for (uint32_t i = 0; i < symbols; i++) {
        uint32_t code = out->bits[i] ? next[out->bits[i]]++ : 0;
        uint32_t turned = 0;
        for (uint32_t bit = 0; bit < out->bits[i]; bit++)
            turned |= (code >> bit & 1) << (out->bits[i] - 1 - bit);
        out->code[i] = (uint16_t)turned;
    }
}

void huffman_make(const uint32_t *counts, uint32_t symbols, uint32_t bits_max, struct huffman *out) {
    struct entry leaves[HUFFMAN_SYMBOLS_MAX];
    uint32_t used = 0;
    *out = (struct huffman){0};
    for (uint32_t i = 0; i < symbols; i++)
        if (counts[i])
            leaves[used++] = (struct entry){counts[i], i};
    if (used == 1)
        out->bits[leaves[0].symbol] = 1;
    if (used > 1) {
        uint32_t at_depth[DEPTH_MAX] = {0};
        qsort(leaves, used, sizeof *leaves, rarer_first);
        count_depths(leaves, used, at_depth);
        limit_depths(at_depth, bits_max);
        uint32_t leaf = 0;
        for (uint32_t bits = bits_max; bits > 0; bits--)
            for (uint32_t k = 0; k < at_depth[bits]; k++)
                out->bits[leaves[leaf++].symbol] = (uint8_t)bits;
    }
    number_codes(out, symbols);
}
