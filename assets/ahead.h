// Decodes the background's pixels in parallel with everything else: begun before the meshes are read, awaited
// when the pixels are needed.
//
// It finds and reads the file as assets.c does, and reports nothing: faults are left to assets.c, which
// reports them in their turn. Errors: none; then nothing is decoded ahead. Ownership: ahead_finish waits and
// frees; ahead_take gives the pixels away. Thread safety: as assets.h; the decoder alone has another thread.
#ifndef GLINT_ASSETS_AHEAD_H
#define GLINT_ASSETS_AHEAD_H

#include "assets/file/asset_file.h"
#include "assets/store.h"

struct asset_ahead;

// Begins with the image that the scene's file `base` names; NULL: there is nothing to begin.
struct asset_ahead *ahead_begin(const struct assets_input *input, struct asset_hold *hold, str base);
// Whether it decodes that file; then the entry and the file are noted for ahead_take.
bool ahead_is_for(struct asset_ahead *ahead, const struct file_read *identity, struct store_entry *entry,
                  const struct asset_file *file);
// Waits for the pixels, which become the noted entry's, or its fault, which is picture_no_memory if memory
// ran out. Returns the noted file, for what must be reported; NULL: nothing was noted.
struct asset_file *ahead_take(struct asset_ahead *ahead, struct store_entry **entry);
// NULL does nothing.
void ahead_finish(struct asset_ahead *ahead);

#endif
