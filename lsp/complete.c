// Completion: attributes where a name is typed; words, names and files where a value is.
#include "lsp/context.h"
#include "lsp/server_private.h"

#include "core/expression.h"
#include "core/heap.h"
#include "core/number.h"
#include "core/strbuf.h"
#include "files/files_walk.h"
#include "grammar/emit/emit_words.h"
#include "grammar/ir_values.h"
#include "grammar/ir_walk.h"
#include "parser/tree/reader.h"

#include <string.h>

enum {
    FILES_MOST = 500, // names offered for a path
};

// The word before the place and the key before that: `material: gl|`, `material="gl|`.
struct typed {
    str key, word;
    size_t begin; // of the word, in the text
};

static bool is_word(char c) {
    return c != ' ' && c != '\t' && c != '\n' && c != '\r' && !strchr("\"'[]{},=:<>", c);
}

// Whether the '=' before a place is of ==, !=, <= or >=, also of &lt;=.
static bool is_compared(str text, size_t at) {
    return (at >= 2 && strchr("=!<>;", text.ptr[at - 2])) || (at < text.len && text.ptr[at] == '=');
}

static struct typed typed_at(str text, size_t offset) {
    struct typed typed = {0};
    size_t at = offset;
    while (at > 0 && is_word(text.ptr[at - 1]))
        at--;
    typed.begin = at;
    typed.word = str_slice(text, at, offset);
    while (at > 0 && text.ptr[at - 1] != '\n' && strchr(" \t\"'[", text.ptr[at - 1]))
        at--;
    if (at == 0 || (text.ptr[at - 1] != ':' && text.ptr[at - 1] != '=') ||
        (text.ptr[at - 1] == '=' && is_compared(text, at)))
        return typed;
    size_t end = at - 1;
    while (end > 0 && (text.ptr[end - 1] == ' ' || text.ptr[end - 1] == '"'))
        end--;
    at = end;
    while (at > 0 && is_word(text.ptr[at - 1]))
        at--;
    typed.key = str_slice(text, at, end);
    return typed;
}

// The key of a value that has an operator, a comma in brackets or another word before the typed one: nothing
// may end the value between them. Empty: there is none.
static str key_of_value(str text, size_t place, bool is_xml) {
    size_t at = place;
    bool has_comma = false; // outside of brackets that end before the place
    int depth = 0;
    for (; at > 0 && !strchr(is_xml ? "\n\r{}<" : "\n\r{}", text.ptr[at - 1]); at--) {
        const char c = text.ptr[at - 1];
        const bool is_colon = c == ':' && at < text.len && text.ptr[at] == ' ';
        if (c == ']' || c == ')')
            depth++;
        else if ((c == '[' || c == '(') && depth > 0)
            depth--;
        else if (c == '[' || c == '(')
            has_comma = false; // it was between items, or arguments
        has_comma |= c == ',' && depth == 0;
        if (!is_colon && c != '=')
            continue;
        size_t begin = at - 1;
        while (begin > 0 && is_word(text.ptr[begin - 1]))
            begin--;
        const bool is_quoted = c == '=' && at < text.len && strchr("\"'", text.ptr[at]);
        if (is_quoted && memchr(text.ptr + at + 1, text.ptr[at], place - at - 1))
            return STR(""); // it ends before the place
        if (c != '=' || (at - begin > 1 && !is_compared(text, at)))
            return has_comma && !is_quoted ? STR("") : str_slice(text, begin, at - 1);
    }
    return STR("");
}

struct completing {
    const struct request *request;
    struct typed typed;
    json_t *range;  // of the word
    json_t *known;  // labels that were offered
    bool has_value; // a key is typed whose value is there already
    str detail;     // of what is offered; empty: it has none
    json_t *items;
};

