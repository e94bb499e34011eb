// What both reports on a scene share.
#include "cli/commands/inspect/inspect.h"
#include "load/where.h"

uint32_t inspect_named_materials(const struct ir_scene *scene) {
    uint32_t named = 0;
    for (uint32_t i = 0; i < scene->materials.count; i++)
        named += scene->materials.items[i].name.len > 0;
    return named;
}

span inspect_feature(const struct inspected_scene *scene, uint64_t bit, struct strbuf *words) {
    const struct ir_feature_reasons *reasons = &scene->reasons;
    for (uint32_t i = 0; i < reasons->count; i++)
        if (reasons->items[i].bit == bit) {
            strbuf_cstr(words, reasons->items[i].words);
            return reasons->items[i].at;
        }
    return where_feature_words(scene->session, bit, &scene->flat.media, words);
}

uint32_t inspect_buffers(const struct flat_scene *flat, struct inspect_buffer *out) {
    const uint64_t word = sizeof(struct gpu_word);
    const struct inspect_buffer all[] = {
        {"triangle tree", flat->triangle_nodes.count * word},
        {"triangles", flat->triangles.count * word},
        {"normals", flat->normals.count * word},
        {"sphere tree", flat->sphere_nodes.count * word},
        {"spheres", flat->spheres.count * word},
        {"bodies", flat->bodies.count * word},
        {"instances", flat->instances.count * word},
        {"materials", flat->materials.count * word},
        {"lights", flat->lights.count * word},
        {"background", flat->background_texels.bytes},
    };
    _Static_assert(sizeof all / sizeof *all <= INSPECT_BUFFERS, "all of them fit");
    uint32_t count = 0;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i].bytes)
            out[count++] = all[i];
    return count;
}

void inspect_copies(const struct flat_use *use, struct strbuf *words) {
    const double saved = (double)use->saved_bytes / (1 << 20);
    switch (use->reason) {
    case FLAT_REASON_UNEVEN:
        strbuf_cstr(words, "their scales differ too much in different directions, or are extreme");
        break;
    case FLAT_REASON_THIN:
        strbuf_cstr(words, "at their sizes rounding could leave too many triangles without area");
        break;
    default:
        if (saved < 0.05)
            strbuf_cstr(words, "sharing would save no memory");
        else
            strbuf_format(words, "sharing would save %.1f MiB, which is not worth slower rays", saved);
    }
}
