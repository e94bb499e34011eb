// Memory of one phase (source, tree, IR, flat): many allocations, freed together.
//
// `arena_alloc` returns zeroed memory, or not at all: at the byte cap, or when malloc fails, it jumps out
// of the work that `arena_guarded` runs, however deep it is, and `arena_guarded` says why:
//
//     struct job job = {.arena = &arena, ...};
//     enum arena_fault fault = arena_guarded(&arena, run, &job);
//
// The job holds the input of the work, its results, and what must be released whether it finishes or not (a
// file, memory from malloc): the work's own locals are gone after a jump.
// Never jump through a library's frames: callbacks of expat and stb use `arena_try_alloc` and set a flag, or
// run what they do guarded.
// An arena is guarded while such work runs. Unguarded, a failed `arena_alloc` aborts: that is a
// programmer's mistake. Thread safety: an arena belongs to one thread at a time.
#ifndef GLINT_CORE_ARENA_H
#define GLINT_CORE_ARENA_H

#include "core/str.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum arena_fault {
    ARENA_FAULT_NONE,
    ARENA_FAULT_CAP,    // the arena's own byte cap is reached
    ARENA_FAULT_SYSTEM, // malloc returned NULL
};

struct arena_block;
struct arena_guard;

struct arena {
    struct arena_block *last;
    struct arena_guard *guard; // of the innermost arena_guarded; NULL outside
    size_t used_bytes;         // handed out, padding included
    size_t cap_bytes;
};

void arena_init(struct arena *arena, size_t cap_bytes);
// Frees all; the arena may be used again, with the same cap. NULL does nothing.
void arena_finish(struct arena *arena);
// Frees all but one block, which is kept for reuse: for memory that each item needs anew.
void arena_reset(struct arena *arena);

typedef void arena_work(void *context);
// Runs `work` with `context`; returns ARENA_FAULT_NONE, or why the arena ended it. Calls may be nested: a
// fault ends the innermost one of its arena. What was allocated stays in the arena until that is finished.
enum arena_fault arena_guarded(struct arena *arena, arena_work *work, void *context);
// As `arena_guarded`, for all arenas of a list that ends with NULL; an arena may be in it twice. The list
// must name every arena that `work` allocates from: a fault of one that is only guarded further out would
// jump past this call, and leave the arenas named here with a stale guard.
enum arena_fault arena_guarded_all(struct arena *const *arenas, arena_work *work, void *context);

// Returns `size` zeroed bytes, aligned to 16. A size of 0 returns a valid pointer.
void *arena_alloc(struct arena *arena, size_t size);
// As `arena_alloc`, but returns NULL when that would jump.
void *arena_try_alloc(struct arena *arena, size_t size);
// The same for `count` items of `size` bytes; a product beyond all memory is an allocation that fails.
void *arena_alloc_array(struct arena *arena, uint64_t count, size_t size);
void *arena_try_alloc_array(struct arena *arena, uint64_t count, size_t size);
#define ARENA_NEW(arena, type)          ((type *)arena_alloc((arena), sizeof(type)))
#define ARENA_ARRAY(arena, type, count) ((type *)arena_alloc_array((arena), (count), sizeof(type)))

// Jumps as a failed allocation does: for a caller that guarded some work in order to release something, and
// passes the fault on.
_Noreturn void arena_raise(struct arena *arena, enum arena_fault fault);

// A copy of `s` in the arena, followed by a NUL (not counted).
str arena_copy(struct arena *arena, str s);
// printf into the arena; the result is followed by a NUL (not counted).
str arena_format(struct arena *arena, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Makes room for one more item in an array that lives in an arena: `items` holds `count` of `*capacity`
// items; returns the array, moved to twice the room if it was full. The old array stays in the arena.
void *arena_grow(struct arena *arena, void *items, size_t count, uint32_t *capacity, size_t item_size);
// As `arena_grow`, for large arrays: the old array is freed, so pointers into it become invalid, and the room
// after the `count` items is not zeroed.
void *arena_regrow(struct arena *arena, void *items, size_t count, uint32_t *capacity, size_t item_size);
// Whether another item needs arena_regrow first; a test that costs less than the call.
#define ARENA_IS_FULL(list) ((list)->count >= (list)->capacity)
// Frees an array that arena_regrow made; small ones stay with the arena. NULL does nothing.
void arena_give_back(struct arena *arena, void *items, uint32_t capacity, size_t item_size);
// Hands an array of `capacity` items, allocated by `from`, to another arena without copying it. false: it is
// too small for that, or more than `to` may have; nothing has changed.
bool arena_hand_over(struct arena *from, struct arena *to, void *items, uint32_t capacity, size_t item_size);
// Appends a zeroed item to a list {items, count, capacity}; returns its address.
#define ARENA_PUSH(arena, list)                                                                              \
    ((list)->items =                                                                                         \
         arena_grow((arena), (list)->items, (list)->count, &(list)->capacity, sizeof(*(list)->items)),       \
     &(list)->items[(list)->count++])

#endif
