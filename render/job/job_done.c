#include "render/job/job_done.h"

#include "files/stream.h"
#include "picture/metrics/picture_file.h"
#include "render/record/record.h"

enum {
    PIXEL_BYTES = 64, // per pixel, at most, while a picture of the wanted size is read
    SPARE_BYTES = 1 << 20,
};

static bool is_whole(str file, uint64_t pixels) {
    struct picture_file picture = {0};
    bool unknown;
    const uint64_t most = pixels * PIXEL_BYTES + SPARE_BYTES;
    const bool good = !picture_file_decode(file, most, &picture, &unknown);
    picture_file_finish(&picture);
    return good;
}

bool job_texts_are_done(const char *path, const struct image_texts *texts, struct arena *arena) {
    struct record_read wanted, there;
    struct record_command command;
    struct strbuf file;
    bool good = false;
    record_of_texts(texts, &wanted);
    if (!wanted.is_there || !record_read_command(wanted.fields[RECORD_COMMAND], arena, &command))
        return false;
    strbuf_init(&file);
    if (stream_read_file(path, SIZE_MAX, &file) == 0 && !file.failed) {
        record_find(strbuf_view(&file), &there);
        good = record_same(&wanted, &there, arena) &&
               is_whole(strbuf_view(&file), (uint64_t)command.width * (uint64_t)command.height);
    }
    strbuf_finish(&file);
    return good;
}

static bool same_pixels(const struct part *a, const struct part *b) {
    return a->width == b->width && a->height == b->height && a->region.x == b->region.x &&
           a->region.y == b->region.y && a->region.width == b->region.width &&
           a->region.height == b->region.height && a->first_sample == b->first_sample &&
           a->end_sample == b->end_sample && a->samples == b->samples && a->display.tone == b->display.tone &&
           a->display.transfer == b->display.transfer && a->display.exposure == b->display.exposure;
}

static bool part_is_there(const struct job *job, const char *path, const struct image_texts *texts) {
    struct part *there = ARENA_NEW(job->arena, struct part);
    struct record_read wanted, read;
    struct strbuf error;
    strbuf_init(&error);
    record_of_texts(texts, &wanted);
    // The head says what it is; only if it fits is the rest read, to see that it is whole.
    bool good = part_read(path, true, there, &error) && same_pixels(there, &job->part);
    if (good)
        record_of_line(str_from(there->record), &read);
    good = good && record_same(&wanted, &read, job->arena);
    part_finish(there);
    good = good && part_read(path, false, there, &error);
    part_finish(there);
    strbuf_finish(&error);
    return good;
}

// What the new file would say of itself, in this precision.
static struct image_texts texts_of(const struct job *job, bool is_double, enum image_format format,
                                   struct image_coding coding) {
    struct provenance made = job_provenance(job, format, coding);
    made.is_double = is_double;
    return provenance_texts(&made, job->arena);
}

// A picture in either precision will do. If the scene leaves the precision open, the same one would be chosen
// for it again.
bool job_picture_is_done(const struct job *job, const char *path, enum image_format format,
                         struct image_coding coding) {
    bool done = false;
    for (int is_double = 0; is_double < 2 && !done; is_double++) {
        const struct image_texts texts = texts_of(job, is_double, format, coding);
        done = job_texts_are_done(path, &texts, job->arena);
    }
    return done;
}

bool job_part_is_done(const struct job *job, const char *path) {
    bool done = false;
    for (int is_double = 0; is_double < 2 && !done; is_double++) {
        const struct image_texts texts = texts_of(job, is_double, IMAGE_PNG, (struct image_coding){0});
        done = part_is_there(job, path, &texts);
    }
    return done;
}
