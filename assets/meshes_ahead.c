#include "assets/meshes_ahead.h"

#include "assets/mesh_build.h"
#include "core/clock.h"
#include "core/heap.h"
#include "core/parallel.h"
#include "core/timeline.h"
#include "grammar/ir.h"
#include "grammar/mesh_format.h"
#include "grammar/schema.h"

#include <stdlib.h>

enum {
    GROUP_BYTES = 256 << 20, // bytes of the texts in memory at the same time
};

struct one {
    struct file_read identity;
    struct assets_input input; // with a sink that keeps nothing and only counts
    struct diag_sink sink;
    struct asset_file file; // its text while it is in memory
    struct arena scratch;
    struct mesh mesh;
    bool is_whole; // and not taken yet
};

struct meshes_ahead {
    struct one **items;
    uint32_t count, capacity;
    struct str_map names; // as models write them: 1 + the source that does
    struct str_map paths; // canonical: 1 + the index of its item
};

// ---- which

static struct one *add(struct meshes_ahead *ahead) {
    struct one **items = heap_grow(ahead->items, ahead->count, &ahead->capacity, sizeof *items);
    struct one *one = items ? heap_zeroed(1, sizeof *one) : NULL;
    ahead->items = items ? items : ahead->items;
    if (one)
        ahead->items[ahead->count++] = one;
    return one;
}

// Whether the model's mesh is seen for the first time; most models name the same mesh as the model before.
static bool is_new_name(struct meshes_ahead *ahead, str name, span at) {
    uint32_t *source = str_map_at(&ahead->names, name);
    const bool is_new = *source != at.source + 1;
    *source = at.source + 1;
    return is_new;
}

static void consider(struct meshes_ahead *ahead, const struct loader *loader, const struct ir_model *model) {
    const struct assets_input *input = loader->input;
    const span at = ir_place_value(input->origin, &model->head, &SCHEMA_MODEL, "mesh");
    struct file_read identity;
    str path;
    const enum mesh_format_id format = mesh_format_of_path(model->mesh.name);
    if (format == MESH_FORMAT_COUNT || format == MESH_FORMAT_GLTF ||
        !is_new_name(ahead, model->mesh.name, at) ||
        files_resolve(input->files, asset_base(input, at), model->mesh.name, &path) != FILE_OK ||
        files_identify(input->files, path, &identity) != FILE_OK || identity.size_bytes > GROUP_BYTES ||
        identity.size_bytes > input->limits->value[LIMIT_MESH_BYTES] ||
        str_map_find(&ahead->paths, identity.path) || store_find(loader->hold, STORE_MESH, &identity))
        return;
    struct one *one = add(ahead);
    if (!one)
        return;
    *one = (struct one){.identity = identity, .input = *input};
    one->input.sink = &one->sink;
    one->file =
        (struct asset_file){.input = &one->input, .path = path, .what = "mesh", .limit = LIMIT_MESH_BYTES};
    *str_map_at(&ahead->paths, identity.path) = ahead->count;
}

// ---- reading

static void parse(void *context) {
    struct one *one = context;
    mesh_read(&one->file, &one->scratch, &one->mesh);
}

static void parse_piece(void *context, size_t begin, size_t end) {
    struct one **items = context;
    for (size_t i = begin; i < end; i++) {
        struct one *one = items[i];
        struct arena *arenas[] = {&one->scratch, &one->mesh.arena, NULL};
        const double start = clock_seconds();
        if (one->file.text.len == 0)
            continue;
        const bool is_done = arena_guarded_all(arenas, parse, one) == ARENA_FAULT_NONE;
        timeline_add(one->input.timeline, "mesh", one->file.path, start);
        arena_finish(&one->scratch);
        one->is_whole = is_done && one->sink.errors + one->sink.warnings + one->sink.notes == 0;
        if (!one->is_whole)
            arena_finish(&one->mesh.arena);
    }
}

static void read_text(void *context) {
    struct one *one = context;
    struct files *files = one->input.files;
    if (files_read(files, one->file.path, one->identity.size_bytes, &one->scratch, &one->file.text) !=
        FILE_OK)
        one->file.text = STR("");
}

// Reads the text of the file as it was found, not of one that has grown since.
static void begin(struct one *one) {
    const size_t cap = limits_size(one->input.limits, LIMIT_MESH_MEMORY);
    arena_init(&one->scratch, cap);
    arena_init(&one->mesh.arena, cap);
    if (arena_guarded(&one->scratch, read_text, one) != ARENA_FAULT_NONE)
        one->file.text = STR("");
}

static int compare_sizes(const void *a, const void *b) {
    const struct one *x = *(struct one *const *)a, *y = *(struct one *const *)b;
    if (x->identity.size_bytes != y->identity.size_bytes)
        return x->identity.size_bytes > y->identity.size_bytes ? -1 : 1;
    return str_compare(x->identity.path, y->identity.path);
}

// The largest first, so that no large one is left for the end.
static void read_group(struct one **items, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        begin(items[i]);
    parallel_for(count, 1, parse_piece, items);
}

static void read_groups(struct meshes_ahead *ahead) {
    // Sorts the items into the order of reading, and rebuilds the map by which they are found.
    qsort(ahead->items, ahead->count, sizeof *ahead->items, compare_sizes);
    for (uint32_t i = 0; i < ahead->count; i++)
        *str_map_at(&ahead->paths, ahead->items[i]->identity.path) = i + 1;
    for (uint32_t first = 0, end; first < ahead->count; first = end) {
        uint64_t bytes = 0;
        for (end = first; end < ahead->count && bytes + ahead->items[end]->identity.size_bytes <= GROUP_BYTES;
             end++)
            bytes += ahead->items[end]->identity.size_bytes;
        read_group(ahead->items + first, end - first);
    }
}

void meshes_ahead_read(const struct loader *loader, struct meshes_ahead **out) {
    const struct assets_input *input = loader->input;
    const struct ir_scene *scene = input->scene;
    struct meshes_ahead *ahead = *out = scene->models.count > 1 ? heap_zeroed(1, sizeof *ahead) : NULL;
    if (!ahead || parallel_processors() == 1)
        return;
    str_map_init(&ahead->names, input->arena);
    str_map_init(&ahead->paths, input->arena);
    for (uint32_t i = 0; i < scene->models.count; i++)
        if (loader_names_file(&scene->models.items[i]))
            consider(ahead, loader, &scene->models.items[i]);
    // The log gets each file when it is used.
    const uint32_t logged = input->files->log.count;
    if (ahead->count > 1)
        read_groups(ahead);
    input->files->log.count = logged;
}

bool meshes_ahead_take(struct meshes_ahead *ahead, const struct file_read *identity, struct mesh *mesh) {
    const uint32_t at = ahead ? str_map_find(&ahead->paths, identity->path) : 0;
    struct one *one = at ? ahead->items[at - 1] : NULL;
    if (!one || !one->is_whole || one->identity.size_bytes != identity->size_bytes ||
        one->identity.modified_ns != identity->modified_ns)
        return false;
    *mesh = one->mesh;
    one->is_whole = false;
    return true;
}

void meshes_ahead_finish(struct meshes_ahead *ahead) {
    if (!ahead)
        return;
    for (uint32_t i = 0; i < ahead->count; i++) {
        arena_finish(&ahead->items[i]->scratch);
        if (ahead->items[i]->is_whole)
            arena_finish(&ahead->items[i]->mesh.arena);
        free(ahead->items[i]);
    }
    free(ahead->items);
    free(ahead);
}
