// The report of glint test for programs: docs/schema/test-report.schema.json.
#include "cli/commands/test/test.h"

#include "core/json_write.h"

static void metrics(const struct test_case *test, struct json_writer *json) {
    const struct measure_bounds *bounds = &test->settings.bounds;
    json_open_object(json, "metrics");
    for (int m = 0; test->is_measured && m < METRIC_COUNT; m++)
        if (bounds->has[m] || test->result.value[m] == test->result.value[m])
            json_write_real(json, metric_infos[m].name, test->result.value[m]);
    json_close_object(json);
    json_open_object(json, "bounds");
    for (int m = 0; m < METRIC_COUNT; m++)
        if (bounds->has[m])
            json_write_real(json, metric_infos[m].name, bounds->bound[m]);
    json_close_object(json);
    json_write_real(json, "threshold", test->settings.threshold);
}

static void worst(const struct test_case *test, struct json_writer *json) {
    const struct measure_place *place = &test->result.largest;
    if (!test->is_measured || test->state == TEST_SAME)
        return;
    json_open_object(json, "worst");
    json_write_integer(json, "x", place->x);
    json_write_integer(json, "y", place->y);
    json_write_integer(json, "channel", place->channel);
    json_write_real(json, "value", place->value);
    json_write_real(json, "reference", place->reference);
    json_close_object(json);
    json_write_integer(json, "not_finite", test->result.not_finite_together);
}

static void one(const struct test_case *test, struct json_writer *json) {
    struct strbuf words;
    strbuf_init(&words);
    test_figures(test, &words);
    json_open_object(json, NULL);
    json_write_text(json, "name", test->name);
    json_write_text(json, "scene", test->scene);
    json_write_text(json, "picture", test->picture);
    json_write_text(json, "state", str_from(test_state_words[test->state]));
    json_write_boolean(json, "written", test->is_written);
    if (test->settings.camera.len)
        json_write_text(json, "camera", test->settings.camera);
    if (test->now.width) {
        json_write_integer(json, "width", test->now.width);
        json_write_integer(json, "height", test->now.height);
        json_write_integer(json, "samples", (uint64_t)test->samples);
    }
    metrics(test, json);
    worst(test, json);
    json_write_text(json, "words", strbuf_view(&words));
    if (test->record.len)
        json_write_text(json, "record", test->record);
    json_write_real(json, "seconds", test->seconds);
    json_close_object(json);
    json->out->failed = json->out->failed || words.failed;
    strbuf_finish(&words);
}

void test_json(const struct test_run *run, struct strbuf *out) {
    const struct test_counts counts = test_count(run);
    struct json_writer json;
    json_report_begin(&json, out, 3, "glint test", 1);
    json_write_text(&json, "folder", run->folder);
    if (run->file_path.len)
        json_write_text(&json, "file", run->file_path);
    json_open_list(&json, "tests");
    for (uint32_t i = 0; i < run->cases.count; i++)
        one(&run->cases.items[i], &json);
    json_close_list(&json);
    json_open_list(&json, "unused");
    for (uint32_t i = 0; i < run->unused.count; i++)
        json_write_text(&json, NULL, run->unused.items[i]);
    json_close_list(&json);
    json_open_object(&json, "counts");
    json_write_integer(&json, "all", counts.all);
    for (int state = TEST_SAME; state <= TEST_FAILED; state++)
        json_write_integer(&json, test_state_words[state], counts.of[state]);
    json_write_integer(&json, "written", counts.written);
    json_write_integer(&json, "left_out", run->left_out);
    json_close_object(&json);
    json_write_integer(&json, "scenes_read", run->loads);
    json_write_real(&json, "seconds", run->seconds);
    json_write_boolean(&json, "passed", test_passed(run));
    json_report_end(&json);
}
