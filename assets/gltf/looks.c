// Images, textures and materials.
#include "assets/gltf/gltf_internal.h"
#include "core/str_map.h"
#include "diag/codes/file.h"

#include <math.h>

// ---- images

static void read_image(struct gltf *gltf, json_index node) {
    struct gltf_image *image = ARENA_PUSH(gltf->arena, &gltf->images);
    *image = (struct gltf_image){.node = node, .uri = STR(""), .mime = STR("")};
    image->name = gltf_name(gltf, node);
    gltf_get_text(gltf, node, "mimeType", &image->mime);
    gltf_get_text(gltf, node, "uri", &image->uri);
    gltf_get_index(gltf, node, "bufferView", gltf->views.count, &image->view);
    if (image->uri.len == 0 && image->view == GLTF_NONE && !json_get(&gltf->json, node, "uri") &&
        !json_get(&gltf->json, node, "bufferView"))
        gltf_add(gltf, DIAG_GLTF_VALUE, node, "'%s' must have 'uri' or 'bufferView'", gltf_where(gltf, node));
    if (image->uri.len && image->view != GLTF_NONE)
        gltf_add(gltf, DIAG_GLTF_VALUE, node, "'%s' has both 'uri' and 'bufferView'", gltf_where(gltf, node));
}

static unsigned read_wrap(struct gltf *gltf, json_index node, const char *key) {
    uint64_t value = GLTF_WRAP_REPEAT;
    gltf_get_whole(gltf, node, key, UINT32_MAX, &value);
    if (value == GLTF_WRAP_REPEAT || value == GLTF_WRAP_CLAMP || value == GLTF_WRAP_MIRROR)
        return (unsigned)value;
    const json_index at = json_get(&gltf->json, node, key);
    gltf_add(gltf, DIAG_GLTF_VALUE, at, "'%s' must be 10497, 33071 or 33648", gltf_where(gltf, at));
    return GLTF_WRAP_REPEAT;
}

static struct gltf_sampler read_sampler(struct gltf *gltf, json_index node) {
    struct gltf_sampler sampler = {.wrap = {GLTF_WRAP_REPEAT, GLTF_WRAP_REPEAT}};
    uint64_t magnify = 0;
    if (!node)
        return sampler;
    gltf_get_whole(gltf, node, "magFilter", UINT32_MAX, &magnify);
    sampler.magnify = (unsigned)magnify;
    sampler.wrap[0] = read_wrap(gltf, node, "wrapS");
    sampler.wrap[1] = read_wrap(gltf, node, "wrapT");
    return sampler;
}

static json_index nth(const struct gltf *gltf, json_index list, uint32_t index) {
    json_index at = json_at(&gltf->json, list)->first;
    while (at && index--)
        at = json_at(&gltf->json, at)->next;
    return at;
}

static void read_texture(struct gltf *gltf, json_index node, json_index samplers) {
    struct gltf_texture *texture = ARENA_PUSH(gltf->arena, &gltf->textures);
    uint32_t sampler;
    *texture = (struct gltf_texture){.node = node};
    gltf_get_index(gltf, node, "source", gltf->images.count, &texture->image);
    gltf_get_index(gltf, node, "sampler", samplers ? json_at(&gltf->json, samplers)->count : 0, &sampler);
    texture->sampler = read_sampler(gltf, sampler == GLTF_NONE ? 0 : nth(gltf, samplers, sampler));
}

void gltf_read_images(struct gltf *gltf) {
    const json_index root = gltf->json.root;
    json_index list = gltf_get_list(gltf, root, "images");
    for (json_index at = 0; list && (at = gltf_next_object(gltf, list, at));)
        read_image(gltf, at);
    const json_index samplers = gltf_get_list(gltf, root, "samplers");
    list = gltf_get_list(gltf, root, "textures");
    for (json_index at = 0; list && (at = gltf_next_object(gltf, list, at));)
        read_texture(gltf, at, samplers);
}

// ---- materials

static void read_transform(struct gltf *gltf, json_index node, struct gltf_texture_use *use) {
    uint64_t set = use->set;
    use->has_transform = true;
    gltf_get_numbers(gltf, node, "offset", -HUGE_VAL, HUGE_VAL, 2, use->offset);
    gltf_get_numbers(gltf, node, "scale", -HUGE_VAL, HUGE_VAL, 2, use->scale);
    gltf_get_number(gltf, node, "rotation", -HUGE_VAL, HUGE_VAL, &use->rotation);
    gltf_get_whole(gltf, node, "texCoord", UINT32_MAX - 1, &set);
    use->set = (uint32_t)set;
}

