// pack_kernels OUT.c NAME FUSES MODULE.spv...: packs modules as shaders/packed/packed.h says, and deflates
// them. For each three arguments after OUT.c, the C file defines the struct kernel (shaders/kernel.h)
// kernel_NAME: decorated when it is unpacked if FUSES is `exact`, and as it is if that is `plain`.
//
// Modules are best when their ids count up in the order in which they appear (`spirv-opt --compact-ids`).
// Exit codes: 0, or 1 with a line on stderr.
#include "shaders/packed/exact.h"
#include "shaders/packed/packed.h"
#include "tools/spirv_exact/module.h"

#include <spirv/unified1/spirv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <zlib.h>

enum {
    MOST_MODULES = 256,
    MASK_WORDS = MOST_MODULES / 64,
};

// Bytes that grow. The tool ends where memory does.
struct bytes {
    unsigned char *bytes;
    size_t count, capacity;
};

struct function {
    struct bytes parts[PACKED_CODE_PARTS];
    uint64_t users[MASK_WORDS]; // a bit for each module that has it
    int group, number;          // which of its group
};

struct module {
    const char *name;
    bool plain;
    uint32_t *words;
    size_t count, exact_count;
    struct bytes own[PACKED_PARTS];
    struct function **functions; // in its order
    size_t function_count;
};

// What is written; functions are in the order in which they were first met.
struct archive {
    struct module modules[MOST_MODULES];
    size_t module_count;
    struct function **functions;
    size_t function_count, function_room;
    struct function **groups; // the first function of each, whose users are the group's
    size_t group_count;
};

static void *need(void *memory) {
    if (memory)
        return memory;
    fprintf(stderr, "pack_kernels: not enough memory\n");
    exit(1);
}

static void put(struct bytes *to, const void *bytes, size_t count) {
    if (to->count + count > to->capacity) {
        to->capacity = 2 * (to->count + count) + 64;
        to->bytes = need(realloc(to->bytes, to->capacity));
    }
    if (count)
        memcpy(to->bytes + to->count, bytes, count);
    to->count += count;
}

static void put_number(struct bytes *to, uint32_t value) {
    unsigned char bytes[5];
    size_t count = 0;
    for (; value >= 0x80; value >>= 7)
        bytes[count++] = (unsigned char)(value | 0x80);
    bytes[count++] = (unsigned char)value;
    put(to, bytes, count);
}

static void put_distance(struct bytes *to, uint32_t value) {
    put_number(to, value >> 31 ? ~value << 1 | 1 : value << 1);
}

// ---- a module

// Where the first function begins.
static size_t head_end(const struct module *module) {
    size_t at = PACKED_HEADER_WORDS;
    while (at < module->count && (module->words[at] & 0xffff) != SpvOpFunction)
        at += module->words[at] >> 16;
    return at;
}

// The largest id that is there before functions introduce theirs: the first label is the first of those.
static uint32_t newest_before(const struct module *module, size_t end) {
    for (size_t at = end; at < module->count; at += module->words[at] >> 16)
        if ((module->words[at] & 0xffff) == SpvOpLabel)
            return module->words[at + 1] - 1;
    return 0;
}

static void pack_head(struct module *module, size_t end, uint32_t newest) {
    const uint32_t *words = module->words;
    uint32_t last = 0;
    put_number(&module->own[PACKED_PLAIN], newest);
    for (size_t i = 0; i < PACKED_HEADER_WORDS; i++)
        put_number(&module->own[PACKED_PLAIN], words[i]);
    for (size_t at = PACKED_HEADER_WORDS; at < end; at += words[at] >> 16) {
        const uint32_t opcode = words[at] & 0xffff, length = words[at] >> 16;
        put_number(&module->own[PACKED_HEADS], opcode);
        put_number(&module->own[PACKED_HEADS], length);
        for (uint32_t i = 1; i < length; i++) {
            const uint32_t word = words[at + i];
            if (packed_word_of(opcode, i) == PACKED_LITERAL)
                put_number(&module->own[PACKED_PLAIN], word);
            else
                put_distance(&module->own[PACKED_REFS], last - word);
            if (i == packed_result(opcode))
                last = word;
        }
    }
}

