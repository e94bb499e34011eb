// A picture's own error: pixels spread over it are traced again by the double-precision reference, at the
// same settings, and compared as displayed.
//
// The pixels are one in each cell of a grid, at a place in it that depends on the picture's size alone. What
// is said of the whole picture is the upper bound of Clopper and Pearson (1934) at AUDIT_CONFIDENCE; where
// all pixels are traced again it is exact. Errors: as app/shot.h. Thread safety: one thread.
#ifndef GLINT_APP_AUDIT_H
#define GLINT_APP_AUDIT_H

#include "app/shot.h"

#define AUDIT_CONFIDENCE 0.95
// A pixel is off where a displayed channel differs by more.
#define AUDIT_THRESHOLD (1.0 / 255)

struct audit {
    uint32_t pixels; // traced again
    uint32_t off;    // of them
    bool whole;      // they are all of the picture
    double bound;    // the share of the picture's pixels that is off is at most this
    uint32_t x, y;   // the first of them that is off, by rows; where there is one
    double seconds;
};

// `image` was rendered with the session's settings through `view`.
enum shot_status audit_take(struct session *session, const struct view *view, const struct image *image,
                            const struct render_progress *progress, struct audit *out);
// The least share such that `off` or fewer of `pixels` occur with a probability of at most half of
// 1 - AUDIT_CONFIDENCE. `pixels` is at least 1.
double audit_bound(uint32_t off, uint32_t pixels);
// "at most 0.0995 % of the pixels are off by more than 1/255 (95 % sure): 0 of 3710 traced again ...", a line
// without an end.
void audit_words(const struct audit *audit, struct strbuf *out);

#endif
