// The rows of the table for meshes that the scene describes.
#include "grammar/ir.h"
#include "grammar/schema.h"
#include "grammar/schema_field.h"

static const char *const curve_words[] = {"linear", "smooth", NULL};
static const char *const curve_docs[] = {"Straight lines from point to point.",
                                         "A smooth curve through the points.", NULL};
static const char *const align_words[] = {"left", "center", "right", NULL};
static const char *const align_docs[] = {"The lines begin at x = 0.", "The lines have their middle at x = 0.",
                                         "The lines end at x = 0.", NULL};

// A row reads as a unit, its columns in lines of text.
// clang-format off
static const struct schema_row point_rows[] = {
    {.name = "at", .element = "At", FIELD(ir_outline_point, at), .example = "1 0.5", .unit = SCHEMA_UNIT_SCENE,
     .range = SCHEMA_RANGE_COORDINATE, .required = true, .short_form = true,
     .doc = "The point: x to the right, y upwards."},
};
const struct schema_element SCHEMA_OUTLINE_POINT = {
    ELEMENT("point", "Point", ir_outline_point, point_rows, "A point of an outline.")};

static const struct schema_row lathe_rows[] = {
    {.name = "point", .element = "Point", .plural = "profile", FIELD(ir_lathe, profile), .example = "0 0, 1 0.2, 0 1",
     .also = "points outline contour curve_points", .many = SCHEMA_SEQUENCE, .child = &SCHEMA_OUTLINE_POINT, .required = true,
     .doc = "The outline that is turned around the y axis: x is the distance from the axis, y the height."},
    {.name = "curve", FIELD(ir_lathe, curve), .example = "smooth", .words = curve_words, .word_docs = curve_docs,
     .also = "interpolation spline type", .standard = "linear", .doc = "What lies between the points."},
    {.name = "angle", FIELD(ir_lathe, angle), .example = "270", .unit = SCHEMA_UNIT_DEGREES, .also = "sweep degrees arc",
     .range = SCHEMA_RANGE_TURN, .standard = "360",
     .doc = "How far the profile is turned; less than a whole turn is closed by flat ends."},
};
const struct schema_element SCHEMA_LATHE = {
    ELEMENT("lathe", "Lathe", ir_lathe, lathe_rows,
            "What a profile becomes that is turned around the y axis: a bowl, a glass, a chess piece.")};

static const struct schema_row torus_rows[] = {
    {.name = "radius", FIELD(ir_torus, radius), .example = "1", .unit = SCHEMA_UNIT_SCENE, .also = "r major_radius major",
     .range = SCHEMA_RANGE_LENGTH, .required = true, .doc = "From the middle to the middle of the tube."},
    {.name = "tube", FIELD(ir_torus, tube), .example = "0.2", .unit = SCHEMA_UNIT_SCENE,
     .also = "minor_radius minor thickness tube_radius",
     .range = SCHEMA_RANGE_LENGTH, .required = true, .doc = "Radius of the tube; at most 'radius'."},
};
const struct schema_element SCHEMA_TORUS = {
    ELEMENT("torus", "Torus", ir_torus, torus_rows, "A ring around the y axis.")};

static const struct schema_row hole_rows[] = {
    {.name = "point", .element = "Point", .plural = "outline", FIELD(ir_hole, points), .example = "0.4 0.1, 0.8 0.1, 0.8 0.5", .short_form = true,
     .also = "points contour", .many = SCHEMA_SEQUENCE, .child = &SCHEMA_OUTLINE_POINT, .required = true, .doc = "The hole's points, in either sense."},
};
const struct schema_element SCHEMA_HOLE = {ELEMENT("hole", "Hole", ir_hole, hole_rows, "A hole in an outline.")};

