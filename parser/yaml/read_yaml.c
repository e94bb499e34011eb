#include "diag/codes/binding.h"
#include "diag/codes/limit.h"
#include "diag/codes/syntax.h"
#include "parser/yaml/yaml_memory.h"
#include "parser/yaml/yaml_reader.h"

#include <string.h>

// After each repair the text is read again from the start: ATTEMPTS_FREE times whatever its size, and up to
// ATTEMPTS_MAX times as long as that is less than REREAD_BYTES_MAX in all.
enum {
    ATTEMPTS_MAX = 256,
    ATTEMPTS_FREE = 8,
    REREAD_BYTES_MAX = 32 * 1024 * 1024
};

// ---- properties: anchor and tag before a node

struct properties {
    uint32_t end; // where the node itself begins
    span anchor, tag;
};

static bool is_between(str text, uint32_t at) {
    return char_is_space(text.ptr[at]) || str_yaml_break_length(text, at);
}

static uint32_t skip_word(str text, uint32_t at, uint32_t end) {
    while (at < end && !is_between(text, at))
        at++;
    return at;
}

static uint32_t skip_anchor(str text, uint32_t at, uint32_t end) {
    do
        at++;
    while (at < end && !is_between(text, at) && !memchr(",[]{}:", text.ptr[at], 6));
    return at;
}

// libyaml's marks for a node include its properties; a node has at most one of each kind.
static struct properties find_properties(struct yaml_reader *r, uint32_t begin, uint32_t end) {
    str text = r->text->bytes;
    struct properties p = {.end = begin};
    uint32_t at = begin;
    while (at < end) {
        char c = text.ptr[at];
        if (c == '&' && span_is_none(p.anchor)) {
            uint32_t stop = skip_anchor(text, at, end);
            p.anchor = yaml_span(r, at, stop);
            at = p.end = stop;
        } else if (c == '!' && span_is_none(p.tag)) {
            uint32_t stop = skip_word(text, at, end);
            p.tag = yaml_span(r, at, stop);
            at = p.end = stop;
        } else if (c == '#') {
            while (at < end && !str_yaml_break_length(text, at))
                at++;
        } else if (char_is_blank(c)) {
            at++;
        } else if (str_yaml_break_length(text, at)) {
            at += (uint32_t)str_yaml_break_length(text, at);
        } else {
            p.end = at;
            break;
        }
    }
    return p;
}

// Tags of YAML's core schema say what the attribute decides anyway; a value with another tag would be
// misread.
static bool is_core_tag(str tag) {
    return tag.len == 1 || str_starts_with(tag, STR("!!")) || str_starts_with(tag, STR("!<tag:yaml.org,"));
}

// Reports a tag; returns the flags of its node.
static uint8_t report_tag(struct yaml_reader *r, span tag) {
    if (span_is_none(tag))
        return 0;
    str text = str_slice(r->text->bytes, tag.begin, tag.end);
    span removed = tag;
    while (removed.end < r->text->bytes.len && r->text->bytes.ptr[removed.end] == ' ')
        removed.end++;
    diag_add(&r->sink, DIAG_YAML_TAG, tag, "the tag '%.*s' has no meaning in a scene",
             STR_ARG(reader_clip(text)));
    diag_help(&r->sink, "remove it");
    diag_fix(&r->sink, true, removed, STR(""));
    return is_core_tag(text) ? 0 : TREE_BAD;
}

// ---- events

static bool is_null_text(str text) {
    return text.len == 0 || str_equal(text, STR("~")) || str_equal(text, STR("null"));
}

static bool is_too_long(struct yaml_reader *r, str value, span at) {
    if (value.len <= r->context->limits->value[LIMIT_SCALAR_BYTES])
        return false;
    reader_limit(&r->sink, r->context->limits, LIMIT_SCALAR_BYTES, (span){at.source, at.begin, at.begin + 1},
                 "bytes in one value");
    r->stopped = true;
    return true;
}

static uint8_t check_escapes(struct yaml_reader *r, str value, span at) {
    size_t control = reader_find_control(value);
    if (control == value.len)
        return 0;
    diag_add(&r->sink, DIAG_CONTROL_CHARACTER, at, "an escape in this text is a control character");
    diag_help(&r->sink, "remove the escape; for a backslash write '\\\\', or put the text in single quotes");
    return TREE_BAD;
}

