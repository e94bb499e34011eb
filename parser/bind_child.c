// An attribute of XML that must be an element: the fix takes it out of its tag and puts the element behind
// it.
#include "parser/bind.h"
#include "parser/mend.h"

#include <string.h>

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

// Where an attribute begins, blanks before it included, whose value begins at `value`; 0: it is none.
static uint32_t attribute_begin(str text, uint32_t value) {
    uint32_t at = value;
    if (at < 2 || (text.ptr[at - 1] != '"' && text.ptr[at - 1] != '\''))
        return 0;
    at--;
    while (at > 0 && is_blank(text.ptr[at - 1]))
        at--;
    if (at == 0 || text.ptr[at - 1] != '=')
        return 0;
    at--;
    while (at > 0 && is_blank(text.ptr[at - 1]))
        at--;
    while (at > 0 && !is_blank(text.ptr[at - 1]))
        at--;
    while (at > 0 && is_blank(text.ptr[at - 1]))
        at--;
    return at;
}

// The '>' of the tag that goes on at `at`; the text's length where it does not end.
static uint32_t tag_close(str text, uint32_t at) {
    char quote = '\0';
    for (; at < text.len; at++) {
        char c = text.ptr[at];
        if (quote ? c == quote : c == '"' || c == '\'')
            quote = quote ? '\0' : c;
        else if (c == '>' && !quote)
            break;
    }
    return at;
}

// Whether another value of the tag is several numbers: it goes first, so that the fixes do not lie over each
// other.
static bool has_other(str rest) {
    while (rest.len) {
        size_t begin = 0;
        while (begin < rest.len && rest.ptr[begin] != '"' && rest.ptr[begin] != '\'')
            begin++;
        size_t end = begin + 1;
        while (end < rest.len && rest.ptr[end] != rest.ptr[begin])
            end++;
        if (end >= rest.len)
            return false;
        if (mend_is_numbers(str_slice(rest, begin + 1, end)))
            return true;
        rest = str_slice(rest, end + 1, rest.len);
    }
    return false;
}

void bind_fix_as_child(struct bind_context *context, tree_index value, str child) {
    span at = tree_span(context->tree, value);
    str text = context->sources->items[at.source].text;
    uint32_t begin = attribute_begin(text, at.begin), close = tag_close(text, at.end + 1);
    uint32_t open = begin;
    while (open > 0 && text.ptr[open - 1] != '<')
        open--;
    if (begin == 0 || open == 0 || close >= text.len || has_other(str_slice(text, at.end + 1, close)))
        return;
    uint32_t name_end = open;
    while (name_end < begin && !is_blank(text.ptr[name_end]))
        name_end++;
    bool alone = text.ptr[close - 1] == '/';
    uint32_t rest_end = alone ? close - 1 : close;
    while (rest_end > at.end + 1 && is_blank(text.ptr[rest_end - 1]))
        rest_end--;
    str end_tag =
        alone ? arena_format(context->scratch, "</%.*s>", STR_ARG(str_slice(text, open, name_end))) : STR("");
    diag_fix(context->sink, true, (span){at.source, begin, close + 1},
             arena_format(context->scratch, "%.*s>%.*s%.*s", STR_ARG(str_slice(text, at.end + 1, rest_end)),
                          STR_ARG(child), STR_ARG(end_tag)));
}
