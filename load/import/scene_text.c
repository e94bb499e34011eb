#include "load/import/scene_text.h"

#include "grammar/ir.h"
#include "grammar/print/ir_print.h"
#include "load/around/around.h"

#include <string.h>

const struct ir_scene *import_around(const struct import_source *source,
                                     const struct gltf_document *document) {
    if (!source->store || document->file.errors || !import_lacks(document))
        return NULL;
    struct ir_scene *scene = ARENA_NEW(source->input->arena, struct ir_scene);
    return around_scene(source->store, source->input, document->file.path, source->width, source->height,
                        source->assets, scene)
               ? scene
               : NULL;
}

struct making {
    const struct import_source *source;
    const struct ir_scene *around;
    struct gltf_document *document;
    const struct assets_input *input;
    struct ir_scene scene;
    struct strbuf *text;
};

static void make(void *context) {
    struct making *m = context;
    const struct import_options options = {.around = m->around, .mesh = path_base(m->document->file.path)};
    import_gltf(m->document, &options, &m->document->arena, &m->scene);
    ir_write_yaml(&m->scene, NULL, NULL, (struct ir_write_options){0}, m->text);
    m->document->file.input = m->input;
    memset(m->document->gltf.losses, 0, sizeof m->document->gltf.losses); // reading the mesh reports them
    import_report(m->document);
}

static void find_around(void *context) {
    struct making *m = context;
    m->around = import_around(m->source, m->document);
}

// Opens the file once for everything, and closes it also if memory runs out.
static bool write_scene(const struct import_source *source, const struct assets_input *quiet, str path,
                        struct strbuf *text) {
    struct making making = {
        .source = source, .document = import_open(quiet, path), .input = source->input, .text = text};
    if (!making.document)
        return false;
    const enum arena_fault fault = arena_guarded(source->input->arena, find_around, &making);
    if (fault) {
        gltf_documents_finish(making.document);
        arena_raise(source->input->arena, fault);
    }
    if (making.document->file.errors == 0)
        gltf_document_guarded(making.document, NULL, make, &making);
    // If the scene shows no mesh, that is all there is to report.
    const bool good = making.document->file.errors == 0 &&
                      (making.scene.models.count || making.scene.instances.count) && !text->failed;
    gltf_documents_finish(making.document);
    return good;
}

bool import_scene_text(const struct import_source *source, str path, struct strbuf *text) {
    struct diag_sink sink = {0}; // keeps nothing
    struct assets_input quiet = *source->input;
    quiet.sink = &sink;
    quiet.uses = NULL;
    const size_t before = text->len;
    const bool good = write_scene(source, &quiet, path, text);
    if (!good)
        text->len = before;
    diag_sink_finish(&sink);
    return good;
}
