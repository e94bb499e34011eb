// The report on a scene, for people.
#include "cli/commands/inspect/inspect.h"
#include "core/heap.h"
#include "core/number.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_formula.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"

#include <stdlib.h>

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
    const uint32_t named = inspect_named_materials(scene);
    strbuf_format(out, "files       %u\n", s->origin.files.count);
    strbuf_format(out, "image       %d x %d pixels, %d sample%s\n", s->image->width, s->image->height,
                  s->image->samples, s->image->samples == 1 ? "" : "s");
    strbuf_format(out, "cameras     %u\nlights      %u\n", scene->cameras.count, scene->lights.count);
    strbuf_format(out, "materials   %u named, %u inline, %u used in all, including those of meshes\n", named,
                  scene->materials.count - named, s->assets.material_count);
    if (scene->meshes.count)
        strbuf_format(out, "meshes      %u described by the scene\n", scene->meshes.count);
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[i];
        if (scene_is_body(row->child))
            strbuf_format(out, "%-12s%u\n", schema_yaml_key(row), ir_walk_list(row, scene).count);
    }
}

static void bound(struct strbuf *out, const struct ir_parameter *p, const char *row, double value,
                  const char *word) {
    if (!ir_walk_written(&SCHEMA_PARAMETER, (uint32_t)schema_find_row(&SCHEMA_PARAMETER, str_from(row)), p))
        return;
    strbuf_format(out, ", %s ", word);
    number(out, value);
}

static void parameters(struct strbuf *out, const struct ir_scene *scene) {
    if (scene->parameters.count)
        strbuf_cstr(out, "parameters\n");
    for (uint32_t i = 0; i < scene->parameters.count; i++) {
        const struct ir_parameter *p = &scene->parameters.items[i];
        const struct ir_result *result = &scene->formulas->results[i];
        struct strbuf value;
        strbuf_init(&value);
        expression_print(result->type, result->value, &value);
        strbuf_format(out, "  %-17.*s%.*s", STR_ARG(p->name), STR_ARG(strbuf_view(&value)));
        bound(out, p, "min", p->min, "at least");
        bound(out, p, "max", p->max, "at most");
        const str bare = value.len && value.data[0] == '[' ? str_slice(strbuf_view(&value), 1, value.len - 1)
                                                           : strbuf_view(&value);
        if (!str_equal(p->value, bare))
            strbuf_format(out, " = %.*s", STR_ARG(p->value));
        if (p->description.len)
            strbuf_format(out, ": %.*s", STR_ARG(p->description));
        strbuf_char(out, '\n');
        strbuf_finish(&value);
    }
}

static void objects(struct strbuf *out, struct session *s) {
    const struct ir_copies *c = s->origin.copies;
    if (c && c->objects.count)
        strbuf_cstr(out, "objects\n");
    for (uint32_t i = 0; c && i < c->objects.count; i++) {
        const struct ir_shown *object = &c->objects.items[i];
        const struct source_place place = source_locate(&s->sources, object->at);
        strbuf_format(out, "  %-17.*s%u instance%s (%.*s:%u:%u)\n", STR_ARG(object->name), object->instances,
                      object->instances == 1 ? "" : "s", STR_ARG(place.path), place.line, place.column);
    }
}

