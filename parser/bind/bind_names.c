// Names that an element does not have: what may have been meant, and where the name does exist.
#include "core/nearest.h"
#include "core/strbuf.h"
#include "diag/codes/binding.h"
#include "grammar/concept.h"
#include "grammar/ir_value.h"
#include "grammar/ir_walk.h"
#include "parser/bind/bind.h"
#include "parser/bind/say.h"
#include "parser/tree/mend.h"
#include "parser/tree/xml_scan.h"

#include <string.h>

// A row's name as a key of this kind; NULL: none, the row has another form there.
static const char *spelling(const struct schema_row *row, enum tree_key kind, bool singular) {
    if (kind == TREE_KEY_CHILD)
        return row->element;
    if (kind == TREE_KEY_ATTRIBUTE)
        return schema_is_attribute(row) ? row->name : NULL;
    if (row->key)
        return NULL;
    return singular && row->single ? row->name : schema_yaml_key(row);
}

static void offer_row(struct mend_search *search, const struct schema_row *row, int id) {
    mend_offer(search, row->name, id);
    if (row->plural)
        mend_offer(search, row->plural, id);
    if (row->element)
        mend_offer(search, row->element, id);
}

// Of equally near rows, one that is not given yet was probably meant.
static struct mend_search search_rows(struct bind_context *context, const struct bind_frame *frame,
                                      str text) {
    struct mend_search search = mend_begin(context->sink, context->scratch, text);
    for (int given = 0; given < 2; given++)
        for (uint32_t i = 0; i < frame->schema->row_count; i++)
            if (((frame->seen >> i) & 1) == (uint64_t)given)
                offer_row(&search, &frame->schema->rows[i], (int)i);
    return search;
}

int bind_find_style(struct bind_context *context, const struct bind_frame *frame, tree_index key) {
    enum tree_key kind = tree_node(context->tree, key)->key;
    struct mend_search search = search_rows(context, frame, tree_text(context->tree, key));
    bool found = search.best && search.distance == 0;
    return found && spelling(&frame->schema->rows[search.best_id], kind, false) ? search.best_id : -1;
}

void bind_fix_tag(struct bind_context *context, span at, tree_index element, bool safe, str right) {
    str text = context->sources->items[at.source].text;
    str name = source_text(context->sources, at);
    span whole = tree_span(context->tree, element);
    uint32_t closing = xml_end_name(text, whole.begin, whole.end);
    if (closing && str_starts_with(str_slice(text, closing, whole.end), name)) {
        str between = str_slice(text, at.end, closing);
        at.end = closing + (uint32_t)name.len;
        diag_fix(
            context->sink, safe, at,
            arena_format(context->scratch, "%.*s%.*s%.*s", STR_ARG(right), STR_ARG(between), STR_ARG(right)));
    } else if (whole.end >= at.end + 2 && text.ptr[whole.end - 2] == '/') {
        diag_fix(context->sink, safe, at, right);
    }
}

// Proposes another name for a key; for an XML element with an end tag in both tags.
static void fix_key(struct bind_context *context, tree_index key, bool safe, str right) {
    if (tree_node(context->tree, key)->key == TREE_KEY_CHILD)
        bind_fix_tag(context, tree_span(context->tree, key), tree_value(context->tree, key), safe, right);
    else
        diag_fix(context->sink, safe, tree_span(context->tree, key), right);
}

static void add_unknown(struct bind_context *context, const struct bind_frame *frame, tree_index key) {
    diag_add(context->sink, DIAG_UNKNOWN_NAME, tree_span(context->tree, key), "%.*s has no '%.*s'",
             STR_ARG(say_kind(context->scratch, frame)),
             STR_ARG(say_text(context->scratch, tree_text(context->tree, key))));
}

