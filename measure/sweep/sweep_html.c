// A sweep as one HTML file: a family a row, a scene a square whose title has its numbers. No scripts, nothing
// from outside.
#include "measure/sweep/sweep.h"

enum {
    SIDE = 13,
    LEFT = 150,
    ACROSS = 72, // squares in a line
};

static const char style[] =
    "body{font:15px/1.5 system-ui,sans-serif;margin:2em auto;max-width:76em;padding:0 1em;"
    "color:#1b1b1b;background:#fff}"
    "h1{font-size:1.4em}svg text{font:12px system-ui,sans-serif;fill:#1b1b1b}"
    ".key span{display:inline-block;width:1em;height:1em;vertical-align:-.15em;margin:0 .3em 0 1em}"
    "@media(prefers-color-scheme:dark){body{color:#e6e6e6;background:#181818}svg text{fill:#e6e6e6}}";

static const char *const words[SWEEP_VERDICTS] = {
    [SWEEP_RIGHT] = "right",
    [SWEEP_WRONG] = "single was chosen and is wrong",
    [SWEEP_NEEDLESS] = "double was chosen and is not needed",
    [SWEEP_BEYOND] = "double is wrong too",
};

static const char *color_of(enum sweep_verdict verdict, bool is_double) {
    static const char *const colors[SWEEP_VERDICTS] = {[SWEEP_RIGHT] = "#2f9e62",
                                                       [SWEEP_WRONG] = "#d0342c",
                                                       [SWEEP_NEEDLESS] = "#e0b93c",
                                                       [SWEEP_BEYOND] = "#6a5acd"};
    return verdict == SWEEP_RIGHT && is_double ? "#8fcfa8" : colors[verdict];
}

static void put_picture(struct strbuf *out, const char *name, const struct sweep_picture *picture) {
    strbuf_format(out, "\n%s: %.4f %% off, %u pixels show the background", name, 100 * picture->off,
                  picture->background);
}

static void put_square(struct strbuf *out, const struct sweep_item *item, uint32_t x, uint32_t y) {
    strbuf_format(out, "<rect x=\"%u\" y=\"%u\" width=\"%d\" height=\"%d\" fill=\"%s\"><title>%s-%u: %s", x,
                  y, SIDE - 1, SIDE - 1, color_of(item->verdict, item->is_double),
                  sweep_families[item->family].name, item->number, words[item->verdict]);
    put_picture(out, "single", &item->pictures[SWEEP_SINGLE]);
    put_picture(out, "double", &item->pictures[SWEEP_DOUBLE]);
    strbuf_cstr(out, "</title></rect>\n");
}

// Returns how many squares were put, from line `top` on.
static uint32_t put_family(struct strbuf *out, const struct sweep *sweep, enum sweep_family family,
                           uint32_t top) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < sweep->count; i++) {
        if (sweep->items[i].family != family)
            continue;
        if (count == 0)
            strbuf_format(out, "<text x=\"0\" y=\"%u\">%s</text>\n", top * SIDE + SIDE - 3,
                          sweep_families[family].name);
        put_square(out, &sweep->items[i], LEFT + count % ACROSS * SIDE, (top + count / ACROSS) * SIDE);
        count++;
    }
    return count;
}

static void put_key(struct strbuf *out) {
    strbuf_cstr(out, "<p class=\"key\">");
    for (int i = 0; i < SWEEP_VERDICTS; i++)
        strbuf_format(out, "<span style=\"background:%s\"></span>%s", color_of((enum sweep_verdict)i, false),
                      words[i]);
    strbuf_format(out, "<span style=\"background:%s\"></span>right, in double</p>\n",
                  color_of(SWEEP_RIGHT, true));
}

static uint32_t lines_of(const struct sweep *sweep) {
    uint32_t lines = 0;
    for (int family = 0; family < SWEEP_FAMILIES; family++) {
        uint32_t count = 0;
        for (uint32_t i = 0; i < sweep->count; i++)
            count += sweep->items[i].family == (enum sweep_family)family;
        lines += (count + ACROSS - 1) / ACROSS;
    }
    return lines;
}

void sweep_html(const struct sweep_report *report, struct strbuf *out) {
    const struct sweep *s = report->sweep;
    struct strbuf text;
    strbuf_init(&text);
    sweep_text(report, &text);
    strbuf_format(out,
                  "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>%u random scenes</title>"
                  "<style>%s</style>\n<h1>%u random scenes of seed %llu</h1>\n",
                  s->count, style, s->count, (unsigned long long)report->input->seed);
    put_key(out);
    strbuf_format(out, "<svg width=\"%d\" height=\"%u\" role=\"img\" aria-label=\"a square a scene\">\n",
                  LEFT + ACROSS * SIDE, lines_of(s) * SIDE);
    uint32_t top = 0;
    for (int i = 0; i < SWEEP_FAMILIES; i++)
        top += (put_family(out, s, (enum sweep_family)i, top) + ACROSS - 1) / ACROSS;
    strbuf_cstr(out, "</svg>\n<pre>");
    strbuf_markup(out, strbuf_view(&text));
    strbuf_cstr(out, "</pre>\n</html>\n");
    out->failed = out->failed || text.failed;
    strbuf_finish(&text);
}
