#include "cli/commands/inspect/inspect.h"

#include "core/json_write.h"
#include "diag/codes/file.h"
#include "files/files.h"
#include "picture/metrics/picture_file.h"
#include "render/record/record.h"

struct inspected {
    const char *path;
    const char *kind;       // "PNG"
    uint32_t width, height; // 0: not known
    bool has_place;         // the format has one for a record
    bool is_understood;     // the record's command is one that glint writes
    struct record_read record;
};

bool inspect_is_picture(const char *path) {
    enum image_format format;
    return image_format_of_path(str_from(path), IMAGE_WRITTEN | IMAGE_COMPARED, &format);
}

// glint writes WebP and does not read it: "RIFF", the size, "WEBP".
static bool is_webp(str bytes) {
    return bytes.len >= 12 && str_starts_with(bytes, STR("RIFF")) &&
           str_equal(str_slice(bytes, 8, 12), STR("WEBP"));
}

static int read_picture(struct cli *cli, struct inspected *p) {
    const struct limits *limits = &cli->options.limits;
    struct picture_file picture = {0};
    struct files files;
    bool unknown;
    str bytes;
    files_init(&files, &cli->arena);
    const enum file_status read =
        files_read_given(&files, str_from(p->path), limits->value[LIMIT_IMAGE_BYTES], &cli->arena, &bytes);
    if (read != FILE_OK) {
        cli_error(cli, session_file_code(read), p->path, NULL, "%s", file_status_text(&files, read));
        return CLI_FILE;
    }
    if (is_webp(bytes)) {
        p->kind = image_format_info(IMAGE_WEBP)->name;
        return CLI_OK;
    }
    const char *fault = picture_file_decode(bytes, limits->value[LIMIT_IMAGE_MEMORY], &picture, &unknown);
    p->kind = picture.kind;
    p->width = picture.width;
    p->height = picture.height;
    p->has_place = !fault && !str_equal_cstr(str_from(picture.kind), image_format_info(IMAGE_PFM)->name);
    picture_file_finish(&picture);
    if (fault) {
        cli_error(cli, unknown ? DIAG_IMAGE_KIND : DIAG_IMAGE_BROKEN, p->path, NULL, "%s", fault);
        return CLI_SCENE;
    }
    struct record_command command;
    record_find(bytes, &p->record);
    p->is_understood =
        p->record.is_there && record_read_command(p->record.fields[RECORD_COMMAND], &cli->arena, &command);
    return CLI_OK;
}

// ---- text

static void line(struct strbuf *out, const char *name, str value) {
    if (value.len == 0)
        return;
    strbuf_format(out, "%-12s", name);
    // A file's text may hold anything: it stays one line, and cannot control the terminal.
    for (size_t i = 0; i < value.len; i++)
        strbuf_char(out, (unsigned char)value.ptr[i] < ' ' || value.ptr[i] == 0x7f ? '?' : value.ptr[i]);
    strbuf_char(out, '\n');
}

static const char *why_none(const struct inspected *p) {
    if (!p->has_place)
        return "none: the format has no place for it";
    if (p->record.fields[RECORD_SOFTWARE].len)
        return "none: the picture names the program above, and does not say how it was made";
    return "none: the picture does not say how it was made; docs/provenance.md says which ones do";
}

static void text_of(const struct inspected *p, struct strbuf *out) {
    static const char *const names[RECORD_FIELDS] = {
        [RECORD_SOFTWARE] = "software", [RECORD_SCENE] = "scene hash", [RECORD_DEVICE] = "device",
        [RECORD_SETTINGS] = "settings", [RECORD_SCALED] = "scaled",    [RECORD_COMMAND] = "command",
    };
    line(out, "picture", str_from(p->path));
    strbuf_format(out, "%-12s%s", "kind", p->kind);
    if (p->width)
        strbuf_format(out, ", %u x %u pixels", p->width, p->height);
    strbuf_char(out, '\n');
    for (int field = 0; field < RECORD_FIELDS; field++)
        line(out, names[field], p->record.fields[field]);
    line(out, "accuracy", p->record.note);
    if (!p->record.is_there)
        line(out, "record", str_from(why_none(p)));
    else if (!p->is_understood)
        line(out, "record", STR("not understood: its command is not one that glint writes"));
}

// ---- JSON

static void field(struct json_writer *json, const char *key, str value) {
    if (value.len)
        json_write_text(json, key, value);
    else
        json_write_null(json, key);
}

static void json_of(const struct inspected *p, struct strbuf *out) {
    static const char *const keys[RECORD_FIELDS] = {
        [RECORD_SOFTWARE] = "software", [RECORD_SCENE] = "scene_hash", [RECORD_DEVICE] = "device",
        [RECORD_SETTINGS] = "settings", [RECORD_SCALED] = "scaled",    [RECORD_COMMAND] = "command",
    };
    struct json_writer json;
    json_report_begin(&json, out, JSON_WRITE_DEPTH_MAX, "glint inspect", 1);
    json_write_text(&json, "picture", str_from(p->path));
    json_write_text(&json, "kind", str_from(p->kind));
    if (p->width) {
        json_write_integer(&json, "width", p->width);
        json_write_integer(&json, "height", p->height);
    }
    json_write_boolean(&json, "recorded", p->record.is_there);
    json_write_boolean(&json, "understood", p->is_understood);
    for (int i = 0; i < RECORD_FIELDS; i++)
        field(&json, keys[i], p->record.fields[i]);
    field(&json, "accuracy", p->record.note);
    json_report_end(&json);
}

int inspect_picture(struct cli *cli) {
    static const char *const formats[] = {"text", "json", NULL};
    struct inspected p = {.path = cli->operands[0]};
    int format;
    if (!cli_format(cli, formats, &format) ||
        cli_has_no_effect(cli, "ir", "this is a picture, and not a scene") ||
        cli_has_no_effect(cli, "set", "this is a picture, and not a scene"))
        return CLI_USAGE;
    int status = read_picture(cli, &p);
    if (status != CLI_OK)
        return status;
    struct strbuf text;
    strbuf_init(&text);
    (format == 1 ? json_of : text_of)(&p, &text);
    status = cli_write_made(cli, "-", &text, "the report");
    strbuf_finish(&text);
    return status;
}
