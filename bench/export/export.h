// A loaded scene in another tracer's language, to be timed by it: the same triangles and spheres in scene
// units, the same camera and lights, and materials as near as its own come. What a tool cannot say is left
// out, and named.
//
// Writers append to `out` (out->failed: no memory) and give what the tool cannot show of this scene, in words
// for a table; empty: nothing. Ownership: the caller's. Thread safety: pure functions of what they are given.
#ifndef GLINT_BENCH_EXPORT_EXPORT_H
#define GLINT_BENCH_EXPORT_EXPORT_H

#include "core/strbuf.h"
#include "scene/view.h"

struct export_input {
    const struct scene *scene;
    const struct view *view;
    str background_path;        // of the image's file; empty: no image
    double background_rotation; // degrees
    uint32_t width, height;
};

const char *export_pov(const struct export_input *in, struct strbuf *out);
const char *export_tachyon(const struct export_input *in, struct strbuf *out);

// ---- what they share

// The unit normals of a smooth body's triangle in world space, corner by corner; false: it is flat there.
bool export_normals(const struct scene_body *body, const vec3 *normals, uint32_t triangle, vec3 out[3]);
static inline double export_largest(vec3 v) {
    return fmax(v.x, fmax(v.y, v.z));
}

#endif