// Where the text of a scalar ends: libyaml ends a block scalar at the token after it.
static uint32_t scalar_end(const struct yaml_reader *r, uint32_t begin, uint32_t end) {
    while (end > begin && char_is_space(r->text->bytes.ptr[end - 1]))
        end--;
    return end;
}

static uint32_t skip_spaces(const struct yaml_reader *r, uint32_t at) {
    while (at < r->text->bytes.len && r->text->bytes.ptr[at] == ' ')
        at++;
    return at;
}

static void begin_token(struct yaml_reader *r, tree_index node) {
    if (yaml_at_entry(r))
        yaml_begin_entry(r, node);
    else
        yaml_begin_value(r);
}

static void end_token(struct yaml_reader *r, uint32_t end) {
    r->closed = 0;
    r->gap = end > r->gap ? end : r->gap;
    r->seen_token = true;
}

// The unquoted colour that left a value empty. In brackets libyaml places an empty value after the comment.
static bool find_swallowed(struct yaml_reader *r, uint32_t at, uint32_t token, struct reader_range *color) {
    if (yaml_comment_color(r, at, color))
        return true;
    *color = r->lost_color;
    if (color->begin == color->end || color->begin < token)
        return false;
    r->lost_color = (struct reader_range){0};
    return true;
}

static bool is_block_text(yaml_scalar_style_t style) {
    return style == YAML_LITERAL_SCALAR_STYLE || style == YAML_FOLDED_SCALAR_STYLE;
}

static void on_scalar(struct yaml_reader *r) {
    uint32_t begin = yaml_byte(r, r->event.start_mark);
    uint32_t end = yaml_byte(r, r->event.end_mark);
    str value = {(const char *)r->event.data.scalar.value, r->event.data.scalar.length};
    bool plain = r->event.data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
    uint32_t token = r->gap;
    yaml_gap(r, begin);
    yaml_take_ready(r);
    bool any = r->event.data.scalar.anchor || r->event.data.scalar.tag;
    struct properties p = {.end = begin};
    if (any)
        p = find_properties(r, begin, end);
    uint32_t stop = scalar_end(r, p.end, end);
    struct tree_node node = {.kind = plain && is_null_text(value) ? TREE_NULL : TREE_SCALAR,
                             .style = plain ? TREE_PLAIN : TREE_QUOTED,
                             .begin = p.end,
                             .end = stop};
    span at = yaml_span(r, p.end, stop);
    if (is_too_long(r, value, at))
        return;
    if (any)
        node.flags = report_tag(r, p.tag);
    struct reader_range color;
    bool absent = plain && value.len == 0 && !yaml_at_key(r);
    if (absent && find_swallowed(r, p.end, token, &color)) {
        yaml_report_color(&r->sink, r->text->bytes, yaml_span(r, color.begin, color.end));
        node.flags |= TREE_BAD;
        node.begin = color.begin;
        node.end = stop = color.end;
    }
    if (r->event.data.scalar.style == YAML_DOUBLE_QUOTED_SCALAR_STYLE)
        node.flags |= check_escapes(r, value, at);
    // A value of only bad bytes has become spaces.
    bool bad = absent ? reader_text_is_bad(r->text, token, skip_spaces(r, node.end))
                      : reader_text_is_bad(r->text, node.begin, node.end);
    if (bad)
        node.flags |= TREE_BAD;
    node.value = tree_add_text(r->tree, value);
    node.count = (uint32_t)value.len;
    tree_index added = yaml_add(r, node);
    r->last_scalar = added;
    begin_token(r, added);
    end_token(r, stop);
    if (is_block_text(r->event.data.scalar.style))
        r->line_entry = 0; // it ends on the line after it
    if (r->event.data.scalar.anchor)
        yaml_anchor_add(r, str_from((const char *)r->event.data.scalar.anchor), p.anchor, added);
    yaml_put(r, added);
}

