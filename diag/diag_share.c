#include "diag/diag_share.h"

#include "core/limits.h"

#include <string.h>

enum {
    MADE_BY_PROGRAMS = 10, // a mesh or an image: a mistake in one place mostly occurs in thousands
};

// How many are shown if each code in each source may have `quota`; stops counting above `most`.
static uint64_t count_shown(const struct diag_sink *sink, uint32_t quota, uint32_t most, bool notes) {
    uint32_t seen[DIAG_CODE_COUNT] = {0};
    uint64_t sum = 0;
    for (uint32_t i = 0; i < sink->count && sum <= most; i++) {
        const struct diag *item = &sink->items[i];
        if (i && item->at.source != sink->items[i - 1].at.source)
            memset(seen, 0, sizeof seen);
        if (item->severity != DIAG_NOTE || notes)
            sum += seen[item->code]++ < quota;
    }
    return sum;
}

static uint32_t fair_quota(const struct diag_sink *sink, uint32_t most, bool notes) {
    if (most == 0 || count_shown(sink, UINT32_MAX, most, notes) <= most)
        return UINT32_MAX;
    uint32_t low = 1;
    uint32_t high = most + 1;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (count_shown(sink, middle, most, notes) <= most)
            low = middle;
        else
            high = middle;
    }
    return low;
}

struct diag_share diag_share_begin(const struct diag_sink *sink, uint32_t most, uint32_t alike, bool notes) {
    return (struct diag_share){.most = most ? most : UINT32_MAX,
                               .quota = fair_quota(sink, most, notes),
                               .alike = alike ? alike : UINT32_MAX,
                               .source = UINT32_MAX};
}

static uint32_t alike_of(const struct diag_share *share, diag_code code) {
    bool made = (diag_info(code)->where & (DIAG_IN_MESH | DIAG_IN_IMAGE)) != 0;
    if (share->alike == UINT32_MAX || !made)
        return share->alike;
    return share->alike > MADE_BY_PROGRAMS ? share->alike / MADE_BY_PROGRAMS : 1;
}

bool diag_share_takes(struct diag_share *share, const struct diag *item, bool always) {
    if (item->at.source != share->source)
        memset(share->seen, 0, sizeof share->seen);
    share->source = item->at.source;
    uint32_t before = share->seen[item->code]++;
    bool fits = share->used < share->most && before < share->quota && before < alike_of(share, item->code);
    share->used += fits || always;
    return fits || always;
}

void diag_hide(struct diag_hidden *hidden, diag_code code, uint32_t number) {
    hidden->count += number;
    hidden->of[code] += number;
}

void diag_hide_dropped(struct diag_hidden *hidden, const struct diag_sink *sink, bool notes) {
    for (diag_code code = diag_next(-1); code < DIAG_CODE_COUNT && sink->dropped; code = diag_next(code))
        if (notes || diag_info(code)->severity != DIAG_NOTE)
            diag_hide(hidden, code, sink->dropped_of[code]);
}

void diag_hidden_codes(struct strbuf *out, const struct diag_hidden *hidden) {
    bool first = true;
    for (diag_code code = diag_next(-1); code < DIAG_CODE_COUNT; code = diag_next(code)) {
        if (!hidden->of[code])
            continue;
        strbuf_format(out, "%s%s: %u", first ? "" : ", ", diag_info(code)->code, hidden->of[code]);
        first = false;
    }
}

uint32_t diag_share_standard(void) {
    return (uint32_t)limit_info(LIMIT_MESSAGES)->standard;
}

uint32_t diag_share_needed(uint32_t total) {
    const struct limit_info *info = limit_info(LIMIT_MESSAGES);
    uint64_t least = info->standard + 1;
    uint64_t needed = total > least ? total : least;
    return (uint32_t)(needed < info->greatest ? needed : info->greatest);
}
