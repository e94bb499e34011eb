// Includes: which files belong to the scene, in which order, and why one cannot be read.
#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "diag/codes/reference.h"
#include "diag/diag_outside.h"
#include "grammar/ir.h"
#include "parser/stages/loader.h"
#include "parser/tree/reader_text.h"

#include <inttypes.h>
#include <string.h>

static str shown(const struct loader *loader, uint32_t file) {
    return path_base(loader->input->sources->items[loader->files.items[file].source].path);
}

static void report_missing(struct loader *loader, span at, str path, str tried) {
    struct diag_sink *sink = loader->input->sink;
    diag_add(sink, DIAG_FILE_MISSING, at, "the included file '%.*s' does not exist", STR_ARG(path));
    str near = files_suggest(loader->input->files, tried, schema_file_endings(SCHEMA_FILE_SCENE));
    str folder = str_slice(path, 0, path.len - path_base(path).len);
    str advice = files_advice(loader->input->arena, path);
    if (advice.len) {
        diag_help(sink, "%.*s", STR_ARG(advice));
    } else if (near.len) {
        diag_help(sink, "did you mean '%.*s%.*s'?", STR_ARG(folder), STR_ARG(near));
        diag_fix_part(sink, loader->input->sources, false, path_base(path), near);
    } else {
        diag_help(sink, "glint looked for '%.*s'; --asset-path DIR adds a folder to look in", STR_ARG(tried));
    }
}

static void note_unread(struct loader *loader, span at) {
    if (span_is_none(loader->output->unread))
        loader->output->unread = at;
}

static void refuse(struct loader *loader, span at, str path, str tried, enum file_status status) {
    struct diag_sink *sink = loader->input->sink;
    note_unread(loader, at);
    switch (status) {
    case FILE_MISSING:
        report_missing(loader, at, path, tried);
        return;
    case FILE_OUTSIDE:
        diag_add(sink, DIAG_FILE_OUTSIDE, at,
                 "the included file '%.*s' lies outside the scene's folder: '%.*s'", STR_ARG(path),
                 STR_ARG(tried));
        diag_outside(sink, loader->input->files, path, tried);
        return;
    case FILE_NOT_REGULAR:
        diag_add(sink, DIAG_FILE_NOT_REGULAR, at, "the included file '%.*s' is not a regular file",
                 STR_ARG(path));
        diag_help(sink, "name a scene file; folders are not read");
        return;
    case FILE_TOO_LARGE:
        reader_limit(sink, loader->input->limits, LIMIT_SCENE_BYTES, at, "the included file is too large");
        return;
    case FILE_NO_MEMORY:
        diag_add(sink, DIAG_OUT_OF_MEMORY, at, "there is not enough memory for the included file '%.*s'",
                 STR_ARG(path));
        return;
    default:
        diag_add(sink, DIAG_FILE_UNREADABLE, at, "the included file '%.*s' cannot be read: %s", STR_ARG(path),
                 file_status_text(loader->input->files, status));
    }
}

// Meshes and images are named by attributes of their own.
static bool is_other_kind(struct loader *loader, span at, str path) {
    static const char *const others[] = {".mtl", ".gltf", ".glb", ".exr", ".bmp",
                                         ".tga", ".tiff", ".ppm", ".pfm", NULL};
    bool is_other = schema_file_fits(SCHEMA_FILE_MESH, path) || schema_file_fits(SCHEMA_FILE_IMAGE, path);
    for (const char *const *ending = others; *ending; ending++)
        is_other = is_other || str_ends_with_nocase(path, *ending);
    if (!is_other)
        return false;
    diag_add(loader->input->sink, DIAG_FILE_KIND, at, "'%.*s' is not a scene file", STR_ARG(path));
    diag_help(loader->input->sink, "scene files end in .yaml, .yml, .json or .xml; a mesh belongs in "
                                   "'mesh' of a model, an image in 'image' of the background");
    note_unread(loader, at);
    return true;
}

static void report_cycle(struct loader *loader, uint32_t from, uint32_t to, span at) {
    struct diag_sink *sink = loader->input->sink;
    loader->incomplete = true;
    diag_add(sink, DIAG_INCLUDE_CYCLE, at, "'%.*s' includes itself", STR_ARG(shown(loader, to)));
    uint32_t chain[256];
    uint32_t count = 0;
    for (uint32_t f = from; f != to && count < sizeof chain / sizeof *chain;
         f = loader->files.items[f].parent)
        chain[count++] = f;
    while (count > 0) {
        const struct loader_file *file = &loader->files.items[chain[--count]];
        diag_note(sink, file->include, "'%.*s' includes '%.*s'", STR_ARG(shown(loader, file->parent)),
                  STR_ARG(shown(loader, chain[count])));
    }
    if (from != to)
        diag_note(sink, at, "'%.*s' includes '%.*s'", STR_ARG(shown(loader, from)),
                  STR_ARG(shown(loader, to)));
    diag_help(sink, "remove one of these includes");
}

