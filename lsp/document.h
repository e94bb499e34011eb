// The texts that the editor has open: they replace the files of the same names.
//
// Ownership: the list owns text and names. Thread safety: one thread.
#ifndef GLINT_LSP_DOCUMENT_H
#define GLINT_LSP_DOCUMENT_H

#include "files/files.h"
#include "lsp/position.h"

#include <jansson.h>

struct document {
    char *uri;
    str path; // as the URI says
    char *text;
    size_t length, capacity;
    json_int_t version;
    bool is_placed; // scenes that might include it were searched for
    bool is_scene;  // its name or its text showed that it is a scene
};

struct documents {
    struct arena arena; // for paths; paths of closed documents stay until the end
    struct document *items;
    uint32_t count, capacity;
};

void documents_init(struct documents *documents);
void documents_finish(struct documents *documents);
// NULL: it is not open.
struct document *documents_find(struct documents *documents, const char *uri);
struct document *documents_find_path(struct documents *documents, str path);
// Opens it, or replaces the text of an open one. NULL: the URI is not of a file, or memory ran out.
struct document *documents_open(struct documents *documents, const char *uri, const char *text, size_t length,
                                json_int_t version);
void documents_close(struct documents *documents, const char *uri);
// Applies the events of a didChange notification, in order. false: they are malformed, or memory ran out.
bool document_change(struct document *document, enum position_encoding encoding, const json_t *changes);
str document_text(const struct document *document);

#endif
