// Recognises values despite a reported mistake: they are still read, so that their own mistakes show in the
// same run, and names in them are known.
#include "core/number.h"
#include "diag/codes/binding.h"
#include "parser/bind/bind.h"
#include "parser/bind/say.h"
#include "parser/tree/mend.h"

#include <string.h>

// Whether a map is an entry of the row and not a map of entries: it has a key of an entry.
static bool is_entry(struct bind_context *context, const struct schema_row *row, tree_index map) {
    struct bind_frame entry = {.schema = row->child, .via = row};
    bool single;
    for (tree_index key = tree_first(context->tree, map); key; key = tree_next_key(context->tree, key))
        if (bind_find_row(context, row->child, key, &single) >= 0 ||
            bind_find_style(context, &entry, key) >= 0)
            return true;
    return false;
}

static void add_entry(struct bind_context *context, struct bind_entries *entries, str name,
                      struct bind_given given) {
    if (!bind_is_known(context, given.value))
        *ARENA_PUSH(context->scratch, entries) = (struct bind_found){name, given};
}

// What an entry must name and does not, so that the key before it is that name: 'object' of an instance.
static const struct schema_row *named_by_key(struct bind_context *context,
                                             const struct schema_element *schema, tree_index entry) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        if (row->kind != SCHEMA_REFERENCE || !row->required)
            continue;
        bool single;
        for (tree_index key = tree_first(context->tree, entry); key; key = tree_next_key(context->tree, key))
            if (bind_find_row(context, schema, key, &single) == (int)i)
                return NULL;
        return row;
    }
    return NULL;
}

// A map where a list belongs: one entry, or entries by name.
static void map_for_list(struct bind_context *context, struct bind_entries *entries,
                         const struct schema_row *row, tree_index map, bool reported) {
    struct diag_sink *sink = context->sink;
    const struct tree *tree = context->tree;
    tree_index first = tree_first(tree, map);
    if (!first) {
        if (reported)
            diag_help(sink, "an empty list is written []");
        return;
    }
    str name = tree_text(tree, first);
    if (name.len > 1 && name.ptr[0] == '-') {
        if (reported)
            diag_help(sink, "a space is missing after the '-': write '- %.*s'",
                      STR_ARG(say_text(context->scratch, str_slice(name, 1, name.len))));
        return;
    }
    if (is_entry(context, row, map)) {
        if (reported && tree_node(tree, map)->style == TREE_FLOW)
            diag_help(sink, "put it into a list: [{...}]");
        else if (reported)
            diag_help(sink, "begin each entry with '- ', even if there is only one");
        add_entry(context, entries, STR(""), (struct bind_given){.value = map});
        return;
    }
    if (bind_kind(context, tree_value(tree, first)) != TREE_MAP)
        return;
    const struct schema_row *named = named_by_key(context, row->child, tree_value(tree, first));
    const str own = say_text(context->scratch, name);
    if (reported && named)
        diag_help(sink, "begin each entry with '- ' and write its name inside: - {%s: %.*s, ...}",
                  named->name, STR_ARG(own));
    else if (reported)
        diag_help(sink, "begin each entry with '- ' and write its name inside: - {name: %.*s, ...}",
                  STR_ARG(own));
    for (tree_index key = first; key; key = tree_next_key(tree, key)) {
        const tree_index value = tree_value(tree, key);
        if (bind_kind(context, value) != TREE_MAP || bind_is_bad_pair(context, map, key))
            continue;
        if (named_by_key(context, row->child, value))
            tree_node(tree, value)->flags |= TREE_CUT; // what it lacks is its key
        add_entry(context, entries, STR(""), bind_given_by(context, key));
    }
}

// The name that an item of a list gives itself, for a map that has names as keys; its pair is then skipped.
static str take_name(const struct bind_context *context, const struct schema_row *row, tree_index item,
                     struct bind_given *given) {
    const struct tree *tree = context->tree;
    int key_row = schema_key_row(row->child);
    for (tree_index key = tree_first(tree, item); key && key_row >= 0; key = tree_next_key(tree, key)) {
        tree_index value = tree_value(tree, key);
        if (!str_equal_cstr(tree_text(tree, key), row->child->rows[key_row].name) ||
            bind_kind(context, value) != TREE_SCALAR || bind_is_bad(context, value))
            continue;
        tree_node(tree, key)->flags |= TREE_BAD;
        given->key = key;
        given->key_span = tree_span(tree, value);
        return tree_text(tree, value);
    }
    return STR("");
}

