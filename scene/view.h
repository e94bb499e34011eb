// Camera and lights in double precision, automatic ones included: the same for GPU and reference.
//
// What the IR and the loaded meshes together say about camera and lights.
// Ownership: names point into the IR; lights in the caller's arena.
#ifndef GLINT_SCENE_VIEW_H
#define GLINT_SCENE_VIEW_H

#include "grammar/ir.h"
#include "scene/scene.h"

struct view_camera {
    str name;
    vec3 position;           // scene units
    vec3 right, up, forward; // orthonormal
    double tan_half_fov;     // of the vertical field; for other projections: of a field about as wide
    bool automatic;
    unsigned projection; // ir_projection
    double half_height;  // orthographic: of the visible part, scene units
    double half_field;   // fisheye: from the middle to the upper edge, radians
    double lens_radius;  // scene units; 0: a pinhole
    double focus;        // of a lens: where things are sharp, scene units along the view, or from the
                         // position where a fisheye or a panorama looks all round
};

enum view_extent {
    VIEW_POINT,
    VIEW_SPHERE, // around `position`
    VIEW_DISC,   // in the sky, around `to_light`
    VIEW_PANEL   // around `position`
};

struct view_light {
    enum view_extent extent;
    double radius;                // of the sphere; scene units
    double half_angle;            // of the disc, radians
    vec3 edge_u, edge_v, outward; // of the panel: scene units; unit, on the side that it shines on
    // Above 0: a body has exactly the surface of the sphere or the panel. Shadow rays end this far in front
    // of it (scene units), so that rounding cannot decide whether it blocks them.
    double before_body;
    bool directional;
    vec3 position; // scene units; zero where directional
    vec3 to_light; // unit; zero where positional
    vec3 emission; // intensity times colour, linear
    bool seen;     // also seen by rays; a body that has exactly its surface is seen instead
    vec3 radiance; // how bright a seen light looks: linear
    bool inverse_square;
    // Full light where (open - v) * rate is 1 or more, none from 0 down, with v = 1 - the cosine to `axis`;
    // between them the square.
    bool spot;
    vec3 axis; // unit, the way its light goes
    double open, rate;
    bool automatic;
    uint32_t index; // in scene.lights; IR_NO_INDEX where automatic
};

// Whether rays see the light itself: only if it has an extent, and no body has its surface.
static inline bool view_light_is_seen(const struct view_light *light) {
    return light->seen && light->extent != VIEW_POINT && !(light->before_body > 0);
}
// Sets how bright such a light looks, from its emission and its extent. One without falloff lights all
// distances alike: it looks as bright as one with falloff that lights `place` equally.
void view_light_shine(struct view_light *light, vec3 place);

struct view {
    struct view_camera camera;
    struct view_light *lights;
    uint32_t light_count;
};

// The view through camera `camera_index` of the scene (0 where it has none: the automatic camera for an
// image of width x height pixels). Notes N401 and N402 report automatic ones where `sink` is not NULL.
void view_build(const struct scene *scene, uint32_t camera_index, int32_t width, int32_t height,
                struct arena *arena, struct diag_sink *sink, struct view *out);

// The ray of a place in the picture, from -1, -1 at the lower left to 1, 1, through the middle of the lens.
struct view_ray {
    vec3 start, direction; // scene units; unit
};
struct view_ray view_ray_at(const struct view_camera *camera, double aspect, double x, double y);
// How a picture shows a point: the pinhole's ray to it, and its place and scale in the picture.
struct view_sight {
    vec3 direction; // unit
    double x, y;    // of the place in the picture, as above
    // How much of space the picture's height covers there, scene units: with `rows` rows a pixel is height /
    // rows wide, as the cones of filters are (docs/language.md, "Paint").
    double height;
    // For small areas across the ray: an area a covers a * density * rows^2 pixels.
    double density;
};
// false: the point is not in the picture.
bool view_sight_of(const struct view_camera *camera, double aspect, vec3 point, struct view_sight *out);

// Whether every ray begins at the camera's position.
static inline bool view_from_one_place(const struct view_camera *camera) {
    return camera->projection != IR_PROJECTION_ORTHOGRAPHIC && !(camera->lens_radius > 0);
}

// Turns and rolls a camera by a fraction of a pixel in a picture of some hundred lines: in a symmetric view,
// pixels lie exactly on edges and lines of a checker, where any rounding is right.
void view_turn_aside(struct view_camera *camera);

// "A ray whose path ... offset of sample n": frac(1/2 + n/φ), frac(1/2 + n/φ²), φ = 1.32471795724474602596
// (Roberts 2018, R2 sequence).
void view_sample_offset(uint32_t n, double *a, double *b);

// The first of the samples that are compared with those from 0 on: up to 256 samples from 0 and 1024 from
// here have none in common, and between the two sets no distance is below about half of the least distance
// within the sequence.
#define VIEW_OTHER_SAMPLES 6528

#endif
