// The options of glint test.
#include "cli/cli.h"

bool cli_test_apply(struct cli *cli, int arg, enum cli_test_option option, const char *value) {
    struct cli_test *test = &cli->options.test;
    switch (option) {
    case CLI_TEST_BOUNDS:
        test->bounds = value;
        test->bounds_arg = arg;
        return true;
    case CLI_TEST_BLESS:
        return test->blesses = true;
    case CLI_TEST_ONLY:
        test->only = value;
        test->only_arg = arg;
        return true;
    case CLI_TEST_HTML:
        test->html = value;
        return true;
    case CLI_TEST_JUNIT:
        test->junit = value;
        return true;
    }
    return false;
}
