#include "parser/bind/say.h"

#include <string.h>

enum {
    TEXT_SHOWN_MAX = 60
};

static const char *blank_if_null(const char *s) {
    return s ? s : "";
}

// "material_map" as words.
static str spoken(struct arena *arena, const char *snake) {
    str copy = arena_copy(arena, str_from(snake));
    char *text = (char *)copy.ptr;
    for (size_t i = 0; i < copy.len; i++)
        if (text[i] == '_')
            text[i] = ' ';
    return copy;
}

str say_article(struct arena *arena, const char *word) {
    const char *article = strchr("aeio", word[0]) ? "an" : "a";
    return arena_format(arena, "%s %.*s", article, STR_ARG(spoken(arena, word)));
}

str say_text(struct arena *arena, str text) {
    size_t shown = text.len;
    if (shown > TEXT_SHOWN_MAX) {
        shown = TEXT_SHOWN_MAX;
        while (shown > 0 && ((unsigned char)text.ptr[shown] & 0xC0) == 0x80)
            shown--;
    }
    str copy =
        arena_format(arena, "%.*s%s", (int)shown, blank_if_null(text.ptr), shown < text.len ? "..." : "");
    char *c = (char *)copy.ptr;
    for (size_t i = 0; i < copy.len; i++)
        if ((unsigned char)c[i] < 0x20 || c[i] == 0x7F)
            c[i] = ' ';
    return copy;
}

// Whether messages name the element by the row that holds it, before its own rows: 'material.albedo' of
// this sphere, 'image.width'. Entries of lists and the scene are named by themselves.
static bool is_part(const struct bind_frame *frame) {
    return frame->parent && frame->via->many == SCHEMA_ONE;
}

static const struct bind_frame *owner_of(const struct bind_frame *frame) {
    while (is_part(frame))
        frame = frame->parent;
    return frame;
}

str say_owner(struct arena *arena, const struct bind_frame *frame) {
    frame = owner_of(frame);
    str word = spoken(arena, frame->schema->name);
    if (frame->name.len)
        return arena_format(arena, "%.*s '%.*s'", STR_ARG(word), STR_ARG(say_text(arena, frame->name)));
    bool many = frame->via && frame->via->many != SCHEMA_ONE;
    return arena_format(arena, "%s %.*s", many ? "this" : "the", STR_ARG(word));
}

static str path_of_frame(struct arena *arena, const struct bind_frame *frame) {
    if (!is_part(frame))
        return STR("");
    str above = path_of_frame(arena, frame->parent);
    return arena_format(arena, "%.*s%s%s", STR_ARG(above), above.len ? "." : "", frame->via->name);
}

// "'radius'": the path from the nearest entry of a list, without its owner; may be empty.
static str say_path(struct arena *arena, struct bind_subject subject) {
    str path = path_of_frame(arena, subject.frame);
    const bool is_item = subject.frame->via && subject.frame->via->many == SCHEMA_SEQUENCE;
    if (subject.row && !(subject.frame->bare && subject.row->short_form && (path.len || is_item))) {
        const char *name = subject.row->many == SCHEMA_ONE ? subject.row->name : schema_yaml_key(subject.row);
        path = arena_format(arena, "%.*s%s%s", STR_ARG(path), path.len ? "." : "", name);
    }
    if (subject.index >= 0)
        path = arena_format(arena, "%.*s[%d]", STR_ARG(path), subject.index);
    if (subject.component)
        path = arena_format(arena, "%.*s.%s", STR_ARG(path), subject.component);
    return path;
}

str say_subject(struct arena *arena, struct bind_subject subject) {
    str path = say_path(arena, subject);
    if (path.len && !owner_of(subject.frame)->parent)
        return arena_format(arena, "'%.*s'", STR_ARG(path));
    str owner = say_owner(arena, subject.frame);
    return path.len ? arena_format(arena, "'%.*s' of %.*s", STR_ARG(path), STR_ARG(owner)) : owner;
}

str say_kind(struct arena *arena, const struct bind_frame *frame) {
    if (!frame->via)
        return arena_format(arena, "the %s", frame->schema->name);
    if (frame->via->kind == SCHEMA_REFERENCE || frame->via->many != SCHEMA_ONE)
        return say_article(arena, frame->schema->name);
    return arena_format(arena, "'%s'", frame->via->name);
}

