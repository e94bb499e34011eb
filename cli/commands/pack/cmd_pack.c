// glint pack SCENE OUT: a scene and all its files in one folder or archive.
#include "cli/commands/commands.h"
#include "cli/commands/pack/pack_scene.h"

#include "cli/progress.h"
#include "diag/codes/command.h"
#include "diag/codes/limit.h"
#include "edit/pack/pack.h"

#include <string.h>

static bool is_stopped(void) {
    return interrupt_signal() != 0;
}

// Whoever gets the package must know that it needs more than the default limits.
static void tell_limits(const struct pack_plan *plan, const char *out) {
    struct strbuf text;
    if (!plan->limits.len)
        return;
    strbuf_init(&text);
    strbuf_format(&text, "%s: needs limits that were raised: use it with --config and its %.*s\n", out,
                  STR_ARG(plan->limits));
    cli_write_error(strbuf_view(&text));
    strbuf_finish(&text);
}

static int pack(struct cli *cli, struct session *session, const char *out, const char **packed) {
    struct inventory inventory;
    struct pack_plan plan;
    struct pack_error error = {""};
    bool listed = inventory_make(session, &inventory);
    if (!listed)
        diag_add(&session->sink, DIAG_OUT_OF_MEMORY, SPAN_NONE, "not enough memory to pack this scene");
    if (!listed || pack_make_plan(session, &inventory, &plan) != PACK_OK)
        return cli_report(cli, session, false);
    interrupt_catch();
    enum pack_status status = pack_write(session, &plan, out, is_stopped, &error);
    if (status == PACK_OK) {
        tell_limits(&plan, out);
        if (packed)
            *packed = arena_copy(&cli->arena, plan.items[0].target).ptr;
        return CLI_OK;
    }
    if (status == PACK_STOPPED)
        return cli_interrupted(cli);
    cli_error(cli, DIAG_OUTPUT, out, NULL, "%s", error.text);
    return CLI_FILE;
}

// An archive of another kind: OUT would become a folder of that name.
static bool is_other_archive(struct cli *cli) {
    static const char *const others[] = {".tar", ".gz", ".tgz", ".bz2", ".xz", ".zst", ".7z", ".rar", NULL};
    const char *out = cli->operands[1];
    for (const char *const *ending = others; *ending; ending++) {
        if (!str_ends_with_nocase(str_from(out), *ending))
            continue;
        cli_usage(cli, cli_operand_place(cli, 1), "'%s' names an archive that glint cannot write", out);
        diag_help(&cli->sink, "a name that ends in .zip makes an archive, any other a folder");
        return true;
    }
    return false;
}

int pack_scene(struct cli *cli, const char *scene, const char *out, const char **packed) {
    struct session session;
    struct session_options options = cli_session_options(cli, scene);
    struct asset_store *store = asset_store_create();
    options.set_count = 0; // a package is the scene, not a picture of it
    options.width = options.height = options.samples = 0;
    options.pixels = ASSETS_SKIP_PIXELS;
    session_load(&session, &options, store);
    int status = cli_report(cli, &session, false);
    if (status == CLI_OK)
        status = pack(cli, &session, out, packed);
    session_finish(&session);
    asset_store_destroy(store);
    return status;
}

int cmd_pack(struct cli *cli) {
    if (strcmp(cli->operands[0], "-") == 0)
        return cli_usage(cli, cli_operand_place(cli, 0),
                         "a package has the scene's name, and standard input has none: name a file");
    if (strcmp(cli->operands[1], "-") == 0)
        return cli_usage(cli, cli_operand_place(cli, 1), "a package cannot be written to standard output");
    if (is_other_archive(cli))
        return CLI_USAGE;
    return pack_scene(cli, cli->operands[0], cli->operands[1], NULL);
}
