#include "load/import/import.h"
#include "diag/codes/file.h"

#include "assets/gltf/fields.h"
#include "assets/gltf/material.h"
#include "core/angle.h"
#include "grammar/ir.h"
#include "grammar/schema.h"
#include "load/import/names.h"
#include "load/import/place.h"
#include "load/import/repeated.h"

#include <math.h>

#define TOO_STRONG 30.0
#define LUMENS     683.0 // per watt, of green light

enum {
    WIDTH = 1024,
    SAMPLES_ROUGH = 16
};

// Where a node, and what is below it, is written.
struct site {
    uint32_t
        object;    // 1 + its index among the scene's; 0: the scene; AGAIN: nowhere, what is written shows it
    affine3 place; // the node's, in there
};
#define AGAIN UINT32_MAX

struct importing {
    struct gltf_document *document;
    struct gltf *gltf;
    const struct import_options *options;
    struct arena *arena;
    struct ir_scene *out;
    struct str_map cameras, materials, objects; // names that are taken
    struct {
        struct str_map
            *items; // of the scene, and of each of its objects: those of bodies, lights and instances
        uint32_t count, capacity;
    } names;
    str *material_names;  // by material of the file; empty: not used so far
    struct str_map parts; // names of meshes: how many meshes have each
    double dimming;
    struct ir_reference clay; // the material for a file without materials
};

static void write(struct ir_head *head, const struct schema_element *schema, const char *row) {
    head->written |= UINT64_C(1) << schema_find_row(schema, str_from(row));
}

// ---- materials

static bool has_rough_mirror(const struct gltf_material *m) {
    const bool is_rough = m->roughness > 0.01;
    return m->metal_texture.node ||
           (is_rough && m->roughness < 1 && (m->metallic > 0 || m->transmission > 0 || m->roughness <= 0.3));
}

static void put_material(struct importing *im, uint32_t material) {
    const uint32_t image = gltf_material_images(im->gltf, material).base;
    struct ir_material made;
    if (im->material_names[material].len || !gltf_document_material(im->document, material, true, &made))
        return;
    made.name = import_name(&im->materials, im->gltf->materials.items[material].name, "material");
    write(&made.head, &SCHEMA_MATERIAL, "name");
    if (image != GLTF_NONE)
        made.diffuse_color.image.file = im->options->images[image];
    im->material_names[material] = made.name;
    *ARENA_PUSH(im->arena, &im->out->materials) = made;
    write(&im->out->head, &SCHEMA_SCENE, "material");
}

static struct ir_reference ref_to(const struct importing *im, uint32_t material) {
    return (struct ir_reference){.name = im->material_names[material], .index = IR_NO_INDEX};
}

// The materials of a mesh's primitives that have faces, each once; GLTF_NONE among them: one has none.
static void put_materials(struct importing *im, const struct gltf_mesh *mesh, struct ir_model *model) {
    uint32_t first = GLTF_NONE, count = 0;
    for (uint32_t i = mesh->first; i < mesh->first + mesh->count; i++) {
        const struct gltf_primitive *p = &im->gltf->primitives.items[i];
        if (gltf_triangle_count(im->gltf, p) == 0)
            continue;
        count += count == 0 || p->material != first;
        first = count == 1 ? p->material : first;
        if (p->material != GLTF_NONE)
            put_material(im, p->material);
    }
    if (count == 1 && first != GLTF_NONE) {
        model->material = ref_to(im, first);
        write(&model->head, &SCHEMA_MODEL, "material");
        return;
    }
    struct str_map seen;
    str_map_init(&seen, im->arena);
    for (uint32_t i = mesh->first; i < mesh->first + mesh->count; i++) {
        const struct gltf_primitive *p = &im->gltf->primitives.items[i];
        if (p->material == GLTF_NONE || gltf_triangle_count(im->gltf, p) == 0)
            continue;
        const str from = gltf_material_name(im->gltf, p->material);
        if ((*str_map_at(&seen, from))++)
            continue;
        struct ir_map_entry *entry = ARENA_PUSH(im->arena, &model->material_map);
        schema_init(&SCHEMA_MAP_ENTRY, entry);
        entry->from = from;
        entry->to = ref_to(im, p->material);
        write(&entry->head, &SCHEMA_MAP_ENTRY, "from");
        write(&entry->head, &SCHEMA_MAP_ENTRY, "to");
        write(&model->head, &SCHEMA_MODEL, "material_map");
    }
}

