#include "assets/assets.h"

#include "assets/ahead.h"
#include "assets/gltf/asset_gltf.h"
#include "assets/loader.h"
#include "assets/mesh_build.h"
#include "assets/mesh_losses.h"
#include "assets/meshes_ahead.h"
#include "core/clock.h"
#include "core/strbuf.h"
#include "core/timeline.h"
#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "diag/codes/rule.h"
#include "grammar/ir.h"
#include "grammar/ir_walk.h"
#include "grammar/mesh_format.h"
#include "grammar/schema.h"
#include "picture/read/picture_read.h"

#include <assert.h>

static bool is_poisoned(const struct ir_head *head, const struct schema_element *schema, const char *row) {
    return head->poisoned >> schema_find_row(schema, str_from(row)) & 1;
}

// ---- meshes

bool assets_is_mesh_path(str path) {
    return mesh_format_of_path(path) != MESH_FORMAT_COUNT;
}

static void report_mesh_kind(struct asset_file *file) {
    str base = path_base(file->path);
    size_t dot = base.len;
    while (dot > 0 && base.ptr[dot - 1] != '.')
        dot--;
    if (dot == 0)
        asset_report_named(file, DIAG_FILE_KIND, "'%.*s' has no extension that shows its kind",
                           STR_ARG(base));
    else
        asset_report_named(file, DIAG_FILE_KIND, "meshes of the kind '.%.*s' are not supported",
                           STR_ARG(str_slice(base, dot, base.len)));
    diag_help(file->input->sink, "glint reads %.*s; a 3D program can convert other meshes",
              STR_ARG(mesh_format_words(file->input->arena)));
}

// Shown whole, the mesh would not be what the scene asks for.
static bool can_have_part(struct asset_file *file) {
    const enum mesh_format_id format = mesh_format_of_path(file->path);
    if (file->part.len == 0 || mesh_formats[format].traits & MESH_HOLDS_BODIES)
        return true;
    asset_report_part(file, "'part' has no meaning here: '%.*s' is %s, which is one body",
                      STR_ARG(file->path), mesh_formats[format].called);
    diag_help(file->input->sink, "leave 'part' out%s",
              mesh_formats[format].traits & MESH_HOLDS_PARTS
                  ? "; 'material_map' gives its groups materials by their names"
                  : "");
    return false;
}

struct mesh_reading {
    struct asset_file *file;
    struct arena *scratch;
    struct mesh *mesh;
};

static void read_mesh(void *context) {
    const struct mesh_reading *r = context;
    if (r->file->document || asset_read(r->file, r->scratch))
        mesh_read(r->file, r->scratch, r->mesh);
}

static void read_mesh_guarded(struct asset_file *file, struct arena *scratch, struct mesh *mesh) {
    struct mesh_reading reading = {file, scratch, mesh};
    struct arena *arenas[] = {scratch, &mesh->arena, NULL};
    if (file->document) {
        gltf_document_guarded(file->document, arenas, read_mesh, &reading);
        file->errors += file->document->file.errors;
        return;
    }
    enum arena_fault fault = arena_guarded_all(arenas, read_mesh, &reading);
    if (fault)
        asset_report_memory(file, fault);
}

// Reports what is notable about a mesh, whether it was read now or for an earlier scene.
static void report_mesh(struct asset_file *file, const struct mesh *mesh) {
    file->is_binary = mesh->is_binary;
    if (mesh->turned)
        asset_report_line(file, DIAG_MESH_TURNED, 0,
                          "the faces of this closed mesh point inwards and were turned outwards");
    mesh_losses_report(file, mesh);
}

// Reads the mesh now, unless it was read ahead.
static void fill_mesh(struct loader *loader, struct asset_file *file, const struct file_read *identity,
                      struct store_entry *entry) {
    const size_t cap = limits_size(loader->input->limits, LIMIT_MESH_MEMORY);
    struct arena *scratch = &loader->hold->scratch;
    if (meshes_ahead_take(loader->ahead, identity, &entry->mesh)) {
        store_complete(loader->hold, entry);
        report_mesh(file, &entry->mesh);
        return;
    }
    arena_init(scratch, cap);
    arena_init(&entry->mesh.arena, cap);
    const double start = clock_seconds();
    read_mesh_guarded(file, scratch, &entry->mesh);
    timeline_add(loader->input->timeline, "mesh", file->path, start);
    if (file->errors == 0) {
        store_complete(loader->hold, entry);
        report_mesh(file, &entry->mesh);
    } else
        arena_finish(&entry->mesh.arena);
    file->text = STR("");
    arena_finish(scratch);
}

