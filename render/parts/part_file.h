// A part of a picture as a file: lines of text that say which part of which picture it is, then its floats.
//
//     glint part 1
//     scene 3f0c...             hash of the scene, its files and its view (32 hexadecimal digits)
//     settings 9a41...          hash of what else decides the floats: settings, version, precision
//     device llvmpipe (...)     that made them
//     size 640 480              of the whole picture, in pixels
//     region 0 240 640 120      x, y, width and height
//     samples 0 16 16           first, end (not included), and of the whole picture
//     shown clip srgb           tone and transfer, for formats of displayed values
//     record Software: ...      how the whole picture is made: texts with a tab between them; may be empty
//     data 921600               bytes that follow
//
// Then floats, little endian: rows from the top, and of a row its planes, three floats a pixel. A part with
// all samples has one plane, their mean. A part with some has one for each sample: sums of floats depend on
// their order, so the samples must be separate to be added up as in a picture that is rendered whole. The
// last eight bytes are the XXH64 of all before. Errors: false, with a sentence about it; ownership:
// part_finish frees the floats. Thread safety: plain data.
#ifndef GLINT_RENDER_PARTS_PART_FILE_H
#define GLINT_RENDER_PARTS_PART_FILE_H

#include "core/strbuf.h"
#include "files/spool.h"
#include "picture/write/rows.h"

#define PART_ENDING ".part"

enum {
    PART_DEVICE_BYTES = 256,
    PART_RECORD_BYTES = 4096,
};

struct part_region {
    uint32_t x, y, width, height; // pixels
};

struct part {
    uint64_t scene[2], settings[2];
    char device[PART_DEVICE_BYTES];
    char record[PART_RECORD_BYTES]; // of the whole picture (render/record), a tab between its texts; empty:
                                    // none
    uint32_t width, height;         // of the whole picture
    struct part_region region;
    uint32_t first_sample, end_sample, samples; // samples: of the whole picture
    struct image_display display;
    size_t head_bytes; // of the file that it was read from
    float *rgb;        // NULL: only its head was read; plane after plane, each rows from the top
};

uint32_t part_planes(const struct part *part);
// Appends the whole file.
void part_encode(const struct part *part, struct strbuf *out);
// Writes the same file for a part with all samples, whose rows come a few at a time. false: as
// image_rows_write.
bool part_write_rows(const struct part *part, const struct image_rows *rows, const struct image_sink *sink);
// Reads a file that part_encode has made. `head_only`: not its floats.
bool part_read(const char *path, bool head_only, struct part *part, struct strbuf *error);
void part_finish(struct part *part);
// For a part with all samples of which only the head was read: whether its file is whole, which means reading
// all of it; and `count` rows from row y of its region. false: it cannot be read.
bool part_check(const char *path, const struct part *part, struct strbuf *error);
bool part_take_rows(struct spool *file, const struct part *part, uint32_t y, uint32_t count, float *rgb);

// ---- what other files of pictures in parts have too

// The lines above from the first to `record`; `kind` is "part".
void part_put_head(const struct part *part, const char *kind, struct strbuf *out);
// Reads these lines: *text is then after them, and was changed. false: this is something else.
bool part_take_head(char **text, const char *kind, struct part *part);
// Reads a further line of such a head: the text after its first word, or whole numbers. NULL or false: it is
// another line.
char *part_take_line(char **text, const char *word);
bool part_take_numbers(char **text, const char *word, uint32_t *out, int count);

#endif
