// The table of options, row by row: each is read at its bounds and refused beyond them, with its message at
// its place, and is in the help, the man page and the completions of its commands and of no other.
#include "cli/cli.h"
#include "cli/commands/manual/manual.h"
#include "core/ranges.h"
#include "diag/codes/command.h"
#include "load/settings/keys.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    COMMANDS_MOST = 64,
    NAME_BYTES = 32,
};

// The commands that rows name, and at the end none.
static struct cli_command commands[COMMANDS_MOST + 1];
static char names[COMMANDS_MOST][NAME_BYTES];

// Whether a row's list of commands has a name; NULL: the program.
static bool names_command(const struct option_row *row, const char *name) {
    char list[512], *rest = NULL;
    snprintf(list, sizeof list, "%s", row->commands);
    if (!name || row->commands[0] == '*')
        return row->commands[0] == '*' ? name || row->commands[1] == '-' : strcmp(row->commands, "-") == 0;
    for (char *word = strtok_r(list, " ", &rest); word; word = strtok_r(NULL, " ", &rest))
        if (strcmp(word, name) == 0)
            return true;
    return false;
}

static int make_commands(void **state) {
    int count = 0;
    (void)state;
    for (int i = 0; i < option_row_count; i++) {
        char list[512], *rest = NULL;
        snprintf(list, sizeof list, "%s", option_rows[i].commands);
        for (char *word = strtok_r(list, " ", &rest); word; word = strtok_r(NULL, " ", &rest)) {
            int at = 0;
            while (at < count && strcmp(names[at], word) != 0)
                at++;
            if (at < count || word[0] == '*' || word[0] == '-')
                continue;
            assert_true(count < COMMANDS_MOST);
            snprintf(names[count], sizeof names[count], "%s", word);
            commands[count] = (struct cli_command){
                .name = names[count], .operands = "", .summary = "s", .details = "", .most_operands = -1};
            count++;
        }
    }
    assert_true(count > 15);
    return 0;
}

static const struct cli_command *command_of(const char *name) {
    const struct cli_command *c = commands;
    while (name && c->name && strcmp(c->name, name) != 0)
        c++;
    return name ? c : NULL;
}

// The first command of a row; NULL: it is only the program's.
static const struct cli_command *first_command(const struct option_row *row) {
    const struct cli_command *c = commands;
    while (c->name && !names_command(row, c->name))
        c++;
    return c->name ? c : NULL;
}

// ---- a command line

struct line {
    struct cli cli;
    char *argv[8];
    bool good;
};

static void parse(struct line *line, const struct cli_command *command, const char *a, const char *b) {
    struct strbuf text;
    *line = (struct line){.argv = {(char *)"glint", (char *)(command ? command->name : a)}};
    int count = command ? 2 : 1;
    if (command && a)
        line->argv[count] = (char *)a;
    count += a != NULL;
    line->argv[count] = (char *)b;
    count += b != NULL;
    line->cli = (struct cli){.argc = count, .argv = line->argv, .commands = commands};
    arena_init(&line->cli.arena, SIZE_MAX / 2);
    source_set_init(&line->cli.sources, &line->cli.arena);
    diag_sink_init(&line->cli.sink);
    line->cli.options.limits = limits_default();
    line->cli.arg_begin = ARENA_ARRAY(&line->cli.arena, uint32_t, (size_t)count + 1);
    strbuf_init(&text);
    for (int i = 0; i < count; i++) {
        line->cli.arg_begin[i] = (uint32_t)text.len;
        strbuf_format(&text, "%s ", line->argv[i]);
    }
    source_add(&line->cli.sources, SOURCE_KIND_OPTION, STR("command-line"),
               arena_copy(&line->cli.arena, strbuf_view(&text)));
    strbuf_finish(&text);
    line->good = cli_parse_options(&line->cli, command, command ? 2 : 1);
}