enum completion_kind { // LSP 3.17, "Completion Request"
    COMPLETION_FUNCTION = 3,
    COMPLETION_VARIABLE = 6,
    COMPLETION_PROPERTY = 10,
    COMPLETION_FILE = 17,
    COMPLETION_REFERENCE = 18,
    COMPLETION_FOLDER = 19,
    COMPLETION_ENUM_MEMBER = 20,
};

// Offers a text to replace the word; NULL: it was offered before.
static json_t *offer_text(struct completing *c, str label, enum completion_kind kind, const char *doc,
                          str text) {
    json_t *name = position_string(label);
    if (json_object_get(c->known, json_string_value(name))) {
        json_decref(name);
        return NULL;
    }
    json_object_set_new(c->known, json_string_value(name), json_true());
    json_t *item = json_object();
    json_t *edit = json_object();
    json_object_set_new(item, "label", name);
    json_object_set_new(item, "kind", json_integer(kind));
    if (c->detail.len)
        json_object_set_new(item, "detail", position_string(c->detail));
    if (doc)
        json_object_set_new(item, "documentation", json_string(doc));
    json_object_set(edit, "range", c->range);
    json_object_set_new(edit, "newText", position_string(text));
    json_object_set_new(item, "textEdit", edit);
    json_array_append_new(c->items, item);
    return item;
}

static void offer(struct completing *c, str label, enum completion_kind kind, const char *doc) {
    offer_text(c, label, kind, doc, label);
}

static void offer_names(struct completing *c, const struct schema_element *target) {
    const struct schema_row *pool = ir_walk_pool(target);
    const struct ir_scene *scene = locate_scene(c->request->session);
    size_t index;
    const json_t *name_before;
    json_array_foreach(json_object_get(c->request->scene->names, target->name), index, name_before)
        offer(c, str_from(json_string_value(name_before)), COMPLETION_REFERENCE, target->doc);
    if (!pool || !scene)
        return;
    struct ir_any_list list = ir_walk_list(pool, scene);
    for (uint32_t i = 0; i < list.count; i++) {
        str name = ir_walk_key(target, ir_walk_item(pool, list, i));
        if (name.len)
            offer(c, name, COMPLETION_REFERENCE, target->doc);
    }
}

// Offers files and folders at the path typed so far, relative to the document's folder.
static void offer_files(struct completing *c, enum schema_file kind) {
    struct arena *arena = c->request->arena;
    str typed = c->typed.word;
    str base = path_base(typed);
    str stem = str_slice(typed, 0, typed.len - base.len);
    str folder =
        arena_format(arena, "%.*s/%.*s", STR_ARG(path_folder(c->request->document->path)), STR_ARG(stem));
    struct files_names names = {0};
    files_list_folder(arena, folder, &names);
    for (uint32_t i = 0; i < names.count && i < FILES_MOST; i++) {
        str name = names.items[i];
        str path = arena_format(arena, "%.*s%.*s", STR_ARG(folder), STR_ARG(name));
        str label = arena_format(arena, "%.*s%.*s", STR_ARG(stem), STR_ARG(name));
        if (files_is_folder(path))
            offer(c, arena_format(arena, "%.*s/", STR_ARG(label)), COMPLETION_FOLDER, NULL);
        else if (schema_file_fits(kind, name))
            offer(c, label, COMPLETION_FILE, NULL);
    }
}

enum {
    INSERT_SNIPPET = 2, // LSP 3.17, "InsertTextFormat"
};

static void offer_insert(struct completing *c, str label, const char *doc, str plain, str snippet,
                         enum completion_kind kind) {
    bool snippets = c->request->server->has_snippets;
    json_t *item = offer_text(c, label, kind, doc, snippets ? snippet : plain);
    if (item && snippets)
        json_object_set_new(item, "insertTextFormat", json_integer(INSERT_SNIPPET));
}

// ---- expressions