// A list where a map by name belongs.
static void list_for_map(struct bind_context *context, struct bind_entries *entries,
                         const struct schema_row *row, tree_index list, bool reported) {
    for (tree_index item = tree_first(context->tree, list); item; item = tree_next(context->tree, item)) {
        if (bind_kind(context, item) != TREE_MAP)
            continue;
        struct bind_given given = {.value = item};
        str name = take_name(context, row, item, &given);
        const tree_index only = tree_first(context->tree, item);
        if (only && !name.len && !is_entry(context, row, item) && !bind_is_bad_pair(context, item, only)) {
            if (reported) // - size: 2
                diag_help(context->sink, "write each name without '- ' before it: %.*s: ...",
                          STR_ARG(say_text(context->scratch, tree_text(context->tree, only))));
            reported = false;
            add_entry(context, entries, tree_text(context->tree, only), bind_given_by(context, only));
            continue;
        }
        if (reported && name.len)
            diag_help(context->sink, "write each entry after its name, without '- ' and 'name': %.*s: {...}",
                      STR_ARG(say_text(context->scratch, name)));
        reported = false;
        add_entry(context, entries, name, given);
    }
}

// One value where a list belongs, if the value alone makes an entry.
static void value_for_list(struct bind_context *context, struct bind_entries *entries,
                           const struct schema_row *row, tree_index value, bool reported) {
    str written = source_text(context->sources, tree_span(context->tree, value));
    const int only = schema_short_row(row->child);
    const enum schema_kind kind = only < 0 ? SCHEMA_ELEMENT : row->child->rows[only].kind;
    const bool needs_list = schema_components(kind)[0] && kind != SCHEMA_VECTOR && kind != SCHEMA_COLOR;
    if (only < 0 || row->many != SCHEMA_SEQUENCE || needs_list)
        return;
    if (reported) {
        str mended = arena_format(context->scratch, "[%.*s]", STR_ARG(written));
        diag_help(context->sink, "write %.*s", STR_ARG(say_text(context->scratch, mended)));
        diag_fix(context->sink, true, tree_span(context->tree, value), mended);
    }
    add_entry(context, entries, STR(""), (struct bind_given){.value = value});
}

struct bind_entries bind_loose_entries(struct bind_context *context, const struct schema_row *row,
                                       tree_index value, bool reported) {
    struct bind_entries entries = {0};
    enum tree_kind kind = bind_kind(context, value);
    if (row->many == SCHEMA_FIXED || bind_is_known(context, value))
        return entries;
    if (kind == TREE_MAP)
        map_for_list(context, &entries, row, value, reported);
    else if (kind == TREE_LIST)
        list_for_map(context, &entries, row, value, reported);
    else if (kind == TREE_SCALAR)
        value_for_list(context, &entries, row, value, reported);
    return entries;
}

// Whether a key belongs to the elements of `row`, and to nothing where it is written.
static bool is_out_of_column(const struct bind_context *context, const struct bind_frame *outer,
                             const struct schema_row *row, tree_index key) {
    bool single;
    return key && !bind_is_bad(context, key) && bind_find_row(context, row->child, key, &single) >= 0 &&
           (!outer || bind_find_row(context, outer->schema, key, &single) < 0);
}

void bind_loose_columns(struct bind_context *context, const struct bind_frame *outer,
                        const struct schema_row *row, tree_index key) {
    const struct tree *tree = context->tree;
    tree_index value = tree_value(tree, key);
    const struct tree_node *n = tree_node(tree, value);
    bool open = n->kind == TREE_NULL || ((n->kind == TREE_MAP || n->kind == TREE_LIST) && outer);
    if (tree->is_xml || !row->child || !open || n->style == TREE_FLOW || bind_is_known(context, value) ||
        !is_out_of_column(context, outer, row, tree_next_key(tree, key)))
        return;
    tree_index last = value;
    if (n->kind == TREE_LIST)
        for (tree_index item = tree_first(tree, value); item; item = tree_next(tree, item))
            last = item;
    tree_node(tree, last)->flags |= n->kind == TREE_NULL ? TREE_BAD : TREE_CUT;
    tree_index next = tree_next_key(tree, key);
    str name = say_text(context->scratch, tree_text(tree, next));
    str above = say_text(context->scratch, tree_text(tree, key));
    diag_add(context->sink, DIAG_UNKNOWN_NAME, tree_span(tree, next), "'%.*s' does not belong in this column",
             STR_ARG(name));
    diag_help(context->sink, "what belongs to '%.*s' above must be indented further than it", STR_ARG(above));
    for (; is_out_of_column(context, outer, row, next); next = tree_next_key(tree, next))
        tree_node(tree, next)->flags |= TREE_BAD;
}

