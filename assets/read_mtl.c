#include "assets/read_mtl.h"

#include "assets/obj_lex.h"
#include "grammar/ir.h"
#include "grammar/schema.h"

#include <math.h>
#include <stdio.h>

enum {
    UNUSED_SHOWN = 12,      // different words that the note lists
    UNUSED_WORD_SHOWN = 32, // characters of each
    ILLUM_REFLECTS_FIRST = 3,
    ILLUM_REFLECTS_LAST = 7,
};

// One `newmtl` as the file has it.
struct mtl_entry {
    bool open; // a newmtl was read
    str name;
    double kd[3], ks[3];
    bool has_kd, has_ks, has_d, has_tr, has_ns, has_ni;
    double d, tr, ns, ni;
    int64_t illum;
};

struct mtl_reader {
    struct asset_file *file;
    struct mtl_materials *out;
    struct obj_lex lex;
    struct mtl_entry entry;
    str unused[UNUSED_SHOWN];
    uint32_t unused_words;
    uint32_t unused_count;
    size_t unused_begin, unused_end; // the first
};

static void note_unused(struct mtl_reader *r, str word) {
    if (r->unused_count++ == 0) {
        r->unused_begin = (size_t)(word.ptr - r->lex.begin);
        r->unused_end = r->unused_begin + word.len;
    }
    for (uint32_t i = 0; i < r->unused_words; i++)
        if (str_equal(r->unused[i], word))
            return;
    if (r->unused_words < UNUSED_SHOWN)
        r->unused[r->unused_words++] = word;
}

static void report_unused(struct mtl_reader *r) {
    if (r->unused_count == 0)
        return;
    // On the stack: reporting may jump out of here when memory runs out.
    char words[UNUSED_SHOWN * (UNUSED_WORD_SHOWN + 2) + 8];
    int length = 0;
    for (uint32_t i = 0; i < r->unused_words; i++) {
        int shown = r->unused[i].len < UNUSED_WORD_SHOWN ? (int)r->unused[i].len : UNUSED_WORD_SHOWN;
        length += snprintf(words + length, sizeof words - (size_t)length, "%s%.*s", i ? ", " : "", shown,
                           r->unused[i].ptr);
    }
    if (r->unused_words == UNUSED_SHOWN)
        snprintf(words + length, sizeof words - (size_t)length, ", ...");
    asset_report(r->file, DIAG_MTL_UNUSED, r->unused_begin, r->unused_end,
                 "%u line%s of the material file %s no effect: %s", r->unused_count,
                 r->unused_count == 1 ? "" : "s", r->unused_count == 1 ? "has" : "have", words);
}

// ---- values

static double clamp_into(struct mtl_reader *r, double value, double least, double greatest, size_t begin) {
    double inside = value < least ? least : value > greatest ? greatest : value;
    if (inside != value)
        asset_report(r->file, DIAG_MTL_RANGE, begin, obj_lex_offset(&r->lex),
                     "%g is outside the range from %g to %g; %g is used", value, least, greatest, inside);
    return inside;
}

static bool read_value(struct mtl_reader *r, str keyword, double least, double greatest, double *value) {
    size_t begin = obj_lex_offset(&r->lex);
    if (!obj_lex_more(&r->lex)) {
        size_t at = (size_t)(keyword.ptr - r->lex.begin);
        asset_report(r->file, DIAG_MTL_SYNTAX, at, at + keyword.len, "'%.*s' needs a number",
                     STR_ARG(keyword));
        return false;
    }
    begin = obj_lex_offset(&r->lex);
    const char *word = r->lex.at;
    double number;
    enum number_status status = obj_lex_number(&r->lex, &number);
    size_t length = (size_t)(r->lex.at - word);
    if (status != NUMBER_OK) {
        asset_report(r->file, DIAG_MTL_SYNTAX, begin, begin + length, "'%.*s' %s",
                     (int)(length < 64 ? length : 64), word, number_problem(status));
        return false;
    }
    *value = clamp_into(r, number, least, greatest, begin);
    return true;
}

static bool read_range(struct mtl_reader *r, str keyword, enum schema_range range, double *value) {
    const struct schema_range_info *info = schema_range_info(range);
    return read_value(r, keyword, info->least, info->greatest, value);
}

// Three numbers, or one for all. The forms "spectral FILE" and "xyz X Y Z" are not used.
static bool read_color(struct mtl_reader *r, str keyword, double out[3]) {
    if (obj_lex_more(&r->lex) && (*r->lex.at == 's' || *r->lex.at == 'x')) {
        note_unused(r, keyword);
        return false;
    }
    double value[3];
    if (!read_range(r, keyword, SCHEMA_RANGE_WEIGHT, &value[0]))
        return false;
    value[1] = value[2] = value[0];
    if (obj_lex_more(&r->lex)) {
        if (!read_range(r, keyword, SCHEMA_RANGE_WEIGHT, &value[1]))
            return false;
        if (!obj_lex_more(&r->lex)) {
            size_t at = (size_t)(keyword.ptr - r->lex.begin);
            asset_report(r->file, DIAG_MTL_SYNTAX, at, obj_lex_offset(&r->lex),
                         "'%.*s' has 2 numbers; it needs 3, or 1 for all three", STR_ARG(keyword));
            return false;
        }
        if (!read_range(r, keyword, SCHEMA_RANGE_WEIGHT, &value[2]))
            return false;
    }
    for (int i = 0; i < 3; i++)
        out[i] = value[i];
    return true;
}