// The name exists, but has another form in this spelling: a vector as an attribute, a number as an element.
static void wrong_form(struct bind_context *context, struct bind_frame *frame, tree_index key, int id) {
    const struct schema_row *row = &frame->schema->rows[id];
    struct bind_subject subject = {.frame = frame, .row = row, .index = -1};
    tree_index value = tree_value(context->tree, key);
    const struct tree_node *n = tree_node(context->tree, value);
    frame->guessed |= bind_bit((uint32_t)id);
    if ((n->flags | tree_node(context->tree, key)->flags) & TREE_BAD)
        return;
    str found = n->kind == TREE_SCALAR
                    ? arena_format(context->scratch, "'%.*s'",
                                   STR_ARG(say_text(context->scratch, tree_text(context->tree, value))))
                : n->count ? STR("a group of attributes")
                           : STR("an empty group");
    diag_add(context->sink, DIAG_WRONG_SHAPE, tree_span(context->tree, n->kind == TREE_SCALAR ? value : key),
             "%.*s must be %.*s, not %.*s", STR_ARG(say_subject(context->scratch, subject)),
             STR_ARG(say_expected(context->scratch, row)), STR_ARG(found));
    bind_help_shape(context, subject, value);
}

// Of 'camera' and 'cameras' the nearer one was meant; of equally near ones the one whose value looks like it.
static bool is_singular(struct bind_context *context, const struct schema_row *row,
                        const struct mend_search *search, tree_index value) {
    unsigned one = nearest_distance(search->snake, str_from(row->name));
    unsigned many = nearest_distance(search->snake, str_from(schema_yaml_key(row)));
    if (one != many || tree_node(context->tree, value)->kind != TREE_MAP)
        return one <= many;
    tree_index first = tree_first(context->tree, value);
    return !first || bind_kind(context, tree_value(context->tree, first)) != TREE_MAP;
}

static void did_you_mean(struct bind_context *context, struct bind_frame *frame, tree_index key,
                         const struct mend_search *search) {
    const struct schema_row *row = &frame->schema->rows[search->best_id];
    enum tree_key kind = tree_node(context->tree, key)->key;
    bool singular = is_singular(context, row, search, tree_value(context->tree, key));
    const char *right = spelling(row, kind, singular);
    frame->guessed |= bind_bit((uint32_t)search->best_id);
    tree_index value = tree_value(context->tree, key);
    bool near = search->distance == 0 || mend_is_safe(search);
    if (!right && near && kind == TREE_KEY_ATTRIBUTE &&
        bind_help_numbers(context, bind_subject(frame, row), value))
        return;
    if (!right) {
        diag_help(context->sink, "did you mean %.*s?",
                  STR_ARG(say_example(context->scratch, row, context->tree->is_xml)));
        return;
    }
    str snake = mend_snake(context->scratch, str_from(right));
    bool style_only = str_equal(snake, search->snake);
    if (style_only && mend_quotes(search->word).len < search->word.len)
        diag_help(context->sink, "write '%s' without these quotes", right);
    else if (style_only)
        diag_help(context->sink, "did you mean '%s'? Names are %s here", right,
                  kind == TREE_KEY_CHILD ? "PascalCase" : "snake_case");
    else if (search->distance == 0)
        diag_help(context->sink, "did you mean '%s'? For example %.*s", right,
                  STR_ARG(say_example(context->scratch, row, context->tree->is_xml)));
    else
        diag_help(context->sink, "did you mean '%s'?", right);
    fix_key(context, key, style_only || (search->distance > 0 && mend_is_safe(search)), str_from(right));
}

// The row of another element that has this name, or, with `near`, one a letter off.
static const struct schema_row *row_elsewhere(const struct schema_element *element,
                                              const struct mend_search *begun, bool near) {
    for (uint32_t i = 0; i < element->row_count; i++) {
        struct mend_search search = *begun;
        if (!element->rows[i].key)
            offer_row(&search, &element->rows[i], 0);
        if (search.best && search.distance <= (near ? 1 : 0))
            return &element->rows[i];
    }
    return NULL;
}

// The name by which the author knows the element: its own, or that of its row.
static str element_in_words(struct bind_context *context, const struct schema_element *element) {
    if (element == &SCHEMA_SCENE)
        return STR("the scene itself");
    for (const struct schema_element *const *e = schema_elements; *e; e++)
        for (uint32_t i = 0; i < (*e)->row_count; i++) {
            const struct schema_row *row = &(*e)->rows[i];
            if (row->child == element && row->kind == SCHEMA_ELEMENT && strcmp(row->name, element->name) != 0)
                return arena_format(context->scratch, "'%s' of %.*s", row->name,
                                    STR_ARG(say_article(context->scratch, (*e)->name)));
        }
    return say_article(context->scratch, element->name);
}

