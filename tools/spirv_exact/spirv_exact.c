// spirv_exact IN.spv OUT.spv OUT.c NAME [plain] [values]: decorates every floating-point arithmetic operation
// of a module with NoContraction, so that no compiler may fuse a multiplication and an addition, and writes
// the module as SPIR-V and, packed and deflated, as a C file that defines the `struct kernel` NAME
// (shaders/kernel.h). With `plain` nothing is decorated: for measuring what that saves and costs. With
// `values` functions take by value what they only read (by_value.h). A module that computes with doubles and
// asks for SignedZeroInfNanPreserve of floats asks for it of doubles too: GLSL can say it of one width alone.
//
// GLSL's `precise` stops at function calls and does nothing for dot and cross; watertight intersection
// and conservative boxes need every operation rounded once. Exit codes: 0, or 1 with a line on stderr.
// Reference: SPIR-V Specification 1.6, sections 2.3, 2.4 and 3.
#include "by_value.h"
#include "shaders/packed.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <zlib.h>

enum {
    HEADER_WORDS = 5,
    MAGIC = 0x07230203,
    DECORATION_NO_CONTRACTION = 42,
    MODE_NAN_PRESERVE = 4461,
    DOUBLE_BITS = 64,
    OP_EXECUTION_MODE = 16,
    OP_TYPE_FLOAT = 22,
    OP_DECORATE = 71,
    OP_DECORATION_GROUP = 73,
    OP_TYPE_VOID = 19,
    OP_TYPE_FORWARD_POINTER = 39,
    OP_SPEC_CONSTANT_OP = 52,
    OP_CONSTANT_TRUE = 41,
    OP_FUNCTION = 54,
    OP_FNEGATE = 127,
    OP_FADD = 129,
    OP_FSUB = 131,
    OP_FMUL = 133,
    OP_FDIV = 136,
    OP_FREM = 140,
    OP_FMOD = 141,
    OP_VECTOR_TIMES_SCALAR = 142,
};

static bool is_arithmetic(uint32_t opcode) {
    switch (opcode) {
    case OP_FNEGATE:
    case OP_FADD:
    case OP_FSUB:
    case OP_FMUL:
    case OP_FDIV:
    case OP_FREM:
    case OP_FMOD:
    case OP_VECTOR_TIMES_SCALAR:
        return true;
    default:
        return false;
    }
}

static uint32_t *read_module(const char *path, size_t *words) {
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    uint32_t *module = NULL;
    long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    if (size >= HEADER_WORDS * 4 && size % 4 == 0 && fseek(file, 0, SEEK_SET) == 0) {
        *words = (size_t)size / 4;
        module = malloc((size_t)size);
        if (module && fread(module, 4, *words, file) != *words) {
            free(module);
            module = NULL;
        }
    }
    fclose(file);
    return module;
}

static bool is_sound(const uint32_t *module, size_t words) {
    if (module[0] != MAGIC)
        return false;
    for (size_t at = HEADER_WORDS; at < words; at += module[at] >> 16)
        if (module[at] >> 16 == 0 || at + (module[at] >> 16) > words)
            return false;
    return true;
}

// Annotations end where the first type or constant begins (section 2.4, logical layout).
static size_t annotations_end(const uint32_t *module, size_t words) {
    for (size_t at = HEADER_WORDS; at < words; at += module[at] >> 16) {
        const uint32_t opcode = module[at] & 0xffff;
        if ((opcode >= OP_TYPE_VOID && opcode <= OP_TYPE_FORWARD_POINTER) ||
            (opcode >= OP_CONSTANT_TRUE && opcode <= OP_FUNCTION))
            return at;
    }
    return words;
}

static bool has_doubles(const uint32_t *module, size_t words) {
    for (size_t at = HEADER_WORDS; at < words; at += module[at] >> 16)
        if ((module[at] & 0xffff) == OP_TYPE_FLOAT && module[at + 2] == DOUBLE_BITS)
            return true;
    return false;
}

// Copies what stands before types and constants; gives the words written.
static size_t copy_head(const uint32_t *module, size_t words, size_t end, uint32_t *out) {
    const bool doubles = has_doubles(module, words);
    size_t count = 0;
    for (; count < HEADER_WORDS; count++)
        out[count] = module[count];
    for (size_t at = HEADER_WORDS; at < end; at += module[at] >> 16) {
        const uint32_t length = module[at] >> 16, opcode = module[at] & 0xffff;
        for (uint32_t i = 0; i < length; i++)
            out[count++] = module[at + i];
        if (doubles && opcode == OP_EXECUTION_MODE && module[at + 2] == MODE_NAN_PRESERVE) {
            for (uint32_t i = 0; i + 1 < length; i++)
                out[count++] = module[at + i];
            out[count++] = DOUBLE_BITS;
        }
    }
    return count;
}

// A module of `*words` words, on the heap.
static uint32_t *decorate(const uint32_t *module, size_t *words, bool plain) {
    const size_t end = annotations_end(module, *words);
    bool *done = calloc(module[3], sizeof *done);           // by result id; module[3] is their bound
    uint32_t *out = malloc((*words * 2 + 7) * sizeof *out); // an operation has at least 3 words, a mode 4
    if (!done || !out) {
        free(done);
        free(out);
        return NULL;
    }
    size_t count = copy_head(module, *words, end, out);
    for (size_t at = HEADER_WORDS; at < end; at += module[at] >> 16)
        if ((module[at] & 0xffff) == OP_DECORATE && module[at + 2] == DECORATION_NO_CONTRACTION)
            done[module[at + 1]] = true;
    for (size_t at = end; at < *words; at += module[at] >> 16) {
        if (plain || !is_arithmetic(module[at] & 0xffff) || done[module[at + 2]])
            continue;
        out[count++] = 3u << 16 | OP_DECORATE;
        out[count++] = module[at + 2];
        out[count++] = DECORATION_NO_CONTRACTION;
    }
    for (size_t at = end; at < *words; at++)
        out[count++] = module[at];
    free(done);
    *words = count;
    return out;
}