// ---- models

static void write_vector(struct ir_head *head, const struct schema_element *schema, const char *row,
                         vec3 *field, vec3 value) {
    const vec3 standard = *field;
    *field = value;
    if (!vec3_is_zero(vec3_sub(value, standard)))
        write(head, schema, row);
}

#define WRITE_PLACE(out, schema, place)                                                                      \
    do {                                                                                                     \
        write_vector(&(out)->head, schema, "scale", &(out)->scale, (place)->scale);                          \
        write_vector(&(out)->head, schema, "rotation", &(out)->rotation, (place)->rotation);                 \
        write_vector(&(out)->head, schema, "translation", &(out)->translation, (place)->translation);        \
    } while (0)

// The mesh's name if no other mesh has it and it does not look like "mesh 3" or "node 3"; else its number.
static str part_name(struct importing *im, uint32_t mesh) {
    const str name = im->gltf->meshes.items[mesh].name;
    const bool is_number = str_starts_with(name, STR("mesh ")) || str_starts_with(name, STR("node "));
    if (name.len && !is_number && str_map_find(&im->parts, name) == 1 && gltf_is_clean(name))
        return name;
    return arena_format(im->arena, "mesh %u", mesh);
}

static bool is_smooth(const struct gltf *gltf, const struct gltf_mesh *mesh) {
    bool is = false;
    for (uint32_t i = mesh->first; i < mesh->first + mesh->count; i++)
        is |= gltf->primitives.items[i].normal != GLTF_NONE;
    return is;
}

static void put_model(struct importing *im, struct ir_models *models, const struct import_place *place,
                      str part, str name, const struct gltf_mesh *mesh) {
    struct ir_model *model = ARENA_PUSH(im->arena, models);
    schema_init(&SCHEMA_MODEL, model);
    model->material.index = IR_NO_INDEX;
    model->name = name;
    model->mesh = (struct ir_reference){im->options->mesh, IR_NO_INDEX};
    model->part = part;
    model->smooth = is_smooth(im->gltf, mesh);
    write(&model->head, &SCHEMA_MODEL, "name");
    write(&model->head, &SCHEMA_MODEL, "mesh");
    write(&model->head, &SCHEMA_MODEL, "part");
    if (model->smooth)
        write(&model->head, &SCHEMA_MODEL, "smooth");
    if (place)
        WRITE_PLACE(model, &SCHEMA_MODEL, place);
    if (im->clay.name.len) {
        model->material = im->clay;
        write(&model->head, &SCHEMA_MODEL, "material");
    } else if (im->options->images) {
        put_materials(im, mesh, model);
    }
}

// ---- objects

static struct ir_models *models_of(const struct importing *im, uint32_t object) {
    return object ? &im->out->objects.items[object - 1].models : &im->out->models;
}

// 1 + its index. Without a name it is in place.
static uint32_t add_object(struct importing *im, str name) {
    struct ir_object *object = ARENA_PUSH(im->arena, &im->out->objects);
    schema_init(&SCHEMA_OBJECT, object);
    object->name = name;
    str_map_init(ARENA_PUSH(im->arena, &im->names), im->arena);
    return im->out->objects.count;
}

static void write_matrix(struct importing *im, struct ir_instance *instance, const affine3 *map) {
    const double offset[3] = {map->offset.x, map->offset.y, map->offset.z};
    for (int i = 0; i < 3; i++) {
        struct ir_matrix_row *row = ARENA_PUSH(im->arena, &instance->matrix.rows);
        const double *m = map->linear.m[i];
        schema_init(&SCHEMA_MATRIX_ROW, row);
        row->numbers = (struct ir_quad){m[0], m[1], m[2], offset[i]};
        write(&row->head, &SCHEMA_MATRIX_ROW, "numbers");
    }
    write(&instance->matrix.head, &SCHEMA_MATRIX, "row");
    write(&instance->head, &SCHEMA_INSTANCE, "matrix");
}

