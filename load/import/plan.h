// What `glint import` writes: a scene, and beside it the images that the glTF file holds.
//
// Errors: false if the document has errors, which its file has reported. Ownership: all of it is in the
// document's arena, and lives as long. Thread safety: one thread.
#ifndef GLINT_LOAD_IMPORT_PLAN_H
#define GLINT_LOAD_IMPORT_PLAN_H

#include "core/strbuf.h"
#include "load/import/import.h"

enum import_spelling {
    IMPORT_YAML,
    IMPORT_XML,
    IMPORT_JSON
};

struct import_file {
    str path; // with a NUL after it
    str bytes;
};

struct import_plan {
    struct ir_scene *scene;
    struct {
        struct import_file *items;
        uint32_t count, capacity;
    } images; // beside the scene
    str mesh; // as the scene names it
};

// `out`: the path that the scene will have; empty: it is not written to a file, and materials stay in the
// glTF file.
// `around`: import_around.
bool import_plan_make(struct gltf_document *document, const struct ir_scene *around, str out,
                      struct import_plan *plan);
void import_plan_write(const struct import_plan *plan, enum import_spelling spelling, struct strbuf *text);

#endif
