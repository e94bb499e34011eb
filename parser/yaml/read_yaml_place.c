// Where the reader is, in the text and in the tree, and the nodes that it adds there.
#include "parser/yaml/yaml_reader.h"

span yaml_span(const struct yaml_reader *r, uint32_t begin, uint32_t end) {
    uint32_t size = (uint32_t)r->text->bytes.len;
    return (span){r->text->source, begin < size ? begin : size, end < size ? end : size};
}

// libyaml counts characters; counting continues from the last place asked for.
static uint32_t find_byte(struct yaml_reader *r, yaml_mark_t mark) {
    str text = r->text->bytes;
    uint32_t at = r->place_bytes;
    while (r->place_characters < mark.index && at < text.len) {
        at += (uint32_t)utf8_sequence_length(text, at);
        r->place_characters++;
    }
    while (r->place_characters > mark.index && at > r->text->begin) {
        do
            at--;
        while (at > r->text->begin && ((unsigned char)text.ptr[at] & 0xC0) == 0x80);
        r->place_characters--;
    }
    r->place_bytes = at;
    return at;
}

uint32_t yaml_byte(struct yaml_reader *r, yaml_mark_t mark) {
    const struct reader_text *text = r->text;
    if (!r->ascii)
        return find_byte(r, mark);
    return text->begin + (uint32_t)(mark.index < text->bytes.len ? mark.index : text->bytes.len);
}

bool yaml_at_key(const struct yaml_reader *r) {
    const struct yaml_frame *frame = yaml_top(r);
    return frame && tree_node(r->tree, frame->node)->kind == TREE_MAP && frame->key == 0;
}

bool yaml_at_entry(const struct yaml_reader *r) {
    const struct yaml_frame *frame = yaml_top(r);
    return frame && (tree_node(r->tree, frame->node)->kind == TREE_LIST || frame->key == 0);
}

tree_index yaml_add(struct yaml_reader *r, struct tree_node node) {
    if (r->tree->nodes.count + r->taken.nodes > r->context->limits->value[LIMIT_SCENE_NODES] && !r->stopped) {
        reader_limit(&r->sink, r->context->limits, LIMIT_SCENE_NODES, yaml_span(r, node.begin, node.end),
                     "too many values in the file");
        r->stopped = true;
    }
    return tree_add(r->tree, node);
}
