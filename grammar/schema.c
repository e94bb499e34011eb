#include "grammar/schema.h"

#include "grammar/ir.h"
#include "grammar/schema_field.h"
#include "grammar/schema_rows.h"
#include "picture/formats/formats.h"
#include "shaders/features.h"

static const char *const tone_words[] = {"clip", "normalize", "neutral", "filmic", NULL};
static const char *const tone_docs[] = {
    "Values above 1 are clipped.", "A colour with a component above 1 is divided by its largest component.",
    "Colours stay as they are up to 0.8; brighter ones approach 1, and white (Khronos PBR Neutral).",
    "Dark parts are darker and bright ones roll off, as on film (the curve of Narkowicz 2015).", NULL};
static const char *const transfer_words[] = {"none", "srgb", NULL};
static const char *const transfer_docs[] = {
    "Values are displayed as they are.",
    "Values are linear light; image files, #rrggbb and the picture are sRGB.", NULL};
static const char *const depth_words[] = {"background", "black", NULL};
static const char *const depth_docs[] = {"A ray beyond 'max_depth' sees the background.",
                                         "A ray beyond 'max_depth' sees black.", NULL};
static const char *const precision_words[] = {"auto", "single", "double", NULL};
static const char *const precision_docs[] = {
    "Double where the picture needs it, else single: a small picture tells. `glint inspect` forecasts which.",
    "Always single precision.", "Always double precision: slower.", NULL};
static const char *const projection_words[] = {"perspective", "orthographic", "fisheye", "panorama", NULL};
static const char *const projection_docs[] = {
    "Straight lines stay straight; what is farther away is smaller.",
    "All rays are parallel: what is farther away is as large. Its height is 'size'.",
    "Equal angles from the view are equal distances in the picture; 'fov' may reach 360.",
    "All directions: 360 degrees of longitude across, 180 of latitude down.", NULL};
static const char *const falloff_words[] = {"none", "inverse_square", NULL};
static const char *const falloff_docs[] = {"The light is equally strong everywhere.",
                                           "The light's strength is divided by the square of the distance.",
                                           NULL};

// A row reads as a unit, its columns in lines of text.
// clang-format off
static const struct schema_row include_rows[] = {
    {.name = "file", FIELD(ir_include, file), .example = "base.yaml", .text = SCHEMA_TEXT_PATH,
     .also = "path href src name filename",
     .file = SCHEMA_FILE_SCENE, .required = true, .short_form = true,
     .doc = "Path of a scene file, YAML or XML, whose entries come before this file's."},
};
const struct schema_element SCHEMA_INCLUDE = {ELEMENT("include", "Include", ir_include, include_rows,
                                                      "Another scene file that is part of this scene.")};

static const struct schema_row image_rows[] = {
    {.name = "width", FIELD(ir_image, width), .example = "1920", .unit = SCHEMA_UNIT_PIXELS,
     .also = "w res_x xres size resolution",
     .range = SCHEMA_RANGE_EXTENT, .standard = "1024", .doc = "Width of the picture."},
    {.name = "height", FIELD(ir_image, height), .example = "1080", .unit = SCHEMA_UNIT_PIXELS,
     .also = "h res_y yres",
     .range = SCHEMA_RANGE_EXTENT, .standard = "768", .doc = "Height of the picture."},
    {.name = "samples", FIELD(ir_image, samples), .example = "64", .range = SCHEMA_RANGE_SAMPLES,
     .also = "spp aa antialiasing samples_per_pixel sample_count",
     .standard = "1", .doc = "Rays through each pixel, averaged; more of them smooth edges."},
    {.name = "error", FIELD(ir_image, error), .example = "0.01", .range = SCHEMA_RANGE_FRACTION,
     .also = "noise noise_threshold adaptive adaptive_sampling adaptive_threshold max_error",
     .standard = "0",
     .doc = "A pixel takes no more samples once the error of its displayed colour is at most this, 95 % sure; "
            "`samples` is then the most that it takes. 0: all pixels take all samples."},
    {.name = "min_samples", FIELD(ir_image, min_samples), .example = "8", .range = SCHEMA_RANGE_SAMPLES,
     .also = "samples_min min_spp",
     .standard = "16", .doc = "Samples that a pixel takes before `error` may end it."},
    {.name = "exposure", FIELD(ir_image, exposure), .example = "-0.5", .range = SCHEMA_RANGE_STOPS,
     .also = "ev stops brightness gain", .standard = "0",
     .doc = "How much brighter the picture is shown, in stops: 1 is twice as bright, -1 half. HDR files keep the scene's light."},
    {.name = "tone", FIELD(ir_image, tone), .example = "normalize", .words = tone_words,
     .also = "tonemap tone_mapping tonemapping",
     .word_docs = tone_docs, .standard = "clip",
     .doc = "What happens to colours brighter than the picture can show."},
    {.name = "transfer", FIELD(ir_image, transfer), .example = "srgb", .words = transfer_words,
     .also = "gamma color_space encoding",
     .word_docs = transfer_docs, .standard = "none",
     .doc = "How numbers in the scene relate to displayed values."},
};
const struct schema_element SCHEMA_IMAGE = {
    ELEMENT("image", "Image", ir_image, image_rows, "Size and encoding of the picture.")};

