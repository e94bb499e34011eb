// glint schema json|relaxng|markdown
#include "cli/cli.h"

#include "core/nearest.h"
#include "grammar/emit.h"

#include <string.h>

struct kind {
    const char *name;
    void (*emit)(struct strbuf *out);
};

static const struct kind kinds[] = {
    {"json", emit_json_schema},
    {"relaxng", emit_relaxng},
    {"markdown", emit_markdown},
};
enum {
    KIND_COUNT = sizeof kinds / sizeof kinds[0]
};

int cmd_schema(struct cli *cli) {
    const char *wanted = cli->operands[0];
    struct nearest search = nearest_begin(str_from(wanted));
    for (int i = 0; i < KIND_COUNT; i++) {
        nearest_offer(&search, str_from(kinds[i].name));
        if (strcmp(wanted, kinds[i].name) != 0)
            continue;
        struct strbuf text;
        strbuf_init(&text);
        kinds[i].emit(&text);
        int status = cli_print(cli, strbuf_view(&text));
        strbuf_finish(&text);
        return status;
    }
    int status = cli_usage(cli, cli_operand_place(cli, 0),
                           "'%s' is no kind of schema; they are json, relaxng and markdown", wanted);
    if (nearest_best(&search).len)
        diag_help(&cli->sink, "did you mean '%.*s'?", STR_ARG(nearest_best(&search)));
    return status;
}
