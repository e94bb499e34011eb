#include "core/diag_text.h"

enum { LINE_SHOWN_MAX = 160 };

static const char *const severity_names[] = {"error", "warning", "note"};
static const char *const severity_colors[] = {"\033[1;31m", "\033[1;35m", "\033[1;36m"};

const char *diag_severity_name(enum diag_severity severity) { return severity_names[severity]; }

static void paint(struct strbuf *out, struct diag_text_options options, const char *color) {
    if (options.color)
        strbuf_cstr(out, color);
}

// The source line, cut around the caret where it is long, and the caret below it. Tabs stay tabs in both,
// so that they line up; control characters are shown as '?'.
static void excerpt(struct strbuf *out, struct source_place place, struct diag_text_options options) {
    str line = place.line_text;
    size_t at = 0;
    for (uint32_t c = 1; c < place.column && at < line.len; c++) {
        size_t n = utf8_sequence_length(line, at);
        at += n ? n : 1;
    }
    size_t first = 0;
    if (at > LINE_SHOWN_MAX / 2)
        first = at - LINE_SHOWN_MAX / 2;
    while (first > 0 && first < line.len && ((unsigned char)line.ptr[first] & 0xC0) == 0x80)
        first++;
    size_t last = first + LINE_SHOWN_MAX < line.len ? first + LINE_SHOWN_MAX : line.len;
    while (last < line.len && last > first && ((unsigned char)line.ptr[last] & 0xC0) == 0x80)
        last--;
    strbuf_format(out, "%6u | %s", place.line, first ? "..." : "");
    for (size_t i = first; i < last; i++) {
        unsigned char c = (unsigned char)line.ptr[i];
        strbuf_char(out, (c < 0x20 && c != '\t') || c == 0x7F ? '?' : (char)c);
    }
    strbuf_cstr(out, last < line.len ? "...\n" : "\n");
    strbuf_cstr(out, "       | ");
    strbuf_cstr(out, first ? "   " : "");
    for (size_t i = first; i < at; i++)
        if (((unsigned char)line.ptr[i] & 0xC0) != 0x80)
            strbuf_char(out, line.ptr[i] == '\t' ? '\t' : ' ');
    size_t shown = utf8_count(str_slice(line, at, last));
    size_t width = place.end_line == place.line && place.end_column > place.column ? place.end_column - place.column
                   : place.end_line > place.line                                  ? shown
                                                                                  : 1;
    if (width > shown)
        width = shown ? shown : 1;
    paint(out, options, "\033[1;32m");
    strbuf_char(out, '^');
    strbuf_repeat(out, '~', width > 1 ? width - 1 : 0);
    paint(out, options, "\033[0m");
    strbuf_char(out, '\n');
}

static void place_text(struct strbuf *out, struct source_place place) {
    strbuf_format(out, "%.*s:%u:%u: ", STR_ARG(place.path), place.line, place.column);
}

static void one(struct strbuf *out, const struct diag *d, struct source_set *sources, struct diag_text_options options) {
    const struct diag_info *info = diag_info(d->code);
    struct source_place place = source_locate(sources, d->at);
    paint(out, options, "\033[1m");
    place_text(out, place);
    paint(out, options, severity_colors[info->severity]);
    strbuf_format(out, "%s: ", severity_names[info->severity]);
    paint(out, options, "\033[0m");
    strbuf_format(out, "%.*s", STR_ARG(d->message));
    if (d->repeats)
        strbuf_format(out, " (and %u more like it)", d->repeats);
    strbuf_format(out, " [%s]\n", info->code);
    if (sources->items[d->at.source].text.len)
        excerpt(out, place, options);
    for (const struct diag_related *n = d->notes; n; n = n->next) {
        if (span_is_none(n->at)) {
            strbuf_format(out, "       = note: %.*s\n", STR_ARG(n->message));
            continue;
        }
        struct source_place related = source_locate(sources, n->at);
        place_text(out, related);
        strbuf_format(out, "note: %.*s\n", STR_ARG(n->message));
        excerpt(out, related, options);
    }
    if (d->help.len)
        strbuf_format(out, "       = help: %.*s\n", STR_ARG(d->help));
}

void diag_text(struct strbuf *out, const struct diag_sink *sink, struct source_set *sources,
               struct diag_text_options options) {
    uint32_t shown = 0;
    uint32_t hidden = 0;
    for (uint32_t i = 0; i < sink->count; i++) {
        const struct diag *d = &sink->items[i];
        if (diag_info(d->code)->severity == DIAG_NOTE && !options.notes)
            continue;
        if (options.most && shown >= options.most) {
            hidden++;
            continue;
        }
        one(out, d, sources, options);
        shown++;
    }
    hidden += sink->dropped;
    if (hidden)
        strbuf_format(out, "glint: %u more message%s not shown; --limit messages=N shows more\n", hidden, hidden == 1 ? "" : "s");
}
