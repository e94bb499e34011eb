// The table's rows for the scene: what a file holds.
#include "grammar/schema_field.h"
#include "grammar/schema_rows.h"

// A row reads as a unit, its columns in lines of text.
// clang-format off
static const struct schema_row scene_rows[] = {
    {.name = "glint", FIELD(ir_scene, version), .example = "1", .range = SCHEMA_RANGE_VERSION, .plain = true,
     .required = true, .doc = "Version of the language: 1."},
    {.name = "description", FIELD(ir_scene, description), .example = "A glass ball", .text = SCHEMA_TEXT_FREE,
     .also = "title comment comments note notes author",
     .doc = "Free text."},
    {.name = "include", .element = "Include", FIELD(ir_scene, includes), .many = SCHEMA_SEQUENCE,
     .also = "import",
     .child = &SCHEMA_INCLUDE, .doc = "Scene files that are part of this one."},
    {.name = "parameter", .element = "Parameter", .plural = "parameters", FIELD(ir_scene, parameters), .many = SCHEMA_NAMED_MAP,
     .also = "variable variables param params constant constants define defines let var vars", .aside = true,
     .child = &SCHEMA_PARAMETER, .doc = "Values with names, which expressions of the scene use."},
    {.name = "image", .element = "Image", FIELD(ir_scene, image), .child = &SCHEMA_IMAGE,
     .also = "film output picture resolution",
     .doc = "The picture."},
    {.name = "trace", .element = "Trace", FIELD(ir_scene, trace), .child = &SCHEMA_TRACE,
     .also = "tracer render renderer settings integrator",
     .doc = "The tracer's settings."},
    {.name = "background", .element = "Background", FIELD(ir_scene, background), .child = &SCHEMA_BACKGROUND,
     .also = "sky environment env world skybox",
     .doc = "What rays that hit no body see."},
    {.name = "ambient", .element = "Ambient", FIELD(ir_scene, ambient), .child = &SCHEMA_AMBIENT,
     .also = "ambient_light ambient_color",
     .doc = "Light that comes from everywhere."},
    {.name = "camera", .element = "Camera", .plural = "cameras", FIELD(ir_scene, cameras),
     .also = "eye viewpoint view",
     .many = SCHEMA_NAMED_MAP, .single = "main", .child = &SCHEMA_CAMERA, .doc = "Points of view."},
    LIGHTS(ir_scene),
    {.name = "material", .element = "Material", .plural = "materials", FIELD(ir_scene, materials),
     .also = "shader shaders bsdf bsdfs",
     .many = SCHEMA_NAMED_MAP, .child = &SCHEMA_MATERIAL, .doc = "Materials by name."},
    {.name = "mesh", .element = "Mesh", .plural = "meshes", FIELD(ir_scene, meshes), .example_alone = true,
     .also = "geometry geometries",
     .many = SCHEMA_NAMED_MAP, .child = &SCHEMA_MESH, .doc = "Meshes that models show, by name."},
    BODIES(ir_scene),
    {.name = "object", .element = "Object", .plural = "objects", FIELD(ir_scene, objects), .example_alone = true,
     .also = "prototype prototypes symbol symbols component components definition definitions template templates",
     .many = SCHEMA_NAMED_MAP, .child = &SCHEMA_OBJECT, .aside = true,
     .doc = "Things made of bodies and lights, by name; instances show them."},
    INSTANCES(ir_scene),
    {.name = "animation", .element = "Animation", FIELD(ir_scene, animation), .child = &SCHEMA_ANIMATION,
     .also = "animate motion keyframes timeline", .doc = "How values move from frame to frame."},
};
const struct schema_element SCHEMA_SCENE = {
    ELEMENT("scene", "Scene", ir_scene, scene_rows, "The root of a scene file.")};
// clang-format on
