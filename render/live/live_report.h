// What a load of a live scene did, as a line of text or of JSON.
//
// Ownership: nothing is owned. Errors: the buffer's (`failed`). Thread safety: pure.
#ifndef GLINT_RENDER_LIVE_LIVE_REPORT_H
#define GLINT_RENDER_LIVE_LIVE_REPORT_H

#include "render/live/live.h"

struct strbuf;

struct live_report {
    const struct live *live;
    bool is_broken;     // there is no new picture
    bool is_view;       // of a window: without what is about a picture's file
    const char *output; // the picture's file
    uint32_t width, height;
    const struct render_statistics *frame;
    double coarse_seconds; // from the change that was seen to a picture of few pixels; 0: there was none
    double encode_seconds, total_seconds; // total: from the change that was seen to the picture
};

void live_text(const struct live_report *report, struct strbuf *out);
// One line, a report by itself (docs/reports.md).
void live_json(const struct live_report *report, struct strbuf *out);

#endif
