// Meshes that a scene file describes instead of naming a file: bodies of revolution, rings, extruded
// outlines, lists of faces and text. From plain numbers to the polygons that readers of mesh files make, too
// (assets/file/polygons.h), which mesh_build makes a mesh of.
//
// Input: one of the structs below. Coordinates are those of the mesh: any unit, y upwards, at most
// MESH_COORDINATE_MAX; in profiles and outlines, less than PLANE_LEAST counts as 0. Output: struct made. Its
// polygons have the normals of the true surface at every corner (a model that is not smooth ignores them) and
// texture coordinates. Faces point outward where the body is closed. The same input gives the same bits.
//
// Curved surfaces become facets. `tolerance` is the greatest distance from the facets to the true surface, as
// a share of the body's size: of the largest radius (lathe), of radius and tube together (torus), of half of
// the longer side of the outlines' box (extrude), of the letters' height (text). The default is
// MADE_TOLERANCE. Numbers of facets are clamped: a whole turn has 8 to MADE_COLUMNS_MOST columns, one piece
// of a curve becomes 1 to MADE_PIECES_MOST straight ones.
//
// Errors: false, and out->fault says what is wrong, which entries are to blame and where; only triangle_count
// is set then. Ownership: all is in to->arena, which must be guarded; what a build needs for itself
// stays there, too. Thread safety: one call belongs to one thread; there is no shared state.
#ifndef GLINT_ASSETS_MADE_MADE_H
#define GLINT_ASSETS_MADE_MADE_H

#include "assets/file/polygons.h"
#include "core/arena.h"

#define MADE_TOLERANCE      1e-3
#define MADE_TOLERANCE_MOST 0.5

enum {
    MADE_COLUMNS_MOST = 4096,
    MADE_PIECES_MOST = 256,
    MADE_POINTS_MOST = 1 << 18, // of all outlines or of a profile, after curves became straight pieces
    MADE_TEXT_MOST = 1 << 16,   // bytes of a text
};

enum made_code {
    MADE_FINE,
    MADE_POINTS_FEW,   // a profile has fewer than 2 different points, an outline fewer than 3
    MADE_POINTS_MANY,  // more than MADE_POINTS_MOST; a text with more than MADE_TEXT_MOST bytes
    MADE_NUMBER,       // a number is not finite, or larger than MESH_COORDINATE_MAX
    MADE_RANGE,        // a size, an angle or a tolerance is out of its range
    MADE_RADIUS,       // a point of a profile has a negative radius
    MADE_AXIS,         // all points of a profile are on the axis
    MADE_CURVE,        // the curve through a profile's points crosses the axis
    MADE_CROSSES,      // a profile or an outline crosses itself or another one
    MADE_TOUCHES,      // the same, but only touches it
    MADE_TUBE,         // the tube of a torus is larger than its radius
    MADE_BEVEL,        // larger than the outlines or the height allow: see made_fault.most
    MADE_EMPTY,        // nothing to build: no outline, no face, no area
    MADE_INDEX,        // a corner names a vertex that does not exist
    MADE_CORNERS_FEW,  // a face has fewer than 3 corners
    MADE_COORDINATES,  // texture coordinates are neither one per vertex nor one per corner
    MADE_TRIANGLES,    // more than made_to.triangles_most
    MADE_NO_FONTS,     // this build of glint reads no fonts
    MADE_FONT,         // the bytes are not a font with outlines
    MADE_GLYPH,        // the font has no glyph for a character
    MADE_GLYPH_BROKEN, // a glyph has no usable outline
    MADE_TEXT,         // the text is not UTF-8
    MADE_TEXT_EMPTY,   // the text has nothing to draw
};

enum {
    MADE_TEXT_BYTES = 200
};

struct made_fault {
    enum made_code code;
    // The entries to blame, up to two, from 0; IR_NO_INDEX: none. Of crossing pieces: the point that each
    // begins at. Of a text: points[0] is the byte that the character begins at.
    uint32_t points[2];
    uint32_t outlines[2];       // in which outlines these are; of `faces`: outlines[0] is the face
    struct ir_pair place;       // of MADE_CROSSES, MADE_TOUCHES and MADE_CURVE
    double most;                // of MADE_BEVEL: a bevel that fits; 0: none does
    char text[MADE_TEXT_BYTES]; // a sentence in lower case, without full stop; entries counted from 1
};