static void put_instance(struct importing *im, uint32_t in, const struct import_place *place, str name,
                         uint32_t object) {
    struct ir_object *items = im->out->objects.items;
    struct ir_instance *instance = ARENA_PUSH(im->arena, in ? &items[in - 1].instances : &im->out->instances);
    schema_init(&SCHEMA_INSTANCE, instance);
    instance->material.index = IR_NO_INDEX;
    instance->name = name;
    instance->object = (struct ir_reference){items[object - 1].name, object - 1};
    write(&instance->head, &SCHEMA_INSTANCE, "name");
    write(&instance->head, &SCHEMA_INSTANCE, "object");
    if (place->is_sheared)
        write_matrix(im, instance, &place->matrix);
    else
        WRITE_PLACE(instance, &SCHEMA_INSTANCE, place);
}

// ---- bodies

// The node, else its mesh.
static str name_of(const struct importing *im, const struct gltf_node *node) {
    return node->name.len || node->mesh == GLTF_NONE ? node->name : im->gltf->meshes.items[node->mesh].name;
}

static void put_body(struct importing *im, const struct site *site, uint32_t index, bool is_root) {
    const struct gltf_node *node = &im->gltf->nodes.items[index];
    const struct gltf_mesh *mesh = &im->gltf->meshes.items[node->mesh];
    struct import_place place;
    const bool has_room = import_place_of(site->place, &place);
    const str part = has_room ? part_name(im, node->mesh) : arena_format(im->arena, "node %u", index);
    const str name =
        import_name(&im->names.items[site->object], is_root ? mesh->name : name_of(im, node), "body");
    if (!has_room || !place.is_sheared) {
        put_model(im, models_of(im, site->object), has_room ? &place : NULL, part, name, mesh);
        return;
    }
    const uint32_t group = add_object(im, STR(""));
    const str own = import_name(&im->names.items[group], mesh->name, "body");
    put_model(im, models_of(im, group), NULL, part, own, mesh);
    put_instance(im, site->object, &place, name, group);
}

// ---- cameras and lights

static void put_camera(struct importing *im, const struct gltf_node *node) {
    const struct gltf_camera *camera = &im->gltf->cameras.items[node->camera];
    struct ir_camera *out = ARENA_PUSH(im->arena, &im->out->cameras);
    schema_init(&SCHEMA_CAMERA, out);
    out->name = import_name(&im->cameras, node->name.len ? node->name : camera->name, "camera");
    out->position = import_tidy_vector(node->world.offset);
    out->view = IR_VIEW_ROTATION;
    out->rotation = import_rotation(mat3_column(node->world.linear, 1), mat3_column(node->world.linear, 2));
    write(&out->head, &SCHEMA_CAMERA, "name");
    write(&out->head, &SCHEMA_CAMERA, "position");
    write(&out->head, &SCHEMA_CAMERA, "rotation");
    if (camera->is_orthographic) {
        out->projection = IR_PROJECTION_ORTHOGRAPHIC;
        out->size = import_tidy(2 * camera->ymag);
        write(&out->head, &SCHEMA_CAMERA, "projection");
        write(&out->head, &SCHEMA_CAMERA, "size");
    } else {
        out->fov = fmin(import_tidy(camera->yfov / PI * 180), 179.9);
        write(&out->head, &SCHEMA_CAMERA, "fov");
    }
    if (im->out->cameras.count == 1 && camera->aspect > 0) {
        im->out->image.height = (int32_t)fmin(fmax(round(WIDTH / camera->aspect), 16), 16 * WIDTH);
        write(&im->out->image.head, &SCHEMA_IMAGE, "height");
    }
    write(&im->out->head, &SCHEMA_SCENE, "camera");
}

// Both fade by the square of a ramp between the cosines of two angles.
static void put_spot(struct ir_light *out, const struct gltf_light *light, vec3 direction) {
    out->spot.aim = IR_AIM_DIRECTION;
    out->spot.direction = direction;
    out->spot.angle = import_tidy(2 * light->outer / RADIANS);
    out->spot.softness = light->outer > 0 ? import_tidy(fmax(1 - light->inner / light->outer, 0)) : 0;
    write(&out->head, &SCHEMA_LIGHT, "spot");
    write(&out->spot.head, &SCHEMA_SPOT, "direction");
    write(&out->spot.head, &SCHEMA_SPOT, "angle");
    write(&out->spot.head, &SCHEMA_SPOT, "softness");
}

