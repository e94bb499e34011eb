// glint inspect SCENE [--ir]: counts, bounds, features with their reasons, buffers; or the canonical dump.
#include "app/precision.h"
#include "app/where.h"
#include "cli/inspect/inspect.h"
#include "grammar/schema.h"

#include "core/number.h"
#include "grammar/ir.h"
#include "grammar/ir_features.h"
#include "grammar/ir_walk.h"
#include "grammar/print/ir_print.h"
#include "tracer/flatten/flatten.h"

static void number(struct strbuf *out, double value) {
    char text[NUMBER_FORMAT_MAX];
    strbuf_add(out, text, number_format(value, text));
}

static void vector(struct strbuf *out, vec3 v) {
    number(out, v.x);
    strbuf_char(out, ' ');
    number(out, v.y);
    strbuf_char(out, ' ');
    number(out, v.z);
}

static void counts(struct strbuf *out, const struct session *s) {
    const struct ir_scene *scene = s->scene;
    uint32_t named = 0;
    for (uint32_t i = 0; i < scene->materials.count; i++)
        named += scene->materials.items[i].name.len > 0;
    strbuf_format(out, "files       %u\n", s->origin.files.count);
    strbuf_format(out, "image       %d x %d pixels, %d sample%s\n", s->image->width, s->image->height,
                  s->image->samples, s->image->samples == 1 ? "" : "s");
    strbuf_format(out, "cameras     %u\nlights      %u\n", scene->cameras.count, scene->lights.count);
    strbuf_format(out, "materials   %u named, %u inline, %u used in all, including those of meshes\n", named,
                  scene->materials.count - named, s->assets.material_count);
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[i];
        if (scene_is_body(row->child))
            strbuf_format(out, "%-12s%u\n", schema_yaml_key(row), ir_walk_list(row, scene).count);
    }
}

static void bounds(struct strbuf *out, const struct session *s) {
    vec3 lower;
    vec3 upper;
    if (!scene_bounds(&s->resolved, &lower, &upper)) {
        strbuf_cstr(out, "bounds      none: the scene has no body\n");
        return;
    }
    strbuf_cstr(out, "bounds      ");
    vector(out, lower);
    strbuf_cstr(out, " to ");
    vector(out, upper);
    strbuf_char(out, '\n');
}

static void meshes(struct strbuf *out, const struct session *s) {
    for (uint32_t i = 0; i < s->assets.model_count; i++) {
        const struct mesh *mesh = s->assets.models[i].mesh;
        const struct ir_model *model = &s->scene->models.items[i];
        if (!mesh)
            continue;
        strbuf_format(out, "  %.*s%s%.*s: %u triangles, %s", STR_ARG(model->name),
                      model->name.len ? ", " : "", STR_ARG(model->mesh), mesh->triangle_count,
                      mesh->closed ? "closed" : "open");
        if (!mesh->closed)
            strbuf_format(out, " (%u edges, the first at %s %u of the mesh)", mesh->open_edges,
                          mesh_place_word(mesh), mesh->open_line);
        if (mesh->zero_area)
            strbuf_format(out, ", %u without area", mesh->zero_area);
        strbuf_cstr(out, mesh->turned ? ", turned outward\n" : "\n");
    }
}

static void features(struct strbuf *out, struct session *s, const struct flat_scene *flat) {
    struct ir_feature_reasons reasons;
    ir_features_explain(s->scene, &s->origin, &reasons);
    strbuf_cstr(out, "features\n");
    for (uint32_t i = 0; i < FEATURE_COUNT; i++) {
        const uint64_t bit = UINT64_C(1) << i;
        uint32_t k = 0;
        if (!(flat->features & bit))
            continue;
        strbuf_format(out, "  %-17s", feature_name(bit));
        while (k < reasons.count && reasons.items[k].bit != bit)
            k++;
        if (k == reasons.count) {
            where_feature_words(s, bit, &flat->media, out);
            continue;
        }
        if (!span_is_none(reasons.items[k].at)) {
            struct source_place place = source_locate(&s->sources, reasons.items[k].at);
            strbuf_format(out, "%.*s:%u:%u: ", STR_ARG(place.path), place.line, place.column);
        }
        strbuf_format(out, "%s\n", reasons.items[k].words);
    }
    strbuf_cstr(out, "not required:");
    for (uint32_t i = 0; i < FEATURE_COUNT; i++)
        if (FEATURE_SCENE_MASK & ~flat->features & UINT64_C(1) << i)
            strbuf_format(out, " %s", feature_name(UINT64_C(1) << i));
    strbuf_char(out, '\n');
}

static void buffer(struct strbuf *out, const char *name, uint64_t bytes) {
    if (bytes)
        strbuf_format(out, "  %-17s%12llu bytes\n", name, (unsigned long long)bytes);
}

