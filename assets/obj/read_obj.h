// Wavefront OBJ: text to polygons, as the file has them.
//
// Read: v (three numbers), vn, f (v, v/vt, v//vn, v/vt/vn; negative indices; vertices that follow later),
// usemtl, mtllib. Ignored: vt, vp, o, g, s and the like. Counted as losses: colours of vertices, images of
// faces; points, lines, curves and surfaces. Every fault is reported, at its place. Ownership:
// everything is in the scratch arena and points into the text. Thread safety: one call belongs to one thread.
#ifndef GLINT_ASSETS_OBJ_READ_OBJ_H
#define GLINT_ASSETS_OBJ_READ_OBJ_H

#include "assets/file/asset_file.h"
#include "assets/file/polygons.h"

// Reads file->text, on all processors. Faults are counted in file->errors; after one the result must not be
// used.
void read_obj(struct asset_file *file, struct arena *scratch, struct polygons *out);
// Reads file->text for texture coordinates only (obj_coordinates.c).
void read_obj_coordinates(struct asset_file *file, struct arena *scratch, struct textured_faces *out);

// The two ways of reading, with bit-equal results; for tests and benches.
// By one thread, from the first line to the last.
void read_obj_in_order(struct asset_file *file, struct arena *scratch, struct polygons *out);
// In pieces of about this many bytes, at least 1, on all processors. false: the file has something that only
// the other way understands or reports; nothing was reported.
bool read_obj_in_chunks(struct asset_file *file, struct arena *scratch, size_t chunk_bytes,
                        struct polygons *out);

#endif
