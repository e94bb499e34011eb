#include "bench/mesh/read_ply.h"

#include "core/heap.h"
#include "core/number.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- the head

static const struct {
    const char *name;
    uint32_t bytes;
    bool is_float;
} types[] = {
    {"char", 1, false},  {"uchar", 1, false},  {"short", 2, false},  {"ushort", 2, false},
    {"int", 4, false},   {"uint", 4, false},   {"float", 4, true},   {"double", 8, true},
    {"int8", 1, false},  {"uint8", 1, false},  {"int16", 2, false},  {"uint16", 2, false},
    {"int32", 4, false}, {"uint32", 4, false}, {"float32", 4, true}, {"float64", 8, true},
};

static bool find_type(str name, uint32_t *bytes, bool *is_float) {
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (str_equal_cstr(name, types[i].name)) {
            *bytes = types[i].bytes;
            *is_float = types[i].is_float;
            return true;
        }
    return false;
}

static str take_word(str *line) {
    size_t begin = 0, end;
    while (begin < line->len && char_is_blank(line->ptr[begin]))
        begin++;
    for (end = begin; end < line->len && !char_is_space(line->ptr[end]);)
        end++;
    const str word = str_slice(*line, begin, end);
    *line = str_slice(*line, end, line->len);
    return word;
}

static bool take_property(struct ply_element *element, str line) {
    struct ply_property p = {0};
    bool unused;
    str type = take_word(&line);
    if (element->property_count == PLY_PROPERTIES_MOST)
        return false;
    if (str_equal_cstr(type, "list")) {
        if (!find_type(take_word(&line), &p.count_bytes, &unused))
            return false;
        type = take_word(&line);
    }
    if (!find_type(type, &p.value_bytes, &p.is_float))
        return false;
    const str name = take_word(&line);
    if (!p.count_bytes && p.is_float && name.len == 1)
        p.axis = name.ptr[0];
    if (p.count_bytes && str_starts_with(name, STR("vertex_ind")))
        p.axis = 'i';
    element->properties[element->property_count++] = p;
    return true;
}

static bool take_element(struct ply *ply, str line, struct ply_element **current) {
    const str name = take_word(&line);
    int64_t count;
    *current = str_equal_cstr(name, "vertex") ? &ply->vertex
               : str_equal_cstr(name, "face") ? &ply->face
                                              : NULL;
    if (!*current || number_parse_integer(take_word(&line), &count) != NUMBER_OK || count < 0 ||
        count > UINT32_MAX)
        return false;
    (*current)->count = (uint32_t)count;
    return true;
}

static const char *read_head(struct ply *ply) {
    struct ply_element *current = NULL;
    bool little = false;
    while (ply->at < ply->size) {
        const char *text = (const char *)ply->bytes + ply->at;
        const char *end = memchr(text, '\n', ply->size - ply->at);
        if (!end)
            break;
        str line = {text, (size_t)(end - text)};
        ply->at += line.len + 1;
        const str word = take_word(&line);
        if (str_equal_cstr(word, "end_header"))
            return little ? NULL : "is not a binary little-endian PLY file";
        if (str_equal_cstr(word, "format"))
            little = str_equal_cstr(take_word(&line), "binary_little_endian");
        else if (str_equal_cstr(word, "element") && !take_element(ply, line, &current))
            return "has an element that is neither vertex nor face";
        else if (str_equal_cstr(word, "property") && (!current || !take_property(current, line)))
            return "has a property of an unknown type";
    }
    return "has no end of its head";
}

// ---- values

static double value_of(const unsigned char *bytes, const struct ply_property *p) {
    if (p->is_float) {
        float single = 0;
        double value = 0;
        memcpy(p->value_bytes == 8 ? (void *)&value : (void *)&single, bytes, p->value_bytes);
        return p->value_bytes == 8 ? value : (double)single;
    }
    uint32_t value = 0;
    for (uint32_t i = 0; i < p->value_bytes; i++)
        value |= (uint32_t)bytes[i] << (8 * i);
    return value;
}

static bool has(const struct ply *ply, size_t bytes) {
    return ply->size - ply->at >= bytes;
}

bool ply_vertex(struct ply *ply, double position[3]) {
    for (uint32_t i = 0; i < ply->vertex.property_count; i++) {
        const struct ply_property *p = &ply->vertex.properties[i];
        if (p->count_bytes || !has(ply, p->value_bytes))
            return false;
        if (p->axis >= 'x' && p->axis <= 'z')
            position[p->axis - 'x'] = value_of(ply->bytes + ply->at, p);
        ply->at += p->value_bytes;
    }
    return true;
}

bool ply_face(struct ply *ply, uint32_t *corners, uint32_t most, uint32_t *count) {
    *count = 0;
    for (uint32_t i = 0; i < ply->face.property_count; i++) {
        const struct ply_property *p = &ply->face.properties[i];
        const struct ply_property length = {.value_bytes = p->count_bytes};
        if (!has(ply, p->count_bytes))
            return false;
        const uint32_t values = p->count_bytes ? (uint32_t)value_of(ply->bytes + ply->at, &length) : 1;
        ply->at += p->count_bytes;
        if (!has(ply, (size_t)values * p->value_bytes) || (p->axis == 'i' && values > most))
            return false;
        for (uint32_t k = 0; k < values && p->axis == 'i'; k++)
            corners[(*count)++] = (uint32_t)value_of(ply->bytes + ply->at + (size_t)k * p->value_bytes, p);
        ply->at += (size_t)values * p->value_bytes;
    }
    return true;
}

// ---- the file

static bool read_all(FILE *file, struct ply *ply) {
    if (fseek(file, 0, SEEK_END) != 0)
        return false;
    const long size = ftell(file);
    if (size <= 0 || fseek(file, 0, SEEK_SET) != 0)
        return false;
    ply->size = (size_t)size;
    ply->bytes = heap_alloc(ply->size);
    return ply->bytes && fread(ply->bytes, 1, ply->size, file) == ply->size;
}

const char *ply_open(struct ply *ply, const char *path) {
    *ply = (struct ply){0};
    FILE *file = fopen(path, "rb");
    if (!file)
        return "cannot be opened";
    const bool good = read_all(file, ply);
    fclose(file);
    if (!good)
        return "cannot be read";
    if (ply->size < 4 || memcmp(ply->bytes, "ply", 3) != 0)
        return "is not a PLY file";
    return read_head(ply);
}

void ply_finish(struct ply *ply) {
    free(ply->bytes);
    *ply = (struct ply){0};
}
