// glint convert IN OUT: what the scene means, in the other spelling.
#include "app/convert.h"
#include "cli/cli.h"

#include <string.h>
#include <sys/stat.h>

static enum convert_spelling wanted_spelling(struct session *session, const char *out) {
    str path = str_from(out);
    if (str_ends_with_nocase(path, ".xml"))
        return CONVERT_XML;
    if (str_ends_with_nocase(path, ".json"))
        return CONVERT_JSON;
    if (str_ends_with_nocase(path, ".yaml") || str_ends_with_nocase(path, ".yml"))
        return CONVERT_YAML;
    return session->origin.files.items[0].is_xml ? CONVERT_YAML : CONVERT_XML;
}

// Made before anything is reported, since what is wrong with it is a finding too. false: no memory.
static bool make_text(struct cli *cli, struct session *session, struct strbuf *text) {
    const char *out = cli->operands[1];
    if (strcmp(out, "-") != 0 && !session_rebase(session, str_from(out)))
        return false;
    return convert_write(session, wanted_spelling(session, out), text) != CONVERT_NO_MEMORY;
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
    struct strbuf text;
    strbuf_init(&text);
    session_load_text(&session, &options);
    bool good = session.state == SESSION_LOADED && session.sink.errors == 0;
    if (good && !make_text(cli, &session, &text))
        diag_add(&session.sink, DIAG_OUT_OF_MEMORY, SPAN_NONE, "not enough memory to convert this scene");
    int status = cli_report(cli, &session, false);
    if (status == CLI_OK)
        status = cli_write(cli, out, strbuf_view(&text));
    strbuf_finish(&text);
    session_finish(&session);
    return status;
}
