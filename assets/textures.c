// The images that materials name, and the coordinates of meshes that show them.
#include "assets/gltf/asset_gltf.h"
#include "assets/loader.h"
#include "assets/mesh_coordinates.h"
#include "diag/codes/file.h"
#include "grammar/ir.h"
#include "grammar/schema.h"
#include "picture/formats/formats.h"

// ---- images

// If an image of a material file is not available, its material's own colour counts, as in programs that show
// no images.
static bool is_found(const struct material_source *source, str name) {
    struct asset_file *file = source->file;
    const struct assets_input *input = file->input;
    str path;
    const bool exists = files_resolve(input->files, file->path, name, &path) == FILE_OK;
    if (exists && schema_file_fits(SCHEMA_FILE_IMAGE, name))
        return true;
    if (asset_report_line(file, DIAG_MTL_DROPPED, source->line, "'map_Kd' has no effect: '%.*s' %s",
                          STR_ARG(name),
                          exists ? "is not a " IMAGE_IN_SCENE_NAMES " image" : "cannot be found"))
        diag_help(input->sink,
                  exists ? "convert the image, or give the model a 'material'"
                         : "put the image where the material file says, or give the model a 'material'");
    return false;
}

// MTL multiplies the image by Kd: a weight if Kd is grey.
void loader_settle_image(struct loader *loader, uint32_t material) {
    struct ir_material *m = &loader->materials.items[material];
    const struct material_source *source = &loader->sources.items[material];
    const struct ir_color kd = m->diffuse_color.color;
    if (m->diffuse_color.kind != IR_PAINT_IMAGE || !source->file)
        return;
    if (!is_found(source, m->diffuse_color.image.file)) {
        m->diffuse_color.kind = IR_PAINT_COLOR;
        return;
    }
    if (source->kd_line && kd.r > 0 && kd.r == kd.g && kd.g == kd.b)
        m->albedo.diffuse *= kd.r;
    else if (source->kd_line)
        asset_report_line(source->file, DIAG_MTL_DROPPED, source->kd_line,
                          "'Kd' has no effect: it is %s, and 'map_Kd' has the colours",
                          kd.r + kd.g + kd.b > 0 ? "not grey" : "black");
}

static const struct picture *known_image(const struct loader *loader, str canonical, bool *is_known) {
    for (const struct loaded_image *image = loader->images; image; image = image->next)
        if (str_equal(image->canonical, canonical)) {
            *is_known = true;
            return image->picture;
        }
    *is_known = false;
    return NULL;
}

struct image_finding {
    const struct material_source *source;
    struct asset_file *file;
    struct file_read *identity;
    bool found;
};

static void find_image(void *context) {
    struct image_finding *f = context;
    f->found = gltf_document_image(f->source->document, f->source->image, f->file, f->identity);
}

static bool find_in_document(const struct material_source *source, struct asset_file *file,
                             struct file_read *identity) {
    struct image_finding finding = {source, file, identity, false};
    gltf_document_guarded(source->document, NULL, find_image, &finding);
    return finding.found;
}

// Images of a document may share bytes, whole or in part; shared bytes count once.
static uint64_t file_bytes(const struct loader *loader, const struct loaded_image *image,
                           const struct file_read *identity) {
    const str own = image->held;
    if (own.len == 0)
        return identity->size_bytes;
    for (const struct loaded_image *other = loader->images; other; other = other->next)
        if (other->held.ptr < own.ptr + own.len && own.ptr < other->held.ptr + other->held.len)
            return 0;
    return own.len;
}

static const struct picture *load_image(struct loader *loader, struct assets *out,
                                        const struct ir_texture *texture,
                                        const struct material_source *source) {
    const struct assets_input *input = loader->input;
    struct loaded_image *image = ARENA_NEW(input->arena, struct loaded_image);
    const span at = ir_place_value(input->origin, &texture->head, &SCHEMA_TEXTURE, "file");
    const str base = source->file ? source->file->path : asset_base(input, at);
    struct file_read identity;
    bool is_known;
    str name = texture->file;
    if (source->document) {
        if (!find_in_document(source, &image->file, &identity))
            return NULL;
        name = image->file.path;
    } else {
        image->file = (struct asset_file){.input = input, .what = "image", .limit = LIMIT_IMAGE_BYTES};
        image->file.named_in = source->file;
        image->file.named_line = source->line;
        if (!source->file)
            image->file.named_at = at;
        if (!asset_find(&image->file, base, name, &identity, NULL))
            return NULL;
    }
    const struct picture *known = known_image(loader, identity.path, &is_known);
    if (is_known)
        return known;
    image->canonical = arena_copy(input->arena, identity.path);
    image->held = source->document ? image->file.text : STR("");
    struct store_entry *entry =
        loader_read_image(loader, &image->file, name, &identity,
                          (struct image_role){.file_bytes = file_bytes(loader, image, &identity)});
    if (!entry)
        return NULL;
    // A material of a glTF file says whether alpha counts.
    image->picture = loader_judge_image(&image->file, entry, source->document != NULL);
    image->next = loader->images;
    loader->images = image;
    out->pixels_skipped |= image->picture && entry->kind == STORE_PICTURE_SKIPPED;
    return image->picture;
}

