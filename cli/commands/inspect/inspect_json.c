// The report on a scene, for programs: docs/schema/inspect-scene-report.schema.json.
#include "cli/commands/inspect/inspect.h"
#include "core/json_write.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_formula.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"

enum {
    FLAT_DEPTH = 3 // from here on a value is on one line
};

static void put_vector(struct json_writer *w, const char *key, vec3 v) {
    const double numbers[] = {v.x, v.y, v.z};
    json_open_list(w, key);
    for (int i = 0; i < 3; i++)
        json_write_real(w, NULL, numbers[i]);
    json_close_list(w);
}

static void put_place(struct json_writer *w, struct session *session, span at) {
    if (span_is_none(at)) {
        json_write_null(w, "place");
        return;
    }
    const struct source_place place = source_locate(&session->sources, at);
    json_open_object(w, "place");
    json_write_text(w, "file", place.path);
    json_write_integer(w, "line", place.line);
    json_write_integer(w, "column", place.column);
    json_close_object(w);
}

static void put_image(struct json_writer *w, const struct session *s) {
    json_open_object(w, "image");
    json_write_integer(w, "width", (uint64_t)s->image->width);
    json_write_integer(w, "height", (uint64_t)s->image->height);
    json_write_integer(w, "samples", (uint64_t)s->image->samples);
    json_close_object(w);
}

static void put_counts(struct json_writer *w, const struct session *s) {
    const struct ir_scene *scene = s->scene;
    const uint32_t named = inspect_named_materials(scene);
    json_open_object(w, "counts");
    json_write_integer(w, "cameras", scene->cameras.count);
    json_write_integer(w, "lights", scene->lights.count);
    json_write_integer(w, "materials", named);
    json_write_integer(w, "inline_materials", scene->materials.count - named);
    json_write_integer(w, "used_materials", s->assets.material_count);
    json_write_integer(w, "meshes", scene->meshes.count);
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[i];
        if (scene_is_body(row->child))
            json_write_integer(w, schema_yaml_key(row), ir_walk_list(row, scene).count);
    }
    json_close_object(w);
}

static void put_bound(struct json_writer *w, const struct ir_parameter *p, const char *row, double value) {
    if (ir_walk_written(&SCHEMA_PARAMETER, (uint32_t)schema_find_row(&SCHEMA_PARAMETER, str_from(row)), p))
        json_write_real(w, row, value);
    else
        json_write_null(w, row);
}

static void put_result(struct json_writer *w, const struct ir_result *result) {
    if (result->type == EXPRESSION_TRUTH)
        json_write_boolean(w, "value", result->value[0] != 0);
    else if (result->type == EXPRESSION_NUMBER)
        json_write_real(w, "value", result->value[0]);
    else
        put_vector(w, "value", (vec3){result->value[0], result->value[1], result->value[2]});
}

static void put_parameters(struct json_writer *w, const struct ir_scene *scene) {
    json_open_list(w, "parameters");
    for (uint32_t i = 0; i < scene->parameters.count; i++) {
        const struct ir_parameter *p = &scene->parameters.items[i];
        json_open_object(w, NULL);
        json_write_text(w, "name", p->name);
        put_result(w, &scene->formulas->results[i]);
        json_write_text(w, "written", p->value);
        put_bound(w, p, "min", p->min);
        put_bound(w, p, "max", p->max);
        json_write_text(w, "description", p->description);
        json_close_object(w);
    }
    json_close_list(w);
}

static void put_objects(struct json_writer *w, const struct ir_copies *copies) {
    json_open_list(w, "objects");
    for (uint32_t i = 0; copies && i < copies->objects.count; i++) {
        json_open_object(w, NULL);
        json_write_text(w, "name", copies->objects.items[i].name);
        json_write_integer(w, "instances", copies->objects.items[i].instances);
        json_close_object(w);
    }
    json_close_list(w);
}

static void put_copies(struct json_writer *w, const struct ir_copies *copies) {
    json_open_list(w, "copies");
    for (uint32_t i = 0; copies && i < copies->entries.count; i++) {
        const struct ir_copied *entry = &copies->entries.items[i];
        json_open_object(w, NULL);
        json_write_text(w, "list", str_from(schema_yaml_key(entry->list)));
        json_write_integer(w, "index", entry->entry);
        json_write_text(w, "name", entry->name);
        json_write_integer(w, "count", entry->count);
        json_close_object(w);
    }
    json_close_list(w);
}

static void put_bounds(struct json_writer *w, const struct session *s) {
    vec3 lower, upper;
    if (!scene_bounds(&s->resolved, &lower, &upper)) {
        json_write_null(w, "bounds");
        return;
    }
    json_open_object(w, "bounds");
    put_vector(w, "lower", lower);
    put_vector(w, "upper", upper);
    json_close_object(w);
}

