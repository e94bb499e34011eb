#include "diag/codes/binding.h"
#include "diag/codes/limit.h"
#include "diag/codes/syntax.h"
#include "parser/yaml/yaml_reader.h"

#include <string.h>

// libyaml's words and ours.
struct yaml_words {
    const char *problem;
    const char *context; // NULL: any
    const char *message;
    const char *note; // at the context's place; NULL: none
    const char *help; // NULL: none
    diag_code code;
    bool at_context; // the mistake is where the context begins
};

#define TAG_HELP "remove the tag; text that begins with '!' needs quotes"

static const struct yaml_words words[] = {
    {"mapping values are not allowed", NULL, "this ':' cannot begin a value here", NULL,
     "put each key on a line of its own, in the same column as its neighbours; text that contains ': ' needs "
     "quotes",
     DIAG_YAML_SYNTAX, false},
    {"block sequence entries are not allowed", NULL, "a list item ('- ') cannot begin here", NULL,
     "begin the list on a line of its own, or write it as [a, b]", DIAG_YAML_SYNTAX, false},
    {"mapping keys are not allowed", NULL, "a key ('? ') cannot begin here", NULL,
     "put the key on a line of its own", DIAG_YAML_SYNTAX, false},
    {"could not find expected ':'", NULL, "a ':' is missing after this key", NULL,
     "write 'key: value', or '- value' for an item of a list", DIAG_YAML_SYNTAX, true},
    {"did not find expected key", NULL, "this does not fit into the map around it", "the map begins here",
     "the keys of a map begin in the same column; what follows quoted text, a bracket or an alias needs a "
     "line of its own",
     DIAG_YAML_SYNTAX, false},
    {"did not find expected '-' indicator", NULL, "this does not fit into the list around it",
     "the list begins here", "the items of a list begin with '- ' in the same column", DIAG_YAML_SYNTAX,
     false},
    {"did not find expected ',' or ']'", NULL, "a ',' or ']' is missing before this", "the list begins here",
     "items are separated by ','; ']' closes the list", DIAG_YAML_SYNTAX, false},
    {"did not find expected ',' or '}'", NULL, "a ',' or '}' is missing before this", "the map begins here",
     "pairs are separated by ','; '}' closes the map", DIAG_YAML_SYNTAX, false},
    {"did not find expected node content", NULL, "a value is missing before this", NULL, NULL,
     DIAG_YAML_SYNTAX, false},
    {"found unexpected end of stream", NULL, "the text that begins here has no closing quote", NULL,
     "close the quotes", DIAG_YAML_SYNTAX, true},
    {"found unexpected document indicator", NULL, "the text that begins here has no closing quote", NULL,
     "close the quotes", DIAG_YAML_SYNTAX, true},
    {"found unknown escape character", NULL, "this escape has no meaning in double quotes",
     "the text begins here", "write '\\\\' for a backslash, or put the text in single quotes",
     DIAG_YAML_SYNTAX, false},
    {"did not find expected hexdecimal number", NULL, "this escape needs hexadecimal digits",
     "the text begins here", "write '\\\\' for a backslash, or put the text in single quotes",
     DIAG_YAML_SYNTAX, false},
    {"found invalid Unicode character escape code", NULL, "this escape does not name a character",
     "the text begins here", "write the character itself", DIAG_YAML_SYNTAX, false},
    {"found unexpected ':'", NULL, "a ':' inside brackets needs a space after it, or quotes around the text",
     NULL, "write 'key: value'", DIAG_YAML_SYNTAX, false},
    {"did not find expected comment or line break", NULL,
     "'|' and '>' begin text that starts on the next line", NULL,
     "text that begins with '|' or '>' needs quotes", DIAG_YAML_SYNTAX, true},
    {"found an indentation indicator equal to 0", NULL, "'|' and '>' begin text that starts on the next line",
     NULL, NULL, DIAG_YAML_SYNTAX, true},
    {"did not find expected alphabetic or numeric character", "while scanning an alias",
     "'*' begins an alias, but no name follows", NULL, "text that begins with '*' needs quotes",
     DIAG_YAML_SYNTAX, true},
    {"did not find expected alphabetic or numeric character", "while scanning an anchor",
     "'&' begins an anchor, but no name follows", NULL, "text that begins with '&' needs quotes",
     DIAG_YAML_SYNTAX, true},
    {"found undefined tag handle", NULL, "this tag has no meaning in a scene", NULL, TAG_HELP, DIAG_YAML_TAG,
     false},
    {"", "while scanning a tag", "this tag has no meaning in a scene", NULL, TAG_HELP, DIAG_YAML_TAG, true},
    {"", "while parsing a tag", "this tag has no meaning in a scene", NULL, TAG_HELP, DIAG_YAML_TAG, true},
    {"found incompatible YAML document", NULL, "this version of YAML is not supported", NULL,
     "remove the %YAML line", DIAG_YAML_SYNTAX, false},
    {"", "while scanning a directive", "a line that begins with '%' is not allowed", NULL, "remove the line",
     DIAG_YAML_SYNTAX, true},
    {"", "while scanning a %YAML directive", "this line is not allowed", NULL, "remove the line",
     DIAG_YAML_SYNTAX, true},
    {"", "while scanning a %TAG directive", "this line is not allowed", NULL, "remove the line",
     DIAG_YAML_SYNTAX, true},
    {"", "while parsing a %TAG directive", "this line is not allowed", NULL, "remove the line",
     DIAG_YAML_SYNTAX, true},
    {"found duplicate", NULL, "this line is given twice", NULL, "remove the line", DIAG_YAML_SYNTAX, false},
    {"did not find expected <document start>", NULL, "this comes after the end of the scene", NULL,
     "a scene file is one map of keys and values", DIAG_YAML_SYNTAX, false},
};

