// The tables of verdicts: run_verdicts check|show FILE
//
// A table holds many small files and what is to be said of each. A case begins with a line
//     @@FLAGS VERDICT: title
// followed by its text. VERDICT is "ok" or the codes of all errors and warnings in the order of their places,
// with commas between. FLAGS: '+' writes the text into a scene (YAML: behind "glint: 1"; XML: in <Scene>),
// 'x' turns \xHH and \n of the text into bytes and its own line ends into nothing. A line "==" ends the text;
// each line behind it must be a line of the scene's canonical dump. Lines beginning with "##" between cases
// are remarks. Whether the table is of YAML or of XML, its name tells. Every beginning of every text is read
// too: the verdict is left open, but it must come to one.
#include "core/strbuf.h"
#include "grammar/print/ir_print.h"
#include "parser/parser.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MEMORY_BYTES = 64 * 1024 * 1024
};

struct table {
    bool is_xml;
    bool show;
    unsigned cases, failed;
};

struct verdict {
    struct strbuf codes;
    struct strbuf dump;
};

static str next_line(str *rest) {
    const char *end = rest->len ? memchr(rest->ptr, '\n', rest->len) : NULL;
    size_t length = end ? (size_t)(end - rest->ptr) : rest->len;
    str line = str_slice(*rest, 0, length);
    *rest = str_slice(*rest, length + (end ? 1 : 0), rest->len);
    return line;
}

static unsigned hex_digit(char c) {
    return c <= '9' ? (unsigned)(c - '0') : (unsigned)((c | 0x20) - 'a') + 10;
}

static void add_escaped(struct strbuf *out, str line) {
    for (size_t i = 0; i < line.len; i++) {
        if (line.ptr[i] != '\\' || i + 1 == line.len) {
            strbuf_char(out, line.ptr[i]);
        } else if (line.ptr[i + 1] == 'x' && i + 3 < line.len) {
            strbuf_char(out, (char)(hex_digit(line.ptr[i + 2]) * 16 + hex_digit(line.ptr[i + 3])));
            i += 3;
        } else {
            strbuf_char(out, line.ptr[i + 1] == 'n' ? '\n' : '\\');
            i += 1;
        }
    }
}

static void take_codes(struct strbuf *codes, struct diag_sink *sink) {
    diag_sort(sink);
    for (uint32_t i = 0; i < sink->count; i++) {
        const struct diag_info *info = diag_info(sink->items[i].code);
        if (info->severity == DIAG_NOTE)
            continue;
        strbuf_format(codes, "%s%s", strbuf_view(codes).len ? "," : "", info->code);
    }
    if (strbuf_view(codes).len == 0)
        strbuf_cstr(codes, "ok");
}

static void load(const struct table *table, str text, struct verdict *verdict) {
    struct arena arena;
    struct source_set sources;
    struct files files;
    struct diag_sink sink;
    struct limits limits = limits_default();
    struct parser_output output;
    arena_init(&arena, MEMORY_BYTES);
    source_set_init(&sources, &arena);
    files_init(&files, &arena);
    diag_sink_init(&sink);
    uint32_t source =
        source_add(&sources, SOURCE_KIND_OVERLAY, table->is_xml ? STR("case.xml") : STR("case.yaml"), text);
    struct parser_input input = {
        .sources = &sources, .files = &files, .sink = &sink, .limits = &limits, .arena = &arena};
    bool found = parser_load(&input, source, &output);
    take_codes(&verdict->codes, &sink);
    if (found)
        ir_dump(output.scene, &verdict->dump);
    diag_sink_finish(&sink);
    arena_finish(&arena);
}

static void begin_verdict(struct verdict *verdict) {
    strbuf_init(&verdict->codes);
    strbuf_init(&verdict->dump);
}

static void end_verdict(struct verdict *verdict) {
    strbuf_finish(&verdict->codes);
    strbuf_finish(&verdict->dump);
}

static bool has_line(str dump, str wanted) {
    while (dump.len)
        if (str_equal(str_trim(next_line(&dump)), str_trim(wanted)))
            return true;
    return false;
}

