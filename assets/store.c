#include "assets/store.h"

#include "assets/gltf/asset_gltf.h"
#include "core/heap.h"

#include <stdlib.h>
#include <string.h>

struct asset_store {
    struct store_entry *entries;
    struct asset_hold *holds;
    struct asset_reads reads;
};

struct asset_store *asset_store_create(void) {
    return heap_zeroed(1, sizeof(struct asset_store));
}

static void free_entry(struct store_entry *entry) {
    arena_finish(&entry->mesh.arena);
    picture_finish(&entry->picture);
    free(entry->path);
    free(entry);
}

void asset_store_destroy(struct asset_store *store) {
    if (!store)
        return;
    while (store->holds)
        store_release(store->holds);
    while (store->entries) {
        struct store_entry *next = store->entries->next;
        free_entry(store->entries);
        store->entries = next;
    }
    free(store);
}

struct asset_hold *store_hold(struct asset_store *store) {
    struct asset_hold *hold = heap_zeroed(1, sizeof *hold);
    if (!hold)
        return NULL;
    hold->store = store;
    hold->next = store->holds;
    store->holds = hold;
    return hold;
}

void store_release(struct asset_hold *hold) {
    if (!hold)
        return;
    for (uint32_t i = 0; i < hold->count; i++)
        hold->items[i]->references--;
    struct asset_hold **at = &hold->store->holds;
    while (*at != hold)
        at = &(*at)->next;
    *at = hold->next;
    arena_finish(&hold->scratch);
    gltf_documents_finish(hold->documents);
    free(hold->items);
    free(hold);
}

static bool take(struct asset_hold *hold, struct store_entry *entry) {
    struct store_entry **items =
        heap_grow(hold->items, hold->count, &hold->capacity, sizeof(struct store_entry *));
    if (!items)
        return false;
    hold->items = items;
    hold->items[hold->count++] = entry;
    entry->references++;
    return true;
}

static bool is_entry(const struct store_entry *entry, enum store_kind kind,
                     const struct file_read *identity) {
    return entry->is_whole && entry->kind == kind && entry->size_bytes == identity->size_bytes &&
           entry->modified_ns == identity->modified_ns &&
           str_equal((str){entry->path, entry->path_length}, identity->path);
}

struct store_entry *store_find(struct asset_hold *hold, enum store_kind kind,
                               const struct file_read *identity) {
    for (struct store_entry *entry = hold->store->entries; entry; entry = entry->next)
        if (is_entry(entry, kind, identity))
            return take(hold, entry) ? entry : NULL;
    return NULL;
}

struct store_entry *store_add(struct asset_hold *hold, enum store_kind kind,
                              const struct file_read *identity) {
    struct store_entry *entry = heap_zeroed(1, sizeof *entry);
    char *path = heap_alloc(identity->path.len + 1);
    if (!entry || !path || !take(hold, entry)) {
        free(entry);
        free(path);
        return NULL;
    }
    memcpy(path, identity->path.ptr, identity->path.len);
    entry->kind = kind;
    entry->path = path;
    entry->path_length = identity->path.len;
    entry->size_bytes = identity->size_bytes;
    entry->modified_ns = identity->modified_ns;
    entry->next = hold->store->entries;
    hold->store->entries = entry;
    return entry;
}

void store_complete(struct asset_hold *hold, struct store_entry *entry) {
    struct asset_reads *reads = &hold->store->reads;
    entry->is_whole = true;
    if (entry->kind == STORE_MESH)
        reads->meshes++;
    else
        reads->images++;
}

struct asset_reads asset_store_reads(const struct asset_store *store) {
    return store->reads;
}

void store_sweep(struct asset_store *store) {
    struct store_entry **at = &store->entries;
    while (*at) {
        struct store_entry *entry = *at;
        if (entry->references > 0) {
            at = &entry->next;
            continue;
        }
        *at = entry->next;
        free_entry(entry);
    }
}