// The ids that a function has met.
struct ids {
    uint32_t *local, *outer;
    size_t locals, outers;
    uint32_t newest;
};

static size_t place_of(const uint32_t *ids, size_t count, uint32_t id) {
    size_t at = 0;
    while (at < count && ids[at] != id)
        at++;
    return at;
}

static uint32_t code_of(struct ids *ids, uint32_t id, struct bytes *outer) {
    if (id == ids->newest + 1) {
        ids->local[ids->locals++] = ++ids->newest;
        return 0;
    }
    size_t place = place_of(ids->local, ids->locals, id);
    if (place < ids->locals)
        return (uint32_t)(ids->locals - place) << 1;
    place = place_of(ids->outer, ids->outers, id);
    if (place == ids->outers) {
        ids->outer[ids->outers++] = id;
        put_number(outer, id);
        ids->newest = id > ids->newest ? id : ids->newest;
    }
    return (uint32_t)place << 1 | 1;
}

// Packs the function that begins at `at`; gives where the next one begins.
static size_t pack_function(struct module *module, size_t at, struct ids *ids, struct function *function) {
    const uint32_t *words = module->words;
    bool ended = false;
    ids->locals = ids->outers = 0;
    for (; at < module->count && !ended; at += words[at] >> 16) {
        const uint32_t opcode = words[at] & 0xffff, length = words[at] >> 16;
        put_number(&function->parts[PACKED_HEADS], opcode);
        put_number(&function->parts[PACKED_HEADS], length);
        for (uint32_t i = 1; i < length; i++) {
            const enum packed_word kind = packed_word_of(opcode, i);
            const uint32_t word = words[at + i];
            put_number(&function->parts[kind == PACKED_ID ? PACKED_REFS : PACKED_PLAIN],
                       kind == PACKED_LITERAL ? word : code_of(ids, word, &module->own[PACKED_OUTER]));
        }
        ended = opcode == SpvOpFunctionEnd;
    }
    return at;
}

static bool same_parts(const struct function *a, const struct function *b) {
    for (int i = 0; i < PACKED_CODE_PARTS; i++)
        if (a->parts[i].count != b->parts[i].count ||
            memcmp(a->parts[i].bytes, b->parts[i].bytes, a->parts[i].count) != 0)
            return false;
    return true;
}

// The function, or that of another module which is the same.
static struct function *shared(struct archive *archive, struct function *function) {
    for (size_t i = 0; i < archive->function_count; i++)
        if (same_parts(archive->functions[i], function)) {
            for (int k = 0; k < PACKED_CODE_PARTS; k++)
                free(function->parts[k].bytes);
            free(function);
            return archive->functions[i];
        }
    if (archive->function_count == archive->function_room) {
        archive->function_room = 2 * archive->function_room + 64;
        archive->functions =
            need(realloc(archive->functions, archive->function_room * sizeof *archive->functions));
    }
    return archive->functions[archive->function_count++] = function;
}

static void pack_module(struct archive *archive, size_t index) {
    struct module *module = &archive->modules[index];
    struct ids ids = {.local = need(malloc(module->count * sizeof *ids.local)),
                      .outer = need(malloc(module->count * sizeof *ids.outer))};
    size_t at = head_end(module);
    ids.newest = newest_before(module, at);
    pack_head(module, at, ids.newest);
    module->functions = need(malloc(module->count * sizeof *module->functions));
    while (at < module->count) {
        struct function *function = need(calloc(1, sizeof *function));
        at = pack_function(module, at, &ids, function);
        function = shared(archive, function);
        function->users[index / 64] |= (uint64_t)1 << index % 64;
        module->functions[module->function_count++] = function;
    }
    free(ids.local);
    free(ids.outer);
}

