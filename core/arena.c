#include "core/arena.h"

#include "core/heap.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A fuzz build has blocks, which are quick, with poisoned bytes after each allocation, which show overruns.
#ifdef GLINT_ARENA_REDZONES
#include <sanitizer/asan_interface.h>
#define POISON(memory, size)   ASAN_POISON_MEMORY_REGION((memory), (size))
#define UNPOISON(memory, size) ASAN_UNPOISON_MEMORY_REGION((memory), (size))
#define REDZONE_BYTES          16
#define BLOCK_BYTES            (8 * 1024)
#else
#define POISON(memory, size)   ((void)(memory), (void)(size))
#define UNPOISON(memory, size) ((void)(memory), (void)(size))
#define REDZONE_BYTES          0
#define BLOCK_BYTES            (64 * 1024)
#endif

enum {
    ARENA_ALIGN = 16,
    ARENA_BLOCK_BYTES = BLOCK_BYTES,
    ARENA_SHARED_BYTES = ARENA_BLOCK_BYTES / 4, // a larger allocation gets a block of its own
};

struct arena_block {
    struct arena_block *previous;
    size_t used;
    size_t size;
    struct arena_block *next; // also keeps the bytes after the header aligned to 16
};

void arena_init(struct arena *arena, size_t cap_bytes) {
    *arena = (struct arena){.cap_bytes = cap_bytes};
}

void arena_finish(struct arena *arena) {
    if (!arena)
        return;
    struct arena_block *block = arena->last;
    while (block) {
        struct arena_block *previous = block->previous;
        free(block);
        block = previous;
    }
    arena->last = NULL;
    arena->used_bytes = 0;
}

void arena_reset(struct arena *arena) {
    struct arena_block *kept = arena->last;
    if (!kept || kept->size != ARENA_BLOCK_BYTES) {
        arena_finish(arena);
        return;
    }
    arena->last = kept->previous;
    arena_finish(arena);
    UNPOISON(kept + 1, kept->used);
    memset(kept + 1, 0, kept->used);
    POISON(kept + 1, kept->used);
    kept->previous = NULL;
    kept->used = 0;
    arena->last = kept;
}

// Whether an allocation of this size has a block of its own.
static bool is_single(size_t need) {
#ifdef GLINT_ARENA_EXACT
    (void)need;
    return true;
#else
    return need > ARENA_SHARED_BYTES;
#endif
}

// Whether an allocation already made certainly has a block of its own: smaller ones may share one that had
// room.
static bool has_own_block(size_t need) {
#ifdef GLINT_ARENA_EXACT
    (void)need;
    return true;
#else
    return need > ARENA_BLOCK_BYTES;
#endif
}

// What an allocation takes of its block.
static size_t rounded(size_t size) {
#ifdef GLINT_ARENA_EXACT
    return size ? size : 1;
#else
    return (size ? (size + ARENA_ALIGN - 1) & ~(size_t)(ARENA_ALIGN - 1) : ARENA_ALIGN) + REDZONE_BYTES;
#endif
}

static struct arena_block *new_block(size_t size) {
    struct arena_block *block = heap_zeroed(1, sizeof(struct arena_block) + size);
    if (block) {
        block->size = size;
        POISON(block + 1, size);
    }
    return block;
}

static void link_block(struct arena *arena, struct arena_block *block, bool behind_last) {
    struct arena_block *last = arena->last;
    behind_last = behind_last && last;
    block->previous = behind_last ? last->previous : last;
    block->next = behind_last ? last : NULL;
    if (block->previous)
        block->previous->next = block;
    if (block->next)
        block->next->previous = block;
    else
        arena->last = block;
}

static void unlink_block(struct arena *arena, struct arena_block *block) {
    if (block->previous)
        block->previous->next = block->next;
    if (block->next)
        block->next->previous = block->previous;
    else
        arena->last = block->previous;
}

// A block with room for `need` bytes. A block of a single allocation goes after the last one, which stays in
// use: the room it has left is not lost.
static struct arena_block *block_with_room(struct arena *arena, size_t need) {
    struct arena_block *last = arena->last;
    if (last && last->size - last->used >= need)
        return last;
    bool single = is_single(need);
    struct arena_block *block = new_block(single ? need : ARENA_BLOCK_BYTES);
    if (block)
        link_block(arena, block, single);
    return block;
}

static void *alloc_or_fault(struct arena *arena, size_t size, enum arena_fault *fault) {
    *fault = ARENA_FAULT_CAP;
    if (size > arena->cap_bytes || arena->used_bytes > arena->cap_bytes - size)
        return NULL;
    *fault = ARENA_FAULT_SYSTEM;
    if (size > SIZE_MAX / 2)
        return NULL;
    size_t need = rounded(size);
    struct arena_block *block = block_with_room(arena, need);
    if (!block)
        return NULL;
    void *memory = (char *)(block + 1) + block->used;
    block->used += need;
    arena->used_bytes += need;
    UNPOISON(memory, size);
    return memory;
}

void *arena_try_alloc(struct arena *arena, size_t size) {
    enum arena_fault fault;
    return alloc_or_fault(arena, size, &fault);
}

struct arena_guard {
    jmp_buf jump;
    enum arena_fault fault;
};

// The guard is outside the function that calls setjmp, so that the fault is defined after a jump.
static void run(struct arena_guard *guard, arena_work *work, void *context) {
    if (setjmp(guard->jump) == 0)
        work(context);
}

