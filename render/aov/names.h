// What the numbers of `object` and `material` stand for: a table of names, and the manifest of mattes.
//
// Number 1 is the first body in the order of the scene (grammar/ir.h), or the first material; 0 is the
// background. Ownership: the arena given, whose guard the caller sets. Thread safety: plain data.
#ifndef GLINT_RENDER_AOV_NAMES_H
#define GLINT_RENDER_AOV_NAMES_H

#include "core/strbuf.h"
#include "load/session.h"

struct aov_name {
    // As the scene has it, else where it stands: "spheres[2]", "spheres[2].material"; of a copy with its
    // places, "pawn[3]", or in a scene of more than 100 000 bodies that of its entry, "pawn".
    const char *name;
    const char *kind; // "sphere", "inline material"
    span at;          // SPAN_NONE: not in the scene
    uint32_t bits;    // of its hash (matte.h)
    bool is_again;    // an earlier one has the same name: they share a matte
};

struct aov_names {
    struct aov_name *objects, *materials;
    uint32_t object_count, material_count;
};

void aov_names_make(const struct session *session, struct arena *arena, struct aov_names *out);
// The table as JSON: {"objects": [{"id": 1, "name": ..., "kind": ..., "place": ..., "hash": ...}, ...],
// "materials": [...]}.
void aov_names_json(const struct aov_names *names, struct source_set *sources, struct strbuf *out);
// The manifest of Cryptomatte: {"name":"hash", ...}, each name once.
void aov_manifest(const struct aov_name *names, uint32_t count, struct strbuf *out);

#endif
