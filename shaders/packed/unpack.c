#include "shaders/packed/unpack.h"

uint32_t packed_number(struct packed_bytes *part) {
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

struct packed_bytes packed_piece(struct packed_bytes *part, size_t count) {
    part->ended = part->ended || count > part->count - part->at;
    const size_t size = part->ended ? 0 : count;
    const struct packed_bytes piece = {.bytes = part->bytes + part->at, .count = size, .ended = part->ended};
    part->at += size;
    return piece;
}

bool packed_all_read(const struct packed_bytes *part) {
    return !part->ended && part->at == part->count;
}

static uint32_t read_distance(struct packed_bytes *part) {
    const uint32_t value = packed_number(part);
    return value & 1 ? ~(value >> 1) : value >> 1;
}

// Begins an instruction and writes its first word; returns its length, 0 if there is no room for it.
static uint32_t begin(struct unpacking *to, struct packed_bytes *heads, uint32_t *opcode) {
    *opcode = packed_number(heads);
    const uint32_t length = packed_number(heads);
    if (length == 0 || length > to->count - to->at || length > UINT16_MAX) {
        to->broken = true;
        return 0;
    }
    to->words[to->at] = length << 16 | *opcode;
    return length;
}

bool unpack_head(struct unpacking *to) {
    struct packed_bytes *heads = &to->own[PACKED_HEADS], *plain = &to->own[PACKED_PLAIN];
    uint32_t last = 0, opcode;
    to->newest = packed_number(plain);
    to->broken = to->count < PACKED_HEADER_WORDS;
    while (!to->broken && to->at < PACKED_HEADER_WORDS)
        to->words[to->at++] = packed_number(plain);
    while (!to->broken && heads->at < heads->count) {
        const uint32_t length = begin(to, heads, &opcode);
        for (uint32_t i = 1; i < length; i++) {
            const bool literal = packed_word_of(opcode, i) == PACKED_LITERAL;
            const uint32_t word =
                literal ? packed_number(plain) : last - read_distance(&to->own[PACKED_REFS]);
            to->words[to->at + i] = word;
            if (i == packed_result(opcode))
                last = word;
        }
        to->at += length;
    }
    return !to->broken;
}

static uint32_t outer_id(struct unpacking *to, uint32_t index) {
    if (index < to->outers)
        return to->outer[index];
    const uint32_t id = packed_number(&to->own[PACKED_OUTER]);
    if (index > to->outers)
        to->broken = true;
    else
        to->outer[to->outers++] = id;
    to->newest = id > to->newest ? id : to->newest;
    return id;
}

static uint32_t read_id(struct unpacking *to, struct packed_bytes *part) {
    const uint32_t code = packed_number(part), index = code >> 1;
    if (code & 1)
        return outer_id(to, index);
    if (code == 0)
        return to->local[to->locals++] = ++to->newest;
    if (index <= to->locals)
        return to->local[to->locals - index];
    to->broken = true;
    return 0;
}

bool unpack_function(struct unpacking *to, const struct packed_function *function) {
    struct packed_bytes heads = function->parts[PACKED_HEADS], plain = function->parts[PACKED_PLAIN],
                        refs = function->parts[PACKED_REFS];
    uint32_t opcode;
    to->locals = to->outers = 0;
    while (!to->broken && heads.at < heads.count) {
        const uint32_t length = begin(to, &heads, &opcode);
        for (uint32_t i = 1; i < length && !to->broken; i++) {
            const enum packed_word kind = packed_word_of(opcode, i);
            to->words[to->at + i] = kind == PACKED_LITERAL
                                        ? packed_number(&plain)
                                        : read_id(to, kind == PACKED_TYPE ? &plain : &refs);
        }
        to->at += length;
    }
    return !to->broken && packed_all_read(&heads) && packed_all_read(&plain) && packed_all_read(&refs);
}
