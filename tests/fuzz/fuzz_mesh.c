#include "fuzz_mesh.h"

#include "assets/mesh_coordinates.h"
#include "diag/diag_text.h"
#include "fuzz_sample.h"
#include "grammar/ir.h"
#include "grammar/mesh_format.h"
#include "grammar/schema.h"
#include "load/around/around.h"
#include "load/import/plan.h"
#include "load/import/scene_text.h"
#include "scene/view.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MEMORY_BYTES = 64 * 1024 * 1024,
    TRIANGLES_MAX = 100000
};

static void require(bool holds, const char *what) {
    if (holds)
        return;
    fprintf(stderr, "the mesh reader broke its promise: %s\n", what);
    abort();
}

static void check_mesh(const struct mesh *mesh, struct arena *arena) {
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            const struct mesh_triangle *triangle = &mesh->triangles[t];
            require(triangle->corners[k] < mesh->position_count, "a corner has a position");
            require(triangle->normals[k] == IR_NO_INDEX || triangle->normals[k] < mesh->normal_count,
                    "a normal");
            require(triangle->group < mesh->group_count, "a group");
        }
    require(mesh->closed == (mesh->open_edges == 0), "closed, or an open edge");
    const vec3 *normals = mesh_smooth_normals(mesh, 180, arena);
    for (uint32_t i = 0; i < 3 * mesh->triangle_count; i++)
        require(isfinite(normals[i].x) && isfinite(normals[i].y) && isfinite(normals[i].z),
                "normals are finite");
}

// The coordinates of textures, which are read only where an image asks for them.
struct coordinates {
    struct asset_file file;
    struct arena scratch;
    struct mesh mesh; // a copy, with memory of its own for what is added
};

static void read_coordinates(void *context) {
    struct coordinates *c = context;
    mesh_read_coordinates(&c->file, &c->scratch, &c->mesh);
    for (uint32_t t = 0; c->mesh.textured && t < c->mesh.triangle_count; t++)
        for (int k = 0; k < 3; k++)
            require(c->mesh.textured[t][k] == IR_NO_INDEX ||
                        c->mesh.textured[t][k] < c->mesh.coordinate_count,
                    "a corner's coordinates");
}

static void check_coordinates(const struct assets_input *input, str path, str text, const struct mesh *mesh) {
    struct coordinates c = {.file = {.input = input, .path = path, .what = "mesh", .text = text},
                            .mesh = *mesh};
    struct arena *arenas[] = {&c.scratch, &c.mesh.arena, input->arena, NULL};
    arena_init(&c.scratch, MEMORY_BYTES);
    arena_init(&c.mesh.arena, MEMORY_BYTES);
    arena_guarded_all(arenas, read_coordinates, &c);
    arena_finish(&c.scratch);
    arena_finish(&c.mesh.arena);
}

// The scene around a mesh, and that of a glTF file, as `glint render` and `glint import` make them.
struct scenes {
    struct assets around;
    struct gltf_document *document;
};

static void check_scenes(struct asset_store *store, const struct assets_input *input, str path,
                         struct scenes *out) {
    struct strbuf text;
    const struct import_source source = {input, store, &out->around, 0, 0};
    strbuf_init(&text);
    if (mesh_format_of_path(path) != MESH_FORMAT_GLTF) {
        around_text(store, input, path, 0, 0, &out->around);
        return;
    }
    import_scene_text(&source, path, &text);
    struct import_plan plan;
    out->document = import_open(input, path);
    if (out->document && import_plan_make(out->document, NULL, STR("/scene.glint.yaml"), &plan))
        import_plan_write(&plan, (enum import_spelling)(text.len % 3), &text);
    strbuf_finish(&text);
}

struct loaded {
    struct asset_store *store;
    str name, mesh, materials; // the mesh's path; texts
    struct arena arena;
    struct source_set sources;
    struct files files;
    struct limits limits;
    struct diag_sink sink;
    struct ir_origin origin;
    struct ir_scene scene;
    struct assets assets;
    struct scenes scenes;
};

static void load(void *context) {
    struct loaded *s = context;
    source_set_init(&s->sources, &s->arena);
    files_init(&s->files, &s->arena);
    files_add_overlay(&s->files, s->name, s->mesh);
    files_add_overlay(&s->files, STR("/own.mtl"), s->materials);
    ir_origin_init(&s->origin, &s->arena);
    schema_init(&SCHEMA_SCENE, &s->scene);
    s->limits = limits_default();
    s->limits.value[LIMIT_MESH_MEMORY] = MEMORY_BYTES;
    s->limits.value[LIMIT_MESH_TRIANGLES] = TRIANGLES_MAX;
    struct ir_model *model = ARENA_PUSH(&s->arena, &s->scene.models);
    schema_init(&SCHEMA_MODEL, model);
    model->mesh = (struct ir_reference){s->name, IR_NO_INDEX}; // each folder of a path is asked for its links
    model->material.index = IR_NO_INDEX;
    struct assets_input input = {.scene = &s->scene,
                                 .origin = &s->origin,
                                 .sources = &s->sources,
                                 .files = &s->files,
                                 .limits = &s->limits,
                                 .sink = &s->sink,
                                 .arena = &s->arena};
    assets_load(s->store, &input, false, &s->assets);
    const struct mesh *loaded = s->assets.models[0].mesh;
    require(loaded || s->sink.errors > 0, "a mesh, or an error");
    if (loaded)
        check_mesh(loaded, &s->arena);
    // Those of glTF are read with the document, for the images that its materials name.
    if (loaded && mesh_format_of_path(s->name) != MESH_FORMAT_GLTF && fuzz_is_chosen(s->mesh, 0, 4))
        check_coordinates(&input, s->name, s->mesh, loaded);
    if (fuzz_is_chosen(s->mesh, 1, 4))
        check_scenes(s->store, &input, s->name, &s->scenes);
    struct scene scene;
    scene_build(&s->scene, &s->assets, &s->arena, &scene);
    scene_check_reach(&scene, &s->sink);
    if (!fuzz_is_chosen(s->mesh, 0, 4))
        return;
    struct strbuf text;
    strbuf_init(&text);
    diag_text(&text, &s->sink, &s->sources, (struct diag_text_options){.notes = true});
    strbuf_finish(&text);
}

void fuzz_mesh(const char *path, str mesh, str materials) {
    struct loaded *s = calloc(1, sizeof *s);
    if (!s || !(s->store = asset_store_create()))
        abort();
    s->name = str_from(path);
    s->mesh = mesh;
    s->materials = materials;
    diag_sink_init(&s->sink);
    arena_init(&s->arena, MEMORY_BYTES);
    arena_guarded(&s->arena, load, s);
    gltf_documents_finish(s->scenes.document);
    assets_finish(&s->scenes.around);
    assets_finish(&s->assets);
    asset_store_destroy(s->store);
    diag_sink_finish(&s->sink);
    arena_finish(&s->arena);
    free(s);
}