static const struct schema_row trace_rows[] = {
    {.name = "max_depth", FIELD(ir_trace, max_depth), .example = "8", .range = SCHEMA_RANGE_DEPTH,
     .also = "depth bounces max_bounces recursion max_recursion",
     .standard = "16", .doc = "Surfaces at this depth send no further rays; the camera's ray has depth 0."},
    {.name = "min_weight", FIELD(ir_trace, min_weight), .example = "0.001", .range = SCHEMA_RANGE_FRACTION,
     .standard = "0.0009765625",
     .doc = "A ray that would contribute less than this weight is not traced."},
    {.name = "depth_limit", FIELD(ir_trace, depth_limit), .example = "black", .words = depth_words,
     .word_docs = depth_docs, .standard = "background", .feature = FEATURE_DEPTH_BLACK,
     .doc = "What a ray beyond 'max_depth' sees."},
    {.name = "precision", FIELD(ir_trace, precision), .example = "double", .words = precision_words,
     .word_docs = precision_docs, .standard = "auto", .also = "float real accuracy",
     .doc = "How precisely positions and distances are computed."},
    {.name = "shadows", FIELD(ir_trace, shadows), .standard = "true", .feature = FEATURE_SHADOWS,
     .doc = "Whether bodies cast shadows."},
    {.name = "transparent_shadows", FIELD(ir_trace, transparent_shadows), .standard = "false",
     .also = "shadow_transparency colored_shadows translucent_shadows transmissive_shadows",
     .feature = FEATURE_CLEAR_SHADOWS,
     .doc = "Whether light shines through bodies that refract, straight and weakened by their weight of refraction; "
            "else they cast full shadows."},
};
const struct schema_element SCHEMA_TRACE = {
    ELEMENT("trace", "Trace", ir_trace, trace_rows, "How far rays are followed.")};

