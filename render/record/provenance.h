// What the pictures that glint writes say of how they were made (record.h).
//
// Ownership: text lies in the given arena, whose guard the caller sets. Thread safety: session and device are
// only read.
#ifndef GLINT_RENDER_RECORD_PROVENANCE_H
#define GLINT_RENDER_RECORD_PROVENANCE_H

#include "load/session.h"
#include "picture/write/image.h"
#include "tracer/gpu/gpu.h"

struct provenance {
    const struct session *session; // the background's pixels are there
    const struct gpu *gpu;         // NULL: the reference
    uint32_t camera;
    bool is_double;
    bool as_file;                         // of the reference: it obeyed max_depth and min_weight
    bool audits;                          // the picture's note says what an audit found
    double max_off;                       // that the audit was to allow; below 0: not given
    uint32_t scaled_width, scaled_height; // 0: the picture was not scaled up
    enum image_format format;
    struct image_coding coding; // of its file
};

// The texts for the head of its file; none for a format that has no place for them, or for a picture that no
// command makes again.
struct image_texts provenance_texts(const struct provenance *made, struct arena *arena);
// The texts of a whole picture as a line for its parts, which do not know the format; empty: there are none,
// or they need more than `size` bytes. And back, for the picture that parts make.
void provenance_line(const struct provenance *made, struct arena *arena, char *line, size_t size);
struct image_texts provenance_of_line(const char *line, enum image_format format, struct image_coding coding,
                                      struct arena *arena);

#endif
