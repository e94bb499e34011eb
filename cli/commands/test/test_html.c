// The results of glint test as one self-contained page: cases not within their bounds are open, with picture,
// reference and difference side by side.
#include "cli/commands/test/test.h"

static const char style[] =
    ":root{color-scheme:light dark;--ink:#1c1f24;--soft:#59616b;--paper:#fff;--panel:#f4f5f7;--line:#d6dae0;"
    "--good:#1d6b34;--bad:#b3261e;--focus:#1f6fb2}"
    "@media(prefers-color-scheme:dark){:root{--ink:#e6e8eb;--soft:#a0a8b2;--paper:#16181c;--panel:#1f2228;"
    "--line:#363b43;--good:#7fd196;--bad:#ff8a80;--focus:#6cb2f0}}"
    "body{margin:0 auto;max-width:1180px;padding:24px;background:var(--paper);color:var(--ink);"
    "font:15px/1.5 system-ui,sans-serif}"
    "h1{font-size:22px;margin:0 0 4px}.soft{color:var(--soft)}"
    "fieldset{border:0;padding:0;margin:16px 0}label{margin-right:16px}"
    ":focus-visible{outline:3px solid var(--focus);outline-offset:2px}"
    "details{border:1px solid var(--line);border-radius:6px;margin:8px 0;background:var(--panel)}"
    "summary{cursor:pointer;padding:8px 12px}summary b{display:inline-block;min-width:5em}"
    ".good b{color:var(--good)}.bad b{color:var(--bad)}"
    ".in{padding:0 12px 12px}.trio{display:grid;grid-template-columns:repeat(3,minmax(0,1fr));gap:12px}"
    "figure{margin:0;min-width:0}figcaption{color:var(--soft);font-size:13px}"
    "img{width:100%;height:auto;image-rendering:pixelated;background:#000;border-radius:3px}"
    "@media(max-width:640px){.trio{grid-template-columns:1fr}}"
    "body.only .good{display:none}";

// The arrow keys go from picture to picture; Enter and space open one, as usual.
static const char script[] =
    "const only=document.getElementById('only');if(only)only.onchange=()=>"
    "document.body.classList.toggle('only',only.checked);"
    "document.addEventListener('keydown',e=>{if(e.target.tagName!=='SUMMARY'||e.altKey||e.ctrlKey||e.metaKey)"
    "return;const step={ArrowDown:1,ArrowUp:-1,j:1,k:-1}[e.key];if(!step)return;"
    "const all=[...document.querySelectorAll('summary')].filter(s=>s.offsetParent),"
    "next=all[all.indexOf(e.target)+step];if(next){e.preventDefault();next.focus();"
    "next.scrollIntoView({block:'nearest'})}})";

static void head(const struct test_run *run, struct strbuf *out) {
    struct strbuf sums;
    strbuf_init(&sums);
    test_sums(run, &sums);
    strbuf_cstr(out, "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
                     "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
                     "<title>glint test: ");
    strbuf_markup(out, run->folder);
    strbuf_format(out, "</title>\n<style>%s</style></head><body>\n<main>\n<h1>Pictures of ", style);
    strbuf_markup(out, run->folder);
    strbuf_cstr(out, "</h1>\n<p>");
    strbuf_markup(out, strbuf_view(&sums));
    strbuf_cstr(out, ".</p>\n");
    out->failed = out->failed || sums.failed;
    strbuf_finish(&sums);
}

static void figure(const struct test_case *test, enum test_shown shown, struct strbuf *out) {
    static const char *const titles[TEST_SHOWN_COUNT] = {"picture", "reference", "difference"};
    const struct strbuf *png = &test->shown[shown];
    strbuf_cstr(out, "<figure>");
    if (png->len) {
        strbuf_format(out, "<img alt=\"%s of ", titles[shown]);
        strbuf_markup(out, test->name);
        strbuf_cstr(out, "\" src=\"data:image/png;base64,");
        strbuf_base64(out, strbuf_view(png));
        strbuf_cstr(out, "\">");
    }
    strbuf_format(out, "<figcaption>%s", titles[shown]);
    const struct test_size size = shown == TEST_SHOWN_REFERENCE ? test->was : test->now;
    if (shown != TEST_SHOWN_DIFFERENCE && size.width)
        strbuf_format(out, ", %u &times; %u", size.width, size.height);
    else if (!png->len)
        strbuf_cstr(out, test->state == TEST_SAME ? ": none" : ": not known");
    strbuf_cstr(out, "</figcaption></figure>\n");
}