static const struct schema_row camera_rows[] = {
    {.name = "name", FIELD(ir_camera, name), .example = "main",
     .also = "id", .text = SCHEMA_TEXT_NAME, .key = true,
     .doc = "Name for --camera; the camera without a name is 'main'."},
    {.name = "position", .element = "Position", FIELD(ir_camera, position), .example = "0 2 8",
     .also = "eye origin location from center translation",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .standard = "0 0 0",
     .doc = "The camera's position."},
    {.name = "look_at", .element = "LookAt", FIELD(ir_camera, look_at), .example = "0 1 0",
     .also = "target at to looking_at interest point_of_interest",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .choice = 1, .alternative = IR_VIEW_LOOK_AT,
     .doc = "The point shown in the middle of the picture."},
    {.name = "direction", .element = "Direction", FIELD(ir_camera, direction), .example = "0 -0.2 -1",
     .also = "forward view_direction",
     .range = SCHEMA_RANGE_COORDINATE, .choice = 1, .alternative = IR_VIEW_DIRECTION, .standard = "0 0 -1",
     .doc = "The direction of view; any length except 0."},
    {.name = "rotation", .element = "Rotation", FIELD(ir_camera, rotation), .example = "-10 0 0",
     .also = "orientation rotate",
     .unit = SCHEMA_UNIT_DEGREES, .range = SCHEMA_RANGE_ANGLE, .choice = 1, .alternative = IR_VIEW_ROTATION,
     .doc = "Turns a camera that looks along -z: about x, then y, then z."},
    {.name = "up", .element = "Up", FIELD(ir_camera, up), .range = SCHEMA_RANGE_COORDINATE,
     .standard = "0 1 0", .doc = "The direction that points up in the picture."},
    {.name = "fov", FIELD(ir_camera, fov), .example = "45", .unit = SCHEMA_UNIT_DEGREES,
     .also = "angle field_of_view vfov fovy fov_y",
     .range = SCHEMA_RANGE_FOV, .standard = "60",
     .doc = "Vertical field of view; less than 180 but in a fisheye's picture."},
    {.name = "projection", FIELD(ir_camera, projection), .example = "fisheye", .words = projection_words,
     .also = "type camera_type", .word_docs = projection_docs, .standard = "perspective",
     .feature = FEATURE_CAMERA, .doc = "How directions become places in the picture."},
    {.name = "size", FIELD(ir_camera, size), .unit = SCHEMA_UNIT_SCENE,
     .also = "ortho_scale orthographic_scale view_height",
     .range = SCHEMA_RANGE_LENGTH, .standard = "10", .doc = "Height of what an orthographic camera sees."},
    {.name = "aperture", FIELD(ir_camera, aperture), .example = "0.1", .unit = SCHEMA_UNIT_SCENE,
     .also = "lens_diameter aperture_size aperture_diameter",
     .range = SCHEMA_RANGE_DISTANCE, .standard = "0", .feature = FEATURE_CAMERA,
     .doc = "Diameter of the lens: the larger, the less is sharp; 0 is a pinhole, which shows all sharp."},
    {.name = "focus", FIELD(ir_camera, focus), .example = "4", .unit = SCHEMA_UNIT_SCENE,
     .also = "focal_distance focus_distance",
     .range = SCHEMA_RANGE_LENGTH, .choice = 2, .alternative = IR_FOCUS_DISTANCE,
     .doc = "How far away things are sharp, along the view; if left out, where 'look_at' is."},
    {.name = "focus_at", .element = "FocusAt", FIELD(ir_camera, focus_at), .example = "0 1 0",
     .also = "focus_point",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .choice = 2, .alternative = IR_FOCUS_POINT,
     .doc = "A point that is sharp, and all that is as far away along the view."},
    {.name = "focus_on", FIELD(ir_camera, focus_on), .example = "ball", .text = SCHEMA_TEXT_BODY_NAME, .counted = true,
     .also = "focus_object focus_body", .choice = 2, .alternative = IR_FOCUS_BODY,
     .doc = "Name of a body whose middle is sharp, and all that is as far away along the view; of a model the middle of its box."},
};
const struct schema_element SCHEMA_CAMERA = {
    ELEMENT("camera", "Camera", ir_camera, camera_rows, "A point of view; the first is the default."),
    .choices = {{SCHEMA_CHOICE_AT_MOST_ONE, offsetof(struct ir_camera, view)},
                {SCHEMA_CHOICE_AT_MOST_ONE, offsetof(struct ir_camera, focusing)}}};

static const struct schema_row background_rows[] = {
    {.name = "color", .element = "Color", FIELD(ir_background, color), .example = "0.2 0.7 0.8",
     .range = SCHEMA_RANGE_WEIGHT, .choice = 1, .alternative = IR_BACKDROP_COLOR, .standard = "0 0 0",
     .doc = "One colour in all directions."},
    {.name = "image", FIELD(ir_background, image), .example = "sky.jpg", .text = SCHEMA_TEXT_PATH,
     .also = "texture map file skybox envmap hdri",
     .file = SCHEMA_FILE_IMAGE, .choice = 1, .alternative = IR_BACKDROP_IMAGE,
     .feature = FEATURE_BACKGROUND_IMAGE,
     .doc = "Path of an equirectangular image (" IMAGE_IN_SCENE_NAMES "): its middle is the view along +x."},
    {.name = "intensity", FIELD(ir_background, intensity), .example = "0.5", .range = SCHEMA_RANGE_WEIGHT,
     .also = "strength brightness",
     .standard = "1", .doc = "Multiplies the background."},
    {.name = "rotation", FIELD(ir_background, rotation), .example = "90", .unit = SCHEMA_UNIT_DEGREES,
     .range = SCHEMA_RANGE_ANGLE, .standard = "0", .doc = "Turns the background about the y axis."},
    {.name = "lights", FIELD(ir_background, lights), .standard = "false", .feature = FEATURE_SKY_LIGHT,
     .also = "light lighting illuminates ibl image_based_lighting environment_light",
     .doc = "Whether the background lights surfaces, with soft shadows, the brighter parts of it more."},
};
const struct schema_element SCHEMA_BACKGROUND = {
    ELEMENT("background", "Background", ir_background, background_rows, "What rays that hit no body see."),
    .choices = {{SCHEMA_CHOICE_AT_MOST_ONE, offsetof(struct ir_background, kind)}}};