static void on_alias(struct yaml_reader *r) {
    uint32_t begin = yaml_byte(r, r->event.start_mark);
    uint32_t end = yaml_byte(r, r->event.end_mark);
    yaml_gap(r, begin);
    yaml_take_ready(r);
    yaml_alias(r, str_from((const char *)r->event.data.alias.anchor), yaml_span(r, begin, end));
    end_token(r, end);
}

static void on_collection(struct yaml_reader *r, enum tree_kind kind, bool flow, const yaml_char_t *anchor,
                          const yaml_char_t *tag) {
    uint32_t begin = yaml_byte(r, r->event.start_mark);
    uint32_t end = yaml_byte(r, r->event.end_mark);
    // A block collection that is a value has no token of its own: comments before it belong to its first
    // entry.
    bool entry = yaml_at_entry(r);
    if (flow || entry) {
        yaml_gap(r, begin);
        yaml_take_ready(r);
    }
    struct properties p = {.end = begin};
    if (anchor || tag)
        p = find_properties(r, begin, (uint32_t)r->text->bytes.len);
    if (r->is_option && !flow) {
        diag_add(&r->sink, DIAG_SET_SYNTAX, yaml_span(r, p.end, p.end + 1),
                 "a value with several lines or keys needs brackets");
        diag_help(&r->sink, "write lists as [a, b] and maps as {key: value}");
        r->stopped = true;
        return;
    }
    uint8_t flags = tag ? report_tag(r, p.tag) : 0;
    if (r->depth == 0)
        flags = 0; // the root's contents are checked anyway
    tree_index added = yaml_add(r, (struct tree_node){.kind = (uint8_t)kind,
                                                      .style = flow ? TREE_FLOW : TREE_BLOCK,
                                                      .flags = flags,
                                                      .begin = p.end,
                                                      .end = p.end});
    if (flow || entry)
        begin_token(r, added);
    // `[a: b]` is a map without a bracket of its own.
    bool token = flow && end > p.end;
    if (token)
        end_token(r, p.end + 1);
    uint32_t number = YAML_NO_ANCHOR;
    if (anchor)
        number = yaml_anchor_add(r, str_from((const char *)anchor), p.anchor, 0);
    yaml_open(r, added, number);
    if (number) {
        r->anchors.items[number].node = added;
        tree_node(r->tree, added)->flags |= TREE_SHARED;
    }
}

// `[ #aabbcc` with the bracket closed on a later line: a list that seems to be empty.
static void find_lost_color(struct yaml_reader *r, tree_index list, uint32_t end) {
    struct tree_node *node = tree_node(r->tree, list);
    if (node->kind != TREE_LIST || node->count)
        return;
    for (uint32_t at = node->begin + 1; at < end; at++) {
        struct reader_range color;
        if (r->text->bytes.ptr[at] != '#' || !yaml_comment_color(r, at, &color))
            continue;
        yaml_report_color(&r->sink, r->text->bytes, yaml_span(r, color.begin, color.end));
        node->flags |= TREE_BAD;
        return;
    }
}

static void on_collection_end(struct yaml_reader *r) {
    tree_index node = r->frames[r->depth - 1].node;
    uint32_t begin = yaml_byte(r, r->event.start_mark);
    uint32_t end = yaml_byte(r, r->event.end_mark);
    bool token = tree_node(r->tree, node)->style == TREE_FLOW && end > begin;
    if (token) {
        yaml_gap(r, begin);
        find_lost_color(r, node, begin);
        end_token(r, end);
    }
    yaml_close(r, r->gap);
}

static void on_document(struct yaml_reader *r) {
    if (r->documents++ == 0)
        return;
    uint32_t begin = yaml_byte(r, r->event.start_mark);
    yaml_gap(r, begin);
    yaml_report_document(r, begin);
    r->stopped = true;
}

