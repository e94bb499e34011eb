// Where findings are reported and what they call things.
#include "lint/lint_parts.h"

#include "assets/file/asset_file.h"
#include "grammar/ir.h"

#include <stdarg.h>
#include <stdio.h>

enum {
    NOTE_MAX = 512
};

str lint_words(struct lint *lint, const struct lint_body *body) {
    if (body->is->name.len)
        return arena_format(lint->arena, "%s '%.*s'", body->is->element->name, STR_ARG(body->is->name));
    return arena_format(lint->arena, "this %s", body->is->element->name);
}

str lint_words_other(struct lint *lint, const struct lint_body *body) {
    if (body->is->name.len)
        return lint_words(lint, body);
    return arena_format(lint->arena, "a %s", body->is->element->name);
}

span lint_place(const struct lint *lint, const struct lint_body *body) {
    return ir_place_label(lint->origin, body->is->head);
}

span lint_place_mesh(const struct lint *lint, const struct lint_body *body) {
    return ir_place_value(lint->origin, body->is->head, body->is->element, "mesh");
}

// The source with the mesh's text that an earlier message made, if there is one.
static uint32_t known_source(const struct source_set *sources, str path) {
    for (uint32_t i = 1; i < sources->count; i++) {
        const struct source *source = &sources->items[i];
        if (source->kind == SOURCE_KIND_FILE && source->text.len && str_equal(source->path, path))
            return i;
    }
    return SOURCE_DEFAULT;
}

void lint_note_mesh(struct lint *lint, struct lint_mesh *mesh, uint32_t line, const char *format, ...) {
    char text[NOTE_MAX];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    const struct assets_input *input = lint->input->files;
    if (mesh->source == SOURCE_DEFAULT)
        mesh->source = known_source(input->sources, mesh->mesh->path);
    struct asset_file file = {.input = input,
                              .path = mesh->mesh->path,
                              .what = "mesh",
                              .limit = LIMIT_MESH_BYTES,
                              .source = mesh->source,
                              .is_binary = mesh->mesh->is_binary};
    span at = asset_line(&file, line);
    mesh->source = file.source;
    if (file.is_binary || input->sources->items[at.source].text.len == 0)
        diag_note(lint->sink, at, "%s %u: %s", mesh_place_word(mesh->mesh), line, text);
    else
        diag_note(lint->sink, at, "%s", text);
}