static void finish(struct line *line) {
    diag_sink_finish(&line->cli.sink);
    arena_finish(&line->cli.arena);
}

// "--name", or "--name=value" where a value may be left out.
static void parse_row(struct line *line, const struct option_row *row, const char *value) {
    static char text[256];
    const bool glued = value && cli_option_is_optional(row);
    snprintf(text, sizeof text, "--%s%s%s", row->name, glued ? "=" : "", glued ? value : "");
    parse(line, first_command(row), text, glued ? NULL : value);
}

// The row that says what an option is.
static const struct option_row *base_of(const struct option_row *row) {
    const char *name = row->name;
    while (row->kind == OPTION_AGAIN || strcmp(row->name, name) != 0)
        row--;
    return row;
}

static const void *field_of(const struct line *line, const struct option_row *row) {
    return (const char *)&line->cli.options + base_of(row)->offset;
}

static void check_given(const struct line *line, const struct option_row *row) {
    const uint32_t given = base_of(row)->given;
    assert_true(cli_option_place(&line->cli, row->name) == line->cli.argc - 1 ||
                cli_option_place(&line->cli, row->name) == line->cli.argc - 2);
    if (given)
        assert_true(*((const bool *)&line->cli.options + given));
}

static void check_taken(const struct option_row *row, const char *value) {
    struct line line;
    parse_row(&line, row, value);
    if (!line.good)
        fail_msg("--%s %s: %s", row->name, value ? value : "",
                 line.cli.sink.count ? line.cli.sink.items[0].message.ptr : "");
    check_given(&line, row);
    finish(&line);
}

// What is said of a value, at the option. `message` NULL: anything that names the option.
static void check_refused(const struct option_row *row, const char *value, const char *message) {
    struct line line;
    parse_row(&line, row, value);
    if (line.good || line.cli.sink.count != 1)
        fail_msg("--%s %s: %u mistakes", row->name, value, line.cli.sink.count);
    const struct diag *d = &line.cli.sink.items[0];
    const int arg = first_command(row) ? 2 : 1;
    assert_int_equal(d->code, DIAG_USAGE);
    assert_int_equal(d->at.begin, line.cli.arg_begin[arg]);
    assert_int_equal(d->at.end, line.cli.arg_begin[arg] + strlen(line.argv[arg]));
    if (message)
        assert_string_equal(d->message.ptr, message);
    else if (!strstr(d->message.ptr, row->name))
        fail_msg("--%s %s: %s", row->name, value, d->message.ptr);
    finish(&line);
}

// ---- what a row may be

static void check_row(const struct option_row *row) {
    const struct option_row *base = base_of(row);
    assert_true(strspn(row->name, "abcdefghijklmnopqrstuvwxyz-") == strlen(row->name) && row->doc[0]);
    assert_true((base->kind == OPTION_FLAG) == (row->argument == NULL));
    assert_true((base->kind == OPTION_SYNTAX) == (base->read != NULL));
    assert_true((base->kind == OPTION_WORD || base->kind == OPTION_CHOICE) == (base->words != NULL));
    if (base->kind == OPTION_WHOLE || base->kind == OPTION_NUMBER)
        assert_true(base->least < base->most);
    if (base->words && base->words[0].word[0] == '\0')
        assert_true(cli_option_is_optional(row));
    assert_true((row->needs || row->excludes) == (row->why != NULL));
    for (int i = 0; commands[i].name; i++)
        if (names_command(row, commands[i].name)) {
            assert_true(!row->needs || cli_has_option(&commands[i], row->needs));
            assert_true(!row->excludes || cli_has_option(&commands[i], row->excludes));
        }
}

