#include "tests/generate/mutate.h"

#include "tests/unit/kit/random.h"

enum {
    CHANGES_MAX = 4
};

struct mutation {
    uint64_t *state;
    str text;
    struct strbuf *out;
};

static size_t below(const struct mutation *m, size_t limit) {
    return limit ? (size_t)((random_bits(m->state) >> 16) % limit) : 0;
}

#define CR  "\r"
#define NEL "\xC2\x85"
#define LS  "\xE2\x80\xA8"
#define PS  "\xE2\x80\xA9"

static const char *const breaks[] = {"\n", CR, "\r\n", NEL, LS, PS, "\n\n", "\n" CR, CR CR};

static const char *a_break(const struct mutation *m) {
    return breaks[below(m, sizeof breaks / sizeof *breaks)];
}

// What begins, ends and joins things in either spelling.
static const char *a_piece(const struct mutation *m) {
    static const char *const pieces[] = {
        "#",        " # ",      "<!--", "-->",   "--",     "-",    "\\",       "-\\-",       " ",
        "\t",       ":",        ": ",   "- ",    ",",      "[",    "]",        "{",          "}",
        "\"",       "'",        "|\n",  ">-\n",  "&a ",    "*a",   "<<: *a",   "---\n",      "...\n",
        "%YAML ",   "<",        "/>",   "&#13;", "&#133;", "&lt;", "<?x y?>",  "x-note: ",   "\xEF\xBB\xBF",
        "\xC3\xA9", "glint: 1", "0",    "nan",   "true",   "~",    "<Light/>", "lights: []", "description: ",
    };
    return pieces[below(m, sizeof pieces / sizeof *pieces)];
}

// A comment of several lines, of which all but the first look like content; in the spelling of the text.
static void put_comment(const struct mutation *m, bool is_xml) {
    static const char *const contents[] = {
        " words",  " - {position: [9, 9, 9]}", " glint: 2", " key: value", "   ", " # no comment",
        " a -- b", " <Light x=\"1\"/>",        " -\\-"};
    strbuf_cstr(m->out, is_xml ? "<!--" : "#");
    for (size_t lines = 1 + below(m, 4); lines; lines--) {
        strbuf_cstr(m->out, contents[below(m, sizeof contents / sizeof *contents)]);
        if (lines > 1)
            strbuf_cstr(m->out, is_xml ? a_break(m) : " ");
    }
    strbuf_cstr(m->out, is_xml ? "-->" : a_break(m));
}

// A place at the beginning of a line, where comments are.
static size_t a_line(const struct mutation *m) {
    size_t at = below(m, m->text.len + 1);
    while (at > 0 && m->text.ptr[at - 1] != '\n')
        at--;
    return at;
}

static void put_changed_breaks(const struct mutation *m) {
    const char *all = a_break(m);
    bool some = below(m, 2);
    for (size_t i = 0; i < m->text.len; i++)
        if (m->text.ptr[i] == '\n' && (!some || below(m, 3) == 0))
            strbuf_cstr(m->out, all);
        else
            strbuf_char(m->out, m->text.ptr[i]);
}

static void put(const struct mutation *m, size_t begin, size_t end) {
    strbuf_str(m->out, str_slice(m->text, begin, end));
}

static void change(const struct mutation *m) {
    size_t size = m->text.len, at = below(m, size + 1);
    size_t most = size - at < 24 ? size - at : 24;
    size_t end = at + below(m, most + 1);
    size_t from = below(m, size + 1);
    bool is_xml = memchr(m->text.ptr, '<', size) != NULL && str_starts_with(str_trim(m->text), STR("<"));
    // Comments and line ends most often: what follows them can still be read.
    static const char kinds[] = "LLCCCCcbbpPTd";
    char kind = kinds[below(m, sizeof kinds - 1)];
    if (kind == 'L') {
        put_changed_breaks(m);
        return;
    }
    if (kind == 'C') // between lines
        at = a_line(m);
    if (strchr("Ccbp", kind))
        end = at;
    put(m, 0, at);
    if (kind == 'C' || kind == 'c')
        put_comment(m, is_xml);
    else if (kind == 'b')
        strbuf_cstr(m->out, a_break(m));
    else if (kind == 'p' || kind == 'P')
        strbuf_cstr(m->out, a_piece(m));
    else if (kind == 'T')
        put(m, from, from + 24);
    put(m, end, size);
}

void mutate_text(uint64_t *state, str text, struct strbuf *out) {
    struct strbuf before;
    strbuf_init(&before);
    strbuf_clear(out);
    strbuf_str(out, text);
    struct mutation m = {.state = state, .out = out};
    for (size_t changes = 1 + below(&m, CHANGES_MAX); changes; changes--) {
        strbuf_clear(&before);
        strbuf_str(&before, strbuf_view(out));
        m.text = strbuf_view(&before);
        strbuf_clear(out);
        change(&m);
    }
    out->failed = out->failed || before.failed;
    strbuf_finish(&before);
}
