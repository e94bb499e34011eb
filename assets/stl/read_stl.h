// STL, ascii and binary: text or bytes to polygons whose corners share vertices.
//
// The file names every corner by its position, and no vertex twice is the same to it. Here corners whose
// three coordinates are equal to the bit, 0 and -0 being the same, are one vertex, numbered by where it comes
// first; nothing is joined by nearness. Facet normals are not used, right or wrong: which way a face points
// is said by the order of its corners, and the normals of smooth models are computed. There are no units. Of
// an ascii file each `solid` with a name is a group, where there are several. Counted as losses: what is in
// the attribute bytes, where some programs put a colour; bytes after the last facet. Which of the two a file
// is follows from its bytes, not from its first word: many binary files begin with `solid`. Errors: every
// fault, at its line, or at its byte in a binary file; counted in file->errors, after which the result must
// not be used. Ownership: all is in the scratch arena, names in the text. Thread safety: one call belongs to
// one thread.
#ifndef GLINT_ASSETS_STL_READ_STL_H
#define GLINT_ASSETS_STL_READ_STL_H

#include "assets/file/asset_file.h"
#include "assets/file/polygons.h"

void read_stl(struct asset_file *file, struct arena *scratch, struct polygons *out);

#endif