static const struct yaml_words *find_words(const char *problem, const char *context) {
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        const struct yaml_words *row = &words[i];
        if (strncmp(problem, row->problem, strlen(row->problem)) == 0 &&
            (!row->context || (context && strcmp(context, row->context) == 0)))
            return row;
    }
    return NULL;
}

// One character, or nothing at a line's end.
static span character_at(const struct yaml_reader *r, uint32_t at) {
    str text = r->text->bytes;
    uint32_t length =
        at < text.len && !char_is_break(text.ptr[at]) ? (uint32_t)utf8_sequence_length(text, at) : 0;
    return yaml_span(r, at, at + length);
}

// From `at` to the space or line end after it.
static span word_at(const struct yaml_reader *r, uint32_t at) {
    str text = r->text->bytes;
    uint32_t end = at;
    while (end < text.len && !char_is_space(text.ptr[end]))
        end++;
    return yaml_span(r, at, end);
}

// Whether only spaces, line ends and comments follow.
static bool at_end(const struct yaml_reader *r, uint32_t at) {
    str text = r->text->bytes;
    for (; at < text.len; at++) {
        if (text.ptr[at] == '#')
            while (at + 1 < text.len && !char_is_break(text.ptr[at + 1]))
                at++;
        else if (!char_is_space(text.ptr[at]))
            return false;
    }
    return true;
}

void yaml_report_document(struct yaml_reader *r, uint32_t at) {
    diag_add(&r->sink, DIAG_SECOND_DOCUMENT, word_at(r, at),
             "a second document begins here; a scene file has only one");
    diag_help(&r->sink, "put it into a file of its own; 'include' joins files");
}

// Whether the text between two places of one line is blank.
static bool only_blanks(const struct yaml_reader *r, uint32_t begin, uint32_t end) {
    for (uint32_t at = begin; at < end; at++)
        if (!char_is_blank(yaml_char(r, at)))
            return false;
    return begin <= end;
}

static tree_index last_child(const struct tree *tree, tree_index node) {
    tree_index last = 0;
    for (tree_index child = tree_first(tree, node); child; child = tree_next(tree, child))
        last = child;
    return last;
}

