#include "app/import/scene_text.h"

#include "app/around/around.h"
#include "grammar/ir.h"
#include "grammar/print/ir_print.h"

const struct ir_scene *import_around(const struct import_source *source, str path) {
    struct diag_sink sink = {0}; // keeps nothing
    struct assets_input quiet = *source->input;
    struct ir_scene *scene = ARENA_NEW(quiet.arena, struct ir_scene);
    quiet.sink = &sink;
    struct gltf_document *document = source->store ? import_open(&quiet, path) : NULL;
    const bool lacks = document && document->file.errors == 0 && import_lacks(document);
    gltf_documents_finish(document);
    diag_sink_finish(&sink);
    return lacks && around_scene(source->store, source->input, path, source->width, source->height,
                                 source->assets, scene)
               ? scene
               : NULL;
}

struct making {
    const struct ir_scene *around;
    struct gltf_document *document;
    const struct assets_input *input;
    struct ir_scene scene;
    struct strbuf *text;
};

// Only of what is not read again with the mesh.
static void keep_light_losses(struct gltf *gltf) {
    for (int i = 0; i < GLTF_LOSSES; i++)
        if (i != GLTF_LOSS_SPOT)
            gltf->losses[i] = (struct gltf_loss_count){0};
}

static void make(void *context) {
    struct making *m = context;
    const struct import_options options = {.around = m->around, .mesh = path_base(m->document->file.path)};
    import_gltf(m->document, &options, &m->document->arena, &m->scene);
    ir_write_yaml(&m->scene, NULL, NULL, (struct ir_write_options){0}, m->text);
    m->document->file.input = m->input;
    keep_light_losses(&m->document->gltf);
    import_report(m->document);
}

static bool write_scene(const struct assets_input *quiet, const struct assets_input *input,
                        const struct ir_scene *around, str path, struct strbuf *text) {
    struct making making = {
        .around = around, .document = import_open(quiet, path), .input = input, .text = text};
    if (!making.document)
        return false;
    if (making.document->file.errors == 0)
        gltf_document_guarded(making.document, NULL, make, &making);
    // A scene that shows no mesh has nothing to say but that.
    const bool good = making.document->file.errors == 0 && making.scene.models.count > 0 && !text->failed;
    gltf_documents_finish(making.document);
    return good;
}

bool import_scene_text(const struct import_source *source, str path, struct strbuf *text) {
    const struct assets_input *input = source->input;
    const struct ir_scene *around = import_around(source, path);
    struct diag_sink sink = {0};
    struct assets_input quiet = *input;
    quiet.sink = &sink;
    quiet.uses = NULL;
    const size_t before = text->len;
    const bool good = write_scene(&quiet, input, around, path, text);
    if (!good)
        text->len = before;
    diag_sink_finish(&sink);
    return good;
}
