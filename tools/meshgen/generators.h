// What glint-meshgen can make. Each generator is deterministic: the same bytes on every run.
//
// Meshes are y up and rest on, or are centred at, y = 0; sizes are about one unit. A generator leaves
// `mesh->failed` set where memory ended.
#ifndef GLINT_MESHGEN_GENERATORS_H
#define GLINT_MESHGEN_GENERATORS_H

#include "tools/meshgen/mesh.h"

// A ribbon that follows a trefoil knot and turns as it goes: smooth, one sided to the eye, closed.
void sculpture_generate(struct mesh *mesh);

// A round brilliant of 73 facets, girdle radius 1, culet down.
void gem_generate(struct mesh *mesh);

// A sitting fox that looks along +z, about 1.2 high, standing on y = 0.
void fox_generate(struct mesh *mesh);
// The colours of the fox, for its MTL.
void fox_write_mtl(struct strbuf *text);

// "glint" in letters of our own, extruded along z with a rounded edge; baseline at y = 0.
void word_generate(struct mesh *mesh);

// A vase turned from a profile, 1.35 high, with a wall, standing on y = 0; 16 sides, no normals.
void vase_generate(struct mesh *mesh);

// A drinking glass, 1 high, with a thick bottom, standing on y = 0; what is in it, whose wall lies in the
// middle of the glass's own; the same of a low, heavy glass, 0.9 high; and a cube of ice around the origin.
// The glasses have 48 and 64 sides and no normals.
void tumbler_generate(struct mesh *mesh);
void drink_generate(struct mesh *mesh);
void rocks_generate(struct mesh *mesh);
void whisky_generate(struct mesh *mesh);
void ice_generate(struct mesh *mesh);

// Chess pieces and a plinth, the pawn about 1 high, standing on y = 0; a column, 4 high; a bowl, 0.6 high and
// about 2 wide; an urn, 1.35 high; rings around the y axis of radius 1, 0.4 and 0.1 thick: all without
// normals.
void pawn_generate(struct mesh *mesh);
void rook_generate(struct mesh *mesh);
void bishop_generate(struct mesh *mesh);
void queen_generate(struct mesh *mesh);
void king_generate(struct mesh *mesh);
void plinth_generate(struct mesh *mesh);
void column_generate(struct mesh *mesh);
void bowl_generate(struct mesh *mesh);
void urn_generate(struct mesh *mesh);
void ring_generate(struct mesh *mesh);
void hoop_generate(struct mesh *mesh);

// A block of water, 1 x 1, 1 deep, whose rippled surface lies around y = 0.
void water_generate(struct mesh *mesh);

// A TrueType font of letters, figures and signs for labels; false: no memory.
bool font_generate(struct strbuf *bytes);

// Equirectangular sky, mountains and lake: width * height RGB bytes (sRGB), width twice the height.
// The caller frees the result; NULL: out of memory.
unsigned char *sky_generate(int width, int height);

// Planks of wood that repeat without a seam; NULL: no memory. 8-bit sRGB, the caller frees it.
unsigned char *planks_generate(int side);
// Land and sea of a globe, by longitude and latitude, as a sphere shows it; the same.
unsigned char *globe_generate(int width, int height);

#endif