static const struct schema_row ambient_rows[] = {
    {.name = "color", .element = "Color", FIELD(ir_ambient, color), .example = "0.2 0.22 0.25",
     .range = SCHEMA_RANGE_WEIGHT, .standard = "0 0 0", .short_form = true, .feature = FEATURE_AMBIENT,
     .doc = "Colour of the light that comes from everywhere."},
    {.name = "intensity", FIELD(ir_ambient, intensity), .example = "0.5", .range = SCHEMA_RANGE_WEIGHT,
     .also = "strength brightness",
     .standard = "1", .doc = "Multiplies the colour."},
    {.name = "occlusion", FIELD(ir_ambient, occlusion), .example = "2", .unit = SCHEMA_UNIT_SCENE,
     .also = "ao distance ambient_occlusion occlusion_distance max_distance",
     .range = SCHEMA_RANGE_SIZE, .standard = "0", .feature = FEATURE_OCCLUSION,
     .doc = "How near a body must be to keep ambient light off a surface: corners get darker; 0: none does."},
};
const struct schema_element SCHEMA_AMBIENT = {
    ELEMENT("ambient", "Ambient", ir_ambient, ambient_rows, "Light that comes from everywhere alike, on diffuse colours.")};

static const struct schema_row panel_rows[] = {
    {.name = "corner", .element = "Corner", FIELD(ir_panel, corner), .example = "-1 4 -1",
     .also = "pos position origin location center",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .required = true,
     .doc = "One of the four corners."},
    {.name = "edge_u", .element = "EdgeU", FIELD(ir_panel, edge_u), .example = "2 0 0",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .required = true,
     .doc = "From the corner to one next to it."},
    {.name = "edge_v", .element = "EdgeV", FIELD(ir_panel, edge_v), .example = "0 0 2",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .required = true,
     .doc = "From the corner to the other one next to it; light leaves on the side that edge_u x edge_v points to."},
};
const struct schema_element SCHEMA_PANEL = {
    ELEMENT("panel", "Panel", ir_panel, panel_rows, "The rectangle of a light, which shines on one side.")};

static const struct schema_row spot_rows[] = {
    {.name = "look_at", .element = "LookAt", FIELD(ir_spot, look_at), .example = "0 1 0",
     .also = "target point_at", .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .choice = 1,
     .alternative = IR_AIM_LOOK_AT, .doc = "A point that the middle of the light meets."},
    {.name = "direction", .element = "Direction", FIELD(ir_spot, direction), .example = "0 -1 0",
     .also = "axis dir", .range = SCHEMA_RANGE_COORDINATE, .choice = 1, .alternative = IR_AIM_DIRECTION,
     .doc = "The direction in which the middle of the light travels; any length except 0."},
    {.name = "angle", FIELD(ir_spot, angle), .example = "60", .unit = SCHEMA_UNIT_DEGREES,
     .also = "cone_angle beam_angle outer_angle size cutoff", .range = SCHEMA_RANGE_OPENING, .standard = "45",
     .doc = "How wide the light is: from edge to edge of its cone."},
    {.name = "softness", FIELD(ir_spot, softness), .example = "0.5", .range = SCHEMA_RANGE_FRACTION,
     .also = "blend penumbra falloff inner_angle", .standard = "0.15",
     .doc = "Share of the way from the middle to the edge on which the light fades; 0 is a sharp edge."},
};
const struct schema_element SCHEMA_SPOT = {
    ELEMENT("spot", "Spot", ir_spot, spot_rows, "The cone that a light with a position shines into."),
    .choices = {{SCHEMA_CHOICE_EXACTLY_ONE, offsetof(struct ir_spot, aim)}}};

