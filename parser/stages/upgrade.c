#include "parser/stages/upgrade.h"

#include "core/number.h"
#include "core/text_edit.h"
#include "parser/tree/xml_scan.h"

const struct upgrade_table UPGRADE_STANDARD = {.version = 1};

struct upgrader {
    struct arena *arena;
    const struct tree *tree;
    const struct upgrade_table *table;
    int32_t version; // the file's
    struct {
        struct text_edit *items;
        uint32_t count, capacity;
    } edits;
};

static void replace(struct upgrader *u, span at, str text) {
    struct text_edit *edit = ARENA_PUSH(u->arena, &u->edits);
    *edit = (struct text_edit){at.begin, at.end, text, u->edits.count - 1};
}

// The closing tag's name as well, if the element has one.
static void replace_closing(struct upgrader *u, tree_index key, str text, str source) {
    span at = tree_span(u->tree, tree_value(u->tree, key));
    at.begin = xml_end_name(source, at.begin, at.end);
    at.end = at.begin + (uint32_t)tree_text(u->tree, key).len;
    if (at.begin)
        replace(u, at, text);
}

static const char *old_name(const struct upgrade_rule *rule, bool is_child) {
    return is_child ? rule->old_element : rule->old_key;
}

// Renames a key as far as the rules say, then its word; returns the name it has today.
static str upgrade_key(struct upgrader *u, const struct schema_element *element, tree_index key, str source) {
    bool is_child = tree_node(u->tree, key)->key == TREE_KEY_CHILD;
    tree_index value = tree_value(u->tree, key);
    str first = tree_text(u->tree, key), name = first;
    str word = tree_text(u->tree, value), last_word = word;
    for (int32_t version = u->version; version < u->table->version; version++) {
        for (uint32_t i = 0; i < u->table->count; i++) {
            const struct upgrade_rule *rule = &u->table->rules[i];
            const char *old = old_name(rule, is_child);
            if (rule->version != version || rule->element != element || !old || !str_equal_cstr(name, old))
                continue;
            if (rule->old_word && str_equal_cstr(last_word, rule->old_word))
                last_word = str_from(rule->new_word);
            else if (!rule->old_word)
                name = str_from(is_child ? rule->new_element : rule->new_key);
        }
    }
    if (!str_equal(name, first)) {
        replace(u, tree_span(u->tree, key), name);
        if (is_child)
            replace_closing(u, key, name, source);
    }
    if (!str_equal(word, last_word))
        replace(u, tree_span(u->tree, value), last_word);
    return name;
}

static void upgrade_map(struct upgrader *u, const struct schema_element *element, tree_index map, str source);

static void upgrade_value(struct upgrader *u, const struct schema_row *row, bool is_single, tree_index value,
                          str source) {
    const struct tree_node *node = tree_node(u->tree, value);
    bool entries = !u->tree->is_xml && row->many == SCHEMA_NAMED_MAP && !is_single && node->kind == TREE_MAP;
    if (!row->child)
        return;
    if (node->kind == TREE_LIST) {
        for (tree_index item = tree_first(u->tree, value); item; item = tree_next(u->tree, item))
            upgrade_map(u, row->child, item, source);
    } else if (entries) {
        for (tree_index key = tree_first(u->tree, value); key; key = tree_next_key(u->tree, key))
            upgrade_map(u, row->child, tree_value(u->tree, key), source);
    } else {
        upgrade_map(u, row->child, value, source);
    }
}

static void upgrade_map(struct upgrader *u, const struct schema_element *element, tree_index map,
                        str source) {
    if (tree_node(u->tree, map)->kind != TREE_MAP)
        return;
    for (tree_index key = tree_first(u->tree, map); key; key = tree_next_key(u->tree, key)) {
        bool is_single = false;
        enum tree_key kind = tree_node(u->tree, key)->key;
        str name = upgrade_key(u, element, key, source);
        int row = kind == TREE_KEY_PLAIN   ? schema_find_yaml(element, name, &is_single)
                  : kind == TREE_KEY_CHILD ? schema_find_child(element, name)
                                           : -1;
        if (row >= 0)
            upgrade_value(u, &element->rows[row], is_single, tree_value(u->tree, key), source);
    }
}

// The value of the key that holds the version; 0: there is none.
static tree_index find_version(const struct tree *tree) {
    for (tree_index key = tree_first(tree, tree->root); key; key = tree_next_key(tree, key)) {
        int row = schema_find_row(&SCHEMA_SCENE, tree_text(tree, key));
        if (row >= 0 && SCHEMA_SCENE.rows[row].range == SCHEMA_RANGE_VERSION)
            return tree_value(tree, key);
    }
    return 0;
}

bool upgrade_text(const struct reader_context *context, const struct upgrade_table *table,
                  const struct tree *tree, str text, str *upgraded) {
    struct upgrader u = {.arena = context->arena, .tree = tree, .table = table};
    tree_index version = find_version(tree);
    int64_t number = 0;
    if (!version || number_parse_integer(tree_text(tree, version), &number) != NUMBER_OK || number < 0 ||
        number >= table->version)
        return false;
    u.version = (int32_t)number;
    replace(&u, tree_span(tree, version), arena_format(u.arena, "%d", (int)table->version));
    upgrade_map(&u, &SCHEMA_SCENE, tree->root, text);
    uint32_t count = text_edits_settle(u.edits.items, u.edits.count);
    struct strbuf out;
    strbuf_init(&out);
    text_edits_apply(text, u.edits.items, count, &out);
    bool made = !out.failed;
    if (made)
        *upgraded = arena_copy(u.arena, strbuf_view(&out));
    strbuf_finish(&out);
    return made;
}
