// The report of a study as one HTML file: plot, answers, a table that can be sorted, pictures.
#include "measure/tradeoff/report/report_html.h"

#include "measure/tradeoff/report/report.h"

#include <math.h>

static const char STYLE[] =
    ":root{--ink:#1c1f24;--soft:#5d6570;--paper:#fff;--panel:#f4f5f7;--line:#d6dae0;--accent:#b3261e;"
    "--k0:#1f6fb2;--k1:#2a8c82;--k2:#7a4fb5;--k3:#b06a00;--k4:#8a8d00;--k5:#c2457a;--k6:#3c7d1e;--k7:#9a6a58;"
    "--pair:#7d858f;--study:#"
    "a33}"
    "@media(prefers-color-scheme:dark){:root{--ink:#e6e8eb;--soft:#9aa3ad;--paper:#16181c;--panel:#1f2228;"
    "--line:#363b43;--accent:#ff8a80;--k0:#6cb2f0;--k1:#63c9bd;--k2:#b794f0;--k3:#eeae55;--k4:#c9cc4d;"
    "--k5:#f08ab8;--k6:#8fd06a;--k7:#cf9f8c;--pair:#8d96a1;--study:#ef7f7f}}"
    "body{margin:0 auto;max-width:1180px;padding:24px;background:var(--paper);color:var(--ink);"
    "font:15px/1.5 system-ui,sans-serif}"
    "h1{font-size:22px;margin:0 0 4px}h2{font-size:17px;margin:32px 0 8px}p{max-width:72ch}"
    ".soft{color:var(--soft)}pre{background:var(--panel);padding:12px;overflow-x:auto;border-radius:6px}"
    "svg{width:100%;height:auto;background:var(--panel);border-radius:6px}"
    ".grid{stroke:var(--line)}.tick,.axis{fill:var(--soft);font-size:12px}.note{fill:var(--accent);font-size:"
    "13px}"
    ".front{fill:none;stroke:var(--accent);stroke-width:1.5;stroke-dasharray:5 3}"
    ".knee{fill:none;stroke:var(--accent);stroke-width:2}.spread{stroke:currentColor;opacity:.5}"
    ".point circle{fill:currentColor;stroke:var(--paper)}"
    ".file{color:var(--ink)}.max_depth{color:var(--k0)}.min_weight{color:var(--k1)}.precision{color:var(--k2)"
    "}"
    ".samples{color:var(--k3)}.shadows{color:var(--k4)}.resolution{color:var(--k5)}.pair{color:var(--pair)}"
    ".error{color:var(--k6)}.without{color:var(--k7)}"
    ".features,.study{color:var(--study)}"
    ".lines{white-space:pre-line}.legend span{margin-right:16px;white-space:nowrap}.legend "
    "b{font-size:18px;line-height:1}"
    ".scroll{overflow-x:auto}table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:13px}"
    "th,td{padding:4px 9px;text-align:right;border-bottom:1px solid var(--line);white-space:nowrap}"
    "th{position:sticky;top:0;background:var(--paper);cursor:pointer;color:var(--soft);font-weight:600}"
    "th:hover{color:var(--ink)}th:nth-child(2),td:nth-child(2){text-align:left}"
    "tr.front td{font-weight:600}tr.never td{color:var(--soft)}"
    ".cards{display:grid;grid-template-columns:repeat(auto-fill,minmax(340px,1fr));gap:14px}"
    ".card{background:var(--panel);border-radius:6px;padding:10px}.card "
    "img{width:48%;image-rendering:pixelated}"
    ".card div{font-size:13px}";

// A click sorts by a column, numerically if it has numbers; a second click reverses the order.
static const char SCRIPT[] =
    "document.querySelectorAll('table').forEach(t=>t.querySelectorAll('th').forEach((h,c)=>h.onclick=()=>{"
    "const b=t.tBodies[0],up=h.dataset.up!=='1';"
    "t.querySelectorAll('th').forEach(o=>{delete o.dataset.up;o.removeAttribute('aria-sort')});"
    "h.dataset.up=up?'1':'0';h.setAttribute('aria-sort',up?'ascending':'descending');"
    "const key=r=>{const d=r.cells[c].dataset.v;return d!==undefined?parseFloat(d):r.cells[c].textContent};"
    "[...b.rows].sort((p,q)=>{const x=key(p),y=key(q);"
    "const o=typeof x==='number'&&typeof "
    "y==='number'?(isNaN(x)-isNaN(y))||(x-y):String(x).localeCompare(String(y));"
    "return up?o:-o}).forEach(r=>b.append(r))}))";

