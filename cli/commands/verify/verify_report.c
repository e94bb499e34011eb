// What glint verify found, for people and for programs.
#include "cli/commands/verify/verify.h"

#include "core/json_write.h"

#include <inttypes.h>

// ---- what holds

static bool verify_same(const struct verify *v, enum record_field field) {
    // The scene's place does not change the picture; the rest of the command is in the other fields.
    const bool moved = v->cli->operand_count > 1 || cli_option_place(v->cli, "asset-path");
    if (field == RECORD_COMMAND && moved)
        return true;
    return str_equal(v->was.fields[field], v->is.fields[field]);
}

// Another version or device: pixels may differ within the bound.
static bool verify_elsewhere(const struct verify *v) {
    return !verify_same(v, RECORD_SOFTWARE) || !verify_same(v, RECORD_DEVICE);
}

static bool is_same_size(const struct verify *v) {
    return v->pictures[0].width == v->pictures[1].width && v->pictures[0].height == v->pictures[1].height;
}

static bool verify_pixels_hold(const struct verify *v) {
    const struct verify_pixels *p = &v->pixels;
    if (!is_same_size(v))
        return false;
    return p->differ == 0 || (verify_elsewhere(v) && p->share <= VERIFY_SHARE && p->mean <= VERIFY_MEAN);
}

static bool verify_note_same(const struct verify *v) {
    return verify_elsewhere(v) || str_equal(v->was.note, v->is.note);
}

static bool verify_bytes_same(const struct verify *v) {
    return str_equal(v->bytes, strbuf_view(&v->made));
}

bool verify_holds(const struct verify *v) {
    bool holds = verify_pixels_hold(v) && verify_note_same(v);
    for (int field = 0; field < RECORD_FIELDS; field++)
        if (field != RECORD_SOFTWARE && field != RECORD_DEVICE)
            holds = holds && verify_same(v, (enum record_field)field);
    return holds;
}

// ---- text

static void field_text(const struct verify *v, enum record_field field, struct strbuf *out) {
    const str was = v->was.fields[field], is = v->is.fields[field];
    if (was.len == 0 && is.len == 0)
        return;
    strbuf_format(out, "%-11s", record_keywords[field]);
    if (verify_same(v, field))
        strbuf_format(out, "the same: %.*s\n", STR_ARG(was));
    else
        strbuf_format(out, "DIFFERS: %.*s\n%-11snow:     %.*s\n", STR_ARG(was), "", STR_ARG(is));
}

static void pixels_text(const struct verify *v, struct strbuf *out) {
    static const char *const channels[] = {"red", "green", "blue"};
    const struct verify_pixels *p = &v->pixels;
    strbuf_format(out, "%-11s", "Pixels");
    if (!is_same_size(v)) {
        strbuf_format(out, "DIFFER: %u x %u, and now %u x %u\n", v->pictures[0].width, v->pictures[0].height,
                      v->pictures[1].width, v->pictures[1].height);
        return;
    }
    if (p->differ == 0) {
        strbuf_format(out, "the same: all %" PRIu64 "\n", p->count);
        return;
    }
    strbuf_format(out, "DIFFER: %" PRIu64 " of %" PRIu64 ", the worst at %u,%u in %s: %.6g, and now %.6g\n",
                  p->differ, p->count, p->worst.x, p->worst.y, channels[p->worst.channel], p->worst.value,
                  p->worst.reference);
    strbuf_format(out, "%-11s%.3g %% of them by more than 2/255 as displayed, on average %.3g of 255\n", "",
                  100 * p->share, 255 * p->mean);
    if (verify_elsewhere(v))
        strbuf_format(out, "%-11s%s the bound between devices and versions: %g %% of them, %g of 255\n", "",
                      verify_pixels_hold(v) ? "within" : "BEYOND", 100 * VERIFY_SHARE, 255 * VERIFY_MEAN);
}

static size_t first_other_byte(const struct verify *v) {
    const str is = strbuf_view(&v->made);
    size_t at = 0;
    while (at < is.len && at < v->bytes.len && is.ptr[at] == v->bytes.ptr[at])
        at++;
    return at;
}

