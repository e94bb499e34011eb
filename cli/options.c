// Walks the table: the parser, --help, "did you mean", which options go together.
#include "cli/cli.h"

#include "core/nearest.h"
#include "core/number.h"

#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    LETTER_END = 256,           // getopt's numbers of rows begin after those of letters
    LETTERS_BYTES = 4 * 26 + 2, // of all letters, each with a sign
};

static bool belongs(const struct option_row *row, const struct cli_command *command) {
    if (!command)
        return strchr(row->commands, '-') != NULL;
    if (row->commands[0] == '*')
        return true;
    size_t n = strlen(command->name);
    for (const char *p = strstr(row->commands, command->name); p; p = strstr(p + n, command->name))
        if ((p == row->commands || p[-1] == ' ') && (p[n] == ' ' || p[n] == '\0'))
            return true;
    return false;
}

const struct option_row *cli_next_option(const struct cli_command *command, const struct option_row *row) {
    const struct option_row *end = option_rows + option_row_count;
    for (row = row ? row + 1 : option_rows; row < end; row++)
        if (belongs(row, command))
            return row;
    return NULL;
}

bool cli_option_is_optional(const struct option_row *row) {
    return row->argument && row->argument[0] == '[';
}

void cli_option_help(struct strbuf *out, const struct cli_command *command) {
    for (const struct option_row *row = NULL; (row = cli_next_option(command, row)) != NULL;) {
        char left[128];
        const char *argument = row->argument ? row->argument : "";
        const char *joint = row->argument && !cli_option_is_optional(row) ? " " : "";
        if (row->letter)
            snprintf(left, sizeof left, "-%c, --%s%s%s", row->letter, row->name, joint, argument);
        else
            snprintf(left, sizeof left, "    --%s%s%s", row->name, joint, argument);
        strbuf_format(out, "  %-28s %s\n", left, row->doc);
    }
}

// ---- values

static bool read_whole(struct cli *cli, int arg, const struct option_row *row, const char *text,
                       int32_t *out) {
    if (!text)
        *out = row->otherwise;
    return !text || number_parse_whole(str_from(text), (int64_t)row->least, (int64_t)row->most, out) ||
           cli_bad_count(cli, arg, row->name, text, (uint64_t)row->least, (uint64_t)row->most);
}

static bool read_number(struct cli *cli, int arg, const struct option_row *row, const char *text,
                        double *out) {
    if (number_parse_real(str_from(text), row->least, row->most, out))
        return true;
    if (isinf(row->most))
        cli_usage(cli, arg, "--%s takes a number of at least %g, not '%s'", row->name, row->least, text);
    else
        cli_usage(cli, arg, "--%s takes a number from %g to %g, not '%s'", row->name, row->least, row->most,
                  text);
    return false;
}

static bool bad_word(struct cli *cli, int arg, const struct option_row *row, const char *text) {
    const bool optional = cli_option_is_optional(row); // 'no', 'yes' or nothing
    const char *quote = optional ? "'" : "";
    str list = STR("");
    for (const struct option_word *w = row->words + optional; w->word; w++) {
        const char *joint = w == row->words + optional ? "" : w[1].word || optional ? ", " : " or ";
        list = arena_format(&cli->arena, "%.*s%s%s%s%s", STR_ARG(list), joint, quote, w->word, quote);
    }
    cli_usage(cli, arg, "--%s takes %.*s%s, not '%s'", row->name, STR_ARG(list),
              optional ? " or nothing" : "", text);
    return false;
}

static bool read_word(struct cli *cli, int arg, const struct option_row *row, const char *text, void *field) {
    const struct option_word *w = row->words;
    if (text)
        for (w += cli_option_is_optional(row); w->word && strcmp(w->word, text) != 0;)
            w++;
    if (!w->word)
        return bad_word(cli, arg, row, text);
    if (row->kind == OPTION_CHOICE)
        *(const char **)field = w->word;
    else if (row->size == sizeof(bool))
        *(bool *)field = w->value != 0;
    else
        *(int *)field = w->value;
    return true;
}

static bool read_folder(struct cli *cli, int arg, const char *name, const char *text) {
    struct stat info;
    int error = stat(text, &info) != 0 ? errno : S_ISDIR(info.st_mode) ? 0 : ENOTDIR;
    if (error)
        cli_usage(cli, arg, "--%s: '%s' is not a folder that can be read: %s", name, text, strerror(error));
    return error == 0;
}

