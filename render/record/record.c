#include "render/record/record.h"

#include "core/number.h"
#include "grammar/ir.h"
#include "grammar/schema.h"
#include "render/record/words.h"
#include "scene/content.h"

const char *const record_keywords[RECORD_FIELDS] = {
    [RECORD_SOFTWARE] = "Software", [RECORD_SCENE] = "Scene hash", [RECORD_DEVICE] = "Device",
    [RECORD_SETTINGS] = "Settings", [RECORD_SCALED] = "Scaled",    [RECORD_COMMAND] = "Command",
};

// ---- the command

static void add(struct strbuf *line, const char *option, str value) {
    words_add(line, str_from(option));
    words_add(line, value);
}

static void add_number(struct strbuf *line, const char *option, double value) {
    char text[NUMBER_FORMAT_MAX];
    const size_t length = number_format(value, text);
    add(line, option, (str){text, length});
}

static const char *const compressions[] = {
    [IMAGE_ZIP] = "zip", [IMAGE_PIZ] = "piz", [IMAGE_UNCOMPRESSED] = "none", NULL};

void record_add_coding(struct strbuf *line, enum image_format format, const struct image_coding *c) {
    const struct image_format_info *info = image_format_info(format);
    if (c->bits && info->bits[0] && c->bits != info->bits[0])
        add_number(line, "--depth", c->bits);
    if (info->has_quality && c->quality && c->quality != IMAGE_QUALITY)
        add_number(line, "--quality", c->quality);
    if (info->has_compression && c->compression != IMAGE_ZIP)
        add(line, "--compression", str_from(compressions[c->compression]));
}

static void write_command(const struct record *record, struct strbuf *line) {
    const struct record_command *c = &record->command;
    words_add(line, STR("glint"));
    words_add(line, STR("render"));
    words_add(line, c->scene);
    words_add(line, STR("--size"));
    strbuf_format(line, " %dx%d", (int)c->width, (int)c->height);
    add_number(line, "--samples", c->samples);
    if (c->camera.len)
        add(line, "--camera", c->camera);
    for (uint32_t i = 0; i < c->set_count; i++)
        add(line, "--set", c->sets[i]);
    for (uint32_t i = 0; i < c->asset_path_count; i++)
        add(line, "--asset-path", c->asset_paths[i]);
    if (c->noise > 0)
        add_number(line, "--noise", c->noise);
    if (c->audit)
        words_add(line, STR("--audit"));
    if (c->max_off >= 0)
        add_number(line, "--max-off", c->max_off);
    if (c->is_reference)
        add(line, "--device", STR("reference"));
    if (c->as_file)
        words_add(line, STR("--as-file"));
    record_add_coding(line, record->format, &record->command.coding);
}

// ---- all of it

static void write_settings(const struct record *record, struct strbuf *text) {
    const struct record_command *c = &record->command;
    const struct ir_image *image = record->session->image;
    strbuf_format(text, "%d x %d pixels, %d sample%s", (int)c->width, (int)c->height, (int)c->samples,
                  c->samples == 1 ? "" : "s");
    if (image->error > 0 && !c->is_reference) {
        strbuf_cstr(text, " at most, error ");
        char number[NUMBER_FORMAT_MAX];
        strbuf_add(text, number, number_format(image->error, number));
    }
    if (c->camera.len)
        strbuf_format(text, ", camera %.*s", STR_ARG(c->camera));
    strbuf_format(text, ", %s precision", record->is_double ? "double" : "single");
    if (image->exposure != 0) {
        char number[NUMBER_FORMAT_MAX];
        strbuf_cstr(text, ", exposure ");
        strbuf_add(text, number, number_format(image->exposure, number));
    }
    strbuf_format(text, ", tone %s, transfer %s", schema_words(&SCHEMA_IMAGE, "tone")[image->tone],
                  schema_words(&SCHEMA_IMAGE, "transfer")[image->transfer]);
}

static void write_field(const struct record *record, enum record_field field, struct strbuf *text) {
    char hash[SCENE_CONTENT_TEXT];
    switch (field) {
    case RECORD_SOFTWARE:
        strbuf_format(text, "glint %.*s", STR_ARG(record->version));
        break;
    case RECORD_SCENE:
        scene_content_text(&record->session->resolved, hash);
        strbuf_cstr(text, hash);
        break;
    case RECORD_DEVICE:
        strbuf_str(text, record->device);
        break;
    case RECORD_SETTINGS:
        write_settings(record, text);
        break;
    case RECORD_SCALED:
        if (record->scaled_width)
            strbuf_format(text, "%ux%u", record->scaled_width, record->scaled_height);
        break;
    default:
        write_command(record, text);
        break;
    }
}

struct image_texts record_texts(const struct record *record, struct arena *arena) {
    struct image_text *items = ARENA_ARRAY(arena, struct image_text, RECORD_FIELDS);
    struct image_texts texts = {items, 0};
    struct strbuf text;
    strbuf_init(&text);
    for (int field = 0; field < RECORD_FIELDS; field++) {
        strbuf_clear(&text);
        write_field(record, (enum record_field)field, &text);
        if (text.len && !text.failed)
            items[texts.count++] =
                (struct image_text){record_keywords[field], arena_copy(arena, strbuf_view(&text)).ptr};
    }
    strbuf_finish(&text);
    return texts;
}
