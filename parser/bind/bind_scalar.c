// One value of one row: numbers, words, booleans, text. Each mistake gets its message and, if the right text
// is known, a fix.
#include "diag/codes/binding.h"
#include "diag/codes/syntax.h"
#include "parser/bind/bind.h"
#include "parser/bind/say.h"
#include "parser/tree/mend.h"

#include "core/angle.h"
#include "core/heap.h"
#include "core/nearest.h"
#include "core/number.h"
#include "grammar/ir_copies.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool bind_no_value(struct bind_context *context, struct bind_subject subject, tree_index node) {
    if (bind_is_known(context, node))
        return false;
    str s = say_subject(context->scratch, subject);
    diag_add(context->sink, DIAG_NO_VALUE, tree_span(context->tree, node), "%.*s has no value", STR_ARG(s));
    bool is_text = subject.row && (subject.row->kind == SCHEMA_TEXT || subject.row->kind == SCHEMA_REFERENCE);
    if (is_text && tree_text(context->tree, node).len > 1)
        diag_help(context->sink, "'%.*s' means no value: leave the key out, or quote it if you mean the word",
                  STR_ARG(tree_text(context->tree, node)));
    else if (subject.row && subject.row->required)
        bind_help_example(context, subject);
    else if (!subject.row && subject.frame->via->many == SCHEMA_SEQUENCE)
        diag_help(context->sink, "write the entry, or remove the '-'");
    else if (!subject.row && schema_short_row(subject.frame->schema) < 0)
        diag_help(context->sink, "write {} for the defaults, or leave the key out");
    else
        diag_help(context->sink, "write the value, or leave the key out");
    return false;
}

// One number where several belong: perhaps it is meant for each.
static void fix_scalar(struct bind_context *context, const struct schema_row *row, tree_index node,
                       str text) {
    double ignored;
    if ((row->kind != SCHEMA_VECTOR && row->kind != SCHEMA_PAIR) || context->tree->is_xml ||
        number_parse(text, &ignored) != NUMBER_OK || tree_node(context->tree, node)->style != TREE_PLAIN)
        return;
    // A turn by a single angle is about the vertical axis.
    str all = row->kind == SCHEMA_PAIR
                  ? arena_format(context->scratch, "[%.*s, %.*s]", STR_ARG(text), STR_ARG(text))
              : row->unit == SCHEMA_UNIT_DEGREES
                  ? arena_format(context->scratch, "[0, %.*s, 0]", STR_ARG(text))
                  : arena_format(context->scratch, "[%.*s, %.*s, %.*s]", STR_ARG(text), STR_ARG(text),
                                 STR_ARG(text));
    diag_fix(context->sink, false, tree_span(context->tree, node), all);
}

enum {
    PARENTHESIS_MAX = 256 // bytes
};

// "(0, 0, 2)": YAML splits it at its commas. The span of all of it, if it ends on its line.
static span with_parenthesis(const struct bind_context *context, tree_index node) {
    span at = tree_span(context->tree, node);
    str rest = context->sources->items[at.source].text;
    size_t most = at.begin + PARENTHESIS_MAX < rest.len ? at.begin + PARENTHESIS_MAX : rest.len;
    for (uint32_t i = at.begin; i < most && rest.ptr[at.begin] == '(' && rest.ptr[i] != '\n'; i++)
        if (rest.ptr[i] == ')')
            return (span){at.source, at.begin, i + 1};
    return at;
}

bool bind_help_numbers(struct bind_context *context, struct bind_subject subject, tree_index node) {
    const struct schema_row *row = subject.row;
    enum tree_kind kind = bind_kind(context, node);
    if (!row || subject.component || kind == TREE_NULL)
        return false;
    span at = context->tree->is_xml ? tree_span(context->tree, node) : with_parenthesis(context, node);
    bool parted = at.end != tree_span(context->tree, node).end;
    str text =
        kind == TREE_SCALAR && !parted ? tree_text(context->tree, node) : source_text(context->sources, at);
    str list = mend_numbers(context->scratch, text,
                            schema_component_count(row->kind) ? schema_component_count(row->kind) : 3);
    if (list.len == 0 || !schema_components(row->kind)[0]) {
        fix_scalar(context, row, node, text);
        return false;
    }
    if (context->tree->is_xml) {
        str child = say_components(context->scratch, subject, list);
        diag_help(context->sink, "write %.*s", STR_ARG(child));
        if (kind == TREE_SCALAR && !subject.component)
            bind_fix_as_child(context, node, child);
        return true;
    }
    str value = arena_format(context->scratch, "[%.*s]", STR_ARG(list));
    diag_help(context->sink, "write %.*s", STR_ARG(value));
    diag_fix(context->sink, true, at, value);
    return true;
}

