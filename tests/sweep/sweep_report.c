// A sweep as text.
#include "tests/sweep/sweep.h"

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