static void copies(struct strbuf *out, struct session *s) {
    const struct ir_copies *c = s->origin.copies;
    objects(out, s);
    if (c && c->entries.count)
        strbuf_cstr(out, "copies\n");
    for (uint32_t i = 0; c && i < c->entries.count; i++) {
        const struct ir_copied *entry = &c->entries.items[i];
        struct strbuf label;
        strbuf_init(&label);
        if (entry->name.len)
            strbuf_format(&label, "%s '%.*s'", entry->list->child->name, STR_ARG(entry->name));
        else
            strbuf_format(&label, "%s[%u]", schema_yaml_key(entry->list), entry->entry);
        strbuf_format(out, "  %-16.*s %u", STR_ARG(strbuf_view(&label)), entry->count);
        const struct source_place place = source_locate(&s->sources, entry->at);
        strbuf_format(out, " (%.*s:%u:%u)\n", STR_ARG(place.path), place.line, place.column);
        strbuf_finish(&label);
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

// Models of one mesh.
struct mesh_use {
    const struct mesh *mesh;
    uint32_t first, count; // models: the index of the first
};

static int by_mesh(const void *a, const void *b) {
    const struct mesh_use *x = a, *y = b;
    if (x->mesh != y->mesh)
        return (uintptr_t)x->mesh < (uintptr_t)y->mesh ? -1 : 1;
    return x->first < y->first ? -1 : x->first > y->first;
}

static int by_first(const void *a, const void *b) {
    const struct mesh_use *x = a, *y = b;
    return x->first < y->first ? -1 : x->first > y->first;
}

// In the order of their first models; the caller frees the list. *count stays 0 without memory.
static struct mesh_use *find_uses(const struct session *s, uint32_t *count) {
    struct mesh_use *uses = heap_array(s->assets.model_count, sizeof *uses);
    for (uint32_t i = 0; uses && i < s->assets.model_count; i++)
        uses[i] = (struct mesh_use){s->assets.models[i].mesh, i, 1};
    if (!uses || s->assets.model_count == 0)
        return uses;
    qsort(uses, s->assets.model_count, sizeof *uses, by_mesh);
    for (uint32_t i = 0; i < s->assets.model_count; i++) {
        if (*count && uses[*count - 1].mesh == uses[i].mesh)
            uses[*count - 1].count++;
        else
            uses[(*count)++] = uses[i];
    }
    qsort(uses, *count, sizeof *uses, by_first);
    return uses;
}

// A line a mesh, not a model.
static void meshes(struct strbuf *out, const struct session *s) {
    uint32_t count = 0;
    struct mesh_use *uses = find_uses(s, &count);
    for (uint32_t i = 0; i < count; i++) {
        const struct mesh *mesh = uses[i].mesh;
        const struct ir_model *model = &s->scene->models.items[uses[i].first];
        if (!mesh)
            continue;
        const str shown = model->mesh.name.len ? model->mesh.name : mesh->path;
        if (uses[i].count > 1)
            strbuf_format(out, "  %u models, ", uses[i].count);
        else
            strbuf_format(out, "  %.*s%s", STR_ARG(model->name), model->name.len ? ", " : "");
        strbuf_format(out, "%.*s: %u triangles, %s", STR_ARG(shown), mesh->triangle_count,
                      mesh->closed ? "closed" : "open");
        if (!mesh->closed)
            strbuf_format(out, " (%u edges, the first at %s %u of the mesh)", mesh->open_edges,
                          mesh_place_word(mesh), mesh->open_line);
        if (mesh->zero_area)
            strbuf_format(out, ", %u without area", mesh->zero_area);
        strbuf_cstr(out, mesh->turned ? ", turned outward\n" : "\n");
    }
    free(uses);
}

static void features(struct strbuf *out, const struct inspected_scene *scene) {
    strbuf_cstr(out, "features\n");
    for (uint32_t i = 0; i < FEATURE_COUNT; i++) {
        const uint64_t bit = UINT64_C(1) << i;
        struct strbuf words;
        if (!(scene->flat.features & bit))
            continue;
        strbuf_init(&words);
        const span at = inspect_feature(scene, bit, &words);
        strbuf_format(out, "  %-17s", feature_name(bit));
        if (!span_is_none(at)) {
            struct source_place place = source_locate(&scene->session->sources, at);
            strbuf_format(out, "%.*s:%u:%u: ", STR_ARG(place.path), place.line, place.column);
        }
        strbuf_format(out, "%.*s\n", STR_ARG(strbuf_view(&words)));
        strbuf_finish(&words);
    }
    strbuf_cstr(out, "not required:");
    for (uint32_t i = 0; i < FEATURE_COUNT; i++)
        if (FEATURE_SCENE_MASK & ~scene->flat.features & UINT64_C(1) << i)
            strbuf_format(out, " %s", feature_name(UINT64_C(1) << i));
    strbuf_char(out, '\n');
}

// How models hold a mesh that several of them show, and why.
static void instances(struct strbuf *out, const struct flat_scene *flat) {
    if (!flat->use_count)
        return;
    strbuf_cstr(out, "meshes of several models\n");
    for (uint32_t i = 0; i < flat->use_count; i++) {
        const struct flat_use *use = &flat->uses[i];
        const char *what = use->mesh->path.len ? "models" : "boxes"; // which have one mesh, without a name
        strbuf_format(out, "  %.*s: ", STR_ARG(use->mesh->path.len ? use->mesh->path : STR("all boxes")));
        if (use->instances) {
            strbuf_format(out, "%u %s share %u triangles, which saves %.1f MiB", use->instances, what,
                          use->mesh->triangle_count - use->copied - use->left_out,
                          (double)use->saved_bytes / (1 << 20));
            if (use->copied)
                strbuf_format(out, "; %u more are too thin for that", use->copied);
            if (use->left_out)
                strbuf_format(out, "; %u are without area in all", use->left_out);
            strbuf_cstr(out, use->instances < use->models ? "; " : "\n");
        }
        if (use->instances < use->models) {
            strbuf_format(out, "%u %s have copies: ", use->models - use->instances, what);
            inspect_copies(use, out);
            strbuf_char(out, '\n');
        }
    }
    strbuf_cstr(out, "  a device without doubles makes copies for all\n");
}

static void buffers(struct strbuf *out, const struct flat_scene *flat) {
    struct inspect_buffer all[INSPECT_BUFFERS];
    const uint32_t count = inspect_buffers(flat, all);
    strbuf_cstr(out, "buffers\n");
    for (uint32_t i = 0; i < count; i++)
        strbuf_format(out, "  %-17s%12llu bytes\n", all[i].name, (unsigned long long)all[i].bytes);
    strbuf_format(out, "triangles   %u in a tree of depth %u, %u without area dropped", flat->triangle_count,
                  flat->triangle_depth, flat->dropped_triangles);
    if (flat->shown_triangles > flat->triangle_count)
        strbuf_format(out, "; %llu shown", (unsigned long long)flat->shown_triangles);
    strbuf_char(out, '\n');
    strbuf_cstr(out, "origin      ");
    vector(out, flat->origin);
    strbuf_format(out, ", scaled by 2^%d\n", flat->scale_exponent);
}

void inspect_scene_text(const struct inspected_scene *scene, struct strbuf *out) {
    counts(out, scene->session);
    parameters(out, scene->session->scene);
    copies(out, scene->session);
    bounds(out, scene->session);
    meshes(out, scene->session);
    precision_words(scene->session, &scene->precision, out);
    features(out, scene);
    instances(out, &scene->flat);
    buffers(out, &scene->flat);
}