static void keep_text(struct cli *cli, const struct option_row *row, const char *text, void *field) {
    if (row->kind == OPTION_LIST || (row->kind == OPTION_FOLDER && row->size == sizeof(struct cli_list)))
        *(str *)ARENA_PUSH(&cli->arena, (struct cli_list *)field) = str_from(text);
    else if (row->size == sizeof(str))
        *(str *)field = str_from(text);
    else
        *(const char **)field = text;
}

static bool apply(struct cli *cli, int arg, const struct option_row *row, const char *value) {
    while (row->kind == OPTION_AGAIN)
        for (const char *name = (row--)->name; strcmp(row->name, name) != 0;)
            row--;
    char *options = (char *)&cli->options, *field = options + row->offset;
    if (row->given)
        *(bool *)(options + row->given) = true;
    switch (row->kind) {
    case OPTION_FLAG:
        return *(bool *)field = true;
    case OPTION_FOLDER:
        if (!read_folder(cli, arg, row->name, value))
            return false;
        keep_text(cli, row, value, field);
        return true;
    case OPTION_TEXT:
    case OPTION_READ:
    case OPTION_WRITTEN:
    case OPTION_LIST:
        keep_text(cli, row, value, field);
        return true;
    case OPTION_WHOLE:
        return read_whole(cli, arg, row, value, (int32_t *)field);
    case OPTION_NUMBER:
        return read_number(cli, arg, row, value, (double *)field);
    case OPTION_WORD:
    case OPTION_CHOICE:
        return read_word(cli, arg, row, value, field);
    case OPTION_SYNTAX:
        return row->read(cli, arg, row, value);
    case OPTION_AGAIN:
        break;
    }
    return false;
}

// ---- the command line

// A repeated flag changes nothing.
static bool takes_many(const struct option_row *row) {
    return !row->argument || str_ends_with_nocase(str_from(row->argument), " ...");
}

// A repeated option that takes one value would lose the first value.
static bool is_repeated(struct cli *cli, int arg, const struct option_row *row) {
    int *first = &cli->option_places[row - option_rows];
    if (*first == 0 || takes_many(row)) {
        *first = arg;
        return false;
    }
    cli_usage(cli, arg, "option '--%s' is given twice, and takes one value", row->name);
    diag_note(&cli->sink, cli_place(cli, *first), "the first one is here");
    diag_help(&cli->sink, "leave one of them out");
    return true;
}

bool cli_has_option(const struct cli_command *command, const char *name) {
    for (const struct option_row *row = NULL; (row = cli_next_option(command, row)) != NULL;)
        if (strcmp(row->name, name) == 0)
            return true;
    return false;
}

int cli_option_place(const struct cli *cli, const char *name) {
    int place = 0;
    for (int i = 0; i < option_row_count; i++)
        if (cli->option_places && strcmp(option_rows[i].name, name) == 0 && cli->option_places[i])
            place = cli->option_places[i];
    return place;
}

bool cli_has_no_effect(struct cli *cli, const char *name, const char *why) {
    int place = cli_option_place(cli, name);
    if (place == 0)
        return false;
    cli_usage(cli, place, "option '--%s' would have no effect: %s", name, why);
    diag_help(&cli->sink, "leave it out");
    return true;
}

bool cli_have_no_effect(struct cli *cli, const struct cli_no_effect *rows) {
    const char *why = NULL;
    for (; rows->option; rows++) {
        why = rows->why ? rows->why : why;
        if (cli_has_no_effect(cli, rows->option, why))
            return true;
    }
    return false;
}

bool cli_judge_options(struct cli *cli) {
    for (int i = 0; i < option_row_count; i++) {
        const struct option_row *row = &option_rows[i];
        const bool is_idle = cli->option_places[i] && row->why &&
                             ((row->needs && !cli_option_place(cli, row->needs)) ||
                              (row->excludes && cli_option_place(cli, row->excludes)));
        if (is_idle && cli_has_no_effect(cli, row->name, row->why))
            return false;
    }
    return true;
}

static void suggest(struct cli *cli, const struct cli_command *command, const char *word) {
    struct nearest search = nearest_begin((str){word, strcspn(word, "=")});
    for (const struct option_row *row = NULL; (row = cli_next_option(command, row)) != NULL;)
        nearest_offer(&search, arena_format(&cli->arena, "--%s", row->name));
    cli_did_you_mean(cli, &search,
                     arena_format(&cli->arena, "'glint %s%s--help' lists the options",
                                  command ? command->name : "", command ? " " : "")
                         .ptr);
}