void bind_help_shape(struct bind_context *context, struct bind_subject subject, tree_index node) {
    if (!bind_help_numbers(context, subject, node))
        bind_help_example(context, subject);
}

void bind_help_example(struct bind_context *context, struct bind_subject subject) {
    diag_help(context->sink, "for example %.*s",
              STR_ARG(say_subject_example(context->scratch, subject, context->tree->is_xml)));
}

// The kind of a node, in words that fit both spellings.
static str found(struct bind_context *context, tree_index node) {
    const struct tree_node *n = tree_node(context->tree, node);
    if (n->kind == TREE_SCALAR)
        return arena_format(context->scratch, "'%.*s'",
                            STR_ARG(say_text(context->scratch, tree_text(context->tree, node))));
    if (n->kind == TREE_LIST)
        return STR("a list");
    return n->count ? STR("a group of attributes") : STR("an empty group");
}

// Lines of "radius:1" with a space after each ':'; empty if one of them is not of that kind.
static str with_blanks(struct arena *arena, const struct schema_element *schema, str lines) {
    char *all = arena_alloc(arena, heap_times(2, lines.len) + 1);
    size_t length = 0;
    while (lines.len) {
        const char *line_end = memchr(lines.ptr, '\n', lines.len);
        str line = str_slice(lines, 0, line_end ? (size_t)(line_end - lines.ptr) + 1 : lines.len);
        const char *colon = memchr(line.ptr, ':', line.len);
        bool single;
        if (!colon ||
            schema_find_yaml(schema, str_trim(str_slice(line, 0, (size_t)(colon - line.ptr))), &single) < 0)
            return STR("");
        size_t end = (size_t)(colon - line.ptr) + 1;
        memcpy(all + length, line.ptr, end);
        all[length + end] = ' ';
        memcpy(all + length + end + 1, line.ptr + end, line.len - end);
        length += line.len + 1;
        lines = str_slice(lines, line.len, lines.len);
    }
    return (str){all, length};
}

// "position [0, 5, 5]" or "radius:1" where a map belongs: a key without its ':', or without the space after
// it.
static bool help_pair(struct bind_context *context, struct bind_subject subject, tree_index node) {
    const struct schema_element *schema = subject.row ? subject.row->child : subject.frame->schema;
    if (!schema || context->tree->is_xml || bind_kind(context, node) != TREE_SCALAR)
        return false;
    str text = tree_text(context->tree, node);
    size_t end = 0;
    while (end < text.len && text.ptr[end] != ' ' && text.ptr[end] != ':')
        end++;
    str name = str_slice(text, 0, end);
    bool single;
    if (end == text.len || schema_find_yaml(schema, name, &single) < 0)
        return false;
    str written = source_text(context->sources, tree_span(context->tree, node));
    const char *line_end = memchr(written.ptr, '\n', written.len);
    str line = str_trim(str_slice(written, 0, line_end ? (size_t)(line_end - written.ptr) : written.len));
    str value = str_trim(str_slice(line, end + 1 < line.len ? end + 1 : line.len, line.len));
    diag_help(context->sink, "write '%.*s: %.*s'", STR_ARG(name), STR_ARG(say_text(context->scratch, value)));
    str mended = with_blanks(context->scratch, schema, written);
    if (mended.len)
        diag_fix(context->sink, true, tree_span(context->tree, node), mended);
    return true;
}

bool bind_wrong_shape(struct bind_context *context, struct bind_subject subject, tree_index node) {
    if (bind_is_known(context, node))
        return false;
    if (tree_node(context->tree, node)->kind == TREE_NULL)
        return bind_no_value(context, subject, node);
    bool is_entry = !subject.row && subject.frame->via->many != SCHEMA_ONE;
    str s = say_subject(context->scratch, subject);
    str expected = is_entry ? STR("a group of attributes") : say_expected_of(context->scratch, subject);
    diag_add(context->sink, DIAG_WRONG_SHAPE, tree_span(context->tree, node), "%.*s must be %.*s, not %.*s",
             STR_ARG(s), STR_ARG(expected), STR_ARG(found(context, node)));
    if (!help_pair(context, subject, node))
        bind_help_shape(context, subject, node);
    return false;
}

