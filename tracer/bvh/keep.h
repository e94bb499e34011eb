// Trees that were built before, looked up by the items that they were built over.
//
// For a scene that is flattened again and again while it changes: a tree depends only on its items, so a tree
// over equal items need not be built again. Input and errors as bvh_build; ownership: the keep has copies,
// and bvh_keep_destroy takes NULL. Thread safety: one thread at a time.
#ifndef GLINT_TRACER_BVH_KEEP_H
#define GLINT_TRACER_BVH_KEEP_H

#include "tracer/bvh/bvh.h"

struct bvh_keep;

struct bvh_keep *bvh_keep_create(void); // NULL: no memory
void bvh_keep_destroy(struct bvh_keep *keep);
// As bvh_build. Without a keep (NULL) it builds. If there is no memory to keep a tree, it is built again next
// time.
bool bvh_build_kept(struct bvh_keep *keep, struct bvh_item *items, uint32_t count, enum bvh_method method,
                    struct bvh *out);
// As if all kept trees had been asked for and found. NULL does nothing.
void bvh_keep_all(struct bvh_keep *keep);
// Forgets the trees that were not asked for since the last call.
void bvh_keep_sweep(struct bvh_keep *keep);
// How many trees with items were built, and how many were found, since the keep was created.
uint32_t bvh_keep_built(const struct bvh_keep *keep);
uint32_t bvh_keep_found(const struct bvh_keep *keep);

#endif
