// The plain part of XML, read without expat and several times faster: elements, attributes, comments.
// Anything not certainly well-formed and plain (DOCTYPE, CDATA, text, references by number, line ends in
// values, names beyond ASCII ...) ends it silently, and expat reads the file. A fuzz target checks that both
// make the same tree.
#include "parser/xml/xml_reader.h"

#include <string.h>

enum {
    ATTRIBUTES_MAX = 32,
    DECODED_MAX = 512
};

struct plain {
    struct xml_reader *reader;
    const char *text;
    uint32_t at, end;
};

static bool is_name_start(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static bool is_name(char c) {
    return is_name_start(c) || (c >= '0' && c <= '9') || c == '-' || c == '.' || c == ':';
}

static bool looking_at(const struct plain *p, const char *what) {
    size_t length = strlen(what);
    return p->end - p->at >= length && memcmp(p->text + p->at, what, length) == 0;
}

// Returns whether there was a space. Other bytes are left to the caller.
static bool skip_blanks(struct plain *p) {
    uint32_t begin = p->at;
    while (p->at < p->end && char_is_space(p->text[p->at]))
        p->at++;
    return p->at > begin;
}

// The empty string if there is no name.
static str read_name(struct plain *p) {
    uint32_t begin = p->at;
    if (p->at < p->end && is_name_start(p->text[p->at]))
        while (p->at < p->end && is_name(p->text[p->at]))
            p->at++;
    return (str){p->text + begin, p->at - begin};
}

// ---- attributes

// Decodes the five entities; false for all other references, and if there is no room.
static bool decode(str raw, char *out, size_t *length) {
    static const struct {
        str name;
        char c;
    } entities[] = {{{"&amp;", 5}, '&'},
                    {{"&lt;", 4}, '<'},
                    {{"&gt;", 4}, '>'},
                    {{"&quot;", 6}, '"'},
                    {{"&apos;", 6}, '\''}};
    *length = 0;
    if (raw.len > DECODED_MAX)
        return false;
    while (raw.len) {
        size_t taken = raw.ptr[0] == '&' ? 0 : 1;
        char c = raw.ptr[0];
        for (size_t i = 0; !taken && i < sizeof entities / sizeof *entities; i++)
            if (str_starts_with(raw, entities[i].name)) {
                taken = entities[i].name.len;
                c = entities[i].c;
            }
        if (!taken)
            return false;
        out[(*length)++] = c;
        raw = str_slice(raw, taken, raw.len);
    }
    return true;
}

static bool add(struct plain *p, str name, struct xml_attribute place, bool has_reference) {
    char decoded[DECODED_MAX];
    str value = {p->text + place.value_begin, place.value_end - place.value_begin};
    if (has_reference) {
        size_t length;
        if (!decode(value, decoded, &length))
            return false;
        value = (str){decoded, length};
    }
    xml_add_attribute(p->reader, name, value, place);
    return !p->reader->stopped;
}

// Ends after the closing quote.
static bool read_attribute(struct plain *p, str name) {
    struct xml_attribute place = {.name_end = p->at, .name_begin = p->at - (uint32_t)name.len};
    if (p->end - p->at < 2 || p->text[p->at] != '=')
        return false;
    char quote = p->text[p->at + 1];
    if (quote != '"' && quote != '\'')
        return false;
    bool has_reference = false;
    for (p->at = place.value_begin = p->at + 2;; p->at++) {
        if (p->at == p->end)
            return false;
        char c = p->text[p->at];
        if (c == quote)
            break;
        if (c == '<' || c == '\n' || c == '\t' || c == '\r')
            return false;
        has_reference = has_reference || c == '&';
    }
    place.value_end = p->at++;
    return add(p, name, place, has_reference);
}

// ---- markup

// Reads from after the name to the '>'; *empty: it was '/>'.
static bool skip_to_tag_end(const struct plain *p, uint32_t *end, bool *empty) {
    char quote = '\0';
    for (uint32_t at = p->at; at < p->end; at++) {
        char c = p->text[at];
        if (quote)
            quote = c == quote ? '\0' : quote;
        else if (c == '"' || c == '\'')
            quote = c;
        else if (c == '>') {
            *end = at + 1;
            *empty = p->text[at - 1] == '/';
            return true;
        } else if (c == '<')
            return false;
    }
    return false;
}

static bool is_second(const str *names, uint32_t count, str name) {
    for (uint32_t i = 0; i < count; i++)
        if (str_equal(names[i], name))
            return true;
    return false;
}

static bool read_attributes(struct plain *p, uint32_t end) {
    str names[ATTRIBUTES_MAX];
    for (uint32_t count = 0;; count++) {
        bool blank = skip_blanks(p);
        if (p->at >= end)
            return p->at == end;
        names[count] = read_name(p);
        if (!blank || names[count].len == 0 || is_second(names, count, names[count]) ||
            !read_attribute(p, names[count]) || count + 1 == ATTRIBUTES_MAX)
            return false;
    }
}

// At '<' of an opening tag.
static bool read_opening(struct plain *p) {
    uint32_t begin = p->at++;
    str name = read_name(p);
    uint32_t end;
    bool empty;
    if (name.len == 0 || !skip_to_tag_end(p, &end, &empty))
        return false;
    if (!xml_open(p->reader, (struct reader_range){begin, end}, name) ||
        !read_attributes(p, end - (empty ? 2 : 1)))
        return false;
    xml_opened(p->reader);
    p->at = end;
    if (empty)
        xml_close(p->reader, end);
    return !p->reader->stopped;
}

// At '</'.
static bool read_closing(struct plain *p) {
    struct xml_reader *r = p->reader;
    p->at += 2;
    if (r->depth == 0)
        return false;
    span opened = r->frames[r->depth - 1].name;
    str name = read_name(p);
    skip_blanks(p);
    if (!str_equal(name, str_slice(r->text->bytes, opened.begin, opened.end)) || p->at == p->end ||
        p->text[p->at] != '>')
        return false;
    xml_close(r, ++p->at);
    return !r->stopped;
}

// At '<!--'.
static bool read_comment(struct plain *p) {
    uint32_t begin = p->at;
    for (p->at += 4; p->at < p->end && !looking_at(p, "--"); p->at++)
        ;
    if (!looking_at(p, "-->"))
        return false;
    p->at += 3;
    xml_see_comment(p->reader, begin, p->at);
    return true;
}

// At '<?': the editor's line, or the declaration as it is nearly always written.
static bool read_instruction(struct plain *p) {
    static const char *const declarations[] = {"<?xml version=\"1.0\"?>",
                                               "<?xml version=\"1.0\" encoding=\"UTF-8\"?>",
                                               "<?xml version=\"1.0\" encoding=\"utf-8\"?>"};
    uint32_t begin = p->at;
    for (size_t i = 0; i < sizeof declarations / sizeof *declarations; i++)
        if (begin == p->reader->text->begin && looking_at(p, declarations[i])) {
            p->at += (uint32_t)strlen(declarations[i]);
            return true;
        }
    if (!looking_at(p, "<?xml-model "))
        return false;
    while (p->at < p->end && !looking_at(p, "?>"))
        p->at++;
    if (p->at == p->end)
        return false;
    p->at += 2;
    xml_see_instruction(p->reader, STR("xml-model"), begin, p->at);
    return true;
}

static bool read_markup(struct plain *p) {
    if (p->end - p->at < 2 || p->text[p->at] != '<')
        return false;
    switch (p->text[p->at + 1]) {
    case '/':
        return read_closing(p);
    case '!':
        return looking_at(p, "<!--") && read_comment(p);
    case '?':
        return read_instruction(p);
    default:
        return (p->reader->depth > 0 || !p->reader->tree->root) && read_opening(p);
    }
}

bool xml_read_plain(struct xml_reader *r) {
    struct plain p = {
        .reader = r, .text = r->text->bytes.ptr, .at = r->text->begin, .end = (uint32_t)r->text->bytes.len};
    for (skip_blanks(&p); p.at < p.end; skip_blanks(&p))
        if (!read_markup(&p))
            return false;
    return r->depth == 0 && r->tree->root;
}