static struct gltf_texture_use read_use(struct gltf *gltf, json_index object, const char *key) {
    struct gltf_texture_use use = {.scale = {1, 1}};
    const json_index node = gltf_get_object(gltf, object, key);
    uint64_t set = 0;
    if (!node)
        return use;
    use.node = node;
    if (!gltf_get_index(gltf, node, "index", gltf->textures.count, &use.texture)) {
        if (!json_get(&gltf->json, node, "index"))
            gltf_missing(gltf, node, "index");
        use.node = 0;
        return use;
    }
    gltf_get_whole(gltf, node, "texCoord", UINT32_MAX - 1, &set);
    use.set = (uint32_t)set;
    const json_index transform = gltf_extension(gltf, node, "KHR_texture_transform");
    if (transform)
        read_transform(gltf, transform, &use);
    return use;
}

static void read_metal(struct gltf *gltf, json_index node, struct gltf_material *m) {
    gltf_get_numbers(gltf, node, "baseColorFactor", 0, 1, 4, m->base);
    gltf_get_number(gltf, node, "metallicFactor", 0, 1, &m->metallic);
    gltf_get_number(gltf, node, "roughnessFactor", 0, 1, &m->roughness);
    m->base_texture = read_use(gltf, node, "baseColorTexture");
    m->metal_texture = read_use(gltf, node, "metallicRoughnessTexture");
}

static void read_alpha(struct gltf *gltf, json_index node, struct gltf_material *m) {
    str mode;
    if (!gltf_get_text(gltf, node, "alphaMode", &mode) || str_equal_cstr(mode, "OPAQUE"))
        return;
    m->alpha = str_equal_cstr(mode, "MASK") ? GLTF_ALPHA_MASK : GLTF_ALPHA_BLEND;
    const json_index at = json_get(&gltf->json, node, "alphaMode");
    if (m->alpha == GLTF_ALPHA_BLEND && !str_equal_cstr(mode, "BLEND"))
        gltf_add(gltf, DIAG_GLTF_VALUE, at, "'%s' must be OPAQUE, MASK or BLEND", gltf_where(gltf, at));
}

static void read_glass(struct gltf *gltf, json_index node, struct gltf_material *m) {
    const json_index ior = gltf_extension(gltf, node, "KHR_materials_ior");
    const json_index transmission = gltf_extension(gltf, node, "KHR_materials_transmission");
    const json_index volume = gltf_extension(gltf, node, "KHR_materials_volume");
    gltf_get_number(gltf, ior, "ior", 0, 1e6, &m->index);
    gltf_get_number(gltf, transmission, "transmissionFactor", 0, 1, &m->transmission);
    m->transmission_texture = gltf_get_object(gltf, transmission, "transmissionTexture");
    gltf_get_number(gltf, volume, "thicknessFactor", 0, HUGE_VAL, &m->thickness);
    gltf_get_number(gltf, volume, "attenuationDistance", 0x1p-149, HUGE_VAL, &m->attenuation_distance);
    gltf_get_numbers(gltf, volume, "attenuationColor", 0, 1, 3, m->attenuation_color);
}

static void read_material(struct gltf *gltf, json_index node) {
    struct gltf_material *m = ARENA_PUSH(gltf->arena, &gltf->materials);
    *m = (struct gltf_material){.node = node,
                                .base = {1, 1, 1, 1},
                                .metallic = 1,
                                .roughness = 1,
                                .index = 1.5,
                                .attenuation_distance = HUGE_VAL,
                                .attenuation_color = {1, 1, 1}};
    double strength = 1;
    m->name = gltf_name(gltf, node);
    const json_index metal = gltf_get_object(gltf, node, "pbrMetallicRoughness");
    if (metal)
        read_metal(gltf, metal, m);
    gltf_get_numbers(gltf, node, "emissiveFactor", 0, 1, 3, m->emission);
    gltf_get_number(gltf, gltf_extension(gltf, node, "KHR_materials_emissive_strength"), "emissiveStrength",
                    0, 1e12, &strength);
    for (int k = 0; k < 3; k++)
        m->emission[k] *= strength;
    m->emission_texture = read_use(gltf, node, "emissiveTexture");
    m->normal_texture = read_use(gltf, node, "normalTexture");
    m->occlusion_texture = read_use(gltf, node, "occlusionTexture");
    m->is_unlit = gltf_extension(gltf, node, "KHR_materials_unlit") != 0;
    read_alpha(gltf, node, m);
    read_glass(gltf, node, m);
}

// Which materials go by their own name: the first of each name, unless the name has control characters or
// could be taken for one like "material 3", which all others go by.
static void find_names(struct gltf *gltf) {
    struct str_map map;
    str_map_init(&map, gltf->arena);
    for (uint32_t i = 0; i < gltf->materials.count; i++) {
        struct gltf_material *m = &gltf->materials.items[i];
        m->is_named = m->name.len && gltf_is_clean(m->name) && !str_starts_with(m->name, STR("material ")) &&
                      (*str_map_at(&map, m->name))++ == 0;
    }
}

void gltf_read_materials(struct gltf *gltf) {
    const json_index list = gltf_get_list(gltf, gltf->json.root, "materials");
    for (json_index at = 0; list && (at = gltf_next_object(gltf, list, at));)
        read_material(gltf, at);
    find_names(gltf);
}