static void rows_are_whole(void **state) {
    (void)state;
    assert_int_equal(option_rows[0].kind == OPTION_AGAIN, 0);
    for (int i = 0; i < option_row_count; i++)
        check_row(&option_rows[i]);
    for (int c = 0; commands[c].name; c++)
        for (const struct option_row *a = NULL; (a = cli_next_option(&commands[c], a)) != NULL;)
            for (const struct option_row *b = a; (b = cli_next_option(&commands[c], b)) != NULL;)
                if (strcmp(a->name, b->name) == 0 || (a->letter && a->letter == b->letter))
                    fail_msg("%s has --%s and --%s", commands[c].name, a->name, b->name);
}

// The program has each command that a row names.
static void commands_are_there(void **state) {
    char line[512];
    bool seen[COMMANDS_MOST] = {false};
    FILE *help = popen("'" GLINT "' --help", "r");
    (void)state;
    assert_non_null(help);
    while (fgets(line, sizeof line, help))
        for (int i = 0; commands[i].name; i++)
            seen[i] |= strncmp(line, "  ", 2) == 0 && line[2 + strlen(commands[i].name)] == ' ' &&
                       strncmp(line + 2, commands[i].name, strlen(commands[i].name)) == 0;
    assert_int_equal(pclose(help), 0);
    for (int i = 0; commands[i].name; i++)
        if (!seen[i])
            fail_msg("there is no command '%s'", commands[i].name);
}

// ---- values

static void check_whole(const struct option_row *row) {
    const struct option_row *base = base_of(row);
    const double ends[2] = {base->least, base->most};
    char text[64], message[256];
    struct line line;
    for (int i = 0; i < 2; i++) {
        snprintf(text, sizeof text, "%.0f", ends[i]);
        parse_row(&line, row, text);
        assert_true(line.good && (double)*(const int32_t *)field_of(&line, row) == ends[i]);
        finish(&line);
        snprintf(text, sizeof text, "%.0f", ends[i] + (i ? 1 : -1));
        snprintf(message, sizeof message, "--%s takes a whole number from %.0f to %.0f, not '%s'", row->name,
                 base->least, base->most, text);
        check_refused(row, text, message);
    }
    check_refused(row, "1e3", NULL);
    if (!cli_option_is_optional(row))
        return;
    parse_row(&line, row, NULL);
    assert_true(line.good && *(const int32_t *)field_of(&line, row) == base->otherwise);
    finish(&line);
}

static void check_number(const struct option_row *row) {
    const struct option_row *base = base_of(row);
    const double ends[2] = {base->least, base->most};
    char text[64], message[256];
    struct line line;
    for (int i = 0; i < (isinf(base->most) ? 1 : 2); i++) {
        snprintf(text, sizeof text, "%.17g", ends[i]);
        parse_row(&line, row, text);
        assert_true(line.good && *(const double *)field_of(&line, row) == ends[i]);
        finish(&line);
        snprintf(text, sizeof text, "%.17g", nextafter(ends[i], i ? HUGE_VAL : -HUGE_VAL));
        snprintf(message, sizeof message, "--%s takes a number from %g to %g, not '%s'", row->name,
                 base->least, base->most, text);
        if (isinf(base->most))
            snprintf(message, sizeof message, "--%s takes a number of at least %g, not '%s'", row->name,
                     base->least, text);
        check_refused(row, fabs(ends[i]) > 0 ? text : "-1e-9", fabs(ends[i]) > 0 ? message : NULL);
    }
    check_refused(row, "one", NULL);
    check_refused(row, "nan", NULL);
}

static void check_words(const struct option_row *row) {
    const struct option_row *base = base_of(row);
    struct line line;
    for (const struct option_word *w = base->words; w->word; w++) {
        parse_row(&line, row, w->word[0] ? w->word : NULL);
        assert_true(line.good);
        if (base->kind == OPTION_CHOICE)
            assert_string_equal(*(const char *const *)field_of(&line, row), w->word);
        else if (base->size == sizeof(bool))
            assert_int_equal(*(const bool *)field_of(&line, row), w->value);
        else
            assert_int_equal(*(const int *)field_of(&line, row), w->value);
        check_given(&line, row);
        finish(&line);
    }
    check_refused(row, "such", NULL);
}

