// From a place in a file to its path in the scene, by walking the table.
#include "load/check_path.h"

#include "grammar/ir_copies.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"

struct search {
    const struct session *session;
    const struct ir_scene *scene;
    const struct ir_copies *copies; // of the scene; NULL: it is as it is written
    struct arena *arena;
    span at;
    uint32_t best_size; // of the span found so far
    str best;
};

static bool holds(span outer, span at) {
    return outer.source == at.source && outer.begin <= at.begin && at.begin < outer.end;
}

// Keeps the path if its span is the tightest so far that contains the place.
static bool offer(struct search *s, span outer, str path) {
    if (!holds(outer, s->at))
        return false;
    if (outer.end - outer.begin <= s->best_size) {
        s->best_size = outer.end - outer.begin;
        s->best = path;
    }
    return true;
}

static str join(struct arena *arena, str path, str key) {
    return path.len ? arena_format(arena, "%.*s.%.*s", STR_ARG(path), STR_ARG(key)) : key;
}

static void walk_element(struct search *s, const struct schema_element *schema, const void *element,
                         str path);

static void walk_list(struct search *s, const struct schema_row *row, const void *element, str path) {
    struct ir_any_list list = ir_walk_list(row, element);
    uint32_t position = 0;
    for (uint32_t i = 0; i < list.count; i++) {
        const void *item = ir_walk_item(row, list, i);
        if (ir_walk_is_anonymous(row->child, item))
            continue; // written inline, where it is used
        const struct ir_head *head = ir_walk_head(item);
        const uint32_t number = position++, index = ir_copies_entry(s->copies, row, number);
        if (ir_copies_instance(s->copies, row, number))
            continue; // as it is written, it is in an object
        if (head->origin >= s->session->origin.elements.count)
            continue;
        const struct ir_element_origin *origin = &s->session->origin.elements.items[head->origin];
        if (!holds(origin->at, s->at) && !holds(origin->label, s->at))
            continue;
        str list_path = join(s->arena, path, str_from(schema_yaml_key(row)));
        str key = ir_walk_key(row->child, item);
        str own = row->many == SCHEMA_NAMED_MAP && key.len
                      ? join(s->arena, list_path, key)
                      : arena_format(s->arena, "%.*s[%u]", STR_ARG(list_path), index);
        offer(s, origin->at, own);
        offer(s, origin->label, own);
        walk_element(s, row->child, item, own);
    }
}

static void walk_row(struct search *s, const struct schema_row *row, const void *element, str path) {
    const void *field = schema_field_const(row, element);
    if (row->kind == SCHEMA_LIST) {
        walk_list(s, row, element, path);
    } else if (row->kind == SCHEMA_ELEMENT) {
        walk_element(s, row->child, field, join(s->arena, path, str_from(row->name)));
    } else if (row->kind == SCHEMA_REFERENCE && ir_walk_is_inline(s->scene, row, field)) {
        const void *body = ir_walk_referent(s->scene, row, field);
        walk_element(s, row->child, body, join(s->arena, path, str_from(row->name)));
    }
}

static void walk_element(struct search *s, const struct schema_element *schema, const void *element,
                         str path) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const struct ir_row_origin *origin = ir_origin_row(&s->session->origin, ir_walk_head(element), i);
        bool here = origin && (holds(origin->key, s->at) || holds(origin->value, s->at));
        if (here) {
            str own = join(s->arena, path, str_from(schema_yaml_key(row)));
            offer(s, origin->key, own);
            offer(s, origin->value, own);
        }
        // Lists gather their items from several places.
        if (here || row->kind == SCHEMA_LIST)
            walk_row(s, row, element, path);
    }
}

str check_scene_path(const struct session *session, struct arena *arena, span at) {
    const struct ir_copies *copies = session->origin.copies;
    struct search search = {session, session->scene, copies, arena, at, .best_size = UINT32_MAX};
    if (!session->scene || span_is_none(at))
        return search.best;
    walk_element(&search, &SCHEMA_SCENE, session->scene, STR(""));
    if (copies) {
        search.scene = copies->document;
        search.copies = NULL;
        walk_element(&search, &SCHEMA_SCENE, search.scene, STR(""));
    }
    return search.best;
}
