// Completions for bash, zsh and fish: commands, their options, and the words that an option or operand can
// be. Everything else is completed as files.
#include "cli/commands/manual/manual.h"

#include <stdio.h>
#include <string.h>

static bool is_word_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
}

// The words that "a|b" offers: the next one at *at, empty at the end or where `text` does not begin with such
// words. A word has lower-case letters, digits and signs.
static str manual_next_word(const char *text, size_t *at) {
    const size_t length = strcspn(text, " ");
    const str all = {text, length};
    size_t end = *at;
    // "FILE|..." are not words, and one word alone is a name.
    if (!memchr(text, '|', length) || *at >= length)
        return (str){text, 0};
    while (end < length && is_word_letter(text[end]))
        end++;
    const str word = str_slice(all, *at, end);
    *at = end < length && text[end] == '|' ? end + 1 : length;
    return end == length || text[end] == '|' ? word : (str){text, 0};
}

static void add_words(struct strbuf *out, const char *text) {
    size_t at = 0;
    for (str word = manual_next_word(text, &at); word.len; word = manual_next_word(text, &at)) {
        strbuf_char(out, ' ');
        strbuf_str(out, word);
    }
}

static bool has_words(const char *text) {
    size_t at = 0;
    return text && manual_next_word(text, &at).len;
}

static void add_names(struct strbuf *out, const struct manual *manual) {
    for (const struct cli_command *c = manual->commands; c->name; c++)
        strbuf_format(out, " %s", c->name);
}

// ---- bash

static void add_bash_options(struct strbuf *out, const struct cli_command *command) {
    for (const struct option_row *o = NULL; (o = cli_next_option(command, o)) != NULL;) {
        strbuf_format(out, " --%s", o->name);
        if (cli_option_is_optional(o)) // "[=all]": both ways are complete
            strbuf_format(out, " --%s%.*s", o->name, (int)strcspn(o->argument + 1, "]"), o->argument + 1);
        if (o->letter)
            strbuf_format(out, " -%c", o->letter);
    }
}

static void add_bash_values(struct strbuf *out, const struct cli_command *command) {
    for (const struct option_row *o = NULL; (o = cli_next_option(command, o)) != NULL;) {
        if (!o->argument || cli_option_is_optional(o))
            continue;
        strbuf_format(out, "    %s:--%s", command->name, o->name);
        if (o->letter)
            strbuf_format(out, " | %s:-%c", command->name, o->letter);
        strbuf_cstr(out, ") takes=1");
        if (has_words(o->argument)) {
            strbuf_cstr(out, "; words='");
            add_words(out, o->argument);
            strbuf_char(out, '\'');
        }
        strbuf_cstr(out, " ;;\n");
    }
}

void manual_bash(const struct manual *manual, struct strbuf *out) {
    strbuf_cstr(
        out, "# Completions of glint for bash, made by 'glint manual bash' from the table of options.\n"
             "_glint() {\n"
             "    local current=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} previous= words= takes=\n"
             "    COMPREPLY=()\n"
             "    if [ \"$COMP_CWORD\" -eq 1 ] || { [ \"$command\" = help ] && [ \"$COMP_CWORD\" -eq 2 ]; }; "
             "then\n"
             "        words='help");
    add_names(out, manual);
    add_bash_options(out, NULL);
    strbuf_cstr(out, "'\n"
                     "        COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
                     "        return\n"
                     "    fi\n"
                     "    previous=${COMP_WORDS[COMP_CWORD - 1]}\n"
                     "    case $command:$previous in\n");
    for (const struct cli_command *c = manual->commands; c->name; c++)
        add_bash_values(out, c);
    strbuf_cstr(out, "    esac\n"
                     "    if [ -z \"$takes\" ]; then\n"
                     "        case $command in\n");
    for (const struct cli_command *c = manual->commands; c->name; c++) {
        strbuf_format(out, "        %s) words='", c->name);
        add_bash_options(out, c);
        strbuf_char(out, '\'');
        if (has_words(c->operands)) {
            strbuf_cstr(out, "; [ \"$COMP_CWORD\" -gt 2 ] || words=\"$words");
            add_words(out, c->operands);
            strbuf_char(out, '"');
        }
        strbuf_cstr(out, " ;;\n");
    }
    strbuf_cstr(out, "        esac\n"
                     "    fi\n"
                     "    COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
                     "}\n"
                     "complete -o default -F _glint glint\n");
}

// ---- zsh

// Text in single quotes, inside brackets and between colons.
static void add_zsh_text(struct strbuf *out, const char *text) {
    for (; *text; text++)
        if (*text == '\'')
            strbuf_cstr(out, "'\\''");
        else if (strchr("[]:\\", *text))
            strbuf_format(out, "\\%c", *text);
        else
            strbuf_char(out, *text);
}