// Each arena's previous guard is kept in a frame of its own; they are put back in reverse order.
static void guard_each(struct arena *const *arenas, struct arena_guard *guard, arena_work *work,
                       void *context) {
    struct arena *arena = *arenas;
    if (!arena) {
        run(guard, work, context);
        return;
    }
    struct arena_guard *outer = arena->guard;
    arena->guard = guard;
    guard_each(arenas + 1, guard, work, context);
    arena->guard = outer;
}

enum arena_fault arena_guarded_all(struct arena *const *arenas, arena_work *work, void *context) {
    struct arena_guard guard = {.fault = ARENA_FAULT_NONE};
    guard_each(arenas, &guard, work, context);
    return guard.fault;
}

enum arena_fault arena_guarded(struct arena *arena, arena_work *work, void *context) {
    return arena_guarded_all((struct arena *[]){arena, NULL}, work, context);
}

_Noreturn void arena_raise(struct arena *arena, enum arena_fault fault) {
    if (!arena->guard)
        abort();
    arena->guard->fault = fault;
    longjmp(arena->guard->jump, 1);
}

void *arena_alloc(struct arena *arena, size_t size) {
    enum arena_fault fault;
    void *memory = alloc_or_fault(arena, size, &fault);
    if (!memory)
        arena_raise(arena, fault);
    return memory;
}

void *arena_alloc_array(struct arena *arena, uint64_t count, size_t size) {
    return arena_alloc(arena, heap_times(count, size));
}

void *arena_try_alloc_array(struct arena *arena, uint64_t count, size_t size) {
    return arena_try_alloc(arena, heap_times(count, size));
}

str arena_copy(struct arena *arena, str s) {
    char *copy = arena_alloc(arena, s.len + 1);
    if (s.len)
        memcpy(copy, s.ptr, s.len);
    return (str){copy, s.len};
}

// The arguments are read twice, with the jump that `arena_alloc` may take in between, outside of both.
str arena_format(struct arena *arena, const char *format, ...) {
    va_list args;
    va_start(args, format);
    int length = vsnprintf(NULL, 0, format, args);
    va_end(args);
    if (length < 0) {
        heap_exhausted(0); // a correct format fails only for lack of memory
        arena_raise(arena, ARENA_FAULT_SYSTEM);
    }
    size_t size = (size_t)length;
    char *text = arena_alloc(arena, size + 1);
    va_start(args, format);
    vsnprintf(text, size + 1, format, args);
    va_end(args);
    return (str){text, size};
}

void *arena_grow(struct arena *arena, void *items, size_t count, uint32_t *capacity, size_t item_size) {
    if (count < *capacity)
        return items;
    uint32_t wanted = *capacity == 0 ? 8 : *capacity > UINT32_MAX / 2 ? UINT32_MAX : *capacity * 2;
    // A full list of 2^32 - 1 items cannot grow.
    if (count >= wanted)
        arena_raise(arena, ARENA_FAULT_SYSTEM);
    void *moved = arena_alloc_array(arena, wanted, item_size);
    if (count)
        memcpy(moved, items, count * item_size);
    *capacity = wanted;
    return moved;
}

// A block for one array, with room for `need` bytes: moved, mostly by the system's page tables.
static void *move_block(struct arena *arena, void *items, size_t need) {
    struct arena_block *block = (struct arena_block *)items - 1;
    size_t had = block->size;
    if (arena->used_bytes - had > arena->cap_bytes - need)
        arena_raise(arena, ARENA_FAULT_CAP);
    unlink_block(arena, block);
    struct arena_block *moved = heap_resize(block, sizeof *moved + need);
    struct arena_block *kept = moved ? moved : block;
    link_block(arena, kept, true);
    if (!moved)
        arena_raise(arena, ARENA_FAULT_SYSTEM);
    moved->size = moved->used = need;
    POISON((char *)(moved + 1) + need - REDZONE_BYTES, REDZONE_BYTES);
    arena->used_bytes = arena->used_bytes - had + need;
    return moved + 1;
}

void *arena_regrow(struct arena *arena, void *items, size_t count, uint32_t *capacity, size_t item_size) {
    if (count < *capacity)
        return items;
    uint32_t wanted = *capacity < 8 ? 8 : *capacity > UINT32_MAX / 2 ? UINT32_MAX : *capacity + *capacity / 2;
    size_t had = rounded(*capacity * item_size);
    if (!items || !has_own_block(had) || count >= wanted || wanted > SIZE_MAX / 2 / item_size ||
        wanted * item_size > arena->cap_bytes)
        return arena_grow(arena, items, count, capacity, item_size);
    items = move_block(arena, items, rounded(wanted * item_size));
    *capacity = wanted;
    return items;
}

void arena_give_back(struct arena *arena, void *items, uint32_t capacity, size_t item_size) {
    if (!items || !has_own_block(rounded(capacity * item_size)))
        return;
    struct arena_block *block = (struct arena_block *)items - 1;
    arena->used_bytes -= block->size;
    unlink_block(arena, block);
    free(block);
}

bool arena_hand_over(struct arena *from, struct arena *to, void *items, uint32_t capacity, size_t item_size) {
    if (!items || !has_own_block(rounded(capacity * item_size)))
        return false;
    struct arena_block *block = (struct arena_block *)items - 1;
    if (block->size > to->cap_bytes || to->used_bytes > to->cap_bytes - block->size)
        return false;
    unlink_block(from, block);
    from->used_bytes -= block->size;
    link_block(to, block, true);
    to->used_bytes += block->size;
    return true;
}