static void put_models(struct json_writer *w, const struct session *s) {
    json_open_list(w, "models");
    for (uint32_t i = 0; i < s->assets.model_count; i++) {
        const struct mesh *mesh = s->assets.models[i].mesh;
        const struct ir_model *model = &s->scene->models.items[i];
        if (!mesh)
            continue;
        json_open_object(w, NULL);
        json_write_text(w, "name", model->name);
        json_write_text(w, "mesh", model->mesh.name.len ? model->mesh.name : mesh->path);
        json_write_integer(w, "triangles", mesh->triangle_count);
        json_write_boolean(w, "closed", mesh->closed);
        json_write_integer(w, "open_edges", mesh->open_edges);
        json_write_integer(w, "without_area", mesh->zero_area);
        json_write_boolean(w, "turned", mesh->turned);
        json_close_object(w);
    }
    json_close_list(w);
}

static void put_precision(struct json_writer *w, const struct inspected_scene *scene) {
    const struct precision_choice *choice = &scene->precision;
    const struct ir_scene *ir = scene->session->scene;
    json_open_object(w, "precision");
    json_write_text(w, "setting", str_from(precision_setting_word(ir->trace.precision)));
    json_write_text(w, "choice", str_from(precision_is_double(ir, choice) ? "double" : "single"));
    json_write_integer(w, "traced_pixels", choice->traced ? choice->pixels : 0);
    json_write_integer(w, "differing_pixels", choice->traced ? choice->off : 0);
    json_close_object(w);
    json_open_list(w, "precision_measures");
    for (int i = 0; i < PRECISION_FEATURES; i++) {
        const struct precision_measure *m = &choice->report.least[i];
        if (!m->any)
            continue;
        json_open_object(w, NULL);
        json_write_text(w, "name", str_from(precision_feature_words((enum precision_feature)i)));
        json_write_real(w, "length", m->length);
        json_write_real(w, "distance", m->distance);
        json_write_real(w, "steps", m->steps);
        json_close_object(w);
    }
    json_close_list(w);
}

static void put_features(struct json_writer *w, const struct inspected_scene *scene) {
    const uint64_t on = scene->flat.features;
    json_open_list(w, "features");
    for (uint32_t i = 0; i < FEATURE_COUNT; i++) {
        const uint64_t bit = UINT64_C(1) << i;
        struct strbuf words;
        if (!(on & bit))
            continue;
        strbuf_init(&words);
        const span at = inspect_feature(scene, bit, &words);
        json_open_object(w, NULL);
        json_write_text(w, "name", str_from(feature_name(bit)));
        put_place(w, scene->session, at);
        json_write_text(w, "why", strbuf_view(&words));
        json_close_object(w);
        strbuf_finish(&words);
    }
    json_close_list(w);
    json_open_list(w, "not_required");
    for (uint32_t i = 0; i < FEATURE_COUNT; i++)
        if (FEATURE_SCENE_MASK & ~on & UINT64_C(1) << i)
            json_write_text(w, NULL, str_from(feature_name(UINT64_C(1) << i)));
    json_close_list(w);
}

static void put_meshes(struct json_writer *w, const struct flat_scene *flat) {
    json_open_list(w, "meshes");
    for (uint32_t i = 0; i < flat->use_count; i++) {
        const struct flat_use *use = &flat->uses[i];
        json_open_object(w, NULL);
        json_write_text(w, "mesh", use->mesh->path);
        json_write_integer(w, "models", use->models);
        json_write_integer(w, "instances", use->instances);
        // Sharing a small mesh can cost memory.
        json_write_real(w, "saved_bytes", (double)use->saved_bytes);
        struct strbuf words;
        strbuf_init(&words);
        if (use->instances < use->models)
            inspect_copies(use, &words);
        json_write_text(w, "why_copies", strbuf_view(&words));
        strbuf_finish(&words);
        json_close_object(w);
    }
    json_close_list(w);
}

static void put_buffers(struct json_writer *w, const struct flat_scene *flat) {
    struct inspect_buffer all[INSPECT_BUFFERS];
    const uint32_t count = inspect_buffers(flat, all);
    json_open_list(w, "buffers");
    for (uint32_t i = 0; i < count; i++) {
        json_open_object(w, NULL);
        json_write_text(w, "name", str_from(all[i].name));
        json_write_integer(w, "bytes", all[i].bytes);
        json_close_object(w);
    }
    json_close_list(w);
    json_open_object(w, "tree");
    json_write_integer(w, "triangles", flat->triangle_count);
    json_write_integer(w, "shown_triangles", flat->shown_triangles);
    json_write_integer(w, "dropped_triangles", flat->dropped_triangles);
    json_write_integer(w, "depth", flat->triangle_depth);
    json_close_object(w);
}

void inspect_scene_json(const struct inspected_scene *scene, struct strbuf *out) {
    const struct session *session = scene->session;
    struct json_writer w;
    json_report_begin(&w, out, FLAT_DEPTH, "glint inspect scene", 1);
    json_open_list(&w, "files");
    for (uint32_t i = 0; i < session->origin.files.count; i++)
        json_write_text(&w, NULL, session->sources.items[session->origin.files.items[i].source].path);
    json_close_list(&w);
    put_image(&w, session);
    put_counts(&w, session);
    put_parameters(&w, session->scene);
    put_objects(&w, session->origin.copies);
    put_copies(&w, session->origin.copies);
    put_bounds(&w, session);
    put_models(&w, session);
    put_precision(&w, scene);
    put_features(&w, scene);
    put_meshes(&w, &scene->flat);
    put_buffers(&w, &scene->flat);
    json_report_end(&w);
}
