#include "app/import/scene_text.h"

#include "app/import/import.h"
#include "grammar/ir.h"
#include "grammar/print/ir_print.h"

struct making {
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
    const struct import_options options = {.mesh = path_base(m->document->file.path)};
    import_gltf(m->document, &options, &m->document->arena, &m->scene);
    ir_write_yaml(&m->scene, NULL, NULL, (struct ir_write_options){0}, m->text);
    m->document->file.input = m->input;
    keep_light_losses(&m->document->gltf);
    import_report(m->document);
}

static bool write_scene(const struct assets_input *quiet, const struct assets_input *input, str path,
                        struct strbuf *text) {
    struct making making = {.document = import_open(quiet, path), .input = input, .text = text};
    if (!making.document)
        return false;
    if (making.document->file.errors == 0)
        gltf_document_guarded(making.document, NULL, make, &making);
    // A scene that shows no mesh has nothing to say but that.
    const bool good = making.document->file.errors == 0 && making.scene.models.count > 0 && !text->failed;
    gltf_documents_finish(making.document);
    return good;
}

bool import_scene_text(const struct assets_input *input, str path, struct strbuf *text) {
    struct diag_sink sink = {0}; // keeps nothing
    struct assets_input quiet = *input;
    quiet.sink = &sink;
    quiet.uses = NULL;
    const size_t before = text->len;
    const bool good = write_scene(&quiet, input, path, text);
    if (!good)
        text->len = before;
    diag_sink_finish(&sink);
    return good;
}
