// A mesh written as a file of every format that tests know, without glint's own code for them.
//
// Coordinates are written so that every reader gets the same double: in text with 17 digits, as floats where
// `single` says that they are. Errors: those of the strbuf.
#ifndef GLINT_TESTS_UNIT_MESH_KIT_H
#define GLINT_TESTS_UNIT_MESH_KIT_H

#include "core/strbuf.h"

enum mesh_kit_form {
    MESH_KIT_OBJ,
    MESH_KIT_PLY_TEXT,
    MESH_KIT_PLY_LITTLE,
    MESH_KIT_PLY_BIG,
    MESH_KIT_STL_TEXT,
    MESH_KIT_STL_BINARY,
    MESH_KIT_FORMS
};

struct mesh_kit {
    const double *positions; // three of each
    uint32_t vertex_count;
    const uint32_t *corners; // of all faces; of three each, if `counts` is NULL
    const uint32_t *counts;  // of each face
    uint32_t face_count;
    bool single; // PLY has floats; STL always has
    bool extras; // PLY has elements and properties that nobody knows, around those that are needed, and STL a
                 // binary header that begins with "solid", and normals that are wrong
};

extern const char *const mesh_kit_names[MESH_KIT_FORMS]; // "le.ply": the ending, after a word for the form
void mesh_kit_write(const struct mesh_kit *mesh, enum mesh_kit_form form, struct strbuf *out);

#endif
