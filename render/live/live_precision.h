// Whether the precision that `auto` chose for one frame holds for the next. Private to render/live.
//
// Thread safety: as live.h.
#ifndef GLINT_RENDER_LIVE_LIVE_PRECISION_H
#define GLINT_RENDER_LIVE_LIVE_PRECISION_H

#include "render/live/live.h"

// Whether it holds for a session that follows the shot's, seen through this camera. false: ask again, or the
// result of asking is not known.
bool live_keeps_precision(struct live *live, struct session *session, uint32_t camera);

#endif
