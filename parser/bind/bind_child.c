// An attribute of XML that must be an element: the fix takes it out of its tag and puts the element after it.
#include "parser/bind/bind.h"
#include "parser/tree/mend.h"
#include "parser/tree/xml_scan.h"

// The tag around an attribute.
struct tag {
    uint32_t name_begin, name_end;
    uint32_t begin;    // of the attribute, spaces before it included
    uint32_t rest_end; // after the last attribute
    bool others;       // a later attribute also has several numbers
    enum xml_tag_end end;
    uint32_t behind; // the '>'
};

// false: no attribute of a tag that ends has its value at `value`.
static bool find_tag(str text, uint32_t value, struct tag *tag) {
    uint32_t open = value;
    while (open > 0 && text.ptr[open - 1] != '<')
        open--;
    if (open == 0)
        return false;
    uint32_t at = xml_name_end(text, open - 1);
    struct xml_attribute attribute;
    *tag = (struct tag){.name_begin = open, .name_end = at};
    for (;;) {
        uint32_t before = at;
        tag->end = xml_next_attribute(text, &at, &attribute);
        if (tag->end != XML_TAG_MORE) {
            tag->rest_end = before;
            tag->behind = xml_behind(text, at, ">");
            return tag->begin && tag->end != XML_TAG_MALFORMED;
        }
        str words = str_slice(text, attribute.value_begin, attribute.value_end);
        tag->others = tag->others || (tag->begin && mend_is_numbers(words));
        if (attribute.value_begin == value)
            tag->begin = before;
    }
}

// If a tag has several such attributes, the last comes first, so that the fixes do not overlap.
void bind_fix_as_child(struct bind_context *context, tree_index value, str child) {
    span at = tree_span(context->tree, value);
    str text = context->sources->items[at.source].text;
    struct tag tag;
    if (!find_tag(text, at.begin, &tag) || tag.others)
        return;
    str end_tag = STR("");
    if (tag.end != XML_TAG_OPEN)
        end_tag =
            arena_format(context->scratch, "</%.*s>", STR_ARG(str_slice(text, tag.name_begin, tag.name_end)));
    diag_fix(context->sink, true, (span){at.source, tag.begin, tag.behind},
             arena_format(context->scratch, "%.*s>%.*s%.*s",
                          STR_ARG(str_slice(text, at.end + 1, tag.rest_end)), STR_ARG(child),
                          STR_ARG(end_tag)));
}
