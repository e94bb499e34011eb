// Names and files: definitions, uses, renaming, links, the outline, and what an attribute means.
#include "lsp/markdown.h"
#include "lsp/server_private.h"

#include "core/strbuf.h"
#include "grammar/emit/explain.h"
#include "grammar/ir_formula.h"
#include "grammar/ir_values.h"
#include "grammar/ir_walk.h"

#include <string.h>

enum highlight_kind { // LSP 3.17, "Document Highlights"
    HIGHLIGHT_READ = 2,
    HIGHLIGHT_WRITE = 3,
};

enum {
    SNIPPET_BYTES = 1000, // of a definition that is shown
};

static struct located located_at(const struct request *request) {
    return locate(request->session, request->document->path, request->offset);
}

static bool name_at(const struct request *request, const struct located *at, struct located_name *name) {
    return locate_name(request->session, at, request->arena, name);
}

static json_t *location_of(const struct request *request, span at) {
    return server_location(request->server, request->session, request->arena, at);
}

static void add_location(const struct request *request, json_t *list, span at) {
    json_t *location = location_of(request, at);
    if (location)
        json_array_append_new(list, location);
}

static json_t *file_location(struct arena *arena, str path) {
    json_t *location = json_object();
    json_object_set_new(location, "uri", json_string(position_uri(arena, path).ptr));
    json_object_set_new(location, "range", position_range_once(STR(""), POSITION_UTF16, 0, 0));
    return location;
}

static bool is_path(const struct located *at) {
    return at->row && at->in_value && ir_walk_path(at->row, at->element);
}

// The file that a path in the document names; the empty string if it is not found.
static str resolve(const struct request *request, str path) {
    struct files *files = &request->session->files;
    str found;
    if (path.len == 0 || files_resolve(files, request->document->path, path, &found) != FILE_OK)
        return STR("");
    return files_canonical(files, found);
}

// The line of a mesh with its first face of a material.
static json_t *mesh_group_location(const struct request *request, const struct located *at) {
    struct session *session = request->session;
    const str *name = schema_field_const(at->row, at->element);
    for (uint32_t i = 0; i < session->assets.model_count; i++) {
        const struct ir_model *model = &session->scene->models.items[i];
        const struct mesh *mesh = session->assets.models[i].mesh;
        const uint32_t origin = ir_walk_head(at->element)->origin;
        bool is_mine = false; // the model, or a copy of it
        for (uint32_t k = 0; k < model->material_map.count; k++)
            is_mine |= model->material_map.items[k].head.origin == origin;
        for (uint32_t g = 0; is_mine && mesh && g < mesh->group_count; g++) {
            if (!str_equal(mesh->groups[g].name, *name) || mesh->groups[g].line == 0)
                continue;
            json_t *location = file_location(request->arena, files_canonical(&session->files, mesh->path));
            json_t *start = json_object_get(json_object_get(location, "range"), "start");
            json_t *end = json_object_get(json_object_get(location, "range"), "end");
            json_object_set_new(start, "line", json_integer(mesh->groups[g].line - 1));
            json_object_set_new(end, "line", json_integer(mesh->groups[g].line - 1));
            return location;
        }
    }
    return NULL;
}

json_t *server_definition(const struct request *request) {
    struct located_name name;
    struct located at = located_at(request);
    if (is_path(&at)) {
        str path = resolve(request, *(const str *)schema_field_const(at.row, at.element));
        return path.len ? file_location(request->arena, path) : NULL;
    }
    if (at.row && at.row->kind == SCHEMA_TEXT && at.row->text == SCHEMA_TEXT_FOREIGN_NAME && at.in_value)
        return mesh_group_location(request, &at);
    return name_at(request, &at, &name) ? location_of(request, name.definition) : NULL;
}

