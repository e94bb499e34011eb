// --config: settings of whoever runs glint. They go before those beside the scenes, and after the other
// options.
#include "cli/cli.h"

#include "app/settings/config.h"

static void take(void *context) {
    struct cli *cli = context;
    struct cli_options *options = &cli->options;
    struct files files;
    struct config config;
    files_init(&files, &cli->arena);
    struct config_input input = {
        .files = &files, .sources = &cli->sources, .sink = &cli->sink, .arena = &cli->arena};
    str path = str_from(options->config);
    config_read_file(&input, path, path, &config);
    if (cli->sink.errors)
        return;
    limits_fill(&options->limits, &config.limits);
    diag_policy_overlay(&config.policy, &cli->arena, &options->policy);
    options->policy = config.policy;
    for (uint32_t i = 0; i < config.asset_paths.count; i++)
        *ARENA_PUSH(&cli->arena, &options->asset_paths) = config.asset_paths.items[i];
}

bool cli_take_config(struct cli *cli) {
    enum arena_fault fault = arena_guarded(&cli->arena, take, cli);
    if (fault)
        diag_add(&cli->sink, DIAG_OUT_OF_MEMORY, SPAN_NONE, "not enough memory for the settings");
    return cli->sink.errors == 0;
}
