// Properties of JSON objects, checked by type, range and references: faults are reported at their place.
//
// Thread safety: as gltf.h.
#ifndef GLINT_ASSETS_GLTF_FIELDS_H
#define GLINT_ASSETS_GLTF_FIELDS_H

#include "assets/gltf/gltf.h"

// Each returns false if the property is missing or wrong, and then leaves *out unchanged; only wrong ones are
// reported.
bool gltf_get_number(struct gltf *gltf, json_index object, const char *key, double least, double most,
                     double *out);
bool gltf_get_whole(struct gltf *gltf, json_index object, const char *key, uint64_t most, uint64_t *out);
bool gltf_get_bool(struct gltf *gltf, json_index object, const char *key, bool *out);
bool gltf_get_text(struct gltf *gltf, json_index object, const char *key, str *out);
bool gltf_get_numbers(struct gltf *gltf, json_index object, const char *key, double least, double most,
                      uint32_t count, double *out);
// An index below `count`; *out is GLTF_NONE where the property is missing or wrong.
bool gltf_get_index(struct gltf *gltf, json_index object, const char *key, uint32_t count, uint32_t *out);
// An object or a list; 0: missing, or wrong.
json_index gltf_get_object(struct gltf *gltf, json_index object, const char *key);
json_index gltf_get_list(struct gltf *gltf, json_index object, const char *key);
// Reports that a required property is missing.
void gltf_missing(struct gltf *gltf, json_index object, const char *key);
// The name of an object; empty: none.
str gltf_name(struct gltf *gltf, json_index object);
// Whether a text has no control characters, which scenes may not contain.
bool gltf_is_clean(str text);
// object.extensions.name; 0: none.
json_index gltf_extension(struct gltf *gltf, json_index object, const char *name);

// The values of a list that are objects, one after the other: 0 to begin, 0 at the end. Others are reported.
json_index gltf_next_object(struct gltf *gltf, json_index list, json_index before);

#endif