static void reason(struct strbuf *out, const struct flat_use *use) {
    const double saved = (double)use->saved_bytes / (1 << 20);
    switch (use->reason) {
    case FLAT_REASON_UNEVEN:
        strbuf_cstr(out, "their scales differ too much in different directions, or are extreme");
        break;
    case FLAT_REASON_THIN:
        strbuf_cstr(out, "at their sizes rounding could leave too many triangles without area");
        break;
    default:
        if (saved < 0.05)
            strbuf_cstr(out, "sharing would save no memory");
        else
            strbuf_format(out, "sharing would save %.1f MiB, which is not worth slower rays", saved);
    }
}

// How models hold a mesh that several of them show, and why.
static void instances(struct strbuf *out, const struct flat_scene *flat) {
    if (!flat->use_count)
        return;
    strbuf_cstr(out, "meshes of several models\n");
    for (uint32_t i = 0; i < flat->use_count; i++) {
        const struct flat_use *use = &flat->uses[i];
        strbuf_format(out, "  %.*s: ", STR_ARG(use->mesh->path));
        if (use->instances) {
            strbuf_format(out, "%u models share %u triangles, which saves %.1f MiB", use->instances,
                          use->mesh->triangle_count - use->copied, (double)use->saved_bytes / (1 << 20));
            if (use->copied)
                strbuf_format(out, "; %u more are too thin for that", use->copied);
            strbuf_cstr(out, use->instances < use->models ? "; " : "\n");
        }
        if (use->instances < use->models) {
            strbuf_format(out, "%u models have copies: ", use->models - use->instances);
            reason(out, use);
            strbuf_char(out, '\n');
        }
    }
    strbuf_cstr(out, "  a device without doubles makes copies for all\n");
}

static void buffers(struct strbuf *out, const struct flat_scene *flat) {
    const uint64_t word = sizeof(struct gpu_word);
    strbuf_cstr(out, "buffers\n");
    buffer(out, "triangle tree", flat->triangle_nodes.count * word);
    buffer(out, "triangles", flat->triangles.count * word);
    buffer(out, "normals", flat->normals.count * word);
    buffer(out, "sphere tree", flat->sphere_nodes.count * word);
    buffer(out, "spheres", flat->spheres.count * word);
    buffer(out, "bodies", flat->bodies.count * word);
    buffer(out, "instances", flat->instances.count * word);
    buffer(out, "materials", flat->materials.count * word);
    buffer(out, "lights", flat->lights.count * word);
    buffer(out, "background", flat->background_texels.bytes);
    strbuf_format(out, "triangles   %u in a tree of depth %u, %u without area dropped", flat->triangle_count,
                  flat->triangle_depth, flat->dropped_triangles);
    if (flat->shown_triangles > flat->triangle_count)
        strbuf_format(out, "; %llu shown", (unsigned long long)flat->shown_triangles);
    strbuf_char(out, '\n');
    strbuf_cstr(out, "origin      ");
    vector(out, flat->origin);
    strbuf_format(out, ", scaled by 2^%d\n", flat->scale_exponent);
}

static bool describe(struct session *session, struct strbuf *out) {
    struct view view;
    struct flat_scene flat;
    if (!session_view(session, 0, &view))
        return false;
    struct flat_input input = precision_input(session, &view);
    input.sharing = FLAT_CHEAPER;
    struct precision_choice precision;
    if (!precision_forecast(session, &input, &precision) || !flatten(&input, &flat))
        return false;
    counts(out, session);
    bounds(out, session);
    meshes(out, session);
    precision_words(session, &precision, out);
    features(out, session, &flat);
    instances(out, &flat);
    buffers(out, &flat);
    flat_finish(&flat);
    return true;
}

int cmd_inspect(struct cli *cli) {
    if (inspect_is_picture(cli->operands[0]))
        return inspect_picture(cli);
    if (cli_has_no_effect(cli, "format", "only what a picture says is printed as JSON"))
        return CLI_USAGE;
    struct session session;
    struct strbuf text;
    struct asset_store *store = asset_store_create();
    struct session_options options = cli_session_options(cli, cli->operands[0]);
    options.text_only = cli->options.ir;
    options.lint = LINT_ALL;
    if (options.pixels == ASSETS_KEEP_PIXELS)
        options.pixels = ASSETS_CHECK_PIXELS;
    strbuf_init(&text);
    session_load(&session, &options, store);
    bool good = session.state == SESSION_LOADED && session.sink.errors == 0;
    if (good && cli->options.ir)
        ir_dump(session.scene, &text);
    else if (good)
        good = describe(&session, &text);
    int status = cli_report(cli, &session, !cli->options.ir);
    if (status == CLI_OK)
        status = good ? cli_print(cli, strbuf_view(&text)) : CLI_SCENE;
    strbuf_finish(&text);
    session_finish(&session);
    asset_store_destroy(store);
    return status;
}
