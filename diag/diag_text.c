#include "diag/diag_text.h"

#include "core/unicode.h"
#include "diag/diag_share.h"

enum {
    LINE_SHOWN_MAX = 160, // bytes
    MESSAGE_BYTES = 500,  // of a message with its notes: all together have at most `most` times as many
    TAB_COLUMNS = 8,
};

static const char *const severity_names[] = {"error", "warning", "note"};
static const char *const severity_colors[] = {"\033[1;31m", "\033[1;35m", "\033[1;36m"};

const char *diag_severity_name(enum diag_severity severity) {
    return severity_names[severity];
}

static void paint(struct strbuf *out, struct diag_text_options options, const char *color) {
    if (options.color)
        strbuf_cstr(out, color);
}

// Writes the character at `at` as a terminal may show it, counts the columns that it takes from *column on,
// and returns its length in bytes. Tabs become spaces, so that the marks below the line align; bytes that a
// terminal might obey or that are not UTF-8 become '?'.
static size_t put_character(struct strbuf *out, str s, size_t at, unsigned *column) {
    size_t size = utf8_sequence_length(s, at);
    uint32_t c = size ? utf8_decode(s, at) : 0;
    if (c == '\t') {
        unsigned blanks = TAB_COLUMNS - *column % TAB_COLUMNS;
        strbuf_repeat(out, ' ', blanks);
        *column += blanks;
    } else if (unicode_is_control(c)) {
        strbuf_char(out, '?');
        ++*column;
    } else {
        strbuf_add(out, s.ptr + at, size);
        *column += unicode_width(c);
    }
    return size ? size : 1;
}

void diag_text_plain(struct strbuf *out, str s) {
    for (size_t at = 0; at < s.len;) {
        unsigned column = TAB_COLUMNS - 1;
        at += put_character(out, s, at, &column);
    }
}

// The source line, cut around the place if it is long, and the caret below it.
static void excerpt(struct strbuf *out, struct source_place place, struct diag_text_options options) {
    str line = place.line_text;
    size_t begin = place.begin, end = place.end;
    size_t first = begin > LINE_SHOWN_MAX / 2 ? begin - LINE_SHOWN_MAX / 2 : 0;
    for (int i = 0; i < 3 && first > 0 && ((unsigned char)line.ptr[first] & 0xC0) == 0x80; i++)
        first++;
    size_t last = line.len - first > LINE_SHOWN_MAX ? first + LINE_SHOWN_MAX : line.len;
    size_t gutter = out->len;
    strbuf_format(out, "%6u", place.line);
    gutter = out->len - gutter;
    strbuf_cstr(out, first ? " | ..." : " | ");
    unsigned column = first ? 3 : 0;
    unsigned begin_column = column;
    unsigned end_column = column;
    for (size_t at = first; at < last;) {
        at += put_character(out, line, at, &column);
        begin_column = at <= begin ? column : begin_column;
        end_column = at <= end ? column : end_column;
    }
    strbuf_cstr(out, last < line.len ? "...\n" : "\n");
    strbuf_repeat(out, ' ', gutter);
    strbuf_cstr(out, " | ");
    strbuf_repeat(out, ' ', begin_column);
    paint(out, options, "\033[1;32m");
    strbuf_char(out, '^');
    strbuf_repeat(out, '~', end_column > begin_column + 1 ? end_column - begin_column - 1 : 0);
    paint(out, options, "\033[0m");
    strbuf_char(out, '\n');
}

static void place_text(struct strbuf *out, struct source_place place) {
    diag_text_plain(out, place.path);
    strbuf_format(out, ":%u:%u: ", place.line, place.column);
}

static bool has_text(const struct source_set *sources, span at) {
    return at.source < sources->count && sources->items[at.source].text.len > 0 &&
           sources->items[at.source].kind != SOURCE_KIND_GENERATED;
}

static void labelled(struct strbuf *out, const char *label, str text) {
    strbuf_cstr(out, label);
    diag_text_plain(out, text);
    strbuf_char(out, '\n');
}

static void one(struct strbuf *out, const struct diag *d, struct source_set *sources,
                struct diag_text_options options) {
    const struct diag_info *info = diag_info(d->code);
    struct source_place place = source_locate(sources, d->at);
    paint(out, options, "\033[1m");
    place_text(out, place);
    paint(out, options, severity_colors[d->severity]);
    strbuf_format(out, "%s: ", severity_names[d->severity]);
    paint(out, options, "\033[0m");
    diag_text_plain(out, d->message);
    strbuf_format(out, " [%s]\n", info->code);
    if (has_text(sources, d->at))
        excerpt(out, place, options);
    for (const struct diag_related *n = d->notes; n; n = n->next) {
        if (span_is_none(n->at)) {
            labelled(out, "       = note: ", n->message);
            continue;
        }
        struct source_place related = source_locate(sources, n->at);
        place_text(out, related);
        labelled(out, "note: ", n->message);
        if (has_text(sources, n->at))
            excerpt(out, related, options);
    }
    if (d->help.len)
        labelled(out, "       = help: ", d->help);
}

static void put_hidden(struct strbuf *out, const struct diag_sink *sink, const struct diag_hidden *hidden,
                       uint32_t shown) {
    strbuf_format(out, "glint: %u more message%s not shown (", hidden->count, hidden->count == 1 ? "" : "s");
    diag_hidden_codes(out, hidden);
    // The messages that the sink dropped for lack of memory may not fit now either.
    uint32_t total = shown + hidden->count;
    uint32_t kept = sink->dropped ? sink->kept_max + sink->dropped : 0;
    strbuf_format(out, "); --limit messages=%u shows %s\n", diag_share_needed(total > kept ? total : kept),
                  sink->dropped ? "more" : "all");
}

void diag_text(struct strbuf *out, const struct diag_sink *sink, struct source_set *sources,
               struct diag_text_options options) {
    struct diag_share share = diag_share_begin(sink, options.most, options.alike, options.notes);
    struct diag_hidden hidden = {0};
    bool error_shown = false;
    bool bounded = options.most && options.most <= diag_share_standard();
    size_t begin = out->len;
    diag_hide_dropped(&hidden, sink, options.notes);
    for (uint32_t i = 0; i < sink->count; i++) {
        const struct diag *d = &sink->items[i];
        if (d->severity == DIAG_NOTE && !options.notes)
            continue;
        // A failing run shows why, however many warnings come first.
        bool first_error = d->severity == DIAG_ERROR && !error_shown;
        bool full = bounded && out->len - begin >= (size_t)options.most * MESSAGE_BYTES;
        if ((full && !first_error) || !diag_share_takes(&share, d, first_error)) {
            diag_hide(&hidden, d->code, 1);
            continue;
        }
        one(out, d, sources, options);
        error_shown = error_shown || first_error;
    }
    if (hidden.count)
        put_hidden(out, sink, &hidden, share.used);
}
