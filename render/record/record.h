// How a picture was made, as its file says it: version, hash of the scene, device, settings, and the command
// that makes it again.
//
// Only what changes the picture is in it: no time, no folder that the user did not write, neither the name of
// the output nor options that change no pixel. So the same command writes the same bytes, and so does one
// that says the same in other words (such as --time, and the samples that it allowed). Ownership: text lies
// in the given arena, whose guard the caller sets. Thread safety: pure.
#ifndef GLINT_RENDER_RECORD_RECORD_H
#define GLINT_RENDER_RECORD_RECORD_H

#include "load/session.h"
#include "picture/write/image.h"

enum record_field {
    RECORD_SOFTWARE, // "glint 1.0.0"
    RECORD_SCENE,    // the hash: scene/content.h
    RECORD_DEVICE,
    RECORD_SETTINGS, // for people
    RECORD_SCALED,   // "640x480", of a smaller picture that was scaled up; most pictures do not have it
    RECORD_COMMAND,
    RECORD_FIELDS,
};
extern const char *const record_keywords[RECORD_FIELDS];

// What `glint render` is asked for: all that verify needs to render again.
struct record_command {
    str scene;  // as the user wrote it; "-": standard input
    str camera; // empty: the first
    const str *sets, *asset_paths;
    uint32_t set_count, asset_path_count;
    int32_t width, height, samples;
    double noise; // 0: not given
    bool is_reference, as_file, audit;
    double max_off; // below 0: not given
    struct image_coding coding;
};

// What is known of a picture when it is written.
struct record {
    struct record_command command;
    str version, device;
    const struct session *session; // its scene, whose pixels are there
    bool is_double;
    uint32_t scaled_width, scaled_height; // 0: not scaled
    enum image_format format;
};

// The texts for its file; in the arena.
struct image_texts record_texts(const struct record *record, struct arena *arena);

// How a format is coded, added to a command.
void record_add_coding(struct strbuf *line, enum image_format format, const struct image_coding *coding);

// ---- the other way round

// What a file holds; NULL: it does not have this field.
struct record_read {
    str fields[RECORD_FIELDS];
    str note; // IMAGE_NOTE_KEYWORD
    bool is_there;
};

void record_find(str file, struct record_read *out);
// Reads a command that record_texts wrote. false: it is not one.
bool record_read_command(str text, struct arena *arena, struct record_command *out);
// The same of texts that will be written, and of the line that a part carries (render/parts): "Software:
// ...", a tab, "Scene hash: ..." and so on.
void record_of_texts(const struct image_texts *texts, struct record_read *out);
void record_of_line(str line, struct record_read *out);
// Whether two records are of one picture: the same scene, version, device and settings, coded alike. The
// scene's path and an audit's note do not count. Also false if one is not a record.
bool record_same(const struct record_read *a, const struct record_read *b, struct arena *arena);

#endif
