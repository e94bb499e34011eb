// A picture's own error: pixels spread over it are traced again by the double-precision reference, at the
// same settings, and compared as displayed.
//
// The pixels are one in each cell of a grid, at a place in it that depends on the picture's size alone. Each
// look takes one such grid. Another, finer look follows as long as it is open whether more than the wished
// share of the picture is off. The bounds for the whole picture are those of Clopper and Pearson (1934), and
// hold together at AUDIT_CONFIDENCE; if all pixels are traced again they are exact. Errors: as render/shot.h.
// Thread safety: one thread.
#ifndef GLINT_RENDER_AUDIT_H
#define GLINT_RENDER_AUDIT_H

#include "render/shot.h"

#define AUDIT_CONFIDENCE 0.95
// A pixel is off where a displayed channel differs by more.
#define AUDIT_THRESHOLD (1.0 / 255)

struct audit {
    uint32_t pixels; // traced again
    uint32_t off;    // of them
    bool whole;      // they are all of the picture
    double bound;    // the share of the picture's pixels that is off is at most this,
    double floor;    // and at least this
    uint32_t x, y;   // the first pixel that is off, row by row, if there is one
    double seconds;
};

struct reference;

struct audit_wish {
    const struct reference *reference; // of the session's scene and the view; NULL: it is made for the audit
    double share; // the audit asks whether more pixels are off: AUDIT_SHARE, or what the user allows
    const uint32_t *samples; // of each pixel, where they differ; NULL: all have the session's
    uint32_t planned;        // samples of the frame, if a time limit ended it earlier; 0: the session's
    bool decides; // looks go on until that is answered, at most to all pixels; else there are two at most
};
#define AUDIT_SHARE 0.001

// `image` was rendered with the session's settings through `view`.
enum shot_status audit_take(struct session *session, const struct view *view, const struct image *image,
                            const struct audit_wish *wish, const struct render_progress *progress,
                            struct audit *out);
// Whether a pixel is off: its linear values by the device, and by the reference.
bool audit_is_off(const float rgb[3], const double reference[3], struct image_display display);
// "at most 0.0995 % of the pixels are off by more than 1/255 (95 % sure): 0 of 3710 traced again ...", a line
// without an end.
void audit_words(const struct audit *audit, struct strbuf *out);

#endif
