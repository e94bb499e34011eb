#include "load/import/plan.h"
#include "diag/codes/file.h"

#include "grammar/ir.h"
#include "grammar/print/ir_print.h"
#include "load/import/names.h"
#include "picture/formats/formats.h"
#include "picture/read/picture_read.h"

struct planning {
    struct gltf_document *document;
    const struct ir_scene *around;
    str out;
    struct import_plan *plan;
    struct str_map names; // of images that are written
    bool good;
};

// "scene" of "folder/scene.glint.yaml".
static str stem_of(str path) {
    const str base = path_base(path);
    size_t end = 1;
    while (end < base.len && base.ptr[end] != '.')
        end++;
    return str_slice(base, 0, end);
}

static const char *ending_of(enum image_format kind) {
    return image_format_info(kind)->endings[0] + 1;
}

// A file for an image that the glTF file holds; the empty string: it has none, and that was reported.
static str take_out(struct planning *p, uint32_t image) {
    struct arena *arena = &p->document->arena;
    struct asset_file file;
    struct file_read identity;
    struct picture_header header;
    if (!gltf_document_image(p->document, image, &file, &identity))
        return STR("");
    picture_read_header(file.text, &header);
    if (header.kind == IMAGE_NONE) {
        asset_report_named(&file, DIAG_IMAGE_KIND, "'%.*s' is not a " IMAGE_IN_SCENE_NAMES " image",
                           STR_ARG(file.path));
        return STR("");
    }
    const str own = p->document->gltf.images.items[image].name;
    const str name = import_name(&p->names, own, "image");
    const str base =
        arena_format(arena, "%.*s_%.*s.%s", STR_ARG(stem_of(p->out)), STR_ARG(name), ending_of(header.kind));
    *ARENA_PUSH(arena, &p->plan->images) =
        (struct import_file){path_join(arena, path_folder(p->out), base), file.text};
    return base;
}

static str beside(struct planning *p, str path) {
    const struct asset_file *file = &p->document->file;
    return files_rebase(file->input->files, path, file->path, p->out);
}

static const str *name_images(struct planning *p) {
    const struct gltf *gltf = &p->document->gltf;
    str *names = ARENA_ARRAY(&p->document->arena, str, (size_t)gltf->images.count + 1);
    const bool *shown = import_images(p->document, &p->document->arena);
    for (uint32_t i = 0; i < gltf->images.count; i++) {
        if (!shown[i])
            continue;
        names[i] = gltf_document_holds(p->document, i)
                       ? take_out(p, i)
                       : beside(p, gltf_decode_uri(gltf->images.items[i].uri, &p->document->arena));
        p->good &= names[i].len > 0;
    }
    return names;
}

static void make(void *context) {
    struct planning *p = context;
    struct arena *arena = &p->document->arena;
    const str base = path_base(p->document->file.path);
    struct import_options options = {.around = p->around, .mesh = p->out.len ? beside(p, base) : base};
    str_map_init(&p->names, arena);
    if (p->out.len)
        options.images = name_images(p);
    p->plan->mesh = options.mesh;
    p->plan->scene = ARENA_NEW(arena, struct ir_scene);
    import_gltf(p->document, &options, arena, p->plan->scene);
}

bool import_plan_make(struct gltf_document *document, const struct ir_scene *around, str out,
                      struct import_plan *plan) {
    struct planning planning = {
        .document = document, .around = around, .out = out, .plan = plan, .good = true};
    *plan = (struct import_plan){0};
    if (document->file.errors == 0)
        gltf_document_guarded(document, NULL, make, &planning);
    return planning.good && document->file.errors == 0;
}

void import_plan_write(const struct import_plan *plan, enum import_spelling spelling, struct strbuf *text) {
    const struct ir_write_options options = {0};
    if (spelling == IMPORT_XML)
        ir_write_xml(plan->scene, NULL, NULL, options, text);
    else if (spelling == IMPORT_JSON)
        ir_write_json(plan->scene, text);
    else
        ir_write_yaml(plan->scene, NULL, NULL, options, text);
}
