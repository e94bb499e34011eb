#include "parser/parser.h"

#include "parser/bind/bind.h"
#include "parser/stages/loader.h"
#include "parser/tree/reader.h"
#include "parser/tree/reader_text.h"

static struct bind_context binding(struct loader *loader, struct diag_sink *sink, const struct tree *tree) {
    return (struct bind_context){.sink = sink,
                                 .sources = loader->input->sources,
                                 .origin = &loader->output->origin,
                                 .arena = loader->input->arena,
                                 .scratch = &loader->scratch,
                                 .index = &loader->index,
                                 .texts = &loader->texts,
                                 .tree = tree};
}

static struct reader_context reading(struct loader *loader, struct diag_sink *sink) {
    return (struct reader_context){.sources = loader->input->sources,
                                   .sink = sink,
                                   .limits = loader->input->limits,
                                   .arena = &loader->scratch};
}

typedef bool read_file(const struct reader_context *context, uint32_t source, struct tree *tree);

// Binds the entries of large lists while they are read. NULL, and nothing is said, where there is more to say
// than of single entries: then the file is read whole.
static struct ir_scene *stream_file(struct loader *loader, read_file *read, uint32_t source,
                                    struct tree *tree) {
    struct diag_sink *sink = &loader->trial;
    struct bind_stream *stream = &loader->stream;
    diag_sink_init(sink);
    struct bind_context context = binding(loader, sink, tree);
    bind_stream_begin(stream, &context, (size_t)loader->input->limits->value[LIMIT_SCENE_MEMORY]);
    struct reader_context reader = reading(loader, sink);
    reader.taker = &stream->taker;
    struct ir_scene *scene = read(&reader, source, tree) ? bind_file(&context) : NULL;
    if (!scene || sink->count) {
        scene = NULL;
        bind_stream_forget(stream);
        arena_finish(&loader->scratch);
        *tree = (struct tree){.source = source};
    }
    diag_merge(loader->input->sink, &stream->sink);
    bind_stream_finish(stream);
    diag_sink_finish(sink);
    return scene;
}

static void keep_directives(struct loader *loader, const struct tree *tree) {
    for (uint32_t i = 0; i < tree->directives.count; i++) {
        struct tree_comment at = tree->directives.items[i];
        *ARENA_PUSH(loader->input->arena, &loader->output->origin.directives) =
            (span){tree->source, at.begin, at.end};
    }
}

static struct ir_scene *load_source(struct loader *loader, uint32_t source, struct ir_file_origin *file) {
    const struct parser_input *input = loader->input;
    const struct source *text = &input->sources->items[source];
    struct tree tree = {.source = source};
    bool is_xml = reader_is_xml(text->path, text->text);
    read_file *read = is_xml ? read_xml : read_yaml;
    *file = (struct ir_file_origin){.source = source, .is_xml = is_xml};
    struct ir_scene *scene = input->whole ? NULL : stream_file(loader, read, source, &tree);
    bool readable = scene != NULL;
    if (!scene) {
        struct reader_context reader = reading(loader, input->sink);
        struct bind_context context = binding(loader, input->sink, &tree);
        readable = read(&reader, source, &tree);
        scene = readable ? bind_file(&context) : NULL;
    }
    keep_directives(loader, &tree);
    if (readable) {
        file->schema_line = tree.schema_line;
        file->xsi_attributes = arena_copy(input->arena, tree.xsi_attributes);
        file->closing_comments = tree.closing_comments;
    }
    int includes = schema_find_row(&SCHEMA_SCENE, STR("include"));
    bool lost = scene && (scene->head.poisoned & bind_bit((uint32_t)includes));
    loader->incomplete = loader->incomplete || !scene || tree.broken || lost;
    file->scene = scene;
    arena_finish(&loader->scratch);
    return scene;
}

uint32_t loader_add_file(struct loader *loader, uint32_t source, uint32_t parent, span include) {
    struct arena *arena = loader->input->arena;
    uint32_t index = loader->files.count;
    struct loader_file *file = ARENA_PUSH(arena, &loader->files);
    *file = (struct loader_file){
        .path = files_canonical(loader->input->files, loader->input->sources->items[source].path),
        .source = source,
        .parent = parent,
        .include = include};
    struct ir_file_origin origin;
    struct ir_scene *scene = load_source(loader, source, &origin);
    origin.included_at = include;
    *ARENA_PUSH(arena, &loader->output->origin.files) = origin;
    loader->files.items[index].scene = scene;
    return index;
}

// Runs the stages; false where there is no scene.
static bool run(struct loader *loader, uint32_t main_source, bool alone) {
    struct parser_output *output = loader->output;
    ir_origin_init(&output->origin, loader->input->arena);
    schema_index_init(&loader->index, &loader->steady);
    loader_add_file(loader, main_source, 0, SPAN_NONE);
    output->scene = loader->files.items[0].scene;
    if (alone || !output->scene)
        return output->scene != NULL;
    resolve_includes(loader, 0);
    output->scene = merge_files(loader);
    override_apply(loader, output->scene);
    names_resolve(loader, output->scene);
    merge_compact(loader, output->scene);
    validate_scene(loader, output->scene);
    resolve_note_includes(loader);
    return true;
}

static void report_fault(const struct parser_input *input, uint32_t source, enum arena_fault fault) {
    span at = {source, 0, 0};
    if (fault == ARENA_FAULT_CAP)
        reader_limit(input->sink, input->limits, LIMIT_SCENE_MEMORY, at, "the scene needs too much memory");
    else
        diag_add(input->sink, DIAG_OUT_OF_MEMORY, at, "not enough memory for the scene");
}

// The arenas that the stages allocate from, and the guards that they had before.
enum {
    ARENAS = 5
};
struct guards {
    struct arena *arena[ARENAS];
    struct arena_guard *before[ARENAS];
};

static struct guards take_guards(struct loader *loader, struct arena_guard *guard) {
    const struct parser_input *input = loader->input;
    struct guards guards = {.arena = {input->arena, input->sources->arena, input->files->arena,
                                      &loader->scratch, &loader->steady}};
    for (int i = 0; i < ARENAS; i++)
        guards.before[i] = guards.arena[i]->guard;
    for (int i = 0; i < ARENAS; i++)
        arena_set_guard(guards.arena[i], guard);
    return guards;
}

static void give_guards_back(const struct guards *guards) {
    for (int i = 0; i < ARENAS; i++)
        guards->arena[i]->guard = guards->before[i];
}

static bool guarded(struct loader *loader, uint32_t main_source, bool alone) {
    struct arena_guard guard;
    struct guards guards = take_guards(loader, &guard);
    if (setjmp(guard.jump) == 0) {
        bool done = run(loader, main_source, alone);
        give_guards_back(&guards);
        return done;
    }
    give_guards_back(&guards);
    report_fault(loader->input, main_source, guard.fault);
    *loader->output = (struct parser_output){.scene = NULL};
    return false;
}

static bool load(const struct parser_input *input, uint32_t main_source, bool alone,
                 struct parser_output *output) {
    struct loader loader = {.input = input, .output = output};
    *output = (struct parser_output){.scene = NULL};
    arena_init(&loader.scratch, (size_t)input->limits->value[LIMIT_SCENE_MEMORY]);
    arena_init(&loader.steady, (size_t)input->limits->value[LIMIT_SCENE_MEMORY]);
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
