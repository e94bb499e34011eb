// Whether two records are of one picture.
#include "render/record/record.h"

#include <string.h>

static void take_field(str keyword, str text, struct record_read *out) {
    for (int field = 0; field < RECORD_FIELDS; field++)
        if (str_equal_cstr(keyword, record_keywords[field]))
            out->fields[field] = text;
    out->is_there = out->fields[RECORD_SCENE].len && out->fields[RECORD_COMMAND].len;
}

void record_of_texts(const struct image_texts *texts, struct record_read *out) {
    *out = (struct record_read){0};
    for (uint32_t i = 0; i < texts->count; i++)
        take_field(str_from(texts->items[i].keyword), str_from(texts->items[i].text), out);
}

void record_of_line(str line, struct record_read *out) {
    *out = (struct record_read){0};
    for (size_t begin = 0, i = 0; i <= line.len; i++) {
        size_t colon = begin;
        if (i < line.len && line.ptr[i] != '\t')
            continue;
        while (colon < i && line.ptr[colon] != ':')
            colon++;
        if (colon + 2 <= i)
            take_field(str_slice(line, begin, colon), str_slice(line, colon + 2, i), out);
        begin = i + 1;
    }
}

// Compares only what the other fields do not say: the scene's path, its settings and folders are in the hash,
// or change nothing.
static bool same_command(const struct record_command *a, const struct record_command *b) {
    return a->is_reference == b->is_reference && a->as_file == b->as_file && a->noise == b->noise &&
           a->coding.bits == b->coding.bits && a->coding.quality == b->coding.quality &&
           a->coding.compression == b->coding.compression;
}

bool record_same(const struct record_read *a, const struct record_read *b, struct arena *arena) {
    struct record_command commands[2];
    for (int field = 0; field < RECORD_COMMAND; field++)
        if (!str_equal(a->fields[field], b->fields[field]))
            return false;
    return a->is_there && b->is_there &&
           record_read_command(a->fields[RECORD_COMMAND], arena, &commands[0]) &&
           record_read_command(b->fields[RECORD_COMMAND], arena, &commands[1]) &&
           same_command(&commands[0], &commands[1]);
}
