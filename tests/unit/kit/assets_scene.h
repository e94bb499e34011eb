// A scene for tests of assets: models and files from memory, and the messages that come of them.
#ifndef GLINT_TESTS_UNIT_ASSETS_SCENE_H
#define GLINT_TESTS_UNIT_ASSETS_SCENE_H

#include "assets/assets.h"
#include "diag/diag_text.h"
#include "grammar/ir.h"
#include "grammar/schema.h"
#include "scene/scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

struct assets_scene {
    struct arena arena;
    struct source_set sources;
    struct files files;
    struct limits limits;
    struct diag_sink sink;
    struct ir_origin origin;
    struct ir_scene scene;
    struct timeline *timeline; // NULL: none
    struct asset_store *store;
    bool owns_store;
    struct scene resolved;
    struct assets assets;
};

static inline struct assets_scene *assets_scene_begin_in(struct asset_store *store) {
    struct assets_scene *s = calloc(1, sizeof *s);
    assert_non_null(s);
    arena_init(&s->arena, SIZE_MAX);
    source_set_init(&s->sources, &s->arena);
    files_init(&s->files, &s->arena);
    assert_int_equal(files_add_root(&s->files, STR(".")), FILE_OK);
    s->limits = limits_default();
    diag_sink_init(&s->sink);
    ir_origin_init(&s->origin, &s->arena);
    schema_init(&SCHEMA_SCENE, &s->scene);
    s->store = store;
    return s;
}

static inline struct assets_scene *assets_scene_begin(void) {
    struct assets_scene *s = assets_scene_begin_in(asset_store_create());
    assert_non_null(s->store);
    s->owns_store = true;
    return s;
}

static inline void assets_scene_end(struct assets_scene *s) {
    assets_finish(&s->assets);
    if (s->owns_store)
        asset_store_destroy(s->store);
    diag_sink_finish(&s->sink);
    arena_finish(&s->arena);
    free(s);
}

// A file from memory; binary ones too.
static inline void assets_scene_bytes(struct assets_scene *s, const char *path, const void *bytes,
                                      size_t count) {
    files_add_overlay(&s->files, str_from(path), (str){bytes, count});
}
static inline void assets_scene_file(struct assets_scene *s, const char *path, const char *text) {
    assets_scene_bytes(s, path, text, strlen(text));
}

// An element of scene.yaml that holds one row: "ROW: VALUE".
static inline uint32_t assets_scene_place(struct assets_scene *s, const struct schema_element *schema,
                                          const char *row, const char *value) {
    str text = arena_format(&s->arena, "%s: %s", row, value);
    uint32_t source = source_add(&s->sources, SOURCE_KIND_FILE, STR("scene.yaml"), text);
    uint32_t key_end = (uint32_t)strlen(row);
    span all = {source, 0, (uint32_t)text.len};
    uint32_t id = ir_origin_add(&s->origin, (struct ir_element_origin){.at = all, .label = all});
    struct ir_row_origin place = {.row = (uint32_t)schema_find_row(schema, str_from(row)),
                                  .key = {source, 0, key_end},
                                  .value = {source, key_end + 2, (uint32_t)text.len}};
    ir_origin_add_row(&s->origin, id, place);
    return id;
}

// A model without material. The pointer is valid until the next one is added.
static inline struct ir_model *assets_scene_model(struct assets_scene *s, const char *mesh) {
    struct ir_model *model = ARENA_PUSH(&s->arena, &s->scene.models);
    schema_init(&SCHEMA_MODEL, model);
    model->mesh = (struct ir_reference){str_from(mesh), IR_NO_INDEX};
    model->material.index = IR_NO_INDEX;
    model->head.origin = assets_scene_place(s, &SCHEMA_MODEL, "mesh", mesh);
    return model;
}

static inline uint32_t assets_scene_material(struct assets_scene *s, const char *name, double refraction) {
    struct ir_material *material = ARENA_PUSH(&s->arena, &s->scene.materials);
    schema_init(&SCHEMA_MATERIAL, material);
    material->name = str_from(name);
    material->albedo.refraction = refraction;
    return s->scene.materials.count - 1;
}

static inline void assets_scene_background(struct assets_scene *s, const char *image) {
    s->scene.background.kind = IR_BACKDROP_IMAGE;
    s->scene.background.image = str_from(image);
    s->scene.background.head.origin = assets_scene_place(s, &SCHEMA_BACKGROUND, "image", image);
}

static inline void assets_scene_load(struct assets_scene *s) {
    struct assets_input input = {.scene = &s->scene,
                                 .origin = &s->origin,
                                 .sources = &s->sources,
                                 .files = &s->files,
                                 .limits = &s->limits,
                                 .sink = &s->sink,
                                 .arena = &s->arena,
                                 .timeline = s->timeline};
    assets_load(s->store, &input, false, &s->assets);
    scene_build(&s->scene, &s->assets, &s->arena, &s->resolved);
    scene_check_reach(&s->resolved, &s->sink);
    diag_sort(&s->sink);
}

// The mesh of one text, loaded as mesh.obj; NULL where it has an error.
static inline const struct mesh *assets_scene_mesh(struct assets_scene *s, const char *text) {
    assets_scene_file(s, "mesh.obj", text);
    assets_scene_model(s, "mesh.obj");
    assets_scene_load(s);
    return s->assets.models[0].mesh;
}

// All messages as text, in the scene's arena.
static inline const char *assets_scene_text(struct assets_scene *s) {
    struct strbuf out;
    strbuf_init(&out);
    diag_text(&out, &s->sink, &s->sources, (struct diag_text_options){.notes = true});
    str text = arena_copy(&s->arena, strbuf_view(&out));
    strbuf_finish(&out);
    return text.ptr;
}

// How many diagnostics of this code there are.
static inline uint32_t assets_scene_count(const struct assets_scene *s, diag_code code) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < s->sink.count; i++)
        count += s->sink.items[i].code == code;
    return count;
}

// The messages hold this text; they are printed if not.
#define assert_says(s, part)                                                                                 \
    do {                                                                                                     \
        const char *said_ = assets_scene_text(s);                                                            \
        if (!strstr(said_, (part)))                                                                          \
            fail_msg("expected \"%s\" in:\n%s", (part), said_);                                              \
    } while (0)
#define assert_silent(s) assert_string_equal(assets_scene_text(s), "")

#endif