// Where else the name exists: "'color' belongs to a background or a light"; empty: nowhere, or in many
// places.
static str elsewhere(struct bind_context *context, const struct bind_frame *frame, str snake, bool near) {
    str list = STR("");
    const char *name = NULL;
    unsigned count = 0;
    const struct mend_search begun = mend_begin(context->sink, context->scratch, snake);
    for (const struct schema_element *const *e = schema_elements; *e; e++) {
        const struct schema_row *row = *e == frame->schema ? NULL : row_elsewhere(*e, &begun, near);
        if (!row || ++count > 2)
            continue;
        str kind = element_in_words(context, *e);
        list = arena_format(context->scratch, "%.*s%s%.*s", STR_ARG(list), list.len ? " or " : "",
                            STR_ARG(kind));
        name = name ? name : row->name;
    }
    if (count == 0)
        return STR("");
    return arena_format(context->scratch, "'%s' belongs to %.*s%s", name, STR_ARG(list),
                        count > 2 ? " or others" : "");
}

static void list_what_there_is(struct bind_context *context, const struct bind_frame *frame,
                               enum tree_key kind) {
    struct strbuf list;
    strbuf_init(&list);
    for (uint32_t i = 0; i < frame->schema->row_count; i++) {
        const struct schema_row *row = &frame->schema->rows[i];
        const char *name = spelling(row, kind, false);
        if (!name)
            name = kind == TREE_KEY_PLAIN ? NULL : row->element ? row->element : row->name;
        if (name)
            strbuf_format(&list, "%s%s", list.len ? ", " : "", name);
    }
    diag_help(context->sink, "it can have: %.*s", STR_ARG(strbuf_view(&list)));
    strbuf_finish(&list);
}

// A row under the name that other programs give it.
static void other_word(struct bind_context *context, struct bind_frame *frame, tree_index key, int id) {
    const struct schema_row *row = &frame->schema->rows[id];
    const char *right = spelling(row, tree_node(context->tree, key)->key, false);
    frame->guessed |= bind_bit((uint32_t)id);
    str example = say_example(context->scratch, row, context->tree->is_xml);
    if (right) {
        diag_help(context->sink, "did you mean '%s'? For example %.*s", right, STR_ARG(example));
        fix_key(context, key, false, str_from(right));
    } else {
        diag_help(context->sink, "did you mean %.*s?", STR_ARG(example));
    }
}

// A row of other elements under the name that other programs give it: 'ior' of a sphere. false: none, or
// many.
static bool other_word_elsewhere(struct bind_context *context, str snake) {
    str list = STR("");
    const struct schema_row *only = NULL;
    unsigned count = 0;
    for (const struct schema_element *const *e = schema_elements; *e; e++) {
        int row = schema_find_also(*e, snake, 0);
        if (row < 0)
            continue;
        count++;
        only = &(*e)->rows[row];
        list = arena_format(context->scratch, "%.*s%s'%s' of %.*s", STR_ARG(list), list.len ? " or " : "",
                            only->name, STR_ARG(element_in_words(context, *e)));
    }
    if (count == 1)
        diag_help(context->sink, "did you mean %.*s? For example %.*s", STR_ARG(list),
                  STR_ARG(say_example(context->scratch, only, context->tree->is_xml)));
    else if (count == 2)
        diag_help(context->sink, "did you mean %.*s?", STR_ARG(list));
    return count == 1 || count == 2;
}

// The entry of a list with this name, of those that are bound already; NULL: none.
static const void *find_entry(const struct schema_row *list, const void *memory, str name) {
    const struct ir_any_list all = ir_walk_list(list, memory);
    for (uint32_t i = 0; i < all.count; i++)
        if (str_equal(ir_walk_key(list->child, ir_walk_item(list, all, i)), name))
            return ir_walk_item(list, all, i);
    return NULL;
}

// The row by whose entries values are given to what an element shows: a map of names to values.
static const struct schema_row *giving_row(const struct schema_element *schema) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const int value = row->many == SCHEMA_NAMED_MAP ? schema_short_row(row->child) : -1;
        if (value >= 0 && row->child->rows[value].required)
            return row;
    }
    return NULL;
}