static void check_text(const struct option_row *row) {
    const struct option_row *base = base_of(row);
    struct line line;
    parse_row(&line, row, ".");
    assert_true(line.good);
    check_given(&line, row);
    const void *field = field_of(&line, row);
    if (base->kind == OPTION_LIST || (base->kind == OPTION_FOLDER && base->size == sizeof(struct cli_list)))
        assert_true(((const struct cli_list *)field)->count == 1 &&
                    str_equal(((const struct cli_list *)field)->items[0], STR(".")));
    else if (base->size == sizeof(str))
        assert_true(str_equal(*(const str *)field, STR(".")));
    else
        assert_string_equal(*(const char *const *)field, ".");
    finish(&line);
    if (base->kind == OPTION_FOLDER)
        check_refused(row, "no such folder", NULL);
}

static void check_syntax(const struct option_row *row) {
    static const struct {
        const char *name, *good[4], *bad[6];
    } values[] = {
        {"output", {"a", "-"}, {NULL}},
        {"size", {"1x1", "16384X16384"}, {"0x1", "1x0", "16385x1", "1x16385", "1"}},
        {"aov", {"depth", "depth,normal"}, {"", "depht", "depth,depth", "depth,"}},
        {"limit", {"help", "messages=1", "messages=1000000"}, {"messages=x"}},
        {"max-messages", {"1", "1000000"}, {"0", "1000001"}},
        {"untrusted", {NULL, "1", "1000000,1"}, {"0", "1000001", "1,0", "a"}},
        {"region", {"0,0,1,1", "16384,16384,16384,16384"}, {"0,0,0,1", "0,0,1,0", "16385,0,1,1", "1,1,1"}},
        {"tile", {"1/1", "100000/100000"}, {"0/1", "2/1", "1/100001", "1"}},
        {"heatmap", {"a.png", "A.PNG"}, {"a.jpg"}},
        {"frames", {"0", "0..1000000000:2"}, {"2..1", "0..1:0", "-1", "0..1000000001"}},
        {"frame", {"0", "1000000000"}, {"-1", "1000000001"}},
        {"sweep", {"a=1:2:10000", "a=x,y"}, {"a", "=1", "a=1,,2"}},
        {"severity", {"W401=error", "w4XX=off"}, {"W401", "W401=loud", "E101=off", "W999=off"}},
        {"ignore", {"W401", "a/**"}, {"", "E101"}},
        {"only", {"W401"}, {"W999"}},
        {"fail-on", {"warning", "error"}, {"note"}},
    };
    size_t at = 0;
    while (at < sizeof values / sizeof *values && strcmp(values[at].name, row->name) != 0)
        at++;
    if (at == sizeof values / sizeof *values)
        fail_msg("no value is tried for --%s", row->name);
    for (int i = 0; i == 0 || (i < 4 && values[at].good[i]); i++)
        check_taken(row, values[at].good[i]);
    for (int i = 0; i < 6 && values[at].bad[i]; i++)
        check_refused(row, values[at].bad[i], NULL);
}

static void check_values(const struct option_row *row) {
    struct line line;
    switch (base_of(row)->kind) {
    case OPTION_FLAG:
        parse_row(&line, row, NULL);
        assert_true(line.good && *(const bool *)field_of(&line, row));
        check_given(&line, row);
        finish(&line);
        break;
    case OPTION_WHOLE:
        check_whole(row);
        break;
    case OPTION_NUMBER:
        check_number(row);
        break;
    case OPTION_WORD:
    case OPTION_CHOICE:
        check_words(row);
        break;
    case OPTION_SYNTAX:
        check_syntax(row);
        break;
    default:
        check_text(row);
        break;
    }
}

static void values_end_at_their_bounds(void **state) {
    (void)state;
    for (int i = 0; i < option_row_count; i++)
        check_values(&option_rows[i]);
}

