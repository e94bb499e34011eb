// glint tradeoff SCENE: what each setting costs, and what error it causes.
#include "cli/commands/commands.h"
#include "cli/commands/study.h"
#include "cli/device.h"
#include "cli/progress.h"
#include "measure/tradeoff/report/report.h"

static int write_html(struct cli *cli, const struct tradeoff *study) {
    struct strbuf page;
    strbuf_init(&page);
    tradeoff_html(study, cli->operands[0], &page);
    const int status = cli_write_made(cli, cli->options.output, &page, "the report");
    strbuf_finish(&page);
    return status;
}

static int print_report(struct cli *cli, const struct tradeoff *study, int kind) {
    struct strbuf text;
    strbuf_init(&text);
    if (kind == 0)
        tradeoff_text(study, cli->operands[0], &text);
    else if (kind == 1)
        tradeoff_json(study, cli->operands[0], &text);
    else
        tradeoff_csv(study, &text);
    const int status = cli_write_made(cli, "-", &text, "the report");
    strbuf_finish(&text);
    return status;
}

static bool nothing_fits(const struct tradeoff *study) {
    const struct choice *choice = tradeoff_choice(study);
    return choice && choice->row == CHOICE_NONE;
}

static int study_and_report(struct cli *cli, struct session *session, const struct tradeoff_options *options,
                            int kind) {
    struct tradeoff study;
    struct gpu *gpu = NULL;
    int status = cli_study(cli, session, options, &gpu, &study);
    if (status == CLI_OK)
        status = cli_report(cli, session, !cli->options.quiet);
    if (status == CLI_OK && cli->options.output)
        status = write_html(cli, &study);
    if (status == CLI_OK)
        status = print_report(cli, &study, kind);
    if (status == CLI_OK && nothing_fits(&study))
        status = CLI_SCENE;
    tradeoff_finish(&study);
    cli_close_device(cli, gpu);
    return status;
}

int cmd_tradeoff(struct cli *cli) {
    static const char *const kinds[] = {"text", "json", "csv", NULL};
    struct tradeoff_options options;
    struct session session;
    int kind;
    if (!cli_format(cli, kinds, &kind) || !cli_study_options(cli, &options))
        return CLI_USAGE;
    if (cli_device_is_reference(cli))
        return cli_usage(cli, 1, "settings are measured against the reference: choose a device");
    if (cli->options.output && !str_ends_with_nocase(str_from(cli->options.output), ".html"))
        return cli_usage(cli, cli_option_place(cli, "output"), "the report '%s' must end in .html",
                         cli->options.output);
    if (!(options.budget_s > 0))
        options.budget_s = TRADEOFF_BUDGET_S;
    options.thumbnails = cli->options.output != NULL;
    interrupt_catch();
    struct asset_store *store = asset_store_create();
    struct session_options load = cli_session_options(cli, cli->operands[0]);
    load.whole_picture = true;
    session_load(&session, &load, store);
    const bool good = session.state == SESSION_LOADED && session.sink.errors == 0;
    const int status = good ? study_and_report(cli, &session, &options, kind)
                            : cli_report(cli, &session, !cli->options.quiet);
    session_finish(&session);
    asset_store_destroy(store);
    return status;
}
