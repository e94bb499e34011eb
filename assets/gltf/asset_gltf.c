#include "assets/gltf/asset_gltf.h"

#include "assets/gltf/material.h"
#include "core/heap.h"
#include "diag/codes/file.h"
#include "picture/read/picture_read.h"

#include <stdlib.h>

// ---- findings

static void add_finding(void *context, diag_code code, size_t begin, size_t end, const char *message) {
    struct gltf_document *document = context;
    struct asset_file *file = &document->file;
    const uint32_t errors = file->errors;
    file->text = document->gltf.json.text;
    if (end == 0)
        asset_report_line(file, code, 0, "%s", message);
    else
        asset_report(file, code, begin, end, "%s", message);
    if (code == DIAG_GLTF_EXTENSION && file->errors > errors)
        diag_help(file->input->sink,
                  "export the file without it, or decompress it with gltf-transform or gltfpack");
}

// ---- opening

struct opening {
    struct gltf_document *document;
    const struct file_read *identity;
};

static void open_document(void *context) {
    const struct opening *o = context;
    struct gltf_document *document = o->document;
    str bytes;
    document->identity = *o->identity;
    document->identity.path = arena_copy(&document->arena, o->identity->path);
    if (!asset_read(&document->file, &document->arena))
        return;
    bytes = document->file.text;
    gltf_open(&document->gltf, bytes, &document->report, &document->arena);
    document->gltf.most_elements = 3 * document->file.input->limits->value[LIMIT_MESH_COPIES];
    document->file.text = document->gltf.json.text;
    document->means =
        ARENA_ARRAY(&document->arena, struct gltf_means, (size_t)document->gltf.images.count + 1);
}

void gltf_document_guarded(struct gltf_document *document, struct arena *const *others, arena_work *work,
                           void *context) {
    struct arena *arenas[4] = {&document->arena};
    for (int i = 0; i < 2 && others && others[i]; i++)
        arenas[i + 1] = others[i];
    const enum arena_fault fault = arena_guarded_all(arenas, work, context);
    if (fault)
        asset_report_memory(&document->file, fault);
}

struct gltf_document *gltf_document_open(const struct asset_file *file, const struct file_read *identity) {
    struct gltf_document *document = heap_zeroed(1, sizeof *document);
    struct opening opening = {document, identity};
    if (!document)
        return NULL;
    document->file = *file;
    document->file.is_binary = false; // its JSON has lines
    document->report = (struct gltf_report){document, add_finding};
    arena_init(&document->arena, limits_size(file->input->limits, LIMIT_MESH_MEMORY));
    gltf_document_guarded(document, NULL, open_document, &opening);
    return document;
}

void gltf_documents_finish(struct gltf_document *first) {
    while (first) {
        struct gltf_document *next = first->next;
        arena_finish(&first->arena);
        free(first);
        first = next;
    }
}

// ---- files beside it

// The line of a value, for messages about it; 0 in a GLB file, whose JSON has no visible lines.
static uint32_t gltf_document_line(const struct gltf_document *document, json_index at) {
    const str text = document->gltf.json.text;
    const size_t offset = json_at(&document->gltf.json, at)->begin;
    uint32_t line = 1;
    if (document->gltf.is_binary)
        return 0;
    for (size_t i = 0; i < offset; i++)
        line += text.ptr[i] == '\n' || (text.ptr[i] == '\r' && text.ptr[i + 1] != '\n');
    return line;
}

static struct asset_file *file_beside(struct gltf_document *document, json_index at, const char *what,
                                      enum limit limit) {
    struct asset_file *file = ARENA_NEW(&document->arena, struct asset_file);
    *file = (struct asset_file){.input = document->file.input,
                                .what = what,
                                .limit = limit,
                                .named_in = &document->file,
                                .named_line = gltf_document_line(document, at)};
    return file;
}

static bool read_buffer(void *context, str uri, json_index at, str *bytes) {
    struct gltf_document *document = context;
    struct asset_file *file = file_beside(document, at, "buffer", LIMIT_MESH_BYTES);
    struct file_read identity;
    if (!asset_find(file, document->file.path, uri, &identity, NULL) || !asset_read(file, &document->arena))
        return false;
    *bytes = file->text;
    return true;
}

static void read_buffers(void *context) {
    struct gltf_document *document = context;
    const struct gltf_files files = {document, read_buffer};
    gltf_load_buffers(&document->gltf, &files);
}

bool gltf_document_buffers(struct gltf_document *document) {
    if (!document->buffers_read && document->file.errors == 0) {
        gltf_document_guarded(document, NULL, read_buffers, document);
        document->file.errors += document->gltf.errors > 0 && document->file.errors == 0;
    }
    document->buffers_read = true;
    return document->file.errors == 0;
}

// ---- images