static const struct schema_row extrude_rows[] = {
    {.name = "point", .element = "Point", .plural = "outline", FIELD(ir_extrude, outline), .example = "0 0, 1 0, 1 1",
     .also = "points profile contour shape polygon", .many = SCHEMA_SEQUENCE, .child = &SCHEMA_OUTLINE_POINT, .required = true,
     .doc = "The outline's points, in either sense; the last is joined to the first."},
    {.name = "hole", .element = "Hole", .plural = "holes", FIELD(ir_extrude, holes), .example_alone = true, .also = "cutouts inner",
     .many = SCHEMA_SEQUENCE, .child = &SCHEMA_HOLE,
     .doc = "Further outlines: what lies in an even number of them is left out."},
    {.name = "curve", FIELD(ir_extrude, curve), .example = "smooth", .example_alone = true, .words = curve_words, .word_docs = curve_docs,
     .also = "interpolation spline type", .standard = "linear", .doc = "What lies between the points."},
    {.name = "height", FIELD(ir_extrude, height), .example = "0.5", .unit = SCHEMA_UNIT_SCENE, .also = "depth length thickness",
     .range = SCHEMA_RANGE_LENGTH, .required = true, .doc = "How far the outline is drawn along z, from 0 on."},
    {.name = "bevel", FIELD(ir_extrude, bevel), .example = "0.02", .unit = SCHEMA_UNIT_SCENE, .also = "chamfer",
     .range = SCHEMA_RANGE_SIZE, .standard = "0", .doc = "How far the edges are cut off, at 45 degrees."},
};
const struct schema_element SCHEMA_EXTRUDE = {
    ELEMENT("extrude", "Extrude", ir_extrude, extrude_rows, "An outline in the x,y plane, drawn along z: a gable, a letter, a star.")};

static const struct schema_row vertex_rows[] = {
    {.name = "at", .element = "At", FIELD(ir_vertex, at), .example = "1 0 0", .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE,
     .required = true, .short_form = true, .doc = "The vertex."},
};
const struct schema_element SCHEMA_VERTEX = {ELEMENT("vertex", "Vertex", ir_vertex, vertex_rows, "A vertex of a mesh.")};
static const struct schema_row uv_rows[] = {
    {.name = "at", .element = "At", FIELD(ir_coordinate, at), .example = "1 0", .range = SCHEMA_RANGE_SHIFT, .required = true, .short_form = true,
     .doc = "The place in an image: u to the right, v upwards, an image from 0 to 1."},
};
const struct schema_element SCHEMA_UV = {
    ELEMENT("uv", "Uv", ir_coordinate, uv_rows, "The place in an image of a vertex.")};
static const struct schema_row corner_rows[] = {
    {.name = "vertex", FIELD(ir_corner, vertex), .example = "2", .range = SCHEMA_RANGE_CORNER, .required = true, .short_form = true,
     .also = "index v", .doc = "Number of a vertex, from 0."},
};
const struct schema_element SCHEMA_CORNER = {ELEMENT("corner", "Corner", ir_corner, corner_rows, "A corner of a face.")};
static const struct schema_row face_rows[] = {
    {.name = "corner", .element = "Corner", .plural = "corners", FIELD(ir_face, corners), .example = "0, 1, 2", .short_form = true,
     .also = "indices vertices", .many = SCHEMA_SEQUENCE, .child = &SCHEMA_CORNER, .required = true,
     .doc = "The face's vertices by number, at least three, counter-clockwise as seen from outside."},
};
const struct schema_element SCHEMA_FACE = {ELEMENT("face", "Face", ir_face, face_rows, "A face of a mesh.")};
static const struct schema_row faces_rows[] = {
    {.name = "vertex", .element = "Vertex", .plural = "vertices", FIELD(ir_faces, vertices), .example = "0 0 0, 1 0 0, 0 1 0", .also = "points positions verts",
     .many = SCHEMA_SEQUENCE, .child = &SCHEMA_VERTEX, .required = true, .doc = "The vertices, which faces name by their number."},
    {.name = "uv", .element = "Uv", .plural = "uv", FIELD(ir_faces, uv), .example = "0 0, 1 0, 0 1", .also = "uvs texcoords texture_coordinates",
     .many = SCHEMA_SEQUENCE, .child = &SCHEMA_UV, .doc = "Places in an image, one of each vertex."},
    {.name = "face", .element = "Face", .plural = "faces", FIELD(ir_faces, faces), .example = "0 1 2", .also = "triangles polygons indices",
     .many = SCHEMA_SEQUENCE, .child = &SCHEMA_FACE, .required = true, .doc = "The faces, of three vertices or more."},
};
const struct schema_element SCHEMA_FACES = {
    ELEMENT("faces", "Faces", ir_faces, faces_rows, "Vertices, and the faces between them.")};

