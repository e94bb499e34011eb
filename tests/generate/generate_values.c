#include "tests/generate/generate_values.h"

#include "core/splitmix.h"
#include "core/strbuf.h"
#include "grammar/ir_value.h"

#include <math.h>
#include <string.h>

uint64_t generate_bits(struct generator *g) {
    return splitmix_next(&g->state);
}

uint32_t generate_below(struct generator *g, uint32_t count) {
    return (uint32_t)((generate_bits(g) >> 32) % count);
}

bool generate_chance(struct generator *g, uint32_t percent) {
    return generate_below(g, 100) < percent;
}

double generate_unit(struct generator *g) {
    return (double)(generate_bits(g) >> 11) * 0x1p-53;
}

double generate_between(struct generator *g, double least, double greatest) {
    return least + (greatest - least) * generate_unit(g);
}

// What a picture can show: values near 1, in whole hundredths.
static double moderate(struct generator *g, enum schema_range range) {
    static const double bounds[SCHEMA_RANGE_COUNT][2] = {
        [SCHEMA_RANGE_VERSION] = {1, 1},     [SCHEMA_RANGE_EXTENT] = {24, 64},
        [SCHEMA_RANGE_SAMPLES] = {1, 4},     [SCHEMA_RANGE_DEPTH] = {1, 6},
        [SCHEMA_RANGE_FRACTION] = {0, 0.05}, [SCHEMA_RANGE_COORDINATE] = {-3, 3},
        [SCHEMA_RANGE_DISTANCE] = {0, 0.5},  [SCHEMA_RANGE_LENGTH] = {0.3, 1.3},
        [SCHEMA_RANGE_SCALE] = {0.4, 1.4},   [SCHEMA_RANGE_WEIGHT] = {0, 1},
        [SCHEMA_RANGE_ANGLE] = {-180, 180},  [SCHEMA_RANGE_FOV] = {40, 75},
        [SCHEMA_RANGE_EXPONENT] = {1, 120},  [SCHEMA_RANGE_INDEX] = {1, 2},
        [SCHEMA_RANGE_PRIORITY] = {-3, 3},   [SCHEMA_RANGE_REPEAT] = {0.5, 4},
        [SCHEMA_RANGE_SHIFT] = {-1, 1},      [SCHEMA_RANGE_SIZE] = {0.2, 2},
        [SCHEMA_RANGE_OPENING] = {1, 20},    [SCHEMA_RANGE_FRAMES] = {20, 100},
        [SCHEMA_RANGE_FRAME] = {0, 20},      [SCHEMA_RANGE_RATE] = {1, 60},
        [SCHEMA_RANGE_TURN] = {90, 360},     [SCHEMA_RANGE_TOLERANCE] = {0.01, 0.1},
        [SCHEMA_RANGE_CORNER] = {0, 3},
    };
    double value = round(generate_between(g, bounds[range][0], bounds[range][1]) * 100) / 100;
    return range == SCHEMA_RANGE_SCALE && generate_chance(g, 20) ? -value : value;
}

static double extreme(struct generator *g, const struct schema_range_info *info) {
    double least = info->least;
    double greatest = info->greatest;
    switch (generate_below(g, 8)) {
    case 0:
        return info->open ? nextafter(least, greatest) : least;
    case 1:
        return greatest;
    case 2:
        return nextafter(least, greatest);
    case 3:
        return nextafter(greatest, least);
    case 4: { // even over the exponents
        double mantissa = 1 + generate_unit(g);
        double value = ldexp(mantissa, (int)generate_below(g, 120) - 60);
        return least < 0 && generate_chance(g, 50) ? -value : value;
    }
    case 5:
        return generate_between(g, least, greatest);
    case 6:
        return round(generate_between(g, -20, 20) * 1000) / 1000;
    default:
        return (double)generate_below(g, 40) - 10;
    }
}

double generate_number(struct generator *g, enum schema_range range) {
    const struct schema_range_info *info = schema_range_info(range);
    if (g->options->renderable)
        return moderate(g, range);
    for (;;) {
        double value = extreme(g, info);
        if (info->magnitude && generate_chance(g, 50))
            value = -value;
        if (schema_in_range(range, value) && !(info->magnitude && value == 0))
            return value == 0 ? 0.0 : value;
    }
}

int32_t generate_integer(struct generator *g, enum schema_range range) {
    const struct schema_range_info *info = schema_range_info(range);
    if (g->options->renderable)
        return (int32_t)moderate(g, range);
    uint32_t span = (uint32_t)(info->greatest - info->least) + 1;
    switch (generate_below(g, 4)) {
    case 0:
        return (int32_t)info->least;
    case 1:
        return (int32_t)info->greatest;
    default:
        return (int32_t)info->least + (int32_t)generate_below(g, span);
    }
}

struct ir_color generate_color(struct generator *g, enum schema_range range) {
    if (generate_chance(g, 25))
        return (struct ir_color){.is_hex = true, .hex = (uint32_t)generate_bits(g) & 0xFFFFFF};
    double r = generate_number(g, range);
    if (generate_chance(g, 25))
        return (struct ir_color){.r = r, .g = r, .b = r};
    double green = generate_number(g, range);
    double blue = generate_number(g, range);
    return (struct ir_color){.r = r, .g = green, .b = blue};
}