enum {
    NUMBERS_BYTES_MAX = 256
};

static size_t skip_blanks(str text, size_t at) {
    while (at < text.len && (text.ptr[at] == ' ' || text.ptr[at] == '\t'))
        at++;
    return at;
}

// The end of the numbers, separated by commas, that begin at `begin`; there are *count of them.
static size_t numbers_end(str text, size_t begin, uint32_t *count) {
    size_t end = begin;
    text = str_slice(text, 0, begin + NUMBERS_BYTES_MAX < text.len ? begin + NUMBERS_BYTES_MAX : text.len);
    for (size_t at = begin; at < text.len;) {
        size_t stop = at;
        double ignored;
        while (stop < text.len && !strchr(" \t\r\n,:]}", text.ptr[stop]))
            stop++;
        size_t after = skip_blanks(text, stop);
        bool is_key = after < text.len && text.ptr[after] == ':';
        if (is_key || number_parse(str_slice(text, at, stop), &ignored) != NUMBER_OK)
            break;
        end = stop;
        ++*count;
        if (after == text.len || text.ptr[after] != ',')
            break;
        at = skip_blanks(text, after + 1);
    }
    return end;
}

bool bind_loose_numbers(struct bind_context *context, struct bind_frame *frame, uint32_t row, tree_index map,
                        tree_index key) {
    const struct tree *tree = context->tree;
    const struct schema_row *r = &frame->schema->rows[row];
    const struct tree_node *value = tree_node(tree, tree_value(tree, key));
    uint32_t components = 0;
    for (const char *const *names = schema_components(r->kind); names[components];)
        components++;
    if (tree->is_xml || components == 0 || r->many != SCHEMA_ONE || value->kind != TREE_SCALAR ||
        value->style != TREE_PLAIN || tree_node(tree, map)->style != TREE_FLOW || !tree_next_key(tree, key))
        return false;
    str text = context->sources->items[tree->source].text;
    uint32_t count = 0;
    uint32_t end = (uint32_t)numbers_end(text, value->begin, &count);
    if (count < 2)
        return false;
    struct bind_subject subject = bind_subject(frame, r);
    span at = {tree->source, value->begin, end};
    str written = source_text(context->sources, at);
    str list = mend_numbers(context->scratch, written, components);
    diag_add(context->sink, DIAG_WRONG_SHAPE, at, "%.*s must be %.*s, not '%.*s'",
             STR_ARG(say_subject(context->scratch, subject)),
             STR_ARG(say_expected_of(context->scratch, subject)), STR_ARG(written));
    if (list.len) {
        str mended = arena_format(context->scratch, "[%.*s]", STR_ARG(list));
        diag_help(context->sink, "write %.*s", STR_ARG(mended));
        diag_fix(context->sink, true, at, mended);
    } else {
        bind_help_example(context, subject);
    }
    for (tree_index next = key; next; next = tree_next_key(tree, next))
        if (tree_node(tree, next)->begin < end)
            tree_node(tree, next)->flags |= TREE_BAD;
    return true;
}

enum {
    FLAT_NUMBERS_MOST = 16 // that a fix writes
};

// How many numbers an entry of a list is, if it is that and no more: of a matrix's rows 4, of points 2; else
// 0.
static uint32_t numbers_of_entry(const struct schema_row *row) {
    const int only = row->many == SCHEMA_SEQUENCE ? schema_short_row(row->child) : -1;
    return only < 0 ? 0 : schema_component_count(row->child->rows[only].kind);
}

