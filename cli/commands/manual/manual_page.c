// Man pages, in the macros of man(7).
#include "cli/commands/manual/manual.h"

#include <ctype.h>
#include <string.h>

enum {
    LINE_BYTES = 64, // of the page's source; tools that check pages want short lines
};

// Escapes text for roff: no character of it is a command.
static void add_letters(struct strbuf *out, str text, bool at_begin) {
    if (at_begin && text.len && (text.ptr[0] == '.' || text.ptr[0] == '\''))
        strbuf_cstr(out, "\\&");
    for (size_t i = 0; i < text.len; i++)
        if (text.ptr[i] == '\\')
            strbuf_cstr(out, "\\e");
        else if (text.ptr[i] == '-')
            strbuf_cstr(out, "\\-");
        else if (text.ptr[i] == '\'')
            strbuf_cstr(out, "\\(aq");
        else
            strbuf_char(out, text.ptr[i]);
}

// Words, broken into lines.
static void add_words(struct strbuf *out, str text) {
    size_t column = 0;
    for (size_t at = 0; at < text.len;) {
        while (at < text.len && isspace((unsigned char)text.ptr[at]))
            at++;
        size_t end = at;
        while (end < text.len && !isspace((unsigned char)text.ptr[end]))
            end++;
        if (end == at)
            break;
        if (column && column + end - at + 1 > LINE_BYTES) {
            strbuf_char(out, '\n');
            column = 0;
        } else if (column) {
            strbuf_char(out, ' ');
        }
        add_letters(out, str_slice(text, at, end), column == 0);
        column += end - at + 1;
        at = end;
    }
    strbuf_char(out, '\n');
}

static str next_line(const char **text) {
    const char *end = strchr(*text, '\n');
    str line = {*text, end ? (size_t)(end - *text) : strlen(*text)};
    *text = end ? end + 1 : *text + line.len;
    return line;
}

static void add_example(struct strbuf *out, const char **text) {
    strbuf_cstr(out, ".PP\n.nf\n");
    while (**text == ' ') {
        str line = next_line(text);
        add_letters(out, line, true);
        strbuf_char(out, '\n');
    }
    strbuf_cstr(out, ".fi\n");
}

static void add_details(struct strbuf *out, const char *text) {
    bool is_first = true;
    while (*text) {
        if (*text == '\n') {
            text++;
            continue;
        }
        if (*text == ' ') {
            add_example(out, &text);
            is_first = false;
            continue;
        }
        const char *begin = text;
        while (*text && *text != '\n' && *text != ' ')
            next_line(&text);
        if (!is_first)
            strbuf_cstr(out, ".PP\n");
        add_words(out, (str){begin, (size_t)(text - begin)});
        is_first = false;
    }
}

static void add_option(struct strbuf *out, const struct option_row *option) {
    strbuf_cstr(out, ".TP\n");
    if (option->letter)
        strbuf_format(out, "\\fB\\-%c\\fR, ", option->letter);
    strbuf_cstr(out, "\\fB\\-\\-");
    add_letters(out, str_from(option->name), false);
    strbuf_cstr(out, "\\fR");
    if (option->argument) {
        strbuf_cstr(out, cli_option_is_optional(option) ? "\\fI" : " \\fI");
        add_letters(out, str_from(option->argument), false);
        strbuf_cstr(out, "\\fR");
    }
    strbuf_char(out, '\n');
    add_words(out, str_from(option->doc));
}

static void add_options(struct strbuf *out, const struct cli_command *command) {
    strbuf_cstr(out, ".SH OPTIONS\n");
    for (const struct option_row *row = NULL; (row = cli_next_option(command, row)) != NULL;)
        add_option(out, row);
}

static void add_synopsis(struct strbuf *out, const char *name, const char *rest) {
    strbuf_cstr(out, ".SH SYNOPSIS\n.B glint");
    if (name)
        strbuf_format(out, " %s", name);
    strbuf_char(out, '\n');
    add_words(out, str_from("[OPTION]..."));
    if (rest[0])
        add_words(out, str_from(rest));
}

// "Exit status: 0 no error; 130 or 143 interrupted." as a list.
static void add_exits(struct strbuf *out, const char *text) {
    strbuf_cstr(out, ".SH EXIT STATUS\n");
    text = strchr(text, ':') ? strchr(text, ':') + 1 : text;
    while (*text) {
        text += strspn(text, " \n");
        const size_t length = strcspn(text, ";");
        size_t head = strspn(text, "0123456789");
        if (strncmp(text + head, " or ", 4) == 0)
            head += 4 + strspn(text + head + 4, "0123456789");
        if (head == 0 || head > length)
            break;
        str rest = str_trim((str){text + head, length - head});
        if (rest.len && rest.ptr[rest.len - 1] == '.')
            rest.len--;
        strbuf_format(out, ".TP\n.B %.*s\n", (int)head, text);
        add_words(out, rest);
        text += length + (text[length] == ';');
    }
}

static void add_program(const struct manual *manual, struct strbuf *out) {
    strbuf_cstr(out, "glint \\- check and render scenes that are described in a text file\n");
    strbuf_cstr(out, ".SH SYNOPSIS\n.B glint\n.I COMMAND\n[OPTION]...\n.SH DESCRIPTION\n");
    add_words(out, str_from(manual->purpose));
    strbuf_cstr(out, ".SH COMMANDS\n");
    for (const struct cli_command *c = manual->commands; c->name; c++) {
        strbuf_format(out, ".TP\n.BR glint\\-%s (1)\n", c->name);
        add_words(out, str_from(c->summary));
    }
    add_options(out, NULL);
    add_exits(out, manual->exits);
    strbuf_cstr(out, ".SH FILES\n.TP\n.I .glintrc.yaml\nsettings of the scenes below its folder\n");
    strbuf_cstr(out, ".SH SEE ALSO\n");
    for (const struct cli_command *c = manual->commands; c->name; c++)
        strbuf_format(out, ".BR glint\\-%s (1)%s\n", c->name, c[1].name ? "," : "");
}

static void add_command(const struct manual *manual, const struct cli_command *command, struct strbuf *out) {
    strbuf_format(out, "glint\\-%s \\-\n", command->name);
    add_words(out, str_from(command->summary));
    add_synopsis(out, command->name, command->operands);
    strbuf_cstr(out, ".SH DESCRIPTION\n");
    if (command->details[0])
        add_details(out, command->details);
    else
        strbuf_format(out, "Takes no argument: %s.\n", command->summary);
    add_options(out, command);
    add_exits(out, manual->exits);
    strbuf_cstr(out, ".SH SEE ALSO\n.BR glint (1)\n");
}

void manual_page(const struct manual *manual, const struct cli_command *command, struct strbuf *out) {
    strbuf_cstr(out, ".\\\" Made by 'glint manual page' from the table of options.\n.TH GLINT");
    for (const char *p = command ? command->name : ""; *p; p++)
        strbuf_format(out, "%s%c", p == command->name ? "\\-" : "", toupper((unsigned char)*p));
    strbuf_format(out, " 1 \"%s\" \"glint %s\" \"glint\"\n.nh\n.ad l\n.SH NAME\n", manual->date,
                  manual->version);
    if (command)
        add_command(manual, command, out);
    else
        add_program(manual, out);
}
