#include "assets/obj/read_mtl.h"

#include "assets/obj/obj_lex.h"
#include "diag/codes/file.h"
#include "grammar/ir.h"
#include "grammar/schema.h"

#include <math.h>
#include <stdio.h>

// Of a file with three digits.
#define ROUNDING 0.001

enum {
    KINDS_MAX = 16,  // of statements without effect, each reported separately; the rest share a last one
    WORD_SHOWN = 64, // bytes of a statement
    ILLUM_MATT = 1,
    ILLUM_USUAL = 2,
    ILLUM_REFLECTS_FIRST = 3,
    ILLUM_REFLECTS_LAST = 7,
    ILLUM_MODES = 11,
};

// The other meanings of the modes of `illum` (Ramey, Rose and Tyerman: MTL material format, 1995).
static const struct illum_mode {
    bool fresnel, transparent;
    const char *never; // why it never has an effect; NULL: it may have one
} illum_modes[ILLUM_MODES] = {
    [0] = {.never = "all surfaces are shaded"},
    [4] = {.transparent = true},
    [5] = {.fresnel = true},
    [6] = {.transparent = true},
    [7] = {.fresnel = true, .transparent = true},
    [9] = {.transparent = true},
    [10] = {.never = "all surfaces are seen"},
};

// One `newmtl` as the file has it.
struct mtl_entry {
    bool open; // a newmtl was read
    str name;
    str statement; // newmtl and name, in the text
    str tr_statement, tf_statement, illum_statement;
    double kd[3], ks[3], ke[3], tf[3];
    bool has_kd, has_ks, has_ke, has_tf, has_d, has_tr, has_ns, has_ni, has_pr;
    double d, tr, ns, ni, pr;
    uint32_t illum;
    str image; // of map_Kd, in the text; empty: none
    uint32_t image_line;
    uint32_t kd_line;
    struct ir_pair repeat, shift; // factor and offset for coordinates
    bool clamps;
};

// Statements that have no effect for the same reason.
struct mtl_dropped {
    str word; // in the text: the first statement
    const char *why;
    bool is_map;
    bool is_shared; // the last one: other statements are counted here
    uint32_t count;
};

struct mtl_reader {
    struct asset_file *file;
    struct mtl_materials *out;
    struct obj_lex lex;
    struct mtl_entry entry;
    struct mtl_dropped dropped[KINDS_MAX];
    uint32_t dropped_kinds;
};

// ---- statements without effect

static const char TF_AT_SURFACES[] = "light takes its colour on its way inside, and not at surfaces";
static const char NOT_TRANSPARENT[] = "'d' and 'Tr' say how much light is let through, and neither lets any";
static const char FRESNEL_NEEDS_INDEX[] = "Fresnel's equations need an 'Ni' above 1";

static void drop(struct mtl_reader *r, str word, const char *why, bool is_map) {
    for (uint32_t i = 0; i < r->dropped_kinds; i++) {
        struct mtl_dropped *kind = &r->dropped[i];
        bool same = kind->why == why && str_equal(kind->word, word);
        if (!same && i + 1 < KINDS_MAX)
            continue;
        kind->count++;
        kind->is_shared = kind->is_shared || !same;
        return;
    }
    r->dropped[r->dropped_kinds++] = (struct mtl_dropped){word, why, is_map, false, 1};
}

// Statements of other programs that have a meaning; NULL as `word`: all others.
static const struct known_statement {
    const char *word;
    const char *why;
} known_statements[] = {
    {"Ka", "ambient light is the scene's, and takes the colour of diffuse light"},
    {"sharpness", "reflections are always sharp"},
    {"Pm", "it is not read; give the model a 'material' with 'metal: true' and a 'reflection_color'"},
    {"Ps", "materials have no sheen"},
    {"Pc", "materials have no clear coat"},
    {"Pcr", "materials have no clear coat"},
    {"aniso", "highlights are round"},
    {"anisor", "highlights are round"},
    {NULL, "glint does not know this statement"},
};

static bool is_map(str keyword) {
    static const char *const maps[] = {"bump", "disp", "decal", "refl", "norm", NULL};
    for (const char *const *map = maps; *map; map++)
        if (str_equal_cstr(keyword, *map))
            return true;
    return str_starts_with(keyword, STR("map_"));
}

// Whether all numbers of the line are 0, so that the statement changes nothing.
static bool is_zero(struct mtl_reader *r) {
    bool all = obj_lex_more(&r->lex);
    while (obj_lex_more(&r->lex)) {
        double value;
        all = obj_lex_number(&r->lex, &value) == NUMBER_OK && value == 0 && all;
    }
    return all;
}

