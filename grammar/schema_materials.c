// The rows of the table for materials, and what is painted on them.
#include "grammar/ir.h"
#include "grammar/schema.h"
#include "grammar/schema_field.h"
#include "picture/formats/formats.h"
#include "shaders/features.h"

static const char *const filter_words[] = {"auto", "nearest", "bilinear", NULL};
static const char *const filter_docs[] = {
    "The mean of what lies in the pixel's footprint: nothing shimmers from afar.",
    "The pixel of the image at the place: hard edges from near.",
    "Between the four pixels around the place, however far away they are.", NULL};
static const char *const wrap_words[] = {"repeat", "clamp", "mirror", NULL};
static const char *const wrap_docs[] = {"The image begins anew.", "The image's edge goes on.",
                                        "The image begins anew, every other one mirrored.", NULL};

// grammar/presets.def: the words, and what each stands for as a sentence.
static const char *const preset_words[] = {"none",
#define PRESET(word, name, values) #word,
#include "grammar/presets.def"
#undef PRESET
                                           NULL};
static const char *const preset_docs[] = {"What is not written has its default.",
#define PRESET(word, name, values) name values ".",
#define VALUE(row, value)          ", " row " " value
#include "grammar/presets.def"
#undef VALUE
#undef PRESET
                                          NULL};

// A row reads as a unit, its columns in lines of text.
// clang-format off
static const struct schema_row checker_rows[] = {
    {.name = "color", .element = "Color", .plural = "colors", FIELD_PAIR(ir_checker, colors),
     .example = "0.9 0.9 0.9", .example_next = "0.1 0.1 0.3", .range = SCHEMA_RANGE_WEIGHT, .required = true,
     .doc = "The two colours; the cell at the origin has the first."},
    {.name = "size", FIELD(ir_checker, size), .example = "2", .unit = SCHEMA_UNIT_SCENE,
     .also = "scale width cell_size",
     .range = SCHEMA_RANGE_LENGTH, .standard = "1",
     .doc = "Edge length of a cell: on a rectangle along its edges, on other bodies in their own coordinates."},
    {.name = "antialias", FIELD(ir_checker, antialias), .standard = "false", .feature = FEATURE_FOOTPRINT,
     .also = "filter smooth antialiasing",
     .doc = "Whether cells smaller than a pixel's footprint blend into the mean of the two colours."},
};
const struct schema_element SCHEMA_CHECKER = {
    ELEMENT("checker", "Checker", ir_checker, checker_rows, "Cells of two alternating colours.")};

static const struct schema_row texture_rows[] = {
    {.name = "file", FIELD(ir_texture, file), .example = "wood.jpg", .text = SCHEMA_TEXT_PATH,
     .also = "path src href image texture map filename", .file = SCHEMA_FILE_IMAGE, .required = true,
     .short_form = true, .feature = FEATURE_TEXTURES,
     .doc = "Path of an image: " IMAGE_IN_SCENE_NAMES "."},
    {.name = "repeat", .element = "Repeat", FIELD(ir_texture, repeat), .example = "2 2",
     .also = "scale tiling tile times", .range = SCHEMA_RANGE_REPEAT, .standard = "1 1", .fill = true,
     .doc = "How often the image lies side by side where the surface's coordinates go from 0 to 1."},
    {.name = "offset", .element = "Offset", FIELD(ir_texture, offset), .example = "0.5 0",
     .also = "translation shift position", .range = SCHEMA_RANGE_SHIFT, .standard = "0 0",
     .doc = "Moves the image, in the surface's coordinates, after it is turned."},
    {.name = "rotation", FIELD(ir_texture, rotation), .example = "90", .unit = SCHEMA_UNIT_DEGREES,
     .also = "rotate angle turn", .range = SCHEMA_RANGE_ANGLE, .standard = "0",
     .doc = "Turns the image counterclockwise about the middle of the surface's coordinates."},
    {.name = "filter", FIELD(ir_texture, filter), .example = "nearest", .words = filter_words,
     .also = "interpolation filtering mipmap", .word_docs = filter_docs, .standard = "auto",
     .feature = FEATURE_FOOTPRINT, .feature_of_first = true,
     .doc = "How a colour is made of the pixels of the image."},
    {.name = "wrap", FIELD(ir_texture, wrap), .example = "mirror", .words = wrap_words,
     .also = "extension wrapping extend", .word_docs = wrap_docs, .standard = "repeat",
     .doc = "What lies beside the image."},
};
const struct schema_element SCHEMA_TEXTURE = {
    ELEMENT("texture", "Texture", ir_texture, texture_rows, "An image on a surface.")};