static const struct schema_row light_rows[] = {
    BODY_NAME(ir_light, "sun"),
    COPIES(ir_light),
    {.name = "position", .element = "Position", FIELD(ir_light, position), .example = "-20 20 20",
     .also = "location origin center translation",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .choice = 1,
     .alternative = IR_LIGHT_POSITION, .feature = FEATURE_POINT_LIGHT, .doc = "A light at a point."},
    {.name = "direction", .element = "Direction", FIELD(ir_light, direction), .example = "1 -2 -1",
     .range = SCHEMA_RANGE_COORDINATE, .choice = 1, .alternative = IR_LIGHT_DIRECTION,
     .feature = FEATURE_DIRECTION_LIGHT,
     .doc = "A light infinitely far away: the direction in which its light travels; any length except 0."},
    {.name = "rectangle", .element = "Rectangle", FIELD(ir_light, rectangle), .child = &SCHEMA_PANEL,
     .also = "panel area quad", .choice = 1, .alternative = IR_LIGHT_RECTANGLE,
     .feature = FEATURE_SOFT_LIGHT,
     .doc = "A panel: a rectangle that shines on one side, with soft shadows."},
    {.name = "radius", FIELD(ir_light, radius), .example = "0.5", .example_alone = true, .unit = SCHEMA_UNIT_SCENE,
     .range = SCHEMA_RANGE_SIZE, .standard = "0", .feature = FEATURE_SOFT_LIGHT,
     .doc = "Radius of a light with a position: a sphere around it, with soft shadows; 0 is a point."},
    {.name = "angle", FIELD(ir_light, angle), .example = "0.53", .example_alone = true, .unit = SCHEMA_UNIT_DEGREES,
     .also = "angular_diameter sun_size",
     .range = SCHEMA_RANGE_OPENING, .standard = "0", .feature = FEATURE_SOFT_LIGHT,
     .doc = "Angle that a light with a direction measures across: a disc in the sky, with soft shadows; 0 is a point, the sun has 0.53."},
    {.name = "spot", .element = "Spot", FIELD(ir_light, spot), .child = &SCHEMA_SPOT, .example_alone = true,
     .feature = FEATURE_SPOT,
     .also = "spotlight spot_light cone beam",
     .doc = "The cone that a light with a position shines into; without it the light goes everywhere."},
    {.name = "visible", FIELD(ir_light, visible), .standard = "false", .feature = FEATURE_SEEN_LIGHT,
     .also = "camera_visible",
     .doc = "Whether camera, mirrors and glass show the light itself, if it has a radius, an angle or a rectangle."},
    {.name = "intensity", FIELD(ir_light, intensity), .example = "1.5", .range = SCHEMA_RANGE_WEIGHT,
     .also = "power strength brightness energy",
     .standard = "1", .doc = "Multiplies the colour."},
    {.name = "color", .element = "Color", FIELD(ir_light, color), .example = "1 0.9 0.8",
     .range = SCHEMA_RANGE_WEIGHT, .standard = "1 1 1", .doc = "Colour of the light."},
    {.name = "falloff", FIELD(ir_light, falloff), .words = falloff_words, .word_docs = falloff_docs,
     .also = "attenuation decay",
     .standard = "none", .feature = FEATURE_INVERSE_SQUARE, .doc = "How the light weakens with distance."},
};
const struct schema_element SCHEMA_LIGHT = {
    ELEMENT("light", "Light", ir_light, light_rows, "A light: at a point or infinitely far away, with hard shadows, or with an extent, and soft ones."),
    .choices = {{SCHEMA_CHOICE_EXACTLY_ONE, offsetof(struct ir_light, kind)}}};

static const struct schema_row sphere_rows[] = {
    BODY_NAME(ir_sphere, "ball"),
    COPIES(ir_sphere),
    {.name = "center", .element = "Center", FIELD(ir_sphere, center), .example = "0 1 0",
     .also = "pos position location origin translation middle",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .required = true,
     .doc = "Centre of the sphere."},
    {.name = "radius", FIELD(ir_sphere, radius), .example = "1.5", .unit = SCHEMA_UNIT_SCENE,
     .also = "r size diameter",
     .range = SCHEMA_RANGE_LENGTH, .required = true, .doc = "Distance from the centre to the surface."},
    {.name = "rotation", .element = "Rotation", FIELD(ir_sphere, rotation), .example = "0 110 0", .example_alone = true,
     .also = "orientation angles rotate",
     .unit = SCHEMA_UNIT_DEGREES, .range = SCHEMA_RANGE_ANGLE, .standard = "0 0 0", .feature = FEATURE_TURNED,
     .doc = "Turns its image or checker around the centre, about x, then y, then z."},
    BODY_MATERIAL(ir_sphere),
};
const struct schema_element SCHEMA_SPHERE = {
    ELEMENT("sphere", "Sphere", ir_sphere, sphere_rows, "A sphere.")};

