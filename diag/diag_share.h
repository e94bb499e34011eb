// Which diagnostics are shown where there is no room for all of them: each code in each file gets the same
// share of the room, and what one does not need goes to the others. So a mistake that occurs a thousand times
// does not hide the one that occurs once, and a report of one mistake only uses all the room.
//
// Input: a sorted sink, whose diagnostics are then asked about in their order. Ownership: a value. Thread
// safety: pure except for the share.
#ifndef GLINT_DIAG_DIAG_SHARE_H
#define GLINT_DIAG_DIAG_SHARE_H

#include "core/strbuf.h"
#include "diag/diag.h"

struct diag_share {
    uint32_t most;  // of all
    uint32_t quota; // of one code in one source
    uint32_t alike; // the same, however much room there is; in files made by programs a tenth of it
    uint32_t used;
    uint32_t source;
    uint32_t seen[DIAG_CODE_COUNT]; // in this source
};

// `most`: room for so many; 0 is room for all. `alike`: of one code in one file show so many at most; 0: all
// for which there is room. `notes`: whether diagnostics of severity "note" are shown.
struct diag_share diag_share_begin(const struct diag_sink *sink, uint32_t most, uint32_t alike, bool notes);
// Whether there is room for the next diagnostic; `always` if it must be shown whatever room there is.
bool diag_share_takes(struct diag_share *share, const struct diag *item, bool always);

// What was not shown, by code.
struct diag_hidden {
    uint32_t count;
    uint32_t of[DIAG_CODE_COUNT];
};
void diag_hide(struct diag_hidden *hidden, diag_code code, uint32_t number);
// Those that the sink itself had no room for; notes only if they are asked for.
void diag_hide_dropped(struct diag_hidden *hidden, const struct diag_sink *sink, bool notes);
// "E206: 80, W401: 20", in the order of the codes.
void diag_hidden_codes(struct strbuf *out, const struct diag_hidden *hidden);
// Above how many diagnostics no other bound holds on what is shown.
uint32_t diag_share_standard(void);
// The limit of messages with which `total` diagnostics are all shown, or the greatest that there is.
uint32_t diag_share_needed(uint32_t total);

#endif
