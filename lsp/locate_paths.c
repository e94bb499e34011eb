// Names within other text: in the target of a track, spheres[pawn].radius, and in the whole name of a body,
// chairs[3]/seat.
#include "lsp/locate.h"

#include "core/number.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_walk.h"

#include <string.h>

struct naming {
    const struct session *session;
    locate_visit_named *visit;
    void *context;
    str text;
    span at; // of the text; SPAN_NONE: it is written otherwise, and has no places
};

// A piece of a path, or of a whole name.
struct step {
    str text;
    size_t begin;
};

// What is between two of these characters. false: nothing is left.
static bool next_step(str text, const char *between, size_t *at, struct step *step) {
    while (*at < text.len && strchr(between, text.ptr[*at]))
        ++*at;
    step->begin = *at;
    while (*at < text.len && !strchr(between, text.ptr[*at]))
        ++*at;
    step->text = str_slice(text, step->begin, *at);
    return step->text.len > 0;
}

static void tell(const struct naming *n, const struct schema_element *schema, const void *element,
                 struct step step, size_t length) {
    const uint32_t begin = n->at.begin + (uint32_t)step.begin;
    n->visit(n->context, schema, element, (span){n->at.source, begin, begin + (uint32_t)length});
}

static const void *item_called(const struct schema_row *list, const void *owner, str name) {
    const struct ir_any_list items = ir_walk_list(list, owner);
    for (uint32_t i = 0; i < items.count; i++)
        if (str_equal(ir_walk_name(list->child, ir_walk_item(list, items, i)), name))
            return ir_walk_item(list, items, i);
    return NULL;
}

static const void *item_numbered(const struct schema_row *list, const void *owner, str digits) {
    const struct ir_any_list items = ir_walk_list(list, owner);
    int64_t number;
    return number_parse_integer(digits, &number) == NUMBER_OK && number >= 0 && number < items.count
               ? ir_walk_item(list, items, (uint32_t)number)
               : NULL;
}

// ---- targets of tracks

static void visit_target(const struct naming *n) {
    const struct ir_scene *scene = locate_scene(n->session);
    const struct schema_element *schema = &SCHEMA_SCENE;
    const struct schema_row *list = NULL; // whose entry is next
    const void *element = scene;
    struct step step;
    bool is_single = false;
    for (size_t at = 0; element && next_step(n->text, ".[]", &at, &step);) {
        if (list) {
            const void *owner = element;
            element = item_called(list, owner, step.text);
            if (element)
                tell(n, list->child, element, step, step.text.len);
            else
                element = item_numbered(list, owner, step.text);
            schema = list->child;
            list = NULL;
            continue;
        }
        const int number = schema_find_yaml(schema, step.text, &is_single);
        const struct schema_row *row = number < 0 ? NULL : &schema->rows[number];
        if (!row || !row->child)
            return;
        if (row->kind == SCHEMA_REFERENCE)
            element = ir_walk_is_inline(scene, row, schema_field_const(row, element))
                          ? ir_walk_referent(scene, row, schema_field_const(row, element))
                          : NULL;
        else if (row->kind == SCHEMA_ELEMENT)
            element = schema_field_const(row, element);
        else if (is_single)
            element = item_called(row, element, str_from(row->single));
        else
            list = row;
        schema = list ? schema : row->child;
    }
}

// ---- whole names

// The body or instance in a scene or an object, by its name or by its list and place; NULL: there is none.
static const void *find_body(const struct naming *n, const struct schema_element *owner, const void *element,
                             struct step step, const struct schema_element **schema) {
    const str name = ir_copies_base(step.text);
    size_t at = 0;
    struct step list, place;
    const bool is_numbered =
        next_step(step.text, "[]", &at, &list) && next_step(step.text, "[]", &at, &place);
    const void *found = NULL;
    for (uint32_t i = 0; i < owner->row_count && !found; i++) {
        const struct schema_row *row = &owner->rows[i];
        if (!locate_has_entries(row))
            continue;
        *schema = row->child;
        found = item_called(row, element, name);
        if (found)
            tell(n, row->child, found, step, name.len);
        else if (is_numbered && str_equal_cstr(list.text, schema_yaml_key(row)))
            found = item_numbered(row, element, place.text);
    }
    return found;
}

static void visit_whole_name(const struct naming *n) {
    const struct schema_element *owner = &SCHEMA_SCENE, *schema = NULL;
    const void *element = locate_scene(n->session);
    struct step step;
    for (size_t at = 0; element && next_step(n->text, "/", &at, &step);) {
        const void *found = find_body(n, owner, element, step, &schema);
        element = found && schema == &SCHEMA_INSTANCE ? locate_shown(n->session, found) : NULL;
        owner = &SCHEMA_OBJECT;
    }
}

// ---- where they are

// The text's own place, without quotes; SPAN_NONE: something in it is written otherwise.
static span place_of(const struct session *session, span at, str text) {
    const str written = source_text(&session->sources, at);
    const uint32_t quotes = written.len == text.len + 2 ? 1 : 0;
    const span inner = {at.source, at.begin + quotes, at.end - quotes};
    return str_equal(source_text(&session->sources, inner), text) ? inner : SPAN_NONE;
}

static void visit_element(void *context, const struct schema_element *schema, const void *element) {
    struct naming *n = context;
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const bool is_target = schema == &SCHEMA_TRACK && row->key;
        if (!is_target && (row->kind != SCHEMA_TEXT || row->text != SCHEMA_TEXT_BODY_NAME))
            continue;
        n->text = *(const str *)schema_field_const(row, element);
        const span at = is_target ? locate_name_place(n->session, schema, element)
                                  : ir_place_value(&n->session->origin, element, schema, row->name);
        n->at = n->text.len ? place_of(n->session, at, n->text) : SPAN_NONE;
        if (span_is_none(n->at))
            continue;
        if (is_target)
            visit_target(n);
        else
            visit_whole_name(n);
    }
}

void locate_named(const struct session *session, locate_visit_named *visit, void *context) {
    struct naming naming = {.session = session, .visit = visit, .context = context};
    // Once a frame was taken, the scene has no tracks.
    const struct ir_scene *written = session->origin.written;
    locate_walk(&SCHEMA_SCENE, written ? written : session->scene, visit_element, &naming);
}
