// The reference asked through a cache: pictures and hits that were computed before are read back.
//
// The key is a hash of all that the scene means, row by row of the table, of the contents of meshes and
// images, of the view, the settings and REFERENCE_VERSION; how the scene is written does not matter. Names
// count too: computing a picture twice costs time, but another scene's picture would be wrong. Entries that
// are damaged, or of another version, are ignored and replaced. The tree is built only where something is not
// in the cache. Ownership: scene, assets, view and the store's path must outlive the source. Thread safety: a
// source belongs to one thread; several processes may share a store.
#ifndef GLINT_REFERENCE_CACHE_H
#define GLINT_REFERENCE_CACHE_H

#include "files/folder_store.h"
#include "reference/reference.h"

// Under the user's cache folder (folder_store_path), and its size.
#define REFERENCE_CACHE_NAME  "reference"
#define REFERENCE_CACHE_BYTES (UINT64_C(1) << 30)

struct reference_source {
    struct reference_input input;
    struct folder_store store;   // path NULL: no cache
    struct reference *reference; // made when first needed
    uint64_t scene_key[2];
    bool has_key;
    uint32_t found, computed; // answers from the cache, and those computed
};

void reference_source_init(struct reference_source *source, const struct reference_input *input,
                           struct folder_store store);
void reference_source_finish(struct reference_source *source);
// Makes the reference if it was not made yet; it belongs to the source. NULL: no memory.
const struct reference *reference_source_get(struct reference_source *source);

// As reference_render; a picture from the cache has the statistics from when it was made.
enum reference_result reference_source_render(struct reference_source *source,
                                              const struct reference_settings *settings, double *rgb,
                                              const struct reference_progress *progress,
                                              struct reference_statistics *statistics);
// As reference_hits.
enum reference_result reference_source_hits(struct reference_source *source,
                                            const struct reference_settings *settings, struct hit_pixel *hits,
                                            const struct reference_progress *progress);

// A hash of the scene, its files and the view, with which the keys of all entries of an input begin.
void reference_input_key(const struct reference_input *input, uint64_t key[2]);

enum reference_entry {
    REFERENCE_ENTRY_PICTURE,
    REFERENCE_ENTRY_HITS,
};
enum {
    REFERENCE_NAME_BYTES = 48
};
// The name of the entry in the store.
void reference_source_name(struct reference_source *source, const struct reference_settings *settings,
                           enum reference_entry entry, char name[REFERENCE_NAME_BYTES]);

#endif