static uint32_t depth_of(const struct loader *loader, uint32_t file) {
    uint32_t depth = 0;
    for (; file != 0; file = loader->files.items[file].parent)
        depth++;
    return depth;
}

// Whether the file at `tried` must still be read.
static bool is_new(struct loader *loader, uint32_t from, str tried, span at) {
    str canonical = files_canonical(loader->input->files, tried);
    for (uint32_t i = 0; i < loader->files.count; i++) {
        if (!str_equal(loader->files.items[i].path, canonical))
            continue;
        if (loader->files.items[i].open)
            report_cycle(loader, from, i, at);
        return false;
    }
    const struct limits *limits = loader->input->limits;
    bool too_deep = depth_of(loader, from) >= limits->value[LIMIT_INCLUDE_DEPTH];
    bool too_many = loader->files.count > limits->value[LIMIT_INCLUDE_FILES];
    if (too_deep)
        reader_limit(loader->input->sink, limits, LIMIT_INCLUDE_DEPTH, at,
                     "the chain of includes is too long");
    else if (too_many && loader->refused.count++ == 0)
        loader->refused.first = at;
    if (too_deep || too_many)
        note_unread(loader, at);
    return !too_deep && !too_many;
}

static void include_one(struct loader *loader, uint32_t from, const struct ir_include *include) {
    const struct parser_input *input = loader->input;
    if (include->file.len == 0) {
        loader->incomplete = true; // it has been reported
        return;
    }
    span at = ir_place_value(&loader->output->origin, &include->head, &SCHEMA_INCLUDE, "file");
    str base = input->sources->items[loader->files.items[from].source].path;
    str path;
    str text;
    if (is_other_kind(loader, at, include->file))
        return;
    enum file_status status = files_resolve(input->files, base, include->file, &path);
    if (status == FILE_OK && !is_new(loader, from, path, at))
        return;
    if (status == FILE_OK)
        status = files_read(input->files, path, input->limits->value[LIMIT_SCENE_BYTES], input->arena, &text);
    if (status != FILE_OK) {
        refuse(loader, at, include->file, path, status);
        return;
    }
    uint32_t source = source_add(input->sources, SOURCE_KIND_FILE, path, text);
    uint32_t file = loader_add_file(loader, source, from, at);
    resolve_includes(loader, file);
}

// Reported once for all of them.
static void report_refused(const struct loader *loader) {
    const struct limit_info *info = limit_info(LIMIT_INCLUDE_FILES);
    const uint64_t all = loader->files.count - 1 + (uint64_t)loader->refused.count;
    struct diag_sink *sink = loader->input->sink;
    if (loader->refused.count == 0)
        return;
    diag_add(sink, DIAG_LIMIT, loader->refused.first,
             "the scene includes too many files: %" PRIu64 ", where the limit %s is %" PRIu64, all,
             info->name, loader->input->limits->value[LIMIT_INCLUDE_FILES]);
    if (all <= info->greatest)
        diag_help(sink, "if this is intended, raise the limit: --limit %s=%" PRIu64, info->name, all);
}

void resolve_includes(struct loader *loader, uint32_t file) {
    const struct ir_scene *scene = loader->files.items[file].scene;
    loader->files.items[file].open = true;
    for (uint32_t i = 0; scene && i < scene->includes.count; i++)
        include_one(loader, file, &scene->includes.items[i]);
    loader->files.items[file].open = false;
    uint32_t *order = ARENA_PUSH(loader->input->arena, &loader->order);
    *order = file;
    if (file == 0)
        report_refused(loader);
}

// Notes.

void resolve_note_unread(struct loader *loader, span at, str message) {
    struct diag_sink *sink = loader->input->sink;
    for (uint32_t i = 0; i < sink->count; i++) {
        const span there = sink->items[i].at, unread = loader->output->unread;
        if (there.source == unread.source && there.begin == unread.begin &&
            sink->items[i].severity == DIAG_ERROR) {
            diag_note_to(sink, &sink->items[i], at, "%.*s", STR_ARG(message));
            return;
        }
    }
}

static struct diag *first_diag(struct diag_sink *sink, uint32_t source) {
    struct diag *first = NULL;
    for (uint32_t i = 0; i < sink->count; i++) {
        struct diag *d = &sink->items[i];
        if (d->at.source == source && (!first || d->at.begin < first->at.begin))
            first = d;
    }
    return first;
}

void resolve_note_includes(struct loader *loader) {
    struct diag_sink *sink = loader->input->sink;
    for (uint32_t i = 1; i < loader->files.count; i++) {
        struct diag *d = first_diag(sink, loader->files.items[i].source);
        if (!d || d->code == DIAG_INCLUDE_CYCLE) // a cycle shows its own chain
            continue;
        for (uint32_t f = i; f != 0; f = loader->files.items[f].parent)
            diag_note_to(sink, d, loader->files.items[f].include, "included here");
    }
}
