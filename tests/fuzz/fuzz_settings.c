// libFuzzer entry: any bytes as a glint-test.yaml, as the bounds of `glint extremes` and as a baseline. Each
// diagnostic stands in them.
#include "fuzz_file.h"
#include "load/scope/baseline.h"
#include "load/settings/extreme_bounds.h"
#include "load/settings/test_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MEMORY_BYTES = 16 * 1024 * 1024
};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(bool holds, const char *what) {
    if (holds)
        return;
    fprintf(stderr, "the settings broke their promise: %s\n", what);
    abort();
}

struct job {
    str text;
    const char *path;
    struct arena arena;
    struct source_set sources;
    struct diag_sink sink;
    struct limits limits;
};

static void check_places(const struct job *job) {
    for (uint32_t i = 0; i < job->sink.count; i++) {
        const span at = job->sink.items[i].at;
        require(span_is_none(at) || (at.begin <= at.end && at.end <= job->text.len),
                "a diagnostic has its place");
    }
}

static void run(void *context) {
    struct job *job = context;
    struct test_file tests;
    struct extreme_bounds bounds = {0};
    source_set_init(&job->sources, &job->arena);
    const uint32_t source = source_add(&job->sources, SOURCE_KIND_OVERLAY, STR(TEST_FILE_NAME), job->text);
    const struct reader_context input = {
        .sources = &job->sources, .sink = &job->sink, .limits = &job->limits, .arena = &job->arena};
    test_file_init(&tests);
    if (test_file_read(&input, source, &tests))
        for (uint32_t i = 0; i < tests.entries.count; i++)
            test_settings_join(&tests.all, &tests.entries.items[i].own, &job->arena);
    extreme_bounds_read(&input, source, &bounds);
    check_places(job);
}

static void read_baseline(struct job *job) {
    struct baseline baseline;
    const uint32_t before = job->sink.count;
    if (baseline_read(&baseline, job->path, &job->arena, &job->sources, &job->sink)) {
        struct strbuf stale;
        strbuf_init(&stale);
        baseline_put_stale(&baseline, &stale);
        strbuf_finish(&stale);
    } else {
        require(job->sink.count > before, "a baseline that cannot be read has a diagnostic");
    }
    check_places(job);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *text = malloc(size + 1);
    if (!text || size > UINT32_MAX / 2) {
        free(text);
        return 0;
    }
    if (size)
        memcpy(text, data, size);
    text[size] = '\0';
    struct job job = {.text = {text, size}, .path = fuzz_file(data, size), .limits = limits_default()};
    arena_init(&job.arena, MEMORY_BYTES);
    diag_sink_init(&job.sink);
    arena_guarded(&job.arena, run, &job);
    read_baseline(&job);
    diag_sink_finish(&job.sink);
    arena_finish(&job.arena);
    free(text);
    return 0;
}
