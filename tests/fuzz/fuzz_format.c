// libFuzzer entry: any bytes as a scene file, put into its canonical layout. The layout never changes what is
// meant (parser/format/format.h proves that itself, or says FORMAT_UNSAFE), and a second time it changes
// nothing.
#include "fuzz_sample.h"
#include "parser/format/format.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MEMORY_BYTES = 64 * 1024 * 1024
};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

struct job {
    struct arena arena;
    struct source_set sources;
    struct diag_sink sink;
    struct limits limits;
    str text;
    struct strbuf once, twice;
};

static void require(bool holds, const char *what) {
    if (holds)
        return;
    fprintf(stderr, "the formatter broke its promise: %s\n", what);
    abort();
}

static enum format_status format(struct job *job, str path, str text, struct strbuf *out) {
    struct reader_context context = {
        .sources = &job->sources, .sink = &job->sink, .limits = &job->limits, .arena = &job->arena};
    uint32_t source = source_add(&job->sources, SOURCE_KIND_OVERLAY, path, text);
    return format_source(&context, source, NULL, out);
}

static void run(void *context) {
    struct job *job = context;
    str path = reader_is_xml(STR("fuzz"), job->text) ? STR("fuzz.xml") : STR("fuzz.yaml");
    source_set_init(&job->sources, &job->arena);
    enum format_status status = format(job, path, job->text, &job->once);
    require(status != FORMAT_UNSAFE, "the meaning stays");
    require(status == FORMAT_DONE || job->sink.errors > 0, "what is refused has a diagnostic");
    if (status == FORMAT_DONE && fuzz_is_chosen(job->text, 0, 2)) {
        status = format(job, path, strbuf_view(&job->once), &job->twice);
        require(status == FORMAT_DONE, "what was laid out can be laid out");
        require(str_equal(strbuf_view(&job->once), strbuf_view(&job->twice)), "once is enough");
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    struct job job = {.limits = limits_default()};
    job.limits.value[LIMIT_ALIAS_NODES] = 2000;
    job.limits.value[LIMIT_SCENE_DEPTH] = 24;
    char *copy = malloc(size ? size : 1);
    if (!copy)
        abort();
    if (size)
        memcpy(copy, data, size);
    arena_init(&job.arena, MEMORY_BYTES);
    diag_sink_init(&job.sink);
    strbuf_init(&job.once);
    strbuf_init(&job.twice);
    job.text = (str){copy, size};
    arena_guarded(&job.arena, run, &job);
    strbuf_finish(&job.once);
    strbuf_finish(&job.twice);
    diag_sink_finish(&job.sink);
    arena_finish(&job.arena);
    free(copy);
    return 0;
}
