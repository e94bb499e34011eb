// Image files: found in the store or read, and judged.
#include "assets/loader.h"
#include "core/clock.h"
#include "core/timeline.h"
#include "picture/read/picture_read.h"

static bool fits_memory(struct asset_file *file, str name, const struct store_entry *entry) {
    const struct limit_info *info = limit_info(LIMIT_IMAGE_MEMORY);
    const uint64_t bytes = entry->picture_bytes;
    if (bytes <= file->input->limits->value[LIMIT_IMAGE_MEMORY])
        return true;
    asset_report_named(
        file, DIAG_LIMIT,
        "the image '%.*s' claims %u x %u pixels, which take %llu bytes of memory; the limit %s "
        "is %llu",
        STR_ARG(name), entry->picture.width, entry->picture.height, (unsigned long long)bytes, info->name,
        (unsigned long long)file->input->limits->value[LIMIT_IMAGE_MEMORY]);
    if (bytes <= info->greatest)
        diag_help(file->input->sink, "if the file is right, raise the limit: --limit %s=%llu", info->name,
                  (unsigned long long)bytes);
    else
        diag_help(file->input->sink, "no limit allows more than %llu bytes; make the image smaller",
                  (unsigned long long)info->greatest);
    return false;
}

// What the file's bytes say; a fault of the decoder is left in the entry.
static void decode_image(struct asset_file *file, str name, struct store_entry *entry) {
    struct picture_header header;
    const char *fault = picture_read_header(file->text, &header);
    if (header.kind == IMAGE_NONE) {
        asset_report_named(file, DIAG_IMAGE_KIND, "'%.*s' is not a " IMAGE_IN_SCENE_NAMES " image",
                           STR_ARG(name));
        return;
    }
    entry->picture = picture_of_header(&header);
    entry->picture_bytes = fault ? 0 : picture_memory(&header, ASSET_TEXEL_BYTES);
    if (!fits_memory(file, name, entry))
        return;
    if (!fault && entry->kind == STORE_PICTURE_KEPT)
        fault = picture_decode(file->text, &header, &entry->picture);
    else if (!fault && entry->kind == STORE_PICTURE_CHECKED)
        fault = picture_check(file->text, &header);
    entry->picture.ignored = header.ignored;
    entry->picture.clear_pixels = header.clear_pixels;
    if (fault == picture_no_memory)
        asset_report_memory(file, ARENA_FAULT_SYSTEM);
    else
        entry->picture_fault = fault;
}

static void read_image(struct loader *loader, struct asset_file *file, str name, struct store_entry *entry) {
    struct arena *scratch = &loader->hold->scratch;
    arena_init(scratch, limits_size(file->input->limits, LIMIT_IMAGE_BYTES) + ASSET_TEXT_ROOM);
    const double start = clock_seconds();
    if (file->text.len || asset_read(file, scratch))
        decode_image(file, name, entry);
    timeline_add(loader->input->timeline, "image", file->path, start);
    file->text = STR("");
    arena_finish(scratch);
    if (file->errors == 0)
        store_complete(loader->hold, entry);
}

// An image of which at least as much is known as is asked for.
struct store_entry *loader_find_image(struct loader *loader, const struct file_read *identity) {
    const enum assets_pixels pixels = loader->pixels;
    static const enum store_kind kinds[] = {[ASSETS_KEEP_PIXELS] = STORE_PICTURE_KEPT,
                                            [ASSETS_CHECK_PIXELS] = STORE_PICTURE_CHECKED,
                                            [ASSETS_SKIP_PIXELS] = STORE_PICTURE_SKIPPED};
    for (enum assets_pixels known = ASSETS_KEEP_PIXELS; known < pixels; known++) {
        struct store_entry *entry = store_find(loader->hold, kinds[known], identity);
        if (entry)
            return entry;
    }
    struct store_entry *entry = store_find(loader->hold, kinds[pixels], identity);
    return entry ? entry : store_add(loader->hold, kinds[pixels], identity);
}

static void report_clear(struct asset_file *file, const struct picture *picture) {
    const double share = (double)picture->clear_pixels / ((double)picture->width * picture->height);
    if (asset_report_line(file, DIAG_IMAGE_CLEAR, 0,
                          "the image is not opaque in %.3g %% of its pixels, and is drawn as if it were",
                          100 * share))
        diag_help(
            file->input->sink,
            "its pixels show the colours that they have beneath their alpha; cut the shape out as a mesh, "
            "or save the image without alpha");
}

const struct picture *loader_judge_image(struct asset_file *file, struct store_entry *entry, bool is_solid) {
    if (entry->picture_fault)
        asset_report_line(file, DIAG_IMAGE_BROKEN, 0, "the image cannot be decoded: %s",
                          entry->picture_fault);
    if (file->errors)
        return NULL;
    if (entry->picture.ignored)
        asset_report_line(file, DIAG_IMAGE_CHUNKS, 0, "the image's %s ignored", entry->picture.ignored);
    if (entry->picture.clear_pixels && !is_solid)
        report_clear(file, &entry->picture);
    return &entry->picture;
}

void loader_complete_image(struct loader *loader, struct asset_file *file, str name,
                           struct store_entry *entry) {
    if (!entry->is_whole)
        read_image(loader, file, name, entry);
    else
        fits_memory(file, name, entry);
}

struct store_entry *loader_read_image(struct loader *loader, struct asset_file *file, str name,
                                      const struct file_read *identity) {
    struct store_entry *entry = loader_find_image(loader, identity);
    if (entry)
        loader_complete_image(loader, file, name, entry);
    else
        asset_report_memory(file, ARENA_FAULT_SYSTEM);
    return entry;
}
