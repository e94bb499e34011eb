// The inside of sweep_scene.h: what families are made of. Private to measure/sweep.
//
// Families speak in coordinates of their own, y up; the writer turns, scales and moves all of a scene at once
// when it writes. Names are not needed: what is wrong is found by looking. Ownership: the writer's texts are
// freed by sweep_scene.c. Thread safety: one thread.
#ifndef GLINT_TESTS_SWEEP_SWEEP_INTERNAL_H
#define GLINT_TESTS_SWEEP_SWEEP_INTERNAL_H

#include "core/vec3.h"
#include "tests/sweep/sweep_scene.h"

struct sweep_writer {
    uint64_t random; // state
    struct sweep_scene *scene;
    mat3 turn; // written = offset + scale * turn * own
    double scale;
    vec3 offset;
    struct strbuf lights, spheres, rectangles, models, head;
    struct strbuf *mesh; // under way
    uint32_t mesh_vertices;
    bool baked;       // this mesh's vertices are written in the scene's coordinates
    uint32_t depth;   // max_depth
    uint32_t samples; // of a pixel
    vec3 background;  // colour
    double intensity; // of it
    bool has_camera;
};

// A material. Zeroes mean: black, no checker.
struct sweep_paint {
    double diffuse, specular, reflection, refraction;
    vec3 color, other; // other: of a checker's odd cells
    double cell;       // 0: no checker
    double exponent, index;
    double roughness;
    bool image;    // in place of the colour: one that is made for it
    double repeat; // of it
};

typedef void sweep_maker(struct sweep_writer *w);
#define X(NAME, name, title) sweep_maker sweep_make_##name;
#include "tests/sweep/families.def"
#undef X

// ---- numbers (sweep_write.c, as all that is not said to be elsewhere)

uint64_t sweep_bits(struct sweep_writer *w);
double sweep_from(struct sweep_writer *w, double least, double most);      // evenly
double sweep_magnitude(struct sweep_writer *w, double least, double most); // evenly over magnitudes
uint32_t sweep_count(struct sweep_writer *w, uint32_t least, uint32_t most);
bool sweep_chance(struct sweep_writer *w, double probability);
vec3 sweep_direction(struct sweep_writer *w); // unit
vec3 sweep_inside(struct sweep_writer *w, vec3 lower, vec3 upper);
// The same by coordinates, each from least to most.
vec3 sweep_box(struct sweep_writer *w, double x0, double x1, double y0, double y1, double z0, double z1);
vec3 sweep_around(struct sweep_writer *w, double least, double most); // at such a distance from 0
vec3 sweep_color(struct sweep_writer *w);                             // 0.1 to 0.9 each
mat3 sweep_rotation(struct sweep_writer *w);
vec3 sweep_apply(const mat3 *m, vec3 v);

// ---- materials

struct sweep_paint sweep_matt(struct sweep_writer *w);
struct sweep_paint sweep_checkered(struct sweep_writer *w, double cell);
struct sweep_paint sweep_mirror(struct sweep_writer *w);
struct sweep_paint sweep_glass(struct sweep_writer *w, double index);
struct sweep_paint sweep_any_paint(struct sweep_writer *w); // matt, shiny, mirror or glass

// ---- a scene's things

void sweep_put_vector(struct strbuf *out, const char *key, vec3 v); // "key: [x, y, z]"

void sweep_camera(struct sweep_writer *w, vec3 position, vec3 look_at, double fov);
void sweep_light(struct sweep_writer *w, vec3 position, double intensity);
void sweep_sun(struct sweep_writer *w, vec3 travels, double intensity);
void sweep_sphere(struct sweep_writer *w, vec3 center, double radius, const struct sweep_paint *paint);
void sweep_rectangle(struct sweep_writer *w, vec3 corner, vec3 u, vec3 v, const struct sweep_paint *paint);
// Of the camera that was put last.
void sweep_aperture(struct sweep_writer *w, double aperture, double focus);
// Blocked by what is nearer than `occlusion`.
void sweep_ambient(struct sweep_writer *w, double intensity, double occlusion);
void sweep_ball_light(struct sweep_writer *w, vec3 position, double radius, double intensity);
void sweep_panel_light(struct sweep_writer *w, vec3 corner, double side, double intensity); // shines down
// No pixel may show the background; see sweep_scene.closed.
void sweep_close(struct sweep_writer *w);

// ---- meshes: begin, vertices (the first has index 1), faces, end

void sweep_mesh_begin(struct sweep_writer *w);
uint32_t sweep_vertex(struct sweep_writer *w, vec3 p);
void sweep_face(struct sweep_writer *w, uint32_t a, uint32_t b, uint32_t c);
void sweep_mesh_end(struct sweep_writer *w, bool smooth, const struct sweep_paint *paint);

// ---- shapes (sweep_shapes.c); each is one closed mesh unless it says otherwise

void sweep_box_mesh(struct sweep_writer *w, vec3 lower, vec3 upper, const struct sweep_paint *paint);
// The same of six rectangles, which are six bodies.
void sweep_box_rectangles(struct sweep_writer *w, vec3 lower, vec3 upper, const struct sweep_paint *paint);
// About the z axis, from z = 0 to `length`.
void sweep_prism(struct sweep_writer *w, uint32_t sides, double radius, double length,
                 const struct sweep_paint *paint);
void sweep_tetrahedron(struct sweep_writer *w, double radius, const struct sweep_paint *paint);
void sweep_octahedron(struct sweep_writer *w, vec3 center, double radius, const struct sweep_paint *paint);
// Of meridians and parallels.
void sweep_globe(struct sweep_writer *w, vec3 center, double radius, uint32_t parallels, uint32_t meridians,
                 bool smooth, const struct sweep_paint *paint);
// A cut stone, the table up.
void sweep_gem(struct sweep_writer *w, vec3 center, double radius, uint32_t sides,
               const struct sweep_paint *paint);
// An open mesh: hills over -extent ... extent in x and z, of this height.
void sweep_hills(struct sweep_writer *w, double extent, double height, uint32_t cells, bool smooth,
                 const struct sweep_paint *paint);

// ---- groups

// A floor, some bodies on it within about 4 units of 0, lights, and a camera that sees them.
void sweep_still_life(struct sweep_writer *w);
void sweep_bodies(struct sweep_writer *w, uint32_t count, double reach);
void sweep_floor(struct sweep_writer *w, double extent, const struct sweep_paint *paint);
void sweep_lights(struct sweep_writer *w);
void sweep_look(struct sweep_writer *w); // a camera that sees the middle

#endif
