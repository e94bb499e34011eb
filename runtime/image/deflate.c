// Matches are found by hash chains and taken lazily (RFC 1951, section 4); one block with codes of its own
// for each piece.
#include "runtime/image/deflate.h"

#include "runtime/image/huffman.h"

#include <stdlib.h>
#include <string.h>

enum {
    WINDOW = 32768,
    HASH_BITS = 15,
    MATCH_MIN = 4, // shorter ones seldom pay in pictures
    MATCH_MAX = 258,
    CHAIN_MAX = 12,  // places tried
    MATCH_GOOD = 32, // no better one is looked for
    LITERALS = 286,  // and lengths
    DISTANCES = 30,
    LENGTH_CODES = 19,
    END_OF_BLOCK = 256,
    IS_MATCH = 1 << 30, // of a token; then length - 3 in bits 15..22, distance - 1 below
};

struct finder {
    const uint8_t *text;
    size_t end;
    uint32_t head[1 << HASH_BITS]; // last place + 1 of a hash
    uint32_t previous[WINDOW];     // place + 1 of the same hash before
    uint32_t tokens[DEFLATE_PIECE_MAX];
    uint32_t token_count;
};

struct match {
    uint32_t length, distance;
};

static uint32_t hash_at(const uint8_t *text) {
    uint32_t four;
    memcpy(&four, text, sizeof four);
    return four * 2654435761u >> (32 - HASH_BITS);
}

static void note_place(struct finder *f, size_t place) {
    if (place + MATCH_MIN > f->end)
        return;
    uint32_t *head = &f->head[hash_at(f->text + place)];
    f->previous[place % WINDOW] = *head;
    *head = (uint32_t)place + 1;
}

static struct match find_match(const struct finder *f, size_t place) {
    struct match best = {MATCH_MIN - 1, 0};
    if (place + MATCH_MIN > f->end)
        return (struct match){0, 0};
    size_t room = f->end - place < MATCH_MAX ? f->end - place : MATCH_MAX;
    const uint8_t *here = f->text + place;
    uint32_t next = f->head[hash_at(here)];
    for (int tries = 0; tries < CHAIN_MAX && next && place - (next - 1) <= WINDOW; tries++) {
        const uint8_t *there = f->text + next - 1;
        if (best.length < room && there[best.length] == here[best.length]) {
            uint32_t length = 0;
            while (length < room && there[length] == here[length])
                length++;
            if (length > best.length)
                best = (struct match){length, (uint32_t)(here - there)};
        }
        uint32_t older = f->previous[(next - 1) % WINDOW];
        if (older >= next)
            break; // overwritten since
        next = older;
    }
    return best.distance ? best : (struct match){0, 0};
}

static void find_tokens(struct finder *f, size_t begin) {
    for (size_t i = begin > WINDOW ? begin - WINDOW : 0; i < begin; i++)
        note_place(f, i);
    struct match held = {0, 0}; // found one place before, not yet taken
    for (size_t place = begin; place < f->end;) {
        struct match match = held.length < MATCH_GOOD ? find_match(f, place) : (struct match){0, 0};
        note_place(f, place);
        if (held.length && held.length >= match.length) {
            f->tokens[f->token_count++] = IS_MATCH | (held.length - 3) << 15 | (held.distance - 1);
            size_t end = place - 1 + held.length;
            while (++place < end)
                note_place(f, place);
            held.length = 0;
            continue;
        }
        if (held.length)
            f->tokens[f->token_count++] = f->text[place - 1];
        held = match;
        if (!held.length)
            f->tokens[f->token_count++] = f->text[place];
        place++;
    }
    if (held.length)
        f->tokens[f->token_count++] = f->text[f->end - 1];
}

// ---- codes

// A symbol and the bits that follow it.
struct symbol {
    uint32_t code, extra_bits, extra;
};

// RFC 1951, section 3.2.5: after the first few, a power of two is shared by four lengths, by two distances.
static struct symbol length_symbol(uint32_t length) {
    if (length == MATCH_MAX)
        return (struct symbol){285, 0, 0};
    uint32_t from = length - 3;
    uint32_t extra = 0;
    while (from >> extra >= 8)
        extra++;
    return (struct symbol){257 + 4 * extra + (from >> extra), extra, from & ((1u << extra) - 1)};
}

static struct symbol distance_symbol(uint32_t distance) {
    uint32_t from = distance - 1;
    uint32_t extra = 0;
    while (from >> extra >= 4)
        extra++;
    return (struct symbol){2 * extra + (from >> extra), extra, from & ((1u << extra) - 1)};
}

struct bits {
    struct strbuf *out;
    uint64_t held;
    uint32_t count;
};

static void put_bits(struct bits *bits, uint32_t value, uint32_t count) {
    bits->held |= (uint64_t)value << bits->count;
    bits->count += count;
    if (bits->count < 32)
        return;
    uint8_t bytes[4];
    for (int i = 0; i < 4; i++)
        bytes[i] = (uint8_t)(bits->held >> (8 * i));
    strbuf_add(bits->out, bytes, sizeof bytes);
    bits->held >>= 32;
    bits->count -= 32;
}