str say_words(struct arena *arena, const char *const *words) {
    str text = STR("");
    for (uint32_t i = 0; words[i]; i++) {
        const char *between = i == 0 ? "" : words[i + 1] ? ", " : " or ";
        text = arena_format(arena, "%.*s%s'%s'", STR_ARG(text), between, words[i]);
    }
    return text;
}

static str expected_element(struct arena *arena, const struct schema_row *row) {
    str word = row->plural ? arena_format(arena, " of %.*s", STR_ARG(spoken(arena, row->plural))) : STR("");
    if (row->many == SCHEMA_NAMED_MAP)
        return arena_format(arena, "a map%.*s by name", STR_ARG(word));
    if (row->many != SCHEMA_ONE)
        return arena_format(arena, "a list%.*s", STR_ARG(word));
    int bare = schema_short_row(row->child);
    if (bare < 0)
        return STR("a group of attributes");
    str value = say_expected(arena, &row->child->rows[bare]);
    for (uint32_t i = 0; i < row->child->row_count; i++)
        if ((int)i != bare)
            value = arena_format(arena, "%.*s, or a %s", STR_ARG(value), row->child->rows[i].name);
    return value;
}

str say_expected(struct arena *arena, const struct schema_row *row) {
    if (row->many == SCHEMA_FIXED)
        return arena_format(arena, "a list of %u values", row->fixed_count);
    switch (row->kind) {
    case SCHEMA_BOOLEAN:
        return STR("true or false");
    case SCHEMA_INTEGER:
        return STR("one whole number");
    case SCHEMA_NUMBER:
        return STR("one number");
    case SCHEMA_WORD:
        return say_words(arena, row->words);
    case SCHEMA_TEXT:
        return row->text == SCHEMA_TEXT_PATH     ? STR("the path of a file")
               : row->text == SCHEMA_TEXT_FREE   ? STR("some text")
               : row->text == SCHEMA_TEXT_VALUES ? STR("one to four numbers or expressions")
               : row->text == SCHEMA_TEXT_LIST   ? STR("a list of values")
               : row->text == SCHEMA_TEXT_TARGET ? STR("the way to a value")
                                                 : STR("a name");
    case SCHEMA_VECTOR:
        return row->fill ? STR("three numbers x, y, z, or one number for all three")
                         : STR("three numbers x, y, z");
    case SCHEMA_PAIR:
        return row->fill ? STR("two numbers u, v, or one number for both") : STR("two numbers u, v");
    case SCHEMA_POINT:
        return STR("two numbers x, y");
    case SCHEMA_QUAD:
        return STR("four numbers x, y, z, t");
    case SCHEMA_COLOR:
        return STR("a colour (three numbers r, g, b, one number for all three, or #rrggbb)");
    case SCHEMA_WEIGHTS:
        return STR("four weights (diffuse, specular, reflection, refraction)");
    case SCHEMA_REFERENCE: {
        const str one = say_article(arena, row->child->name);
        return arena_format(arena, "the name of %.*s, or %.*s of its own", STR_ARG(one), STR_ARG(one));
    }
    case SCHEMA_ELEMENT:
    case SCHEMA_LIST:
        return expected_element(arena, row);
    }
    return STR("a value");
}

str say_expected_of(struct arena *arena, struct bind_subject subject) {
    if (subject.component)
        return STR("one number");
    struct schema_row row = subject.row ? *subject.row : *subject.frame->via;
    if (subject.index >= 0)
        row.many = SCHEMA_ONE;
    return say_expected(arena, &row);
}

const char *say_unit(const struct schema_row *row) {
    return row->unit == SCHEMA_UNIT_DEGREES ? " degrees" : row->unit == SCHEMA_UNIT_PIXELS ? " pixels" : "";
}

str say_doc(struct arena *arena, const char *doc) {
    str copy = arena_copy(arena, str_from(doc));
    char *text = (char *)copy.ptr;
    bool word = copy.len > 1 && text[0] >= 'A' && text[0] <= 'Z' && !(text[1] >= 'A' && text[1] <= 'Z');
    if (word)
        text[0] = (char)(text[0] - 'A' + 'a');
    if (copy.len && text[copy.len - 1] == '.')
        copy.len--;
    return copy;
}
