#include "parser/format/format_internal.h"

static size_t skip_space(str s, size_t at) {
    while (at < s.len && (char_is_space(s.ptr[at]) || str_yaml_break_length(s, at)))
        at += char_is_space(s.ptr[at]) ? 1 : str_yaml_break_length(s, at);
    return at;
}

// Whether two texts are equal except for white space.
static bool same_words(str a, str b) {
    size_t i = 0, j = 0;
    for (;;) {
        i = skip_space(a, i);
        j = skip_space(b, j);
        if (i == a.len || j == b.len)
            return i == a.len && j == b.len;
        if (a.ptr[i++] != b.ptr[j++])
            return false;
    }
}

static bool same_span(str a_text, span a, str b_text, span b) {
    return same_words(str_slice(a_text, a.begin, a.end), str_slice(b_text, b.begin, b.end));
}

// The comments before an entry are the same ones, and a comment after it is still there. A comment after the
// last line of an entry, where no other entry begins, may now be after its first line, since lines were
// joined.
static bool same_comments(const struct tree *a, uint32_t i, str a_text, const struct tree *b, uint32_t j,
                          str b_text) {
    struct tree_comment c = a->comments.items[i], d = b->comments.items[j];
    bool joined = c.trailing_begin == c.trailing_end;
    return same_span(a_text, (span){0, c.begin, c.end}, b_text, (span){0, d.begin, d.end}) &&
           (joined || same_span(a_text, (span){0, c.trailing_begin, c.trailing_end}, b_text,
                                (span){0, d.trailing_begin, d.trailing_end}));
}

// Both readers add nodes in the order of the file, so that equal trees have equal indices.
bool format_same(const struct tree *a, str a_text, const struct tree *b, str b_text) {
    if (a->nodes.count != b->nodes.count || a->root != b->root || a->broken != b->broken ||
        !str_equal(a->root_tag, b->root_tag) || !same_words(a->xsi_attributes, b->xsi_attributes) ||
        !same_span(a_text, a->schema_line, b_text, b->schema_line) ||
        !same_span(a_text, a->closing_comments, b_text, b->closing_comments))
        return false;
    for (uint32_t i = 1; i < a->nodes.count; i++) {
        const struct tree_node *n = &a->nodes.items[i], *m = &b->nodes.items[i];
        bool scalar = n->kind == TREE_SCALAR || n->kind == TREE_NULL;
        bool same = n->kind == m->kind && n->style == m->style && n->key == m->key && n->flags == m->flags &&
                    n->count == m->count && n->next == m->next && (scalar || n->value == m->value) &&
                    same_comments(a, n->comments, a_text, b, m->comments, b_text);
        if (!same || (scalar && !str_equal(tree_text(a, i), tree_text(b, i))))
            return false;
    }
    return true;
}