static void align_bits(struct bits *bits) {
    for (; bits->count > 0; bits->count = bits->count > 8 ? bits->count - 8 : 0) {
        strbuf_char(bits->out, (char)(bits->held & 255));
        bits->held >>= 8;
    }
}

static void put_symbol(struct bits *bits, const struct huffman *codes, struct symbol symbol) {
    put_bits(bits, codes->code[symbol.code], codes->bits[symbol.code]);
    put_bits(bits, symbol.extra, symbol.extra_bits);
}

static uint32_t token_length(uint32_t token) {
    return (token >> 15 & 255) + 3;
}
static uint32_t token_distance(uint32_t token) {
    return (token & (WINDOW - 1)) + 1;
}

static void make_codes(const struct finder *f, struct huffman *literals, struct huffman *distances) {
    uint32_t literal_counts[LITERALS] = {[END_OF_BLOCK] = 1};
    uint32_t distance_counts[DISTANCES] = {0};
    for (uint32_t i = 0; i < f->token_count; i++) {
        uint32_t token = f->tokens[i];
        if (token & IS_MATCH) {
            literal_counts[length_symbol(token_length(token)).code]++;
            distance_counts[distance_symbol(token_distance(token)).code]++;
        } else {
            literal_counts[token]++;
        }
    }
    huffman_make(literal_counts, LITERALS, HUFFMAN_BITS_MAX, literals);
    huffman_make(distance_counts, DISTANCES, HUFFMAN_BITS_MAX, distances);
}

// The lengths of both codes, runs shortened (section 3.2.7).
static uint32_t shorten_lengths(const uint8_t *lengths, uint32_t count, struct symbol *out) {
    uint32_t made = 0;
    for (uint32_t i = 0; i < count;) {
        uint32_t run = 1;
        while (i + run < count && lengths[i + run] == lengths[i] && run < 138)
            run++;
        if (lengths[i] == 0 && run >= 3) {
            out[made++] = run < 11 ? (struct symbol){17, 3, run - 3} : (struct symbol){18, 7, run - 11};
            i += run;
            continue;
        }
        out[made++] = (struct symbol){lengths[i++], 0, 0};
        for (run--; lengths[i - 1] && run >= 3;) {
            uint32_t repeat = run < 6 ? run : 6;
            out[made++] = (struct symbol){16, 2, repeat - 3};
            i += repeat;
            run -= repeat;
        }
    }
    return made;
}

static void put_codes(struct bits *bits, const struct huffman *literals, const struct huffman *distances) {
    static const uint8_t order[LENGTH_CODES] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                11, 4,  12, 3, 13, 2, 14, 1, 15};
    uint8_t lengths[LITERALS + DISTANCES];
    struct symbol symbols[LITERALS + DISTANCES];
    memcpy(lengths, literals->bits, LITERALS);
    memcpy(lengths + LITERALS, distances->bits, DISTANCES);
    uint32_t count = shorten_lengths(lengths, LITERALS + DISTANCES, symbols);
    uint32_t counts[LENGTH_CODES] = {0};
    for (uint32_t i = 0; i < count; i++)
        counts[symbols[i].code]++;
    struct huffman codes;
    huffman_make(counts, LENGTH_CODES, 7, &codes);
    uint32_t shown = LENGTH_CODES;
    while (shown > 4 && !codes.bits[order[shown - 1]])
        shown--;
    put_bits(bits, LITERALS - 257, 5);
    put_bits(bits, DISTANCES - 1, 5);
    put_bits(bits, shown - 4, 4);
    for (uint32_t i = 0; i < shown; i++)
        put_bits(bits, codes.bits[order[i]], 3);
    for (uint32_t i = 0; i < count; i++)
        put_symbol(bits, &codes, symbols[i]);
}

static void put_block(const struct finder *f, bool is_last, struct strbuf *out) {
    struct huffman literals, distances;
    struct bits bits = {.out = out};
    make_codes(f, &literals, &distances);
    put_bits(&bits, is_last, 1);
    put_bits(&bits, 2, 2); // codes of its own
    put_codes(&bits, &literals, &distances);
    for (uint32_t i = 0; i < f->token_count; i++) {
        uint32_t token = f->tokens[i];
        if (token & IS_MATCH) {
            put_symbol(&bits, &literals, length_symbol(token_length(token)));
            put_symbol(&bits, &distances, distance_symbol(token_distance(token)));
        } else {
            put_bits(&bits, literals.code[token], literals.bits[token]);
        }
    }
    put_bits(&bits, literals.code[END_OF_BLOCK], literals.bits[END_OF_BLOCK]);
    if (!is_last)
        put_bits(&bits, 0, 3); // an empty stored block
    align_bits(&bits);
    if (!is_last)
        strbuf_add(out, "\0\0\377\377", 4);
}

void deflate_piece(const uint8_t *text, size_t begin, size_t end, bool is_last, struct strbuf *out) {
    struct finder *f = malloc(sizeof *f);
    if (!f) {
        out->failed = true;
        return;
    }
    f->text = text;
    f->end = end;
    f->token_count = 0;
    memset(f->head, 0, sizeof f->head);
    find_tokens(f, begin);
    put_block(f, is_last, out);
    free(f);
}
