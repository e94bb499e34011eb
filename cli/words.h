// What --help and the man page say of the program as a whole. Thread safety: constant.
#ifndef GLINT_CLI_WORDS_H
#define GLINT_CLI_WORDS_H

// What it does, and its exit status.
extern const char *const cli_purpose, *const cli_exits;

#endif