void yaml_blame(struct yaml_reader *r) {
    // The missing parts of these probably come after the mistake.
    for (tree_index node = r->closed; node; node = last_child(r->tree, node)) {
        if (tree_node(r->tree, node)->style != TREE_BLOCK)
            break;
        tree_node(r->tree, node)->flags |= TREE_CUT;
    }
    if (!r->last_scalar)
        return;
    struct tree_node *node = tree_node(r->tree, r->last_scalar);
    if (only_blanks(r, node->end, yaml_byte(r, r->parser.problem_mark)))
        node->flags |= TREE_BAD;
}

static str rest_of_line(const struct yaml_reader *r, uint32_t at) {
    uint32_t end = at;
    while (end < r->text->bytes.len && !char_is_break(yaml_char(r, end)))
        end++;
    return str_slice(r->text->bytes, at, end);
}

// Whether `c` is the last character before `at`, not counting spaces.
static bool precedes(const struct yaml_reader *r, uint32_t at, char c) {
    while (at > r->text->begin && char_is_blank(yaml_char(r, at - 1)))
        at--;
    return at > r->text->begin && yaml_char(r, at - 1) == c;
}

static uint32_t line_begin(const struct yaml_reader *r, uint32_t at) {
    while (at > r->text->begin && !char_is_break(yaml_char(r, at - 1)))
        at--;
    return at;
}

// Where the text of the line with `at` begins, which is not after it.
static uint32_t text_begin(const struct yaml_reader *r, uint32_t at) {
    uint32_t begin = line_begin(r, at);
    while (begin < at && char_is_blank(yaml_char(r, begin)))
        begin++;
    return begin;
}

// How a key and the value after it are written.
static void help_pair(struct yaml_reader *r, str key, str value) {
    static const char *const remarks[] = {"//", "/*", "--", ";"};
    for (size_t i = 0; i < sizeof remarks / sizeof *remarks; i++) {
        if (!str_starts_with(key, str_from(remarks[i])))
            continue;
        diag_help(&r->sink, "a comment begins with '#'");
        return;
    }
    value = str_trim(value);
    if (value.len && value.ptr[0] == '=')
        value = str_trim(str_slice(value, 1, value.len));
    diag_help(&r->sink, "write '%.*s:%s%.*s'", STR_ARG(reader_clip(key)), value.len ? " " : "",
              STR_ARG(reader_clip(value)));
}

// "glint:1" or "camera" on the line above: YAML reads it as the beginning of text that continues here.
static bool report_line_above(struct yaml_reader *r, uint32_t at) {
    uint32_t end = line_begin(r, at);
    while (end > r->text->begin && char_is_space(yaml_char(r, end - 1)))
        end--;
    uint32_t begin = line_begin(r, end);
    while (begin < end && yaml_is_indent(r, begin))
        begin++;
    uint32_t stop = begin;
    while (stop < end && !char_is_blank(yaml_char(r, stop)) && yaml_char(r, stop) != ':')
        stop++;
    str word = str_slice(r->text->bytes, begin, stop);
    const struct tree_node *text = tree_node(r->tree, r->last_scalar);
    bool goes_on = r->last_scalar && text->style == TREE_PLAIN && text->begin == begin && text->end > end;
    if ((begin < r->gap && !goes_on) || !str_is_name(word))
        return false;
    bool colon = yaml_char(r, stop) == ':';
    diag_add(&r->sink, DIAG_YAML_SYNTAX, yaml_span(r, begin, colon ? end : stop),
             colon ? "a space is missing after the ':'" : "a ':' is missing after this key");
    help_pair(r, word, str_slice(r->text->bytes, colon ? stop + 1 : stop, end));
    diag_fix(&r->sink, colon, yaml_span(r, stop + colon, stop + colon), colon ? STR(" ") : STR(":"));
    return true;
}

