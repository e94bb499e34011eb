#include "render/aov/names.h"

#include "core/json_write.h"
#include "core/str_map.h"
#include "grammar/ir_copies.h"
#include "load/where.h"
#include "render/aov/matte.h"
#include "scene/hits.h"

#include <stdio.h>

enum {
    FLAT_DEPTH = 3, // of the table: an entry a line
};

// ---- names

static const char *text(struct arena *arena, str s) {
    return arena_format(arena, "%.*s", STR_ARG(s)).ptr;
}

enum {
    NAMED_COPIES_MOST = 100000 // bodies of a scene: beyond it, copies of one entry share its name
};

static struct aov_name object_of(const struct session *session, uint32_t body, struct arena *arena) {
    struct where where;
    where_find(session, body, 0, &where);
    struct strbuf label;
    strbuf_init(&label);
    if (session->resolved.body_count > NAMED_COPIES_MOST && where.copies)
        ir_copies_entry_label(where.copies, where.row, where.index, where.name, &label);
    else if (where.name.len)
        strbuf_str(&label, where.name);
    else
        ir_copies_label(where.copies, where.row, where.index, &label);
    const char *name = text(arena, strbuf_view(&label));
    strbuf_finish(&label);
    return (struct aov_name){.name = name, .kind = where.kind, .at = where.at};
}

// Names each material of a body, found by the first triangle that shows it.
static void name_materials_of(const struct session *session, uint32_t number, const char *object,
                              struct arena *arena, struct aov_name *materials) {
    const struct scene_body *body = &session->resolved.bodies[number];
    const uint32_t triangles = body->mesh ? body->triangle_count : 1;
    uint32_t left = body->group_count;
    for (uint32_t i = 0; i < triangles && left; i++) {
        struct aov_name *name = &materials[scene_body_material(body, i)];
        struct where where;
        if (name->kind)
            continue;
        left--;
        where_find(session, number, i, &where);
        name->kind = where.material_kind;
        name->at = where.material_at;
        const bool is_default = where.material == session->scene->materials.count;
        name->name = where.material_name.len ? text(arena, where.material_name)
                     : is_default            ? name->kind
                                             : arena_format(arena, "%s.material", object).ptr;
    }
}

static void finish_names(struct aov_name *names, uint32_t count, struct arena *arena) {
    struct str_map seen;
    str_map_init(&seen, arena);
    for (uint32_t i = 0; i < count; i++) {
        const str name = str_from(names[i].name);
        names[i].bits = matte_bits(matte_hash(name));
        names[i].is_again = (*str_map_at(&seen, name))++ > 0;
    }
}

// Materials of the scene that no body shows are named too.
static void name_rest(const struct session *session, struct aov_names *out, struct arena *arena) {
    for (uint32_t i = 0; i < out->material_count; i++) {
        struct aov_name *name = &out->materials[i];
        if (name->kind)
            continue;
        const str own = session->assets.materials[i].name;
        const bool is_default = i == session->scene->materials.count;
        name->kind = is_default ? "default material" : own.len ? "material" : "inline material";
        name->name = own.len ? text(arena, own) : arena_format(arena, "%s %u", name->kind, i + 1).ptr;
        name->at = SPAN_NONE;
        if (i < session->scene->materials.count)
            name->at = ir_place_label(&session->origin, &session->scene->materials.items[i].head);
    }
}

void aov_names_make(const struct session *session, struct arena *arena, struct aov_names *out) {
    *out = (struct aov_names){.object_count = session->resolved.body_count,
                              .material_count = session->resolved.material_count};
    out->objects = ARENA_ARRAY(arena, struct aov_name, out->object_count);
    out->materials = ARENA_ARRAY(arena, struct aov_name, out->material_count);
    for (uint32_t i = 0; i < out->object_count; i++) {
        out->objects[i] = object_of(session, i, arena);
        name_materials_of(session, i, out->objects[i].name, arena, out->materials);
    }
    name_rest(session, out, arena);
    finish_names(out->objects, out->object_count, arena);
    finish_names(out->materials, out->material_count, arena);
}

// ---- as JSON

static void put_hash(struct json_writer *w, const char *key, uint32_t bits) {
    char hash[9];
    snprintf(hash, sizeof hash, "%08x", bits);
    json_write_text(w, key, str_from(hash));
}

static void put_list(struct json_writer *w, const char *key, const struct aov_name *names, uint32_t count,
                     struct source_set *sources) {
    struct strbuf at;
    strbuf_init(&at);
    json_open_list(w, key);
    for (uint32_t i = 0; i < count; i++) {
        json_open_object(w, NULL);
        json_write_integer(w, "id", i + 1);
        json_write_text(w, "name", str_from(names[i].name));
        json_write_text(w, "kind", str_from(names[i].kind));
        if (!span_is_none(names[i].at)) {
            const struct source_place place = source_locate(sources, names[i].at);
            strbuf_clear(&at);
            strbuf_format(&at, "%.*s:%u:%u", STR_ARG(place.path), place.line, place.column);
            json_write_text(w, "place", strbuf_view(&at));
        }
        put_hash(w, "hash", names[i].bits);
        json_close_object(w);
    }
    json_close_list(w);
    strbuf_finish(&at);
}

void aov_names_json(const struct aov_names *names, struct source_set *sources, struct strbuf *out) {
    struct json_writer w;
    json_writer_init(&w, out, FLAT_DEPTH);
    json_open_object(&w, NULL);
    put_list(&w, "objects", names->objects, names->object_count, sources);
    put_list(&w, "materials", names->materials, names->material_count, sources);
    json_close_object(&w);
    json_end(&w);
}

void aov_manifest(const struct aov_name *names, uint32_t count, struct strbuf *out) {
    struct json_writer w;
    json_writer_init(&w, out, 0);
    json_open_object(&w, NULL);
    for (uint32_t i = 0; i < count; i++)
        if (!names[i].is_again)
            put_hash(&w, names[i].name, names[i].bits);
    json_close_object(&w);
}
