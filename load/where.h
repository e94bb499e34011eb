// From a body and its triangle to words and places: what people call it, and where it is in the scene and the
// mesh.
//
// Ownership: text points into session and assets. Thread safety: pure reads.
#ifndef GLINT_LOAD_WHERE_H
#define GLINT_LOAD_WHERE_H

#include "core/strbuf.h"
#include "load/session.h"
#include "scene/media.h"

struct where {
    const char *kind;               // as the language calls it: "sphere"
    const char *list;               // of the scene, that holds it: "spheres"
    uint32_t index;                 // in that list
    const struct ir_copies *copies; // of the scene; NULL: there are none
    const struct schema_row *row;   // the list
    str name;                       // empty: it has none
    span at;                        // in the scene
    uint32_t instance;              // 1 + that in whose object it is (ir_copies); 0: in none
    span instance_at;               // in the scene
    uint32_t material;              // in assets.materials
    str material_name;              // empty: inline, or the default
    const char *material_kind; // "material", "inline material", "default material", "material of the mesh"
    span material_at;          // in the scene; SPAN_NONE if it is not written there
    str mesh;                  // path; empty: no mesh
    uint32_t mesh_line;        // 0: no mesh
    const char *mesh_word;     // what mesh_line counts: "line", or "face" in a binary file
};

// `body` in IR order, `triangle` in file order. false: there is no such body.
bool where_find(const struct session *session, uint32_t body, uint32_t triangle, struct where *out);
// "model 'dragon'", "spheres[2]"; "the background" if `where` is NULL.
void where_body_words(const struct where *where, struct strbuf *out);
// "material 'jade'", "the default material".
void where_material_words(const struct where *where, struct strbuf *out);

// Why a feature is on although nothing written in the scene asks for it: media that may share a place, or a
// mesh's materials. Appends the words to `out`; returns the place that they are about, or SPAN_NONE.
span where_feature_words(const struct session *session, uint64_t feature,
                         const struct scene_media_reason *reason, struct strbuf *out);

// false: the camera is inside more media than a ray can be; the sink has the error.
bool where_camera_fits(struct session *session, uint32_t camera, const struct view *view);

// What either tracer may report about pixels.
#define WHERE_NOT_FINITE    "got a value that is infinite or not a number"
#define WHERE_NESTED        "show rays that are inside more than 8 bodies at once that refract"
#define WHERE_OVER_SEGMENTS "needed more rays than the limit path-segments"
#define WHERE_CUT_SHORT     "needed more rays than the limit reference-segments"

// Reports pixels with a fault in the sink, with the body that the path of the first one hit last (HIT_NONE:
// none): its material, and its lines in scene and mesh.
struct where_fault {
    diag_code code;
    const char *words; // WHERE_NOT_FINITE, or others that follow "3 pixels"
    uint32_t pixels, x, y;
    uint32_t body, triangle;
};
void where_report_fault(struct session *session, const struct where_fault *fault);

#endif