// A ':' that does not begin a value: the second on its line, or that of a key in the wrong column.
static void report_colon(struct yaml_reader *r, uint32_t at) {
    if (report_line_above(r, at))
        return;
    uint32_t begin = text_begin(r, at);
    bool second = false;
    for (uint32_t i = begin; i < at && !second; i++)
        second = yaml_char(r, i) == ':' && char_is_blank(yaml_char(r, i + 1));
    if (second) {
        diag_add(&r->sink, DIAG_YAML_SYNTAX, character_at(r, at), "a second ':' on this line");
        diag_help(&r->sink, "put each key on a line of its own; text that contains ': ' needs quotes");
    } else {
        diag_add(&r->sink, DIAG_YAML_SYNTAX, yaml_span(r, begin, at > begin ? at : at + 1),
                 "this key does not fit under the line above it");
        diag_help(&r->sink, "the keys of a map begin in the same column; a key with a map below it has no "
                            "value on its own line");
    }
}

// "-center: ..." as the first key of the map that the error is about.
static bool report_dash(struct yaml_reader *r, uint32_t begin) {
    if (yaml_char(r, begin) != '-' || char_is_blank(yaml_char(r, begin + 1)))
        return false;
    diag_add(&r->sink, DIAG_YAML_SYNTAX, word_at(r, begin), "a space is missing after the '-'");
    diag_help(&r->sink, "write '- %.*s'",
              STR_ARG(reader_clip(str_slice(r->text->bytes, begin + 1, word_at(r, begin).end))));
    diag_fix(&r->sink, !char_is_digit(yaml_char(r, begin + 1)), yaml_span(r, begin + 1, begin + 1), STR(" "));
    return true;
}

// What follows a value on its line.
static void report_behind(struct yaml_reader *r, uint32_t at) {
    uint32_t begin = text_begin(r, at);
    if (yaml_char(r, begin) == '-' && (yaml_char(r, begin + 1) == '{' || yaml_char(r, begin + 1) == '[')) {
        report_dash(r, begin);
        return;
    }
    if (yaml_char(r, at) == '}' || yaml_char(r, at) == ']') {
        diag_add(&r->sink, DIAG_YAML_SYNTAX, character_at(r, at), "this '%c' closes nothing",
                 yaml_char(r, at));
        diag_help(&r->sink, "remove it, or write the '%c' that it closes",
                  yaml_char(r, at) == '}' ? '{' : '[');
        diag_fix(&r->sink, false, character_at(r, at), STR(""));
        return;
    }
    if (yaml_char(r, at) == ',') {
        diag_add(&r->sink, DIAG_YAML_SYNTAX, character_at(r, at), "this ',' separates nothing");
        diag_help(&r->sink, "remove it: outside brackets each entry is on a line of its own");
        diag_fix(&r->sink, true, character_at(r, at), STR(""));
        return;
    }
    diag_add(&r->sink, DIAG_YAML_SYNTAX, word_at(r, at), "this comes after the end of a value");
    diag_help(&r->sink, "put the whole text in quotes; inside single quotes a quote is written ''");
}

// A character that cannot begin a token.
static void report_character(struct yaml_reader *r, uint32_t at) {
    char c = yaml_char(r, at);
    diag_add(&r->sink, DIAG_YAML_SYNTAX, character_at(r, at), "a value cannot begin with this character");
    if (c == '@' || c == '`' || c == '%')
        diag_help(&r->sink, "text that begins with '%c' needs quotes", c);
}

// The brackets that are open at the end of the file; false: there are none.
static bool report_unclosed(struct yaml_reader *r) {
    if (r->depth == 0)
        return false;
    const struct tree_node *node = tree_node(r->tree, r->frames[r->depth - 1].node);
    if (node->style != TREE_FLOW)
        return false;
    bool list = node->kind == TREE_LIST;
    diag_add(&r->sink, DIAG_YAML_SYNTAX, character_at(r, node->begin),
             "the %s that begins here is not closed", list ? "list" : "map");
    diag_help(&r->sink, "write the closing '%c'", list ? ']' : '}');
    return true;
}