// "d 0.5", "d -halo 0.5": the option makes it depend on the angle, which is not used.
static bool read_dissolve(struct mtl_reader *r, str keyword, double *value) {
    if (obj_lex_more(&r->lex) && *r->lex.at == '-' && r->lex.at + 1 < r->lex.end && r->lex.at[1] == 'h')
        note_unused(r, obj_lex_word(&r->lex));
    return read_range(r, keyword, SCHEMA_RANGE_FRACTION, value);
}

// ---- materials

static void close_entry(struct mtl_reader *r) {
    struct mtl_entry *e = &r->entry;
    if (!e->open || mtl_find(r->out, e->name)) {
        e->open = false;
        return;
    }
    struct arena *arena = r->out->names.arena;
    struct ir_material *m = ARENA_PUSH(arena, r->out);
    schema_init(&SCHEMA_MATERIAL, m);
    m->name = arena_copy(arena, e->name);
    *str_map_at(&r->out->names, m->name) = r->out->count;
    double largest = fmax(e->ks[0], fmax(e->ks[1], e->ks[2]));
    double transparency = e->has_d ? 1 - e->d : e->has_tr ? e->tr : 0;
    bool reflects = e->illum >= ILLUM_REFLECTS_FIRST && e->illum <= ILLUM_REFLECTS_LAST;
    m->albedo =
        (struct ir_weights){1 - transparency, largest > 0 ? 1 : 0, reflects ? largest : 0, transparency};
    if (e->has_kd)
        m->diffuse_color.color = (struct ir_color){.r = e->kd[0], .g = e->kd[1], .b = e->kd[2]};
    if (e->has_ks)
        m->specular_color = (struct ir_color){.r = e->ks[0], .g = e->ks[1], .b = e->ks[2]};
    if (e->has_ns)
        m->specular_exponent = e->ns;
    if (e->has_ni)
        m->refractive_index = e->ni;
    e->open = false;
}

static void read_newmtl(struct mtl_reader *r, str keyword) {
    close_entry(r);
    bool named = obj_lex_more(&r->lex) || (!obj_lex_done(&r->lex) && *r->lex.at == '#');
    r->entry = (struct mtl_entry){.name = named ? obj_lex_rest(&r->lex) : STR("")};
    r->entry.open = r->entry.name.len > 0;
    size_t at = (size_t)(keyword.ptr - r->lex.begin);
    if (!r->entry.open)
        asset_report(r->file, DIAG_MTL_SYNTAX, at, at + keyword.len, "'newmtl' needs a name");
}

// Whether the keyword is one of a material's values; they have no meaning before the first newmtl, where they
// are read and forgotten.
static bool read_attribute(struct mtl_reader *r, str keyword) {
    struct mtl_entry *e = &r->entry;
    double illum;
    if (str_equal_cstr(keyword, "Kd"))
        e->has_kd |= read_color(r, keyword, e->kd);
    else if (str_equal_cstr(keyword, "Ks"))
        e->has_ks |= read_color(r, keyword, e->ks);
    else if (str_equal_cstr(keyword, "Ns"))
        e->has_ns |= read_range(r, keyword, SCHEMA_RANGE_EXPONENT, &e->ns);
    else if (str_equal_cstr(keyword, "Ni"))
        e->has_ni |= read_range(r, keyword, SCHEMA_RANGE_INDEX, &e->ni);
    else if (str_equal_cstr(keyword, "d"))
        e->has_d |= read_dissolve(r, keyword, &e->d);
    else if (str_equal_cstr(keyword, "Tr"))
        e->has_tr |= read_range(r, keyword, SCHEMA_RANGE_FRACTION, &e->tr);
    else if (str_equal_cstr(keyword, "illum"))
        e->illum = read_value(r, keyword, 0, 10, &illum) ? (int64_t)illum : e->illum;
    else
        return false;
    return true;
}

void read_mtl(struct asset_file *file, struct mtl_materials *out) {
    struct mtl_reader r = {.file = file, .out = out};
    obj_lex_init(&r.lex, file->text);
    while (!obj_lex_done(&r.lex)) {
        if (obj_lex_more(&r.lex)) {
            str keyword = obj_lex_word(&r.lex);
            if (str_equal_cstr(keyword, "newmtl"))
                read_newmtl(&r, keyword);
            else if (!read_attribute(&r, keyword))
                note_unused(&r, keyword);
        }
        obj_lex_next_line(&r.lex);
    }
    close_entry(&r);
    report_unused(&r);
}

void mtl_init(struct mtl_materials *materials, struct arena *arena) {
    *materials = (struct mtl_materials){0};
    str_map_init(&materials->names, arena);
}

const struct ir_material *mtl_find(const struct mtl_materials *materials, str name) {
    uint32_t number = str_map_find(&materials->names, name);
    return number ? &materials->items[number - 1] : NULL;
}
