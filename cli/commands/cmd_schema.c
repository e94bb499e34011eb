// glint schema: prints what is made from the language's table, or links scene files to it.
#include "cli/commands/commands.h"

#include "cli/made.h"
#include "core/nearest.h"
#include "diag/codes/limit.h"
#include "edit/schema_line.h"
#include "grammar/emit/emit.h"

#include <string.h>

struct kind {
    const char *name;
    void (*emit)(struct strbuf *out);
};

static const struct kind kinds[] = {
    {"json", emit_json_schema},
    {"relaxng", emit_relaxng},
    {"rnc", emit_relaxng_compact},
    {"markdown", emit_markdown},
};
enum {
    KIND_COUNT = sizeof kinds / sizeof kinds[0]
};

static int print_kind(struct cli *cli, const struct kind *kind) {
    struct strbuf text;
    strbuf_init(&text);
    kind->emit(&text);
    int status = cli_print(cli, strbuf_view(&text));
    strbuf_finish(&text);
    return status;
}

// ---- install

// Writes the schema beside the scene, unless it is already there and current.
static int write_schema(struct cli *cli, const char *path, bool is_xml) {
    struct strbuf text;
    struct files files;
    str there = STR("");
    strbuf_init(&text);
    (is_xml ? emit_relaxng : emit_json_schema)(&text);
    files_init(&files, &cli->arena);
    enum file_status status = files_read_given(&files, str_from(path), UINT32_MAX, &cli->arena, &there);
    int result = CLI_OK;
    if (status != FILE_OK || !str_equal(there, strbuf_view(&text)))
        result = cli_write(cli, path, strbuf_view(&text));
    strbuf_finish(&text);
    return result;
}

static int refuse_json(struct cli *cli, int operand) {
    int status = cli_usage(cli, cli_operand_place(cli, operand),
                           "'%s' is JSON, which has no comments that could tell where the schema is",
                           cli->operands[operand]);
    diag_help(&cli->sink, "name the schema in the editor's settings; 'glint schema json' prints it");
    return status;
}

static int install(struct cli *cli, const char *path) {
    struct session session;
    struct session_options options = cli_session_options(cli, path);
    struct strbuf text;
    session_load_text(&session, &options);
    int status = session.state == SESSION_LOADED ? CLI_OK : cli_report(cli, &session, false);
    strbuf_init(&text);
    if (status == CLI_OK) {
        bool is_xml = session.origin.files.items[0].is_xml;
        const char *address = cli->options.schema;
        if (!address) {
            address = is_xml ? "glint.rng" : "glint.schema.json";
            const char *beside = path_join(&cli->arena, path_folder(str_from(path)), str_from(address)).ptr;
            status = cli_judge_made(cli, path, beside);
            status = status == CLI_OK ? write_schema(cli, beside, is_xml) : status;
        }
        bool changed = status == CLI_OK && schema_line_put(&session, str_from(address), &text);
        if (text.failed)
            cli_error(cli, DIAG_OUT_OF_MEMORY, path, NULL, "not enough memory for this scene");
        else if (changed)
            status = cli_write(cli, path, strbuf_view(&text));
        status = text.failed ? CLI_SCENE : status;
    }
    strbuf_finish(&text);
    session_finish(&session);
    return status;
}

static int install_all(struct cli *cli) {
    int worst = CLI_OK;
    if (cli->operand_count < 2)
        return cli_usage(cli, cli_operand_place(cli, 0), "'glint schema install' needs scene files");
    for (int i = 1; i < cli->operand_count; i++) {
        bool json = str_ends_with_nocase(str_from(cli->operands[i]), ".json");
        int status = json ? refuse_json(cli, i) : install(cli, cli->operands[i]);
        worst = status > worst ? status : worst;
    }
    return worst;
}

int cmd_schema(struct cli *cli) {
    const char *wanted = cli->operands[0];
    struct nearest search = nearest_begin(str_from(wanted));
    if (strcmp(wanted, "install") == 0)
        return install_all(cli);
    if (cli->operand_count > 1)
        return cli_usage(cli, cli_operand_place(cli, 1), "'glint schema %s' takes no more arguments", wanted);
    nearest_offer(&search, STR("install"));
    for (int i = 0; i < KIND_COUNT; i++) {
        nearest_offer(&search, str_from(kinds[i].name));
        if (strcmp(wanted, kinds[i].name) == 0)
            return print_kind(cli, &kinds[i]);
    }
    int status =
        cli_usage(cli, cli_operand_place(cli, 0),
                  "'%s' is not a kind of schema; write json, relaxng, rnc, markdown or 'install'", wanted);
    cli_did_you_mean(cli, &search, NULL);
    return status;
}