static void put_light(struct importing *im, const struct site *site, const struct gltf_node *node) {
    const struct gltf_light *light = &im->gltf->lights.items[node->light];
    struct ir_lights *lights =
        site->object ? &im->out->objects.items[site->object - 1].lights : &im->out->lights;
    struct ir_light *out = ARENA_PUSH(im->arena, lights);
    schema_init(&SCHEMA_LIGHT, out);
    out->name =
        import_name(&im->names.items[site->object], node->name.len ? node->name : light->name, "light");
    write(&out->head, &SCHEMA_LIGHT, "name");
    const vec3 to = vec3_unit(vec3_neg(mat3_column(site->place.linear, 2)));
    const vec3 direction = vec3_is_zero(to) ? (vec3){0, 0, -1} : import_tidy_vector(to);
    if (light->kind == GLTF_LIGHT_DIRECTIONAL) {
        out->kind = IR_LIGHT_DIRECTION;
        out->direction = direction;
        write(&out->head, &SCHEMA_LIGHT, "direction");
    } else {
        out->position = import_tidy_vector(site->place.offset);
        out->falloff = IR_FALLOFF_INVERSE_SQUARE;
        write(&out->head, &SCHEMA_LIGHT, "position");
        write(&out->head, &SCHEMA_LIGHT, "falloff");
    }
    if (light->kind == GLTF_LIGHT_SPOT)
        put_spot(out, light, direction);
    out->intensity = import_tidy(fmin(light->intensity / PI / im->dimming, 1e6));
    out->color = (struct ir_color){.r = light->color[0], .g = light->color[1], .b = light->color[2]};
    write(&out->head, &SCHEMA_LIGHT, "intensity");
    if (light->color[0] != 1 || light->color[1] != 1 || light->color[2] != 1)
        write(&out->head, &SCHEMA_LIGHT, "color");
}

// ---- how strong lights are

// How far the bodies reach from *middle, a point amid them, judged by the positions of their nodes.
static double reach_of(const struct gltf *gltf, vec3 *middle) {
    vec3 lower = {0, 0, 0}, upper = {0, 0, 0};
    bool any = false;
    for (uint32_t i = 0; i < gltf->order_count; i++) {
        const struct gltf_node *node = &gltf->nodes.items[gltf->order[i]];
        if (node->mesh == GLTF_NONE)
            continue;
        lower = any ? vec3_min(lower, node->world.offset) : node->world.offset;
        upper = any ? vec3_max(upper, node->world.offset) : node->world.offset;
        any = true;
    }
    *middle = vec3_mul(vec3_add(lower, upper), 0.5);
    return vec3_length(vec3_sub(upper, lower)) / 2;
}

// A further divisor of all lights: 683 if the strongest would make white surfaces more than 30 times too
// bright, as in files that state watts as lumens (Blender's standard units), else 1.
static double import_dimming(struct gltf_document *document) {
    const struct gltf *gltf = &document->gltf;
    vec3 middle;
    const double reach = reach_of(gltf, &middle);
    double strongest = 0;
    for (uint32_t i = 0; i < gltf->order_count; i++) {
        const struct gltf_node *node = &gltf->nodes.items[gltf->order[i]];
        if (node->light == GLTF_NONE)
            continue;
        const struct gltf_light *light = &gltf->lights.items[node->light];
        const double far = fmax(fmax(vec3_length(vec3_sub(node->world.offset, middle)), reach), 1e-9);
        const double at = light->kind == GLTF_LIGHT_DIRECTIONAL ? 1 : far * far;
        strongest = fmax(strongest, light->intensity / PI / at);
    }
    return strongest > TOO_STRONG ? LUMENS : 1;
}

void import_report(struct gltf_document *document) {
    if (import_dimming(document) > 1)
        gltf_add(
            &document->gltf, DIAG_GLTF_DIMMED, document->gltf.lights.items[0].node,
            "the lights are that strong that they were divided by %g, as if watts had been written as lumens",
            LUMENS);
    gltf_report_losses(&document->gltf);
}