json_t *server_references(const struct request *request) {
    struct located_name name;
    struct located at = located_at(request);
    json_t *list = json_array();
    const json_t *context = json_object_get(request->params, "context");
    if (!name_at(request, &at, &name))
        return list;
    if (json_is_true(json_object_get(context, "includeDeclaration")))
        add_location(request, list, name.definition);
    for (uint32_t i = 0; i < name.uses.count; i++)
        add_location(request, list, name.uses.items[i]);
    return list;
}

// ---- renaming

// The name inside a place, without the quotes that may be around it.
static span bare(const struct session *session, span at) {
    str text = source_text(&session->sources, at);
    if (text.len >= 2 && (text.ptr[0] == '"' || text.ptr[0] == '\'') && text.ptr[text.len - 1] == text.ptr[0])
        return (span){at.source, at.begin + 1, at.end - 1};
    return at;
}

static void add_edit(const struct request *request, json_t *changes, span at, str name, const char *text) {
    const struct session *session = request->session;
    span inner = bare(session, at);
    // A name in quotes may have escapes, and in an attribute entities, but never needs them. A name that is
    // not written at its place comes through an anchor.
    bool whole = inner.begin != at.begin || ir_origin_is_xml(&session->origin, at.source);
    if (!whole && !str_equal(source_text(&session->sources, inner), name))
        return;
    json_t *location = location_of(request, inner);
    if (!location)
        return;
    const char *uri = json_string_value(json_object_get(location, "uri"));
    json_t *edits = json_object_get(changes, uri);
    json_t *edit = json_object();
    if (!edits) {
        edits = json_array();
        json_object_set_new(changes, uri, edits);
    }
    json_object_set(edit, "range", json_object_get(location, "range"));
    json_object_set_new(edit, "newText", json_string(text));
    json_array_append_new(edits, edit);
    json_decref(location);
}

// The name's places in the document.
json_t *server_highlights(const struct request *request) {
    struct located_name name;
    struct located at = located_at(request);
    const uint32_t source = locate_source(request->session, request->document->path);
    json_t *list = json_array();
    if (!name_at(request, &at, &name))
        return list;
    for (uint32_t i = 0; i <= name.uses.count; i++) {
        const span place = i < name.uses.count ? name.uses.items[i] : name.definition;
        if (place.source != source)
            continue;
        json_t *highlight = json_object();
        json_object_set_new(highlight, "range",
                            server_range(request->server, request->session, bare(request->session, place)));
        json_object_set_new(highlight, "kind",
                            json_integer(i < name.uses.count ? HIGHLIGHT_READ : HIGHLIGHT_WRITE));
        json_array_append_new(list, highlight);
    }
    return list;
}

json_t *server_prepare_rename(const struct request *request) {
    struct located_name name;
    struct located at = located_at(request);
    if (!name_at(request, &at, &name))
        return NULL;
    return server_range(request->server, request->session, bare(request->session, name.here));
}

// Names of bodies, lights and instances are unique in the scene, or in their object. *holds: the renamed one
// is there.
static bool is_taken_in(const struct schema_element *owner, const void *element,
                        const struct located_name *renamed, str name, bool *holds) {
    bool taken = false;
    for (uint32_t i = 0; i < owner->row_count; i++) {
        const struct schema_row *row = &owner->rows[i];
        const struct ir_any_list list = ir_walk_list(row, element);
        for (uint32_t k = 0; locate_has_entries(row) && k < list.count; k++) {
            const void *item = ir_walk_item(row, list, k);
            *holds |= item == renamed->element;
            taken |= str_equal(ir_walk_name(row->child, item), name);
        }
    }
    return taken;
}

static bool is_taken_by_neighbour(const struct session *session, const struct located_name *renamed,
                                  str name) {
    const struct ir_scene *scene = locate_scene(session);
    bool holds = false;
    bool taken = is_taken_in(&SCHEMA_SCENE, scene, renamed, name, &holds);
    for (uint32_t i = 0; i < scene->objects.count && !holds; i++)
        taken = is_taken_in(&SCHEMA_OBJECT, &scene->objects.items[i], renamed, name, &holds);
    return holds && taken;
}

