#include "parser/parser.h"

#include "core/clock.h"
#include "core/timeline.h"
#include "grammar/ir.h"
#include "parser/bind/bind.h"
#include "parser/stages/loader.h"
#include "parser/tree/reader_text.h"

// Runs the stages; false if there is no scene.
static bool run(struct loader *loader, uint32_t main_source, bool alone) {
    struct parser_output *output = loader->output;
    struct timeline *timeline = loader->input->timeline;
    double start = clock_seconds();
    ir_origin_init(&output->origin, loader->input->arena);
    schema_index_init(&loader->index, &loader->steady);
    loader_add_file(loader, main_source, 0, SPAN_NONE);
    output->scene = loader->files.items[0].scene;
    if (alone || !output->scene)
        return output->scene != NULL;
    resolve_includes(loader, 0);
    timeline_add(timeline, "parse", STR(""), start);
    start = clock_seconds();
    output->scene = merge_files(loader);
    override_apply(loader, output->scene);
    animate_scene(loader, output->scene);
    names_resolve(loader, output->scene);
    merge_compact(loader, output->scene);
    validate_scene(loader, output->scene);
    resolve_note_includes(loader);
    timeline_add(timeline, "validate", STR(""), start);
    return true;
}

static void report_fault(const struct parser_input *input, uint32_t source, enum arena_fault fault) {
    span at = {source, 0, 0};
    if (fault == ARENA_FAULT_CAP)
        reader_limit(input->sink, input->limits, LIMIT_SCENE_MEMORY, at, "the scene needs too much memory");
    else
        diag_add(input->sink, DIAG_OUT_OF_MEMORY, at, "not enough memory for the scene");
}

struct job {
    struct loader *loader;
    uint32_t main_source;
    bool alone, done;
};

static void run_job(void *context) {
    struct job *job = context;
    job->done = run(job->loader, job->main_source, job->alone);
}

static bool guarded(struct loader *loader, uint32_t main_source, bool alone) {
    const struct parser_input *input = loader->input;
    struct arena *arenas[] = {input->arena,     input->sources->arena, input->files->arena,
                              &loader->scratch, &loader->steady,       NULL};
    struct job job = {loader, main_source, alone, false};
    enum arena_fault fault = arena_guarded_all(arenas, run_job, &job);
    if (fault == ARENA_FAULT_NONE)
        return job.done;
    report_fault(input, main_source, fault);
    *loader->output = (struct parser_output){.scene = NULL};
    return false;
}

static bool load(const struct parser_input *input, uint32_t main_source, bool alone,
                 struct parser_output *output) {
    struct loader loader = {.input = input, .output = output};
    *output = (struct parser_output){.scene = NULL};
    arena_init(&loader.scratch, limits_size(input->limits, LIMIT_SCENE_MEMORY));
    arena_init(&loader.steady, limits_size(input->limits, LIMIT_SCENE_MEMORY));
    bool done = guarded(&loader, main_source, alone);
    diag_sink_finish(&loader.trial);
    bind_stream_finish(&loader.stream);
    arena_finish(&loader.scratch);
    arena_finish(&loader.steady);
    return done;
}

bool parser_load(const struct parser_input *input, uint32_t main_source, struct parser_output *output) {
    return load(input, main_source, false, output);
}

bool parser_load_file(const struct parser_input *input, uint32_t source, struct parser_output *output) {
    return load(input, source, true, output);
}