// What the element shows is named by this row; empty: not known.
static str name_of_shown(struct bind_context *context, const struct bind_frame *frame, uint32_t row,
                         tree_index key) {
    str name = ((const struct ir_reference *)schema_field(&frame->schema->rows[row], frame->memory))->name;
    bool single;
    for (; key && !name.len; key = tree_next_key(context->tree, key))
        if (bind_find_row(context, frame->schema, key, &single) == (int)row)
            name = tree_text(context->tree, tree_value(context->tree, key));
    return name;
}

// A name of what an element shows, to which it gives values by a row of its own: {object: chair, size: 2}.
static bool is_given(struct bind_context *context, const struct bind_frame *frame, tree_index key) {
    const struct schema_element *schema = frame->schema;
    const struct schema_row *giving = giving_row(schema);
    const str name = tree_text(context->tree, key);
    for (uint32_t i = 0; giving && i < schema->row_count; i++) {
        const struct schema_element *of = schema->rows[i].child;
        if (schema->rows[i].kind != SCHEMA_REFERENCE || !schema->rows[i].required)
            continue;
        const str owner = name_of_shown(context, frame, i, key);
        const void *shown = find_entry(&SCHEMA_SCENE.rows[bind_home_row(of)], context->scene, owner);
        for (uint32_t k = 0; shown && owner.len && k < of->row_count; k++) {
            const struct schema_row *list = &of->rows[k];
            if (list->many != SCHEMA_NAMED_MAP || !find_entry(list, shown, name))
                continue;
            const str value = tree_text(context->tree, tree_value(context->tree, key));
            const str example =
                context->tree->is_xml
                    ? arena_format(context->scratch, "<%s %s=\"%.*s\" %s=\"%.*s\"/>", giving->element,
                                   giving->child->rows[schema_key_row(giving->child)].name, STR_ARG(name),
                                   giving->child->rows[schema_short_row(giving->child)].name, STR_ARG(value))
                    : arena_format(
                          context->scratch, "%s: {%.*s: %.*s}", giving->name, STR_ARG(name),
                          STR_ARG(source_text(context->sources,
                                              tree_span(context->tree, tree_value(context->tree, key)))));
            diag_help(context->sink, "it is a %s of the %s '%.*s': write %.*s", list->child->name, of->name,
                      STR_ARG(owner), STR_ARG(say_text(context->scratch, example)));
            return true;
        }
    }
    return false;
}

// A feature of other tools that glint lacks, unless a name of this element is surely meant.
static const struct concept *concept_meant(const struct bind_frame *frame, const struct mend_search *search) {
    const struct concept *concept = concept_find(frame->schema, search->snake);
    bool misspelt = search->best && mend_is_safe(search);
    return concept && misspelt && !concept_is_special(concept) ? NULL : concept;
}

// "radius:1", which YAML takes for one word.
static bool is_glued(struct bind_context *context, struct bind_frame *frame, tree_index key) {
    str text = tree_text(context->tree, key);
    bool plain = !context->tree->is_xml && tree_node(context->tree, key)->style == TREE_PLAIN;
    const char *colon = plain && text.len ? memchr(text.ptr, ':', text.len) : NULL;
    if (!colon)
        return false;
    str name = str_slice(text, 0, (size_t)(colon - text.ptr));
    struct mend_search search = search_rows(context, frame, name);
    int id = search.best ? search.best_id : schema_find_also(frame->schema, search.snake, 0);
    if (id < 0)
        return false;
    frame->guessed |= bind_bit((uint32_t)id);
    add_unknown(context, frame, key);
    str value = str_slice(text, name.len + 1, text.len);
    str mended = arena_format(context->scratch, "%.*s: %.*s", STR_ARG(name), STR_ARG(value));
    diag_help(context->sink, "a space is missing after the ':'; write '%.*s'",
              STR_ARG(say_text(context->scratch, mended)));
    diag_fix(context->sink, true, tree_span(context->tree, key), mended);
    return true;
}

