// The mesh that boxes show: a cube of edge 1 around the origin, which the program has and no file.
#include "assets/mesh.h"
#include "scene/scene_internal.h"

#define LOW  (-0.5)
#define HIGH 0.5

// x, then y, then z.
static vec3 positions[] = {
    {LOW, LOW, LOW},  {HIGH, LOW, LOW},  {LOW, HIGH, LOW},  {HIGH, HIGH, LOW},
    {LOW, LOW, HIGH}, {HIGH, LOW, HIGH}, {LOW, HIGH, HIGH}, {HIGH, HIGH, HIGH},
};
static uint32_t merged[] = {0, 1, 2, 3, 4, 5, 6, 7};
// Of an image on a face, from its lower left corner around.
static struct ir_pair coordinates[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

#define NONE                                                                                                 \
    { IR_NO_INDEX, IR_NO_INDEX, IR_NO_INDEX }
#define FACE(number, a, b, c, d)                                                                             \
    {{a, b, c}, NONE, 0, number}, {                                                                          \
        {a, c, d}, NONE, 0, number                                                                           \
    }
// As seen from outside, from the lower left corner of its image around; as a rectangle is cut in two.
static struct mesh_triangle triangles[] = {
    FACE(1, 4, 5, 7, 6), // +z
    FACE(2, 1, 0, 2, 3), // -z
    FACE(3, 5, 1, 3, 7), // +x
    FACE(4, 0, 4, 6, 2), // -x
    FACE(5, 6, 7, 3, 2), // +y
    FACE(6, 0, 1, 5, 4), // -y
};
#define TEXTURED                                                                                             \
    {0, 1, 2}, {                                                                                             \
        0, 2, 3                                                                                              \
    }
static uint32_t textured[][3] = {TEXTURED, TEXTURED, TEXTURED, TEXTURED, TEXTURED, TEXTURED};
static struct mesh_group groups[1];

#define COUNT(array) (sizeof(array) / sizeof *(array))

static const struct mesh mesh = {
    .positions = positions,
    .position_count = COUNT(positions),
    .merged = merged,
    .coordinates = coordinates,
    .coordinate_count = COUNT(coordinates),
    .textured = textured,
    .triangles = triangles,
    .triangle_count = COUNT(triangles),
    .groups = groups,
    .group_count = COUNT(groups),
    .is_made = true,
    .is_binary = true,
    .closed = true,
    .volume = 1,
    .face_count = 6,
    .lower = {LOW, LOW, LOW},
    .upper = {HIGH, HIGH, HIGH},
};

const struct mesh *scene_box_mesh(void) {
    return &mesh;
}
