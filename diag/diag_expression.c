#include "diag/diag_expression.h"

#include "core/nearest.h"

#include <string.h>

enum {
    NAMES_MOST = 8, // that a message lists
    PART_MOST = 60, // bytes that it quotes
};

span diag_expression_part(const struct source_set *sources, const struct diag_expression *expression,
                          size_t begin, size_t end) {
    const str written = source_text(sources, expression->at), text = expression->text;
    if (end > text.len)
        end = text.len;
    if (begin >= end && begin > 0)
        begin = end - 1; // at the end: the last character
    for (size_t i = 0; text.len && i + text.len <= written.len; i++)
        if (memcmp(written.ptr + i, text.ptr, text.len) == 0)
            return (span){expression->at.source, expression->at.begin + (uint32_t)(i + begin),
                          expression->at.begin + (uint32_t)(i + end)};
    return expression->at;
}

static bool is_part(const struct diag_expression *expression, span place) {
    return place.begin != expression->at.begin || place.end != expression->at.end;
}

static bool is_offered(const struct expression_word *own, bool of_function) {
    return of_function ? own->is_function : !own->is_function && strcmp(own->name, own->form) == 0;
}

static str find_near(struct diag_sink *sink, const struct diag_expression *expression, str word,
                     bool of_function) {
    struct nearest near = nearest_begin_within(word, &sink->search_left);
    for (uint32_t i = 0; i < expression->name_count && !of_function; i++)
        nearest_offer(&near, expression->names[i]);
    for (const struct expression_word *own = expression_words(); own->name; own++)
        if (is_offered(own, of_function))
            nearest_offer(&near, str_from(own->name));
    return nearest_best(&near);
}

bool diag_expression_is_near(struct diag_sink *sink, const struct diag_expression *expression, str word) {
    return find_near(sink, expression, word, false).len > 0;
}

// What was probably meant, and for a number all that there is: "did you mean 'columns'? In reach: columns,
// pitch, frame, time".
static void help_name(struct diag_sink *sink, const struct diag_expression *expression, str word, span place,
                      bool of_function) {
    const str best = find_near(sink, expression, word, of_function);
    const uint32_t count = of_function ? 0 : expression->name_count;
    struct strbuf list;
    strbuf_init(&list);
    for (uint32_t i = 0; i < count && i < NAMES_MOST; i++)
        strbuf_format(&list, "%s%.*s", list.len ? ", " : "", STR_ARG(expression->names[i]));
    if (count > NAMES_MOST)
        strbuf_format(&list, " and %u more", count - NAMES_MOST);
    for (const struct expression_word *own = expression_words(); own->name; own++)
        if (is_offered(own, of_function))
            strbuf_format(&list, "%s%s", list.len ? ", " : "", own->form);
    if (best.len && of_function)
        diag_help(sink, "did you mean '%.*s'?", STR_ARG(best));
    else if (best.len)
        diag_help(sink, "did you mean '%.*s'? In reach: %.*s", STR_ARG(best), STR_ARG(strbuf_view(&list)));
    else
        diag_help(sink, "%s: %.*s", of_function ? "there are" : "in reach", STR_ARG(strbuf_view(&list)));
    if (best.len && is_part(expression, place))
        diag_fix(sink, false, place, best);
    strbuf_finish(&list);
}

void diag_expression_fault(struct diag_sink *sink, const struct source_set *sources, diag_code code,
                           const struct diag_expression *expression, const struct expression_fault *fault) {
    const span place = diag_expression_part(sources, expression, fault->begin, fault->end);
    const str part = str_slice(expression->text, fault->begin, fault->end);
    if (fault->problem != EXPRESSION_WRONG) {
        const bool of_function = fault->problem == EXPRESSION_UNKNOWN_FUNCTION;
        diag_add(sink, code, place, "there is no %s '%.*s'%s%s", of_function ? "function" : "number",
                 (int)(part.len < PART_MOST ? part.len : PART_MOST), part.ptr, of_function ? "" : " here",
                 expression->suffix);
        if (fault->help)
            diag_help(sink, "%s", fault->help);
        else
            help_name(sink, expression, part, place, of_function);
        return;
    }
    // What is seen in the excerpt is not said again, unless the file has it elsewhere.
    if (part.len && part.len <= PART_MOST && !is_part(expression, place) && part.len < expression->text.len)
        diag_add(sink, code, place, "%s, in '%.*s'%s", fault->what, STR_ARG(part), expression->suffix);
    else
        diag_add(sink, code, place, "%s%s", fault->what, expression->suffix);
    if (fault->help)
        diag_help(sink, "%s", fault->help);
    if (fault->fix && (is_part(expression, place) || part.len == expression->text.len))
        diag_fix(sink, true, place, str_from(fault->fix));
}
