// libFuzzer entry: any bytes as a picture file whose record is looked for, and as the command and the line of
// one. What is found lies in the bytes.
#include "render/record/record.h"
#include "render/record/words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MEMORY_BYTES = 1024 * 1024
};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(bool holds, const char *what) {
    if (holds)
        return;
    fprintf(stderr, "the record broke its promise: %s\n", what);
    abort();
}

struct job {
    str bytes;
    struct arena arena;
};

static void check_inside(const struct job *job, str field) {
    require(!field.len ||
                (field.ptr >= job->bytes.ptr && field.ptr + field.len <= job->bytes.ptr + job->bytes.len),
            "a field lies in the file");
}

static void check_command(struct job *job, str text) {
    struct record_command command;
    if (!record_read_command(text, &job->arena, &command))
        return;
    require(command.scene.len && command.width > 0 && command.samples > 0, "a command has what it needs");
    for (uint32_t i = 0; i < command.set_count; i++)
        require(command.sets[i].ptr != NULL, "a value of --set");
}

// A word that is read is written and read again as it was.
static void check_words(struct job *job) {
    str rest = job->bytes, word, again;
    while (words_take(&rest, &job->arena, &word)) {
        struct strbuf line;
        strbuf_init(&line);
        words_add(&line, word);
        str written = strbuf_view(&line);
        require(words_take(&written, &job->arena, &again) && str_equal(word, again), "a word comes back");
        strbuf_finish(&line);
    }
}

static void run(void *context) {
    struct job *job = context;
    struct record_read file, line;
    record_find(job->bytes, &file);
    check_inside(job, file.note);
    for (int i = 0; i < RECORD_FIELDS; i++)
        check_inside(job, file.fields[i]);
    record_of_line(job->bytes, &line);
    record_same(&file, &line, &job->arena);
    check_command(job, file.fields[RECORD_COMMAND]);
    check_command(job, job->bytes);
    check_words(job);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *copy = malloc(size + 1);
    if (!copy)
        abort();
    if (size)
        memcpy(copy, data, size);
    copy[size] = '\0';
    struct job job = {.bytes = {copy, size}};
    arena_init(&job.arena, MEMORY_BYTES);
    arena_guarded(&job.arena, run, &job);
    arena_finish(&job.arena);
    free(copy);
    return 0;
}