static bool may_compute(const struct schema_row *row, str key) {
    const char *const *names = schema_components(row->kind);
    const int inner = row->kind == SCHEMA_ELEMENT ? schema_short_row(row->child) : -1;
    if (inner >= 0 && schema_may_compute(&row->child->rows[inner])) // diffuse_color: [...]
        return str_equal_cstr(key, row->name);
    if (!schema_has_values(row) && !schema_may_compute(row))
        return false;
    if (str_equal_cstr(key, row->name) || (row->plural && str_equal_cstr(key, row->plural)))
        return true;
    for (int i = 0; names[i]; i++)
        if (str_equal_cstr(key, names[i]))
            return true;
    return false;
}

static bool is_of_expression(str key) {
    for (uint32_t e = 0; key.len && schema_elements[e]; e++)
        for (uint32_t i = 0; i < schema_elements[e]->row_count; i++)
            if (may_compute(&schema_elements[e]->rows[i], key))
                return true;
    return false;
}

// "0 to 11", "0 to rows - 1", "one of 2 values".
static str detail_of(struct arena *arena, const struct context_variable *variable) {
    double number;
    if (variable->value.len == 0)
        return STR("");
    if (variable->is_parameter)
        return arena_format(arena, variable->is_list ? "[%.*s]" : "%.*s", STR_ARG(variable->value));
    if (variable->is_list) {
        const uint32_t count = ir_values_count(variable->value);
        return count == 1 ? STR("one value") : arena_format(arena, "one of %u values", count);
    }
    if (number_parse(variable->value, &number) != NUMBER_OK)
        return arena_format(arena, "from 0, less than %.*s", STR_ARG(variable->value));
    return number < 1   ? STR("no value")
           : number < 2 ? STR("0")
                        : arena_format(arena, "0 to %.0f", number - 1);
}

// Whether it is the value of something whose key is a name: of a parameter, of a variable.
static bool is_of_named(const struct request *request, str text, str key) {
    if (key.len == 0)
        return false;
    const struct schema_element *named =
        context_at(request->document->path, text, (size_t)(key.ptr - text.ptr)).named;
    for (uint32_t i = 0; named && i < named->row_count; i++)
        if (named->rows[i].short_form &&
            (schema_has_values(&named->rows[i]) || schema_may_compute(&named->rows[i])))
            return true;
    return false;
}

// The variable or parameter that is being typed.
struct typed_name {
    const struct schema_element *schema;
    const char *begin; // of its text; NULL: none is typed
};

static struct typed_name typed_name(const struct completing *c, str text) {
    const char *at = c->typed.key.ptr;
    const struct context context =
        context_at(c->request->document->path, text, at ? (size_t)(at - text.ptr) : c->typed.begin);
    const struct schema_element *schema = context.named ? context.named : context.schema;
    if (schema != &SCHEMA_VARIABLE && schema != &SCHEMA_PARAMETER)
        return (struct typed_name){NULL, NULL};
    for (; context.is_xml && at > text.ptr && *at != '<'; at--)
        ;
    return (struct typed_name){schema, at};
}

// Whether it is known where another is typed: in what makes a variable, those of its entry that are before
// it.
static bool is_in_reach(const struct context_variable *v, struct typed_name typed) {
    if (!typed.begin || v->is_parameter != (typed.schema == &SCHEMA_PARAMETER) || v->is_around)
        return true;
    if (!v->is_parameter || v->name.ptr <= typed.begin)
        return v->name.ptr < typed.begin;
    return *typed.begin != '<' || memchr(typed.begin + 1, '<', (size_t)(v->name.ptr - typed.begin));
}

// Those of the entry, and of what is around it.
static void offer_variables(struct completing *c) {
    struct arena *arena = c->request->arena;
    struct context_variable variables[CONTEXT_VARIABLES_MOST];
    const str text = document_text(c->request->document);
    const uint32_t count = context_variables(c->request->document->path, text, c->typed.begin, variables);
    const struct typed_name typed = typed_name(c, text);
    for (uint32_t i = 0; i < count; i++) {
        const struct context_variable *v = &variables[i];
        const char *doc = v->is_parameter ? SCHEMA_PARAMETER.doc : SCHEMA_VARIABLE.doc;
        c->detail = detail_of(arena, v);
        if (is_in_reach(v, typed))
            offer(c, v->name, COMPLETION_VARIABLE, doc);
    }
    c->detail = STR("");
}