// ---- the scene

bool *import_images(struct gltf_document *document, struct arena *arena) {
    const struct gltf *gltf = &document->gltf;
    bool *shown = ARENA_ARRAY(arena, bool, (size_t)gltf->images.count + 1);
    for (uint32_t i = 0; i < gltf->order_count; i++) {
        const struct gltf_node *node = &gltf->nodes.items[gltf->order[i]];
        const struct gltf_mesh *mesh = node->mesh == GLTF_NONE ? NULL : &gltf->meshes.items[node->mesh];
        for (uint32_t k = 0; mesh && k < mesh->count; k++) {
            const struct gltf_primitive *p = &gltf->primitives.items[mesh->first + k];
            const uint32_t image = p->material == GLTF_NONE || gltf_triangle_count(gltf, p) == 0
                                       ? GLTF_NONE
                                       : gltf_material_images(gltf, p->material).base;
            if (image != GLTF_NONE)
                shown[image] = true;
        }
    }
    return shown;
}

static void put_head(struct importing *im) {
    struct ir_scene *out = im->out;
    bool is_rough = false;
    for (uint32_t i = 0; i < im->gltf->materials.count; i++)
        is_rough |= has_rough_mirror(&im->gltf->materials.items[i]);
    out->version = 1;
    out->image.transfer = IR_TRANSFER_SRGB;
    write(&out->head, &SCHEMA_SCENE, "glint");
    write(&out->head, &SCHEMA_SCENE, "image");
    write(&out->image.head, &SCHEMA_IMAGE, "transfer");
    if (is_rough) {
        out->image.samples = SAMPLES_ROUGH;
        write(&out->image.head, &SCHEMA_IMAGE, "samples");
    }
    // Metal and glass show nothing without surroundings, and a glTF file has none.
    out->background.color = (struct ir_color){.r = 0.35, .g = 0.4, .b = 0.45};
    write(&out->head, &SCHEMA_SCENE, "background");
    write(&out->background.head, &SCHEMA_BACKGROUND, "color");
}

unsigned import_lacks(const struct gltf_document *document) {
    const struct gltf *gltf = &document->gltf;
    unsigned lacks = IMPORT_LACKS_CAMERA | IMPORT_LACKS_LIGHT;
    for (uint32_t i = 0; i < gltf->order_count; i++) {
        const struct gltf_node *node = &gltf->nodes.items[gltf->order[i]];
        lacks &= node->camera != GLTF_NONE ? ~(unsigned)IMPORT_LACKS_CAMERA : lacks;
        lacks &= node->light != GLTF_NONE ? ~(unsigned)IMPORT_LACKS_LIGHT : lacks;
    }
    return lacks;
}

// Reserves the names of what was taken from the scene around the mesh.
static void keep_names(struct importing *im) {
    const struct ir_scene *out = im->out;
    for (uint32_t i = 0; i < out->cameras.count; i++)
        import_name(&im->cameras, out->cameras.items[i].name, "camera");
    for (uint32_t i = 0; i < out->lights.count; i++)
        import_name(&im->names.items[0], out->lights.items[i].name, "light");
    for (uint32_t i = 0; i < out->rectangles.count; i++)
        import_name(&im->names.items[0], out->rectangles.items[i].name, "body");
    for (uint32_t i = 0; i < out->materials.count; i++)
        import_name(&im->materials, out->materials.items[i].name, "material");
}

