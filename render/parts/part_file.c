#include "render/parts/part_file.h"

#include "core/heap.h"
#include "core/number.h"
#include "core/ranges.h"
#include "core/xxh64.h"
#include "files/stream.h"
#include "grammar/schema.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    READ_BYTES = 1 << 20,                  // at a time
    HEAD_BYTES = 1024 + PART_RECORD_BYTES, // a head is shorter
    SEAL_BYTES = 8,
};

uint32_t part_planes(const struct part *part) {
    const uint32_t samples = part->end_sample - part->first_sample;
    return samples == part->samples ? 1 : samples;
}

static size_t floats_of(const struct part *part) {
    const size_t pixels = heap_times(part->region.width, part->region.height);
    return heap_times(heap_times(pixels, 3), part_planes(part));
}

void part_put_head(const struct part *part, const char *kind, struct strbuf *out) {
    const struct part_region *r = &part->region;
    strbuf_format(out, "glint %s 1\nscene %016" PRIx64 "%016" PRIx64 "\n", kind, part->scene[0],
                  part->scene[1]);
    strbuf_format(out, "settings %016" PRIx64 "%016" PRIx64 "\n", part->settings[0], part->settings[1]);
    strbuf_format(out, "device %s\nsize %u %u\n", part->device, part->width, part->height);
    strbuf_format(out, "region %u %u %u %u\n", r->x, r->y, r->width, r->height);
    strbuf_format(out, "samples %u %u %u\n", part->first_sample, part->end_sample, part->samples);
    strbuf_format(out, "shown %s %s", schema_words(&SCHEMA_IMAGE, "tone")[part->display.tone],
                  schema_words(&SCHEMA_IMAGE, "transfer")[part->display.transfer]);
    if (part->display.exposure != 0) {
        char number[NUMBER_FORMAT_MAX];
        strbuf_cstr(out, " ");
        strbuf_add(out, number, number_format(part->display.exposure, number));
    }
    strbuf_cstr(out, "\n");
    strbuf_format(out, "record %s\n", part->record);
}

static void put_word(uint64_t word, int bytes, unsigned char *out) {
    for (int i = 0; i < bytes; i++)
        out[i] = (unsigned char)(word >> (8 * i));
}

static uint64_t get_word(const unsigned char *bytes, int count) {
    uint64_t word = 0;
    for (int i = 0; i < count; i++)
        word |= (uint64_t)bytes[i] << (8 * i);
    return word;
}

// Where a row of a plane begins in `rgb`.
static size_t row_at(const struct part *part, uint32_t plane, uint32_t y) {
    return ((size_t)plane * part->region.height + y) * part->region.width * 3;
}

void part_encode(const struct part *part, struct strbuf *out) {
    const size_t row = (size_t)part->region.width * 3, begin = out->len;
    part_put_head(part, "part", out);
    strbuf_format(out, "data %zu\n", heap_times(floats_of(part), sizeof *part->rgb));
    for (uint32_t y = 0; y < part->region.height; y++)
        for (uint32_t plane = 0; plane < part_planes(part); plane++)
            for (size_t i = 0; i < row; i++) {
                uint32_t bits;
                unsigned char bytes[sizeof bits];
                memcpy(&bits, &part->rgb[row_at(part, plane, y) + i], sizeof bits);
                put_word(bits, sizeof bits, bytes);
                strbuf_add(out, bytes, sizeof bytes);
            }
    unsigned char seal[SEAL_BYTES];
    if (!out->failed)
        put_word(xxh64_of(out->data + begin, out->len - begin, 0), SEAL_BYTES, seal);
    strbuf_add(out, seal, out->failed ? 0 : sizeof seal);
}

static bool put_sealed(const struct image_sink *sink, struct xxh64 *hash, const void *bytes, size_t count) {
    xxh64_add(hash, bytes, count);
    return sink->put(sink->context, bytes, count);
}

static bool put_rows(const struct image_rows *rows, const struct image_sink *sink, struct xxh64 *hash,
                     float *rgb) {
    const uint32_t most = image_rows_at_once(rows);
    unsigned char *bytes = (unsigned char *)rgb;
    bool good = true;
    for (uint32_t y = 0; y < rows->height && good; y += most) {
        const uint32_t count = rows->height - y < most ? rows->height - y : most;
        const size_t floats = heap_times(heap_times(rows->width, 3), count);
        good = rows->take(rows->context, y, count, rgb);
        for (size_t i = 0; i < floats && good; i++) {
            uint32_t bits;
            memcpy(&bits, bytes + 4 * i, sizeof bits);
            put_word(bits, sizeof bits, bytes + 4 * i);
        }
        good = good && put_sealed(sink, hash, bytes, floats * sizeof *rgb);
    }
    return good;
}

