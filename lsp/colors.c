// Colours in the text, with a swatch in the editor, and as the user picks them there.
//
// Numbers are linear light. They are shown as image.transfer shows them, and a picked colour is written as
// the numbers that look like it. A colour written as #rrggbb stays in that form.
#include "lsp/server_private.h"

#include "core/srgb.h"
#include "grammar/ir.h"
#include "grammar/ir_formula.h"

#include <math.h>
#include <string.h>

struct coloring {
    const struct request *request;
    uint32_t source;
    bool encode; // the picture has the transfer function of sRGB
    json_t *list;
};

static double shown(const struct coloring *coloring, double linear) {
    double inside = fmin(fmax(linear, 0), 1);
    return coloring->encode ? srgb_encode(inside) : inside;
}

static json_t *channels(const struct coloring *coloring, const struct ir_color *color) {
    double rgb[3] = {shown(coloring, color->r), shown(coloring, color->g), shown(coloring, color->b)};
    for (int i = 0; color->is_hex && i < 3; i++)
        rgb[i] = (color->hex >> (16 - 8 * i) & 0xff) / 255.0;
    return json_pack("{s:f, s:f, s:f, s:f}", "red", rgb[0], "green", rgb[1], "blue", rgb[2], "alpha", 1.0);
}

static bool is_transfer_srgb(const struct request *request) {
    return request->session->scene && request->session->scene->image.transfer == IR_TRANSFER_SRGB;
}

static void add_colors(void *context, const struct schema_element *schema, const void *element) {
    struct coloring *coloring = context;
    const struct session *session = coloring->request->session;
    const struct ir_head *head = element;
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const struct ir_row_origin *place = ir_origin_row(&session->origin, head, i);
        if (row->kind != SCHEMA_COLOR || row->many != SCHEMA_ONE || !place ||
            place->value.source != coloring->source || (head->poisoned >> i & 1) ||
            ir_formula_in(session->origin.formulas, head, row))
            continue; // a picked colour would take the place of an expression
        json_t *item = json_object();
        json_object_set_new(item, "range", server_range(coloring->request->server, session, place->value));
        json_object_set_new(item, "color", channels(coloring, schema_field_const(row, element)));
        json_array_append_new(coloring->list, item);
    }
}

json_t *server_colors(const struct request *request) {
    struct session *session = request->session;
    struct coloring coloring = {request, locate_source(session, request->document->path),
                                is_transfer_srgb(request), json_array()};
    if (session->scene && coloring.source != SOURCE_DEFAULT)
        locate_walk(&SCHEMA_SCENE, locate_scene(session), add_colors, &coloring);
    return coloring.list;
}

// ---- what was picked

static double picked(const json_t *color, const char *name, bool decode) {
    double value = fmin(fmax(json_number_value(json_object_get(color, name)), 0), 1);
    return decode ? srgb_decode(value) : value;
}

static void add_presentation(const struct request *request, json_t *list, str text, str label) {
    json_t *item = json_object();
    json_t *edit = json_object();
    json_object_set(edit, "range", json_object_get(request->params, "range"));
    json_object_set_new(edit, "newText", position_string(text));
    json_object_set_new(item, "label", position_string(label));
    json_object_set_new(item, "textEdit", edit);
    json_array_append_new(list, item);
}

// Four decimals can tell 256 steps of light apart.
static str numbers(struct arena *arena, const json_t *color, bool decode, bool is_xml) {
    double rgb[3];
    static const char *const names[] = {"red", "green", "blue"};
    for (int i = 0; i < 3; i++)
        rgb[i] = round(1e4 * picked(color, names[i], decode)) / 1e4;
    return is_xml ? arena_format(arena, "r=\"%g\" g=\"%g\" b=\"%g\"", rgb[0], rgb[1], rgb[2])
                  : arena_format(arena, "[%g, %g, %g]", rgb[0], rgb[1], rgb[2]);
}

static str hex_of(struct arena *arena, const json_t *color) {
    unsigned rgb[3];
    static const char *const names[] = {"red", "green", "blue"};
    for (int i = 0; i < 3; i++)
        rgb[i] = (unsigned)lround(255 * picked(color, names[i], false));
    return arena_format(arena, "#%02x%02x%02x", rgb[0], rgb[1], rgb[2]);
}

static void add_element_texts(const struct request *request, json_t *list, str old, str rgb, str hex) {
    struct arena *arena = request->arena;
    size_t name = 1;
    while (name < old.len && !memchr(" \t\r\n/>", old.ptr[name], 6))
        name++;
    str tag = str_slice(old, 0, name);
    add_presentation(request, list, arena_format(arena, "%.*s %.*s/>", STR_ARG(tag), STR_ARG(rgb)), rgb);
    add_presentation(request, list, arena_format(arena, "%.*s hex=\"%.*s\"/>", STR_ARG(tag), STR_ARG(hex)),
                     hex);
}

// `before`: the byte before it; the value of an attribute is inside its quotes.
static void add_value_texts(const struct request *request, json_t *list, str old, char before, str rgb,
                            str hex) {
    bool is_quoted = old.len && (old.ptr[0] == '"' || old.ptr[0] == '\'');
    bool is_attribute = !is_quoted && (before == '"' || before == '\'');
    bool is_hex = old.len && memchr(old.ptr, '#', old.len);
    str quoted = is_attribute ? hex : arena_format(request->arena, "\"%.*s\"", STR_ARG(hex));
    if (is_hex || is_attribute)
        add_presentation(request, list, quoted, hex);
    if (!is_attribute)
        add_presentation(request, list, rgb, rgb);
    if (!is_hex && !is_attribute)
        add_presentation(request, list, quoted, hex);
}

// The form that the text has comes first: an element of XML, #rrggbb, or a list of numbers.
json_t *server_color_texts(const struct request *request) {
    struct arena *arena = request->arena;
    enum position_encoding encoding = request->server->encoding;
    const json_t *range = json_object_get(request->params, "range");
    const json_t *color = json_object_get(request->params, "color");
    str text = document_text(request->document);
    size_t begin = position_read(text, encoding, json_object_get(range, "start"), NULL);
    size_t end = position_read(text, encoding, json_object_get(range, "end"), NULL);
    str old = begin < end ? str_slice(text, begin, end) : STR("");
    str hex = hex_of(arena, color);
    bool decode = is_transfer_srgb(request);
    json_t *list = json_array();
    if (old.len && old.ptr[0] == '<')
        add_element_texts(request, list, old, numbers(arena, color, decode, true), hex);
    else
        add_value_texts(request, list, old, begin > 0 ? text.ptr[begin - 1] : ' ',
                        numbers(arena, color, decode, false), hex);
    return list;
}