// Numbers.

// false: the right number is not known.
static bool number_fix(struct bind_context *context, bool integer, enum number_status status, str text,
                       span at) {
    str mended = mend_number(context->scratch, status, text);
    double ignored;
    int64_t whole;
    enum number_status good = integer ? number_parse_integer(mended, &whole) : number_parse(mended, &ignored);
    if (good != NUMBER_OK)
        return false;
    bool safe = status == NUMBER_UNDERSCORE || status == NUMBER_HEX || status == NUMBER_LEADING_ZERO ||
                status == NUMBER_DASH;
    diag_help(context->sink, "write %.*s", STR_ARG(mended));
    diag_fix(context->sink, safe, at, mend_like(context->scratch, source_text(context->sources, at), mended));
    return true;
}

static bool bad_number(struct bind_context *context, struct bind_subject subject, tree_index node,
                       enum number_status status) {
    str text = tree_text(context->tree, node);
    str s = say_subject(context->scratch, subject);
    span at = tree_span(context->tree, node);
    if (text.len == 0) {
        diag_add(context->sink, DIAG_BAD_NUMBER, at, "%.*s is empty; it must be a number", STR_ARG(s));
        return false;
    }
    bool three = status == NUMBER_COMMA && !subject.component && mend_numbers(context->scratch, text, 3).len;
    if ((status == NUMBER_UNIT && mend_is_numbers(text)) || three)
        return bind_wrong_shape(context, subject, node);
    diag_add(context->sink, DIAG_BAD_NUMBER, at, "%.*s: '%.*s' %s", STR_ARG(s),
             STR_ARG(say_text(context->scratch, text)), number_problem(status));
    if (!number_fix(context, subject.row->kind == SCHEMA_INTEGER, status, text, at))
        bind_help_example(context, subject);
    return false;
}

// A number or boolean in quotes is text in YAML.
static bool quoted(struct bind_context *context, struct bind_subject subject, tree_index node,
                   const char *what) {
    str s = say_subject(context->scratch, subject);
    str text = tree_text(context->tree, node);
    span at = tree_span(context->tree, node);
    diag_add(context->sink, DIAG_QUOTED_VALUE, at, "%.*s is in quotes, which makes it text; it must be %s",
             STR_ARG(s), what);
    diag_help(context->sink, "write %.*s", STR_ARG(say_text(context->scratch, text)));
    diag_fix(context->sink, true, at, text);
    return false;
}

static bool out_of_range(struct bind_context *context, struct bind_subject subject, tree_index node) {
    const struct schema_row *row = subject.row;
    str s = say_subject(context->scratch, subject);
    str text = say_text(context->scratch, tree_text(context->tree, node));
    span at = tree_span(context->tree, node);
    const struct schema_range_info *range = schema_range_info(row->range);
    if (row->range == SCHEMA_RANGE_VERSION) {
        context->other_version = true;
        diag_add(context->sink, DIAG_BAD_VERSION, at,
                 "the file uses version %.*s of the language; this program reads version %s", STR_ARG(text),
                 range->text);
        diag_help(context->sink, "use a newer glint, or correct the number");
        return false;
    }
    diag_add(context->sink, DIAG_OUT_OF_RANGE, at, "%.*s is %.*s; it must be %s%s", STR_ARG(s), STR_ARG(text),
             range->text, say_unit(row));
    bool single = row->kind == SCHEMA_NUMBER || row->kind == SCHEMA_INTEGER;
    str doc = say_doc(context->scratch, row->doc);
    if (row->standard && single)
        diag_help(context->sink, "'%s': %.*s; the default is %s", row->name, STR_ARG(doc), row->standard);
    else if (single)
        diag_help(context->sink, "'%s': %.*s", row->name, STR_ARG(doc));
    return false;
}

static bool is_scalar(struct bind_context *context, struct bind_subject subject, tree_index node) {
    if (bind_is_known(context, node))
        return false;
    if (tree_node(context->tree, node)->kind != TREE_SCALAR)
        return bind_wrong_shape(context, subject, node);
    return true;
}