// An option that has no effect without another, or with it.
static void what_goes_together(void **state) {
    int count = 0;
    (void)state;
    for (int i = 0; i < option_row_count; i++) {
        const struct option_row *row = &option_rows[i];
        struct line line;
        char other[64];
        if (!row->why)
            continue;
        snprintf(other, sizeof other, "--%s", row->excludes ? row->excludes : "quiet");
        parse_row(&line, row, row->words ? row->words[0].word : row->excludes ? other : NULL);
        assert_true(line.good);
        assert_false(cli_judge_options(&line.cli));
        assert_non_null(strstr(line.cli.sink.items[0].message.ptr, row->why));
        finish(&line);
        count++;
    }
    assert_true(count > 0);
}

// ---- where it is shown

static bool has_line(str text, const char *line) {
    const char *at = strstr(text.ptr, line);
    return at && (at == text.ptr || at[-1] == '\n');
}

// The lines of one command in a completion: from `begin` to `end`.
static str part_of(str text, const char *begin, const char *end) {
    const char *at = strstr(text.ptr, begin), *to = at ? strstr(at, end) : NULL;
    assert_true(at && to);
    return (str){at, (size_t)(to - at)};
}

// Whether the text has `word`, and then one of these characters.
static bool holds(str text, const char *word, const char *ends) {
    const size_t n = strlen(word);
    for (size_t i = 0; i + n < text.len; i++)
        if (memcmp(text.ptr + i, word, n) == 0 && strchr(ends, text.ptr[i + n]))
            return true;
    return false;
}

struct shown {
    struct strbuf help, page, bash, zsh, fish;
};

static bool in_help(const struct shown *s, const struct option_row *row) {
    char line[64];
    if (row->letter)
        snprintf(line, sizeof line, "  -%c, --%s", row->letter, row->name);
    else
        snprintf(line, sizeof line, "      --%s", row->name);
    return holds(strbuf_view(&s->help), line, " [");
}

static bool in_page(const struct shown *s, const struct option_row *row) {
    char page[128] = "\\fB\\-\\-";
    size_t length = strlen(page);
    for (const char *p = row->name; *p; p++)
        length += (size_t)snprintf(page + length, sizeof page - length, *p == '-' ? "\\-" : "%c", *p);
    return holds(strbuf_view(&s->page), page, "\\");
}

static void check_shown(const struct shown *s, const char *command, const struct option_row *row,
                        bool is_there) {
    char word[64], begin[128];
    snprintf(word, sizeof word, " --%s", row->name);
    snprintf(begin, sizeof begin, "        %s) words='", command);
    const bool in_bash = holds(part_of(strbuf_view(&s->bash), begin, ";;\n"), word, " '");
    snprintf(begin, sizeof begin, "    %s)\n        _arguments", command);
    const str zsh = part_of(strbuf_view(&s->zsh), begin, ";;\n");
    snprintf(word, sizeof word, "'--%s", row->name);
    bool in_zsh = holds(zsh, word, "[=");
    snprintf(word, sizeof word, "'*--%s", row->name);
    in_zsh |= holds(zsh, word, "[=");
    snprintf(begin, sizeof begin, "complete -c glint -n '__fish_seen_subcommand_from %s' -l %s ", command,
             row->name);
    const bool in_fish = has_line(strbuf_view(&s->fish), begin);
    if (in_help(s, row) != is_there || in_page(s, row) != is_there || in_bash != is_there ||
        in_zsh != is_there || in_fish != is_there)
        fail_msg("--%s of %s: help %d, page %d, bash %d, zsh %d, fish %d", row->name, command,
                 in_help(s, row), in_page(s, row), in_bash, in_zsh, in_fish);
}

// The option's sentence as well.
static void check_sentence(const struct shown *s, const struct option_row *row) {
    assert_non_null(strstr(s->help.data, row->doc));
}