static const struct schema_row highlight_rows[] = {
    {.name = "color", .element = "Color", FIELD(ir_highlight, color), .example = "1 0.9 0.8",
     .range = SCHEMA_RANGE_WEIGHT, .choice = 1, .alternative = IR_PAINT_COLOR, .standard = "1 1 1",
     .short_form = true, .doc = "One colour everywhere."},
    {.name = "image", .element = "Image", FIELD(ir_highlight, image), .child = &SCHEMA_TEXTURE, .choice = 1,
     .also = "texture map bitmap", .alternative = IR_PAINT_IMAGE, .doc = "The colours of an image file."},
};
const struct schema_element SCHEMA_HIGHLIGHT = {
    ELEMENT("highlight", "Highlight", ir_highlight, highlight_rows, "A colour, or an image."),
    .choices = {{SCHEMA_CHOICE_AT_MOST_ONE, offsetof(struct ir_highlight, kind)}}};

static const struct schema_row paint_rows[] = {
    {.name = "color", .element = "Color", FIELD(ir_paint, color), .example = "0.4 0.4 0.3",
     .range = SCHEMA_RANGE_WEIGHT, .choice = 1, .alternative = IR_PAINT_COLOR, .standard = "0.8 0.8 0.8",
     .short_form = true, .doc = "One colour everywhere."},
    {.name = "checker", .element = "Checker", FIELD(ir_paint, checker), .child = &SCHEMA_CHECKER, .choice = 1,
     .alternative = IR_PAINT_CHECKER, .feature = FEATURE_CHECKER, .doc = "Cells of two colours."},
    {.name = "image", .element = "Image", FIELD(ir_paint, image), .child = &SCHEMA_TEXTURE, .choice = 1,
     .also = "texture map bitmap", .alternative = IR_PAINT_IMAGE, .doc = "The colours of an image file."},
};
const struct schema_element SCHEMA_PAINT = {
    ELEMENT("paint", "Paint", ir_paint, paint_rows, "A colour, a pattern of colours, or an image."),
    .choices = {{SCHEMA_CHOICE_AT_MOST_ONE, offsetof(struct ir_paint, kind)}}};

