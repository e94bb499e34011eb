#include "lsp/locate.h"

#include "grammar/ir.h"
#include "grammar/ir_walk.h"

uint32_t locate_source(struct session *session, str path) {
    for (uint32_t i = 0; i < session->origin.files.count; i++) {
        uint32_t source = session->origin.files.items[i].source;
        if (str_equal(files_canonical(&session->files, session->sources.items[source].path), path))
            return source;
    }
    return SOURCE_DEFAULT;
}

// ---- what is at a place

struct search {
    const struct session *session;
    uint32_t source;
    size_t offset;
    struct located found;
    size_t size; // of what was found, in bytes
};

static bool covers(const struct search *search, span at) {
    return at.source == search->source && at.begin <= search->offset && search->offset <= at.end;
}

static void offer(struct search *search, struct located located) {
    size_t size = located.at.end - located.at.begin;
    if (!covers(search, located.at) || (search->found.schema && size > search->size))
        return;
    search->found = located;
    search->found.offset = search->offset;
    search->size = size;
}

static void search_element(void *context, const struct schema_element *schema, const void *element) {
    struct search *search = context;
    const struct ir_head *head = ir_walk_head(element);
    if (head->origin == 0 || head->origin >= search->session->origin.elements.count)
        return;
    const struct ir_element_origin *origin = &search->session->origin.elements.items[head->origin];
    offer(search, (struct located){schema, element, .at = origin->label});
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct ir_row_origin *row = ir_origin_row(&search->session->origin, head, i);
        if (!row)
            continue;
        offer(search, (struct located){schema, element, &schema->rows[i], .at = row->key});
        offer(search,
              (struct located){schema, element, &schema->rows[i], .in_value = true, .at = row->value});
    }
}

struct located locate(struct session *session, str path, size_t offset) {
    struct search search = {.session = session, .source = locate_source(session, path), .offset = offset};
    if (!session->scene || search.source == SOURCE_DEFAULT)
        return search.found;
    locate_walk(&SCHEMA_SCENE, session->scene, search_element, &search);
    // The merged scene no longer has includes.
    for (uint32_t i = 0; i < session->origin.files.count; i++) {
        const struct ir_file_origin *file = &session->origin.files.items[i];
        if (file->source == search.source && file->scene)
            search_element(&search, &SCHEMA_SCENE, file->scene);
        for (uint32_t k = 0; file->source == search.source && file->scene && k < file->scene->includes.count;
             k++)
            search_element(&search, &SCHEMA_INCLUDE, &file->scene->includes.items[k]);
    }
    return search.found;
}

// ---- names

struct users {
    struct session *session;
    struct arena *arena;
    const void *referent;
    struct located_name *out;
};

static void note_users(void *context, const struct schema_element *schema, const void *element) {
    struct users *users = context;
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        if (row->kind != SCHEMA_REFERENCE)
            continue;
        const struct ir_reference *reference = schema_field_const(row, element);
        if (reference->name.len == 0 ||
            ir_walk_referent(users->session->scene, row, reference) != users->referent)
            continue;
        const struct ir_row_origin *place = ir_origin_row(&users->session->origin, ir_walk_head(element), i);
        bool known = !place;
        for (uint32_t k = 0; !known && k < users->out->uses.count; k++)
            known = span_equal(users->out->uses.items[k], place->value);
        if (!known)
            *ARENA_PUSH(users->arena, &users->out->uses) = place->value;
    }
}

// Where an element's name is written: in a map of YAML as the key, elsewhere as the key row's value.
static span name_place(const struct session *session, const struct schema_element *schema,
                       const void *element) {
    int key = schema_key_row(schema);
    const struct ir_row_origin *row =
        key < 0 ? NULL : ir_origin_row(&session->origin, ir_walk_head(element), (uint32_t)key);
    return row ? row->value : ir_place_label(&session->origin, ir_walk_head(element));
}

bool locate_name(struct session *session, const struct located *at, struct arena *arena,
                 struct located_name *out) {
    *out = (struct located_name){0};
    if (!at->schema || !session->scene)
        return false;
    const struct schema_element *schema = at->schema;
    const void *named = at->element;
    span word = at->at;
    const struct ir_parameter *parameter = locate_parameter(session, at, &word);
    if (parameter) {
        schema = &SCHEMA_PARAMETER;
        named = parameter;
    } else if (at->row && at->row->kind == SCHEMA_REFERENCE && at->in_value) {
        schema = at->row->child;
        named = ir_walk_referent(session->scene, at->row, schema_field_const(at->row, at->element));
    } else if (!span_equal(at->at, name_place(session, schema, named))) {
        return false;
    }
    if (!named || ir_walk_key(schema, named).len == 0)
        return false;
    out->name = ir_walk_key(schema, named);
    out->schema = schema;
    out->element = named;
    out->here = parameter ? word : at->at;
    out->definition = name_place(session, schema, named);
    struct users users = {session, arena, named, out};
    locate_walk(&SCHEMA_SCENE, session->scene, note_users, &users);
    if (schema == &SCHEMA_PARAMETER)
        locate_parameter_uses(session, named, arena, out);
    return true;
}
