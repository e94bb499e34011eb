#include "tools/meshgen/generators.h"
#include "tools/meshgen/lathe.h"

#include <math.h>

// Halves of sections, (radius, height), from the middle of the bottom, up the outside and back to the middle.
static const struct lathe_point TUMBLER[] = {
    {0.000, 0.000}, {0.150, 0.000}, {0.300, 0.000}, {0.330, 0.004}, {0.347, 0.018}, {0.354, 0.040},
    {0.360, 0.100}, {0.372, 0.250}, {0.384, 0.400}, {0.396, 0.550}, {0.408, 0.700}, {0.420, 0.850},
    {0.430, 0.980}, {0.430, 0.994}, {0.424, 1.005}, {0.414, 1.010}, {0.404, 1.005}, {0.398, 0.994},
    {0.396, 0.980}, {0.386, 0.850}, {0.374, 0.700}, {0.362, 0.550}, {0.350, 0.400}, {0.338, 0.250},
    {0.330, 0.170}, {0.320, 0.145}, {0.300, 0.130}, {0.150, 0.120}, {0.000, 0.118},
};
// Its wall is in the middle of that of the tumbler, so that the two overlap.
static const struct lathe_point DRINK[] = {
    {0.000, 0.080}, {0.150, 0.080}, {0.315, 0.090}, {0.338, 0.110}, {0.345, 0.150},
    {0.355, 0.250}, {0.367, 0.400}, {0.379, 0.550}, {0.391, 0.700}, {0.391, 0.703},
    {0.388, 0.705}, {0.150, 0.705}, {0.000, 0.705},
};

// A low, heavy glass, and what is in it: in the same way.
static const struct lathe_point ROCKS[] = {
    {0.000, 0.018}, {0.150, 0.014}, {0.300, 0.000}, {0.395, 0.000}, {0.418, 0.006}, {0.432, 0.020},
    {0.438, 0.045}, {0.442, 0.120}, {0.447, 0.240}, {0.452, 0.400}, {0.458, 0.560}, {0.464, 0.720},
    {0.470, 0.880}, {0.470, 0.890}, {0.466, 0.898}, {0.459, 0.901}, {0.452, 0.898}, {0.448, 0.890},
    {0.448, 0.880}, {0.441, 0.720}, {0.434, 0.560}, {0.427, 0.400}, {0.419, 0.280}, {0.412, 0.240},
    {0.396, 0.205}, {0.365, 0.180}, {0.310, 0.165}, {0.150, 0.155}, {0.000, 0.153},
};
static const struct lathe_point WHISKY[] = {
    {0.000, 0.110}, {0.150, 0.110}, {0.330, 0.118}, {0.390, 0.140},  {0.419, 0.180},
    {0.429, 0.240}, {0.433, 0.280}, {0.440, 0.400}, {0.4455, 0.536}, {0.4455, 0.540},
    {0.441, 0.542}, {0.150, 0.542}, {0.000, 0.542},
};

void tumbler_generate(struct mesh *mesh) {
    lathe_turn(mesh, TUMBLER, sizeof TUMBLER / sizeof *TUMBLER, 48);
}

void drink_generate(struct mesh *mesh) {
    lathe_turn(mesh, DRINK, sizeof DRINK / sizeof *DRINK, 48);
}

void rocks_generate(struct mesh *mesh) {
    lathe_turn(mesh, ROCKS, sizeof ROCKS / sizeof *ROCKS, 64);
}

void whisky_generate(struct mesh *mesh) {
    lathe_turn(mesh, WHISKY, sizeof WHISKY / sizeof *WHISKY, 64);
}

// ---- ice: a cube whose edges and corners are cut off

static const double ICE_HALF = 0.16, ICE_CUT = 0.025;

// Of the corner whose coordinates are negative where its bits are set, the vertex on the face across `axis`.
static int ice_vertex(int corner, int axis) {
    return 3 * corner + axis;
}

// In the order that makes the face look outward: the cube is convex and its middle the origin.
static void put_outward(struct mesh *mesh, int corners[4], int count) {
    const vec3 *p = mesh->positions;
    if (mesh->failed)
        return;
    const vec3 normal =
        vec3_cross(vec3_sub(p[corners[1]], p[corners[0]]), vec3_sub(p[corners[2]], p[corners[0]]));
    if (vec3_dot(normal, p[corners[0]]) < 0) {
        const int second = corners[1];
        corners[1] = corners[count - 1];
        corners[count - 1] = second;
    }
    mesh_face(mesh, corners, count);
}

void ice_generate(struct mesh *mesh) {
    for (int corner = 0; corner < 8; corner++)
        for (int axis = 0; axis < 3; axis++) {
            double at[3];
            for (int k = 0; k < 3; k++)
                at[k] = (corner >> k & 1 ? -1 : 1) * (k == axis ? ICE_HALF : ICE_HALF - ICE_CUT);
            mesh_vertex(mesh, (vec3){at[0], at[1], at[2]});
        }
    for (int axis = 0; axis < 3; axis++) {
        const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, own = 1 << axis;
        for (int side = 0; side < 2; side++) {
            const int c = side ? own : 0;
            put_outward(mesh,
                        (int[4]){ice_vertex(c, axis), ice_vertex(c | u, axis), ice_vertex(c | u | v, axis),
                                 ice_vertex(c | v, axis)},
                        4);
        }
        // The edges along this axis.
        for (int edge = 0; edge < 4; edge++) {
            const int c = (edge & 1 ? u : 0) | (edge & 2 ? v : 0), first = (axis + 1) % 3,
                      second = (axis + 2) % 3;
            put_outward(mesh,
                        (int[4]){ice_vertex(c, first), ice_vertex(c | own, first),
                                 ice_vertex(c | own, second), ice_vertex(c, second)},
                        4);
        }
    }
    for (int corner = 0; corner < 8; corner++)
        put_outward(mesh, (int[4]){ice_vertex(corner, 0), ice_vertex(corner, 1), ice_vertex(corner, 2), 0},
                    3);
}
