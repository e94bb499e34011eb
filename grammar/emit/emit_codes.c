// The page of all codes.
#include "grammar/emit/emit.h"

#include "diag/diag.h"
#include "diag/diag_text.h"

#include <ctype.h>
#include <string.h>

// Plain text in Markdown: what would be markup or HTML is escaped.
static void plain(struct strbuf *out, const char *text) {
    for (; *text; text++) {
        if (strchr("\\`*[]<&|", *text))
            strbuf_char(out, '\\');
        strbuf_char(out, *text);
    }
}

// The name of the anchor that a heading of the code alone gets.
static void anchor(struct strbuf *out, const char *code) {
    for (; *code; code++)
        strbuf_char(out, (char)tolower((unsigned char)*code));
}

static void put_list(struct strbuf *out) {
    strbuf_cstr(out, "| code | severity | |\n|---|---|---|\n");
    for (diag_code i = diag_next(-1); i < DIAG_CODE_COUNT; i = diag_next(i)) {
        const struct diag_info *info = diag_info(i);
        strbuf_format(out, "| [%s](#", info->code);
        anchor(out, info->code);
        strbuf_format(out, ") | %s | ", diag_severity_name(info->severity));
        plain(out, info->title);
        strbuf_cstr(out, " |\n");
    }
}

static void put_code(struct strbuf *out, diag_code code) {
    const struct diag_info *info = diag_info(code);
    strbuf_format(out, "\n### %s\n\n**%s: ", info->code, diag_severity_name(info->severity));
    plain(out, info->title);
    strbuf_cstr(out, ".** ");
    plain(out, info->meaning);
    strbuf_cstr(out, "\n\n*What to do:* ");
    plain(out, info->remedy);
    strbuf_char(out, '\n');
}

void emit_codes(struct strbuf *out) {
    strbuf_cstr(
        out,
        "# The codes of messages\n\n"
        "<!-- Made from the table of codes by tools/regenerate; do not edit. -->\n\n"
        "Every message of glint ends with a code: its letter is the severity (E an error, W a warning, N a "
        "note),\nits first digit the stage. A code never changes its meaning. `glint explain E206` shows the "
        "same in a\nterminal, and `glint explain --list` lists the codes; [lint.md](lint.md) has examples of "
        "the rules about light.\n\n");
    put_list(out);
    // Codes of a stage are next to each other.
    const char *last = "";
    for (diag_code i = diag_next(-1); i < DIAG_CODE_COUNT; i = diag_next(i)) {
        const char *stage = diag_stage(i);
        if (strcmp(stage, last) != 0)
            strbuf_format(out, "\n## %c%s\n", (char)toupper((unsigned char)stage[0]), stage + 1);
        last = stage;
        put_code(out, i);
    }
}
