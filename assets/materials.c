// Which material each face of a model has.
#include "assets/loader.h"

#include "core/nearest.h"
#include "core/strbuf.h"
#include "diag/codes/file.h"
#include "diag/codes/reference.h"
#include "grammar/ir.h"
#include "grammar/mesh_format.h"
#include "grammar/schema.h"

#include <string.h>

enum {
    NAMES_SHOWN = 12,
    SEARCHES_MAX = 50, // up to this many errors list the names that a mesh has
};

static bool is_written(const struct ir_reference *ref) {
    return ref->name.len > 0 || ref->index != IR_NO_INDEX;
}

uint32_t assets_material(const struct ir_scene *scene, const struct ir_reference *ref) {
    return ref->index == IR_NO_INDEX ? scene->materials.count : ref->index;
}

struct ir_material *loader_add_material(struct loader *loader, struct material_source source) {
    *ARENA_PUSH(loader->input->arena, &loader->sources) = source;
    return ARENA_PUSH(loader->input->arena, &loader->materials);
}

// ---- material files

// Reads one material file if it can be found. A name with backslashes is tried with slashes too: it was
// written on another system.
static bool read_library(struct loader *loader, struct loaded_mesh *loaded, str name, uint32_t line) {
    struct asset_file *file =
        ARENA_NEW(loader->input->arena, struct asset_file); // its images are named in it
    *file = (struct asset_file){.input = loader->input,
                                .what = "material file",
                                .limit = LIMIT_MESH_BYTES,
                                .named_in = &loaded->file,
                                .named_line = line};
    struct file_read identity;
    bool missing = false;
    bool found = asset_find(file, loaded->file.path, name, &identity, &missing);
    if (missing && memchr(name.ptr, '\\', name.len)) {
        str slashed = arena_copy(loader->input->arena, name);
        for (char *c = (char *)slashed.ptr; *c; c++)
            *c = *c == '\\' ? '/' : *c;
        found = asset_find(file, loaded->file.path, slashed, &identity, &missing);
    }
    if (missing)
        return false;
    if (found && (*str_map_at(&loaded->library_paths, identity.path))++)
        return true;
    struct arena *scratch = &loader->hold->scratch;
    arena_init(scratch, limits_size(loader->input->limits, LIMIT_MESH_MEMORY));
    if (found && asset_read(file, scratch))
        read_mtl(file, &loaded->materials);
    file->text = STR("");
    arena_finish(scratch);
    loaded->library_missing |= file->errors > 0;
    return true;
}

static void report_missing_library(struct loaded_mesh *loaded, str name, uint32_t line) {
    loaded->library_missing = true;
    struct files *files = loaded->file.input->files;
    struct diag_sink *sink = loaded->file.input->sink;
    if (!asset_report_line(
            &loaded->file, DIAG_MTL_MISSING, line,
            "the material file '%.*s' does not exist; faces that need it get the default material",
            STR_ARG(name)))
        return;
    static const char *const endings[] = {".mtl", NULL};
    str tried = arena_format(files->arena, "%.*s/%.*s", STR_ARG(path_folder(loaded->file.path)),
                             STR_ARG(path_base(name)));
    str near = files_suggest(files, tried, endings);
    str advice = files_advice(files->arena, name);
    if (advice.len)
        diag_help(sink, "%.*s", STR_ARG(advice));
    else if (near.len)
        diag_help(sink, "did you mean '%.*s'?", STR_ARG(near));
    else
        diag_help(sink, "put the file into the folder of the mesh, or give the model a 'material'");
}

static void read_library_or_report(struct loader *loader, struct loaded_mesh *loaded, str name,
                                   uint32_t line) {
    if (!read_library(loader, loaded, name, line))
        report_missing_library(loaded, name, line);
}

// The end of the first of several names: after the first word that ends like a material file, else at the
// end.
static size_t first_name_end(str names) {
    for (size_t at = 1; at < names.len; at++) {
        bool ends = names.ptr[at] == ' ' || names.ptr[at] == '\t';
        if (ends && str_ends_with_nocase(str_slice(names, 0, at), ".mtl"))
            return at;
    }
    return names.len;
}

// A line holds one name, which may have spaces, or several names.
static void read_library_line(struct loader *loader, struct loaded_mesh *loaded,
                              const struct mesh_library *library) {
    str names = library->names;
    if (first_name_end(names) == names.len) {
        read_library_or_report(loader, loaded, names, library->line);
        return;
    }
    if (read_library(loader, loaded, names, library->line))
        return;
    while (names.len) {
        size_t end = first_name_end(names);
        read_library_or_report(loader, loaded, str_slice(names, 0, end), library->line);
        names = str_trim(str_slice(names, end, names.len));
    }
}

static void read_libraries(struct loader *loader, struct loaded_mesh *loaded) {
    loaded->libraries_read = true;
    mtl_init(&loaded->materials, loader->input->arena);
    str_map_init(&loaded->library_paths, loader->input->arena);
    for (uint32_t i = 0; i < loaded->mesh->library_count; i++)
        read_library_line(loader, loaded, &loaded->mesh->libraries[i]);
}

// ---- groups