static void load_mesh(struct loader *loader, struct loaded_mesh *loaded, const struct file_read *identity) {
    struct file_read key = *identity; // a part of a file is a mesh of its own
    if (loaded->part.len)
        key.path = arena_format(loader->input->arena, "%.*s\n%.*s", STR_ARG(key.path), STR_ARG(loaded->part));
    struct store_entry *entry = store_find(loader->hold, STORE_MESH, &key);
    if (entry) {
        report_mesh(&loaded->file, &entry->mesh);
    } else {
        entry = store_add(loader->hold, STORE_MESH, &key);
        if (!entry) {
            asset_report_memory(&loaded->file, ARENA_FAULT_SYSTEM);
            return;
        }
        fill_mesh(loader, &loaded->file, identity, entry);
    }
    loaded->mesh = loaded->own = entry->is_whole ? &entry->mesh : NULL;
}

// The file that a model names, read when the first model names it.
static struct loaded_mesh *mesh_of_model(struct loader *loader, const struct ir_model *model, span at) {
    const struct assets_input *input = loader->input;
    struct asset_file file = {.input = input, .what = "mesh", .limit = LIMIT_MESH_BYTES, .named_at = at};
    struct file_read identity;
    // Thousands of models may name one mesh: the first of them has already checked that its file exists.
    for (struct loaded_mesh *known = loader->meshes; known; known = known->next)
        if (known->file.named_at.source == at.source && str_equal(known->name, model->mesh.name) &&
            str_equal(known->part, model->part)) {
            asset_note_again(&known->file, at, known->name, known->canonical, known->size_bytes);
            return known;
        }
    if (!asset_find(&file, asset_base(input, at), model->mesh.name, &identity, NULL))
        return NULL;
    for (struct loaded_mesh *known = loader->meshes; known; known = known->next)
        if (str_equal(known->canonical, identity.path) && str_equal(known->part, model->part))
            return known;
    if (!assets_is_mesh_path(model->mesh.name)) {
        report_mesh_kind(&file);
        return NULL;
    }
    struct loaded_mesh *loaded = ARENA_NEW(input->arena, struct loaded_mesh);
    loaded->file = file;
    loaded->name = model->mesh.name;
    loaded->part = model->part;
    loaded->file.part = model->part;
    loaded->file.part_at = ir_place_value(input->origin, &model->head, &SCHEMA_MODEL, "part");
    loaded->size_bytes = identity.size_bytes;
    loaded->canonical = arena_copy(input->arena, identity.path);
    loaded->next = loader->meshes;
    loader->meshes = loaded;
    if (!can_have_part(&loaded->file))
        return loaded;
    if (loader_open_document(loader, &loaded->file, &identity) && loaded->file.errors == 0)
        load_mesh(loader, loaded, &identity);
    return loaded;
}

static struct loaded_mesh *made_mesh_of_model(struct loader *loader, const struct ir_model *model) {
    struct loaded_mesh *loaded = loader_made_mesh(loader, model->mesh.index);
    if (model->part.len && !loaded->part_told) {
        diag_add(loader->input->sink, DIAG_UNKNOWN_PART,
                 ir_place_value(loader->input->origin, &model->head, &SCHEMA_MODEL, "part"),
                 "'part' has no meaning here: a mesh that the scene describes is one body");
        diag_help(loader->input->sink, "leave 'part' out");
        loaded->part_told = true;
    }
    return loaded;
}

// ---- models

// A mesh counts once, however many models show it. Meshes that do not fit are reported once, by report_unfit:
// every further model would say the same.
static bool fits_scene(struct loader *loader, struct assets *out, struct loaded_mesh *loaded, span at) {
    const struct mesh *mesh = loaded->mesh;
    const uint32_t added = loaded->is_counted ? 0 : mesh->triangle_count;
    const uint64_t sum = out->held_triangles + added;
    if (loaded->is_counted || sum <= loader->input->limits->value[LIMIT_SCENE_TRIANGLES]) {
        loaded->is_counted = true;
        out->held_triangles = sum;
        out->triangle_count += mesh->triangle_count;
        return true;
    }
    if (loader->unfit.models++ == 0) {
        loader->unfit.first = at;
        loader->unfit.first_mesh = mesh->triangle_count;
        loader->unfit.first_sum = sum;
    }
    loader->unfit.triangles += loaded->is_unfit ? 0 : mesh->triangle_count;
    loaded->is_unfit = true;
    return false;
}