// Whether something else of the same kind has the name.
static bool is_taken(const struct session *session, const struct located_name *renamed, str name) {
    const struct schema_element *schema = renamed->schema;
    if (schema_key_row(schema) < 0)
        return is_taken_by_neighbour(session, renamed, name);
    const struct schema_row *pool = ir_walk_pool(schema);
    if (!pool || locate_is_argument(schema, &renamed->scope)) // which may hide a parameter of the scene
        return false;
    struct ir_any_list list = ir_walk_list(pool, locate_scene(session));
    for (uint32_t i = 0; i < list.count; i++)
        if (str_equal(ir_walk_key(schema, ir_walk_item(pool, list, i)), name))
            return true;
    return false;
}

// Why something in expressions cannot have the name; NULL: it can.
static const char *refusal_of_word(const struct request *request, const struct located_name *name,
                                   const char *text) {
    if (name->schema != &SCHEMA_PARAMETER && name->schema != &SCHEMA_VARIABLE)
        return NULL;
    if (!expression_is_free(str_from(text)))
        return name->schema == &SCHEMA_PARAMETER
                   ? "a parameter's name has letters, digits and '_', and is not a word of expressions"
                   : "a variable's name has letters, digits and '_', and is not a word of expressions";
    return locate_word_conflict(request->session, request->arena, name, str_from(text));
}

json_t *server_rename(const struct request *request) {
    struct located_name name;
    const char *text = json_string_value(json_object_get(request->params, "newName"));
    if (!text || !str_is_name(str_from(text))) {
        request->server->refusal = "a name has letters, digits, '_' and '-', and does not begin with a digit";
        return NULL;
    }
    struct located at = located_at(request);
    if (!name_at(request, &at, &name))
        return NULL;
    request->server->refusal = refusal_of_word(request, &name, text);
    if (request->server->refusal)
        return NULL;
    if (!str_equal(str_from(text), name.name) && is_taken(request->session, &name, str_from(text))) {
        request->server->refusal = "another one already has this name";
        return NULL;
    }
    json_t *edit = json_object();
    json_t *changes = json_object();
    add_edit(request, changes, name.definition, name.name, text);
    for (uint32_t i = 0; i < name.uses.count; i++)
        add_edit(request, changes, name.uses.items[i], name.name, text);
    json_object_set_new(edit, "changes", changes);
    return edit;
}

// ---- hover

static void add_parameter(const struct ir_scene *scene, const struct ir_parameter *parameter,
                          struct strbuf *out) {
    const struct ir_result *results = scene->formulas->results;
    const ptrdiff_t index = parameter - scene->parameters.items;
    if (!results || !results[index].is_known)
        return;
    strbuf_cstr(out, " = ");
    expression_print(results[index].type, results[index].value, out);
    strbuf_char(out, ',');
}

// Appends `before` and the number of copies; a mistake may be why there are none.
static void add_copies(const struct request *request, const struct located_scope *scope, const char *before,
                       struct strbuf *out) {
    const uint32_t copies = locate_copies(request->session, scope);
    if (copies || !request->session->sink.errors)
        strbuf_format(out, copies == 1 ? "%s%u copy" : "%s%u copies", before, copies);
}

static void add_variable(const struct request *request, const struct located_name *name, struct strbuf *out) {
    struct strbuf values;
    strbuf_init(&values);
    locate_print_variable(request->session, &name->scope, name->element, &values);
    if (values.len)
        strbuf_format(out, " = %.*s,", STR_ARG(strbuf_view(&values)));
    strbuf_finish(&values);
}

// The own value of a parameter of an object, as written.
static str own_value(const struct request *request, const struct ir_parameter *parameter) {
    const bool is_many = ir_values_count(parameter->value) > 1;
    return arena_format(request->arena, is_many ? "[%.*s]" : "%.*s", STR_ARG(parameter->value));
}