static const struct schema_row text_rows[] = {
    {.name = "string", FIELD(ir_text, string), .example = "AHA", .also = "text label content value", .required = true,
     .doc = "What is written; lines end where it has a line end."},
    {.name = "font", FIELD(ir_text, font), .example = "letters.ttf", .text = SCHEMA_TEXT_PATH, .file = SCHEMA_FILE_FONT,
     .also = "typeface font_file", .required = true, .doc = "Path of a TrueType or OpenType file."},
    {.name = "height", FIELD(ir_text, height), .example = "0.4", .unit = SCHEMA_UNIT_SCENE, .also = "size font_size",
     .range = SCHEMA_RANGE_LENGTH, .standard = "1", .doc = "Height of a capital letter."},
    {.name = "depth", FIELD(ir_text, depth), .example = "0.1", .unit = SCHEMA_UNIT_SCENE, .also = "thickness extrude",
     .range = SCHEMA_RANGE_LENGTH, .standard = "0.1", .doc = "How far the letters are drawn along z, from 0 on."},
    {.name = "bevel", FIELD(ir_text, bevel), .example = "0.01", .unit = SCHEMA_UNIT_SCENE, .also = "chamfer",
     .range = SCHEMA_RANGE_SIZE, .standard = "0", .doc = "How far the edges are cut off, at 45 degrees."},
    {.name = "align", FIELD(ir_text, align), .example = "center", .words = align_words, .word_docs = align_docs,
     .also = "justify alignment halign", .standard = "left", .doc = "Where the lines are, along x."},
};
const struct schema_element SCHEMA_MESH_TEXT = {
    ELEMENT("text", "Text", ir_text, text_rows, "Letters of a font, drawn along z; the first line stands on y = 0.")};

static const struct schema_row mesh_rows[] = {
    {.name = "name", FIELD(ir_mesh, name), .example = "bowl", .text = SCHEMA_TEXT_NAME, .key = true, .also = "id",
     .doc = "Name that models use."},
    {.name = "lathe", .element = "Lathe", FIELD(ir_mesh, lathe), .child = &SCHEMA_LATHE, .choice = 1, .alternative = IR_MESH_LATHE,
     .also = "revolve revolution sor surface_of_revolution turn", .doc = "A profile turned around the y axis."},
    {.name = "torus", .element = "Torus", FIELD(ir_mesh, torus), .child = &SCHEMA_TORUS, .choice = 1, .alternative = IR_MESH_TORUS,
     .also = "ring donut", .doc = "A ring around the y axis."},
    {.name = "extrude", .element = "Extrude", FIELD(ir_mesh, extrude), .child = &SCHEMA_EXTRUDE, .choice = 1,
     .alternative = IR_MESH_EXTRUDE, .also = "extrusion prism linear_extrude", .doc = "An outline drawn along z."},
    {.name = "faces", .element = "Faces", FIELD(ir_mesh, faces), .child = &SCHEMA_FACES, .choice = 1, .alternative = IR_MESH_FACES,
     .also = "polyhedron polygons triangles", .doc = "Vertices, and the faces between them."},
    {.name = "text", .element = "Text", FIELD(ir_mesh, text), .child = &SCHEMA_MESH_TEXT, .choice = 1, .alternative = IR_MESH_TEXT,
     .also = "letters label string", .doc = "Letters of a font."},
    {.name = "tolerance", FIELD(ir_mesh, tolerance), .example = "0.0001", .range = SCHEMA_RANGE_TOLERANCE, .standard = "0.001",
     .also = "accuracy deviation detail segments",
     .doc = "How far facets may be from the curved surface, as a share of its size."},
};
const struct schema_element SCHEMA_MESH = {
    ELEMENT("mesh", "Mesh", ir_mesh, mesh_rows, "A mesh that the scene describes."),
    .choices = {{SCHEMA_CHOICE_EXACTLY_ONE, offsetof(struct ir_mesh, kind)}}};