static bool write_module(const char *path, const uint32_t *module, size_t words) {
    FILE *file = fopen(path, "wb");
    if (!file)
        return false;
    const bool ok = fwrite(module, 4, words, file) == words;
    return fclose(file) == 0 && ok;
}

// ---- packing (shaders/packed.h)

struct part {
    unsigned char *bytes;
    size_t count;
};

static void put_number(struct part *part, uint32_t value) {
    for (; value >= 0x80; value >>= 7)
        part->bytes[part->count++] = (unsigned char)(value | 0x80);
    part->bytes[part->count++] = (unsigned char)value;
}

static void put_distance(struct part *part, uint32_t value) {
    put_number(part, value >> 31 ? ~value << 1 | 1 : value << 1);
}

static void pack_instruction(const uint32_t *words, uint32_t *last, struct part parts[PACKED_PARTS]) {
    const uint32_t opcode = words[0] & 0xffff, length = words[0] >> 16;
    const enum packed_kind kind = packed_kind_of(opcode);
    put_number(&parts[0], opcode);
    put_number(&parts[0], length);
    for (uint32_t i = 1; i < length; i++) {
        if (kind == PACKED_PLAIN || (kind == PACKED_RESULT && i == 1))
            put_number(&parts[1], words[i]);
        else
            put_distance(&parts[2], *last - words[i]);
        if (i == packed_result(kind, opcode))
            *last = words[i];
    }
}

// Each part has room for all words: at most five bytes for one, and two numbers for an instruction.
static void pack(const uint32_t *module, size_t words, struct part parts[PACKED_PARTS]) {
    uint32_t last = 0;
    for (size_t i = 0; i < HEADER_WORDS; i++)
        put_number(&parts[1], module[i]);
    for (size_t at = HEADER_WORDS; at < words; at += module[at] >> 16)
        pack_instruction(module + at, &last, parts);
}

static bool write_bytes(FILE *file, const char *name, const unsigned char *bytes, size_t count,
                        const struct part *parts, size_t words) {
    fprintf(file, "#include \"shaders/kernel.h\"\n\nstatic const unsigned char deflated[] = {");
    for (size_t i = 0; i < count; i++)
        fprintf(file, "%s%u,", i % 24 ? "" : "\n    ", (unsigned)bytes[i]);
    fprintf(file, "\n};\nconst struct kernel %s = {deflated, sizeof deflated, {%zu, %zu, %zu}, %zu};\n", name,
            parts[0].count, parts[1].count, parts[2].count, words);
    return !ferror(file);
}

static bool write_packed(FILE *file, const char *name, struct part parts[PACKED_PARTS], size_t words) {
    size_t all = 0;
    for (int i = 0; i < PACKED_PARTS; i++) {
        memmove(parts[0].bytes + all, parts[i].bytes, parts[i].count);
        all += parts[i].count;
    }
    uLongf count = compressBound(all);
    unsigned char *bytes = malloc(count);
    const bool ok = bytes && compress2(bytes, &count, parts[0].bytes, all, Z_BEST_COMPRESSION) == Z_OK &&
                    write_bytes(file, name, bytes, count, parts, words);
    free(bytes);
    return ok;
}

static bool write_kernel(const char *path, const char *name, const uint32_t *module, size_t words) {
    const size_t room = 10 * words;
    unsigned char *memory = malloc(PACKED_PARTS * room);
    FILE *file = fopen(path, "w");
    struct part parts[PACKED_PARTS] = {{memory, 0}, {memory + room, 0}, {memory + 2 * room, 0}};
    bool ok = memory && file;
    if (ok) {
        pack(module, words, parts);
        ok = write_packed(file, name, parts, words);
    }
    free(memory);
    return file && fclose(file) == 0 && ok;
}

// What the arguments after the fourth ask for; false: something unknown.
static bool read_wishes(int argc, char **argv, bool *plain, bool *values) {
    for (int i = 5; i < argc; i++) {
        const bool is_plain = strcmp(argv[i], "plain") == 0;
        if (!is_plain && strcmp(argv[i], "values") != 0)
            return false;
        *(is_plain ? plain : values) = true;
    }
    return true;
}

// What becomes of a module, on the heap; NULL: no memory.
static uint32_t *make_exact(const uint32_t *module, size_t *words, bool plain, bool values) {
    uint32_t *lean = values ? by_value(module, words) : NULL;
    uint32_t *exact = !values || lean ? decorate(lean ? lean : module, words, plain) : NULL;
    free(lean);
    return exact;
}

int main(int argc, char **argv) {
    bool plain = false, values = false;
    if (argc < 5 || !read_wishes(argc, argv, &plain, &values)) {
        fprintf(stderr, "usage: spirv_exact IN.spv OUT.spv OUT.c NAME [plain] [values]\n");
        return 1;
    }
    size_t words = 0;
    uint32_t *module = read_module(argv[1], &words), *exact = NULL;
    bool ok = false;
    if (!module || !is_sound(module, words))
        fprintf(stderr, "%s:1:1: error: not a SPIR-V module\n", argv[1]);
    else if (!(exact = make_exact(module, &words, plain, values)))
        fprintf(stderr, "%s:1:1: error: not enough memory\n", argv[1]);
    else if (!write_module(argv[2], exact, words) || !write_kernel(argv[3], argv[4], exact, words))
        fprintf(stderr, "%s:1:1: error: cannot be written\n", argv[2]);
    else
        ok = true;
    free(module);
    free(exact);
    return ok ? 0 : 1;
}
