#include "parser/yaml/yaml_tokens.h"

#include "parser/yaml/yaml_memory.h"

#include <yaml.h>

struct scanner {
    struct arena *arena;
    str text;
    uint32_t begin;
    uint32_t characters, bytes; // one place in both measures: libyaml counts characters
    struct yaml_tokens *tokens;
    struct yaml_token token; // the one to add
};

static bool is_continuation(char c) {
    return ((unsigned char)c & 0xC0) == 0x80;
}

static uint32_t byte_of(struct scanner *s, size_t index) {
    while (s->characters < index && s->bytes < s->text.len) {
        do
            s->bytes++;
        while (s->bytes < s->text.len && is_continuation(s->text.ptr[s->bytes]));
        s->characters++;
    }
    while (s->characters > index && s->bytes > s->begin) {
        do
            s->bytes--;
        while (s->bytes > s->begin && is_continuation(s->text.ptr[s->bytes]));
        s->characters--;
    }
    return s->bytes;
}

static enum yaml_token_kind kind_of(const yaml_token_t *token) {
    switch (token->type) {
    case YAML_VERSION_DIRECTIVE_TOKEN:
    case YAML_TAG_DIRECTIVE_TOKEN:
        return YAML_TOKEN_DIRECTIVE;
    case YAML_DOCUMENT_START_TOKEN:
        return YAML_TOKEN_DOCUMENT;
    case YAML_DOCUMENT_END_TOKEN:
        return YAML_TOKEN_DOCUMENT_END;
    case YAML_BLOCK_SEQUENCE_START_TOKEN:
        return YAML_TOKEN_LIST;
    case YAML_BLOCK_MAPPING_START_TOKEN:
        return YAML_TOKEN_MAP;
    case YAML_BLOCK_END_TOKEN:
        return YAML_TOKEN_BLOCK_END;
    case YAML_FLOW_SEQUENCE_START_TOKEN:
    case YAML_FLOW_MAPPING_START_TOKEN:
        return YAML_TOKEN_FLOW_OPEN;
    case YAML_FLOW_SEQUENCE_END_TOKEN:
    case YAML_FLOW_MAPPING_END_TOKEN:
        return YAML_TOKEN_FLOW_CLOSE;
    case YAML_BLOCK_ENTRY_TOKEN:
        return YAML_TOKEN_ITEM;
    case YAML_FLOW_ENTRY_TOKEN:
        return YAML_TOKEN_COMMA;
    case YAML_KEY_TOKEN:
        return YAML_TOKEN_KEY;
    case YAML_VALUE_TOKEN:
        return YAML_TOKEN_COLON;
    case YAML_ALIAS_TOKEN:
        return YAML_TOKEN_ALIAS;
    case YAML_ANCHOR_TOKEN:
    case YAML_TAG_TOKEN:
        return YAML_TOKEN_PROPERTY;
    case YAML_SCALAR_TOKEN: {
        yaml_scalar_style_t style = token->data.scalar.style;
        return style == YAML_LITERAL_SCALAR_STYLE || style == YAML_FOLDED_SCALAR_STYLE ? YAML_TOKEN_BLOCK_TEXT
                                                                                       : YAML_TOKEN_TEXT;
    }
    default:
        return YAML_TOKEN_END;
    }
}

static void push(void *context) {
    struct scanner *s = context;
    *ARENA_PUSH(s->arena, s->tokens) = s->token;
}

static bool add(struct scanner *s, const yaml_token_t *token) {
    if (token->type == YAML_STREAM_START_TOKEN)
        return true;
    struct yaml_token added = {.kind = kind_of(token)};
    added.begin = byte_of(s, token->start_mark.index);
    added.end = byte_of(s, token->end_mark.index);
    added.column = (uint32_t)token->start_mark.column;
    if (added.kind == YAML_TOKEN_END)
        added.begin = added.end = (uint32_t)s->text.len;
    s->tokens->documents +=
        added.kind == YAML_TOKEN_DOCUMENT || (s->tokens->count == 0 && added.kind > YAML_TOKEN_DOCUMENT_END);
    s->token = added;
    return arena_guarded(s->arena, push, s) == ARENA_FAULT_NONE;
}

static void open_parser(yaml_parser_t *parser, str text, uint32_t begin) {
    yaml_parser_set_encoding(parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(parser, (const unsigned char *)text.ptr + begin, text.len - begin);
}

// The scanner by itself accepts tokens in any order.
static bool is_grammatical(str text, uint32_t begin) {
    yaml_parser_t parser;
    if (!yaml_memory_begin(&parser))
        return false;
    open_parser(&parser, text, begin);
    bool good = true;
    for (bool end = false; good && !end;) {
        yaml_event_t event;
        good = yaml_memory_check(&parser, yaml_parser_parse(&parser, &event));
        end = good && (event.type == YAML_STREAM_END_EVENT || event.type == YAML_NO_EVENT);
        if (good)
            yaml_event_delete(&event);
    }
    yaml_parser_delete(&parser);
    return good;
}

bool yaml_tokens_read(struct arena *arena, str text, uint32_t begin, struct yaml_tokens *tokens) {
    yaml_parser_t parser;
    struct scanner s = {.arena = arena, .text = text, .begin = begin, .bytes = begin, .tokens = tokens};
    *tokens = (struct yaml_tokens){0};
    if (!is_grammatical(text, begin) || !yaml_memory_begin(&parser))
        return false;
    open_parser(&parser, text, begin);
    bool good = true;
    for (bool end = false; good && !end;) {
        yaml_token_t token;
        good = yaml_memory_check(&parser, yaml_parser_scan(&parser, &token));
        if (!good)
            break;
        end = token.type == YAML_STREAM_END_TOKEN || token.type == YAML_NO_TOKEN;
        good = add(&s, &token);
        yaml_token_delete(&token);
    }
    yaml_parser_delete(&parser);
    return good;
}