// "position:[0, 0, 8]" in brackets, where YAML reads "position:[" as a broken word.
static bool report_glued(struct yaml_reader *r, uint32_t at) {
    uint32_t begin = at;
    while (begin > r->text->begin && !strchr(" \t\r\n,{[", yaml_char(r, begin - 1)))
        begin--;
    str key = str_slice(r->text->bytes, begin, at);
    char next = yaml_char(r, at + 1);
    if (!str_is_name(key) || (next != '[' && next != '{'))
        return false;
    diag_add(&r->sink, DIAG_YAML_SYNTAX, yaml_span(r, begin, at + 1), "a space is missing after the ':'");
    diag_help(&r->sink, "write '%.*s: %c'", STR_ARG(reader_clip(key)), next);
    diag_fix(&r->sink, true, yaml_span(r, at + 1, at + 1), STR(" "));
    return true;
}

static void report_row(struct yaml_reader *r, const struct yaml_words *row, uint32_t problem,
                       uint32_t context) {
    uint32_t at = row->at_context ? context : problem;
    bool word = row->code == DIAG_YAML_TAG || strstr(row->problem, "find expected ':'");
    if (!row->at_context && at_end(r, problem) && report_unclosed(r))
        return;
    if (strstr(row->problem, "unexpected ':'") && report_glued(r, at))
        return;
    if (strstr(row->problem, "mapping values")) {
        report_colon(r, at);
        return;
    }
    bool behind = strstr(row->problem, "expected key") || strstr(row->problem, "'-' indicator") ||
                  strstr(row->problem, "document start");
    if (behind && r->seen_token && !char_is_break(yaml_char(r, r->gap - 1)) &&
        only_blanks(r, r->gap, problem)) {
        report_behind(r, at);
        return;
    }
    if (strstr(row->problem, "expected key") && report_dash(r, context))
        return;
    diag_add(&r->sink, row->code, word ? word_at(r, at) : character_at(r, at), "%s", row->message);
    if (row->note && context != problem)
        diag_note(&r->sink, character_at(r, context), "%s", row->note);
    if (strstr(row->problem, "find expected ':'"))
        help_pair(r, source_text(r->context->sources, word_at(r, at)), rest_of_line(r, word_at(r, at).end));
    else if (strstr(row->problem, "expected ','") && precedes(r, at, '='))
        diag_help(&r->sink, "a key and its value are joined by ':', not by '='");
    else if (strstr(row->problem, "block sequence") && char_is_digit(yaml_char(r, at + 2)))
        diag_help(&r->sink, "a negative number has no space after the '-': -%c", yaml_char(r, at + 2));
    else if (row->help)
        diag_help(&r->sink, "%s", row->help);
}

void yaml_report(struct yaml_reader *r) {
    const yaml_parser_t *p = &r->parser;
    if (p->error == YAML_MEMORY_ERROR) {
        diag_add(&r->sink, DIAG_OUT_OF_MEMORY, yaml_span(r, r->gap, r->gap),
                 "not enough memory to read the file");
        return;
    }
    const char *problem = p->problem ? p->problem : "";
    uint32_t at = yaml_byte(r, p->problem_mark);
    uint32_t context = p->context ? yaml_byte(r, p->context_mark) : at;
    if (p->error == YAML_READER_ERROR)
        at = context = r->text->begin + (uint32_t)p->problem_offset;
    const struct yaml_words *row = find_words(problem, p->context);
    bool told = r->blamed && r->blamed <= at && !memchr(r->text->bytes.ptr + r->blamed, '\n', at - r->blamed);
    if (told)
        return;
    if (r->is_option) {
        diag_add(&r->sink, DIAG_SET_SYNTAX, character_at(r, row && row->at_context ? context : at), "%s",
                 row ? row->message : "the value cannot be read");
        diag_help(&r->sink, "a value is YAML flow text: 1.5, \"text\", [a, b] or {key: value}");
    } else if (row && r->document_end && row->code == DIAG_YAML_SYNTAX && strstr(problem, "document start") &&
               yaml_char(r, r->document_end - 1) == '.') {
        yaml_report_document(r, at);
    } else if (row) {
        report_row(r, row, at, context);
    } else if (strstr(problem, "cannot start any token")) {
        report_character(r, at);
    } else {
        diag_add(&r->sink, DIAG_YAML_SYNTAX, character_at(r, at), "the YAML cannot be read here: %s",
                 problem);
    }
}