static const struct schema_row rectangle_rows[] = {
    BODY_NAME(ir_rectangle, "floor"),
    COPIES(ir_rectangle),
    {.name = "corner", .element = "Corner", FIELD(ir_rectangle, corner), .example = "-5 0 5",
     .also = "pos position origin location center",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .required = true,
     .doc = "One of the four corners."},
    {.name = "edge_u", .element = "EdgeU", FIELD(ir_rectangle, edge_u), .example = "10 0 0",
     .also = "u",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .required = true,
     .doc = "From the corner to a neighbouring corner."},
    {.name = "edge_v", .element = "EdgeV", FIELD(ir_rectangle, edge_v), .example = "0 0 -10",
     .also = "v",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .required = true,
     .doc = "From the corner to its other neighbour; need not be at a right angle to 'edge_u'."},
    BODY_MATERIAL(ir_rectangle),
};
const struct schema_element SCHEMA_RECTANGLE = {ELEMENT(
    "rectangle", "Rectangle", ir_rectangle, rectangle_rows, "A flat parallelogram, seen from both sides.")};

static const struct schema_row box_rows[] = {
    BODY_NAME(ir_box, "crate"),
    COPIES(ir_box),
    {.name = "center", .element = "Center", FIELD(ir_box, center), .example = "0 0.6 0",
     .also = "pos position location origin translation middle",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .required = true,
     .doc = "Middle of the box."},
    {.name = "size", .element = "Size", FIELD(ir_box, size), .example = "2 1 0.5",
     .also = "scale dimensions extent lengths edges",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_LENGTH, .required = true, .fill = true,
     .doc = "Lengths of the edges along x, y and z, before the box is turned; one number is a cube."},
    {.name = "rotation", .element = "Rotation", FIELD(ir_box, rotation), .example = "0 30 0",
     .also = "orientation angles rotate",
     .unit = SCHEMA_UNIT_DEGREES, .range = SCHEMA_RANGE_ANGLE, .standard = "0 0 0",
     .doc = "Turns the box around its middle, about x, then y, then z."},
    BODY_MATERIAL(ir_box),
};
const struct schema_element SCHEMA_BOX = {
    ELEMENT("box", "Box", ir_box, box_rows, "A box: six faces at right angles, with an inside.")};

static const struct schema_row cylinder_rows[] = {
    BODY_NAME(ir_cylinder, "column"),
    COPIES(ir_cylinder),
    {.name = "from", .element = "From", FIELD(ir_cylinder, from), .example = "0 0 0",
     .also = "base begin bottom start base_point center position",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .required = true,
     .doc = "Middle of the disc that it begins with."},
    {.name = "to", .element = "To", FIELD(ir_cylinder, to), .example = "0 3 0",
     .also = "cap end tip top cap_point apex",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .required = true,
     .doc = "Middle of the disc that it ends with."},
    {.name = "radius", FIELD(ir_cylinder, radius), .example = "0.4", .unit = SCHEMA_UNIT_SCENE,
     .also = "r size diameter thickness",
     .range = SCHEMA_RANGE_LENGTH, .required = true, .doc = "Distance from the axis to the surface."},
    BODY_MATERIAL(ir_cylinder),
};
const struct schema_element SCHEMA_CYLINDER = {ELEMENT("cylinder", "Cylinder", ir_cylinder, cylinder_rows,
                                                       "A cylinder: round, closed by two discs, with an inside.")};

static const struct schema_row cone_rows[] = {
    BODY_NAME(ir_cone, "roof"),
    COPIES(ir_cone),
    {.name = "from", .element = "From", FIELD(ir_cone, from), .example = "0 0 0",
     .also = "base begin bottom start base_point center position",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .required = true,
     .doc = "Middle of the disc that it begins with."},
    {.name = "to", .element = "To", FIELD(ir_cone, to), .example = "0 2 0",
     .also = "cap end tip top cap_point apex",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .required = true,
     .doc = "Middle of the disc that it ends with, or its tip."},
    {.name = "radius_from", FIELD(ir_cone, radius_from), .example = "1", .unit = SCHEMA_UNIT_SCENE,
     .also = "radius r base_radius bottom_radius radius_bottom",
     .range = SCHEMA_RANGE_SIZE, .required = true, .doc = "Radius at 'from'; 0 is a tip."},
    {.name = "radius_to", FIELD(ir_cone, radius_to), .example = "0", .unit = SCHEMA_UNIT_SCENE,
     .also = "cap_radius top_radius radius_top tip_radius",
     .range = SCHEMA_RANGE_SIZE, .required = true, .doc = "Radius at 'to'; 0 is a tip."},
    BODY_MATERIAL(ir_cone),
};
const struct schema_element SCHEMA_CONE = {
    ELEMENT("cone", "Cone", ir_cone, cone_rows,
            "A cone, whole or cut off: round, closed by discs where it does not end in a tip, with an inside.")};

