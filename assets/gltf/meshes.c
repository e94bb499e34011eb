// Meshes: which accessors their primitives take, and whether these fit together.
#include "assets/gltf/gltf_internal.h"
#include "diag/codes/file.h"

// The accessor of an attribute; GLTF_NONE: it has none, or what is wrong was reported.
static uint32_t read_attribute(struct gltf *gltf, json_index attributes, const char *key, uint32_t components,
                               uint32_t count) {
    uint32_t index;
    if (!gltf_get_index(gltf, attributes, key, gltf->accessors.count, &index))
        return GLTF_NONE;
    const struct gltf_accessor *accessor = &gltf->accessors.items[index];
    const json_index at = json_get(&gltf->json, attributes, key);
    if (accessor->components != components || accessor->is_matrix) {
        gltf_add(gltf, DIAG_GLTF_VALUE, at, "'%s' must name an accessor of type VEC%u", gltf_where(gltf, at),
                 components);
        return GLTF_NONE;
    }
    if (count != GLTF_NONE && accessor->count != count) {
        gltf_add(gltf, DIAG_GLTF_VALUE, at, "'%s' has %u elements, and POSITION %u", gltf_where(gltf, at),
                 accessor->count, count);
        return GLTF_NONE;
    }
    return index;
}

static void read_indices(struct gltf *gltf, json_index node, struct gltf_primitive *primitive) {
    if (!gltf_get_index(gltf, node, "indices", gltf->accessors.count, &primitive->indices))
        return;
    const struct gltf_accessor *accessor = &gltf->accessors.items[primitive->indices];
    const json_index at = json_get(&gltf->json, node, "indices");
    const unsigned type = accessor->component;
    if (accessor->components != 1 || (type != GLTF_UINT8 && type != GLTF_UINT16 && type != GLTF_UINT32))
        gltf_add(gltf, DIAG_GLTF_VALUE, at,
                 "'%s' must name an accessor of type SCALAR and componentType 5121, 5123 or 5125",
                 gltf_where(gltf, at));
    else if (accessor->normalized)
        gltf_add(gltf, DIAG_GLTF_VALUE, at, "'%s' must not name a normalized accessor", gltf_where(gltf, at));
}

static void read_attributes(struct gltf *gltf, json_index attributes, struct gltf_primitive *primitive) {
    static const char *const sets[GLTF_COORDINATE_SETS] = {"TEXCOORD_0", "TEXCOORD_1"};
    primitive->position = read_attribute(gltf, attributes, "POSITION", 3, GLTF_NONE);
    if (primitive->position == GLTF_NONE)
        return;
    const uint32_t count = gltf->accessors.items[primitive->position].count;
    primitive->normal = read_attribute(gltf, attributes, "NORMAL", 3, count);
    for (int i = 0; i < GLTF_COORDINATE_SETS; i++)
        primitive->coordinates[i] = read_attribute(gltf, attributes, sets[i], 2, count);
    const json_index colors = json_get(&gltf->json, attributes, "COLOR_0");
    if (colors)
        gltf_lose(gltf, GLTF_LOSS_COLORS, colors);
}

static void read_primitive(struct gltf *gltf, json_index node) {
    struct gltf_primitive *primitive = ARENA_PUSH(gltf->arena, &gltf->primitives);
    *primitive = (struct gltf_primitive){.node = node, .position = GLTF_NONE, .normal = GLTF_NONE};
    uint64_t mode = GLTF_TRIANGLES;
    primitive->coordinates[0] = primitive->coordinates[1] = GLTF_NONE;
    const json_index attributes = gltf_get_object(gltf, node, "attributes");
    if (attributes)
        read_attributes(gltf, attributes, primitive);
    else if (!json_get(&gltf->json, node, "attributes"))
        gltf_missing(gltf, node, "attributes");
    read_indices(gltf, node, primitive);
    gltf_get_index(gltf, node, "material", gltf->materials.count, &primitive->material);
    gltf_get_whole(gltf, node, "mode", GLTF_TRIANGLE_FAN, &mode);
    primitive->mode = (unsigned)mode;
    if (mode < GLTF_TRIANGLES)
        gltf_lose(gltf, GLTF_LOSS_NOT_FACES, node);
    const json_index targets = json_get(&gltf->json, node, "targets");
    if (targets)
        gltf_lose(gltf, GLTF_LOSS_MORPH, targets);
}

static void read_mesh(struct gltf *gltf, json_index node) {
    struct gltf_mesh *mesh = ARENA_PUSH(gltf->arena, &gltf->meshes);
    *mesh = (struct gltf_mesh){.node = node, .name = gltf_name(gltf, node), .first = gltf->primitives.count};
    const json_index list = gltf_get_list(gltf, node, "primitives");
    if (!json_get(&gltf->json, node, "primitives"))
        gltf_missing(gltf, node, "primitives");
    else if (list && json_at(&gltf->json, list)->count == 0)
        gltf_add(gltf, DIAG_GLTF_VALUE, list, "'%s' is empty", gltf_where(gltf, list));
    for (json_index at = 0; list && (at = gltf_next_object(gltf, list, at));)
        read_primitive(gltf, at);
    mesh->count = gltf->primitives.count - mesh->first;
}

void gltf_read_meshes(struct gltf *gltf) {
    const json_index list = gltf_get_list(gltf, gltf->json.root, "meshes");
    for (json_index at = 0; list && (at = gltf_next_object(gltf, list, at));)
        read_mesh(gltf, at);
}
