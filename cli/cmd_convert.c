// glint convert IN OUT: what the scene means, in the other spelling.
#include "cli/cli.h"

#include "grammar/ir_print.h"

static bool wants_xml(struct session *session, const char *out) {
    str path = str_from(out);
    if (str_ends_with_nocase(path, ".xml"))
        return true;
    if (str_ends_with_nocase(path, ".yaml") || str_ends_with_nocase(path, ".yml") ||
        str_ends_with_nocase(path, ".json"))
        return false;
    return !session->origin.files.items[0].is_xml;
}

static void write_as(struct session *session, bool xml, struct strbuf *text) {
    struct ir_write_options options = {0};
    if (xml)
        ir_write_xml(session->scene, &session->origin, &session->sources, options, text);
    else
        ir_write_yaml(session->scene, &session->origin, &session->sources, options, text);
}

static int convert(struct cli *cli, struct session *session) {
    struct strbuf text;
    strbuf_init(&text);
    write_as(session, wants_xml(session, cli->operands[1]), &text);
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
