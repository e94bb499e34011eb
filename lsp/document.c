#include "lsp/document.h"

#include "core/heap.h"

#include <stdlib.h>
#include <string.h>

void documents_init(struct documents *documents) {
    *documents = (struct documents){0};
    arena_init(&documents->arena, SIZE_MAX / 2);
}

void documents_finish(struct documents *documents) {
    for (uint32_t i = 0; i < documents->count; i++) {
        free(documents->items[i].uri);
        free(documents->items[i].text);
    }
    free(documents->items);
    arena_finish(&documents->arena);
}

struct document *documents_find(struct documents *documents, const char *uri) {
    for (uint32_t i = 0; i < documents->count; i++)
        if (strcmp(documents->items[i].uri, uri) == 0)
            return &documents->items[i];
    return NULL;
}

struct document *documents_find_path(struct documents *documents, str path) {
    for (uint32_t i = 0; i < documents->count; i++)
        if (str_equal(documents->items[i].path, path))
            return &documents->items[i];
    return NULL;
}

static bool set_text(struct document *document, const char *text, size_t length) {
    char *copy = heap_alloc(length + 1);
    if (!copy)
        return false;
    memcpy(copy, text, length);
    copy[length] = '\0';
    free(document->text);
    document->text = copy;
    document->length = length;
    document->capacity = length + 1;
    return true;
}

struct path_search {
    struct arena *arena;
    const char *uri;
    str path;
};

// Finds the path as the sessions know it.
static void find_path(void *context) {
    struct path_search *search = context;
    struct files files;
    str path = position_path(search->arena, search->uri);
    files_init(&files, search->arena);
    search->path = path.len ? files_canonical(&files, path) : path;
}

static struct document *add(struct documents *documents, const char *uri) {
    struct document *items =
        heap_grow(documents->items, documents->count, &documents->capacity, sizeof *items);
    if (!items)
        return NULL;
    documents->items = items;
    struct path_search search = {&documents->arena, uri, STR("")};
    arena_guarded(&documents->arena, find_path, &search);
    struct document document = {.uri = heap_text(uri), .path = search.path};
    if (!document.uri || search.path.len == 0) {
        free(document.uri);
        return NULL;
    }
    documents->items[documents->count] = document;
    return &documents->items[documents->count++];
}

struct document *documents_open(struct documents *documents, const char *uri, const char *text, size_t length,
                                json_int_t version) {
    struct document *document = documents_find(documents, uri);
    if (!document)
        document = add(documents, uri);
    if (!document)
        return NULL;
    document->version = version;
    if (set_text(document, text, length))
        return document;
    documents_close(documents, uri);
    return NULL;
}

void documents_close(struct documents *documents, const char *uri) {
    struct document *document = documents_find(documents, uri);
    if (!document)
        return;
    free(document->uri);
    free(document->text);
    *document = documents->items[--documents->count];
}

// Works in place: editors send thousands of changes at once to replace a word everywhere.
static bool splice(struct document *document, size_t begin, size_t end, const char *text, size_t length) {
    size_t tail = document->length - end;
    size_t whole = begin + length + tail;
    if (whole + 1 > document->capacity) {
        size_t capacity = whole + whole / 2 + 1;
        char *larger = heap_resize(document->text, capacity);
        if (!larger)
            return false;
        document->text = larger;
        document->capacity = capacity;
    }
    memmove(document->text + begin + length, document->text + end, tail);
    memcpy(document->text + begin, text, length);
    document->text[whole] = '\0';
    document->length = whole;
    return true;
}

bool document_change(struct document *document, enum position_encoding encoding, const json_t *changes) {
    size_t index;
    json_t *change;
    struct position_hint hint = {0};
    if (!json_is_array(changes))
        return false;
    json_array_foreach(changes, index, change) {
        const json_t *text = json_object_get(change, "text");
        const json_t *range = json_object_get(change, "range");
        if (!json_is_string(text))
            return false;
        size_t begin = 0;
        size_t end = document->length;
        if (range) {
            str now = document_text(document);
            end = position_read(now, encoding, json_object_get(range, "end"), &hint);
            begin = position_read(now, encoding, json_object_get(range, "start"), &hint);
        }
        // Text inserted after a single "\r" may complete its line end.
        bool joins = begin == hint.begin && begin > 0 && document->text[begin - 1] == '\r';
        if (begin < hint.begin || joins)
            hint = (struct position_hint){0};
        if (end < begin || !splice(document, begin, end, json_string_value(text), json_string_length(text)))
            return false;
    }
    return true;
}

str document_text(const struct document *document) {
    return (str){document->text, document->length};
}