// Variables, parameters and the language's own words, in the place of the name that is typed.
static void offer_expression(struct completing *c) {
    const struct ir_scene *scene = locate_scene(c->request->session);
    const json_t *name;
    size_t index;
    offer_variables(c);
    json_array_foreach(json_object_get(c->request->scene->names, SCHEMA_PARAMETER.name), index, name)
        offer(c, str_from(json_string_value(name)), COMPLETION_VARIABLE, SCHEMA_PARAMETER.doc);
    for (uint32_t i = 0; scene && i < scene->parameters.count; i++)
        if (scene->parameters.items[i].name.len)
            offer(c, scene->parameters.items[i].name, COMPLETION_VARIABLE, SCHEMA_PARAMETER.doc);
    for (const struct expression_word *own = expression_words(); own->name; own++)
        offer_insert(c, str_from(own->name), own->doc, str_from(own->name),
                     own->is_function ? arena_format(c->request->arena, "%s($0)", own->name)
                                      : str_from(own->name),
                     own->is_function ? COMPLETION_FUNCTION : COMPLETION_VARIABLE);
}

// The text is seldom complete while the user types: every attribute with the key's name counts.
static void offer_for(struct completing *c, const struct schema_row *row) {
    if (!str_equal_cstr(c->typed.key, row->name) &&
        !(row->plural && str_equal_cstr(c->typed.key, row->plural)))
        return;
    if (row->kind == SCHEMA_REFERENCE)
        offer_names(c, row->child);
    if (row->kind == SCHEMA_WORD)
        for (uint32_t i = 0; row->words[i]; i++)
            offer(c, str_from(row->words[i]), COMPLETION_ENUM_MEMBER,
                  row->word_docs ? row->word_docs[i] : NULL);
    if (row->kind == SCHEMA_BOOLEAN) {
        offer(c, STR("true"), COMPLETION_ENUM_MEMBER, row->doc);
        offer(c, STR("false"), COMPLETION_ENUM_MEMBER, row->doc);
    }
    if (row->file != SCHEMA_FILE_NONE)
        offer_files(c, row->file);
    if (row->kind == SCHEMA_LIST && schema_short_row(row->child) >= 0) {
        const struct schema_row *inner = &row->child->rows[schema_short_row(row->child)];
        if (inner->file != SCHEMA_FILE_NONE)
            offer_files(c, inner->file);
    }
}

// ---- attributes

// A snippet gives '$', '}' and a backslash a meaning.
static str escaped(struct arena *arena, str text) {
    char *out = arena_alloc(arena, heap_times(2, text.len) + 1);
    size_t length = 0;
    for (size_t i = 0; i < text.len; i++) {
        if (strchr("$}\\", text.ptr[i]))
            out[length++] = '\\';
        out[length++] = text.ptr[i];
    }
    return (str){out, length};
}

// The example in the table, as the file's spelling has it: "albedo: [0, 0.5, 0.1, 0.8]".
static str sample_of(struct completing *c, const struct context *context, uint32_t row) {
    struct strbuf sample;
    strbuf_init(&sample);
    if (context->is_xml)
        emit_xml_sample(context->schema, row, &sample);
    else
        emit_yaml_sample(context->schema, row, &sample);
    str text = arena_copy(c->request->arena, str_trim(strbuf_view(&sample)));
    strbuf_finish(&sample);
    return text;
}

// A first entry of a map whose entries can be short: "i: 5". Empty: it is another map.
static str entry_of(struct completing *c, const struct schema_row *row) {
    const struct schema_row *key = NULL, *value = NULL;
    for (uint32_t i = 0; row->many == SCHEMA_NAMED_MAP && i < row->child->row_count; i++) {
        const struct schema_row *of_child = &row->child->rows[i];
        key = of_child->key ? of_child : key;
        value = !value && of_child->short_form ? of_child : value;
    }
    return key && value ? arena_format(c->request->arena, "${1:%s: %s}", key->example, value->example)
                        : STR("");
}

