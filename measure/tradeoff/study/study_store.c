#include "measure/tradeoff/study/study_store.h"

#include "core/heap.h"
#include "core/xxh64.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    NAME_BYTES = 48,
    ROWS_MOST = 1024,
};

// The header of an entry; the rows follow. An entry is read on the machine that wrote it.
struct entry_head {
    char magic[8];
    uint64_t head_bytes, row_bytes;
    uint64_t key[2];
    uint64_t hash; // of the study and the rows
    struct tradeoff study;
};

static const char MAGIC[8] = "glintST";

static void name_of(const uint64_t key[2], char name[NAME_BYTES]) {
    snprintf(name, NAME_BYTES, "%016" PRIx64 "%016" PRIx64 ".study", key[0], key[1]);
}

static uint64_t hash_of(const struct tradeoff *study, const struct row *rows, size_t count) {
    struct xxh64 h;
    xxh64_begin(&h, 0);
    xxh64_add(&h, study, sizeof *study);
    xxh64_add(&h, rows, count * sizeof *rows);
    return xxh64_end(&h);
}

// The rows follow the head, in memory that may not be aligned for them.
static struct row *rows_of(const char *bytes, size_t size, const uint64_t key[2], struct entry_head *head) {
    if (size < sizeof *head)
        return NULL;
    memcpy(head, bytes, sizeof *head);
    const uint32_t count = head->study.count;
    if (memcmp(head->magic, MAGIC, sizeof MAGIC) != 0 || head->head_bytes != sizeof *head ||
        head->row_bytes != sizeof(struct row) || memcmp(head->key, key, sizeof head->key) != 0 ||
        count == 0 || count > ROWS_MOST || size != sizeof *head + count * sizeof(struct row))
        return NULL;
    struct row *rows = heap_array(count, sizeof *rows);
    if (!rows)
        return NULL;
    memcpy(rows, bytes + sizeof *head, count * sizeof *rows);
    if (head->hash == hash_of(&head->study, rows, count))
        return rows;
    free(rows);
    return NULL;
}

bool study_recall(const struct folder_store *store, const uint64_t key[2], struct tradeoff *study) {
    char name[NAME_BYTES];
    struct entry_head head;
    size_t size = 0;
    *study = (struct tradeoff){0};
    name_of(key, name);
    char *bytes = folder_store_read(store, name, sizeof head + ROWS_MOST * sizeof(struct row), &size);
    struct row *rows = bytes ? rows_of(bytes, size, key, &head) : NULL;
    free(bytes);
    if (!rows)
        return false;
    *study = head.study;
    study->rows = rows;
    study->capacity = study->count;
    for (uint32_t i = 0; i < study->count; i++) {
        strbuf_init(&rows[i].thumbnail);
        strbuf_init(&rows[i].difference);
    }
    return true;
}

void study_keep(const struct folder_store *store, const uint64_t key[2], const struct tradeoff *study) {
    char name[NAME_BYTES];
    struct entry_head head;
    if (study->count == 0 || study->count > ROWS_MOST)
        return;
    // Clears padding too, so that an entry's bytes depend on nothing else.
    memset(&head, 0, sizeof head);
    memcpy(head.magic, MAGIC, sizeof MAGIC);
    head.head_bytes = sizeof head;
    head.row_bytes = sizeof(struct row);
    memcpy(head.key, key, sizeof head.key);
    memcpy(&head.study, study, sizeof *study);
    head.study.rows = NULL;
    head.hash = hash_of(&head.study, study->rows, study->count);
    const struct folder_store_part parts[2] = {{&head, sizeof head},
                                               {study->rows, study->count * sizeof *study->rows}};
    name_of(key, name);
    folder_store_write(store, name, parts, 2);
}
