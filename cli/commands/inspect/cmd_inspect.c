// glint inspect SCENE|PICTURE: counts, bounds, features with their reasons, buffers; or the canonical dump.
#include "cli/commands/commands.h"
#include "cli/commands/inspect/inspect.h"
#include "grammar/ir_expand.h"
#include "grammar/print/ir_print.h"

static bool describe(struct session *session, bool as_json, struct strbuf *out) {
    struct inspected_scene scene = {.session = session};
    struct view view;
    if (!session_view(session, 0, &view))
        return false;
    struct flat_input input = precision_input(session, &view);
    input.sharing = FLAT_CHEAPER;
    if (!precision_forecast(session, &input, &scene.precision))
        return false;
    input.is_double = precision_is_double(session->scene, &scene.precision);
    if (!flatten(&input, &scene.flat))
        return false;
    ir_features_explain(session->scene, &session->origin, &scene.reasons);
    (as_json ? inspect_scene_json : inspect_scene_text)(&scene, out);
    flat_finish(&scene.flat);
    return true;
}

int cmd_inspect(struct cli *cli) {
    static const char *const formats[] = {"text", "json", NULL};
    int format;
    if (inspect_is_picture(cli->operands[0]))
        return inspect_picture(cli);
    if (!cli_format(cli, formats, &format) ||
        (cli->options.ir && cli_has_no_effect(cli, "format", "'--ir' prints the scene, in its own language")))
        return CLI_USAGE;
    struct session session;
    struct strbuf text;
    struct asset_store *store = asset_store_create();
    struct session_options options = cli_session_options(cli, cli->operands[0]);
    options.text_only = cli->options.ir != CLI_IR_NONE;
    options.keeps_written = cli->options.ir == CLI_IR_WRITTEN;
    options.lint = LINT_ALL;
    if (options.pixels == ASSETS_KEEP_PIXELS)
        options.pixels = ASSETS_CHECK_PIXELS;
    strbuf_init(&text);
    session_load(&session, &options, store);
    bool good = session.state == SESSION_LOADED && session.sink.errors == 0;
    if (good && cli->options.ir == CLI_IR_WRITTEN) {
        ir_dump(session.origin.written ? session.origin.written : session.scene, &text);
    } else if (good && cli->options.ir) {
        ir_expand(session.scene, &session.arena);
        ir_dump(session.scene, &text);
    } else if (good) {
        good = describe(&session, format == 1, &text);
    }
    int status = cli_report(cli, &session, !cli->options.ir);
    if (status == CLI_OK)
        status = good ? cli_print(cli, strbuf_view(&text)) : CLI_SCENE;
    strbuf_finish(&text);
    session_finish(&session);
    asset_store_destroy(store);
    return status;
}