// Whether what was printed of a value in instances is the value that is written.
static bool is_value(str printed, str own) {
    return str_starts_with(printed, own) &&
           (printed.len == own.len || str_starts_with(str_slice(printed, own.len, printed.len), STR(" in ")));
}

static void add_given(const struct request *request, const struct located_name *name, struct strbuf *out) {
    struct strbuf values;
    strbuf_init(&values);
    if (locate_print_argument(request->session, &name->scope, name->element, request->arena, &values) &&
        !is_value(strbuf_view(&values), own_value(request, name->element)))
        strbuf_format(out, ", %.*s", STR_ARG(strbuf_view(&values)));
    strbuf_finish(&values);
}

// ", with 1 light, 3 boxes; 12 instances show it"
static void add_object(const struct request *request, const struct ir_object *object, struct strbuf *out) {
    const char *before = ", with";
    for (uint32_t i = 0; i < SCHEMA_OBJECT.row_count; i++) {
        const struct schema_row *row = &SCHEMA_OBJECT.rows[i];
        const uint32_t count = ir_walk_list(row, object).count;
        if (count == 0)
            continue;
        strbuf_format(out, "%s %u %s", before, count, count == 1 ? row->child->name : schema_yaml_key(row));
        before = ",";
    }
    const uint32_t shown = locate_instances(request->session, object, request->arena);
    if (shown || !request->session->sink.errors)
        strbuf_format(out, shown == 1 ? "; %u instance shows it" : "; %u instances show it", shown);
}

static void add_definition(const struct request *request, const struct located *at, struct strbuf *out) {
    struct session *session = request->session;
    struct located_name name;
    if (!name_at(request, at, &name))
        return;
    const bool is_variable = name.schema == &SCHEMA_VARIABLE, is_parameter = name.schema == &SCHEMA_PARAMETER;
    const bool is_argument = locate_is_argument(name.schema, &name.scope),
               is_object = name.schema == &SCHEMA_OBJECT;
    if (!at->in_value && !is_variable && !is_parameter && !is_object) // it is there
        return;
    str text = source_text(&session->sources, name.definition);
    // The whole element, from the place of its name.
    const struct ir_head *head = ir_walk_head(name.element);
    if (head->origin < session->origin.elements.count)
        text = source_text(&session->sources, span_join(session->origin.elements.items[head->origin].label,
                                                        session->origin.elements.items[head->origin].at));
    text = position_clip(text, SNIPPET_BYTES);
    struct source_place where = source_locate(&session->sources, name.definition);
    strbuf_format(out, "%s '%.*s'", name.schema->name, STR_ARG(name.name));
    if (is_argument)
        strbuf_format(out, " = %.*s,", STR_ARG(own_value(request, name.element)));
    else if (is_parameter)
        add_parameter(locate_scene(session), name.element, out);
    if (is_variable)
        add_variable(request, &name, out);
    strbuf_format(out, " of %.*s:%u", STR_ARG(path_base(where.path)), where.line);
    if (is_variable)
        add_copies(request, &name.scope, ", which makes ", out);
    if (is_argument)
        add_given(request, &name, out);
    if (is_object)
        add_object(request, name.element, out);
    strbuf_cstr(out, "\n\n");
    if (request->server->has_markdown)
        markdown_code(text, ir_origin_is_xml(&session->origin, name.definition.source) ? "xml" : "yaml", out);
    else
        strbuf_format(out, "%.*s\n", STR_ARG(text));
    strbuf_char(out, '\n');
}