static const struct schema_row material_rows[] = {
    {.name = "name", FIELD(ir_material, name), .example = "glass",
     .also = "id", .text = SCHEMA_TEXT_NAME, .key = true,
     .doc = "Name for references."},
    {.name = "preset", FIELD(ir_material, preset), .words = preset_words, .word_docs = preset_docs, .standard = "none",
     .example = "gold", .example_alone = true, .also = "base template based_on",
     .doc = "A material that is known by its name: what is not written beside it has that material's values."},
    {.name = "albedo", .element = "Albedo", FIELD(ir_material, albedo), .example = "0 0.5 0.1 0.8",
     .range = SCHEMA_RANGE_WEIGHT, .standard = "1 0 0 0",
     .weight_features = {FEATURE_DIFFUSE, FEATURE_SPECULAR, FEATURE_REFLECTION, FEATURE_REFRACTION},
     .doc = "Weights of diffuse light, highlights, reflection and refraction; their sum may exceed 1."},
    {.name = "diffuse_color", .element = "DiffuseColor", FIELD(ir_material, diffuse_color),
     .also = "color base_color albedo_color kd diffuse",
     .child = &SCHEMA_PAINT, .doc = "Colour of the diffuse light."},
    {.name = "specular_color", .element = "SpecularColor", FIELD(ir_material, specular_color),
     .also = "ks highlight_color",
     .child = &SCHEMA_HIGHLIGHT,
     .doc = "Colour of the highlights."},
    {.name = "reflection_color", .element = "ReflectionColor", FIELD(ir_material, reflection_color),
     .also = "mirror_color reflection_tint metal_color", .example = "1 0.78 0.34", .range = SCHEMA_RANGE_FRACTION,
     .standard = "1 1 1", .feature = FEATURE_REFLECTION_COLOR,
     .doc = "Colour of what the surface mirrors; highlights keep 'specular_color'. A metal has it straight on."},
    {.name = "metal", FIELD(ir_material, metal), .standard = "false", .example = "true", .example_alone = true,
     .also = "metallic metalness metallicness conductor", .feature = FEATURE_REFLECTION_COLOR,
     .doc = "Whether the surface mirrors as metals do: 'reflection_color' straight on, and the whiter the more "
            "grazing the light is (Schlick's form of Fresnel's equations)."},
    {.name = "emission", .element = "Emission", FIELD(ir_material, emission), .example = "1 0.8 0.5",
     .also = "emissive emission_color emissive_color ke glow",
     .range = SCHEMA_RANGE_WEIGHT, .standard = "0 0 0", .feature = FEATURE_EMISSION,
     .doc = "Colour that is added to what is seen of the surface, by the camera and in mirrors. It lights nothing: put a light there too."},
    {.name = "specular_exponent", FIELD(ir_material, specular_exponent), .example = "125",
     .also = "shininess exponent ns phong_exponent glossiness",
     .range = SCHEMA_RANGE_EXPONENT, .standard = "32",
     .doc = "Sharpness of the highlights: a larger value makes them smaller and sharper (Phong's exponent)."},
    {.name = "refractive_index", FIELD(ir_material, refractive_index), .example = "1.5",
     .also = "ior index index_of_refraction eta ni",
     .range = SCHEMA_RANGE_INDEX, .standard = "1",
     .doc = "Bends refracted rays: 1 air, 1.33 water, 1.5 glass, 2.42 diamond."},
    {.name = "fresnel", FIELD(ir_material, fresnel), .standard = "false", .example = "true",
     .also = "fresnel_reflection schlick", .feature = FEATURE_FRESNEL,
     .doc = "Whether reflection and refraction depend on the angle, by Fresnel's equations: their weights are "
            "multiplied by the shares of light that the surface reflects and lets through."},
    {.name = "roughness", FIELD(ir_material, roughness), .example = "0.3", .range = SCHEMA_RANGE_FRACTION,
     .also = "rough glossy gloss microfacet specular_roughness", .standard = "0",
     .feature = FEATURE_ROUGHNESS,
     .doc = "How much reflected and refracted rays are spread: 0 is a clear mirror or clear glass, 0.3 brushed metal "
            "or frosted glass."},
    {.name = "priority", FIELD(ir_material, priority), .range = SCHEMA_RANGE_PRIORITY, .standard = "0",
     .also = "dielectric_priority interior_priority nested_priority order",
     .doc = "Where bodies that refract overlap, the one of the highest priority fills the place; of equal ones "
            "the one entered last."},
    {.name = "attenuation_color", .element = "AttenuationColor", FIELD(ir_material, attenuation_color),
     .also = "transmittance_color absorption_color transmission_color tint interior_color volume_color",
     .example = "0.5 0.8 0.9", .range = SCHEMA_RANGE_FRACTION, .standard = "1 1 1",
     .feature = FEATURE_ATTENUATION,
     .doc = "What is left of white light after 'attenuation_distance' inside a sphere or closed mesh; 1 is clear."},
    {.name = "attenuation_distance", FIELD(ir_material, attenuation_distance),
     .also = "transmittance_distance at_distance absorption_distance depth thickness",
     .example = "2", .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_LENGTH, .standard = "1",
     .doc = "The way inside after which white light has 'attenuation_color'."},
};
const struct schema_element SCHEMA_MATERIAL = {
    ELEMENT("material", "Material", ir_material, material_rows,
            "How a surface responds to light: the weights and colours of tinyraytracer's materials.")};
// clang-format on
