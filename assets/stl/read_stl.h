// STL, ascii and binary: text or bytes to polygons whose corners share vertices.
//
// The file gives every corner by its position and shares no vertices. Here corners whose three coordinates
// are bit-equal, 0 and -0 being the same, are one vertex, numbered by first occurrence; nothing is joined by
// nearness. Facet normals are not used, right or wrong: the order of a face's corners says which way it
// points, and the normals of smooth models are computed. There are no units. In an ascii file with several
// solids, each `solid` with a name is a group. Counted as losses: the attribute bytes, where some programs
// put a colour; bytes after the last facet. Whether a file is ascii or binary follows from its bytes, not
// from its first word: many binary files begin with `solid`. Errors: every fault, at its line, or at its byte
// in a binary file; counted in file->errors, after which the result must not be used. Ownership: all is in
// the scratch arena, names in the text. Thread safety: one call belongs to one thread.
#ifndef GLINT_ASSETS_STL_READ_STL_H
#define GLINT_ASSETS_STL_READ_STL_H

#include "assets/file/asset_file.h"
#include "assets/file/polygons.h"

void read_stl(struct asset_file *file, struct arena *scratch, struct polygons *out);

#endif