// Appends what the value of something with a name comes to: of a variable, of a parameter of an object, of
// `with`.
static bool print_named(const struct request *request, const struct located *at,
                        const struct located_scope *scope, struct strbuf *out) {
    const struct session *session = request->session;
    if (at->row->key)
        return false;
    if (at->schema == &SCHEMA_VARIABLE)
        locate_print_variable(session, scope, at->element, out);
    else if (at->schema == &SCHEMA_WITH)
        return locate_print_given(session, scope, at->element, request->arena, out);
    else if (locate_is_argument(at->schema, scope) && schema_has_values(at->row))
        return locate_print_argument(session, scope, at->element, request->arena, out);
    return out->len > 0;
}

// What an expression has come to, and what `for` and `if` have.
static void add_value(const struct request *request, const struct located *at, struct strbuf *out) {
    struct strbuf value;
    const struct located_scope scope = locate_scope(request->session, at->element, request->arena);
    strbuf_init(&value);
    if (locate_is_of_copies(at->row)) {
        add_copies(request, &scope, "makes ", out);
        strbuf_cstr(out, "\n\n");
    } else if (print_named(request, at, &scope, &value)) {
        strbuf_format(out, "%.*s = %.*s\n\n", STR_ARG(ir_walk_key(at->schema, at->element)),
                      STR_ARG(strbuf_view(&value)));
    } else if (locate_print_value(request->session, at, request->arena, &value)) {
        strbuf_format(out, "%.*s\n\n", STR_ARG(strbuf_view(&value)));
    }
    strbuf_finish(&value);
}

static void add_explanation(str what, bool markdown, struct strbuf *out) {
    struct strbuf text;
    strbuf_init(&text);
    explain(what, false, markdown ? &text : out);
    if (markdown)
        markdown_explanation(strbuf_view(&text), out);
    strbuf_finish(&text);
}

json_t *server_hover(const struct request *request) {
    struct located at = located_at(request);
    if (!at.schema)
        return NULL;
    struct strbuf text;
    strbuf_init(&text);
    add_definition(request, &at, &text);
    if (at.row)
        add_value(request, &at, &text);
    str what = at.row ? arena_format(request->arena, "%s.%s", at.schema->name, at.row->name)
                      : str_from(at.schema->name);
    add_explanation(what, request->server->has_markdown, &text);
    json_t *hover = json_object();
    json_t *contents = json_object();
    json_object_set_new(contents, "kind",
                        json_string(request->server->has_markdown ? "markdown" : "plaintext"));
    json_object_set_new(contents, "value", position_string(strbuf_view(&text)));
    json_object_set_new(hover, "contents", contents);
    json_object_set_new(hover, "range", server_range(request->server, request->session, at.at));
    strbuf_finish(&text);
    return hover;
}

// ---- the outline

enum symbol_kind { // LSP 3.17, "Document Symbols"
    SYMBOL_FIELD = 8,
    SYMBOL_OBJECT = 19,
};

static bool stands_in(const struct session *session, const void *element, uint32_t source, span *at,
                      span *label) {
    const struct ir_head *head = ir_walk_head(element);
    if (head->origin == 0 || head->origin >= session->origin.elements.count)
        return false;
    const struct ir_element_origin *origin = &session->origin.elements.items[head->origin];
    *at = span_is_none(origin->at) ? origin->label : origin->at;
    *label = span_is_none(origin->label) ? *at : origin->label;
    if (label->source == at->source)
        *at = span_join(label->begin < at->begin ? *label : *at, label->end > at->end ? *label : *at);
    return at->source == source && label->source == source;
}

static str symbol_name(struct arena *arena, const struct schema_element *schema, const void *element,
                       int index) {
    str key = ir_walk_key(schema, element);
    if (key.len)
        return key;
    // List entries differ by the file or object that they name, else by their place in the list.
    for (uint32_t i = 0; i < schema->row_count; i++) {
        if (schema->rows[i].kind == SCHEMA_REFERENCE && schema->rows[i].child == &SCHEMA_OBJECT) {
            const struct ir_reference *object = schema_field_const(&schema->rows[i], element);
            if (object->name.len)
                return arena_format(arena, "%s %.*s", schema->name, STR_ARG(object->name));
        }
        const str *text = ir_walk_path(&schema->rows[i], element);
        if (text && text->len)
            return arena_format(arena, "%s %.*s", schema->name, STR_ARG(path_base(*text)));
    }
    return index < 0 ? str_from(schema->name) : arena_format(arena, "%s %d", schema->name, index + 1);
}

