#include "parser/parser.h"

#include "parser/bind.h"
#include "parser/loader.h"
#include "parser/reader.h"
#include "parser/reader_text.h"

static struct ir_scene *bind_tree(struct loader *loader, const struct tree *tree) {
    struct bind_context context = {.sink = loader->input->sink,
                                   .sources = loader->input->sources,
                                   .origin = &loader->output->origin,
                                   .arena = loader->input->arena,
                                   .scratch = &loader->scratch,
                                   .tree = tree};
    return bind_file(&context);
}

static struct ir_scene *load_source(struct loader *loader, uint32_t source, struct ir_file_origin *file) {
    const struct parser_input *input = loader->input;
    const struct source *text = &input->sources->items[source];
    struct reader_context context = {
        .sources = input->sources, .sink = input->sink, .limits = input->limits, .arena = &loader->scratch};
    struct tree tree = {.source = source};
    bool is_xml = reader_is_xml(text->path, text->text);
    bool readable = (is_xml ? read_xml : read_yaml)(&context, source, &tree);
    *file = (struct ir_file_origin){.source = source, .is_xml = is_xml};
    struct ir_scene *scene = readable ? bind_tree(loader, &tree) : NULL;
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
        diag_add(input->sink, DIAG_OUT_OF_MEMORY, at, "the system gave no more memory for the scene");
}

// The arenas that the stages allocate from, and the guards that they had before.
enum {
    ARENAS = 4
};
struct guards {
    struct arena *arena[ARENAS];
    struct arena_guard *before[ARENAS];
};

static struct guards take_guards(struct loader *loader, struct arena_guard *guard) {
    const struct parser_input *input = loader->input;
    struct guards guards = {
        .arena = {input->arena, input->sources->arena, input->files->arena, &loader->scratch}};
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
    bool done = guarded(&loader, main_source, alone);
    arena_finish(&loader.scratch);
    return done;
}

bool parser_load(const struct parser_input *input, uint32_t main_source, struct parser_output *output) {
    return load(input, main_source, false, output);
}

bool parser_load_file(const struct parser_input *input, uint32_t source, struct parser_output *output) {
    return load(input, source, true, output);
}
