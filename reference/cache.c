#include "reference/cache.h"

#include "reference/key.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct folder_seal seal_of(const uint64_t key[2]) {
    return (struct folder_seal){.magic = "glintRF", .version = REFERENCE_VERSION, .key = {key[0], key[1]}};
}

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

// An entry holds the statistics, then the pixels or hits.
static bool find(struct reference_source *source, struct answer *a) {
    const struct folder_seal seal = seal_of(a->key);
    const size_t before = sizeof a->statistics;
    size_t count;
    char *bytes = folder_store_open(&source->store, a->name, &seal, before + a->body_bytes, &count);
    const bool found = bytes && count == before + a->body_bytes;
    if (found) {
        memcpy(&a->statistics, bytes, before);
        memcpy(a->body, bytes + before, a->body_bytes);
        source->found++;
    }
    free(bytes);
    return found;
}

static void keep(struct reference_source *source, const struct answer *a) {
    const struct folder_seal seal = seal_of(a->key);
    struct reference_statistics statistics;
    // Clears padding too, so that an entry's bytes depend on nothing else.
    memset(&statistics, 0, sizeof statistics);
    statistics = a->statistics;
    const struct folder_store_part parts[2] = {{&statistics, sizeof statistics}, {a->body, a->body_bytes}};
    folder_store_seal(&source->store, a->name, &seal, parts, 2);
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