static void legend(struct strbuf *out) {
    static const char *const kinds[] = {"file",    "max_depth", "min_weight", "precision",
                                        "samples", "shadows",   "resolution", "error",
                                        "without", "pair",      "study"};
    strbuf_cstr(out, "<p class=\"legend soft\">");
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        strbuf_format(out, "<span><b class=\"%s\">&#9679;</b> %s</span>", kinds[i],
                      i == 0 ? "as the file says" : kinds[i]);
    strbuf_cstr(out, "</p>\n");
}

// ---- tables

static void cell(struct strbuf *out, double value) {
    if (isnan(value))
        strbuf_cstr(out, "<td data-v=\"NaN\">&ndash;</td>");
    else if (isinf(value))
        strbuf_cstr(out, "<td data-v=\"1e300\">&infin;</td>");
    else
        strbuf_format(out, "<td data-v=\"%.9g\">%.4g</td>", value, value);
}

static void begin_row(const struct row *row, uint32_t index, struct strbuf *out) {
    strbuf_format(out, "<tr class=\"%s\"><td data-v=\"%u\">%u</td><td><b class=\"%s\">&#9679;</b> ",
                  row->on_front    ? "front"
                  : row->choosable ? ""
                                   : "never",
                  index, index, html_kind(row));
    strbuf_markup(out, str_from(row->name));
    strbuf_cstr(out, "</td>");
}

static void begin_table(const char *const *heads, size_t count, struct strbuf *out) {
    strbuf_cstr(out, "<div class=\"scroll\"><table><thead><tr>");
    for (size_t i = 0; i < count; i++)
        strbuf_format(out, "<th>%s</th>", heads[i]);
    strbuf_cstr(out, "</tr></thead><tbody>\n");
}

static void rows_table(const struct tradeoff *t, struct strbuf *out) {
    static const char *const heads[] = {"row",     "setting",    "time ms",  "&plusmn; quartiles",
                                        "class",   "rank",       "rays M",   "work M",
                                        "MAE",     "RMSE",       "relMSE",   "largest",
                                        "PSNR dB", "SSIM",       "FLIP",     "share",
                                        "numeric", "truncation", "sampling", "resolution"};
    begin_table(heads, sizeof heads / sizeof *heads, out);
    for (uint32_t i = 0; i < t->count; i++) {
        const struct row *row = &t->rows[i];
        const bool ranked = row->time_class != CHOICE_NONE, parts = row->parts.known;
        begin_row(row, i, out);
        cell(out, row->time_ms);
        cell(out, 0.5 * (row->time_high_ms - row->time_low_ms));
        cell(out, ranked ? row->time_class : (double)NAN);
        cell(out, ranked ? row->rank : (double)NAN);
        cell(out, (double)row->work.rays / 1e6);
        cell(out, row->work.cost / 1e6);
        for (int k = 0; k < METRIC_COUNT; k++)
            cell(out, row->value[k]);
        cell(out, parts ? row->parts.numeric : (double)NAN);
        cell(out, parts ? row->parts.truncation : (double)NAN);
        cell(out, parts ? row->parts.sampling : (double)NAN);
        cell(out, parts ? row->parts.resolution : (double)NAN);
        strbuf_cstr(out, "</tr>\n");
    }
    strbuf_cstr(out, "</tbody></table></div>\n");
}

static void hits_table(const struct tradeoff *t, struct strbuf *out) {
    static const char *const heads[] = {"row",     "setting",   "wrong, silhouettes", "wrong, elsewhere",
                                        "acne",    "leaks",     "shadow edges",       "holes",
                                        "2nd ray", "NaN pixels"};
    begin_table(heads, sizeof heads / sizeof *heads, out);
    for (uint32_t i = 0; i < t->count; i++) {
        const struct row *row = &t->rows[i];
        const struct hit_errors *h = &row->hits;
        if (!h->known)
            continue;
        begin_row(row, i, out);
        const double values[] = {h->wrong_inside, h->wrong_outside, h->acne,         h->leaks,
                                 h->shadow_edge,  h->holes,         h->wrong_second, (double)row->not_finite};
        for (size_t k = 0; k < sizeof values / sizeof *values; k++)
            cell(out, values[k]);
        strbuf_cstr(out, "</tr>\n");
    }
    strbuf_cstr(out, "</tbody></table></div>\n");
}

