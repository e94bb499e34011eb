// The options that say what a check reports and when it fails: --severity, --ignore, --only, --fail-on; and
// --config, the settings of whoever runs glint, which override those beside the scenes and are overridden by
// the other options.
#include "cli/cli.h"

#include "core/nearest.h"
#include "diag/codes/limit.h"
#include "load/settings/config.h"

#include <string.h>
#include <strings.h>
#include <unistd.h>

static bool refuse_codes(struct cli *cli, int arg, const char *name, str codes,
                         enum diag_policy_status status) {
    if (status == DIAG_POLICY_UNKNOWN_CODE) {
        cli_usage(cli, arg, "--%s: there is no code '%.*s'", name, STR_ARG(codes));
        diag_help(&cli->sink, "a code is a letter and three digits, such as W401, or a family, such as W4xx");
    } else if (status == DIAG_POLICY_ERROR_CODE) {
        cli_usage(cli, arg, "--%s: errors cannot be silenced or lowered, and '%.*s' is one", name,
                  STR_ARG(codes));
        diag_help(&cli->sink, "only warnings (W) and notes (N) can be changed");
    }
    return status == DIAG_POLICY_SET;
}

static bool refuse_word(struct cli *cli, int arg, const char *name, str word, const char *const *words) {
    struct nearest search = nearest_begin(word);
    for (int i = 0; words[i]; i++)
        nearest_offer(&search, str_from(words[i]));
    cli_usage(cli, arg, "--%s does not know '%.*s'", name, STR_ARG(word));
    cli_did_you_mean(cli, &search,
                     words == diag_fail_words ? "it takes error or warning"
                                              : "a severity is error, warning, note or off");
    return false;
}

bool cli_read_severity(struct cli *cli, int arg, const struct option_row *row, const char *text) {
    size_t length = strcspn(text, "=");
    str codes = {text, length};
    if (text[length] != '=') {
        cli_usage(cli, arg, "--severity takes CODE=SEVERITY, such as W401=error, not '%s'", text);
        return false;
    }
    str word = str_from(text + length + 1);
    for (uint32_t i = 0; i < cli->options.severities.count; i++)
        if (codes.len == cli->options.severities.items[i].len &&
            strncasecmp(codes.ptr, cli->options.severities.items[i].ptr, codes.len) == 0) {
            cli_usage(cli, arg, "--severity: '%.*s' is given twice", STR_ARG(codes));
            return false;
        }
    *ARENA_PUSH(&cli->arena, &cli->options.severities) = codes;
    enum diag_policy_status status = diag_policy_level(&cli->options.policy, codes, word);
    if (status == DIAG_POLICY_BAD_WORD)
        return refuse_word(cli, arg, row->name, word, diag_level_words);
    return refuse_codes(cli, arg, row->name, codes, status);
}

bool cli_read_ignore(struct cli *cli, int arg, const struct option_row *row, const char *text) {
    char folder[4096];
    str pattern = str_from(text);
    if (diag_is_code_text(pattern))
        return refuse_codes(cli, arg, row->name, pattern,
                            diag_policy_level(&cli->options.policy, pattern, STR("off")));
    if (pattern.len == 0 || !getcwd(folder, sizeof folder)) {
        cli_usage(cli, arg,
                  "--ignore takes a code, such as W401, or a pattern of paths, such as 'drafts/**'");
        return false;
    }
    diag_policy_ignore_path(&cli->options.policy, &cli->arena, str_from(folder), pattern);
    return true;
}

bool cli_read_only(struct cli *cli, int arg, const struct option_row *row, const char *text) {
    return refuse_codes(cli, arg, row->name, str_from(text),
                        diag_policy_only(&cli->options.policy, str_from(text)));
}

bool cli_read_fail_on(struct cli *cli, int arg, const struct option_row *row, const char *text) {
    return diag_policy_fail_on(&cli->options.policy, str_from(text)) == DIAG_POLICY_SET ||
           refuse_word(cli, arg, row->name, str_from(text), diag_fail_words);
}

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