static void fail(struct table *table, str title, const char *what, str wanted, str got) {
    table->failed++;
    printf("%.*s: %s\n  wanted: %.*s\n  got: %.*s\n", STR_ARG(title), what, STR_ARG(wanted), STR_ARG(got));
}

static void check_case(struct table *table, str title, str wanted, str text, str values) {
    struct verdict verdict;
    begin_verdict(&verdict);
    load(table, text, &verdict);
    str codes = strbuf_view(&verdict.codes), dump = strbuf_view(&verdict.dump);
    if (table->show)
        printf("---- %.*s\n%.*s\n%.*s%.*s\n", STR_ARG(title), STR_ARG(text), STR_ARG(dump), STR_ARG(codes));
    if (!str_equal(codes, wanted))
        fail(table, title, "another verdict", wanted, codes);
    while (values.len) {
        str value = next_line(&values);
        if (str_trim(value).len && !has_line(dump, value))
            fail(table, title, "a value that is not there", value, dump);
    }
    end_verdict(&verdict);
    for (size_t length = 0; length < text.len; length++) {
        begin_verdict(&verdict);
        load(table, str_slice(text, 0, length), &verdict);
        end_verdict(&verdict);
    }
}

// From the header's line on; `rest` moves behind the case.
static void run_case(struct table *table, str header, str *rest) {
    const char *colon = memchr(header.ptr, ':', header.len);
    const char *blank = memchr(header.ptr, ' ', header.len);
    if (!colon || !blank || colon < blank) {
        fail(table, header, "no header of a case", STR("@@FLAGS VERDICT: title"), header);
        return;
    }
    str flags = str_slice(header, 2, (size_t)(blank - header.ptr));
    str wanted = str_slice(header, (size_t)(blank - header.ptr) + 1, (size_t)(colon - header.ptr));
    str title = str_trim(str_slice(header, (size_t)(colon - header.ptr) + 1, header.len));
    bool wraps = flags.len && memchr(flags.ptr, '+', flags.len);
    bool escaped = flags.len && memchr(flags.ptr, 'x', flags.len);
    struct strbuf text;
    strbuf_init(&text);
    if (wraps)
        strbuf_cstr(&text, table->is_xml ? "<Scene glint=\"1\">\n" : "glint: 1\n");
    while (rest->len && !str_starts_with(*rest, STR("@@")) && !str_starts_with(*rest, STR("==")) &&
           !str_starts_with(*rest, STR("##"))) {
        str line = next_line(rest);
        if (escaped) {
            add_escaped(&text, line);
        } else {
            strbuf_str(&text, line);
            strbuf_char(&text, '\n');
        }
    }
    if (wraps && table->is_xml)
        strbuf_cstr(&text, "</Scene>\n");
    str values = STR("");
    if (str_starts_with(*rest, STR("=="))) {
        next_line(rest);
        values = *rest;
        while (rest->len && !str_starts_with(*rest, STR("@@")) && !str_starts_with(*rest, STR("##")))
            next_line(rest);
        values = str_slice(values, 0, values.len - rest->len);
    }
    table->cases++;
    check_case(table, title, wanted, strbuf_view(&text), values);
    strbuf_finish(&text);
}

static char *read_whole(const char *path, size_t *size) {
    FILE *file = fopen(path, "rb");
    char *text = malloc(1 << 20);
    *size = file && text ? fread(text, 1, 1 << 20, file) : 0;
    if (file)
        fclose(file);
    return text;
}

int main(int argc, char **argv) {
    if (argc != 3)
        return 2;
    size_t size;
    char *text = read_whole(argv[2], &size);
    struct table table = {.is_xml = strstr(argv[2], "xml") != NULL, .show = strcmp(argv[1], "show") == 0};
    str rest = {text ? text : "", size};
    while (rest.len) {
        str line = next_line(&rest);
        if (str_starts_with(line, STR("@@")))
            run_case(&table, line, &rest);
    }
    free(text);
    printf("%u cases, %u mistakes\n", table.cases, table.failed);
    return table.failed || table.cases == 0;
}