static void report_unfit(const struct loader *loader, const struct assets *out) {
    const struct limit_info *info = limit_info(LIMIT_SCENE_TRIANGLES);
    const uint64_t all = out->held_triangles + loader->unfit.triangles;
    const uint32_t further = loader->unfit.models - 1;
    struct diag_sink *sink = loader->input->sink;
    if (loader->unfit.models == 0)
        return;
    diag_add(sink, DIAG_LIMIT, loader->unfit.first,
             "with this mesh of %u triangles the scene has %llu; the limit %s is %llu",
             loader->unfit.first_mesh, (unsigned long long)loader->unfit.first_sum, info->name,
             (unsigned long long)loader->input->limits->value[LIMIT_SCENE_TRIANGLES]);
    if (further)
        diag_note(sink, SPAN_NONE,
                  "%u further model%s not fit either; with all of them the scene has %llu triangles", further,
                  further == 1 ? " does" : "s do", (unsigned long long)all);
    if (all <= info->greatest)
        diag_help(sink, "if the scene is right, raise the limit: --limit %s=%llu", info->name,
                  (unsigned long long)all);
}

static void check_refraction(struct loader *loader, const struct ir_model *model,
                             const struct assets_model *loaded_model, struct loaded_mesh *loaded, span at) {
    const struct mesh *mesh = loaded->mesh;
    if (mesh->closed || loaded->no_refraction == loaded_model->group_material)
        return;
    bool refracts = false;
    for (uint32_t i = 0; i < mesh->group_count; i++)
        refracts |= loader->materials.items[loaded_model->group_material[i]].albedo.refraction > 0;
    if (!refracts) {
        loaded->no_refraction = loaded_model->group_material;
        return;
    }
    struct diag_sink *sink = loader->input->sink;
    span place = model->material.name.len || model->material.index != IR_NO_INDEX
                     ? ir_place_value(loader->input->origin, &model->head, &SCHEMA_MODEL, "material")
                     : at;
    diag_add(sink, DIAG_OPEN_DIELECTRIC, place,
             "the mesh '%.*s' is open and its material refracts: it will look like a thin pane",
             STR_ARG(loaded->name));
    if (loaded->made) {
        if (loaded->made->kind == IR_MESH_FACES)
            diag_note(sink,
                      ir_place_label(loader->input->origin,
                                     &loaded->made->faces.faces.items[mesh->open_line - 1].head),
                      "%u edge%s to only one face, the first to this face", mesh->open_edges,
                      mesh->open_edges == 1 ? " belongs" : "s belong");
        diag_help(sink, "close the mesh, or set the material's refraction to 0");
        return;
    }
    span line = asset_line(&loaded->file, mesh->open_line);
    const char *belong = mesh->open_edges == 1 ? " belongs" : "s belong";
    if (mesh->is_binary)
        diag_note(sink, line, "%u edge%s to only one face, the first to face %u", mesh->open_edges, belong,
                  mesh->open_line);
    else
        diag_note(sink, line, "%u edge%s to only one face, the first to this face", mesh->open_edges, belong);
    diag_help(sink, "close the mesh, or set the material's refraction to 0");
}

static void load_model(struct loader *loader, struct assets *out, uint32_t index) {
    const struct ir_model *model = &loader->input->scene->models.items[index];
    struct assets_model *result = &out->models[index];
    span at = ir_place_value(loader->input->origin, &model->head, &SCHEMA_MODEL, "mesh");
    if (is_poisoned(&model->head, &SCHEMA_MODEL, "mesh"))
        return;
    struct loaded_mesh *loaded = model->mesh.index != IR_NO_INDEX ? made_mesh_of_model(loader, model)
                                 : loader_names_file(model)       ? mesh_of_model(loader, model, at)
                                                                  : NULL;
    if (!loaded || !loaded->mesh || !fits_scene(loader, out, loaded, at))
        return;
    result->group_material = loader_group_materials(loader, model, loaded);
    result->mesh = loaded->mesh;
    check_refraction(loader, model, result, loaded, at);
    loader_load_coordinates(loader, result, loaded);
    if (model->smooth && !loaded->normals_told && !loaded->made)
        mesh_losses_report_normals(&loaded->file, loaded->mesh);
    loaded->normals_told = loaded->normals_told || model->smooth;
}

// ---- the background

