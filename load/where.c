#include "load/where.h"
#include "diag/codes/limit.h"

#include "grammar/ir.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_features.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"
#include "scene/hits.h"

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

bool where_find(const struct session *session, uint32_t number, uint32_t triangle, struct where *out) {
    if (number >= session->resolved.body_count)
        return false;
    const struct scene_body *body = &session->resolved.bodies[number];
    *out = (struct where){.kind = body->element->name,
                          .list = schema_yaml_key(ir_walk_pool(body->element)),
                          .row = ir_walk_pool(body->element),
                          .copies = session->origin.copies,
                          .index = body->index,
                          .name = body->name,
                          .at = ir_place_label(&session->origin, body->head),
                          .material = session->scene->materials.count};
    out->instance = ir_copies_instance(out->copies, out->row, out->index);
    if (out->instance)
        out->instance_at =
            ir_place_label(&session->origin, &session->scene->instances.items[out->instance - 1].head);
    if (!body->mesh && body->group_count) {
        out->material = scene_body_material(body, 0);
    } else if (body->mesh && triangle < body->mesh->triangle_count) {
        out->mesh = body->mesh->path;
        out->mesh_line = body->mesh->triangles[triangle].line;
        out->mesh_word = mesh_place_word(body->mesh);
        out->material = scene_body_material(body, triangle);
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
        ir_copies_label(where->copies, where->row, where->index, out);
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
        diag_note(&session->sink, SPAN_NONE, "the face there is at %s %u of %.*s", where.mesh_word,
                  where.mesh_line, STR_ARG(where.mesh));
    if (found && !span_is_none(where.material_at))
        diag_note(&session->sink, where.material_at, "its %.*s", STR_ARG(strbuf_view(&material)));
    else if (found)
        diag_note(&session->sink, SPAN_NONE, "it has the %.*s", STR_ARG(strbuf_view(&material)));
    strbuf_finish(&material);
    strbuf_finish(&body);
}

static span media_words(const struct session *session, const struct scene_media_reason *reason,
                        struct strbuf *out) {
    struct where a, b;
    if (reason->need == SCENE_MEDIA_MANY || !where_find(session, reason->a, 0, &a) ||
        !where_find(session, reason->b, 0, &b)) {
        strbuf_cstr(out, "bodies that refract are too many to be compared");
        return SPAN_NONE;
    }
    where_body_words(&b, out);
    if (reason->need == SCENE_MEDIA_ATTENUATION) {
        strbuf_cstr(out, " is coloured inside");
        return b.at;
    }
    strbuf_cstr(out, " may share a place with ");
    where_body_words(&a, out);
    return b.at;
}

span where_feature_words(const struct session *session, uint64_t feature,
                         const struct scene_media_reason *reason, struct strbuf *out) {
    if (feature == FEATURE_MEDIA)
        return media_words(session, reason, out);
    strbuf_cstr(out, "a material from a mesh's material file");
    return SPAN_NONE;
}

bool where_camera_fits(struct session *session, uint32_t camera, const struct view *view) {
    const uint32_t crowd = scene_media_crowd(&session->resolved, view->camera.position);
    if (!crowd)
        return true;
    const struct ir_cameras *cameras = &session->scene->cameras;
    const struct ir_head *head =
        camera < cameras->count ? &cameras->items[camera].head : &session->scene->head;
    diag_add(&session->sink, DIAG_LIMIT, ir_place_label(&session->origin, head),
             "the camera is inside %u bodies that refract; at most %d may surround a ray", crowd,
             SCENE_MEDIA_MOST);
    return false;
}