// What follows the name, with the place of the cursor; nothing if it is written already.
static str value_of(struct completing *c, const struct context *context, uint32_t row, bool single) {
    struct arena *arena = c->request->arena;
    const struct schema_row *r = &context->schema->rows[row];
    str sample = sample_of(c, context, row);
    char mark = context->is_xml ? '=' : ':';
    const char *at = memchr(sample.ptr, mark, sample.len);
    bool many = r->many != SCHEMA_ONE && !single;
    bool element = (r->kind == SCHEMA_ELEMENT && schema_short_row(r->child) < 0) || (r->single && single);
    const str entry = single ? STR("") : entry_of(c, r);
    if (!context->is_xml && entry.len)
        return arena_format(arena,
                            context->is_flow || context->schema != &SCHEMA_SCENE ? ": {%.*s}" : ":\n  %.*s",
                            STR_ARG(entry));
    if (!context->is_xml && (many || element)) {
        if (context->is_flow)
            return many && r->many == SCHEMA_SEQUENCE ? STR(": [{$0}]") : STR(": {$0}");
        return many && r->many == SCHEMA_SEQUENCE ? STR(":\n  - $0") : STR(":\n  $0");
    }
    if (!at)
        return context->is_xml ? STR("=\"$0\"") : STR(": $0");
    str value = str_trim(str_slice(sample, (size_t)(at - sample.ptr) + 1, sample.len));
    if (context->is_xml)
        value = str_slice(value, 1, value.len - 1);
    if (r->kind == SCHEMA_BOOLEAN && r->example && expression_is_meant(str_from(r->example)))
        value = str_from(r->example);
    if (context->is_xml)
        return arena_format(arena, "=\"${1:%.*s}\"", STR_ARG(escaped(arena, value)));
    return arena_format(arena, ": ${1:%.*s}", STR_ARG(escaped(arena, value)));
}

static void offer_key(struct completing *c, const struct context *context, uint32_t row, const char *name,
                      bool single) {
    struct arena *arena = c->request->arena;
    const char *doc = context->schema->rows[row].doc;
    if (!name)
        return;
    if (c->has_value) {
        offer(c, str_from(name), COMPLETION_PROPERTY, doc);
        return;
    }
    str plain = arena_format(arena, context->is_xml ? "%s=\"\"" : "%s: ", name);
    str snippet = arena_format(arena, "%s%.*s", name, STR_ARG(value_of(c, context, row, single)));
    offer_insert(c, str_from(name), doc, plain, snippet, COMPLETION_PROPERTY);
}

// After '<': the whole element, as the example has it.
static void offer_child(struct completing *c, const struct context *context, uint32_t row) {
    const struct schema_row *r = &context->schema->rows[row];
    str sample = sample_of(c, context, row);
    if (!r->element)
        return;
    str whole = sample.len && sample.ptr[0] == '<'
                    ? escaped(c->request->arena, str_slice(sample, 1, sample.len))
                    : str_from(r->element);
    offer_insert(c, str_from(r->element), r->doc, str_from(r->element), whole, COMPLETION_PROPERTY);
}

static void offer_rows(struct completing *c, const struct context *context) {
    for (uint32_t i = 0; context->schema && i < context->schema->row_count; i++) {
        const struct schema_row *row = &context->schema->rows[i];
        if (context->is_xml && context->in_children)
            offer_child(c, context, i);
        else if (context->is_xml && schema_is_attribute(row))
            offer_key(c, context, i, row->name, false);
        else if (!context->is_xml && !row->key) {
            offer_key(c, context, i, schema_yaml_key(row), false);
            offer_key(c, context, i, row->single ? row->name : NULL, true);
        }
    }
}