static void on_event(struct yaml_reader *r) {
    switch (r->event.type) {
    case YAML_DOCUMENT_START_EVENT:
        on_document(r);
        break;
    case YAML_DOCUMENT_END_EVENT:
        r->document_end = yaml_byte(r, r->event.end_mark);
        r->closed = 0;
        break;
    case YAML_SCALAR_EVENT:
        on_scalar(r);
        break;
    case YAML_ALIAS_EVENT:
        on_alias(r);
        break;
    case YAML_SEQUENCE_START_EVENT:
        on_collection(r, TREE_LIST, r->event.data.sequence_start.style == YAML_FLOW_SEQUENCE_STYLE,
                      r->event.data.sequence_start.anchor, r->event.data.sequence_start.tag);
        break;
    case YAML_MAPPING_START_EVENT:
        on_collection(r, TREE_MAP, r->event.data.mapping_start.style == YAML_FLOW_MAPPING_STYLE,
                      r->event.data.mapping_start.anchor, r->event.data.mapping_start.tag);
        break;
    case YAML_SEQUENCE_END_EVENT:
    case YAML_MAPPING_END_EVENT:
        on_collection_end(r);
        break;
    case YAML_STREAM_END_EVENT:
        yaml_end_comments(r);
        yaml_take_ready(r);
        break;
    default:
        break;
    }
}

// ---- attempts

enum outcome {
    READ_WHOLE,
    READ_STOPPED, // by a limit or a second document
    READ_REFUSED, // by libyaml
};

static enum outcome run_events(struct yaml_reader *r) {
    str input = str_slice(r->text->bytes, r->text->begin, r->text->bytes.len);
    yaml_parser_set_encoding(&r->parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&r->parser, (const unsigned char *)input.ptr, input.len);
    for (bool end = false; !end;) {
        if (!yaml_memory_check(&r->parser, yaml_parser_parse(&r->parser, &r->event)))
            return READ_REFUSED;
        end = r->event.type == YAML_STREAM_END_EVENT;
        on_event(r);
        yaml_event_delete(&r->event);
        if (r->stopped || r->taken.failed)
            return READ_STOPPED;
    }
    return READ_WHOLE;
}

// An attempt begins with an empty tree; its arrays are used again.
static void begin_attempt(struct yaml_reader *r) {
    struct tree *tree = r->tree;
    tree->nodes.count = tree->comments.count = 1;
    tree->texts.count = tree->directives.count = 0;
    tree->root = 0;
    tree->schema_line = tree->closing_comments = SPAN_NONE;
    diag_sink_finish(&r->sink);
    diag_sink_init(&r->sink);
    diag_sink_keep(&r->sink, r->context->sink->kept_max);
    r->stopped = r->seen_token = false;
    r->documents = r->depth = 0;
    r->document_end = 0;
    r->place_characters = 0;
    r->place_bytes = r->gap = r->text->begin;
    r->anchors.count = 0;
    r->alias_nodes = 0;
    r->line_entry = r->last_scalar = r->closed = 0;
    r->blamed = 0;
    r->pending = (struct tree_comment){0};
    r->lost_color = (struct reader_range){0};
    str_map_clear(&r->anchor_names);
    reader_text_seal(r->text);
}

static bool may_read_again(const struct yaml_reader *r, unsigned attempt) {
    uint64_t reread = (uint64_t)attempt * r->text->bytes.len;
    return attempt < ATTEMPTS_FREE || (attempt < ATTEMPTS_MAX && reread < REREAD_BYTES_MAX);
}

static void run_attempts(void *context) {
    struct yaml_reader *r = context;
    struct arena *arena = r->context->arena;
    r->frames = ARENA_ARRAY(arena, struct yaml_frame, r->context->limits->value[LIMIT_SCENE_DEPTH] + 1);
    str_map_init(&r->anchor_names, arena);
    str_map_init(&r->keys, arena);
    str_map_init(&r->joined_keys, arena);
    str_map_init(&r->taken.keys, arena);
    r->taken.on = r->context->taker && !r->is_option;
    bool tabs_repaired = false;
    for (unsigned attempt = 0;; attempt++) {
        begin_attempt(r);
        if (!yaml_memory_begin(&r->parser)) {
            diag_add(&r->sink, DIAG_OUT_OF_MEMORY, yaml_span(r, 0, 0), "not enough memory to read the file");
            return;
        }
        enum outcome outcome = run_events(r);
        if (r->taken.on) {
            r->taken.failed = r->taken.failed || outcome != READ_WHOLE || r->sink.count;
            return;
        }
        bool again = outcome != READ_WHOLE && may_read_again(r, attempt);
        if (again && yaml_repair(r, r->context->sink, &tabs_repaired)) {
            yaml_parser_delete(&r->parser);
            continue;
        }
        if (outcome == READ_REFUSED)
            yaml_blame(r);
        // After repaired tabs, columns are guesses; in binary data, everything is.
        if (outcome == READ_REFUSED && !tabs_repaired && !(r->text->is_binary && r->documents))
            yaml_report(r);
        r->tree->broken = outcome != READ_WHOLE && r->document_end == 0;
        yaml_close_cut(r);
        return;
    }
}

