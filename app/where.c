#include "app/where.h"

#include "scene/hits.h"

static const struct ir_material_ref *find_body(const struct session *session, uint32_t body,
                                               struct where *out) {
    const struct ir_scene *scene = session->scene;
    const struct ir_head *head;
    const struct ir_material_ref *ref = NULL;
    if (body < scene->spheres.count) {
        const struct ir_sphere *sphere = &scene->spheres.items[body];
        *out = (struct where){.kind = "sphere", .index = body, .name = sphere->name};
        head = &sphere->head;
        ref = &sphere->material;
    } else if ((body -= scene->spheres.count) < scene->rectangles.count) {
        const struct ir_rectangle *rectangle = &scene->rectangles.items[body];
        *out = (struct where){.kind = "rectangle", .index = body, .name = rectangle->name};
        head = &rectangle->head;
        ref = &rectangle->material;
    } else {
        body -= scene->rectangles.count;
        *out = (struct where){.kind = "model", .index = body, .name = scene->models.items[body].name};
        head = &scene->models.items[body].head;
    }
    out->at = ir_place_label(&session->origin, head);
    return ref;
}

static void find_material(const struct session *session, struct where *out) {
    const struct ir_materials *of_scene = &session->scene->materials;
    const struct ir_material *material = &session->assets.materials[out->material];
    out->material_name = material->name;
    if (out->material == of_scene->count)
        out->material_kind = "default material";
    else if (out->material > of_scene->count)
        out->material_kind = "material of the mesh";
    else
        out->material_kind = material->name.len ? "material" : "inline material";
    if (out->material < of_scene->count)
        out->material_at = ir_place_label(&session->origin, &of_scene->items[out->material].head);
}

bool where_find(const struct session *session, uint32_t body, uint32_t triangle, struct where *out) {
    if (body >= ir_body_count(session->scene))
        return false;
    const struct ir_material_ref *ref = find_body(session, body, out);
    out->material = session->scene->materials.count;
    if (ref) {
        out->material = assets_material(session->scene, ref);
    } else if (out->index < session->assets.model_count) {
        const struct assets_model *model = &session->assets.models[out->index];
        if (model->mesh && triangle < model->mesh->triangle_count) {
            out->mesh = model->mesh->path;
            out->mesh_line = model->mesh->triangles[triangle].line;
            out->material = model->group_material[model->mesh->triangles[triangle].group];
        }
    }
    find_material(session, out);
    return true;
}

void where_body_words(const struct where *where, struct strbuf *out) {
    if (!where)
        strbuf_cstr(out, "the background");
    else if (where->name.len)
        strbuf_format(out, "%s '%.*s'", where->kind, STR_ARG(where->name));
    else
        strbuf_format(out, "%ss[%u]", where->kind, where->index);
}

void where_material_words(const struct where *where, struct strbuf *out) {
    strbuf_cstr(out, where->material_kind);
    if (where->material_name.len)
        strbuf_format(out, " '%.*s'", STR_ARG(where->material_name));
}

void where_report_fault(struct session *session, const struct where_fault *fault) {
    struct where where;
    const bool found = where_find(session, fault->body, fault->triangle, &where);
    const span at = found ? where.at : ir_place_label(&session->origin, &session->scene->head);
    struct strbuf body, material;
    strbuf_init(&body);
    strbuf_init(&material);
    if (found) {
        strbuf_cstr(&body, ", where the ray last hit ");
        where_body_words(&where, &body);
        where_material_words(&where, &material);
    }
    diag_add(&session->sink, fault->code, at, "%u pixel%s %s, the first at %u,%u%.*s", fault->pixels,
             fault->pixels == 1 ? "" : "s", fault->words, fault->x, fault->y, STR_ARG(strbuf_view(&body)));
    if (found && where.mesh_line)
        diag_note(&session->sink, SPAN_NONE, "the face there is at line %u of %.*s", where.mesh_line,
                  STR_ARG(where.mesh));
    if (found && !span_is_none(where.material_at))
        diag_note(&session->sink, where.material_at, "its %.*s", STR_ARG(strbuf_view(&material)));
    else if (found)
        diag_note(&session->sink, SPAN_NONE, "it has the %.*s", STR_ARG(strbuf_view(&material)));
    strbuf_finish(&material);
    strbuf_finish(&body);
}
