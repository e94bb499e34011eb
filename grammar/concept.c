#include "grammar/concept.h"

#include <string.h>

#define CONCEPT(chapter, title, words, in, lacks, instead, use, example)                                     \
    {chapter, title, words, in, lacks, instead, use, example},
const struct concept concepts[] = {
#include "grammar/concepts.def"
    {0}};
#undef CONCEPT

str concept_next_word(str *rest) {
    size_t end = 0;
    while (end < rest->len && rest->ptr[end] != ' ')
        end++;
    str word = str_slice(*rest, 0, end);
    *rest = str_slice(*rest, end < rest->len ? end + 1 : end, rest->len);
    return word;
}

static bool is_listed(const char *words, str word) {
    str rest = str_from(words);
    while (rest.len)
        if (str_equal(concept_next_word(&rest), word))
            return true;
    return false;
}

// "boxes" is "box", "units" is "unit".
static bool is_word(const char *words, str word) {
    bool plural = word.len > 3 && word.ptr[word.len - 1] == 's';
    str one = str_slice(word, 0, word.len - plural);
    str two = str_slice(word, 0, word.len - 2 * plural);
    return is_listed(words, word) ||
           (plural && (is_listed(words, one) || (one.ptr[one.len - 1] == 'e' && is_listed(words, two))));
}

bool concept_is_special(const struct concept *concept) {
    return concept->in != NULL;
}

const struct concept *concept_find(const struct schema_element *element, str word) {
    const struct concept *general = NULL;
    for (const struct concept *c = concepts; word.len && c->title; c++) {
        bool here = !c->in || !element || is_listed(c->in, str_from(element->name));
        if (!here || !is_word(c->words, word))
            continue;
        if (c->in && element)
            return c;
        general = general ? general : c;
    }
    return general;
}

const struct schema_row *concept_use(const struct concept *concept) {
    const char *dot = concept->use ? strchr(concept->use, '.') : NULL;
    if (!dot)
        return NULL;
    str name = {concept->use, (size_t)(dot - concept->use)};
    for (const struct schema_element *const *e = schema_elements; *e; e++) {
        int row = str_equal_cstr(name, (*e)->name) ? schema_find_row(*e, str_from(dot + 1)) : -1;
        if (row >= 0)
            return &(*e)->rows[row];
    }
    return NULL;
}
