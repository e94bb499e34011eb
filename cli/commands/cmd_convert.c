// glint convert IN OUT: what the scene means, in the other spelling.
#include "cli/commands/commands.h"
#include "diag/codes/limit.h"
#include "edit/convert.h"
#include "grammar/ir_expand.h"
#include "grammar/schema.h"

#include <string.h>
#include <sys/stat.h>

// OUT's ending decides the spelling; without an ending it is the other one.
static enum convert_spelling wanted_spelling(struct session *session, const char *out) {
    enum convert_spelling spelling;
    if (convert_spelling_of(str_from(out), &spelling))
        return spelling;
    return session->origin.files.items[0].is_xml ? CONVERT_YAML : CONVERT_XML;
}

static bool has_ending(struct cli *cli, const char *out) {
    enum convert_spelling spelling;
    if (strcmp(out, "-") == 0 || strncmp(out, "/dev/", 5) == 0 ||
        convert_spelling_of(str_from(out), &spelling))
        return true;
    cli_usage(cli, cli_operand_place(cli, 1), "the output '%s' must end in %s", out,
              schema_file_words(SCHEMA_FILE_SCENE, &cli->arena).ptr);
    diag_help(&cli->sink, "the ending says in which spelling the scene is written");
    return false;
}

// Made before anything is reported, since its mistakes are findings too. false: no memory.
static bool make_text(struct cli *cli, struct session *session, struct strbuf *text) {
    const char *out = cli->operands[1];
    if (strcmp(out, "-") != 0 && !session_rebase(session, str_from(out)))
        return false;
    return convert_write(session, wanted_spelling(session, out), text) != CONVERT_NO_MEMORY;
}

// Whether IN would be overwritten: its anchors, and comments inside entries, would be lost.
static bool is_onto_itself(const struct cli *cli) {
    struct stat in;
    struct stat out;
    return stat(cli->operands[0], &in) == 0 && stat(cli->operands[1], &out) == 0 && S_ISREG(out.st_mode) &&
           in.st_dev == out.st_dev && in.st_ino == out.st_ino;
}

// Values in the place of all that is computed. false: reported.
static bool expand(struct cli *cli, struct session *session) {
    if (ir_moves(session->scene)) {
        cli_usage(cli, cli_operand_place(cli, 0),
                  "this scene moves, and an expanded scene is one frame of it");
        diag_help(&cli->sink, "add --frame 0, or another frame");
        return false;
    }
    ir_expand(session->scene, &session->arena);
    return true;
}

int cmd_convert(struct cli *cli) {
    struct session session;
    struct session_options options = cli_session_options(cli, cli->operands[0]);
    const char *out = cli->operands[1];
    if (is_onto_itself(cli)) {
        int status = cli_usage(cli, cli_operand_place(cli, 1), "OUT is the same file as IN");
        diag_help(&cli->sink,
                  "a converted scene loses its anchors and some of its comments; choose another name");
        return status;
    }
    if (!has_ending(cli, out) || (!cli->options.expanded &&
                                  cli_has_no_effect(cli, "frame", "only an '--expanded' scene stands still")))
        return CLI_USAGE;
    struct strbuf text;
    struct asset_store *store = cli->options.expanded ? asset_store_create() : NULL;
    strbuf_init(&text);
    options.text_only = cli->options.expanded;
    if (cli->options.expanded)
        session_load(&session, &options, store);
    else
        session_load_text(&session, &options);
    bool good = session.state == SESSION_LOADED && session.sink.errors == 0;
    if (good && cli->options.expanded && !expand(cli, &session)) {
        session_finish(&session);
        asset_store_destroy(store);
        return CLI_USAGE;
    }
    if (good && !make_text(cli, &session, &text))
        diag_add(&session.sink, DIAG_OUT_OF_MEMORY, SPAN_NONE, "not enough memory to convert this scene");
    int status = cli_report(cli, &session, false);
    if (status == CLI_OK)
        status = cli_write(cli, out, strbuf_view(&text));
    strbuf_finish(&text);
    session_finish(&session);
    asset_store_destroy(store);
    return status;
}