// ---- groups

static bool same_users(const struct function *a, const struct function *b) {
    return memcmp(a->users, b->users, sizeof a->users) == 0;
}

static bool uses(const struct function *function, size_t module) {
    return function->users[module / 64] >> module % 64 & 1;
}

static void form_groups(struct archive *archive) {
    archive->groups = need(malloc((archive->function_count + 1) * sizeof *archive->groups));
    int *sizes = need(calloc(archive->function_count + 1, sizeof *sizes));
    for (size_t i = 0; i < archive->function_count; i++) {
        struct function *function = archive->functions[i];
        size_t group = 0;
        while (group < archive->group_count && !same_users(archive->groups[group], function))
            group++;
        if (group == archive->group_count)
            archive->groups[archive->group_count++] = function;
        function->group = (int)group;
        function->number = sizes[group]++;
    }
    // The numbers of a module's functions go on from group to group.
    for (size_t m = 0; m < archive->module_count; m++) {
        struct module *module = &archive->modules[m];
        for (size_t i = 0; i < module->function_count; i++) {
            int number = module->functions[i]->number;
            for (int group = 0; group < module->functions[i]->group; group++)
                number += uses(archive->groups[group], m) ? sizes[group] : 0;
            put_number(&module->own[PACKED_ORDER], (uint32_t)number);
        }
    }
    free(sizes);
}

// ---- the C file

static void write_deflated(FILE *file, const char *kind, size_t index,
                           const struct bytes parts[PACKED_PARTS]) {
    struct bytes all = {0};
    for (int i = 0; i < PACKED_PARTS; i++)
        put(&all, parts[i].bytes, parts[i].count);
    uLongf count = compressBound(all.count);
    unsigned char *bytes = need(malloc(count));
    if (compress2(bytes, &count, all.bytes, all.count, Z_BEST_COMPRESSION) != Z_OK)
        need(NULL);
    fprintf(file, "static const unsigned char %s_%zu[] = {", kind, index);
    for (size_t i = 0; i < count; i++)
        fprintf(file, "%s%u,", i % 24 ? "" : "\n    ", (unsigned)bytes[i]);
    fprintf(file, "\n};\n");
    free(bytes);
    free(all.bytes);
}

// A struct kernel_bytes.
static void write_bytes(FILE *file, const char *kind, size_t index, const struct bytes parts[PACKED_PARTS]) {
    fprintf(file, "{%s_%zu, sizeof %s_%zu, {", kind, index, kind, index);
    for (int i = 0; i < PACKED_PARTS; i++)
        fprintf(file, "%zu,", parts[i].count);
    fprintf(file, "}},");
}

static void group_parts(const struct archive *archive, size_t group, struct bytes parts[PACKED_PARTS]) {
    memset(parts, 0, PACKED_PARTS * sizeof *parts);
    for (size_t i = 0; i < archive->function_count; i++) {
        const struct function *function = archive->functions[i];
        for (int k = 0; function->group == (int)group && k < PACKED_CODE_PARTS; k++) {
            put(&parts[k], function->parts[k].bytes, function->parts[k].count);
            put_number(&parts[PACKED_SIZES], (uint32_t)function->parts[k].count);
        }
    }
}

static void write_groups(FILE *file, const struct archive *archive) {
    struct bytes(*groups)[PACKED_PARTS] = need(malloc((archive->group_count + 1) * sizeof *groups));
    for (size_t i = 0; i < archive->group_count; i++) {
        group_parts(archive, i, groups[i]);
        write_deflated(file, "group", i, groups[i]);
    }
    fprintf(file, "static const struct kernel_bytes groups[] = {\n");
    for (size_t i = 0; i < archive->group_count; i++) {
        write_bytes(file, "group", i, groups[i]);
        fprintf(file, "\n");
        for (int k = 0; k < PACKED_PARTS; k++)
            free(groups[i][k].bytes);
    }
    fprintf(file, "};\n");
    free(groups);
}