static bool has_file(const struct ir_texture *texture, const struct material_source *source) {
    if (source->document)
        return source->image != GLTF_NONE;
    const uint32_t row = (uint32_t)schema_find_row(&SCHEMA_TEXTURE, STR("file"));
    return texture->file.len && !(texture->head.poisoned >> row & 1);
}

static const struct picture **images_of(struct loader *loader, struct assets *out, uint32_t material) {
    if (!out->images)
        out->images = arena_alloc_array(loader->input->arena, loader->materials.count, sizeof *out->images);
    return out->images[material];
}

void loader_load_textures(struct loader *loader, struct assets *out) {
    for (uint32_t i = 0; i < loader->materials.count; i++) {
        struct ir_material *m = &loader->materials.items[i];
        const struct material_source *source = &loader->sources.items[i];
        if (m->diffuse_color.kind == IR_PAINT_IMAGE && has_file(&m->diffuse_color.image, source))
            images_of(loader, out, i)[ASSETS_DIFFUSE] =
                load_image(loader, out, &m->diffuse_color.image, source);
        if (m->specular_color.kind == IR_PAINT_IMAGE && has_file(&m->specular_color.image, source))
            images_of(loader, out, i)[ASSETS_SPECULAR] =
                load_image(loader, out, &m->specular_color.image, source);
    }
}

// ---- coordinates

static bool has_image(const struct loader *loader, uint32_t material) {
    const struct ir_material *m = &loader->materials.items[material];
    return m->diffuse_color.kind == IR_PAINT_IMAGE || m->specular_color.kind == IR_PAINT_IMAGE;
}

struct coordinates_reading {
    struct asset_file *file;
    struct arena *scratch;
    struct mesh *mesh;
};

static void read_coordinates(void *context) {
    const struct coordinates_reading *r = context;
    if (r->file->document || asset_read(r->file, r->scratch))
        mesh_read_coordinates(r->file, r->scratch, r->mesh);
}

static void read_guarded(struct loader *loader, struct loaded_mesh *loaded) {
    struct arena *scratch = &loader->hold->scratch;
    struct arena *arenas[] = {scratch, &loaded->own->arena, NULL};
    struct coordinates_reading reading = {&loaded->file, scratch, loaded->own};
    arena_init(scratch, limits_size(loader->input->limits, LIMIT_MESH_MEMORY));
    if (loaded->file.document) {
        gltf_document_guarded(loaded->file.document, arenas, read_coordinates, &reading);
    } else {
        const enum arena_fault fault = arena_guarded_all(arenas, read_coordinates, &reading);
        if (fault)
            asset_report_memory(&loaded->file, fault);
    }
    loaded->file.text = STR("");
    arena_finish(scratch);
}

// Reports faces that show an image without coordinates for it, by their groups' materials.
static void report_bare(struct loader *loader, const struct assets_model *model, struct loaded_mesh *loaded) {
    const struct mesh *mesh = loaded->mesh;
    uint32_t count = 0, first = 0, last_line = 0;
    for (uint32_t t = 0; mesh->textured && t < mesh->triangle_count; t++) {
        const struct mesh_triangle *triangle = &mesh->triangles[t];
        const uint32_t *at = mesh->textured[t];
        const bool bare = at[0] == IR_NO_INDEX || at[1] == IR_NO_INDEX || at[2] == IR_NO_INDEX;
        if (!bare || triangle->line == last_line ||
            !has_image(loader, model->group_material[triangle->group]))
            continue;
        last_line = triangle->line;
        if (count++ == 0)
            first = triangle->line;
    }
    if (count && loaded->made) {
        diag_add(loader->input->sink, DIAG_COORDINATES_MISSING, loaded->file.named_at,
                 "the faces of mesh '%.*s' have no 'uv', and a material with an image: they are shown in the "
                 "image's colour at 0, 0",
                 STR_ARG(loaded->name));
        diag_help(loader->input->sink,
                  "write 'uv', one of each vertex, or give the model a material without an image");
    } else if (count &&
               asset_report_line(&loaded->file, DIAG_COORDINATES_MISSING, first,
                                 "%u face%s no texture coordinates and a material with an image: %s shown in "
                                 "the image's colour at 0, 0",
                                 count, count == 1 ? " has" : "s have", count == 1 ? "it is" : "they are"))
        diag_help(loader->input->sink, "unwrap the mesh in a 3D program and export them (vt in OBJ; u and v, "
                                       "or s and t, of vertices in PLY; STL "
                                       "has none), or give the model a material without an image");
}

void loader_load_coordinates(struct loader *loader, const struct assets_model *model,
                             struct loaded_mesh *loaded) {
    bool wanted = false;
    if (loaded->no_image == model->group_material)
        return;
    for (uint32_t i = 0; i < loaded->mesh->group_count; i++)
        wanted |= has_image(loader, model->group_material[i]);
    if (!wanted) {
        loaded->no_image = model->group_material;
        return;
    }
    if (!loaded->mesh->textured && !loaded->coordinates_read)
        read_guarded(loader, loaded);
    if (!loaded->coordinates_read)
        report_bare(loader, model, loaded);
    loaded->coordinates_read = true;
}