// The word that getopt read last.
static const char *word_of_option(int argc, char **argv, bool unknown) {
    const char *word = argv[optind - 1] == optarg && optind >= 2 ? argv[optind - 2] : argv[optind - 1];
    // inside a word of several letters, optind stays at the word
    return unknown && word[0] != '-' && optind < argc ? argv[optind] : word;
}

// The rows of a command as getopt takes them: no two have the same letter.
struct getopt_words {
    struct option *longs;
    char letters[LETTERS_BYTES];
};

static void take_words(struct cli *cli, const struct cli_command *command, struct getopt_words *words) {
    struct option *at = words->longs = ARENA_ARRAY(&cli->arena, struct option, (size_t)option_row_count + 1);
    char *letter = words->letters;
    *letter++ = ':';
    for (const struct option_row *row = NULL; (row = cli_next_option(command, row)) != NULL;) {
        const int has = !row->argument                ? no_argument
                        : cli_option_is_optional(row) ? optional_argument
                                                      : required_argument;
        *at++ = (struct option){row->name, has, NULL, LETTER_END + (int)(row - option_rows)};
        if (row->letter)
            *letter++ = row->letter;
        if (row->letter && has == required_argument)
            *letter++ = ':';
    }
}

static const struct option_row *row_of(const struct cli_command *command, int id) {
    const struct option_row *row = NULL;
    if (id >= LETTER_END)
        return &option_rows[id - LETTER_END];
    do
        row = cli_next_option(command, row);
    while (row && row->letter != id);
    return row;
}

// The argument that is `word`.
static int argument_of(const struct cli *cli, int first, int at, const char *word) {
    for (int i = first; i < cli->argc; i++)
        at = cli->argv[i] == word ? i : at;
    return at;
}

bool cli_parse_options(struct cli *cli, const struct cli_command *command, int first) {
    struct getopt_words words = {0};
    take_words(cli, command, &words);
    // getopt sorts operands after options, so it works on a copy and places stay those of the user.
    int argc = cli->argc - first + 1;
    char **argv = ARENA_ARRAY(&cli->arena, char *, (size_t)argc + 1);
    for (int i = 0; i < argc; i++)
        argv[i] = cli->argv[first - 1 + i];
    cli->option_places = ARENA_ARRAY(&cli->arena, int, (size_t)option_row_count);
    opterr = 0;
    optind = 0;
    bool good = true;
    const char *faulty = NULL;
    for (;;) {
        int at = optind ? optind : 1;
        int id = getopt_long(argc, argv, words.letters, words.longs, NULL);
        if (id == -1)
            break;
        const bool is_wrong = id == '?' || id == ':';
        const char *word = word_of_option(argc, argv, id == '?');
        const int arg = argument_of(cli, first, at, word);
        const struct option_row *row = is_wrong ? NULL : row_of(command, id);
        if (row)
            good = !is_repeated(cli, arg, row) && apply(cli, arg, row, optarg) && good;
        if (!is_wrong || word == faulty) // another letter of the same word
            continue;
        faulty = word;
        good = false;
        cli_usage(cli, arg, id == ':' ? "option '%s' needs a value" : "unknown or ambiguous option '%s'",
                  word);
        if (id == '?')
            suggest(cli, command, word);
    }
    cli->color = cli_has_color(cli, STDERR_FILENO);
    cli->operands = argv + optind;
    cli->operand_count = argc - optind;
    return good;
}

bool cli_format(struct cli *cli, const char *const *kinds, int *kind) {
    const char *text = cli->options.format;
    *kind = 0;
    if (!text)
        return true;
    struct nearest search = nearest_begin(str_from(text));
    for (int i = 0; kinds[i]; i++) {
        nearest_offer(&search, str_from(kinds[i]));
        *kind = i;
        if (strcmp(text, kinds[i]) == 0)
            return true;
    }
    cli_usage(cli, cli_option_place(cli, "format"), "--format does not know '%s'", text);
    str list = STR("it takes one of: ");
    for (int i = 0; kinds[i]; i++)
        list = arena_format(&cli->arena, "%.*s%s%s", STR_ARG(list), i ? ", " : "", kinds[i]);
    cli_did_you_mean(cli, &search, list.ptr);
    return false;
}