bool gltf_document_holds(const struct gltf_document *document, uint32_t image) {
    const struct gltf_image *i = &document->gltf.images.items[image];
    return i->uri.len == 0 || gltf_is_data(i->uri);
}

static bool take_bytes(struct gltf_document *document, uint32_t image, struct asset_file *file) {
    struct gltf *gltf = &document->gltf;
    const struct gltf_image *i = &gltf->images.items[image];
    str mime;
    if (i->uri.len == 0) {
        if (!gltf_document_buffers(document))
            return false;
        file->text = gltf_view_bytes(gltf, i->view);
    } else if (!gltf_decode_data(i->uri, gltf->arena, &file->text, &mime)) {
        gltf_add(gltf, DIAG_GLTF_DATA, i->node, "'%s' has a 'uri' that is not base64",
                 gltf_where(gltf, i->node));
        return false;
    }
    if (file->text.len == 0)
        gltf_add(gltf, DIAG_GLTF_DATA, i->node, "'%s' has no bytes", gltf_where(gltf, i->node));
    return file->text.len > 0;
}

bool gltf_document_image(struct gltf_document *document, uint32_t image, struct asset_file *file,
                         struct file_read *identity) {
    const struct gltf_image *i = &document->gltf.images.items[image];
    *file = *file_beside(document, i->node, "image", LIMIT_IMAGE_BYTES);
    if (!gltf_document_holds(document, image))
        return asset_find(file, document->file.path, gltf_decode_uri(i->uri, &document->arena), identity,
                          NULL);
    file->path = arena_format(&document->arena, "%.*s: images[%u]", STR_ARG(document->file.path), image);
    *identity = document->identity;
    identity->path =
        arena_format(&document->arena, "%.*s\nimages[%u]", STR_ARG(document->identity.path), image);
    return take_bytes(document, image, file);
}

// ---- materials

struct mean {
    struct gltf_document *document;
    uint32_t image;
    struct picture picture;
};

static void take_means(const struct picture *picture, struct gltf_means *out) {
    const size_t pixels = (size_t)picture->width * picture->height;
    double sum[2] = {0, 0};
    for (size_t at = 0; at < pixels; at++)
        for (size_t k = 0; k < 2; k++)
            sum[k] += picture->depth == PICTURE_RGBE
                          ? (double)picture_linear(picture, at, k + 1)
                          : (double)picture_stored(picture, at, k + 1) / picture_greatest(picture->depth);
    out->roughness = fmin(sum[0] / (double)pixels, 1);
    out->metal = fmin(sum[1] / (double)pixels, 1);
}

// An unreadable image is reported where it is drawn, and counts as none here.
static void read_means(void *context) {
    struct mean *mean = context;
    struct gltf_document *document = mean->document;
    struct gltf_means *out = &document->means[mean->image];
    struct asset_file file;
    struct file_read identity;
    struct picture_header header;
    *out = (struct gltf_means){.is_known = true, .metal = 1, .roughness = 1};
    if (!gltf_document_image(document, mean->image, &file, &identity) ||
        (file.text.len == 0 && !asset_read(&file, &document->arena)))
        return;
    const char *fault = picture_read_header(file.text, &header);
    if (!fault && header.kind != IMAGE_NONE &&
        !asset_fits_growth(file.input, picture_memory(&header, 0), file.text.len))
        asset_report_limit(&file, LIMIT_IMAGE_GROWTH, 0, 0, picture_memory(&header, 0));
    else if (fault || header.kind == IMAGE_NONE ||
             picture_memory(&header, 0) > file.input->limits->value[LIMIT_IMAGE_MEMORY] ||
             picture_decode(file.text, &header, &mean->picture))
        asset_report_named(&file, DIAG_IMAGE_BROKEN, "the image of metal and roughness cannot be decoded");
    else
        take_means(&mean->picture, out);
    picture_finish(&mean->picture);
}

struct material_making {
    struct gltf_document *document;
    uint32_t material;
    bool is_linear;
    struct ir_material *out;
};

static void make_material(void *context) {
    const struct material_making *m = context;
    struct gltf_document *document = m->document;
    const uint32_t image = gltf_material_images(&document->gltf, m->material).metal;
    struct gltf_wording wording = {.is_linear = m->is_linear, .metal = 1, .roughness = 1};
    if (image != GLTF_NONE && !document->means[image].is_known)
        read_means(&(struct mean){.document = document, .image = image});
    if (image != GLTF_NONE) {
        wording.metal = document->means[image].metal;
        wording.roughness = document->means[image].roughness;
    }
    gltf_to_material(&document->gltf, m->material, wording, m->out);
}

bool gltf_document_material(struct gltf_document *document, uint32_t material, bool is_linear,
                            struct ir_material *out) {
    struct material_making making = {document, material, is_linear, out};
    if (document->file.errors == 0)
        gltf_document_guarded(document, NULL, make_material, &making);
    return document->file.errors == 0;
}
