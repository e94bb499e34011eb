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
    locate_walk(&SCHEMA_SCENE, locate_scene(session), search_element, &search);
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

static void add_use(struct arena *arena, struct located_name *name, span at) {
    for (uint32_t i = 0; i < name->uses.count; i++)
        if (span_equal(name->uses.items[i], at))
            return;
    *ARENA_PUSH(arena, &name->uses) = at;
}

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
            ir_walk_referent(locate_scene(users->session), row, reference) != users->referent)
            continue;
        const struct ir_row_origin *place = ir_origin_row(&users->session->origin, ir_walk_head(element), i);
        if (place)
            add_use(users->arena, users->out, place->value);
    }
}

static void note_named(void *context, const struct schema_element *schema, const void *element, span at) {
    struct users *users = context;
    (void)schema;
    if (element == users->referent)
        add_use(users->arena, users->out, at);
}

struct here {
    const struct located *at;
    struct located_name *out;
};

static void find_named(void *context, const struct schema_element *schema, const void *element, span at) {
    struct here *here = context;
    if (at.source != here->at->at.source || here->at->offset < at.begin || here->at->offset > at.end)
        return;
    here->out->schema = schema;
    here->out->element = element;
    here->out->here = at;
}

bool locate_name(struct session *session, const struct located *at, struct arena *arena,
                 struct located_name *out) {
    const struct ir_scene *scene = locate_scene(session);
    *out = (struct located_name){0};
    if (!at->schema || !scene)
        return false;
    struct here here = {at, out};
    locate_named(session, find_named, &here);
    const bool is_within = out->element != NULL; // other text
    const bool is_word = !is_within && locate_word(session, at, arena, out);
    if (!is_within && !is_word) {
        out->schema = at->schema;
        out->element = at->element;
        out->here = at->at;
        if (at->row && at->row->kind == SCHEMA_REFERENCE && at->in_value) {
            out->schema = at->row->child;
            out->element = ir_walk_referent(scene, at->row, schema_field_const(at->row, at->element));
        } else if (!span_equal(at->at, locate_name_place(session, at->schema, at->element))) {
            return false;
        }
    }
    out->name = out->element ? ir_walk_name(out->schema, out->element) : STR("");
    if (out->name.len == 0)
        return false;
    out->definition = locate_name_place(session, out->schema, out->element);
    if ((out->schema == &SCHEMA_VARIABLE || out->schema == &SCHEMA_PARAMETER) && !is_word) {
        out->scope = locate_scope(session, out->element, arena);
        out->scope.reach = UINT32_MAX;
    }
    struct users users = {session, arena, out->element, out};
    locate_walk(&SCHEMA_SCENE, scene, note_users, &users);
    locate_named(session, note_named, &users);
    if (out->schema == &SCHEMA_PARAMETER || out->schema == &SCHEMA_VARIABLE)
        locate_word_uses(session, arena, out);
    return true;
}