static uint32_t from_library(struct loader *loader, struct loaded_mesh *loaded, uint32_t group) {
    const struct mesh_group *g = &loaded->mesh->groups[group];
    uint32_t standard = loader->input->scene->materials.count;
    if (g->name.len == 0 ||
        !(mesh_formats[mesh_format_of_path(loaded->mesh->path)].traits & MESH_HOLDS_MATERIALS))
        return standard;
    if (loaded->file.document) {
        struct ir_material own;
        struct material_source source;
        if (!loader_document_material(loader, loaded, g->name, &own, &source))
            return standard;
        *loader_add_material(loader, source) = own;
        return loader->materials.count - 1;
    }
    if (!loaded->libraries_read)
        read_libraries(loader, loaded);
    const struct ir_material *material = mtl_find(&loaded->materials, g->name);
    if (material) {
        const struct mtl_image *image = &loaded->materials.images.items[material - loaded->materials.items];
        *loader_add_material(loader, (struct material_source){.file = image->file,
                                                              .line = image->line,
                                                              .kd_line = image->kd_line}) = *material;
        loader_settle_image(loader, loader->materials.count - 1);
        return loader->materials.count - 1;
    }
    if (loaded->library_missing)
        return standard;
    if (loaded->mesh->library_count == 0)
        asset_report_line(
            &loaded->file, DIAG_MTL_MATERIAL_MISSING, g->line,
            "the mesh names no material file that could define '%.*s'; its faces get the default material",
            STR_ARG(g->name));
    else
        asset_report_line(&loaded->file, DIAG_MTL_MATERIAL_MISSING, g->line,
                          "no material file defines '%.*s'; its faces get the default material",
                          STR_ARG(g->name));
    return standard;
}

static uint32_t library_material(struct loader *loader, struct loaded_mesh *loaded, uint32_t group) {
    const struct mesh *mesh = loaded->mesh;
    if (!loaded->group_material) {
        loaded->group_material = ARENA_ARRAY(loader->input->arena, uint32_t, mesh->group_count);
        for (uint32_t i = 0; i < mesh->group_count; i++)
            loaded->group_material[i] = IR_NO_INDEX;
    }
    if (loaded->group_material[group] == IR_NO_INDEX)
        loaded->group_material[group] = from_library(loader, loaded, group);
    return loaded->group_material[group];
}

static void report_unknown(struct loader *loader, const struct ir_map_entry *entry, const struct mesh *mesh) {
    const struct assets_input *input = loader->input;
    span at = ir_place_value(input->origin, &entry->head, &SCHEMA_MAP_ENTRY, "from");
    diag_add(input->sink, DIAG_UNKNOWN_MESH_MATERIAL, at,
             "no face of the mesh '%.*s' has the material '%.*s'", STR_ARG(mesh->path), STR_ARG(entry->from));
    if (input->sink->errors > SEARCHES_MAX)
        return;
    struct nearest search = nearest_begin_within(entry->from, &input->sink->search_left);
    struct strbuf names;
    strbuf_init(&names);
    uint32_t named = 0;
    for (uint32_t i = 0; i < mesh->group_count; i++) {
        if (mesh->groups[i].name.len == 0)
            continue;
        nearest_offer(&search, mesh->groups[i].name);
        if (named++ < NAMES_SHOWN)
            strbuf_format(&names, "%s'%.*s'", named > 1 ? ", " : "", STR_ARG(mesh->groups[i].name));
    }
    if (named > NAMES_SHOWN)
        strbuf_format(&names, " and %u more", named - NAMES_SHOWN);
    if (named == 0) {
        diag_help(input->sink, "the mesh names no materials; use 'material'");
    } else if (nearest_best(&search).len) {
        diag_help(input->sink, "did you mean '%.*s'? The mesh uses %.*s", STR_ARG(nearest_best(&search)),
                  STR_ARG(strbuf_view(&names)));
        diag_fix_part(input->sink, input->sources, false, search.word, nearest_best(&search));
    } else {
        diag_help(input->sink, "the mesh uses %.*s", STR_ARG(strbuf_view(&names)));
    }
    strbuf_finish(&names);
}

// 1 + index, or 0.
static uint32_t find_group(struct loader *loader, struct loaded_mesh *loaded, str name) {
    if (!loaded->groups.arena) {
        str_map_init(&loaded->groups, loader->input->arena);
        for (uint32_t i = 0; i < loaded->mesh->group_count; i++)
            *str_map_at(&loaded->groups, loaded->mesh->groups[i].name) = i + 1;
    }
    return str_map_find(&loaded->groups, name);
}

uint32_t *loader_group_materials(struct loader *loader, const struct ir_model *model,
                                 struct loaded_mesh *loaded) {
    const struct mesh *mesh = loaded->mesh;
    const struct ir_scene *scene = loader->input->scene;
    // Models without their own map share a list with the previous such model of the same material.
    const bool has_material = is_written(&model->material), has_map = model->material_map.count > 0;
    const uint32_t whole = has_material ? assets_material(scene, &model->material) : IR_NO_INDEX;
    struct shared_materials *shared = &loaded->shared[has_material];
    if (!has_map && shared->groups && shared->material == whole)
        return shared->groups;
    uint32_t *materials = ARENA_ARRAY(loader->input->arena, uint32_t, mesh->group_count);
    for (uint32_t i = 0; i < mesh->group_count; i++)
        materials[i] = IR_NO_INDEX;
    for (uint32_t i = 0; i < model->material_map.count; i++) {
        const struct ir_map_entry *entry = &model->material_map.items[i];
        if (entry->from.len == 0)
            continue;
        uint32_t group = find_group(loader, loaded, entry->from);
        if (group == 0)
            report_unknown(loader, entry, mesh);
        else
            materials[group - 1] = assets_material(scene, &entry->to);
    }
    for (uint32_t i = 0; i < mesh->group_count; i++) {
        if (materials[i] != IR_NO_INDEX)
            continue;
        materials[i] = has_material ? whole : library_material(loader, loaded, i);
    }
    if (!has_map)
        *shared = (struct shared_materials){materials, whole};
    return materials;
}
