// STL as text. Keywords in any case; `solid`, `facet normal x y z`, `outer loop`, `vertex x y z`, `endloop`,
// `endfacet`, `endsolid`.
//
// As read_stl.h.
#ifndef GLINT_ASSETS_STL_STL_TEXT_H
#define GLINT_ASSETS_STL_STL_TEXT_H

#include "assets/file/asset_file.h"
#include "assets/stl/join.h"

void read_stl_text(struct asset_file *file, struct arena *scratch, struct polygons *out);

#endif
