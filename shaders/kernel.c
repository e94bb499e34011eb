#include "shaders/kernel.h"

#include "core/heap.h"
#include "shaders/packed/exact.h"
#include "shaders/packed/unpack.h"

#include <stdlib.h>

#include <zlib.h>

_Static_assert(sizeof((struct kernel_bytes *)0)->part_bytes / sizeof(uint32_t) == PACKED_PARTS,
               "a length for each part");

static size_t size_of(const struct kernel_bytes *bytes) {
    size_t size = 0;
    for (int i = 0; i < PACKED_PARTS; i++)
        size += bytes->part_bytes[i];
    return size;
}

static const struct kernel_bytes *group_of(const struct kernel *kernel, size_t index) {
    return &kernel->groups[kernel->group[index]];
}

// Inflates to `*at`, and moves it to the end of the output.
static bool inflate_parts(const struct kernel_bytes *bytes, unsigned char **at,
                          struct packed_bytes parts[PACKED_PARTS]) {
    uLongf size = size_of(bytes);
    const size_t wanted = size;
    const int result = uncompress(*at, &size, bytes->deflated, bytes->deflated_bytes);
    if (result == Z_MEM_ERROR)
        heap_exhausted(0);
    for (int i = 0; i < PACKED_PARTS; i++) {
        parts[i] = (struct packed_bytes){.bytes = *at, .count = bytes->part_bytes[i]};
        *at += bytes->part_bytes[i];
    }
    return result == Z_OK && size == wanted;
}

// Adds a group's functions after the existing ones.
static bool add_functions(struct packed_bytes parts[PACKED_PARTS], struct packed_function **functions,
                          size_t *count, uint32_t *capacity) {
    struct packed_bytes *sizes = &parts[PACKED_SIZES];
    while (sizes->at < sizes->count) {
        struct packed_function *grown = heap_grow(*functions, *count, capacity, sizeof **functions);
        if (!grown)
            return false;
        *functions = grown;
        for (int i = 0; i < PACKED_CODE_PARTS; i++)
            grown[*count].parts[i] = packed_piece(&parts[i], packed_number(sizes));
        ++*count;
    }
    return true;
}

static bool unpack_functions(struct unpacking *to, const struct packed_function *functions, size_t count) {
    struct packed_bytes *order = &to->own[PACKED_ORDER];
    while (order->at < order->count) {
        const uint32_t number = packed_number(order);
        if (number >= count || !unpack_function(to, &functions[number]))
            return false;
    }
    bool whole = to->at == to->count;
    for (int i = 0; i < PACKED_PARTS; i++)
        whole = whole && packed_all_read(&to->own[i]);
    return whole;
}

// Unpacks into `words`, from the bytes inflated into `bytes`.
static bool unpack(const struct kernel *kernel, unsigned char *bytes, uint32_t *words, uint32_t *ids) {
    struct unpacking to = {
        .words = words, .count = kernel->packed_words, .local = ids, .outer = ids + kernel->packed_words};
    struct packed_function *functions = NULL;
    size_t count = 0;
    uint32_t capacity = 0;
    bool ok = inflate_parts(&kernel->own, &bytes, to.own) && unpack_head(&to);
    for (size_t i = 0; ok && i < kernel->group_count; i++) {
        struct packed_bytes parts[PACKED_PARTS];
        ok = inflate_parts(group_of(kernel, i), &bytes, parts) &&
             add_functions(parts, &functions, &count, &capacity);
    }
    ok = ok && unpack_functions(&to, functions, count);
    free(functions);
    return ok;
}

static uint32_t *unpacked(const struct kernel *kernel) {
    size_t size = size_of(&kernel->own);
    for (size_t i = 0; i < kernel->group_count; i++)
        size += size_of(group_of(kernel, i));
    unsigned char *bytes = heap_alloc(size + 1);
    uint32_t *words = heap_array(kernel->packed_words + 1, sizeof *words);
    uint32_t *ids = heap_array(heap_times(2, kernel->packed_words) + 1, sizeof *ids);
    const bool ok = bytes && words && ids && unpack(kernel, bytes, words, ids);
    free(bytes);
    free(ids);
    if (ok)
        return words;
    free(words);
    return NULL;
}

uint32_t *kernel_inflate(const struct kernel *kernel) {
    uint32_t *module = unpacked(kernel), *out = NULL;
    bool *done = NULL;
    if (module && exact_is_sound(module, kernel->packed_words)) {
        out = heap_array(EXACT_ROOM(kernel->packed_words), sizeof *out);
        done = heap_zeroed(module[3], sizeof *done);
    }
    const bool ok =
        out && done &&
        exact_decorate(module, kernel->packed_words, kernel->may_fuse, done, out) == kernel->words;
    free(module);
    free(done);
    if (ok)
        return out;
    free(out);
    return NULL;
}