// ---- texts

static str pick(struct generator *g, const char *const *from, uint32_t count) {
    return str_from(from[generate_below(g, count)]);
}

#define PICK(g, from) pick(g, from, (uint32_t)(sizeof(from) / sizeof(from)[0]))

str generate_name(struct generator *g) {
    static const char *const names[] = {
        "glass",    "NO",
        "no",       "yes",
        "On",       "off",
        "y",        "n",
        "true",     "False",
        "null",     "Null",
        "e5",       "_",
        "_1",       "-",
        "--",       "-1",
        "x-y",      "inf",
        "nan",      "name",
        "main",     "color",
        "Größe",    "石",
        "Ωμέγα",    "стекло",
        "زجاج",     "ガラス",
        "유리",     "été",
        "İI",       "to",
        "from",     "glint",
        "material", "a-very-long-name_with_many_parts-and_0123456789",
    };
    if (generate_chance(g, 4)) {
        char longest[128];
        memset(longest, 'a' + (int)generate_below(g, 26), sizeof longest);
        return arena_copy(g->arena, (str){longest, sizeof longest});
    }
    str name = PICK(g, names);
    if (generate_chance(g, 40))
        name = arena_format(g->arena, "%.*s-%u", STR_ARG(name), generate_below(g, 1000));
    return str_is_name(name) ? name : arena_format(g->arena, "n%u", generate_below(g, 100000));
}

// Pieces that some reader trips over.
static const char *const pieces[] = {
    "a",    "word", " ",        "  ",     "#",        " #",     ": ",     ":",    "- ",      "--",
    "---",  "...",  "'",        "''",     "\"",       "\\",     "\\n",    "<",    ">",       "&",
    "&lt;", "]]>",  "{",        "}",      "[",        "]",      ",",      "*a",   "&a",      "!t",
    "|",    "%",    "@",        "`",      "?",        "= ",     "<<",     "0",    "1.5",     "0x1",
    "~",    "é",    "石",       "😀",      "\xC2\xA0", "\u2028", "\u200B", "Gold", "<!--",    "-->",
    "true", "null", "\xC2\x85", "\u202E", "\xC2\xAD", "/",      ".",      "$",    "e\u0301",
};

static str compose(struct generator *g, bool lines) {
    static const char *const breaks[] = {"\n", "\n\n", "\n  ", "\t", "\n# ", " \n", "\r\n", "\n- a: b\n"};
    struct strbuf text;
    strbuf_init(&text);
    uint32_t count = 1 + generate_below(g, generate_chance(g, 10) ? 60 : 8);
    for (uint32_t i = 0; i < count; i++)
        strbuf_str(&text, lines && generate_chance(g, 20) ? PICK(g, breaks) : PICK(g, pieces));
    str result = arena_copy(g->arena, strbuf_view(&text));
    strbuf_finish(&text);
    return result;
}

str generate_foreign_name(struct generator *g) {
    return generate_chance(g, 50) ? generate_name(g) : compose(g, false);
}

// Values that every scene has, and that take what generate_moving makes.
str generate_target(struct generator *g) {
    static const char *const targets[] = {"background.rotation", "background.intensity", "ambient.intensity",
                                          "trace.min_weight"};
    return str_from(targets[generate_below(g, sizeof targets / sizeof *targets)]);
}

// One number, or an expression, near the middle of 0 and 1.
str generate_moving(struct generator *g) {
    static const char *const texts[] = {"0.5 + 0.1*sin(360*time)",
                                        "mix(0.4, 0.6, 0.25)",
                                        "max(0.5,0.4)",
                                        "0.5",
                                        "1/2",
                                        "0.4 if frame % 2 == 0 and time < 1 else 0.6",
                                        "0.25 + random(frame)/2",
                                        "hsv(30*frame, 0.5, 0.5).x"};
    if (generate_chance(g, 40))
        return str_from(texts[generate_below(g, sizeof texts / sizeof *texts)]);
    return arena_format(g->arena, "0.4%u5", generate_below(g, 10));
}

str generate_text(struct generator *g) {
    static const char *const texts[] = {
        "",
        " ",
        "\n",
        "A glass ball",
        "2026-11-21",
        "12:30:45",
        "1e3",
        "first line\nsecond line\n",
        "a\nb",
        "  indented\n  text",
        "ends with blanks  ",
        "tab\there",
        "x: y",
        "- item",
        "? key",
        "no",
        "~",
        "0o17",
        "+1",
        "{a: b}",
        "[1, 2]",
        "\"quoted\"",
        "'quoted'",
        "<Scene/>",
        "a & b",
        "trailing:",
        "# no comment",
        "one\n\n\nfour\n",
        "one\n\n",
        "\n\nthree",
        "a\r\nb",
        "%YAML 1.2",
        "@at",
        "`tick`",
        "\\back\\slash",
    };
    return generate_chance(g, 50) ? PICK(g, texts) : compose(g, true);
}
