// Which precision a scene needs, found by tracing some of its pixels.
//
// Pixels spread over the picture are traced by the reference tracer twice, in double precision and with
// numbers rounded as a device in single precision rounds them, and compared as displayed. So all counts that
// moves a pixel: slender triangles, gaps, checkers, cameras close to a surface, mirrors and glass that
// magnify errors. A scene of more than PRECISION_TRACED triangles is measured alone
// (tracer/flatten/precision.h). No device takes part: the same file gives the same answer on every machine.
// Input: as flatten. Errors: false when memory ends. Thread safety: pure.
#ifndef GLINT_PRECISION_PRECISION_H
#define GLINT_PRECISION_PRECISION_H

#include "tracer/flatten/precision.h"

#define PRECISION_TRACED 500000u     // triangles and spheres
#define PRECISION_OFF    (1.0 / 255) // of a displayed channel
#define PRECISION_SHARE  0.0005      // of the pixels: half of what a picture may have off

struct precision_choice {
    struct precision_report report; // what was measured
    bool traced;                    // pixels were traced
    uint32_t pixels, off;           // so many, and those of them that differ
    bool needs_double;
};

// `width` and `height` of the picture.
bool precision_decide(const struct flat_input *input, uint32_t width, uint32_t height,
                      struct precision_choice *out);
// What a scene is traced in: its own setting, or what the choice says.
bool precision_is_double(const struct ir_scene *ir, const struct precision_choice *choice);

#endif