static void drop_statement(struct mtl_reader *r, str keyword) {
    if (is_map(keyword)) {
        drop(r, keyword, "of a material file only map_Kd is used", true);
        return;
    }
    const struct known_statement *known = known_statements;
    while (known->word && !str_equal_cstr(keyword, known->word))
        known++;
    if (!known->word || !is_zero(r))
        drop(r, keyword, known->why, false);
}

static const char *advice_for(const struct mtl_dropped *kind) {
    if (kind->is_map)
        return "write the image's main colour as Kd, or give the model a 'material'";
    if (kind->why == TF_AT_SURFACES)
        return "give the model a 'material' with this colour as 'attenuation_color', and with the thickness "
               "of the body as 'attenuation_distance'";
    if (kind->why == NOT_TRANSPARENT)
        return "write d 0 where all light is let through, and d 1 where none is";
    if (kind->why == FRESNEL_NEEDS_INDEX)
        return "write the index, such as Ni 1.5, or give the model a 'material'";
    return "remove it, or give the model a 'material'";
}

static void report_dropped(struct mtl_reader *r) {
    for (uint32_t i = 0; i < r->dropped_kinds; i++) {
        const struct mtl_dropped *kind = &r->dropped[i];
        size_t at = (size_t)(kind->word.ptr - r->lex.begin);
        int shown = kind->word.len < WORD_SHOWN ? (int)kind->word.len : WORD_SHOWN;
        const char *has = kind->is_shared ? " and others have" : " has";
        char lines[32] = "";
        if (kind->count > 1)
            snprintf(lines, sizeof lines, " (%u lines)", kind->count);
        if (!asset_report(r->file, DIAG_MTL_DROPPED, at, at + kind->word.len, "'%.*s'%s no effect%s: %s",
                          shown, kind->word.ptr, has, lines, kind->why))
            continue;
        diag_help(r->file->input->sink, "%s", advice_for(kind));
    }
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
        obj_lex_word(&r->lex);
        drop(r, (str){keyword.ptr, (size_t)(r->lex.at - keyword.ptr)}, "colours are three numbers", false);
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

// "d 0.5", "d -halo 0.5": the option makes the value depend on the angle, which is not supported.
static bool read_dissolve(struct mtl_reader *r, str keyword, double *value) {
    if (obj_lex_more(&r->lex) && *r->lex.at == '-' && r->lex.at + 1 < r->lex.end && r->lex.at[1] == 'h')
        drop(r, obj_lex_word(&r->lex), "transparency does not depend on the angle", false);
    return read_range(r, keyword, SCHEMA_RANGE_FRACTION, value);
}

// ---- images

// The options of a map: how many words follow at most, and how many of them are numbers only if they look
// like it.
static const struct map_option {
    const char *word;
    uint8_t least, most;
} map_options[] = {
    {"-s", 1, 3},      {"-o", 1, 3},       {"-t", 1, 3},      {"-mm", 2, 2},    {"-bm", 1, 1},
    {"-texres", 1, 1}, {"-blendu", 1, 1},  {"-blendv", 1, 1}, {"-clamp", 1, 1}, {"-cc", 1, 1},
    {"-boost", 1, 1},  {"-imfchan", 1, 1}, {"-type", 1, 1},
};

static uint32_t take_words(struct mtl_reader *r, const struct map_option *option, double number[3],
                           str *word) {
    uint32_t count = 0;
    while (count < option->most && obj_lex_more(&r->lex)) {
        const struct obj_lex before = r->lex;
        const str text = obj_lex_word(&r->lex);
        double value = 0;
        const bool is_number = number_parse(text, &value) == NUMBER_OK;
        if (!is_number && count >= option->least) {
            r->lex = before;
            break;
        }
        number[count++] = value;
        *word = text;
    }
    return count;
}

// -s, -o, -clamp; other options have no effect. false: it is not an option, and the file's name begins.
static bool read_map_option(struct mtl_reader *r) {
    const struct obj_lex before = r->lex;
    const str name = obj_lex_word(&r->lex);
    struct mtl_entry *e = &r->entry;
    for (size_t i = 0; i < sizeof map_options / sizeof *map_options; i++) {
        const struct map_option *option = &map_options[i];
        double number[3] = {0};
        str word = STR("");
        if (!str_equal_cstr(name, option->word))
            continue;
        const uint32_t count = take_words(r, option, number, &word);
        const bool scales = str_equal_cstr(name, "-s"), moves = str_equal_cstr(name, "-o");
        if (scales && number[0] > 0 && (count < 2 || number[1] > 0))
            e->repeat = (struct ir_pair){number[0], count > 1 ? number[1] : 1};
        else if (moves)
            e->shift = (struct ir_pair){number[0], count > 1 ? number[1] : 0};
        else if (str_equal_cstr(name, "-clamp"))
            e->clamps = str_equal_cstr(word, "on");
        else
            drop(r, name, "images have no such option", true);
        return true;
    }
    r->lex = before;
    return false;
}

static void read_image(struct mtl_reader *r, str keyword) {
    struct mtl_entry *e = &r->entry;
    e->repeat = (struct ir_pair){1, 1};
    e->shift = (struct ir_pair){0, 0};
    e->clamps = false;
    while (obj_lex_more(&r->lex) && *r->lex.at == '-')
        if (!read_map_option(r))
            break;
    e->image_line = r->lex.line;
    e->image = obj_lex_more(&r->lex) ? obj_lex_rest(&r->lex) : STR("");
    if (e->image.len == 0) {
        const size_t at = (size_t)(keyword.ptr - r->lex.begin);
        asset_report(r->file, DIAG_MTL_SYNTAX, at, at + keyword.len, "'%.*s' needs the name of a file",
                     STR_ARG(keyword));
    }
}

static double within(enum schema_range range, double value) {
    const struct schema_range_info *info = schema_range_info(range);
    return fmin(fmax(value, info->least), info->greatest);
}

// The file turns u into repeat * u + shift, glint into repeat * (u - offset).
static void take_image(struct mtl_reader *r, struct ir_material *m) {
    const struct mtl_entry *e = &r->entry;
    struct mtl_image *place = ARENA_PUSH(r->out->names.arena, &r->out->images);
    *place = (struct mtl_image){0};
    if (e->image.len == 0)
        return;
    *place = (struct mtl_image){r->file, e->image_line, e->has_kd ? e->kd_line : 0};
    struct ir_texture *image = &m->diffuse_color.image;
    m->diffuse_color.kind = IR_PAINT_IMAGE;
    image->file = arena_copy(r->out->names.arena, e->image);
    image->repeat =
        (struct ir_pair){within(SCHEMA_RANGE_REPEAT, e->repeat.u), within(SCHEMA_RANGE_REPEAT, e->repeat.v)};
    image->offset = (struct ir_pair){within(SCHEMA_RANGE_SHIFT, 0 - e->shift.u / image->repeat.u),
                                     within(SCHEMA_RANGE_SHIFT, 0 - e->shift.v / image->repeat.v)};
    image->wrap = e->clamps ? IR_WRAP_CLAMP : IR_WRAP_REPEAT;
}

// ---- materials

// Applies what only `illum` and `Tf` say.
static void judge_entry(struct mtl_reader *r, struct ir_material *m) {
    const struct mtl_entry *e = &r->entry;
    const struct illum_mode *mode = &illum_modes[e->illum];
    const bool clear = m->albedo.refraction > 0, filters = e->tf[0] != 1 || e->tf[1] != 1 || e->tf[2] != 1;
    if (e->has_tf && filters)
        drop(r, e->tf_statement, clear ? TF_AT_SURFACES : NOT_TRANSPARENT, false);
    m->fresnel = mode->fresnel && e->ni > 1 && (clear || m->albedo.reflection > 0);
    if (mode->never)
        drop(r, e->illum_statement, mode->never, false);
    else if (mode->transparent && e->ni > 1 && !clear && !e->has_d && !e->has_tr)
        drop(r, e->illum_statement, NOT_TRANSPARENT, false);
    else if (mode->fresnel && !m->fresnel && (clear || m->albedo.reflection > 0))
        drop(r, e->illum_statement, FRESNEL_NEEDS_INDEX, false);
    else if (e->illum == ILLUM_MATT && m->albedo.specular > 0)
        drop(r, e->illum_statement, "'Ks' gives a highlight", false);
}

static void close_entry(struct mtl_reader *r) {
    struct mtl_entry *e = &r->entry;
    if (!e->open || mtl_find(r->out, e->name)) {
        if (e->open)
            drop(r, e->statement, "a material of this name comes before it, and counts", false);
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
    if (e->has_d && e->has_tr && fabs(1 - e->d - e->tr) > ROUNDING)
        drop(r, e->tr_statement, "'d' says otherwise, and counts", false);
    bool reflects = e->illum >= ILLUM_REFLECTS_FIRST && e->illum <= ILLUM_REFLECTS_LAST;
    m->albedo =
        (struct ir_weights){1 - transparency, largest > 0 ? 1 : 0, reflects ? largest : 0, transparency};
    if (e->has_kd)
        m->diffuse_color.color = (struct ir_color){.r = e->kd[0], .g = e->kd[1], .b = e->kd[2]};
    if (e->has_ks)
        m->specular_color.color = (struct ir_color){.r = e->ks[0], .g = e->ks[1], .b = e->ks[2]};
    if (e->has_ke)
        m->emission = (struct ir_color){.r = e->ke[0], .g = e->ke[1], .b = e->ke[2]};
    if (e->has_ns)
        m->specular_exponent = e->ns;
    if (e->has_ni)
        m->refractive_index = e->ni;
    if (e->has_pr)
        m->roughness = e->pr;
    judge_entry(r, m);
    take_image(r, m);
    e->open = false;
}

static void read_newmtl(struct mtl_reader *r, str keyword) {
    close_entry(r);
    bool named = obj_lex_more(&r->lex) || (!obj_lex_done(&r->lex) && *r->lex.at == '#');
    r->entry = (struct mtl_entry){.name = named ? obj_lex_rest(&r->lex) : STR(""), .illum = ILLUM_USUAL};
    r->entry.open = r->entry.name.len > 0;
    r->entry.statement = (str){keyword.ptr, (size_t)(r->entry.name.ptr + r->entry.name.len - keyword.ptr)};
    size_t at = (size_t)(keyword.ptr - r->lex.begin);
    if (!r->entry.open)
        asset_report(r->file, DIAG_MTL_SYNTAX, at, at + keyword.len, "'newmtl' needs a name");
}

static void read_transparency(struct mtl_reader *r, str keyword) {
    r->entry.has_tr |= read_range(r, keyword, SCHEMA_RANGE_FRACTION, &r->entry.tr);
    r->entry.tr_statement = keyword;
}

static void read_illum(struct mtl_reader *r, str keyword) {
    double illum;
    if (!read_value(r, keyword, 0, ILLUM_MODES - 1, &illum))
        return;
    r->entry.illum = (uint32_t)illum;
    r->entry.illum_statement = (str){keyword.ptr, (size_t)(r->lex.at - keyword.ptr)};
}

static void read_filter(struct mtl_reader *r, str keyword) {
    r->entry.has_tf |= read_color(r, keyword, r->entry.tf);
    r->entry.tf_statement = keyword;
}

// Whether the keyword is one of a material's values; they have no meaning before the first newmtl, where they
// are read and forgotten.
static bool read_attribute(struct mtl_reader *r, str keyword) {
    struct mtl_entry *e = &r->entry;
    if (str_equal_cstr(keyword, "Kd")) {
        e->kd_line = r->lex.line;
        e->has_kd |= read_color(r, keyword, e->kd);
    } else if (str_equal_cstr(keyword, "map_Kd"))
        read_image(r, keyword);
    else if (str_equal_cstr(keyword, "Ks"))
        e->has_ks |= read_color(r, keyword, e->ks);
    else if (str_equal_cstr(keyword, "Ke"))
        e->has_ke |= read_color(r, keyword, e->ke);
    else if (str_equal_cstr(keyword, "Pr"))
        e->has_pr |= read_range(r, keyword, SCHEMA_RANGE_FRACTION, &e->pr);
    else if (str_equal_cstr(keyword, "Ns"))
        e->has_ns |= read_range(r, keyword, SCHEMA_RANGE_EXPONENT, &e->ns);
    else if (str_equal_cstr(keyword, "Ni"))
        e->has_ni |= read_range(r, keyword, SCHEMA_RANGE_INDEX, &e->ni);
    else if (str_equal_cstr(keyword, "d"))
        e->has_d |= read_dissolve(r, keyword, &e->d);
    else if (str_equal_cstr(keyword, "Tr"))
        read_transparency(r, keyword);
    else if (str_equal_cstr(keyword, "Tf"))
        read_filter(r, keyword);
    else if (str_equal_cstr(keyword, "illum"))
        read_illum(r, keyword);
    else
        return false;
    if (!e->open)
        drop(r, keyword, "it comes before the first 'newmtl'", false);
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
                drop_statement(&r, keyword);
        }
        obj_lex_next_line(&r.lex);
    }
    close_entry(&r);
    report_dropped(&r);
}

void mtl_init(struct mtl_materials *materials, struct arena *arena) {
    *materials = (struct mtl_materials){0};
    str_map_init(&materials->names, arena);
}

const struct ir_material *mtl_find(const struct mtl_materials *materials, str name) {
    uint32_t number = str_map_find(&materials->names, name);
    return number ? &materials->items[number - 1] : NULL;
}