struct made_to {
    struct arena *arena;
    uint64_t triangles_most; // more is MADE_TRIANGLES, before memory is taken for them; 0 only counts
};

struct made {
    struct polygons polygons;
    struct textured_faces textured;
    uint64_t triangle_count; // set for MADE_TRIANGLES, too
    struct made_fault fault;
};

// Curves through points ("smooth") are centripetal Catmull-Rom splines (Yuksel, Schaefer and Keyser 2011,
// "Parameterization and applications of Catmull-Rom curves"), which pass through each point without loops or
// cusps between two of them. A point that is written twice in a row is a corner of the curve. At an open end
// and at a corner the piece is a parabola. Without "smooth", repeated points count once.

// A body of revolution about the y axis. The profile starts in the plane z = 0 at x = radius and turns
// counter-clockwise as seen from above (from +y), as rotations of a scene do.
// The profile either begins and ends on the axis, or its last point is its first (a ring), or the surface is
// open. A smooth profile leaves the axis at a right angle, so that poles are round; a first or last point
// that is written twice makes them pointed. A turn of less than 360 degrees gets two flat end faces, if the
// profile is closed in one of these ways.
// Texture: u is 0 to 1 around, v is 0 to 1 along the profile; on the end faces, the box of the profile.
struct made_lathe {
    const struct ir_pair *points; // radius, y
    uint32_t count;
    bool smooth;
    double angle; // degrees, more than 0, at most 360
    double tolerance;
};
bool made_build_lathe(const struct made_lathe *lathe, const struct made_to *to, struct made *out);

// A ring about the y axis. Texture: u around the axis, v around the tube from its outermost circle upwards.
struct made_torus {
    double radius; // of the tube's middle
    double tube;   // its radius; at most `radius`
    double tolerance;
};
bool made_build_torus(const struct made_torus *torus, const struct made_to *to, struct made *out);

struct made_outline {
    const struct ir_pair *points; // x, y, in either direction; the last joins the first, or repeats it
    uint32_t count;
};

// Outlines in the plane z = 0, extruded towards +z. What is inside an odd number of outlines is solid.
// Outlines must not cross or touch. `bevel` cuts all edges of both ends at 45 degrees by so much; the body
// keeps its height and, between the bevels, its outlines.
// Texture: u is 0 to 1 around each outline and v is 0 to 1 from the back up; on both ends, the outlines' box.
struct made_extrude {
    const struct made_outline *outlines;
    uint32_t count;
    bool smooth;
    double height; // more than 0
    double bevel;  // 0 to half of the height
    double tolerance;
};
bool made_build_extrude(const struct made_extrude *extrude, const struct made_to *to, struct made *out);

// Vertices and faces as they are. Faces have no normals: those of smooth models are computed.
struct made_faces {
    const vec3 *vertices;
    uint32_t vertex_count;
    const uint32_t *corners; // of all faces, one after another: into vertices
    uint32_t corner_count;
    const uint32_t *firsts; // of each face: its first corner; ascending from 0
    uint32_t face_count;
    const struct ir_pair *coordinates; // of textures; NULL: none
    uint32_t coordinate_count;         // vertex_count or corner_count
};
bool made_build_faces(const struct made_faces *faces, const struct made_to *to, struct made *out);

enum made_align {
    MADE_ALIGN_LEFT, // a line begins at x = 0
    MADE_ALIGN_CENTER,
    MADE_ALIGN_RIGHT, // a line ends at x = 0
};

// Text as a body: its front looks to +z, its back is in the plane z = 0, the baseline of the first line is
// the x axis. Kerning is that of the font's `kern` table. A line feed begins the next line, at the distance
// that the font asks for. Outlines are filled by the nonzero rule and united, also where letters overlap.
// Texture: as for outlines, which are then those of the whole text.
struct made_text {
    str text;      // UTF-8
    str font;      // the bytes of a font file that FreeType reads, with outlines
    double height; // of a capital H; more than 0
    double depth;  // along z; more than 0
    double bevel;  // 0 to half of the depth
    double tolerance;
    enum made_align align;
};
bool made_build_text(const struct made_text *text, const struct made_to *to, struct made *out);

// Whether this build of glint reads fonts.
bool made_has_fonts(void);

#endif