static const struct picture *load_background(struct loader *loader, struct assets *out) {
    const struct assets_input *input = loader->input;
    const struct ir_background *background = &input->scene->background;
    span at = ir_place_value(input->origin, &background->head, &SCHEMA_BACKGROUND, "image");
    struct asset_file file = {.input = input, .what = "image", .limit = LIMIT_IMAGE_BYTES, .named_at = at};
    struct file_read identity;
    if (!asset_find(&file, asset_base(input, at), background->image, &identity, NULL))
        return NULL;
    struct store_entry *entry = loader_find_image(loader, &identity);
    if (!entry) {
        asset_report_memory(&file, ARENA_FAULT_SYSTEM);
        return NULL;
    }
    const struct image_role role = {.is_background = true, .file_bytes = identity.size_bytes};
    out->pixels_later = !entry->is_whole && ahead_is_for(out->ahead, &identity, entry, &file);
    if (out->pixels_later)
        out->pixels_later = loader_image_fits(loader, &file, background->image, entry, role);
    if (out->pixels_later || file.errors)
        return out->pixels_later ? &entry->picture : NULL;
    loader_complete_image(loader, &file, background->image, entry, role);
    const struct picture *picture = loader_judge_image(&file, entry, false);
    out->pixels_skipped |= picture && entry->kind == STORE_PICTURE_SKIPPED;
    return picture;
}

void assets_settle(struct assets *assets) {
    struct store_entry *entry;
    struct asset_file *file = assets->pixels_later ? ahead_take(assets->ahead, &entry) : NULL;
    assets->pixels_later = false;
    if (!file)
        return;
    if (entry->picture_fault == picture_no_memory) {
        asset_report_memory(file, ARENA_FAULT_SYSTEM);
        entry->picture_fault = NULL;
    }
    if (file->errors == 0)
        store_complete(assets->hold, entry);
    assets->background = loader_judge_image(file, entry, false);
}

static bool has_background_image(const struct assets_input *input) {
    const struct ir_background *background = &input->scene->background;
    return background->kind == IR_BACKDROP_IMAGE && background->image.len &&
           !is_poisoned(&background->head, &SCHEMA_BACKGROUND, "image");
}

static struct asset_ahead *decode_ahead(const struct assets_input *input, struct asset_hold *hold) {
    return ahead_begin(input, hold,
                       asset_base(input, ir_place_value(input->origin, &input->scene->background.head,
                                                        &SCHEMA_BACKGROUND, "image")));
}

// ---- all

static void add_scene_materials(struct loader *loader) {
    const struct ir_materials *materials = &loader->input->scene->materials;
    for (uint32_t i = 0; i < materials->count; i++)
        *loader_add_material(loader, (struct material_source){0}) = materials->items[i];
    schema_init(&SCHEMA_MATERIAL, loader_add_material(loader, (struct material_source){0}));
}

void assets_load(struct asset_store *store, const struct assets_input *given, enum assets_pixels pixels,
                 struct assets *out) {
    assert(store);
    const struct ir_scene *scene = given->scene;
    *out = (struct assets){.hold = store_hold(store), .origin = given->origin};
    struct assets_input *input = ARENA_NEW(given->arena, struct assets_input);
    *input = *given;
    input->uses = &out->uses;
    if (!out->hold) {
        diag_add(input->sink, DIAG_OUT_OF_MEMORY, SPAN_NONE,
                 "there is not enough memory to load the scene's files");
        return;
    }
    struct loader loader = {.input = input, .hold = out->hold, .pixels = pixels};
    add_scene_materials(&loader);
    const bool has_image = has_background_image(input);
    // A background that lights is flattened with the scene.
    const bool waits = !scene->background.lights;
    if (has_image && waits && input->pixels_later && pixels == ASSETS_KEEP_PIXELS)
        out->ahead = decode_ahead(input, out->hold);
    out->models = ARENA_ARRAY(input->arena, struct assets_model, scene->models.count);
    out->model_count = scene->models.count;
    meshes_ahead_read(&loader, &out->meshes_ahead);
    loader.ahead = out->meshes_ahead;
    for (uint32_t i = 0; i < scene->models.count; i++)
        load_model(&loader, out, i);
    meshes_ahead_finish(out->meshes_ahead);
    out->meshes_ahead = NULL;
    for (uint32_t i = 0; i < scene->meshes.count; i++)
        loader_made_mesh(&loader, i); // what no model shows is checked too
    report_unfit(&loader, out);
    loader_load_textures(&loader, out);
    loader_close_documents(&loader);
    if (has_image)
        out->background = load_background(&loader, out);
    loader_report_unfit_images(&loader);
    out->materials = loader.materials.items;
    out->material_count = loader.materials.count;
    store_sweep(store);
}

void assets_finish(struct assets *assets) {
    if (!assets)
        return;
    ahead_finish(assets->ahead);
    meshes_ahead_finish(assets->meshes_ahead);
    store_release(assets->hold);
    *assets = (struct assets){0};
}
