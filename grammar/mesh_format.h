// The formats of mesh files, as mesh_formats.def has them: the one place that knows which files are meshes.
//
// Input: a path, or the beginning of a file. Output: constant data, or words in an arena. Errors: none; what
// is not a mesh has no format. Thread safety: pure.
#ifndef GLINT_GRAMMAR_MESH_FORMAT_H
#define GLINT_GRAMMAR_MESH_FORMAT_H

#include "core/arena.h"
#include "core/str.h"

enum mesh_format_id {
#define MESH_FORMAT(id, ...) MESH_FORMAT_##id,
#include "grammar/mesh_formats.def"
#undef MESH_FORMAT
    MESH_FORMAT_COUNT // also: no format
};

// What a file of the format can contain besides positions and faces, and how its programs orient bodies.
enum mesh_traits {
    MESH_HOLDS_NORMALS = 1,     // of corners
    MESH_HOLDS_COORDINATES = 2, // of textures
    MESH_HOLDS_MATERIALS = 4,   // by itself, or in files that it names
    MESH_HOLDS_PARTS = 8,       // with names, so that 'material_map' can give each its material
    MESH_Z_UP = 16,             // the third axis points upwards; else the second
    MESH_HOLDS_BODIES = 32,     // several bodies, of which 'part' chooses one
};

struct mesh_format {
    const char *name;           // "Wavefront OBJ"
    const char *called;         // "a Wavefront OBJ mesh"
    const char *const *endings; // of file names, with their dots, the usual one first; NULL at the end
    const char *const *magic;   // what a file begins with; NULL at the end
    unsigned traits;            // of enum mesh_traits
};

extern const struct mesh_format mesh_formats[MESH_FORMAT_COUNT];
// The endings of all of them; NULL at the end.
extern const char *const mesh_format_endings[];

// By the ending of a path, without regard to case.
enum mesh_format_id mesh_format_of_path(str path);
// By how a file begins.
enum mesh_format_id mesh_format_of_text(str text);
// All formats: "Wavefront OBJ (.obj)", with commas and an "or" between several.
str mesh_format_words(struct arena *arena);

#endif