// A key around contents that belong directly in its place: '- sphere: {...}', 'scene: {...}', <Spheres>
// around spheres.
static bool is_wrapper(struct bind_context *context, struct bind_frame *frame, tree_index key, str snake,
                       struct bind_meant *meant) {
    tree_index value = tree_value(context->tree, key);
    enum tree_key kind = tree_node(context->tree, key)->key;
    if (bind_kind(context, value) != TREE_MAP || bind_is_bad(context, value) || kind == TREE_KEY_ATTRIBUTE)
        return false;
    const struct schema_row *row = NULL;
    for (uint32_t i = 0; i < frame->schema->row_count && kind == TREE_KEY_CHILD; i++)
        if (frame->schema->rows[i].plural && str_equal_cstr(snake, frame->schema->rows[i].plural))
            row = &frame->schema->rows[i];
    bool own = str_equal_cstr(snake, frame->schema->name) && schema_find_row(frame->schema, snake) < 0;
    if (!row && !own)
        return false;
    add_unknown(context, frame, key);
    if (row)
        diag_help(context->sink, "write each <%s> without <%.*s> around it", row->element,
                  STR_ARG(say_text(context->scratch, tree_text(context->tree, key))));
    else if (!frame->parent)
        diag_help(context->sink, "the file itself is the %s: replace this with its contents",
                  frame->schema->name);
    else
        diag_help(context->sink, "this is already %.*s: replace it with its contents",
                  STR_ARG(say_article(context->scratch, frame->schema->name)));
    meant->what = row ? BIND_MEANT_ENTRIES : BIND_MEANT_ITSELF;
    return true;
}

// The key of the map that gives another row of the short row's choice: the one given before, or one after
// `key`. SPAN_NONE: none.
static span excluding_key(const struct bind_context *context, const struct bind_frame *frame, uint32_t bare,
                          tree_index key, const char **name) {
    const struct schema_row *rows = frame->schema->rows;
    for (uint32_t i = 0; i < frame->schema->row_count; i++) {
        const struct ir_row_origin *there = ir_origin_row(context->origin, bind_head(frame), i);
        *name = rows[i].name;
        if (i != bare && rows[i].choice == rows[bare].choice && there)
            return there->key;
    }
    for (; key; key = tree_next_key(context->tree, key)) {
        bool single;
        int row = bind_find_row(context, frame->schema, key, &single);
        *name = row >= 0 ? rows[row].name : NULL;
        if (row >= 0 && row != (int)bare && rows[row].choice == rows[bare].choice)
            return tree_span(context->tree, key);
    }
    return SPAN_NONE;
}

// A component of the value that may be written alone, next to a row that excludes it: r, g, b next to a
// checker.
static bool is_mixed(struct bind_context *context, struct bind_frame *frame, tree_index key) {
    int bare = schema_short_row(frame->schema);
    if (bare < 0 || frame->schema->rows[bare].choice == 0)
        return false;
    const struct schema_row *row = &frame->schema->rows[bare];
    const char *const *names = schema_components(row->kind);
    while (*names && !str_equal_cstr(tree_text(context->tree, key), *names))
        names++;
    if (!*names)
        return false;
    if (frame->guessed & bind_bit((uint32_t)bare))
        return true;
    const char *name = NULL;
    span other = excluding_key(context, frame, (uint32_t)bare, key, &name);
    if (span_is_none(other))
        return false;
    span here = tree_span(context->tree, key);
    bool before = here.begin < other.begin;
    frame->guessed |= bind_bit((uint32_t)bare);
    diag_add(context->sink, DIAG_EXCLUSIVE, before ? other : here,
             "%.*s has both '%s' and '%s'; only one is allowed",
             STR_ARG(say_subject(context->scratch, bind_subject(frame, NULL))), before ? row->name : name,
             before ? name : row->name);
    diag_note(context->sink, before ? here : other, "'%s' is here", before ? row->name : name);
    diag_help(context->sink, "remove one of the two");
    return true;
}

// "x" next to rows that have components of their own: <Light x="1" y="2" z="3"/>. Reported once.
static bool is_component(struct bind_context *context, struct bind_frame *frame, tree_index key) {
    str text = tree_text(context->tree, key);
    for (uint32_t i = 0; i < frame->schema->row_count; i++) {
        const struct schema_row *row = &frame->schema->rows[i];
        const char *const *names = row->kind != SCHEMA_WEIGHTS ? schema_components(row->kind) : NULL;
        while (names && *names && !str_equal_cstr(text, *names))
            names++;
        if (!names || !*names || (frame->seen & bind_bit(i)))
            continue;
        if (frame->guessed & bind_bit(i))
            return true;
        frame->guessed |= bind_bit(i);
        add_unknown(context, frame, key);
        diag_help(context->sink, "write the components together: %.*s",
                  STR_ARG(say_example(context->scratch, row, context->tree->is_xml)));
        return true;
    }
    return false;
}

