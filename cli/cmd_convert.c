// glint convert IN OUT: what the scene means, in the other spelling.
#include "cli/cli.h"

#include "grammar/ir_print.h"

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

static int convert(struct cli *cli, struct session *session) {
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

int cmd_convert(struct cli *cli) {
    struct session session;
    struct session_options options = cli_session_options(cli, cli->operands[0]);
    session_load_text(&session, &options);
    int status = cli_report(cli, &session, false);
    if (status == CLI_OK)
        status = convert(cli, &session);
    session_finish(&session);
    return status;
}
