#include "load/around/around.h"

#include "core/strbuf.h"
#include "grammar/ir.h"
#include "grammar/print/ir_print.h"
#include "grammar/schema.h"

// As the only model of a scene.
static void load(struct asset_store *store, const struct assets_input *given, str path,
                 struct assets *assets) {
    struct arena *arena = given->arena;
    struct assets_input input = *given;
    struct ir_scene *scene = ARENA_NEW(arena, struct ir_scene);
    struct ir_origin *origin = ARENA_NEW(arena, struct ir_origin);
    struct diag_sink sink = {0}; // keeps nothing, only counts
    const uint32_t logged = input.files->log.count;
    schema_init(&SCHEMA_SCENE, scene);
    ir_origin_init(origin, arena);
    struct ir_model *model = ARENA_PUSH(arena, &scene->models);
    schema_init(&SCHEMA_MODEL, model);
    model->mesh.name = path;
    model->material = (struct ir_reference){.index = IR_NO_INDEX};
    input.scene = scene;
    input.origin = origin;
    input.sink = &sink;
    assets_load(store, &input, ASSETS_SKIP_PIXELS, assets);
    input.files->log.count = logged;
}

static str text_of(const struct ir_scene *scene, struct arena *arena) {
    struct strbuf text;
    strbuf_init(&text);
    ir_write_yaml(scene, NULL, NULL, (struct ir_write_options){0}, &text);
    const str copy = text.failed ? STR("") : arena_copy(arena, strbuf_view(&text));
    strbuf_finish(&text);
    return copy;
}

bool around_scene(struct asset_store *store, const struct assets_input *input, str path, int32_t width,
                  int32_t height, struct assets *assets, struct ir_scene *out) {
    load(store, input, path, assets);
    const struct around_input around = {.name = path_base(path),
                                        .mesh = assets->models ? assets->models[0].mesh : NULL,
                                        .width = width,
                                        .height = height,
                                        .arena = input->arena};
    return around.mesh && utf8_first_error(around.name) == around.name.len && around_mesh(&around, out);
}

str around_text(struct asset_store *store, const struct assets_input *input, str path, int32_t width,
                int32_t height, struct assets *assets) {
    struct ir_scene *scene = ARENA_NEW(input->arena, struct ir_scene);
    const bool good = around_scene(store, input, path, width, height, assets, scene);
    return good ? text_of(scene, input->arena) : STR("");
}
