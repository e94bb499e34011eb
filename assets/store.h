// The store behind assets.h: meshes and images by canonical path, size and time, with reference counts.
//
// A hold is one scene's references. Entries without references stay until the next load is done, so that an
// edit that removes a mesh and puts it back does not read it again. Entries live on the heap.
// Thread safety: one thread loads at a time.
#ifndef GLINT_ASSETS_STORE_H
#define GLINT_ASSETS_STORE_H

#include "assets/assets.h"

enum store_kind {
    STORE_MESH,
    STORE_PICTURE_KEPT,
    STORE_PICTURE_CHECKED, // decoded, and its pixels dropped
    STORE_PICTURE_SKIPPED, // only its header was read
};

struct store_entry {
    struct store_entry *next;
    enum store_kind kind;
    char *path; // canonical
    size_t path_length;
    uint64_t size_bytes;
    int64_t modified_ns;
    uint32_t references;
    bool is_whole; // later loads will find this entry; others are never found, and freed by the next sweep
    struct mesh mesh;
    struct picture picture;
    uint64_t decoder_bytes;    // that decoding takes besides the pixels
    const char *picture_fault; // why it cannot be decoded, remembered for the file too; NULL: it can
};

struct asset_hold {
    struct asset_store *store;
    struct asset_hold *next;
    struct store_entry **items;
    uint32_t count, capacity;
    struct arena scratch;            // of the file being read
    struct gltf_document *documents; // of the scene that is being loaded
};

// NULL: no memory.
struct asset_hold *store_hold(struct asset_store *store);
// Releases all references. NULL does nothing.
void store_release(struct asset_hold *hold);
// A whole entry, now referenced by the hold; NULL: none.
struct store_entry *store_find(struct asset_hold *hold, enum store_kind kind,
                               const struct file_read *identity);
// A new entry, referenced by the hold and not whole yet; NULL: no memory.
struct store_entry *store_add(struct asset_hold *hold, enum store_kind kind,
                              const struct file_read *identity);
// The entry is whole from now on: later loads will find it.
void store_complete(struct asset_hold *hold, struct store_entry *entry);
// Frees entries that nothing refers to, and those that are not whole.
void store_sweep(struct asset_store *store);

#endif
