// The tokens of a YAML file as it is written: anchors, aliases, merge keys, indicators and quoting in place,
// which the tree (parser/tree/tree.h) has resolved. For the formatter, which moves only white space.
//
// Ownership: the list is in the caller's arena, which must be guarded. Errors: false if libyaml refuses the
// text; the reader reports what is wrong with it. Thread safety: one call belongs to one thread.
#ifndef GLINT_PARSER_YAML_YAML_TOKENS_H
#define GLINT_PARSER_YAML_YAML_TOKENS_H

#include "core/arena.h"
#include "core/str.h"

enum yaml_token_kind {
    YAML_TOKEN_END, // of the text
    YAML_TOKEN_DIRECTIVE,
    YAML_TOKEN_DOCUMENT,     // ---
    YAML_TOKEN_DOCUMENT_END, // ...
    YAML_TOKEN_LIST,         // a block list begins; no text
    YAML_TOKEN_MAP,          // a block map begins; no text
    YAML_TOKEN_BLOCK_END,    // one of the two ends; no text
    YAML_TOKEN_FLOW_OPEN,
    YAML_TOKEN_FLOW_CLOSE,
    YAML_TOKEN_ITEM,  // -
    YAML_TOKEN_COMMA, // between entries in brackets
    YAML_TOKEN_KEY,   // '?', or no text
    YAML_TOKEN_COLON,
    YAML_TOKEN_ALIAS,
    YAML_TOKEN_PROPERTY, // an anchor or a tag
    YAML_TOKEN_TEXT,     // plain or in quotes
    YAML_TOKEN_BLOCK_TEXT,
};

struct yaml_token {
    uint32_t kind;       // yaml_token_kind
    uint32_t begin, end; // bytes of the source; equal: no text. Block text: from '|' or '>' to its last line
    uint32_t column;     // of `begin`, in characters from 0
};

struct yaml_tokens {
    struct yaml_token *items; // the last is YAML_TOKEN_END
    uint32_t count, capacity;
    uint32_t documents;
};

// `begin`: after a byte order mark.
bool yaml_tokens_read(struct arena *arena, str text, uint32_t begin, struct yaml_tokens *tokens);

#endif
