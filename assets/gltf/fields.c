#include "assets/gltf/fields.h"
#include "diag/codes/file.h"

#include <stdarg.h>
#include <stdio.h>

enum {
    MESSAGE_MAX = 512,
    SHOWN_MAX = 120
};

const char *gltf_where(const struct gltf *gltf, json_index at) {
    const str path = json_path(&gltf->json, at);
    return path.len <= SHOWN_MAX ? arena_format(gltf->arena, "%.*s", STR_ARG(path)).ptr
                                 : arena_format(gltf->arena, "%.*s...", SHOWN_MAX, path.ptr).ptr;
}

void gltf_add(struct gltf *gltf, diag_code code, json_index at, const char *format, ...) {
    char message[MESSAGE_MAX];
    va_list args;
    gltf->errors += diag_info(code)->severity == DIAG_ERROR;
    gltf->warnings += diag_info(code)->severity == DIAG_WARNING;
    if (!gltf->report)
        return;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    const struct json_node *node = json_at(&gltf->json, at);
    // Of long values only the first character is shown.
    const bool is_long =
        node->kind == JSON_OBJECT || node->kind == JSON_LIST || node->end - node->begin > SHOWN_MAX;
    gltf->report->add(gltf->report->context, code, node->begin, is_long ? node->begin + 1 : node->end,
                      message);
}

void gltf_lose(struct gltf *gltf, enum gltf_loss what, json_index at) {
    if (gltf->losses[what].count++ == 0)
        gltf->losses[what].first = at;
}

static bool is_kind(struct gltf *gltf, json_index value, enum json_kind wanted) {
    const enum json_kind kind = json_kind_of(&gltf->json, value);
    if (kind == wanted)
        return true;
    if (kind != JSON_NONE)
        gltf_add(gltf, DIAG_GLTF_VALUE, value, "'%s' must be %s, not %s", gltf_where(gltf, value),
                 json_kind_words(wanted), json_kind_words(kind));
    return false;
}

static bool take_number(struct gltf *gltf, json_index value, double least, double most, double *out) {
    if (!is_kind(gltf, value, JSON_NUMBER))
        return false;
    const double number = json_number(&gltf->json, value);
    if (number < least)
        gltf_add(gltf, DIAG_GLTF_VALUE, value, "'%s' must be at least %g", gltf_where(gltf, value), least);
    else if (number > most)
        gltf_add(gltf, DIAG_GLTF_VALUE, value, "'%s' must be at most %g", gltf_where(gltf, value), most);
    else
        *out = number;
    return number >= least && number <= most;
}

bool gltf_get_number(struct gltf *gltf, json_index object, const char *key, double least, double most,
                     double *out) {
    return take_number(gltf, json_get(&gltf->json, object, key), least, most, out);
}

bool gltf_get_whole(struct gltf *gltf, json_index object, const char *key, uint64_t most, uint64_t *out) {
    const json_index value = json_get(&gltf->json, object, key);
    double number;
    if (!take_number(gltf, value, 0, (double)most, &number))
        return false;
    if (number != floor(number)) {
        gltf_add(gltf, DIAG_GLTF_VALUE, value, "'%s' must be a whole number", gltf_where(gltf, value));
        return false;
    }
    *out = (uint64_t)number;
    return true;
}

bool gltf_get_bool(struct gltf *gltf, json_index object, const char *key, bool *out) {
    const json_index value = json_get(&gltf->json, object, key);
    const enum json_kind kind = json_kind_of(&gltf->json, value);
    if (kind == JSON_TRUE || kind == JSON_FALSE) {
        *out = kind == JSON_TRUE;
        return true;
    }
    if (kind != JSON_NONE)
        gltf_add(gltf, DIAG_GLTF_VALUE, value, "'%s' must be true or false, not %s", gltf_where(gltf, value),
                 json_kind_words(kind));
    return false;
}

bool gltf_get_text(struct gltf *gltf, json_index object, const char *key, str *out) {
    const json_index value = json_get(&gltf->json, object, key);
    if (!is_kind(gltf, value, JSON_TEXT))
        return false;
    *out = json_text(&gltf->json, value);
    return true;
}

bool gltf_get_numbers(struct gltf *gltf, json_index object, const char *key, double least, double most,
                      uint32_t count, double *out) {
    const json_index list = gltf_get_list(gltf, object, key);
    double numbers[16];
    uint32_t taken = 0;
    if (!list)
        return false;
    if (json_at(&gltf->json, list)->count != count) {
        gltf_add(gltf, DIAG_GLTF_VALUE, list, "'%s' must have %u numbers, not %u", gltf_where(gltf, list),
                 count, json_at(&gltf->json, list)->count);
        return false;
    }
    for (json_index at = json_at(&gltf->json, list)->first; at; at = json_at(&gltf->json, at)->next)
        if (!take_number(gltf, at, least, most, &numbers[taken++]))
            return false;
    for (uint32_t i = 0; i < count; i++)
        out[i] = numbers[i];
    return true;
}

bool gltf_get_index(struct gltf *gltf, json_index object, const char *key, uint32_t count, uint32_t *out) {
    uint64_t index;
    *out = GLTF_NONE;
    if (!gltf_get_whole(gltf, object, key, UINT32_MAX - 1, &index))
        return false;
    if (index >= count) {
        const json_index value = json_get(&gltf->json, object, key);
        gltf_add(gltf, DIAG_GLTF_VALUE, value, "'%s' is %llu, and there %s %u of them, counted from 0",
                 gltf_where(gltf, value), (unsigned long long)index, count == 1 ? "is" : "are", count);
        return false;
    }
    *out = (uint32_t)index;
    return true;
}

json_index gltf_get_object(struct gltf *gltf, json_index object, const char *key) {
    const json_index value = json_get(&gltf->json, object, key);
    return is_kind(gltf, value, JSON_OBJECT) ? value : 0;
}

json_index gltf_get_list(struct gltf *gltf, json_index object, const char *key) {
    const json_index value = json_get(&gltf->json, object, key);
    return is_kind(gltf, value, JSON_LIST) ? value : 0;
}

void gltf_missing(struct gltf *gltf, json_index object, const char *key) {
    gltf_add(gltf, DIAG_GLTF_VALUE, object, "'%s' must have '%s'", gltf_where(gltf, object), key);
}

bool gltf_is_clean(str text) {
    bool is = true;
    for (size_t i = 0; i < text.len; i++) {
        const unsigned char c = (unsigned char)text.ptr[i],
                            next = i + 1 < text.len ? (unsigned char)text.ptr[i + 1] : 0;
        is = is && c >= 0x20 && c != 0x7F && !(c == 0xC2 && next < 0xA0);
    }
    return is;
}

json_index gltf_extension(struct gltf *gltf, json_index object, const char *name) {
    const json_index extensions = json_get(&gltf->json, object, "extensions");
    return extensions ? gltf_get_object(gltf, extensions, name) : 0;
}

str gltf_name(struct gltf *gltf, json_index object) {
    str name = STR("");
    gltf_get_text(gltf, object, "name", &name);
    return name;
}

json_index gltf_next_object(struct gltf *gltf, json_index list, json_index before) {
    json_index at = before ? json_at(&gltf->json, before)->next : json_at(&gltf->json, list)->first;
    while (at && !is_kind(gltf, at, JSON_OBJECT))
        at = json_at(&gltf->json, at)->next;
    return at;
}
