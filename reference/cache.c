#include "reference/cache.h"

#include "core/xxh64.h"
#include "reference/key.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The header of an entry. An entry is read on the machine that wrote it.
struct entry_head {
    char magic[8];
    uint64_t version, head_bytes;
    uint64_t key[2];
    uint64_t body_bytes, body_hash;
    struct reference_statistics statistics;
};

static const char MAGIC[8] = "glintRF";

void reference_source_init(struct reference_source *source, const struct reference_input *input,
                           struct folder_store store) {
    *source = (struct reference_source){.input = *input, .store = store};
}

void reference_source_finish(struct reference_source *source) {
    if (!source)
        return;
    reference_destroy(source->reference);
    source->reference = NULL;
}

const struct reference *reference_source_get(struct reference_source *source) {
    if (!source->reference)
        source->reference = reference_create(&source->input);
    return source->reference;
}

void reference_input_key(const struct reference_input *input, uint64_t key[2]) {
    reference_scene_key(input, key);
}

static void entry_key(struct reference_source *source, const struct reference_settings *settings,
                      enum reference_entry entry, uint64_t key[2]) {
    if (!source->has_key)
        reference_scene_key(&source->input, source->scene_key);
    source->has_key = true;
    reference_call_key(source->scene_key, settings, entry == REFERENCE_ENTRY_HITS, key);
}

static void name_of(const uint64_t key[2], enum reference_entry entry, char name[REFERENCE_NAME_BYTES]) {
    snprintf(name, REFERENCE_NAME_BYTES, "%016" PRIx64 "%016" PRIx64 ".%s", key[0], key[1],
             entry == REFERENCE_ENTRY_HITS ? "hits" : "picture");
}

void reference_source_name(struct reference_source *source, const struct reference_settings *settings,
                           enum reference_entry entry, char name[REFERENCE_NAME_BYTES]) {
    uint64_t key[2];
    entry_key(source, settings, entry, key);
    name_of(key, entry, name);
}

// ---- entries

struct answer {
    uint64_t key[2];
    char name[REFERENCE_NAME_BYTES];
    void *body;
    size_t body_bytes;
    struct reference_statistics statistics;
};

static bool is_whole(const struct answer *a, const char *bytes, size_t count, struct entry_head *head) {
    if (count != sizeof *head + a->body_bytes)
        return false;
    memcpy(head, bytes, sizeof *head);
    return memcmp(head->magic, MAGIC, sizeof MAGIC) == 0 && head->version == REFERENCE_VERSION &&
           head->head_bytes == sizeof *head && memcmp(head->key, a->key, sizeof head->key) == 0 &&
           head->body_bytes == a->body_bytes &&
           head->body_hash == xxh64_of(bytes + sizeof *head, a->body_bytes, 0);
}

static bool find(struct reference_source *source, struct answer *a) {
    struct entry_head head;
    size_t count;
    char *bytes =
        folder_store_read(&source->store, a->name, sizeof(struct entry_head) + a->body_bytes, &count);
    bool found = bytes && is_whole(a, bytes, count, &head);
    if (found) {
        memcpy(a->body, bytes + sizeof head, a->body_bytes);
        a->statistics = head.statistics;
        source->found++;
    }
    free(bytes);
    return found;
}

static void keep(struct reference_source *source, const struct answer *a) {
    struct entry_head head;
    // Padding too: an entry's bytes depend on nothing else.
    memset(&head, 0, sizeof head);
    memcpy(head.magic, MAGIC, sizeof MAGIC);
    head.version = REFERENCE_VERSION;
    head.head_bytes = sizeof head;
    memcpy(head.key, a->key, sizeof head.key);
    head.body_bytes = a->body_bytes;
    head.body_hash = xxh64_of(a->body, a->body_bytes, 0);
    head.statistics = a->statistics;
    const struct folder_store_part parts[2] = {{&head, sizeof head}, {a->body, a->body_bytes}};
    folder_store_write(&source->store, a->name, parts, 2);
}

static struct answer ask(struct reference_source *source, const struct reference_settings *settings,
                         enum reference_entry entry, void *body, size_t pixel_bytes) {
    struct answer a = {.body = body, .body_bytes = (size_t)settings->width * settings->height * pixel_bytes};
    if (source->store.path) {
        entry_key(source, settings, entry, a.key);
        name_of(a.key, entry, a.name);
    }
    return a;
}

// ---- questions

enum reference_result reference_source_render(struct reference_source *source,
                                              const struct reference_settings *settings, double *rgb,
                                              const struct reference_progress *progress,
                                              struct reference_statistics *statistics) {
    struct answer a = ask(source, settings, REFERENCE_ENTRY_PICTURE, rgb, 3 * sizeof *rgb);
    enum reference_result result = REFERENCE_DONE;
    if (!source->store.path || !find(source, &a)) {
        const struct reference *reference = reference_source_get(source);
        result = reference ? reference_render(reference, settings, rgb, progress, &a.statistics)
                           : REFERENCE_NO_MEMORY;
        source->computed++;
        if (result == REFERENCE_DONE && source->store.path)
            keep(source, &a);
    }
    if (statistics)
        *statistics = a.statistics;
    return result;
}

enum reference_result reference_source_hits(struct reference_source *source,
                                            const struct reference_settings *settings, struct hit_pixel *hits,
                                            const struct reference_progress *progress) {
    struct answer a = ask(source, settings, REFERENCE_ENTRY_HITS, hits, sizeof *hits);
    if (source->store.path && find(source, &a))
        return REFERENCE_DONE;
    const struct reference *reference = reference_source_get(source);
    enum reference_result result =
        reference ? reference_hits(reference, settings, hits, progress) : REFERENCE_NO_MEMORY;
    source->computed++;
    if (result == REFERENCE_DONE && source->store.path)
        keep(source, &a);
    return result;
}