static bool is_of(const char *name, const char *command) {
    bool is = false;
    for (int i = 0; i < option_row_count; i++)
        is |= strcmp(option_rows[i].name, name) == 0 && names_command(&option_rows[i], command);
    return is;
}

static void shown_by_its_commands_and_no_other(void **state) {
    const struct manual manual = {
        .version = "1", .date = "", .purpose = "p", .exits = "e", .commands = commands};
    struct shown s;
    (void)state;
    strbuf_init(&s.bash);
    strbuf_init(&s.zsh);
    strbuf_init(&s.fish);
    manual_bash(&manual, &s.bash);
    manual_zsh(&manual, &s.zsh);
    manual_fish(&manual, &s.fish);
    for (int c = 0; commands[c].name; c++) {
        strbuf_init(&s.help);
        strbuf_init(&s.page);
        cli_option_help(&s.help, &commands[c]);
        manual_page(&manual, &commands[c], &s.page);
        for (int i = 0; i < option_row_count; i++) {
            check_shown(&s, commands[c].name, &option_rows[i], is_of(option_rows[i].name, commands[c].name));
            if (names_command(&option_rows[i], commands[c].name))
                check_sentence(&s, &option_rows[i]);
        }
        strbuf_finish(&s.help);
        strbuf_finish(&s.page);
    }
    strbuf_finish(&s.bash);
    strbuf_finish(&s.zsh);
    strbuf_finish(&s.fish);
}

// An option with two letters more is not there, and this one may be meant.
static void near_misses_are_named(void **state) {
    (void)state;
    for (int i = 0; i < option_row_count; i++) {
        const struct option_row *row = &option_rows[i];
        struct line line;
        char text[64], wanted[80];
        snprintf(text, sizeof text, "--%szq", row->name);
        snprintf(wanted, sizeof wanted, "did you mean '--%s'?", row->name);
        parse(&line, first_command(row), text, NULL);
        assert_false(line.good);
        if (strlen(row->name) > 5)
            assert_string_equal(line.cli.sink.items[0].help.ptr, wanted);
        finish(&line);
    }
}

// ---- the same settings in files

static const struct option_row *option_of(const char *key, const char *command) {
    char name[NAME_BYTES];
    snprintf(name, sizeof name, "%s", strcmp(key, "asset_paths") == 0 ? "asset-path" : key);
    for (char *p = name; *p; p++)
        *p = *p == '_' ? '-' : *p;
    if (strcmp(name, "limits") == 0)
        name[5] = '\0';
    for (const struct option_row *row = NULL; (row = cli_next_option(command_of(command), row)) != NULL;)
        if (strcmp(row->name, name) == 0)
            return row;
    return NULL;
}

static void settings_are_options(void **state) {
    (void)state;
    for (uint32_t i = 0; i < SETTING_KEYS.count; i++)
        if (!option_of(SETTING_KEYS.rows[i].name, "check"))
            fail_msg("'%s' of .glintrc.yaml is no option of check", SETTING_KEYS.rows[i].name);
    int ranges = 0;
    for (uint32_t i = 0; i < TEST_PICTURE_KEYS.count; i++) {
        const struct key_row *key = &TEST_PICTURE_KEYS.rows[i];
        const struct option_row *row = option_of(key->name, "render");
        if (!row || key->greatest <= 0)
            continue;
        assert_true(base_of(row)->most == key->greatest);
        ranges++;
    }
    assert_int_equal(ranges, 2); // size, samples
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_whole),
        cmocka_unit_test(commands_are_there),
        cmocka_unit_test(values_end_at_their_bounds),
        cmocka_unit_test(what_goes_together),
        cmocka_unit_test(shown_by_its_commands_and_no_other),
        cmocka_unit_test(near_misses_are_named),
        cmocka_unit_test(settings_are_options),
    };
    return cmocka_run_group_tests_name("options", tests, make_commands, NULL);
}