bool part_write_rows(const struct part *part, const struct image_rows *rows, const struct image_sink *sink) {
    struct strbuf head;
    struct xxh64 hash;
    unsigned char seal[SEAL_BYTES];
    float *rgb = heap_array(heap_times(rows->width, image_rows_at_once(rows)), 3 * sizeof *rgb);
    strbuf_init(&head);
    part_put_head(part, "part", &head);
    strbuf_format(&head, "data %zu\n", heap_times(floats_of(part), sizeof *part->rgb));
    xxh64_begin(&hash, 0);
    bool good = rgb && !head.failed && put_sealed(sink, &hash, head.data, head.len) &&
                put_rows(rows, sink, &hash, rgb);
    put_word(xxh64_end(&hash), SEAL_BYTES, seal);
    good = good && sink->put(sink->context, seal, sizeof seal);
    strbuf_finish(&head);
    free(rgb);
    return good;
}

// ---- reading

static bool is_sound(const struct part *part) {
    const struct part_region *r = &part->region;
    return part->width >= 1 && part->height >= 1 && part->width <= RANGE_SIDE_MOST &&
           part->height <= RANGE_SIDE_MOST && r->width >= 1 && r->height >= 1 && r->x < part->width &&
           r->y < part->height && r->width <= part->width - r->x && r->height <= part->height - r->y &&
           part->samples >= 1 && part->samples <= RANGE_SAMPLES_MOST &&
           part->first_sample < part->end_sample && part->end_sample <= part->samples;
}

char *part_take_line(char **text, const char *word) {
    char *line = *text, *end = strchr(line, '\n');
    const size_t length = strlen(word);
    if (!end || strncmp(line, word, length) != 0 || line[length] != ' ')
        return NULL;
    *end = '\0';
    *text = end + 1;
    return line + length + 1;
}

static bool take_key(char **text, const char *word, uint64_t key[2]) {
    const char *line = part_take_line(text, word);
    return line && strlen(line) == 32 && strspn(line, "0123456789abcdef") == 32 &&
           sscanf(line, "%16" SCNx64 "%16" SCNx64, &key[0], &key[1]) == 2;
}

bool part_take_numbers(char **text, const char *word, uint32_t *out, int count) {
    const char *line = part_take_line(text, word);
    for (int i = 0; line && i < count; i++) {
        char *end;
        // strtoul takes signs and any space.
        if ((i && *line++ != ' ') || *line < '0' || *line > '9')
            return false;
        const unsigned long value = strtoul(line, &end, 10);
        if (value > INT32_MAX)
            return false;
        out[i] = (uint32_t)value;
        line = end;
    }
    return line && *line == '\0';
}

static bool take_display(char **text, struct image_display *display) {
    char *tone = part_take_line(text, "shown"), *space = tone ? strchr(tone, ' ') : NULL;
    if (!space)
        return false;
    *space = '\0';
    char *transfer = space + 1, *exposure = strchr(transfer, ' ');
    double stops = 0;
    if (exposure && !number_parse_real(str_from(exposure + 1), -100, 100, &stops))
        return false;
    if (exposure)
        *exposure = '\0';
    const int a = schema_word(schema_words(&SCHEMA_IMAGE, "tone"), str_from(tone));
    const int b = schema_word(schema_words(&SCHEMA_IMAGE, "transfer"), str_from(transfer));
    *display = (struct image_display){(unsigned)a, (unsigned)b, stops};
    return a >= 0 && b >= 0;
}

bool part_take_head(char **text, const char *kind, struct part *part) {
    const char *version = part_take_line(text, "glint");
    const size_t length = strlen(kind);
    uint32_t size[2], region[4], samples[3];
    if (!version || strncmp(version, kind, length) != 0 || strcmp(version + length, " 1") != 0 ||
        !take_key(text, "scene", part->scene) || !take_key(text, "settings", part->settings))
        return false;
    const char *device = part_take_line(text, "device");
    if (!device || !part_take_numbers(text, "size", size, 2) ||
        !part_take_numbers(text, "region", region, 4) || !part_take_numbers(text, "samples", samples, 3) ||
        !take_display(text, &part->display))
        return false;
    snprintf(part->device, sizeof part->device, "%s", device);
    part->width = size[0];
    part->height = size[1];
    part->region = (struct part_region){region[0], region[1], region[2], region[3]};
    part->first_sample = samples[0];
    part->end_sample = samples[1];
    part->samples = samples[2];
    const char *record = part_take_line(text, "record");
    snprintf(part->record, sizeof part->record, "%s", record ? record : "");
    return record && is_sound(part);
}

// Returns how long the head is; 0: it is not that of a part.
static size_t read_head(char *text, struct part *part) {
    char *at = text;
    const char *data = part_take_head(&at, "part", part) ? part_take_line(&at, "data") : NULL;
    char bytes[32];
    snprintf(bytes, sizeof bytes, "%zu", heap_times(floats_of(part), sizeof *part->rgb));
    const bool good = data && strcmp(data, bytes) == 0;
    return good ? (size_t)(at - text) : 0;
}

