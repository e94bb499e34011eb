// The options of glint test (cli/commands/test).
//
// Thread safety: as cli.h.
#ifndef GLINT_CLI_OPTIONS_OPTIONS_TEST_H
#define GLINT_CLI_OPTIONS_OPTIONS_TEST_H

#include <stdbool.h>

enum cli_test_option {
    CLI_TEST_BOUNDS,
    CLI_TEST_BLESS,
    CLI_TEST_ONLY,
    CLI_TEST_HTML,
    CLI_TEST_JUNIT,
};

struct cli_test {
    const char *bounds, *only, *html, *junit; // NULL: not given
    bool blesses;
    int bounds_arg, only_arg;
};

struct cli;
// Takes one of them. false: the value is wrong, and the mistake is in cli->sink.
bool cli_test_apply(struct cli *cli, int arg, enum cli_test_option option, const char *value);

#endif
