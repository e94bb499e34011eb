// Hashes of what the reference reads: equal keys, equal answers. Private to reference/.
#ifndef GLINT_REFERENCE_KEY_H
#define GLINT_REFERENCE_KEY_H

#include "reference/reference.h"

// Everything but the settings of one call.
void reference_scene_key(const struct reference_input *input, uint64_t key[2]);
// `hits`: a question about first hits, which does not depend on how far paths are followed.
void reference_call_key(const uint64_t scene_key[2], const struct reference_settings *settings, bool hits,
                        uint64_t key[2]);

#endif