// The memory of libyaml and the sink is freed, whether memory runs out or not.
static void run_guarded(struct yaml_reader *r) {
    struct arena *arena = r->context->arena;
    enum arena_fault fault = arena_guarded(arena, run_attempts, r);
    yaml_event_delete(&r->event);
    yaml_parser_delete(&r->parser);
    diag_merge(r->context->sink, &r->sink);
    diag_sink_finish(&r->sink);
    if (fault)
        arena_raise(arena, fault);
}

static void read_text(const struct reader_context *context, struct reader_text *text, bool is_option,
                      struct tree *tree) {
    struct yaml_reader reader = {.context = context, .text = text, .tree = tree, .is_option = is_option};
    str content = str_slice(text->bytes, text->begin, text->bytes.len);
    reader.ascii = utf8_count(content) == content.len;
    run_guarded(&reader);
    if (reader.taken.failed)
        tree->root = 0;
    if (!is_option || tree->root || reader.stopped || tree->broken)
        return;
    struct reader_range color;
    if (yaml_comment_color(&reader, text->begin, &color)) {
        yaml_report_color(context->sink, text->bytes, yaml_span(&reader, color.begin, color.end));
    } else {
        diag_add(context->sink, DIAG_SET_SYNTAX, yaml_span(&reader, text->begin, (uint32_t)text->bytes.len),
                 "there is no value here");
        diag_help(context->sink, "in YAML '#' begins a comment: put text that contains it in quotes");
    }
}

// Reports a root that is missing or not a map, unless that was already reported.
static void report_root(const struct reader_context *context, struct tree *tree, bool silent) {
    const struct tree_node *root = tree_node(tree, tree->root);
    if (silent)
        return;
    if (tree->root == 0 || root->kind == TREE_NULL) {
        diag_add(context->sink, DIAG_EMPTY_FILE, (span){tree->source, 0, 0}, "the file contains no scene");
        diag_help(context->sink, "a scene begins with 'glint: 1'");
        return;
    }
    span first = {tree->source, root->begin, root->kind == TREE_LIST ? root->begin + 1 : root->end};
    diag_add(context->sink, DIAG_NOT_A_SCENE, first, "a scene is a map of keys and values, but this is a %s",
             root->kind == TREE_LIST ? "list" : "single value");
    str text = context->sources->items[tree->source].text;
    bool xml = str_starts_with(str_slice(text, root->begin, text.len), STR("<"));
    diag_help(context->sink,
              xml ? "the file looks like XML: name it .xml" : "begin the file with 'glint: 1'");
}

bool read_yaml(const struct reader_context *context, uint32_t source, struct tree *tree) {
    tree_init(tree, context->arena, source, false);
    struct reader_text text;
    if (!reader_text_open(context, source, 0, false, &text))
        return false;
    tree->overwritten = text.is_overwritten;
    uint32_t errors = context->sink->errors;
    if (context->taker && errors)
        return false;
    read_text(context, &text, false, tree);
    if (tree->root && tree_node(tree, tree->root)->kind == TREE_MAP) {
        tree_index first = tree_first(tree, tree->root);
        tree->root_name = first ? tree_span(tree, first) : tree_span(tree, tree->root);
        return true;
    }
    report_root(context, tree, context->sink->errors > errors);
    tree->root = 0;
    return false;
}

bool read_yaml_value(const struct reader_context *context, uint32_t source, uint32_t begin,
                     struct tree *tree) {
    tree_init(tree, context->arena, source, false);
    struct reader_text text;
    if (!reader_text_open(context, source, begin, false, &text))
        return false;
    uint32_t errors = context->sink->errors;
    read_text(context, &text, true, tree);
    return tree->root != 0 && context->sink->errors == errors;
}