// ---- pictures

static void picture(struct strbuf *out, const struct strbuf *png, const char *what) {
    if (!png->len)
        return;
    strbuf_format(out, "<img alt=\"%s\" title=\"%s\" src=\"data:image/png;base64,", what, what);
    strbuf_base64(out, strbuf_view(png));
    strbuf_cstr(out, "\"> ");
}

static void cards(const struct tradeoff *t, struct strbuf *out) {
    strbuf_cstr(out, "<div class=\"cards\">\n");
    for (uint32_t i = 0; i < t->count; i++) {
        const struct row *row = &t->rows[i];
        if (!row->thumbnail.len || (!row->on_front && (row->knobs & (row->knobs - 1))))
            continue;
        strbuf_cstr(out, "<div class=\"card\">");
        picture(out, &row->thumbnail, "picture");
        picture(out, &row->difference, "difference, largest of each square");
        strbuf_format(out, "<div>%u <b class=\"%s\">&#9679;</b> ", i, html_kind(row));
        strbuf_markup(out, str_from(row->name));
        strbuf_format(out, "%s</div><div class=\"soft\">%.4g ms, MAE %.3g, FLIP %.3g</div></div>\n",
                      i == t->knee ? " (knee)" : "", row->time_ms, row->value[METRIC_MAE],
                      row->value[METRIC_FLIP]);
    }
    strbuf_cstr(out, "</div>\n");
}

static void escaped(struct strbuf *out, void (*write)(const struct tradeoff *, struct strbuf *),
                    const struct tradeoff *t) {
    struct strbuf text;
    strbuf_init(&text);
    write(t, &text);
    strbuf_markup(out, strbuf_view(&text));
    out->failed |= text.failed;
    strbuf_finish(&text);
}

static void head(const struct tradeoff *t, const char *scene, struct strbuf *out) {
    const struct setting *base = &t->base;
    strbuf_cstr(out,
                "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
                "content=\"width=device-width\">\n<title>glint tradeoff: ");
    strbuf_markup(out, str_from(scene));
    strbuf_format(out, "</title>\n<style>%s</style></head><body>\n<h1>What speed costs: ", STYLE);
    strbuf_markup(out, str_from(scene));
    strbuf_format(out, "</h1>\n<p class=\"soft\">%u &times; %u pixels on ", base->width, base->height);
    strbuf_markup(out, str_from(t->device));
    strbuf_cstr(out, ".</p>\n<p class=\"soft lines\">");
    escaped(out, tradeoff_notes, t);
    strbuf_cstr(out, "</p>\n");
}

void tradeoff_html(const struct tradeoff *t, const char *scene, struct strbuf *out) {
    head(t, scene, out);
    html_plot(t, out);
    legend(out);
    strbuf_format(
        out,
        "<p class=\"soft\">Each dot is a setting; its bar spans the quartiles of its time. The dashed "
        "line joins the front: no cheaper setting has a smaller error (%s). Times closer than %.0f %% "
        "form one class, within which counted work decides.</p>\n",
        metric_infos[t->options.metric].title, 100 * t->noise);
    strbuf_cstr(out, "<h2>Answers</h2>\n<pre>");
    escaped(out, tradeoff_answers, t);
    strbuf_cstr(out, "</pre>\n<h2>Settings</h2>\n<p class=\"soft\">Bold: on the front. Grey: studies and the "
                     "general shader, never chosen. Click a column heading to sort.");
    if (t->part_pixels)
        strbuf_format(out, " The last four columns split the mean absolute error by cause, at %u pixels.",
                      t->part_pixels);
    strbuf_cstr(out, "</p>\n");
    rows_table(t, out);
    strbuf_cstr(
        out, "<h2>First hits against the reference</h2>\n<p class=\"soft\">Per million pixels. Acne: dark "
             "although nothing is between surface and light. Leaks: lit although something is. Holes: the "
             "background seen through a closed body. 2nd ray: the mirrored or refracted ray hits another "
             "body. Silhouettes and the edges of shadows are left out, except in their own columns.</p>\n");
    hits_table(t, out);
    strbuf_cstr(
        out,
        "<h2>Pictures</h2>\n<p class=\"soft\">Each picture next to its difference from the reference: black "
        "below 0.001, violet 0.005, red 0.03, orange 0.1, pale yellow 1.</p>\n");
    cards(t, out);
    strbuf_format(out, "<script>%s</script>\n</body></html>\n", SCRIPT);
}
