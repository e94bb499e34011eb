// glint convert IN OUT: what the scene means, in the other spelling.
#include "cli/cli.h"

#include "grammar/print/ir_print.h"

#include <string.h>
#include <sys/stat.h>

enum spelling {
    SPELLING_YAML,
    SPELLING_XML,
    SPELLING_JSON,
};

static enum spelling wanted_spelling(struct session *session, const char *out) {
    str path = str_from(out);
    if (str_ends_with_nocase(path, ".xml"))
        return SPELLING_XML;
    if (str_ends_with_nocase(path, ".json"))
        return SPELLING_JSON;
    if (str_ends_with_nocase(path, ".yaml") || str_ends_with_nocase(path, ".yml"))
        return SPELLING_YAML;
    return session->origin.files.items[0].is_xml ? SPELLING_YAML : SPELLING_XML;
}

static void write_as(struct session *session, enum spelling spelling, struct strbuf *text) {
    struct ir_write_options options = {0};
    if (spelling == SPELLING_XML)
        ir_write_xml(session->scene, &session->origin, &session->sources, options, text);
    else if (spelling == SPELLING_JSON)
        ir_write_json(session->scene, text);
    else
        ir_write_yaml(session->scene, &session->origin, &session->sources, options, text);
}

static int write_scene(struct cli *cli, struct session *session) {
    struct strbuf text;
    strbuf_init(&text);
    write_as(session, wanted_spelling(session, cli->operands[1]), &text);
    int status = CLI_OK;
    if (text.failed) {
        cli_error(cli, DIAG_OUT_OF_MEMORY, cli->operands[0], NULL, "not enough memory to convert this scene");
        status = CLI_SCENE;
    } else {
        status = cli_write(cli, cli->operands[1], strbuf_view(&text));
    }
    strbuf_finish(&text);
    return status;
}

// Anchors, and comments inside entries, would be lost for good.
static bool is_onto_itself(const struct cli *cli) {
    struct stat in;
    struct stat out;
    return stat(cli->operands[0], &in) == 0 && stat(cli->operands[1], &out) == 0 && S_ISREG(out.st_mode) &&
           in.st_dev == out.st_dev && in.st_ino == out.st_ino;
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
    session_load_text(&session, &options);
    bool good = session.state == SESSION_LOADED && session.sink.errors == 0;
    if (good && strcmp(out, "-") != 0 && !session_rebase(&session, str_from(out)))
        diag_add(&session.sink, DIAG_OUT_OF_MEMORY, SPAN_NONE, "not enough memory to convert this scene");
    int status = cli_report(cli, &session, false);
    if (status == CLI_OK)
        status = write_scene(cli, &session);
    session_finish(&session);
    return status;
}
