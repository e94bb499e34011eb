#include "assets/gltf/gltf_internal.h"
#include "diag/codes/file.h"

// Extensions that are read and shown, or that change nothing shown.
static const char *const known[] = {
    "KHR_materials_ior",
    "KHR_materials_volume",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_lights_punctual",
    "KHR_texture_transform",
    "KHR_mesh_quantization",
    "KHR_materials_emissive_strength",
    "KHR_xmp_json_ld",
    "KHR_xmp",
};

static bool is_known(str name) {
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (str_equal_cstr(name, known[i]))
            return true;
    return false;
}

static void read_names(struct gltf *gltf, const char *key, bool is_required) {
    const json_index list = gltf_get_list(gltf, gltf->json.root, key);
    for (json_index at = json_at(&gltf->json, list)->first; at; at = json_at(&gltf->json, at)->next) {
        if (json_kind_of(&gltf->json, at) != JSON_TEXT) {
            gltf_add(gltf, DIAG_GLTF_VALUE, at, "'%s' must be a text", gltf_where(gltf, at));
            continue;
        }
        const str name = json_text(&gltf->json, at);
        const int shown = name.len < 80 ? (int)name.len : 80;
        if (is_known(name))
            continue;
        if (is_required)
            gltf_add(gltf, DIAG_GLTF_EXTENSION, at,
                     "the file requires the extension '%.*s', which glint does not read", shown, name.ptr);
        else
            gltf_add(gltf, DIAG_GLTF_DROPPED, at, "what the extension '%.*s' says is not drawn", shown,
                     name.ptr);
    }
}

static void gltf_read_extensions(struct gltf *gltf) {
    read_names(gltf, "extensionsRequired", true);
    if (gltf->errors == 0)
        read_names(gltf, "extensionsUsed", false);
}

static void check_version(struct gltf *gltf) {
    const json_index asset = gltf_get_object(gltf, gltf->json.root, "asset");
    str version = STR(""), least;
    if (!asset) {
        gltf_missing(gltf, gltf->json.root, "asset");
        return;
    }
    gltf_get_text(gltf, asset, "generator", &gltf->generator);
    if (!gltf_get_text(gltf, asset, "version", &version)) {
        if (!json_get(&gltf->json, asset, "version"))
            gltf_missing(gltf, asset, "version");
        return;
    }
    const json_index at = json_get(&gltf->json, asset, "version");
    if (!str_starts_with(version, STR("2.")))
        gltf_add(gltf, DIAG_GLTF_VALUE, at, "the file is glTF %.*s; glint reads glTF 2.0",
                 version.len < 20 ? (int)version.len : 20, version.ptr);
    else if (gltf_get_text(gltf, asset, "minVersion", &least) && !str_equal_cstr(least, "2.0"))
        gltf_add(gltf, DIAG_GLTF_VALUE, json_get(&gltf->json, asset, "minVersion"),
                 "the file needs a reader of glTF %.*s; glint reads glTF 2.0",
                 least.len < 20 ? (int)least.len : 20, least.ptr);
}

static void read_losses(struct gltf *gltf) {
    const json_index animations = gltf_get_list(gltf, gltf->json.root, "animations");
    if (animations && json_at(&gltf->json, animations)->count)
        gltf_lose(gltf, GLTF_LOSS_ANIMATION, animations);
}

void gltf_report_losses(struct gltf *gltf) {
    static const char *const words[GLTF_LOSSES] = {
#define X(NAME, sentence) [GLTF_LOSS_##NAME] = sentence,
#include "assets/gltf/losses.def"
#undef X
    };
    for (int i = 0; i < GLTF_LOSSES; i++) {
        struct gltf_loss_count *loss = &gltf->losses[i];
        if (loss->count == 1)
            gltf_add(gltf, DIAG_GLTF_DROPPED, loss->first, "%s", words[i]);
        else if (loss->count)
            gltf_add(gltf, DIAG_GLTF_DROPPED, loss->first, "%s (the first of %u)", words[i], loss->count);
        *loss = (struct gltf_loss_count){0};
    }
}

static void report_syntax(struct gltf *gltf) {
    gltf->errors++;
    if (gltf->report)
        gltf->report->add(gltf->report->context, DIAG_GLTF_SYNTAX, gltf->json.fault_begin,
                          gltf->json.fault_end, gltf->json.fault);
}

static bool read_json(struct gltf *gltf, str bytes, struct arena *arena) {
    str text = bytes;
    json_read(&gltf->json, STR("0"),
              arena); // faults before the JSON are placed at its first byte
    if (gltf_is_binary(bytes) && !gltf_take_chunks(gltf, bytes, &text))
        return false;
    if (!json_read(&gltf->json, text, arena)) {
        report_syntax(gltf);
        return false;
    }
    if (json_kind_of(&gltf->json, gltf->json.root) == JSON_OBJECT)
        return true;
    gltf_add(gltf, DIAG_GLTF_SYNTAX, gltf->json.root, "a glTF file is an object, and this is %s",
             json_kind_words(json_kind_of(&gltf->json, gltf->json.root)));
    return false;
}

bool gltf_open(struct gltf *gltf, str bytes, const struct gltf_report *report, struct arena *arena) {
    *gltf = (struct gltf){.arena = arena, .report = report};
    if (!read_json(gltf, bytes, arena))
        return false;
    check_version(gltf);
    if (gltf->errors == 0)
        gltf_read_extensions(gltf);
    if (gltf->errors)
        return false;
    gltf_read_buffers(gltf);
    gltf_read_images(gltf);
    gltf_read_materials(gltf);
    gltf_read_meshes(gltf);
    gltf_read_cameras(gltf);
    gltf_read_nodes(gltf);
    read_losses(gltf);
    return gltf->errors == 0;
}