struct outline {
    const struct request *request;
    uint32_t source;
};

static void add_symbol(struct outline *outline, json_t *list, const struct schema_element *schema,
                       const void *element, int index);

static void add_symbols(struct outline *outline, json_t *list, const struct schema_element *schema,
                        const void *element) {
    const struct ir_scene *scene = locate_scene(outline->request->session);
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        struct ir_any_list items = ir_walk_list(row, element);
        if (row->kind == SCHEMA_ELEMENT && ir_walk_written(schema, i, element))
            add_symbol(outline, list, row->child, schema_field_const(row, element), -1);
        if (row->child == &SCHEMA_OBJECT && row->kind == SCHEMA_REFERENCE &&
            ir_walk_is_inline(scene, row, schema_field_const(row, element)))
            add_symbol(outline, list, row->child,
                       ir_walk_referent(scene, row, schema_field_const(row, element)), -1);
        for (uint32_t k = 0; k < items.count; k++) {
            const void *item = ir_walk_item(row, items, k);
            if (!ir_walk_is_anonymous(row->child, item))
                add_symbol(outline, list, row->child, item, (int)k);
        }
    }
}

static void add_symbol(struct outline *outline, json_t *list, const struct schema_element *schema,
                       const void *element, int index) {
    const struct request *request = outline->request;
    span at;
    span label;
    if (!stands_in(request->session, element, outline->source, &at, &label))
        return;
    str name = symbol_name(request->arena, schema, element, index);
    json_t *symbol = json_object();
    json_t *children = json_array();
    json_object_set_new(symbol, "name", position_string(name));
    json_object_set_new(symbol, "detail", json_string(schema->element));
    json_object_set_new(symbol, "kind", json_integer(index < 0 ? SYMBOL_FIELD : SYMBOL_OBJECT));
    json_object_set_new(symbol, "range", server_range(request->server, request->session, at));
    json_object_set_new(symbol, "selectionRange", server_range(request->server, request->session, label));
    add_symbols(outline, children, schema, element);
    json_object_set_new(symbol, "children", children);
    json_array_append_new(list, symbol);
}

json_t *server_symbols(const struct request *request) {
    json_t *list = json_array();
    struct outline outline = {request, locate_source(request->session, request->document->path)};
    add_symbols(&outline, list, &SCHEMA_SCENE, locate_scene(request->session));
    return list;
}

// ---- links

struct linking {
    const struct request *request;
    uint32_t source;
    json_t *list;
};

static void add_link(void *context, const struct schema_element *schema, void *element,
                     const struct schema_row *row, str *path) {
    struct linking *linking = context;
    const struct request *request = linking->request;
    struct session *session = request->session;
    span at = ir_place_value(&session->origin, ir_walk_head(element), schema, row->name);
    if (at.source != linking->source)
        return;
    str target = resolve(request, *path);
    if (target.len == 0)
        return;
    json_t *link = json_object();
    json_object_set_new(link, "range", server_range(request->server, session, bare(session, at)));
    json_object_set_new(link, "target", json_string(position_uri(request->arena, target).ptr));
    json_array_append_new(linking->list, link);
}

json_t *server_links(const struct request *request) {
    const struct session *session = request->session;
    uint32_t source = locate_source(request->session, request->document->path);
    struct linking linking = {request, source, json_array()};
    for (uint32_t i = 0; i < session->origin.files.count; i++)
        if (session->origin.files.items[i].source == source && session->origin.files.items[i].scene)
            ir_walk_paths(session->origin.files.items[i].scene, add_link, &linking);
    return linking.list;
}