static void add_zsh_option(struct strbuf *out, const struct option_row *o) {
    // An option that may be given several times is offered again; "[=X]" takes its value only after '='.
    const bool again = o->argument && strstr(o->argument, "...");
    const char *joint = cli_option_is_optional(o) ? "=-" : o->argument ? "=" : "";
    for (int k = 0; k < (o->letter ? 2 : 1); k++) {
        strbuf_format(out, "        '%s", again ? "*" : "");
        if (k == 0)
            strbuf_format(out, "--%s%s[", o->name, joint);
        else
            strbuf_format(out, "-%c%s[", o->letter, o->argument ? "+" : "");
        add_zsh_text(out, o->doc);
        strbuf_char(out, ']');
        if (cli_option_is_optional(o)) {
            strbuf_format(out, "::value:(%.*s)", (int)strcspn(o->argument + 2, "]"), o->argument + 2);
        } else if (has_words(o->argument)) {
            strbuf_cstr(out, ":value:(");
            add_words(out, o->argument);
            strbuf_char(out, ')');
        } else if (o->argument) {
            strbuf_char(out, ':');
            add_zsh_text(out, o->argument);
            strbuf_cstr(out, ":_files");
        }
        strbuf_cstr(out, "' \\\n");
    }
}

static void add_zsh_command(struct strbuf *out, const struct cli_command *c) {
    strbuf_format(out, "    %s)\n        _arguments \\\n", c->name);
    for (const struct option_row *row = NULL; (row = cli_next_option(c, row)) != NULL;)
        add_zsh_option(out, row);
    if (has_words(c->operands)) {
        strbuf_cstr(out, "        '1:kind:(");
        add_words(out, c->operands);
        strbuf_cstr(out, ")' \\\n");
    }
    strbuf_cstr(out, "        '*:file:_files' ;;\n");
}

void manual_zsh(const struct manual *manual, struct strbuf *out) {
    strbuf_cstr(out, "#compdef glint\n"
                     "# Completions of glint for zsh, made by 'glint manual zsh' from the table of options.\n"
                     "_glint() {\n"
                     "    local -a commands\n"
                     "    commands=(\n");
    for (const struct cli_command *c = manual->commands; c->name; c++) {
        strbuf_format(out, "        '%s:", c->name);
        add_zsh_text(out, c->summary);
        strbuf_cstr(out, "'\n");
    }
    strbuf_cstr(out, "    )\n"
                     "    if ((CURRENT == 2)) || { [[ ${words[2]} == help ]] && ((CURRENT == 3)); }; then\n"
                     "        _describe command commands\n"
                     "        return\n"
                     "    fi\n"
                     "    local command=${words[2]}\n"
                     "    shift words\n"
                     "    ((CURRENT--))\n"
                     "    case $command in\n");
    for (const struct cli_command *c = manual->commands; c->name; c++)
        add_zsh_command(out, c);
    strbuf_cstr(out, "    esac\n"
                     "}\n"
                     "if [[ $funcstack[1] == _glint ]]; then\n"
                     "    _glint \"$@\"\n"
                     "else\n"
                     "    compdef _glint glint\n"
                     "fi\n");
}

// ---- fish

static void add_fish_text(struct strbuf *out, const char *text) {
    strbuf_char(out, '\'');
    for (; *text; text++)
        if (*text == '\'' || *text == '\\')
            strbuf_format(out, "\\%c", *text);
        else
            strbuf_char(out, *text);
    strbuf_char(out, '\'');
}

static void add_fish_option(struct strbuf *out, const char *when, const struct option_row *o) {
    strbuf_format(out, "complete -c glint -n '%s' -l %s", when, o->name);
    if (o->letter)
        strbuf_format(out, " -s %c", o->letter);
    if (has_words(o->argument)) {
        strbuf_cstr(out, " -x -a '");
        add_words(out, o->argument);
        strbuf_char(out, '\'');
    } else if (o->argument && !cli_option_is_optional(o)) {
        strbuf_cstr(out, " -r");
    }
    strbuf_cstr(out, " -d ");
    add_fish_text(out, o->doc);
    strbuf_char(out, '\n');
}

void manual_fish(const struct manual *manual, struct strbuf *out) {
    strbuf_cstr(out,
                "# Completions of glint for fish, made by 'glint manual fish' from the table of options.\n"
                "complete -c glint -n __fish_use_subcommand -f -a help -d 'show help about a command'\n");
    for (const struct option_row *row = NULL; (row = cli_next_option(NULL, row)) != NULL;)
        add_fish_option(out, "__fish_use_subcommand", row);
    for (const struct cli_command *c = manual->commands; c->name; c++) {
        char when[80];
        snprintf(when, sizeof when, "__fish_seen_subcommand_from %s", c->name);
        strbuf_format(out, "complete -c glint -n __fish_use_subcommand -f -a %s -d ", c->name);
        add_fish_text(out, c->summary);
        strbuf_format(out, "\ncomplete -c glint -n '__fish_seen_subcommand_from help' -f -a %s\n", c->name);
        if (has_words(c->operands)) {
            strbuf_format(out, "complete -c glint -n '%s' -a '", when);
            add_words(out, c->operands);
            strbuf_cstr(out, "'\n");
        }
        for (const struct option_row *row = NULL; (row = cli_next_option(c, row)) != NULL;)
            add_fish_option(out, when, row);
    }
}