// A floor and a backdrop are added only if the file has neither camera nor lights: with them it is a scene
// already.
static void put_around(struct importing *im, unsigned lacks) {
    const struct ir_scene *around = im->options->around;
    struct ir_scene *out = im->out;
    if (lacks & IMPORT_LACKS_CAMERA) {
        out->cameras = around->cameras;
        write(&out->head, &SCHEMA_SCENE, "camera");
    }
    if (lacks & IMPORT_LACKS_LIGHT) {
        out->lights = around->lights;
        out->ambient = around->ambient;
        out->image.samples = around->image.samples;
        write(&out->head, &SCHEMA_SCENE, "light");
        write(&out->head, &SCHEMA_SCENE, "ambient");
        write(&out->image.head, &SCHEMA_IMAGE, "samples");
    }
    if (lacks == (IMPORT_LACKS_CAMERA | IMPORT_LACKS_LIGHT)) {
        out->rectangles = around->rectangles;
        out->background = around->background;
        write(&out->head, &SCHEMA_SCENE, "rectangle");
    }
    if (out->rectangles.count || around->models.items[0].material.name.len) {
        out->materials = around->materials;
        write(&out->head, &SCHEMA_SCENE, "material");
    }
    im->clay = around->models.items[0].material;
    keep_names(im);
}

struct gltf_document *import_open(const struct assets_input *input, str path) {
    const struct asset_file file = {.input = input, .path = path, .what = "mesh", .limit = LIMIT_MESH_BYTES};
    struct file_read identity;
    if (files_identify(input->files, path, &identity) != FILE_OK ||
        identity.size_bytes > input->limits->value[LIMIT_MESH_BYTES])
        return NULL;
    return gltf_document_open(&file, &identity);
}

// An instance where what is below the node is an object. Returns whether this is the node that the object is
// made of; `made`: 1 + its index, 0: it was not made.
static bool put_occurrence(struct importing *im, const struct gltf_node *node, struct site *site,
                           uint32_t *made) {
    const struct site around = *site;
    const str own = name_of(im, node);
    const bool is_first = *made == 0;
    struct import_place place;
    if (is_first)
        *made = add_object(im, import_name(&im->objects, own, "object"));
    import_place_of(around.place, &place);
    put_instance(im, around.object, &place, import_name(&im->names.items[around.object], own, "group"),
                 *made);
    *site = (struct site){is_first ? *made : AGAIN, {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}}};
    return is_first;
}

static void put_nodes(struct importing *im) {
    const struct gltf *gltf = im->gltf;
    const uint32_t *repeated = import_repeated(gltf, im->document->file.input->limits, im->arena);
    struct site *sites = ARENA_ARRAY(im->arena, struct site, (size_t)gltf->nodes.count + 1);
    uint32_t *made = ARENA_ARRAY(im->arena, uint32_t, (size_t)gltf->nodes.count + 1);
    for (uint32_t i = 0; i < gltf->order_count; i++) {
        const uint32_t index = gltf->order[i];
        const struct gltf_node *node = &gltf->nodes.items[index];
        const struct site *above = node->parent == GLTF_NONE ? NULL : &sites[node->parent];
        struct site *site = &sites[index];
        *site = above ? (struct site){above->object, affine3_mul(above->place, node->local)}
                      : (struct site){0, node->local};
        if (above && above->object == AGAIN)
            continue;
        const bool is_root = repeated[index] != 0;
        if (is_root && !put_occurrence(im, node, site, &made[repeated[index]]))
            continue;
        if (node->mesh != GLTF_NONE && import_has_faces(gltf, node->mesh))
            put_body(im, site, index, is_root);
        if (node->camera != GLTF_NONE)
            put_camera(im, node);
        if (node->light != GLTF_NONE)
            put_light(im, site, node);
    }
}

void import_gltf(struct gltf_document *document, const struct import_options *options, struct arena *arena,
                 struct ir_scene *out) {
    struct importing im = {
        .document = document, .gltf = &document->gltf, .options = options, .arena = arena, .out = out};
    *out = (struct ir_scene){0};
    schema_init(&SCHEMA_SCENE, out);
    str_map_init(ARENA_PUSH(arena, &im.names), arena);
    str_map_init(&im.objects, arena);
    str_map_init(&im.cameras, arena);
    str_map_init(&im.materials, arena);
    str_map_init(&im.parts, arena);
    im.material_names = ARENA_ARRAY(arena, str, (size_t)im.gltf->materials.count + 1);
    im.dimming = import_dimming(document);
    for (uint32_t i = 0; i < im.gltf->meshes.count; i++)
        (*str_map_at(&im.parts, im.gltf->meshes.items[i].name))++;
    put_head(&im);
    if (options->around)
        put_around(&im, import_lacks(document));
    put_nodes(&im);
}
