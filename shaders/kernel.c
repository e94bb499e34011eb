#include "shaders/kernel.h"

#include "core/heap.h"
#include "shaders/packed.h"

#include <stdbool.h>
#include <stdlib.h>

#include <zlib.h>

// A part of the packed bytes; reading beyond its end gives zeros, and is noted.
struct part {
    const unsigned char *bytes;
    size_t count, at;
    bool ended;
};

static uint32_t read_number(struct part *part) {
    uint32_t value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
        if (part->at == part->count) {
            part->ended = true;
            return 0;
        }
        const unsigned char byte = part->bytes[part->at++];
        value |= shift < 32 ? (uint32_t)(byte & 0x7f) << shift : 0;
        if (byte < 0x80)
            break;
    }
    return value;
}

static uint32_t read_distance(struct part *part) {
    const uint32_t value = read_number(part);
    return value & 1 ? ~(value >> 1) : value >> 1;
}

// false: the parts do not hold so many words.
static bool unpack(struct part parts[PACKED_PARTS], uint32_t *words, size_t count) {
    struct part *heads = &parts[0], *plain = &parts[1], *distances = &parts[2];
    uint32_t last = 0;
    for (size_t i = 0; i < PACKED_HEADER_WORDS && i < count; i++)
        words[i] = read_number(plain);
    for (size_t at = PACKED_HEADER_WORDS; at < count;) {
        const uint32_t opcode = read_number(heads), length = read_number(heads);
        const enum packed_kind kind = packed_kind_of(opcode);
        if (length == 0 || length > count - at)
            return false;
        words[at] = length << 16 | opcode;
        for (uint32_t i = 1; i < length; i++) {
            const bool is_plain = kind == PACKED_PLAIN || (kind == PACKED_RESULT && i == 1);
            words[at + i] = is_plain ? read_number(plain) : last - read_distance(distances);
            if (i == packed_result(kind, opcode))
                last = words[at + i];
        }
        at += length;
    }
    bool whole = true;
    for (int i = 0; i < PACKED_PARTS; i++)
        whole = whole && !parts[i].ended && parts[i].at == parts[i].count;
    return whole;
}

static uint32_t *unpacked(const struct kernel *kernel, const unsigned char *packed) {
    struct part parts[PACKED_PARTS];
    for (int i = 0; i < PACKED_PARTS; i++) {
        parts[i] = (struct part){.bytes = packed, .count = kernel->part_bytes[i]};
        packed += kernel->part_bytes[i];
    }
    uint32_t *words = heap_alloc((kernel->words + 1) * sizeof *words);
    if (!words || unpack(parts, words, kernel->words))
        return words;
    free(words);
    return NULL;
}

uint32_t *kernel_inflate(const struct kernel *kernel) {
    uLongf bytes = 0;
    for (int i = 0; i < PACKED_PARTS; i++)
        bytes += kernel->part_bytes[i];
    const size_t wanted = bytes;
    unsigned char *packed = heap_alloc(bytes + 1);
    const int result =
        packed ? uncompress(packed, &bytes, kernel->deflated, kernel->deflated_bytes) : Z_MEM_ERROR;
    if (result == Z_MEM_ERROR)
        heap_exhausted(0);
    uint32_t *words = result == Z_OK && bytes == wanted ? unpacked(kernel, packed) : NULL;
    free(packed);
    return words;
}
