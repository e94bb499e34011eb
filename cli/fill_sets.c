// Expressions in braces in the values of --set, for one frame.
#include "cli/cli.h"
#include "core/expression.h"
#include "diag/codes/command.h"
#include "diag/diag_expression.h"

enum {
    FPS_DEFAULT = 25
};

bool cli_fill_set(struct cli *cli, str *set, int32_t frame, double fps, bool *filled) {
    const str text = *set;
    const struct expression_at at = {.frame = frame, .time = frame / (fps > 0 ? fps : FPS_DEFAULT)};
    struct expression_fault fault;
    struct strbuf buffer;
    strbuf_init(&buffer);
    const bool good = expression_fill(text, &at, &buffer, filled, &fault);
    *set = arena_copy(&cli->arena, strbuf_view(&buffer));
    strbuf_finish(&buffer);
    if (good)
        return true;
    const uint32_t source =
        source_add(&cli->sources, SOURCE_KIND_OPTION, STR("--set"), arena_copy(&cli->arena, text));
    const struct diag_expression expression = {
        .text = text,
        .at = {source, 0, (uint32_t)text.len},
        .suffix = arena_format(&cli->arena, ", in frame %d", (int)frame).ptr};
    diag_expression_fault(&cli->sink, &cli->sources, DIAG_USAGE, &expression, &fault);
    return false;
}

bool cli_fill_sets(struct cli *cli) {
    bool good = true, filled;
    for (uint32_t i = 0; i < cli->options.sets.count && good; i++)
        good = cli_fill_set(cli, &cli->options.sets.items[i], cli->options.frame, cli->options.batch.fps,
                            &filled);
    return good;
}
