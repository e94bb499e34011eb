// A record that a file carries.
#include "core/number.h"
#include "picture/read/texts.h"
#include "render/record/record.h"
#include "render/record/words.h"

enum {
    TEXTS_MOST = 64,
};

void record_find(str file, struct record_read *out) {
    struct picture_text texts[TEXTS_MOST];
    const uint32_t count = picture_texts(file, texts, TEXTS_MOST);
    *out = (struct record_read){0};
    for (uint32_t i = 0; i < count; i++) {
        if (picture_keyword_is(texts[i].keyword, STR(IMAGE_NOTE_KEYWORD)) && !out->note.ptr)
            out->note = texts[i].text;
        for (int field = 0; field < RECORD_FIELDS; field++)
            if (picture_keyword_is(texts[i].keyword, str_from(record_keywords[field])) &&
                !out->fields[field].ptr)
                out->fields[field] = texts[i].text;
    }
    out->is_there = out->fields[RECORD_SCENE].len && out->fields[RECORD_COMMAND].len;
}

static bool read_unsigned(str text, unsigned *out) {
    int32_t value = 0;
    const bool good = number_parse_whole(text, 1, INT32_MAX, &value);
    *out = (unsigned)value;
    return good;
}

static bool read_real(str text, double *out) {
    return number_parse(text, out) == NUMBER_OK && *out >= 0;
}

static bool read_compression(str text, unsigned *out) {
    *out = str_equal(text, STR("piz")) ? IMAGE_PIZ : IMAGE_UNCOMPRESSED;
    return *out == IMAGE_PIZ || str_equal(text, STR("none"));
}

struct list {
    str *items;
    uint32_t count, capacity;
};

struct reading {
    struct arena *arena;
    struct record_command *command;
    struct list sets, asset_paths;
};

static bool push(struct reading *r, struct list *list, str value) {
    *(str *)ARENA_PUSH(r->arena, list) = value;
    return true;
}

static bool take_value(struct reading *r, str option, str value) {
    struct record_command *c = r->command;
    if (str_equal_cstr(option, "--size"))
        return number_parse_size(value, "x", INT32_MAX, &c->width, &c->height);
    if (str_equal_cstr(option, "--samples"))
        return number_parse_whole(value, 1, INT32_MAX, &c->samples);
    if (str_equal_cstr(option, "--camera"))
        return (c->camera = value).len > 0;
    if (str_equal_cstr(option, "--set"))
        return push(r, &r->sets, value);
    if (str_equal_cstr(option, "--asset-path"))
        return push(r, &r->asset_paths, value);
    if (str_equal_cstr(option, "--noise"))
        return read_real(value, &c->noise);
    if (str_equal_cstr(option, "--max-off"))
        return read_real(value, &c->max_off);
    if (str_equal_cstr(option, "--depth"))
        return read_unsigned(value, &c->coding.bits);
    if (str_equal_cstr(option, "--quality"))
        return read_unsigned(value, &c->coding.quality) && c->coding.quality <= IMAGE_QUALITY_MOST;
    if (str_equal_cstr(option, "--compression"))
        return read_compression(value, &c->coding.compression);
    c->is_reference = str_equal_cstr(option, "--device") && str_equal_cstr(value, "reference");
    return c->is_reference;
}

bool record_read_command(str text, struct arena *arena, struct record_command *out) {
    struct reading r = {.arena = arena, .command = out};
    str glint, render, option, value;
    *out = (struct record_command){.max_off = -1};
    if (!words_take(&text, arena, &glint) || !str_equal_cstr(glint, "glint") ||
        !words_take(&text, arena, &render) || !str_equal_cstr(render, "render") ||
        !words_take(&text, arena, &out->scene) || out->scene.len == 0)
        return false;
    while (text.len) {
        if (!words_take(&text, arena, &option))
            return false;
        if (str_equal_cstr(option, "--audit"))
            out->audit = true;
        else if (str_equal_cstr(option, "--as-file"))
            out->as_file = true;
        else if (!words_take(&text, arena, &value) || !take_value(&r, option, value))
            return false;
    }
    out->sets = r.sets.items;
    out->set_count = r.sets.count;
    out->asset_paths = r.asset_paths.items;
    out->asset_path_count = r.asset_paths.count;
    return out->width > 0 && out->samples > 0;
}