// "0, 0, 1" of x="0" y="0" z="1"
static str attributes_in_order(struct bind_context *context, tree_index element) {
    str list = STR("");
    for (tree_index key = tree_first(context->tree, element); key; key = tree_next_key(context->tree, key))
        if (bind_kind(context, tree_value(context->tree, key)) == TREE_SCALAR)
            list = arena_format(context->scratch, "%.*s%s%.*s", STR_ARG(list), list.len ? ", " : "",
                                STR_ARG(say_text(context->scratch,
                                                 tree_text(context->tree, tree_value(context->tree, key)))));
    return list;
}

// <Value x="0" y="0" z="1"/> for what XML writes as text: value="0, 0, 1", values="[0, 0, 1], [2, 0, 1]".
// Reported once.
static bool is_values(struct bind_context *context, struct bind_frame *frame, tree_index key, str snake) {
    const struct schema_row *row = frame->schema->rows;
    const struct schema_row *end = row + frame->schema->row_count;
    while (row < end && !(schema_has_values(row) && snake.len + 1 >= strlen(row->name) &&
                          str_starts_with(str_from(row->name), snake)))
        row++;
    if (row == end || bind_kind(context, tree_value(context->tree, key)) != TREE_MAP)
        return false;
    const uint64_t bit = bind_bit((uint32_t)(row - frame->schema->rows));
    if (frame->guessed & bit)
        return true;
    str text = STR("");
    for (tree_index k = key; k; k = tree_next_key(context->tree, k)) {
        const str one = attributes_in_order(context, tree_value(context->tree, k));
        if (one.len && str_equal(tree_text(context->tree, k), tree_text(context->tree, key)))
            text =
                arena_format(context->scratch, row->text == SCHEMA_TEXT_LIST ? "%.*s%s[%.*s]" : "%.*s%s%.*s",
                             STR_ARG(text), text.len ? ", " : "", STR_ARG(one));
    }
    if (!text.len)
        return false;
    frame->guessed |= bit;
    add_unknown(context, frame, key);
    diag_help(context->sink, "write %s=\"%.*s\"", row->name, STR_ARG(text));
    return true;
}

// <Material ref="red"/> instead of the name of a material.
static bool is_reference(struct bind_context *context, struct bind_frame *frame, tree_index key) {
    static const char *const words[] = {"ref", "id", "idref", "href", "use", "link"};
    tree_index value = tree_value(context->tree, key);
    if (tree_node(context->tree, key)->key != TREE_KEY_ATTRIBUTE || !frame->via ||
        frame->via->kind != SCHEMA_REFERENCE || !str_is_name(tree_text(context->tree, value)))
        return false;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        if (!str_equal_cstr(tree_text(context->tree, key), words[i]))
            continue;
        add_unknown(context, frame, key);
        diag_help(context->sink, "to use a %s of the scene write %s=\"%.*s\"", frame->schema->name,
                  frame->via->name, STR_ARG(tree_text(context->tree, value)));
        return true;
    }
    return false;
}

// A number that YAML takes for a key without a value: what follows a decimal comma ("radius: 1,5"), or a
// comma in parentheses.
static bool is_rest(struct bind_context *context, tree_index key) {
    const struct tree *tree = context->tree;
    const struct tree_node *n = tree_node(tree, key);
    span at = tree_span(tree, key);
    str all = context->sources->items[at.source].text;
    if (tree->is_xml || n->style != TREE_PLAIN || bind_kind(context, tree_value(tree, key)) != TREE_NULL)
        return false;
    uint32_t begin = at.begin;
    while (begin > 0 && memchr("0123456789.,+- (", all.ptr[begin - 1], 16))
        begin--;
    while (begin < at.begin && all.ptr[begin] == ' ')
        begin++;
    str before = str_slice(all, begin, at.begin);
    if (before.len && before.ptr[0] == '(')
        return true; // reported with the first
    int64_t whole;
    bool digits = number_parse_integer(tree_text(tree, key), &whole) == NUMBER_OK;
    bool comma = before.len > 1 && before.ptr[before.len - 1] == ',';
    if (!digits || !comma || number_parse_integer(str_slice(before, 0, before.len - 1), &whole) != NUMBER_OK)
        return false;
    span both = {at.source, begin, at.end};
    str written = source_text(context->sources, both);
    diag_add(context->sink, DIAG_BAD_NUMBER, both, "'%.*s' has a decimal comma; write a decimal point",
             STR_ARG(written));
    str mended = mend_number(context->scratch, NUMBER_COMMA, written);
    diag_help(context->sink, "write %.*s", STR_ARG(mended));
    diag_fix(context->sink, false, both, mended);
    return true;
}

