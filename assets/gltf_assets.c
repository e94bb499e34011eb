// glTF files among the assets of a scene: one document per file, for all models that show parts of it.
#include "assets/gltf/asset_gltf.h"
#include "assets/gltf/material.h"
#include "assets/loader.h"
#include "grammar/ir.h"
#include "grammar/mesh_format.h"

bool loader_open_document(struct loader *loader, struct asset_file *file, const struct file_read *identity) {
    if (mesh_format_of_path(file->path) != MESH_FORMAT_GLTF)
        return true;
    struct gltf_document **last = &loader->hold->documents;
    file->is_binary = true;
    for (; *last; last = &(*last)->next)
        if (str_equal((*last)->identity.path, identity->path)) {
            file->document = *last;
            file->errors += (*last)->file.errors;
            return true;
        }
    file->document = *last = gltf_document_open(file, identity);
    if (!file->document) {
        asset_report_memory(file, ARENA_FAULT_SYSTEM);
        return false;
    }
    file->errors += file->document->file.errors;
    return true;
}

static void report_losses(void *context) {
    gltf_report_losses(&((struct gltf_document *)context)->gltf);
}

void loader_close_documents(struct loader *loader) {
    for (struct gltf_document *document = loader->hold->documents; document; document = document->next)
        if (document->file.errors == 0)
            gltf_document_guarded(document, NULL, report_losses, document);
    gltf_documents_finish(loader->hold->documents);
    loader->hold->documents = NULL;
}

struct finding {
    struct gltf_document *document;
    str name;
    uint32_t found;
};

static void find_material(void *context) {
    struct finding *f = context;
    const struct gltf *gltf = &f->document->gltf;
    struct str_map *numbers = &f->document->material_numbers;
    if (!numbers->arena) {
        str_map_init(numbers, &f->document->arena);
        for (uint32_t i = gltf->materials.count; i-- > 0;)
            *str_map_at(numbers, gltf_material_name(gltf, i)) = i + 1;
    }
    const uint32_t found = str_map_find(numbers, f->name);
    f->found = found ? found - 1 : gltf->materials.count;
}

bool loader_document_material(const struct loader *loader, struct loaded_mesh *loaded, str group,
                              struct ir_material *material, struct material_source *source) {
    struct gltf_document *document = loaded->file.document;
    struct finding finding = {document, group, 0};
    gltf_document_guarded(document, NULL, find_material, &finding);
    const bool is_linear = loader->input->scene->image.transfer == IR_TRANSFER_SRGB;
    if (finding.found >= document->gltf.materials.count ||
        !gltf_document_material(document, finding.found, is_linear, material))
        return false;
    material->name = arena_copy(loader->input->arena, group);
    *source = (struct material_source){.document = document,
                                       .image = gltf_material_images(&document->gltf, finding.found).base};
    return true;
}
