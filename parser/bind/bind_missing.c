// The required rows of an element.
#include "diag/codes/binding.h"
#include "parser/bind/bind.h"
#include "parser/bind/say.h"

#include <string.h>

static void report_choice(struct bind_context *context, struct bind_frame *frame, uint32_t choice) {
    str names = STR("");
    str example = STR("");
    for (uint32_t i = 0; i < frame->schema->row_count; i++) {
        const struct schema_row *row = &frame->schema->rows[i];
        if (row->choice != choice)
            continue;
        names =
            arena_format(context->scratch, "%.*s%s'%s'", STR_ARG(names), names.len ? " or " : "", row->name);
        example = arena_format(context->scratch, "%.*s%s%.*s", STR_ARG(example), example.len ? " or " : "",
                               STR_ARG(say_example(context->scratch, row, context->tree->is_xml)));
    }
    str owner = say_subject(context->scratch, bind_subject(frame, NULL));
    diag_add(context->sink, DIAG_CHOICE_MISSING, frame->label, "%.*s needs %.*s", STR_ARG(owner),
             STR_ARG(names));
    diag_help(context->sink, "for example %.*s", STR_ARG(example));
}

// There is only one version, so a fix can write it before the rest.
static void fix_version(struct bind_context *context, const struct schema_row *row) {
    const struct tree *tree = context->tree;
    str written = say_example(context->scratch, row, tree->is_xml);
    bool flow = tree_node(tree, tree->root)->style == TREE_FLOW;
    uint32_t begin = tree->is_xml ? tree->root_name.end : tree_node(tree, tree->root)->begin + flow;
    str behind = tree->is_xml ? STR("")
                 : flow       ? STR(", ")
                              : str_line_end(context->sources->items[tree->source].text);
    str text = arena_format(context->scratch, "%s%.*s%.*s", tree->is_xml ? " " : "", STR_ARG(written),
                            STR_ARG(behind));
    diag_fix(context->sink, true, (span){tree->source, begin, begin}, text);
}

static void bind_report_missing(struct bind_context *context, struct bind_frame *frame,
                                const struct schema_row *row) {
    str owner = say_subject(context->scratch, bind_subject(frame, NULL));
    diag_add(context->sink, DIAG_MISSING, frame->label, "%.*s lacks '%s'", STR_ARG(owner),
             row->many == SCHEMA_ONE ? row->name : schema_yaml_key(row));
    diag_help(context->sink, "add %.*s (%.*s)",
              STR_ARG(say_example(context->scratch, row, context->tree->is_xml)),
              STR_ARG(say_doc(context->scratch, row->doc)));
    if (row->range == SCHEMA_RANGE_VERSION)
        fix_version(context, row);
}

// An entry of a named map needs its name, unless the map has a standard one.
static bool is_needed(const struct bind_frame *frame, const struct schema_row *row) {
    bool named = frame->via && frame->via->many == SCHEMA_NAMED_MAP && !frame->via->single;
    return row->required || (row->key && named);
}

void bind_missing(struct bind_context *context, struct bind_frame *frame, bool silent) {
    const struct schema_facts *facts = schema_index_facts(context->index, frame->schema);
    bool keyed = facts->key_row < 0 || (frame->seen & bind_bit((uint32_t)facts->key_row));
    if (keyed && !frame->guessed && !facts->has_choices && !(facts->required & ~frame->seen))
        return;
    bool chosen[1 + sizeof frame->schema->choices / sizeof *frame->schema->choices] = {false};
    uint64_t there = frame->seen | frame->guessed;
    for (uint32_t i = 0; i < frame->schema->row_count; i++) {
        const struct schema_row *row = &frame->schema->rows[i];
        if (there & bind_bit(i))
            chosen[row->choice] = true;
        if (frame->guessed & bind_bit(i))
            bind_poison(frame, i);
        if (!is_needed(frame, row) || (there & bind_bit(i)))
            continue;
        bind_poison(frame, i);
        if (!silent)
            bind_report_missing(context, frame, row);
    }
    for (uint32_t c = 1; c < sizeof chosen / sizeof *chosen; c++) {
        if (frame->schema->choices[c - 1].rule != SCHEMA_CHOICE_EXACTLY_ONE || chosen[c])
            continue;
        for (uint32_t i = 0; i < frame->schema->row_count; i++)
            if (frame->schema->rows[i].choice == c)
                bind_poison(frame, i);
        if (!silent)
            report_choice(context, frame, c);
    }
}
