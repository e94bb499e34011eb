// What a picture by the reference reports of itself: rays by kind, and the weight of those not followed.
//
// Errors: the buffer's (`failed`). Thread safety: pure.
#ifndef GLINT_RENDER_STATS_REFERENCE_STATS_H
#define GLINT_RENDER_STATS_REFERENCE_STATS_H

#include "core/strbuf.h"
#include "render/reference_shot.h"

void reference_stats_text(const struct reference_shot *shot, const struct reference_statistics *statistics,
                          struct strbuf *out);
void reference_stats_json(const struct reference_shot *shot, const struct reference_statistics *statistics,
                          struct strbuf *out);

#endif
