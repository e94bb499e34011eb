#include "assets/ahead.h"

#include "assets/loader.h"
#include "core/clock.h"
#include "core/heap.h"
#include "core/parallel.h"
#include "core/timeline.h"
#include "grammar/ir.h"
#include "picture/read/picture_read.h"

#include <stdlib.h>

struct asset_ahead {
    struct file_read identity;
    struct arena arena; // of the file's text
    str text;
    struct picture_header header;
    struct picture picture;
    const char *fault; // of the decoder
    struct parallel_task task;
    struct timeline *timeline;
    str path;
    // Noted by ahead_is_for.
    struct asset_file file;
    struct store_entry *entry;
};

static void decode(void *context) {
    struct asset_ahead *ahead = context;
    const double start = clock_seconds();
    ahead->fault = picture_decode(ahead->text, &ahead->header, &ahead->picture);
    arena_finish(&ahead->arena);
    timeline_add(ahead->timeline, "image", ahead->path, start);
}

static bool fits(const struct asset_ahead *ahead, const struct assets_input *input) {
    const struct picture picture = picture_of_header(&ahead->header);
    const uint64_t bytes = loader_image_memory(input, &picture, ahead->header.decoder_bytes, true);
    return bytes <= input->limits->value[LIMIT_IMAGE_MEMORY] &&
           asset_fits_growth(input, bytes, ahead->identity.size_bytes);
}

// Does everything up to the pixels; false: something is wrong, or was decoded before.
static bool find(struct asset_ahead *ahead, const struct assets_input *input, struct asset_hold *hold,
                 str base) {
    const uint64_t most = input->limits->value[LIMIT_IMAGE_BYTES];
    struct files *files = input->files;
    if (files_resolve(files, base, input->scene->background.image, &ahead->path) != FILE_OK ||
        files_identify(files, ahead->path, &ahead->identity) != FILE_OK ||
        ahead->identity.size_bytes > most || store_find(hold, STORE_PICTURE_KEPT, &ahead->identity))
        return false;
    arena_init(&ahead->arena, limits_size(input->limits, LIMIT_IMAGE_BYTES) + ASSET_TEXT_ROOM);
    return files_read(files, ahead->path, most, &ahead->arena, &ahead->text) == FILE_OK &&
           !picture_read_header(ahead->text, &ahead->header) && ahead->header.kind != IMAGE_NONE &&
           fits(ahead, input);
}

struct asset_ahead *ahead_begin(const struct assets_input *input, struct asset_hold *hold, str base) {
    struct asset_ahead *ahead = heap_zeroed(1, sizeof *ahead);
    if (!ahead)
        return NULL;
    ahead->timeline = input->timeline;
    if (!find(ahead, input, hold, base)) {
        ahead_finish(ahead);
        return NULL;
    }
    ahead->picture = picture_of_header(&ahead->header);
    parallel_start(&ahead->task, decode, ahead);
    return ahead;
}

bool ahead_is_for(struct asset_ahead *ahead, const struct file_read *identity, struct store_entry *entry,
                  const struct asset_file *file) {
    if (!ahead || !str_equal(ahead->identity.path, identity->path) ||
        ahead->identity.size_bytes != identity->size_bytes ||
        ahead->identity.modified_ns != identity->modified_ns)
        return false;
    entry->picture = picture_of_header(&ahead->header);
    entry->decoder_bytes = ahead->header.decoder_bytes;
    ahead->entry = entry;
    ahead->file = *file;
    return true;
}

struct asset_file *ahead_take(struct asset_ahead *ahead, struct store_entry **entry) {
    if (!ahead || !ahead->entry)
        return NULL;
    parallel_wait(&ahead->task);
    *entry = ahead->entry;
    (*entry)->picture_fault = ahead->fault;
    // The entry stays as before decoding, except for what only pixels show.
    (*entry)->picture.pixels = ahead->picture.pixels;
    (*entry)->picture.ignored = ahead->picture.ignored;
    (*entry)->picture.clear_pixels = ahead->picture.clear_pixels;
    ahead->picture.pixels = NULL;
    ahead->entry = NULL;
    return &ahead->file;
}

void ahead_finish(struct asset_ahead *ahead) {
    if (!ahead)
        return;
    parallel_wait(&ahead->task);
    picture_finish(&ahead->picture);
    arena_finish(&ahead->arena);
    free(ahead);
}
