// Image files: found in the store or read, and checked.
#include "assets/loader.h"
#include "core/clock.h"
#include "core/timeline.h"
#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "grammar/ir.h"
#include "picture/read/picture_read.h"

// Bytes of memory per pixel besides the pixel itself, by depth: for a background, the device's texels; for a
// surface's image also its levels, and those of the device.
struct pixel_cost {
    uint32_t background, surface;
};

static struct pixel_cost cost_of(const struct assets_input *input, enum picture_depth depth) {
    static const struct pixel_cost costs[] = {[PICTURE_8] = {4, 10},
                                              [PICTURE_16] = {16, 26},
                                              [PICTURE_RGBE] = {16, 26},
                                              [PICTURE_FLOAT] = {16, 26}};
    struct pixel_cost cost = costs[depth];
    if (input->scene->image.transfer == IR_TRANSFER_SRGB)
        cost.background = 16;
    return cost;
}

uint64_t loader_image_memory(const struct assets_input *input, const struct picture *picture,
                             uint64_t decoder_bytes, bool is_background) {
    const struct pixel_cost cost = cost_of(input, picture->depth);
    const uint64_t each =
        picture_pixel_bytes(picture->depth) + (is_background ? cost.background : cost.surface);
    const uint64_t pixels = (uint64_t)picture->width * picture->height;
    return pixels > (UINT64_MAX - decoder_bytes) / each ? UINT64_MAX : pixels * each + decoder_bytes;
}

static void help_limit(struct asset_file *file, enum limit which, uint64_t bytes) {
    const struct limit_info *info = limit_info(which);
    if (bytes <= info->greatest)
        diag_help(file->input->sink, "if the file is right, raise the limit: --limit %s=%llu", info->name,
                  (unsigned long long)bytes);
    else
        diag_help(file->input->sink, "no limit allows more than %llu bytes; make the image smaller",
                  (unsigned long long)info->greatest);
}

static bool fits_memory(struct asset_file *file, str name, const struct picture *picture, uint64_t bytes) {
    const struct limit_info *info = limit_info(LIMIT_IMAGE_MEMORY);
    if (bytes <= file->input->limits->value[LIMIT_IMAGE_MEMORY])
        return true;
    asset_report_named(
        file, DIAG_LIMIT,
        "the image '%.*s' claims %u x %u pixels, which take %llu bytes of memory; the limit %s "
        "is %llu",
        STR_ARG(name), picture->width, picture->height, (unsigned long long)bytes, info->name,
        (unsigned long long)file->input->limits->value[LIMIT_IMAGE_MEMORY]);
    help_limit(file, LIMIT_IMAGE_MEMORY, bytes);
    return false;
}

// Neither one small file nor many of them can take much memory. Reported once, for all that do not fit.
static bool fits_scene(struct loader *loader, struct asset_file *file, str name, uint64_t bytes,
                       uint64_t file_bytes) {
    loader->held.file_bytes += file_bytes;
    if (asset_fits_growth(file->input, loader->held.bytes + bytes, loader->held.file_bytes)) {
        loader->held.bytes += bytes;
        return true;
    }
    if (loader->unfit_images.count++ == 0) {
        loader->unfit_images.first = asset_keep(file);
        loader->unfit_images.name = arena_copy(loader->input->arena, name);
        loader->unfit_images.first_sum = loader->held.bytes + bytes;
        loader->unfit_images.first_file_bytes = loader->held.file_bytes;
    }
    loader->unfit_images.bytes += bytes;
    file->errors++;
    return false;
}

void loader_report_unfit_images(struct loader *loader) {
    const uint32_t count = loader->unfit_images.count;
    const uint64_t most = loader->input->limits->value[LIMIT_IMAGE_GROWTH];
    if (count == 0)
        return;
    asset_report_named(loader->unfit_images.first, DIAG_LIMIT,
                       "with the image '%.*s' the images take %llu bytes of memory, and their files have "
                       "%llu bytes; the limit %s is %llu, or %d for each byte of the files",
                       STR_ARG(loader->unfit_images.name), (unsigned long long)loader->unfit_images.first_sum,
                       (unsigned long long)loader->unfit_images.first_file_bytes,
                       limit_info(LIMIT_IMAGE_GROWTH)->name, (unsigned long long)most, ASSET_IMAGE_GROWTH);
    if (count > 1)
        diag_note(loader->input->sink, SPAN_NONE, "%u further image%s not fit either", count - 1,
                  count == 2 ? " does" : "s do");
    help_limit(loader->unfit_images.first, LIMIT_IMAGE_GROWTH,
               loader->held.bytes + loader->unfit_images.bytes);
}

bool loader_image_fits(struct loader *loader, struct asset_file *file, str name,
                       const struct store_entry *entry, struct image_role role) {
    const uint64_t bytes =
        loader_image_memory(file->input, &entry->picture, entry->decoder_bytes, role.is_background);
    return fits_memory(file, name, &entry->picture, bytes) &&
           fits_scene(loader, file, name, bytes, role.file_bytes);
}

// Reads the file's bytes; a fault of the decoder is left in the entry.
static void decode_image(struct loader *loader, struct asset_file *file, str name, struct store_entry *entry,
                         struct image_role role) {
    struct picture_header header;
    const char *fault = picture_read_header(file->text, &header);
    if (header.kind == IMAGE_NONE) {
        asset_report_named(file, DIAG_IMAGE_KIND, "'%.*s' is not a " IMAGE_IN_SCENE_NAMES " image",
                           STR_ARG(name));
        return;
    }
    entry->picture = picture_of_header(&header);
    entry->decoder_bytes = header.decoder_bytes;
    if (!fault && !loader_image_fits(loader, file, name, entry, role))
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

static void read_image(struct loader *loader, struct asset_file *file, str name, struct store_entry *entry,
                       struct image_role role) {
    struct arena *scratch = &loader->hold->scratch;
    arena_init(scratch, limits_size(file->input->limits, LIMIT_IMAGE_BYTES) + ASSET_TEXT_ROOM);
    const double start = clock_seconds();
    if (file->text.len || asset_read(file, scratch))
        decode_image(loader, file, name, entry, role);
    timeline_add(loader->input->timeline, "image", file->path, start);
    file->text = STR("");
    arena_finish(scratch);
    if (file->errors == 0)
        store_complete(loader->hold, entry);
}

// An image of which at least as much is known as requested.
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
                           struct store_entry *entry, struct image_role role) {
    if (!entry->is_whole)
        read_image(loader, file, name, entry, role);
    else if (!entry->picture_fault)
        loader_image_fits(loader, file, name, entry, role);
}

struct store_entry *loader_read_image(struct loader *loader, struct asset_file *file, str name,
                                      const struct file_read *identity, struct image_role role) {
    struct store_entry *entry = loader_find_image(loader, identity);
    if (entry)
        loader_complete_image(loader, file, name, entry, role);
    else
        asset_report_memory(file, ARENA_FAULT_SYSTEM);
    return entry;
}
