// Man pages and completions for shells, made from the tables of commands and options.
//
// Input: a struct manual, whose texts are those of `--help`. Output: text, added to `out`. Errors:
// out->failed. Ownership: the caller's. Thread safety: pure.
#ifndef GLINT_CLI_COMMANDS_MANUAL_MANUAL_H
#define GLINT_CLI_COMMANDS_MANUAL_MANUAL_H

#include "cli/cli.h"

#include <stdint.h>

struct manual {
    const char *version;
    const char *date; // of the page, YYYY-MM-DD; empty: none
    const char *purpose;
    const char *exits;                  // "Exit status: 0 no error; 1 ...", lines broken anywhere
    const struct cli_command *commands; // a row without a name at the end
};

// glint(1) if `command` is NULL, else glint-COMMAND(1), in man(7).
void manual_page(const struct manual *manual, const struct cli_command *command, struct strbuf *out);
// Completion scripts.
void manual_bash(const struct manual *manual, struct strbuf *out);
void manual_zsh(const struct manual *manual, struct strbuf *out);
void manual_fish(const struct manual *manual, struct strbuf *out);

#endif