// For files that differ in bytes although all else is the same.
static void file_text(const struct verify *v, struct strbuf *out) {
    const bool moved = !str_equal(v->was.fields[RECORD_COMMAND], v->is.fields[RECORD_COMMAND]);
    if (verify_elsewhere(v) || moved || v->pixels.differ || !verify_holds(v))
        return;
    strbuf_format(out, "%-11s", "File");
    if (verify_bytes_same(v))
        strbuf_cstr(out, "the same bytes\n");
    else
        strbuf_format(out,
                      "other bytes, the first at %zu, but nothing of them is pixels or record: written by "
                      "another program or library\n",
                      first_other_byte(v));
}

void verify_text(const struct verify *v, struct strbuf *out) {
    for (int field = 0; field < RECORD_FIELDS; field++)
        field_text(v, (enum record_field)field, out);
    if (!verify_note_same(v))
        strbuf_format(out, "%-11sDIFFERS: %.*s\n%-11snow:     %.*s\n", IMAGE_NOTE_KEYWORD,
                      STR_ARG(v->was.note), "", STR_ARG(v->is.note));
    pixels_text(v, out);
    file_text(v, out);
    strbuf_format(out, "%s: %s\n", v->path, verify_holds(v) ? "verified" : "NOT VERIFIED");
}

// ---- JSON

static void field_json(const struct verify *v, enum record_field field, const char *key,
                       struct json_writer *json) {
    json_open_object(json, key);
    json_write_text(json, "recorded", v->was.fields[field]);
    json_write_text(json, "now", v->is.fields[field]);
    json_write_boolean(json, "same", verify_same(v, field));
    json_close_object(json);
}

static void pixels_json(const struct verify *v, struct json_writer *json) {
    const struct verify_pixels *p = &v->pixels;
    json_open_object(json, "pixels");
    json_write_integer(json, "count", p->count);
    json_write_integer(json, "differ", p->differ);
    json_write_boolean(json, "same_size", is_same_size(v));
    if (p->differ && is_same_size(v)) {
        json_open_object(json, "worst");
        json_write_integer(json, "x", p->worst.x);
        json_write_integer(json, "y", p->worst.y);
        json_write_integer(json, "channel", p->worst.channel);
        json_write_real(json, "recorded", p->worst.value);
        json_write_real(json, "now", p->worst.reference);
        json_close_object(json);
    }
    json_write_real(json, "share_over", p->share);
    json_write_real(json, "mean", p->mean);
    if (verify_elsewhere(v)) {
        json_open_object(json, "at_most");
        json_write_real(json, "share_over", VERIFY_SHARE);
        json_write_real(json, "mean", VERIFY_MEAN);
        json_close_object(json);
    }
    json_write_boolean(json, "kept", verify_pixels_hold(v));
    json_close_object(json);
}

void verify_json(const struct verify *v, struct strbuf *out) {
    static const char *const keys[RECORD_FIELDS] = {
        [RECORD_SOFTWARE] = "software", [RECORD_SCENE] = "scene_hash", [RECORD_DEVICE] = "device",
        [RECORD_SETTINGS] = "settings", [RECORD_SCALED] = "scaled",    [RECORD_COMMAND] = "command",
    };
    struct json_writer json;
    json_report_begin(&json, out, 2, "glint verify", 1);
    json_write_text(&json, "picture", str_from(v->path));
    json_write_text(&json, "kind", str_from(v->pictures[0].kind));
    json_write_text(&json, "scene", str_from(v->scene));
    for (int field = 0; field < RECORD_FIELDS; field++)
        field_json(v, (enum record_field)field, keys[field], &json);
    json_write_boolean(&json, "accuracy_same", verify_note_same(v));
    pixels_json(v, &json);
    json_write_boolean(&json, "same_bytes", verify_bytes_same(v));
    json_write_boolean(&json, "verified", verify_holds(v));
    json_report_end(&json);
}
