// One file of a scene: read, and bound to the IR of only that file.
#include "parser/stages/loader.h"

#include "grammar/ir.h"
#include "parser/bind/bind.h"
#include "parser/tree/reader.h"

struct bind_context loader_binding(struct loader *loader, struct diag_sink *sink, const struct tree *tree) {
    return (struct bind_context){.sink = sink,
                                 .sources = loader->input->sources,
                                 .limits = loader->input->limits,
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

// Binds the entries of large lists while they are read. If there is more to report than mistakes in single
// entries, returns NULL and reports nothing: then the file is read whole.
static struct ir_scene *stream_file(struct loader *loader, read_file *read, uint32_t source,
                                    struct tree *tree) {
    struct diag_sink *sink = &loader->trial;
    struct bind_stream *stream = &loader->stream;
    diag_sink_init(sink);
    diag_sink_keep(sink, loader->input->sink->kept_max);
    struct bind_context context = loader_binding(loader, sink, tree);
    bind_stream_begin(stream, &context, limits_size(loader->input->limits, LIMIT_SCENE_MEMORY));
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
        struct bind_context context = loader_binding(loader, input->sink, &tree);
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