static bool is_whole(const struct strbuf *file, size_t head, const struct part *part) {
    const size_t bytes = heap_times(floats_of(part), sizeof *part->rgb);
    if (file->len < head + SEAL_BYTES || file->len - head - SEAL_BYTES != bytes)
        return false;
    const size_t sealed = file->len - SEAL_BYTES;
    return get_word((const unsigned char *)file->data + sealed, SEAL_BYTES) ==
           xxh64_of(file->data, sealed, 0);
}

static bool take_floats(const struct strbuf *file, size_t head, struct part *part) {
    const unsigned char *at = (const unsigned char *)file->data + head;
    const size_t row = (size_t)part->region.width * 3;
    part->rgb = heap_array(floats_of(part), sizeof *part->rgb);
    if (!part->rgb)
        return false;
    for (uint32_t y = 0; y < part->region.height; y++)
        for (uint32_t plane = 0; plane < part_planes(part); plane++)
            for (size_t i = 0; i < row; i++, at += sizeof(uint32_t)) {
                const uint32_t bits = (uint32_t)get_word(at, sizeof bits);
                memcpy(&part->rgb[row_at(part, plane, y) + i], &bits, sizeof bits);
            }
    return true;
}

static bool say_damaged(struct strbuf *error) {
    strbuf_cstr(error, "is damaged: its bytes are not those that were written; render it again");
    return false;
}

static bool read_part(const char *path, bool head_only, struct strbuf *file, struct part *part,
                      struct strbuf *error) {
    char text[HEAD_BYTES + 1] = "";
    const int error_number = stream_read_file(path, head_only ? HEAD_BYTES : SIZE_MAX, file);
    const int fault = error_number ? error_number : file->failed ? ENOMEM : 0;
    if (fault) {
        strbuf_format(error, "cannot be read: %s", strerror(fault));
        return false;
    }
    memcpy(text, file->data ? file->data : "", file->len < HEAD_BYTES ? file->len : HEAD_BYTES);
    const size_t head = read_head(text, part);
    if (head == 0) {
        strbuf_format(error, "is not a part of a picture that 'glint render -o NAME%s' has written",
                      PART_ENDING);
        return false;
    }
    part->head_bytes = head;
    if (!head_only && !is_whole(file, head, part))
        return say_damaged(error);
    if (!head_only && !take_floats(file, head, part)) {
        strbuf_cstr(error, "needs more memory than there is");
        return false;
    }
    return true;
}

bool part_read(const char *path, bool head_only, struct part *part, struct strbuf *error) {
    struct strbuf file;
    *part = (struct part){0};
    strbuf_init(&file);
    const bool good = read_part(path, head_only, &file, part, error);
    strbuf_finish(&file);
    return good;
}

void part_finish(struct part *part) {
    free(part->rgb);
    part->rgb = NULL;
}

// ---- some rows at a time

static bool check_seal(struct spool *file, const struct part *part, char *buffer) {
    uint64_t left = (uint64_t)part->head_bytes + heap_times(floats_of(part), sizeof *part->rgb), at = 0;
    unsigned char seal[SEAL_BYTES], after;
    struct xxh64 hash;
    xxh64_begin(&hash, 0);
    while (left) {
        const size_t count = left < READ_BYTES ? (size_t)left : READ_BYTES;
        if (!spool_take(file, at, buffer, count))
            return false;
        xxh64_add(&hash, buffer, count);
        at += count;
        left -= count;
    }
    return spool_take(file, at, seal, sizeof seal) && get_word(seal, SEAL_BYTES) == xxh64_end(&hash) &&
           !spool_take(file, at + sizeof seal, &after, 1);
}

bool part_check(const char *path, const struct part *part, struct strbuf *error) {
    struct spool file;
    char *buffer = heap_alloc(READ_BYTES);
    bool whole = false;
    if (!buffer)
        return false;
    if (!spool_read(&file, path)) {
        strbuf_format(error, "cannot be read: %s", strerror(file.error));
    } else {
        whole = check_seal(&file, part, buffer);
        if (file.error)
            strbuf_format(error, "cannot be read: %s", strerror(file.error));
        else if (!whole)
            say_damaged(error);
        spool_close(&file);
    }
    free(buffer);
    return whole;
}

bool part_take_rows(struct spool *file, const struct part *part, uint32_t y, uint32_t count, float *rgb) {
    const size_t row = heap_times(part->region.width, 3), floats = heap_times(row, count);
    unsigned char *bytes = (unsigned char *)rgb;
    if (!spool_take(file, part->head_bytes + (uint64_t)y * row * sizeof *rgb, rgb, floats * sizeof *rgb))
        return false;
    for (size_t i = 0; i < floats; i++) {
        const uint32_t bits = (uint32_t)get_word(bytes + 4 * i, sizeof bits);
        memcpy(bytes + 4 * i, &bits, sizeof bits);
    }
    return true;
}