static void value(struct strbuf *out, const struct test_case *test, enum metric metric) {
    const struct metric_info *info = &metric_infos[metric];
    strbuf_format(out, "<li>%s (%s): %.4g", info->title, info->name, test->result.value[metric]);
    if (test->settings.bounds.has[metric])
        strbuf_format(out, ", %s %.4g%s", info->higher_is_better ? "at least" : "at most",
                      test->settings.bounds.bound[metric],
                      test_breaks(test, metric) ? ": <strong>broken</strong>" : "");
    strbuf_cstr(out, "</li>");
}

static void figures(const struct test_case *test, struct strbuf *out) {
    if (!test->is_measured)
        return;
    strbuf_cstr(out, "<ul>");
    for (int m = 0; m < METRIC_COUNT; m++)
        if (test->settings.bounds.has[m] || test->result.value[m] == test->result.value[m])
            value(out, test, (enum metric)m);
    strbuf_cstr(out, "</ul>\n");
}

static void one(const struct test_case *test, struct strbuf *out) {
    const bool good = test->is_written || test->state == TEST_SAME || test->state == TEST_WITHIN;
    struct strbuf words;
    strbuf_init(&words);
    test_figures(test, &words);
    strbuf_format(out, "<details class=\"%s\"%s><summary><b>%s</b> ", good ? "good" : "bad",
                  good ? "" : " open", test->is_written ? "written" : test_state_words[test->state]);
    strbuf_markup(out, test->name);
    strbuf_cstr(out, " <span class=\"soft\">");
    strbuf_markup(out, strbuf_view(&words));
    strbuf_cstr(out, "</span></summary><div class=\"in\">\n");
    if (test->record.len) {
        strbuf_cstr(out, "<p>");
        strbuf_markup(out, test->record);
        strbuf_cstr(out, "</p>\n");
    }
    if (test->now.width) {
        strbuf_cstr(out, "<div class=\"trio\">");
        for (int shown = 0; shown < TEST_SHOWN_COUNT; shown++)
            figure(test, (enum test_shown)shown, out);
        strbuf_cstr(out, "</div>\n");
    }
    figures(test, out);
    strbuf_cstr(out, "<p class=\"soft\">");
    strbuf_markup(out, test->scene);
    strbuf_cstr(out, " &rarr; ");
    strbuf_markup(out, test->picture);
    strbuf_format(out, ", %.2f s</p>\n</div></details>\n", test->seconds);
    out->failed = out->failed || words.failed;
    strbuf_finish(&words);
}

void test_html(const struct test_run *run, struct strbuf *out) {
    const struct test_counts counts = test_count(run);
    head(run, out);
    if (counts.good != counts.all && counts.good)
        strbuf_cstr(out, "<fieldset><label><input type=\"checkbox\" id=\"only\"> only those that are not "
                         "within their bounds</label></fieldset>\n");
    strbuf_cstr(out, "<p class=\"soft\">The difference is black below 0.001, violet 0.005, red 0.03, orange "
                     "0.1, pale yellow 1, of displayed values.</p>\n");
    for (int good = 0; good < 2; good++)
        for (uint32_t i = 0; i < run->cases.count; i++) {
            const struct test_case *test = &run->cases.items[i];
            if (good == (test->is_written || test->state == TEST_SAME || test->state == TEST_WITHIN))
                one(test, out);
        }
    strbuf_format(out,
                  "<p class=\"soft\">glint %s, %.1f s.</p>\n</main>\n<script>%s</script>\n</body></html>\n",
                  GLINT_VERSION, run->seconds, script);
}
