// What became of the pictures, for people.
#include "cli/commands/test/test.h"

#include <math.h>

const char *const test_state_words[TEST_STATES] = {
    [TEST_PENDING] = "pending", [TEST_SAME] = "same",       [TEST_WITHIN] = "within",
    [TEST_DIFFERS] = "differs", [TEST_MISSING] = "missing", [TEST_FAILED] = "failed",
    [TEST_LIBRARY] = "library",
};

struct test_counts test_count(const struct test_run *run) {
    struct test_counts counts = {.all = run->cases.count};
    for (uint32_t i = 0; i < run->cases.count; i++) {
        const struct test_case *test = &run->cases.items[i];
        counts.of[test->state] += test->state != TEST_FAILED || !test->is_written;
        counts.written += test->is_written;
        counts.good += test->is_written || test->state == TEST_SAME || test->state == TEST_WITHIN;
    }
    return counts;
}

bool test_passed(const struct test_run *run) {
    return test_count(run).good == run->cases.count;
}

// ---- figures

static void add(struct strbuf *out, const char *words) {
    if (out->len)
        strbuf_cstr(out, ", ");
    strbuf_cstr(out, words);
}

static void metric_words(const struct test_case *test, enum metric metric, bool with_bound,
                         struct strbuf *out) {
    const struct metric_info *info = &metric_infos[metric];
    const double value = test->result.value[metric];
    add(out, info->name);
    if (isinf(value))
        strbuf_cstr(out, " infinite");
    else
        strbuf_format(out, " %.3g", value);
    if (with_bound)
        strbuf_format(out, " (%s %.3g)", info->higher_is_better ? "at least" : "at most",
                      test->settings.bounds.bound[metric]);
}

static void broken_words(const struct test_case *test, struct strbuf *out) {
    static const char *const channels[] = {"red", "green", "blue"};
    const struct measure_place *worst = &test->result.largest;
    const uint64_t not_finite = test->result.not_finite_together;
    for (int m = 0; m < METRIC_COUNT; m++)
        if (test_breaks(test, (enum metric)m))
            metric_words(test, (enum metric)m, true, out);
    if ((double)not_finite > test->settings.bounds.not_finite) {
        add(out, "");
        strbuf_format(out, "%llu pixel%s infinite or not a number in one of the two only",
                      (unsigned long long)not_finite, not_finite == 1 ? "" : "s");
    }
    if (test->result.value[METRIC_LARGEST] > 0)
        strbuf_format(out, ", the worst at %u,%u in %s: %.3g, and %.3g in the reference", worst->x, worst->y,
                      channels[worst->channel], worst->value, worst->reference);
}

static void words_of(const struct test_case *test, struct strbuf *out) {
    switch (test->state) {
    case TEST_SAME:
        strbuf_cstr(out, "the same pixels");
        break;
    case TEST_WITHIN:
        for (int m = 0; m < METRIC_COUNT; m++)
            if (test->settings.bounds.has[m])
                metric_words(test, (enum metric)m, false, out);
        if (!out->len)
            strbuf_cstr(out, "no bounds");
        break;
    case TEST_DIFFERS:
        if (test->is_measured)
            broken_words(test, out);
        break;
    case TEST_MISSING:
        strbuf_format(out, "there is no picture %.*s", STR_ARG(test->picture));
        break;
    default:
        break;
    }
}

void test_figures(const struct test_case *test, struct strbuf *out) {
    struct strbuf text;
    strbuf_init(&text);
    if (test->reason.len)
        strbuf_str(&text, test->reason);
    else
        words_of(test, &text);
    strbuf_str(out, strbuf_view(&text));
    out->failed = out->failed || text.failed;
    strbuf_finish(&text);
}

// ---- lines

void test_line(const struct test_run *run, const struct test_case *test, struct strbuf *out) {
    static const char *const words[TEST_STATES] = {
        [TEST_PENDING] = "?",       [TEST_SAME] = "ok",         [TEST_WITHIN] = "ok",
        [TEST_DIFFERS] = "DIFFERS", [TEST_MISSING] = "MISSING", [TEST_FAILED] = "FAILED",
        [TEST_LIBRARY] = "",
    };
    const bool blesses = run->cli->options.test.blesses;
    const bool good = test->state == TEST_SAME || test->state == TEST_WITHIN;
    if (test->state == TEST_LIBRARY || (run->cli->options.quiet && good))
        return;
    strbuf_format(out, "%-8s %.*s: ",
                  test->is_written  ? "wrote"
                  : blesses && good ? "kept"
                                    : words[test->state],
                  STR_ARG(test->name));
    if (test->is_written)
        strbuf_format(out, "%.*s, ", STR_ARG(test->picture));
    if (test->is_written && test->state == TEST_MISSING)
        strbuf_cstr(out, "which is new");
    else
        test_figures(test, out);
    strbuf_char(out, '\n');
    if (test->record.len && !test->is_written)
        strbuf_format(out, "         %.*s\n", STR_ARG(test->record));
}

static void part(struct strbuf *out, uint32_t count, const char *one, const char *many) {
    if (!count)
        return;
    strbuf_cstr(out, out->data && out->data[out->len - 1] != ' ' ? ", " : "");
    strbuf_format(out, "%u %s", count, count == 1 ? one : many);
}

void test_sums(const struct test_run *run, struct strbuf *out) {
    const struct test_counts c = test_count(run);
    const uint32_t kept = c.of[TEST_SAME] + c.of[TEST_WITHIN];
    strbuf_format(out, "%u picture%s: ", c.all, c.all == 1 ? "" : "s");
    part(out, kept, "within its bounds", "within their bounds");
    if (c.written) {
        part(out, c.written, "written", "written");
    } else {
        part(out, c.of[TEST_DIFFERS], "differs", "differ");
        part(out, c.of[TEST_MISSING], "is missing", "are missing");
    }
    part(out, c.of[TEST_FAILED], "failed", "failed");
}

static void advice(const struct test_run *run, struct strbuf *out) {
    const struct test_counts c = test_count(run);
    const struct cli_test *options = &run->cli->options.test;
    if (options->blesses || !(c.of[TEST_DIFFERS] + c.of[TEST_MISSING]))
        return;
    strbuf_cstr(out, "glint: ");
    if (!options->html && c.of[TEST_DIFFERS])
        strbuf_cstr(out, "--html FILE shows the differences; ");
    strbuf_format(out, "if the new picture%s right, --bless keeps %s\n",
                  c.of[TEST_DIFFERS] + c.of[TEST_MISSING] == 1 ? " is" : "s are",
                  c.of[TEST_DIFFERS] + c.of[TEST_MISSING] == 1 ? "it" : "them");
}

void test_closing(const struct test_run *run, struct strbuf *out) {
    if (run->cli->options.quiet && test_passed(run) && !test_count(run).written)
        return;
    strbuf_cstr(out, "glint: ");
    test_sums(run, out);
    if (run->left_out)
        strbuf_format(out, "; --only left out %u", run->left_out);
    strbuf_format(out, "; %.1f s\n", run->seconds);
    for (uint32_t i = 0; i < run->unused.count; i++)
        strbuf_format(out, "glint: no scene has the picture %.*s\n", STR_ARG(run->unused.items[i]));
    advice(run, out);
}
