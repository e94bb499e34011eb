#include "parser/bind/bind_stream.h"

#include <string.h>

static struct bind_stream *stream_of(struct reader_taker *taker) {
    return (struct bind_stream *)taker;
}

static bool wants(struct reader_taker *taker, const struct tree *tree, tree_index key, enum tree_kind kind) {
    struct bind_stream *stream = stream_of(taker);
    stream->context->tree = tree;
    bool single;
    int row = bind_find_row(stream->context, stream->root.schema, key, &single);
    if (row < 0 || single || stream->root.schema->rows[row].kind != SCHEMA_LIST)
        return false;
    return tree->is_xml ||
           kind == (stream->root.schema->rows[row].many == SCHEMA_NAMED_MAP ? TREE_MAP : TREE_LIST);
}

static void bind_taken(struct bind_stream *stream, tree_index list_key, tree_index entry) {
    struct bind_context *context = stream->context;
    bool single;
    int row = bind_find_row(context, stream->root.schema, list_key ? list_key : entry, &single);
    bool has_key = tree_node(context->tree, entry)->key != TREE_KEY_NONE;
    bool named = has_key && !context->tree->is_xml;
    struct bind_given given = {.comments = tree_comments(context->tree, entry), .value = entry};
    if (has_key)
        given = bind_given_by(context, entry);
    bind_entry(context, &stream->root, &stream->root.schema->rows[row],
               named ? tree_text(context->tree, entry) : STR(""), given);
}

struct taken {
    struct bind_stream *stream;
    tree_index list_key, entry;
};

static void run_taken(void *context) {
    const struct taken *taken = context;
    bind_taken(taken->stream, taken->list_key, taken->entry);
    arena_reset(&taken->stream->entry);
}

static bool take(struct reader_taker *taker, const struct tree *tree, tree_index list_key, tree_index entry) {
    // The missing value of a name may come after it, in the wrong column.
    if (tree_node(tree, entry)->key == TREE_KEY_PLAIN &&
        tree_node(tree, tree_value(tree, entry))->kind == TREE_NULL)
        return false;
    struct bind_stream *stream = stream_of(taker);
    struct bind_context *context = stream->context;
    struct arena *scratch = context->scratch;
    struct diag_sink *sink = context->sink;
    struct arena *arenas[] = {context->arena, &stream->entry, NULL};
    struct taken taken = {stream, list_key, entry};
    context->tree = tree;
    context->scratch = &stream->entry;
    context->sink = &stream->sink;
    enum arena_fault fault = arena_guarded_all(arenas, run_taken, &taken);
    context->scratch = scratch;
    context->sink = sink;
    return fault == ARENA_FAULT_NONE;
}

void bind_stream_begin(struct bind_stream *stream, struct bind_context *context, size_t memory_bytes) {
    *stream = (struct bind_stream){.taker = {wants, take},
                                   .context = context,
                                   .elements_mark = context->origin->elements.count,
                                   .rows_mark = context->origin->rows.count};
    arena_init(&stream->entry, memory_bytes);
    diag_sink_init(&stream->sink);
    diag_sink_keep(&stream->sink, context->sink->kept_max);
    context->scene = bind_new_scene(context);
    stream->root = (struct bind_frame){.schema = &SCHEMA_SCENE, .memory = context->scene};
}

void bind_stream_forget(struct bind_stream *stream) {
    struct bind_context *context = stream->context;
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++)
        if (SCHEMA_SCENE.rows[i].kind == SCHEMA_LIST)
            bind_list_give_back(context->arena, schema_field(&SCHEMA_SCENE.rows[i], context->scene),
                                SCHEMA_SCENE.rows[i].child->size);
    diag_sink_finish(&stream->sink);
    context->origin->elements.count = stream->elements_mark;
    context->origin->rows.count = stream->rows_mark;
    context->scene = NULL;
    context->other_version = false;
}

void bind_stream_finish(struct bind_stream *stream) {
    diag_sink_finish(&stream->sink);
    arena_finish(&stream->entry);
}