enum {
    SHORT_NAME = 3,
    LONG_NAME = 30
};

struct bind_meant bind_unknown_name(struct bind_context *context, struct bind_frame *frame, tree_index key) {
    struct bind_meant meant = {BIND_MEANT_NOTHING, 0};
    enum tree_key kind = tree_node(context->tree, key)->key;
    str text = tree_text(context->tree, key);
    if (diag_is_full(context->sink)) {
        diag_add(context->sink, DIAG_UNKNOWN_NAME, tree_span(context->tree, key), "unknown name");
        return meant;
    }
    struct mend_search search = search_rows(context, frame, text);
    if (is_mixed(context, frame, key) || is_glued(context, frame, key) ||
        is_wrapper(context, frame, key, search.snake, &meant) || is_reference(context, frame, key) ||
        is_values(context, frame, key, search.snake) || is_rest(context, key))
        return meant;
    const struct schema_row *near = search.best ? &frame->schema->rows[search.best_id] : NULL;
    bool exact = near && search.distance == 0;
    bool style_is_right = near && (str_equal_cstr(text, near->name) || kind == TREE_KEY_CHILD);
    if (exact && !near->key && !spelling(near, kind, false) && style_is_right) {
        wrong_form(context, frame, key, search.best_id);
        return meant;
    }
    int also = exact ? -1 : schema_find_also(frame->schema, search.snake, 0);
    const struct concept *concept = exact || also >= 0 ? NULL : concept_meant(frame, &search);
    if (!exact && also < 0 && !concept && is_component(context, frame, key))
        return meant;
    str other = exact || also >= 0 || concept ? STR("") : elsewhere(context, frame, search.snake, false);
    if (also < 0 && !concept && other.len == 0 && !(near && search.distance <= 1) &&
        search.snake.len > SHORT_NAME && search.snake.len <= LONG_NAME)
        also = schema_find_also(frame->schema, search.snake, 1);
    if (!near && also < 0 && !concept && other.len == 0 && search.snake.len > SHORT_NAME)
        other = elsewhere(context, frame, search.snake, true);
    // Of three letters, one is a third: 'ior' is meant as such before it is taken for 'for'.
    const bool is_doubtful = near && !exact && search.snake.len <= SHORT_NAME;
    add_unknown(context, frame, key);
    bool is_key = (exact && near->key) || (also >= 0 && frame->schema->rows[also].key);
    if (is_key && kind == TREE_KEY_PLAIN)
        diag_help(context->sink, frame->via->kind == SCHEMA_REFERENCE ? "written in place it needs no name"
                                                                      : "the key above it is its name");
    else if (is_given(context, frame, key))
        return meant;
    else if (also >= 0)
        other_word(context, frame, key, also);
    else if (concept)
        diag_help(context->sink, "%.*s",
                  STR_ARG(say_concept(context->scratch, concept, context->tree->is_xml)));
    else if (is_doubtful && other_word_elsewhere(context, search.snake))
        return meant;
    else if (near && (search.distance <= 1 || !other.len))
        did_you_mean(context, frame, key, &search);
    else if (other.len)
        diag_help(context->sink, "%.*s", STR_ARG(other));
    else if (!other_word_elsewhere(context, search.snake))
        list_what_there_is(context, frame, kind);
    if (exact && !near->key && spelling(near, kind, false))
        meant = (struct bind_meant){BIND_MEANT_ROW, (uint32_t)search.best_id};
    return meant;
}
