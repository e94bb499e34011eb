// Pictures against closed forms: a scene as text, its camera, and what each direction must show.
//
// Expected colours are computed in double from the formulas of docs/language.md, with code of the tests' own:
// nothing here calls the program's mathematics. Errors are said on standard error and counted.
// Thread safety: one thread.
#ifndef GLINT_TESTS_ANALYTIC_KIT_H
#define GLINT_TESTS_ANALYTIC_KIT_H

#include "core/vec3.h"
#include "tests/pictures/picture_kit.h"

struct analytic {
    struct picture_kit kit;
    const char *folder; // where scenes, meshes and pictures of the test are written
    int pictures, failed;
};

// What the test knows of the camera: written into the scene, and used for the closed form.
struct analytic_camera {
    vec3 position;
    vec3 forward; // any length; zero: -z
    vec3 up;      // any length; zero: +y
    double fov;   // degrees; 0: 60
};

// The colour seen from the camera in the unit vector `direction`; false: too near an edge to tell.
typedef bool (*analytic_color)(const void *context, vec3 origin, vec3 direction, double rgb[3]);

struct analytic_picture {
    const char *name;
    const char *scene; // everything but glint, image and camera
    struct analytic_camera camera;
    const char *camera_text; // written in place of `camera`, which must mean the same; NULL: none
    const char *image_text;  // further attributes of image, as `, tone: normalize`; NULL: none
    int32_t width, height;   // 0: 48 x 32
    int32_t samples;         // 0: 1
    analytic_color color;
    const void *context;
    double tolerance;   // of each component, times the larger of 1 and the component
    double most_beside; // largest share of pixels for which `color` may give false
};

// Exit code of the test where it is not 0: 77, no device. Arguments: a folder to write to, further ones.
int analytic_open(struct analytic *analytic, int argc, char **argv);
// The program's exit code: 0 where all pictures were right, at least one, and no layer complained.
int analytic_close(struct analytic *analytic);

// Writes a file into the folder.
bool analytic_write(struct analytic *analytic, const char *name, const void *bytes, size_t size);
// Renders; the caller frees the image. false: counted as failed.
bool analytic_take(struct analytic *analytic, const struct analytic_picture *picture, struct image *image);
// Renders and compares every pixel.
void analytic_check(struct analytic *analytic, const struct analytic_picture *picture);
// Says and counts a failure unless `good`.
void analytic_expect(struct analytic *analytic, bool good, const char *name, const char *what);

// Unit direction of a sample: offsets (a, b) in 0..1 within pixel (x, y).
vec3 analytic_direction(const struct analytic_picture *picture, double x, double y);
// Offset of sample n in a pixel.
void analytic_offset(int n, double *a, double *b);

// ---- pieces of closed forms

// Distance along a ray to a sphere around `center`, the nearer crossing beyond `after`; negative: none.
double analytic_sphere(vec3 origin, vec3 direction, vec3 center, double radius, double after);
// Where the ray meets the plane through `point` with this normal, as a distance; negative: nowhere ahead.
double analytic_plane(vec3 origin, vec3 direction, vec3 point, vec3 normal);
vec3 analytic_at(vec3 origin, vec3 direction, double t);
vec3 analytic_mirrored(vec3 direction, vec3 normal);
// docs/language.md, "Reflected and refracted rays", for n towards the viewer; false: total reflection.
bool analytic_refracted(vec3 direction, vec3 normal, double eta, vec3 *out);

// A meter for rays: inside of a sphere of this radius around the origin, lit along the axes
// without shadows, so that each point of it shows its place. Scenes with it say `trace: {shadows: false}`.
#define ANALYTIC_SKY_RADIUS 64.0
extern const char analytic_sky_lights[];
extern const char analytic_sky_sphere[]; // an entry of `spheres`
void analytic_sky(vec3 origin, vec3 direction, double rgb[3]);

#endif