// Of a matrix in one line 3: 9 numbers, without the last column, or 16, whose last row is 0, 0, 0, 1. Else 0.
static uint32_t rows_of_matrix(const struct tree *tree, tree_index list) {
    const uint32_t count = tree_node(tree, list)->count;
    uint32_t i = 0;
    for (tree_index item = tree_first(tree, list); item && count == 16; item = tree_next(tree, item), i++) {
        double value;
        if (i >= 12 && (number_parse(tree_text(tree, item), &value) != NUMBER_OK || value != (i == 15)))
            return 0;
    }
    return count == 16 || count == 9 ? 3 : 0;
}

// [[1, 0, 0], [0, 1, 0], [0, 0, 1]]: all rows of a matrix lack the last number, which is reported once.
bool bind_short_rows(struct bind_context *context, struct bind_subject subject, tree_index list) {
    const struct tree *tree = context->tree;
    str mended = STR("");
    if (numbers_of_entry(subject.row) != 4 || tree_node(tree, list)->count < 2)
        return false;
    for (tree_index row = tree_first(tree, list); row; row = tree_next(tree, row)) {
        if (bind_kind(context, row) != TREE_LIST || bind_is_bad(context, row) ||
            tree_node(tree, row)->count != 3)
            return false;
        for (tree_index item = tree_first(tree, row); item; item = tree_next(tree, item)) {
            if (bind_kind(context, item) != TREE_SCALAR)
                return false;
            mended = arena_format(context->scratch, "%.*s%s%.*s", STR_ARG(mended),
                                  item != tree_first(tree, row)   ? ", "
                                  : row != tree_first(tree, list) ? ", ["
                                                                  : "[",
                                  STR_ARG(tree_text(tree, item)));
        }
        mended = arena_format(context->scratch, "%.*s, 0]", STR_ARG(mended));
    }
    diag_add(context->sink, DIAG_WRONG_COUNT, tree_span(tree, list),
             "the rows of %.*s have 3 numbers; each needs 4",
             STR_ARG(say_subject(context->scratch, subject)));
    mended = arena_format(context->scratch, "[%.*s]", STR_ARG(mended));
    diag_help(context->sink, "the fourth says where the object is: write %.*s",
              STR_ARG(say_text(context->scratch, mended)));
    diag_fix(context->sink, false, tree_span(tree, list), mended);
    return true;
}

bool bind_flat_numbers(struct bind_context *context, struct bind_subject subject, tree_index list) {
    const struct tree *tree = context->tree;
    const uint32_t width = numbers_of_entry(subject.row), count = tree_node(tree, list)->count;
    str mended = STR("[");
    uint32_t i = 0;
    if (width < 2 || count < 2)
        return false;
    const enum schema_kind kind = subject.row->child->rows[schema_short_row(subject.row->child)].kind;
    const uint32_t rows = kind == SCHEMA_QUAD ? rows_of_matrix(tree, list) : 0;
    const uint32_t taken = rows == 3 && count == 9 ? 3 : width; // without the last column
    const bool has_fix = count % taken == 0 && count <= FLAT_NUMBERS_MOST;
    for (tree_index item = tree_first(tree, list); item; item = tree_next(tree, item), i++) {
        const str text = tree_text(tree, item);
        double value;
        const bool is_number = number_parse(text, &value) == NUMBER_OK;
        // A vector may be one expression.
        if (bind_kind(context, item) != TREE_SCALAR || bind_is_bad(context, item) ||
            (kind == SCHEMA_VECTOR && !is_number))
            return false;
        if (has_fix && !(rows && i >= rows * taken))
            mended = arena_format(context->scratch, "%.*s%s%.*s%s", STR_ARG(mended),
                                  i % taken ? ", "
                                  : i       ? ", ["
                                            : "[",
                                  STR_ARG(text),
                                  i % taken + 1 < taken ? ""
                                  : taken < width       ? ", 0]"
                                                        : "]");
    }
    diag_add(context->sink, DIAG_WRONG_SHAPE, tree_span(tree, list),
             "%.*s must be a list of lists of %u numbers, not one list of %u numbers",
             STR_ARG(say_subject(context->scratch, subject)), width, count);
    if (has_fix) {
        mended = arena_format(context->scratch, "%.*s]", STR_ARG(mended));
        diag_help(context->sink, "write %.*s", STR_ARG(mended));
        diag_fix(context->sink, false, tree_span(tree, list), mended);
    } else {
        diag_help(context->sink, "put every %u numbers into brackets of their own", width);
    }
    return true;
}
