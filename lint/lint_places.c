// Where findings are reported and what they call things.
#include "lint/lint_internal.h"

#include "assets/file/asset_file.h"
#include "grammar/ir.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"

#include <stdarg.h>
#include <stdio.h>

enum {
    NOTE_MAX = 512
};

bool lint_is_copy(const struct lint *lint, const struct lint_body *body) {
    const struct schema_row *list = ir_walk_pool(body->is->element);
    const struct ir_copies *copies = lint->origin->copies;
    return ir_copies_at(copies, list, body->is->index) || ir_copies_instance(copies, list, body->is->index);
}

// "this sphere", or of a copy "sphere spheres[2][3]"
static str unnamed(const struct lint *lint, const struct lint_body *body, const char *word) {
    const char *kind = body->is->element->name;
    const struct schema_row *list = ir_walk_pool(body->is->element);
    if (!lint_is_copy(lint, body))
        return arena_format(lint->arena, "%s %s", word, kind);
    struct strbuf label;
    strbuf_init(&label);
    ir_copies_label(lint->origin->copies, list, body->is->index, &label);
    const str words = arena_format(lint->arena, "%s %.*s", kind, STR_ARG(strbuf_view(&label)));
    strbuf_finish(&label);
    return words;
}

str lint_words(struct lint *lint, const struct lint_body *body) {
    if (body->is->name.len)
        return arena_format(lint->arena, "%s '%.*s'", body->is->element->name, STR_ARG(body->is->name));
    return unnamed(lint, body, "this");
}

str lint_words_other(struct lint *lint, const struct lint_body *body) {
    if (body->is->name.len)
        return lint_words(lint, body);
    return unnamed(lint, body, "a");
}

str lint_material_words(struct lint *lint, const struct ir_material *material) {
    if (material->name.len)
        return arena_format(lint->arena, "material '%.*s'", STR_ARG(material->name));
    return STR("this material");
}

bool lint_is_written(const struct ir_head *head, const struct schema_element *schema, const char *row) {
    return head->written >> schema_find_row(schema, str_from(row)) & 1;
}

span lint_place(const struct lint *lint, const struct lint_body *body) {
    return ir_place_label(lint->origin, body->is->head);
}

span lint_place_mesh(const struct lint *lint, const struct lint_body *body) {
    return body->is->element == &SCHEMA_MODEL
               ? ir_place_value(lint->origin, body->is->head, &SCHEMA_MODEL, "mesh")
               : ir_place_label(lint->origin, body->is->head);
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

const struct ir_faces *lint_faces(const struct lint *lint, const struct lint_mesh *mesh) {
    const struct scene_body *body = mesh->first->is;
    if (!mesh->mesh->is_made || body->element != &SCHEMA_MODEL)
        return NULL;
    const struct ir_mesh *ir = &lint->ir->meshes.items[lint->ir->models.items[body->index].mesh.index];
    return ir->kind == IR_MESH_FACES ? &ir->faces : NULL;
}

void lint_note_mesh(struct lint *lint, struct lint_mesh *mesh, uint32_t line, const char *format, ...) {
    char text[NOTE_MAX];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    const struct ir_faces *faces = lint_faces(lint, mesh);
    if (faces)
        diag_note(lint->sink, ir_place_label(lint->origin, &faces->faces.items[line - 1].head), "%s", text);
    if (mesh->mesh->is_made)
        return;
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

void lint_fix_row(struct lint *lint, const struct ir_head *head, const struct schema_element *schema,
                  const char *row, const char *beside, const char *value) {
    const struct source_set *sources = lint->input->files->sources;
    const int own = schema_find_row(schema, str_from(row));
    const int other = schema_find_row(schema, str_from(beside));
    const struct ir_row_origin *at = ir_origin_row(lint->origin, head, (uint32_t)own);
    if (at) {
        diag_fix(lint->sink, false, at->value, arena_format(lint->arena, "%s", value));
        return;
    }
    at = ir_origin_row(lint->origin, head, (uint32_t)other);
    if (!at || span_is_none(at->value))
        return;
    const str text = sources->items[at->value.source].text;
    const span end = {at->value.source, at->value.end, at->value.end};
    uint32_t line = at->key.begin;
    while (line > 0 && text.ptr[line - 1] != '\n')
        line--;
    uint32_t first = line;
    while (first < at->key.begin && text.ptr[first] == ' ')
        first++;
    if (at->key.end < text.len && text.ptr[at->key.end] == '=')
        diag_fix(lint->sink, false, (span){end.source, end.begin + 1, end.begin + 1},
                 arena_format(lint->arena, " %s=\"%s\"", row, value));
    else if (first == at->key.begin)
        diag_fix(lint->sink, false, end,
                 arena_format(lint->arena, "\n%.*s%s: %s", (int)(first - line), text.ptr + line, row, value));
    else
        diag_fix(lint->sink, false, end, arena_format(lint->arena, ", %s: %s", row, value));
}
