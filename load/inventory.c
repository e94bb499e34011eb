#include "load/inventory.h"

#include "grammar/ir.h"
#include "grammar/schema.h"

const char *inventory_role_name(enum inventory_role role) {
    static const char *const names[INVENTORY_ROLES] = {"scene", "include", "mesh",    "materials",
                                                       "image", "font",    "settings"};
    return names[role];
}

// The path of an include as it is written, from the place of the include.
static str include_name(const struct session *session, span at) {
    for (uint32_t f = 0; f < session->origin.files.count; f++) {
        const struct ir_scene *scene = session->origin.files.items[f].scene;
        for (uint32_t i = 0; scene && i < scene->includes.count; i++) {
            const struct ir_include *include = &scene->includes.items[i];
            if (span_equal(ir_place_value(&session->origin, &include->head, &SCHEMA_INCLUDE, "file"), at))
                return include->file;
        }
    }
    return STR("");
}

static void add_scene_files(struct session *session, struct inventory *out) {
    for (uint32_t i = 0; i < session->origin.files.count; i++) {
        const struct ir_file_origin *file = &session->origin.files.items[i];
        const struct source *source = &session->sources.items[file->source];
        if (source->kind == SOURCE_KIND_GENERATED)
            continue; // the main file is a mesh; it follows as a mesh
        *ARENA_PUSH(&session->arena, out) =
            (struct inventory_use){.role = i == 0 ? INVENTORY_SCENE : INVENTORY_INCLUDE,
                                   .named = i == 0 ? STR("") : include_name(session, file->included_at),
                                   .path = source->path,
                                   .canonical = files_canonical(&session->files, source->path),
                                   .size_bytes = source->text.len,
                                   .at = file->included_at};
    }
}

static enum inventory_role role_of(const struct asset_use *use) {
    // A material file names images; a mesh names material files.
    if (use->named_in.len)
        return assets_is_mesh_path(use->named_in) ? INVENTORY_MATERIALS : INVENTORY_IMAGE;
    return assets_is_mesh_path(use->path)                  ? INVENTORY_MESH
           : schema_file_fits(SCHEMA_FILE_FONT, use->path) ? INVENTORY_FONT
                                                           : INVENTORY_IMAGE;
}

static void add_assets(struct session *session, struct inventory *out) {
    const struct asset_uses *uses = &session->assets.uses;
    for (uint32_t i = 0; i < uses->count; i++) {
        const struct asset_use *use = &uses->items[i];
        *ARENA_PUSH(&session->arena, out) = (struct inventory_use){.role = role_of(use),
                                                                   .named = use->named,
                                                                   .path = use->path,
                                                                   .canonical = use->canonical,
                                                                   .size_bytes = use->size_bytes,
                                                                   .at = use->at,
                                                                   .named_in = use->named_in,
                                                                   .named_line = use->named_line};
    }
}

static void add_settings(struct session *session, struct inventory *out) {
    str path = session->config.path;
    str canonical = path.len ? files_canonical(&session->files, path) : path;
    for (uint32_t i = 0; i < session->files.log.count; i++) {
        const struct file_read *read = &session->files.log.items[i];
        if (!str_equal(read->path, canonical))
            continue;
        *ARENA_PUSH(&session->arena, out) = (struct inventory_use){
            .role = INVENTORY_SETTINGS, .path = path, .canonical = canonical, .size_bytes = read->size_bytes};
    }
}

struct listing {
    struct session *session;
    struct inventory *out;
};

static void add_all(void *context) {
    const struct listing *listing = context;
    add_scene_files(listing->session, listing->out);
    add_assets(listing->session, listing->out);
    add_settings(listing->session, listing->out);
}

bool inventory_make(struct session *session, struct inventory *out) {
    struct listing listing = {session, out};
    *out = (struct inventory){0};
    return arena_guarded(&session->arena, add_all, &listing) == ARENA_FAULT_NONE;
}

bool inventory_is_repeat(const struct inventory *inventory, uint32_t use) {
    for (uint32_t i = 0; i < use; i++)
        if (str_equal(inventory->items[i].canonical, inventory->items[use].canonical))
            return true;
    return false;
}