// The parameters of the object that the instance shows, without those that it gives a value.
static void offer_arguments(struct completing *c, const struct context *context) {
    const str text = document_text(c->request->document);
    struct context_given *given = ARENA_NEW(c->request->arena, struct context_given);
    context_given(c->request->document->path, text, c->typed.begin, given);
    const str object = arena_copy(c->request->arena, given->object);
    size_t index;
    const json_t *argument;
    json_array_foreach(json_object_get(c->request->scene->arguments, object.ptr), index, argument) {
        const char *name = json_string_value(json_object_get(argument, "name"));
        const char *value = json_string_value(json_object_get(argument, "value"));
        const char *doc = json_string_value(json_object_get(argument, "doc"));
        const str mended = escaped(c->request->arena, str_from(value));
        bool is_given = false;
        for (uint32_t i = 0; i < given->count; i++)
            is_given |= str_equal_cstr(given->names[i], name);
        if (is_given || !*name)
            continue;
        c->detail = str_from(value);
        if (context->is_xml || c->has_value)
            offer(c, str_from(name), COMPLETION_VARIABLE, *doc ? doc : SCHEMA_PARAMETER.doc);
        else
            offer_insert(c, str_from(name), *doc ? doc : SCHEMA_PARAMETER.doc,
                         arena_format(c->request->arena, "%s: ", name),
                         arena_format(c->request->arena, "%s: ${1:%.*s}", name, STR_ARG(mended)),
                         COMPLETION_VARIABLE);
    }
    c->detail = STR("");
}

// Whether the name is followed by its value already.
static bool is_followed(str text, size_t at, bool is_xml) {
    while (at < text.len && (is_word(text.ptr[at]) || text.ptr[at] == ' '))
        at++;
    return at < text.len && text.ptr[at] == (is_xml ? '=' : ':');
}

// Whether the place is in a value that may be an expression; then only the name before it is the word.
static bool in_expression_at(const struct request *request, str text, size_t offset, struct typed *typed) {
    size_t begin = offset;
    while (begin > typed->begin &&
           expression_name_length(str_slice(text, begin - 1, offset)) == offset - begin + 1)
        begin--;
    const bool is_alone = typed->key.len > 0 && begin == typed->begin;
    const str key =
        is_alone ? typed->key : key_of_value(text, begin, reader_is_xml(request->document->path, text));
    if (!is_of_expression(key) && !is_of_named(request, text, key))
        return false;
    *typed = (struct typed){key, str_slice(text, begin, offset), begin};
    return true;
}

json_t *server_completion(const struct request *request) {
    str text = document_text(request->document);
    struct typed typed = typed_at(text, request->offset);
    const bool in_expression = in_expression_at(request, text, request->offset, &typed);
    struct completing completing = {.request = request,
                                    .typed = typed,
                                    .range = position_range_once(text, request->server->encoding, typed.begin,
                                                                 typed.begin + typed.word.len),
                                    .known = json_object(),
                                    .items = json_array()};
    for (uint32_t e = 0; typed.key.len && schema_elements[e]; e++)
        for (uint32_t i = 0; i < schema_elements[e]->row_count; i++)
            offer_for(&completing, &schema_elements[e]->rows[i]);
    if (in_expression)
        offer_expression(&completing);
    const struct context context = context_at(request->document->path, text, typed.begin);
    if (!typed.key.len) {
        completing.has_value = is_followed(text, request->offset, context.is_xml);
        offer_rows(&completing, &context);
    }
    if (context.is_xml ? context.schema == &SCHEMA_WITH && str_equal(typed.key, STR("name"))
                       : context.named == &SCHEMA_WITH && !typed.key.len)
        offer_arguments(&completing, &context);
    json_decref(completing.range);
    json_decref(completing.known);
    json_t *list = json_object();
    json_object_set_new(list, "isIncomplete", json_false());
    json_object_set_new(list, "items", completing.items);
    return list;
}
