// JSON (RFC 8259) as a tree that knows where each value is: for files whose mistakes are reported at their
// place.
//
// Read strictly: what the standard does not allow is a fault, and so is a key that an object has twice,
// nesting deeper than JSON_DEPTH, and text that is not UTF-8. Numbers and texts are left as they are written
// until they are asked for, so that a text of many megabytes (a `data:` address) costs one walk over it.
// Errors: the first fault ends the reading; its place and what is wrong are in the tree. Ownership: nodes are
// in the arena, which must be guarded; they point into the text. Thread safety: immutable once read.
#ifndef GLINT_ASSETS_GLTF_JSON_H
#define GLINT_ASSETS_GLTF_JSON_H

#include "core/arena.h"
#include "core/str.h"

enum json_kind {
    JSON_NONE, // node 0: there is no such value
    JSON_NULL,
    JSON_FALSE,
    JSON_TRUE,
    JSON_NUMBER,
    JSON_TEXT,
    JSON_LIST,
    JSON_OBJECT,
};

enum {
    JSON_DEPTH = 64
};

typedef uint32_t json_index;

struct json_node {
    uint32_t begin, end; // bytes of the text, quotes and brackets included
    json_index next;     // in its list; in an object a key's value, then the next key
    json_index first;    // of a list or an object
    uint32_t count;      // of the values in a list, or of the pairs in an object
    uint8_t kind;        // json_kind
    bool is_plain;       // a text without escapes
};

struct json {
    str text;
    struct arena *arena;
    struct {
        struct json_node *items;
        uint32_t count, capacity;
    } nodes;
    json_index root;
    const char *fault; // NULL: the text is JSON
    size_t fault_begin, fault_end;
};

// Reads a text of less than 4 GiB. false: it is not JSON, and json->fault says why.
bool json_read(struct json *json, str text, struct arena *arena);

static inline const struct json_node *json_at(const struct json *json, json_index node) {
    return &json->nodes.items[node];
}
static inline enum json_kind json_kind_of(const struct json *json, json_index node) {
    return (enum json_kind)json_at(json, node)->kind;
}
// What a kind is called: "a number".
const char *json_kind_words(enum json_kind kind);
// The value of a key without escapes; 0: the object has none, or `object` is none.
json_index json_get(const struct json *json, json_index object, const char *key);
// A text without its quotes, as written; only if is_plain, this is also its meaning.
str json_raw(const struct json *json, json_index text);
// A text decoded: in the arena where it has escapes, else in the text of the file. U+0000 and unpaired
// surrogates become U+FFFD.
str json_text(const struct json *json, json_index text);
// A number; numbers beyond the range of a double are infinite.
double json_number(const struct json *json, json_index number);
// Where a value is, as "accessors[3].bufferView", in the arena; the root is "the file".
str json_path(const struct json *json, json_index node);

#endif
