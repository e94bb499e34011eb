#include "parser/parser.h"
#include "diag/codes/limit.h"

#include "core/clock.h"
#include "core/heap.h"
#include "core/timeline.h"
#include "grammar/ir.h"
#include "grammar/ir_copy.h"
#include "grammar/preset.h"
#include "parser/bind/bind.h"
#include "parser/stages/loader.h"
#include "parser/tree/reader_text.h"

#include <stdlib.h>

// The stages after merging.
static void run_scene(struct loader *loader) {
    struct parser_output *output = loader->output;
    const double start = clock_seconds();
    override_apply(loader, output->scene);
    preset_take(output->scene);
    names_resolve(loader, output->scene);
    struct ir_scene *objects = unshown_begin(loader, output->scene);
    animate_scene(loader, output->scene);
    merge_compact(loader, output->scene);
    validate_scene(loader, output->scene);
    if (objects)
        unshown_judge(loader, objects);
    resolve_note_includes(loader);
    timeline_add(loader->input->timeline, "validate", STR(""), start);
}

enum extent {
    EXTENT_FILE,  // the first two stages
    EXTENT_FILES, // up to merging
    EXTENT_SCENE, // all of them
};

// Runs the stages; false if there is no scene.
static bool run(struct loader *loader, uint32_t main_source, enum extent extent) {
    struct parser_output *output = loader->output;
    struct timeline *timeline = loader->input->timeline;
    const double start = clock_seconds();
    ir_origin_init(&output->origin, loader->input->arena);
    schema_index_init(&loader->index, &loader->steady);
    loader_add_file(loader, main_source, 0, SPAN_NONE);
    output->scene = loader->files.items[0].scene;
    if (extent == EXTENT_FILE || !output->scene)
        return output->scene != NULL;
    resolve_includes(loader, 0);
    output->scene = merge_files(loader);
    timeline_add(timeline, "parse", STR(""), start);
    if (extent == EXTENT_SCENE)
        run_scene(loader);
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
    const struct parser_kept *kept; // NULL: from the files
    uint32_t main_source;
    enum extent extent;
    bool done;
};

// A kept scene: the loader's files and names, and the scene.
struct parser_kept {
    struct loader loader;
    struct parser_input input;
    struct parser_output output;
};

static void run_job(void *context) {
    struct job *job = context;
    struct loader *loader = job->loader;
    if (!job->kept) {
        job->done = run(loader, job->main_source, job->extent);
        return;
    }
    ir_origin_copy(&job->kept->output.origin, loader->input->arena, &loader->output->origin);
    loader->output->scene = ir_copy(job->kept->output.scene, loader->input->arena);
    loader->output->scene->formulas = loader->output->origin.formulas;
    run_scene(loader);
    job->done = true;
}

static bool guarded(struct job *job) {
    struct loader *loader = job->loader;
    const struct parser_input *input = loader->input;
    struct arena *arenas[] = {input->arena,     input->sources->arena, input->files->arena,
                              &loader->scratch, &loader->steady,       NULL};
    const enum arena_fault fault = arena_guarded_all(arenas, run_job, job);
    if (fault == ARENA_FAULT_NONE)
        return job->done;
    report_fault(input, job->main_source, fault);
    *loader->output = (struct parser_output){.scene = NULL};
    return false;
}

static void begin(struct loader *loader) {
    *loader->output = (struct parser_output){.scene = NULL};
    arena_init(&loader->scratch, limits_size(loader->input->limits, LIMIT_SCENE_MEMORY));
    arena_init(&loader->steady, limits_size(loader->input->limits, LIMIT_SCENE_MEMORY));
}

// Frees all but the steady arena, which has names that a kept scene still needs.
static void end(struct loader *loader) {
    diag_sink_finish(&loader->trial);
    bind_stream_finish(&loader->stream);
    arena_finish(&loader->scratch);
}

static bool load(const struct parser_input *input, uint32_t main_source, enum extent extent,
                 struct parser_output *output) {
    struct loader loader = {.input = input, .output = output};
    struct job job = {.loader = &loader, .main_source = main_source, .extent = extent};
    begin(&loader);
    const bool done = guarded(&job);
    end(&loader);
    arena_finish(&loader.steady);
    return done;
}

bool parser_load(const struct parser_input *input, uint32_t main_source, struct parser_output *output) {
    return load(input, main_source, EXTENT_SCENE, output);
}

bool parser_load_file(const struct parser_input *input, uint32_t source, struct parser_output *output) {
    return load(input, source, EXTENT_FILE, output);
}

// ---- a scene that is kept

struct parser_kept *parser_keep(const struct parser_input *input, uint32_t main_source) {
    struct parser_kept *kept = heap_zeroed(1, sizeof *kept);
    if (!kept)
        return NULL;
    kept->input = *input;
    kept->loader = (struct loader){.input = &kept->input, .output = &kept->output};
    struct job job = {.loader = &kept->loader, .main_source = main_source, .extent = EXTENT_FILES};
    begin(&kept->loader);
    const bool done = guarded(&job);
    end(&kept->loader);
    const struct diag_sink *sink = input->sink;
    if (done && sink->count + sink->dropped == 0)
        return kept;
    parser_drop(kept);
    return NULL;
}

void parser_drop(struct parser_kept *kept) {
    if (kept)
        arena_finish(&kept->loader.steady);
    free(kept);
}

bool parser_load_kept(const struct parser_kept *kept, const struct parser_input *input,
                      struct parser_output *output) {
    struct loader loader = {.input = input,
                            .output = output,
                            .index = kept->loader.index,
                            .texts = kept->loader.texts,
                            .files = kept->loader.files,
                            .order = kept->loader.order,
                            .refused = kept->loader.refused,
                            .incomplete = kept->loader.incomplete};
    struct job job = {.loader = &loader, .kept = kept};
    begin(&loader);
    output->unread = kept->output.unread;
    const bool done = guarded(&job);
    end(&loader);
    arena_finish(&loader.steady);
    return done;
}
