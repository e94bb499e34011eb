// libFuzzer entry: any bytes as an OBJ mesh and, behind the first NUL byte, its material file own.mtl.
#include "diag/diag_text.h"
#include "fuzz_sample.h"
#include "grammar/ir.h"
#include "grammar/schema.h"
#include "scene/view.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MEMORY_BYTES = 64 * 1024 * 1024,
    TRIANGLES_MAX = 100000
};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

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
    const vec3 *normals = mesh_smooth_normals(mesh, arena);
    for (uint32_t i = 0; i < 3 * mesh->triangle_count; i++)
        require(isfinite(normals[i].x) && isfinite(normals[i].y) && isfinite(normals[i].z),
                "normals are finite");
}

struct loaded {
    struct asset_store *store;
    str mesh, materials; // texts
    struct arena arena;
    struct source_set sources;
    struct files files;
    struct limits limits;
    struct diag_sink sink;
    struct ir_origin origin;
    struct ir_scene scene;
    struct assets assets;
};

static void load(void *context) {
    struct loaded *s = context;
    source_set_init(&s->sources, &s->arena);
    files_init(&s->files, &s->arena);
    files_add_overlay(&s->files, STR("/mesh.obj"), s->mesh);
    files_add_overlay(&s->files, STR("/own.mtl"), s->materials);
    ir_origin_init(&s->origin, &s->arena);
    schema_init(&SCHEMA_SCENE, &s->scene);
    s->limits = limits_default();
    s->limits.value[LIMIT_MESH_MEMORY] = MEMORY_BYTES;
    s->limits.value[LIMIT_MESH_TRIANGLES] = TRIANGLES_MAX;
    struct ir_model *model = ARENA_PUSH(&s->arena, &s->scene.models);
    schema_init(&SCHEMA_MODEL, model);
    model->mesh = STR("/mesh.obj"); // each folder of a path is asked for its links
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

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    str all = {(const char *)data, size};
    const char *nul = memchr(all.ptr ? all.ptr : "", 0, size);
    size_t cut = nul ? (size_t)(nul - all.ptr) : size;
    struct loaded *s = calloc(1, sizeof *s);
    if (!s || !(s->store = asset_store_create()))
        abort();
    s->mesh = str_slice(all, 0, cut);
    s->materials = str_slice(all, nul ? cut + 1 : size, size);
    diag_sink_init(&s->sink);
    arena_init(&s->arena, MEMORY_BYTES);
    arena_guarded(&s->arena, load, s);
    assets_finish(&s->assets);
    asset_store_destroy(s->store);
    diag_sink_finish(&s->sink);
    arena_finish(&s->arena);
    free(s);
    return 0;
}
