// A setting as text to paste, and as options.
#include "measure/tradeoff/study/study.h"

#include "core/number.h"

#include <stdio.h>
#include <string.h>

struct assignment {
    const char *element, *attribute;
    char value[48];
};

enum {
    ASSIGNMENTS_MAX = 11
};

static void put(struct assignment *list, uint32_t *count, const char *element, const char *attribute,
                const char *value) {
    struct assignment *a = &list[(*count)++];
    a->element = element;
    a->attribute = attribute;
    snprintf(a->value, sizeof a->value, "%s", value);
}

static void put_real(struct assignment *list, uint32_t *count, const char *element, const char *attribute,
                     double value) {
    char text[NUMBER_FORMAT_MAX];
    number_format(value, text);
    put(list, count, element, attribute, text);
}

static bool is_other(double a, double b) {
    return a < b || a > b;
}

static void put_integer(struct assignment *list, uint32_t *count, const char *element, const char *attribute,
                        uint32_t value) {
    char text[16];
    snprintf(text, sizeof text, "%u", value);
    put(list, count, element, attribute, text);
}

// What differs, image first. Precision is written whenever it differs from what the file's 'auto' resolved
// to.
static uint32_t assignments(const struct setting *s, const struct setting *base,
                            struct assignment list[ASSIGNMENTS_MAX]) {
    uint32_t count = 0;
    const uint32_t without = s->without & ~base->without;
    if (s->width != base->width)
        put_integer(list, &count, "image", "width", s->width);
    if (s->height != base->height)
        put_integer(list, &count, "image", "height", s->height);
    if (s->samples != base->samples)
        put_integer(list, &count, "image", "samples", s->samples);
    if (is_other(s->error, base->error))
        put_real(list, &count, "image", "error", s->error);
    if (s->error > 0 && s->min_samples != base->min_samples)
        put_integer(list, &count, "image", "min_samples", s->min_samples);
    if (s->max_depth != base->max_depth)
        put_integer(list, &count, "trace", "max_depth", s->max_depth);
    if (is_other(s->min_weight, base->min_weight))
        put_real(list, &count, "trace", "min_weight", s->min_weight);
    if (s->is_double != base->is_double)
        put(list, &count, "trace", "precision", s->is_double ? "double" : "single");
    if (s->shadows != base->shadows)
        put(list, &count, "trace", "shadows", s->shadows ? "true" : "false");
    if (without & 1u << KNOB_CLEAR_SHADOWS)
        put(list, &count, "trace", "transparent_shadows", "false");
    if (without & 1u << KNOB_OCCLUSION)
        put(list, &count, "ambient", "occlusion", "0");
    return count;
}

// The attributes of one element, each between `before` and `after`; false: it has none.
static bool write_element(const struct assignment *list, uint32_t count, const char *element, bool xml,
                          struct strbuf *out) {
    bool any = false;
    for (uint32_t i = 0; i < count; i++) {
        if (strcmp(list[i].element, element) != 0)
            continue;
        if (xml)
            strbuf_format(out, " %s=\"%s\"", list[i].attribute, list[i].value);
        else
            strbuf_format(out, "%s%s: %s", any ? ", " : "", list[i].attribute, list[i].value);
        any = true;
    }
    return any;
}

static void write_elements(const struct setting *s, const struct setting *base, struct strbuf *out,
                           bool xml) {
    static const struct {
        const char *yaml, *xml;
    } elements[] = {{"image", "Image"}, {"trace", "Trace"}, {"ambient", "Ambient"}};
    struct assignment list[ASSIGNMENTS_MAX];
    const uint32_t count = assignments(s, base, list);
    for (size_t i = 0; i < sizeof elements / sizeof *elements; i++) {
        struct strbuf attributes;
        strbuf_init(&attributes);
        if (write_element(list, count, elements[i].yaml, xml, &attributes))
            strbuf_format(out, xml ? "<%s%s/>\n" : "%s: {%s}\n", xml ? elements[i].xml : elements[i].yaml,
                          attributes.data);
        out->failed |= attributes.failed;
        strbuf_finish(&attributes);
    }
}

void setting_yaml(const struct setting *setting, const struct setting *base, struct strbuf *out) {
    write_elements(setting, base, out, false);
}

void setting_xml(const struct setting *setting, const struct setting *base, struct strbuf *out) {
    write_elements(setting, base, out, true);
}

void setting_options(const struct setting *setting, const struct setting *base, struct strbuf *out) {
    struct assignment list[ASSIGNMENTS_MAX];
    const uint32_t count = assignments(setting, base, list);
    for (uint32_t i = 0; i < count; i++)
        strbuf_format(out, "%s--set %s.%s=%s", i ? " " : "", list[i].element, list[i].attribute,
                      list[i].value);
}

bool setting_assignment(const struct setting *setting, const struct setting *base, uint32_t index, char *out,
                        size_t capacity) {
    struct assignment list[ASSIGNMENTS_MAX];
    if (index >= assignments(setting, base, list))
        return false;
    snprintf(out, capacity, "%s.%s=%s", list[index].element, list[index].attribute, list[index].value);
    return true;
}
