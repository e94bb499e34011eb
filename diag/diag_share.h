// Which diagnostics are shown when there is no room for all: each code in each file gets the same share of
// the room, and what one does not need goes to the others. So a mistake that occurs a thousand times does not
// hide one that occurs once, and a report of a single mistake uses all the room.
//
// Input: a sorted sink, whose diagnostics are then asked about in their order. Ownership: a value. Thread
// safety: pure except for the share.
#ifndef GLINT_DIAG_DIAG_SHARE_H
#define GLINT_DIAG_DIAG_SHARE_H

#include "core/strbuf.h"
#include "diag/diag.h"

struct diag_share {
    uint32_t most;  // of all
    uint32_t quota; // shown per code and source
    uint32_t alike; // the same limit however much room there is; a tenth in files made by programs
    uint32_t used;
    uint32_t source;
    uint32_t seen[DIAG_CODE_COUNT]; // in this source
};

// `most`: how many there is room for; 0: all. `alike`: show at most so many of one code in one file; 0: all
// that there is room for. `notes`: whether diagnostics of severity "note" are shown.
struct diag_share diag_share_begin(const struct diag_sink *sink, uint32_t most, uint32_t alike, bool notes);
// Whether there is room for the next diagnostic; `always` if it must be shown regardless of room.
bool diag_share_takes(struct diag_share *share, const struct diag *item, bool always);

// What was not shown, by code.
struct diag_hidden {
    uint32_t count;
    uint32_t of[DIAG_CODE_COUNT];
};
void diag_hide(struct diag_hidden *hidden, diag_code code, uint32_t number);
// Adds those that the sink itself had no room for; notes only if requested.
void diag_hide_dropped(struct diag_hidden *hidden, const struct diag_sink *sink, bool notes);
// "E206: 80, W401: 20", in the order of the codes.
void diag_hidden_codes(struct strbuf *out, const struct diag_hidden *hidden);
// If more diagnostics than this are asked for, no other bound applies to what is shown.
uint32_t diag_share_standard(void);
// The message limit that shows all of `total` diagnostics, or the greatest possible limit.
uint32_t diag_share_needed(uint32_t total);

#endif