static void write_kernel(FILE *file, const struct archive *archive, size_t index) {
    const struct module *module = &archive->modules[index];
    write_deflated(file, "own", index, module->own);
    fprintf(file, "static const uint16_t groups_%zu[] = {", index);
    size_t count = 0;
    for (size_t i = 0; i < archive->group_count; i++)
        if (uses(archive->groups[i], index)) {
            fprintf(file, "%zu,", i);
            count++;
        }
    fprintf(file, "};\nconst struct kernel kernel_%s = {", module->name);
    write_bytes(file, "own", index, module->own);
    fprintf(file, " groups, groups_%zu, %zu, %zu, %zu, %d};\n", index, count, module->count,
            module->exact_count, module->plain);
}

static bool write_archive(const char *path, const struct archive *archive) {
    FILE *file = fopen(path, "w");
    if (!file)
        return false;
    size_t functions = 0;
    for (size_t i = 0; i < archive->module_count; i++)
        functions += archive->modules[i].function_count;
    fprintf(file, "// %zu kernels with %zu functions, of which %zu differ, in %zu groups.\n",
            archive->module_count, functions, archive->function_count, archive->group_count);
    fprintf(file, "#include \"shaders/kernel.h\"\n\n");
    write_groups(file, archive);
    for (size_t i = 0; i < archive->module_count; i++)
        write_kernel(file, archive, i);
    const bool ok = !ferror(file);
    return fclose(file) == 0 && ok;
}

// ---- the command

static size_t exact_count(const struct module *module) {
    bool *done = need(calloc(module->words[3], sizeof *done));
    uint32_t *out = need(malloc(EXACT_ROOM(module->count) * sizeof *out));
    const size_t count = exact_decorate(module->words, module->count, module->plain, done, out);
    free(done);
    free(out);
    return count;
}

static bool read_modules(struct archive *archive, int count, char **arguments) {
    for (int i = 0; i < count; i += 3) {
        struct module *module = &archive->modules[archive->module_count++];
        module->name = arguments[i];
        module->plain = strcmp(arguments[i + 1], "plain") == 0;
        module->words = module_read(arguments[i + 2], &module->count);
        if (!module->words)
            return false;
        module->exact_count = exact_count(module);
    }
    return true;
}

static void free_archive(struct archive *archive) {
    for (size_t i = 0; i < archive->module_count; i++) {
        for (int k = 0; k < PACKED_PARTS; k++)
            free(archive->modules[i].own[k].bytes);
        free(archive->modules[i].words);
        free(archive->modules[i].functions);
    }
    for (size_t i = 0; i < archive->function_count; i++) {
        for (int k = 0; k < PACKED_CODE_PARTS; k++)
            free(archive->functions[i]->parts[k].bytes);
        free(archive->functions[i]);
    }
    free(archive->functions);
    free(archive->groups);
    free(archive);
}

int main(int argc, char **argv) {
    if (argc < 5 || (argc - 2) % 3 != 0 || (argc - 2) / 3 > MOST_MODULES) {
        fprintf(stderr, "usage: pack_kernels OUT.c {NAME exact|plain MODULE.spv}...\n");
        return 1;
    }
    struct archive *archive = need(calloc(1, sizeof *archive));
    bool ok = read_modules(archive, argc - 2, argv + 2);
    for (size_t i = 0; ok && i < archive->module_count; i++)
        pack_module(archive, i);
    if (ok)
        form_groups(archive);
    if (ok && !write_archive(argv[1], archive)) {
        fprintf(stderr, "%s:1:1: error: cannot be written\n", argv[1]);
        ok = false;
    }
    free_archive(archive);
    return ok ? 0 : 1;
}