// Which multiple of pi/12 (15 degrees) the text is, correct to all its decimals; 0: none. With fewer than
// three decimals only the best known ones count.
static int written_radians(str text, double value) {
    double size = fabs(value), parts = nearbyint(size * 12 / PI);
    double error = fabs(size - parts * PI / 12);
    if (!(parts >= 1 && parts <= 24 && error <= 0.005))
        return 0;
    size_t point = 0;
    while (point < text.len && text.ptr[point] != '.')
        point++;
    size_t decimals = text.len > point ? text.len - point - 1 : 0;
    for (size_t i = 0; i < text.len; i++)
        if (text.ptr[i] == 'e' || text.ptr[i] == 'E')
            return 0;
    bool known = decimals == 2 && (parts == 6 || parts == 12 || parts == 24);
    bool exact = error <= 0.5 * pow(10, -(double)(decimals < 12 ? decimals : 12));
    return exact && (known || decimals >= 3) ? (int)parts : 0;
}

static void check_angle(struct bind_context *context, struct bind_subject subject, tree_index node,
                        double value) {
    int parts =
        subject.row->unit == SCHEMA_UNIT_DEGREES ? written_radians(tree_text(context->tree, node), value) : 0;
    if (parts == 0)
        return;
    str degrees = arena_format(context->scratch, "%s%d", value < 0 ? "-" : "", parts * 15);
    diag_add(context->sink, DIAG_RADIANS, tree_span(context->tree, node),
             "%.*s is %.*s degrees, which looks like %.*s degrees in radians",
             STR_ARG(say_subject(context->scratch, subject)), STR_ARG(tree_text(context->tree, node)),
             STR_ARG(degrees));
    diag_help(context->sink, "angles are in degrees: write %.*s", STR_ARG(degrees));
    diag_fix(context->sink, false, tree_span(context->tree, node), degrees);
}

bool bind_number(struct bind_context *context, struct bind_subject subject, tree_index node, double *out) {
    if (!is_scalar(context, subject, node))
        return false;
    bool integer = subject.row->kind == SCHEMA_INTEGER;
    str text = tree_text(context->tree, node);
    int64_t whole = 0;
    double value = 0;
    enum number_status status = integer ? number_parse_integer(text, &whole) : number_parse(text, &value);
    if (integer)
        value = (double)whole;
    bool is_quoted = tree_node(context->tree, node)->style == TREE_QUOTED;
    if (is_quoted && status == NUMBER_OK)
        return quoted(context, subject, node, integer ? "a whole number" : "a number");
    if (status != NUMBER_OK && bind_formula(context, subject, node)) {
        *out = 0;
        return true;
    }
    if (status != NUMBER_OK)
        return bad_number(context, subject, node, status);
    if (!schema_in_range(subject.row->range, value))
        return out_of_range(context, subject, node);
    check_angle(context, subject, node, value);
    *out = value;
    return true;
}

// Booleans and words.

static bool bind_boolean(struct bind_context *context, struct bind_subject subject, tree_index node,
                         bool *out) {
    str text = tree_text(context->tree, node);
    bool is_true = str_equal(text, STR("true"));
    if (is_true || str_equal(text, STR("false"))) {
        if (tree_node(context->tree, node)->style == TREE_QUOTED)
            return quoted(context, subject, node, "a boolean");
        *out = is_true;
        return true;
    }
    if (bind_formula(context, subject, node)) {
        *out = false;
        return true;
    }
    str s = say_subject(context->scratch, subject);
    span at = tree_span(context->tree, node);
    diag_add(context->sink, DIAG_BAD_BOOLEAN, at, "%.*s is '%.*s'; it must be true or false", STR_ARG(s),
             STR_ARG(say_text(context->scratch, text)));
    str mended = mend_boolean(text);
    if (mended.len) {
        diag_help(context->sink, "write %.*s", STR_ARG(mended));
        str written = source_text(context->sources, at);
        diag_fix(context->sink, true, at,
                 context->tree->is_xml ? mend_like(context->scratch, written, mended) : mended);
    }
    return false;
}