static const struct schema_row map_entry_rows[] = {
    {.name = "from", FIELD(ir_map_entry, from), .example = "Gold", .text = SCHEMA_TEXT_FOREIGN_NAME,
     .key = true, .required = true, .doc = "Name of a material in the mesh file."},
    {.name = "to", .element = "To", FIELD(ir_map_entry, to), .example = "glass", .child = &SCHEMA_MATERIAL,
     .required = true, .short_form = true,
     .doc = "Name of the scene's material that replaces it, or a material of its own."},
};
const struct schema_element SCHEMA_MAP_ENTRY = {
    ELEMENT("material_map", "MaterialMap", ir_map_entry, map_entry_rows,
            "Gives the faces of one material of the mesh file a material of the scene.")};

static const struct schema_row model_rows[] = {
    BODY_NAME(ir_model, "dragon"),
    COPIES(ir_model),
    {.name = "mesh", .element = "Mesh", FIELD(ir_model, mesh), .example = "dragon.obj", .child = &SCHEMA_MESH,
     .also = "file path filename src geometry obj ply stl shape",
     .file = SCHEMA_FILE_MESH, .required = true,
     .doc = "Path of a mesh file, the name of one of the scene's meshes, or a mesh of its own."},
    {.name = "part", FIELD(ir_model, part), .example = "wheel", .example_alone = true, .text = SCHEMA_TEXT_FOREIGN_NAME,
     .also = "submesh sub_mesh object_name mesh_name",
     .doc = "What to show of a glTF file: the name of one of its meshes, 'mesh 3' or 'node 7' by number; if left out, "
            "its whole scene."},
    BODY_MATERIAL(ir_model),
    {.name = "material_map", .element = "MaterialMap", FIELD(ir_model, material_map),
     .many = SCHEMA_NAMED_MAP, .child = &SCHEMA_MAP_ENTRY,
     .doc = "Materials by the names that the mesh file uses; they override 'material'."},
    {.name = "smooth", FIELD(ir_model, smooth), .example = "true", .example_alone = true, .standard = "false",
     .also = "smooth_shading shade_smooth smoothing",
     .feature = FEATURE_SMOOTH, .doc = "Interpolate normals between vertices, so that facets look smooth."},
    {.name = "crease_angle", FIELD(ir_model, crease_angle), .example = "40", .example_alone = true,
     .also = "auto_smooth auto_smooth_angle smoothing_angle sharp_edges edge_split",
     .unit = SCHEMA_UNIT_DEGREES, .range = SCHEMA_RANGE_OPENING, .standard = "180",
     .doc = "Of a smooth model: edges at which faces differ by more than this stay sharp. Normals in the mesh file are kept."},
    {.name = "scale", .element = "Scale", FIELD(ir_model, scale), .example = "0.7 0.7 0.7",
     .also = "size scaling",
     .range = SCHEMA_RANGE_SCALE, .standard = "1 1 1", .fill = true,
     .doc = "Scales the mesh, before it is turned and moved; negative values mirror it."},
    {.name = "rotation", .element = "Rotation", FIELD(ir_model, rotation), .example = "0 110 0",
     .also = "orientation angles rotate",
     .unit = SCHEMA_UNIT_DEGREES, .range = SCHEMA_RANGE_ANGLE, .standard = "0 0 0",
     .doc = "Turns the scaled mesh about x, then y, then z."},
    {.name = "translation", .element = "Translation", FIELD(ir_model, translation), .example = "0 -3 -7",
     .also = "pos position location offset center origin move translate",
     .unit = SCHEMA_UNIT_SCENE, .range = SCHEMA_RANGE_COORDINATE, .standard = "0 0 0",
     .doc = "Moves the scaled and turned mesh."},
};
const struct schema_element SCHEMA_MODEL = {
    ELEMENT("model", "Model", ir_model, model_rows, "A mesh from a file, placed in the scene.")};
// clang-format on
