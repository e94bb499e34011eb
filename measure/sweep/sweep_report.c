// A sweep as text and as JSON.
#include "core/json_write.h"
#include "measure/sweep/sweep.h"

#include <math.h>
#include <stdio.h>

static const char *precision_of(const struct sweep_item *item) {
    return item->is_double ? "double" : "single";
}

static void put_item(struct strbuf *out, const struct sweep_item *item) {
    const struct sweep_picture *one = &item->pictures[SWEEP_SINGLE], *two = &item->pictures[SWEEP_DOUBLE];
    char name[SWEEP_NAME_BYTES];
    snprintf(name, sizeof name, "%s-%u", sweep_families[item->family].name, item->number);
    strbuf_format(out, "  %-18s %-9s %s  %8.5f %6u  %8.5f %6u %6u  %.4g\n", name,
                  sweep_verdict_names[item->verdict], precision_of(item), one->off, one->background, two->off,
                  two->background, item->pictures[SWEEP_REFERENCE].background, item->steps);
}

static void put_items(struct strbuf *out, const struct sweep_report *report) {
    strbuf_format(
        out,
        "\n%s: their verdict, the precision chosen, the share of pixels off and the pixels that\n"
        "show the background through something closed, in single and in double precision and in the\n"
        "reference, and the steps of the feature that decides\n",
        report->all ? "All scenes" : "Scenes that are not right");
    for (uint32_t i = 0; i < report->sweep->count; i++)
        if (report->all || sweep_is_noted(&report->sweep->items[i]))
            put_item(out, &report->sweep->items[i]);
}

static void put_family(struct strbuf *out, const struct sweep *sweep, enum sweep_family family) {
    uint32_t count = 0, doubles = 0, verdicts[SWEEP_VERDICTS] = {0};
    double worst = 0, seconds = 0;
    for (uint32_t i = 0; i < sweep->count; i++) {
        const struct sweep_item *item = &sweep->items[i];
        if (item->family != family)
            continue;
        count++;
        doubles += item->is_double;
        verdicts[item->verdict]++;
        seconds += item->seconds;
        if (item->verdict == SWEEP_WRONG)
            worst = fmax(worst, item->pictures[SWEEP_SINGLE].off);
    }
    if (count)
        strbuf_format(out, "  %-14s %6u %6u %6u %8u %6u %9.5f %7.3f\n", sweep_families[family].name, count,
                      doubles, verdicts[SWEEP_WRONG], verdicts[SWEEP_NEEDLESS], verdicts[SWEEP_BEYOND], worst,
                      seconds / count);
}

void sweep_text(const struct sweep_report *report, struct strbuf *out) {
    const struct sweep *s = report->sweep;
    strbuf_format(out, "%u random scenes of seed %llu, %u x %u pixels, on %s\n\n", s->count,
                  (unsigned long long)report->input->seed, report->input->width, report->input->height,
                  s->device);
    strbuf_format(out, "  %-14s %6s %6s %6s %8s %6s %9s %7s\n", "family", "scenes", "double", "wrong",
                  "needless", "beyond", "worst", "s each");
    for (int i = 0; i < SWEEP_FAMILIES; i++)
        put_family(out, s, (enum sweep_family)i);
    put_items(out, report);
    strbuf_format(out, "\n%u scenes, %.1f s\n", s->count, s->seconds);
    strbuf_format(out, "chosen wrong: %u, at most %u\n", s->verdicts[SWEEP_WRONG], report->max_wrong);
    strbuf_format(out, "doubles not needed: %u of %u (%.2f %%), at most %.2f %%\n",
                  s->verdicts[SWEEP_NEEDLESS], s->doubles, 100 * sweep_needless(s),
                  100 * report->max_needless);
    strbuf_format(out, "beyond double precision: %u\n", s->verdicts[SWEEP_BEYOND]);
}

static void json_picture(struct json_writer *w, const char *key, const struct sweep_picture *picture) {
    json_open_object(w, key);
    json_write_real(w, "off", picture->off);
    json_write_integer(w, "background", picture->background);
    json_write_boolean(w, "wrong", picture->wrong);
    json_close_object(w);
}

static void json_item(struct json_writer *w, const struct sweep_item *item) {
    json_open_object(w, NULL);
    json_write_text(w, "family", str_from(sweep_families[item->family].name));
    json_write_integer(w, "number", item->number);
    json_write_text(w, "verdict", str_from(sweep_verdict_names[item->verdict]));
    json_write_text(w, "precision", str_from(precision_of(item)));
    json_write_real(w, "trial", item->trial_off);
    if (isfinite(item->steps))
        json_write_real(w, "steps", item->steps);
    json_picture(w, "single", &item->pictures[SWEEP_SINGLE]);
    json_picture(w, "double", &item->pictures[SWEEP_DOUBLE]);
    json_write_integer(w, "reference_background", item->pictures[SWEEP_REFERENCE].background);
    json_write_real(w, "seconds", item->seconds);
    json_close_object(w);
}

void sweep_json(const struct sweep_report *report, struct strbuf *out) {
    const struct sweep *s = report->sweep;
    struct json_writer w;
    json_writer_init(&w, out, 2);
    json_open_object(&w, NULL);
    json_write_text(&w, "device", str_from(s->device));
    json_write_integer(&w, "seed", report->input->seed);
    json_write_integer(&w, "width", report->input->width);
    json_write_integer(&w, "height", report->input->height);
    json_write_integer(&w, "count", s->count);
    json_write_integer(&w, "doubles", s->doubles);
    for (int i = 0; i < SWEEP_VERDICTS; i++)
        json_write_integer(&w, sweep_verdict_names[i], s->verdicts[i]);
    json_write_integer(&w, "max_wrong", report->max_wrong);
    json_write_real(&w, "max_needless", report->max_needless);
    json_write_boolean(&w, "broken", sweep_is_broken(report));
    json_write_real(&w, "seconds", s->seconds);
    json_open_list(&w, "scenes");
    for (uint32_t i = 0; i < s->count; i++)
        json_item(&w, &s->items[i]);
    json_close_list(&w);
    json_close_object(&w);
    json_end(&w);
}
