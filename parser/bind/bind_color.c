// Colours as text: #rrggbb, one number, and what users of other programs write.
#include "diag/codes/binding.h"
#include "parser/bind/bind.h"
#include "parser/bind/say.h"
#include "parser/tree/mend.h"
#include "parser/tree/xml_scan.h"

#include "core/number.h"

#include <ctype.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

// As in "wood.png".
static bool is_file_name(str text) {
    size_t dot = text.len;
    while (dot > 0 && isalpha((unsigned char)text.ptr[dot - 1]))
        dot--;
    return dot > 1 && text.ptr[dot - 1] == '.' && text.len - dot >= 3 && text.len - dot <= 4;
}

// The row by which the element takes a file in place of a colour; NULL: there is none.
static const struct schema_row *row_of_file(struct bind_subject subject) {
    const struct schema_element *schema = subject.frame->schema;
    const bool chosen = subject.frame->via && subject.row && subject.row->choice;
    for (uint32_t i = 0; chosen && i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const int file = row->kind == SCHEMA_ELEMENT ? schema_short_row(row->child) : -1;
        if (row->choice == subject.row->choice && file >= 0 &&
            row->child->rows[file].text == SCHEMA_TEXT_PATH)
            return row;
    }
    return NULL;
}

// A file where a colour is expected: how it is written.
static void help_file(struct bind_context *context, struct bind_subject subject, const struct schema_row *row,
                      tree_index node) {
    const str text = tree_text(context->tree, node);
    const struct schema_row *via = subject.frame->via;
    if (context->tree->is_xml) {
        diag_help(context->sink, "an image is written <%s><%s file=\"%.*s\"/></%s>", via->element,
                  row->element, STR_ARG(text), via->element);
        return;
    }
    const str written = source_text(context->sources, tree_span(context->tree, node));
    const str whole = arena_format(context->scratch, "{%s: %.*s}", row->name, STR_ARG(written));
    diag_help(context->sink, "an image is written %.*s", STR_ARG(whole));
    diag_fix(context->sink, true, tree_span(context->tree, node), whole);
}

bool bind_bad_color(struct bind_context *context, struct bind_subject subject, tree_index node) {
    str text = tree_text(context->tree, node);
    span at = tree_span(context->tree, node);
    diag_add(context->sink, DIAG_BAD_COLOR, at, "%.*s: '%.*s' is not a colour",
             STR_ARG(say_subject(context->scratch, subject)), STR_ARG(say_text(context->scratch, text)));
    const struct schema_row *file = is_file_name(text) ? row_of_file(subject) : NULL;
    if (file) {
        help_file(context, subject, file, node);
        return false;
    }
    bool safe;
    str mended = mend_color(context->scratch, text, &safe);
    if (mended.len == 0) {
        str example = say_subject_example(context->scratch, subject, context->tree->is_xml);
        diag_help(context->sink, "for example %.*s, or six hexadecimal digits as in \"#ff8800\"",
                  STR_ARG(example));
        return false;
    }
    bool has_alpha = text.len == 9 || str_starts_with(text, STR("rgba"));
    diag_help(context->sink, "write \"%.*s\"%s", STR_ARG(mended),
              has_alpha && text.ptr[0] != '\xE2' ? ": colours have no alpha" : "");
    str written = source_text(context->sources, at);
    bool bare = !context->tree->is_xml && written.len && written.ptr[0] != '"' && written.ptr[0] != '\'';
    diag_fix(context->sink, safe, at,
             bare ? arena_format(context->scratch, "\"%.*s\"", STR_ARG(mended))
                  : mend_like(context->scratch, written, mended));
    return false;
}

// Three bytes, as other programs write colours, instead of light: whole numbers, one above what a bright
// light needs.
static bool are_bytes(const double rgb[3]) {
    double largest = 0;
    for (int i = 0; i < 3; i++) {
        if (!(rgb[i] >= 0 && rgb[i] <= 255) || rgb[i] != floor(rgb[i]))
            return false;
        largest = fmax(largest, rgb[i]);
    }
    return largest >= 32;
}

// Text written instead of a list, or of an element without children.
static str hex_like(struct bind_context *context, tree_index node, uint32_t rgb) {
    if (!context->tree->is_xml)
        return arena_format(context->scratch, "\"#%06" PRIx32 "\"", rgb);
    str written = source_text(context->sources, tree_span(context->tree, node));
    if (written.len < 2 || written.ptr[0] != '<' || written.ptr[written.len - 2] != '/')
        return STR("");
    return arena_format(context->scratch, "%.*s " SCHEMA_HEX_ATTRIBUTE "=\"#%06" PRIx32 "\"/>",
                        STR_ARG(str_slice(written, 0, xml_name_end(written, 0))), rgb);
}

void bind_check_bytes(struct bind_context *context, struct bind_subject subject, tree_index node,
                      const double rgb[3]) {
    if (!are_bytes(rgb))
        return;
    uint32_t hex = (uint32_t)rgb[0] << 16 | (uint32_t)rgb[1] << 8 | (uint32_t)rgb[2];
    diag_add(context->sink, DIAG_COLOR_BYTES, tree_span(context->tree, node),
             "%.*s is %.0f %.0f %.0f, which looks like bytes: 1 is white, 255 is 255 times as bright",
             STR_ARG(say_subject(context->scratch, subject)), rgb[0], rgb[1], rgb[2]);
    str mended = hex_like(context, node, hex);
    if (mended.len) {
        diag_help(context->sink, "write %.*s, or divide by 255", STR_ARG(mended));
        diag_fix(context->sink, false, tree_span(context->tree, node), mended);
    } else {
        diag_help(context->sink, "divide by 255");
    }
}

// Whether text that is neither a number nor #rrggbb was meant as a colour.
static bool looks_like_color(str text, enum number_status status, bool is_quoted) {
    uint32_t ignored;
    str bare = mend_quotes(text);
    bool letter = text.len && isalpha((unsigned char)text.ptr[0]);
    bool six_digits =
        text.len == 6 && (status == NUMBER_UNIT || is_quoted) && mend_hex_digits(text, &ignored);
    bool prefix = status == NUMBER_HEX && text.len == 8;
    return six_digits || prefix || (bare.len && bare.ptr[0] == '#') ||
           (letter && status == NUMBER_NOT_A_NUMBER);
}

bool bind_color_text(struct bind_context *context, struct bind_subject subject, tree_index node,
                     struct ir_color *out) {
    str text = tree_text(context->tree, node);
    uint32_t hex;
    if (mend_hex_color(text, &hex)) {
        *out = (struct ir_color){.is_hex = true, .hex = hex};
        return true;
    }
    double value = 0;
    enum number_status status = number_parse(text, &value);
    if (status != NUMBER_OK && bind_formula(context, subject, node)) {
        *out = (struct ir_color){0};
        return true;
    }
    if (looks_like_color(text, status, tree_node(context->tree, node)->style == TREE_QUOTED))
        return bind_bad_color(context, subject, node);
    if (!bind_number(context, subject, node, &value))
        return false;
    *out = (struct ir_color){.r = value, .g = value, .b = value};
    return true;
}
