// libFuzzer entry: any bytes as a .glintrc.yaml. Whatever they are, each diagnostic stands in them, and the
// policy that comes out judges without a crash.
#include "load/settings/config.h"

#include <stdint.h>
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
    fprintf(stderr, "the configuration broke its promise: %s\n", what);
    abort();
}

static void judge(const struct config *config) {
    static const char *const paths[] = {"/", "/none/a.glint.yaml", "/none/x/y/z/a.obj", "relative"};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++)
        diag_policy_ignores(&config->policy, str_from(paths[i]));
    for (diag_code i = diag_next(-1); i < DIAG_CODE_COUNT; i = diag_next(i)) {
        struct diag item = {.code = i, .severity = diag_info(i)->severity};
        bool was_error = item.severity == DIAG_ERROR;
        bool kept = diag_policy_keeps(&config->policy, &item, true);
        require(!was_error || (kept && item.severity == DIAG_ERROR), "errors stay errors");
    }
}

static void check_places(const struct diag_sink *sink, uint32_t source, size_t size) {
    for (uint32_t i = 0; i < sink->count; i++) {
        span at = sink->items[i].at;
        require(at.source == source && at.begin <= at.end && at.end <= size, "a diagnostic has its place");
    }
}

struct job {
    str text;
    struct arena arena;
    struct diag_sink sink;
};

static void run(void *context) {
    struct job *job = context;
    struct source_set sources;
    struct files files;
    struct config config;
    source_set_init(&sources, &job->arena);
    files_init(&files, &job->arena);
    uint32_t source = source_add(&sources, SOURCE_KIND_OVERLAY, STR(".glintrc.yaml"), job->text);
    struct config_input input = {
        .files = &files, .sources = &sources, .sink = &job->sink, .arena = &job->arena};
    config_read(&input, source, STR("/none/.glintrc.yaml"), &config);
    check_places(&job->sink, source, job->text.len);
    judge(&config);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *text = malloc(size + 1);
    if (!text || size > UINT32_MAX / 2) {
        free(text);
        return 0;
    }
    memcpy(text, data, size);
    text[size] = '\0';
    struct job job = {.text = {text, size}};
    arena_init(&job.arena, MEMORY_BYTES);
    diag_sink_init(&job.sink);
    arena_guarded(&job.arena, run, &job);
    diag_sink_finish(&job.sink);
    arena_finish(&job.arena);
    free(text);
    return 0;
}