static bool bind_word(struct bind_context *context, struct bind_subject subject, tree_index node,
                      unsigned *out) {
    const char *const *words = subject.row->words;
    str text = tree_text(context->tree, node);
    struct mend_search search = mend_begin(context->sink, context->scratch, text);
    for (unsigned i = 0; words[i]; i++) {
        if (str_equal_cstr(text, words[i])) {
            *out = i;
            return true;
        }
        mend_offer(&search, words[i], (int)i);
    }
    str s = say_subject(context->scratch, subject);
    span at = tree_span(context->tree, node);
    diag_add(context->sink, DIAG_BAD_CHOICE, at, "%.*s is '%.*s'; it must be %.*s", STR_ARG(s),
             STR_ARG(say_text(context->scratch, text)), STR_ARG(say_words(context->scratch, words)));
    if (search.best) {
        diag_help(context->sink, "did you mean '%s'?", search.best);
        diag_fix(context->sink, mend_is_safe(&search), at,
                 mend_like(context->scratch, source_text(context->sources, at), str_from(search.best)));
    }
    return false;
}

// Text.

// Of a body, which may be in objects, with the places of copies: chairs[3]/seat.
static bool is_whole_name(str text) {
    for (;;) {
        const char *slash = text.len ? memchr(text.ptr, '/', text.len) : NULL;
        if (!str_is_name(ir_copies_base(slash ? str_slice(text, 0, (size_t)(slash - text.ptr)) : text)))
            return false;
        if (!slash)
            return true;
        text = str_slice(text, (size_t)(slash - text.ptr) + 1, text.len);
    }
}

bool bind_name_text(struct bind_context *context, struct bind_subject subject, str text, span at) {
    enum schema_text kind = subject.row->text;
    bool may_be_empty = subject.row->kind == SCHEMA_TEXT && kind == SCHEMA_TEXT_FREE;
    if (text.len == 0 && !may_be_empty) {
        diag_add(context->sink, DIAG_EMPTY_TEXT, at, "%.*s is empty",
                 STR_ARG(say_subject(context->scratch, subject)));
        bool is_map_key = subject.row->key && !context->tree->is_xml && subject.frame->via;
        bind_help_example(context,
                          is_map_key ? bind_subject(subject.frame->parent, subject.frame->via) : subject);
        return false;
    }
    const bool is_name = kind == SCHEMA_TEXT_NAME || kind == SCHEMA_TEXT_BODY_NAME;
    if (subject.row->kind != SCHEMA_TEXT || !is_name ||
        (kind == SCHEMA_TEXT_BODY_NAME ? is_whole_name(text)
                                       : str_is_name(subject.row->counted ? ir_copies_base(text) : text)))
        return true;
    diag_add(context->sink, DIAG_BAD_NAME, at, "'%.*s' is not a name",
             STR_ARG(say_text(context->scratch, text)));
    bool quotes = mend_quotes(text).len < text.len;
    str mended = mend_name(context->scratch, mend_quotes(text));
    bool has_fix = str_is_name(mended);
    diag_help(context->sink,
              "a name has 1 to 128 letters, digits, '_' or '-', and does not begin with a digit%s%.*s%s",
              has_fix ? "; for example '" : "",
              STR_ARG(has_fix ? say_text(context->scratch, mended) : STR("")), has_fix ? "'" : "");
    if (has_fix)
        diag_fix(context->sink, quotes && str_equal(mended, mend_quotes(text)), at,
                 mend_like(context->scratch, source_text(context->sources, at), mended));
    return false;
}

static bool bind_text(struct bind_context *context, struct bind_subject subject, tree_index node, str *out) {
    str text = tree_text(context->tree, node);
    bool good = bind_name_text(context, subject, text, tree_span(context->tree, node));
    // A bad name is kept, so that references to it are not reported as well.
    bool is_path = subject.row->text == SCHEMA_TEXT_PATH;
    if (good || subject.row->text == SCHEMA_TEXT_NAME)
        *out = is_path ? bind_copy_once(context, text) : arena_copy(context->arena, text);
    return good;
}

bool bind_scalar(struct bind_context *context, struct bind_subject subject, tree_index node, void *out) {
    if (!is_scalar(context, subject, node))
        return false;
    double number;
    switch (subject.row->kind) {
    case SCHEMA_BOOLEAN:
        return bind_boolean(context, subject, node, out);
    case SCHEMA_INTEGER:
        if (!bind_number(context, subject, node, &number))
            return false;
        *(int32_t *)out = (int32_t)number;
        return true;
    case SCHEMA_NUMBER:
        if (!bind_number(context, subject, node, &number))
            return false;
        *(double *)out = number;
        return true;
    case SCHEMA_WORD:
        return bind_word(context, subject, node, out);
    default:
        return bind_text(context, subject, node, out);
    }
}
