// What is turned on a lathe and has no inside: chess pieces, a column, a bowl, an urn; and rings.
#include "core/angle.h"
#include "tools/meshgen/generators.h"
#include "tools/meshgen/lathe.h"
#include "tools/meshgen/solids.h"

#include <math.h>

enum {
    STEPS = 4,
    SIDES = 64
};

// A foot that all pieces share, as far as their sizes allow.
#define FOOT(r)                                                                                              \
    {0, 0}, {0.5 * (r), 0}, {0.9 * (r), 0}, {(r), 0.03}, {(r), 0.09}, {0.88 * (r), 0.13}, {0.8 * (r), 0.16}, \
        {0.82 * (r), 0.19}, {                                                                                \
        0.74 * (r), 0.24                                                                                     \
    }

static const struct lathe_point PAWN[] = {
    FOOT(0.34),    {0.15, 0.36},  {0.115, 0.50},  {0.11, 0.59},  {0.19, 0.625}, {0.205, 0.645}, {0.19, 0.665},
    {0.11, 0.695}, {0.165, 0.76}, {0.185, 0.835}, {0.165, 0.92}, {0.10, 0.99},  {0.05, 1.012},  {0, 1.02},
};
static const struct lathe_point ROOK[] = {
    FOOT(0.37),   {0.22, 0.40},  {0.185, 0.60}, {0.18, 0.72},  {0.25, 0.77},  {0.265, 0.79},
    {0.25, 0.81}, {0.245, 0.86}, {0.265, 1.06}, {0.262, 1.09}, {0.245, 1.10}, {0.205, 1.10},
    {0.19, 1.09}, {0.185, 1.03}, {0.17, 1.01},  {0.09, 1.005}, {0, 1.005},
};
static const struct lathe_point BISHOP[] = {
    FOOT(0.36),   {0.17, 0.40},  {0.12, 0.62},   {0.11, 0.80},  {0.20, 0.84}, {0.215, 0.86},
    {0.20, 0.88}, {0.12, 0.91},  {0.125, 0.945}, {0.18, 1.03},  {0.19, 1.10}, {0.165, 1.19},
    {0.10, 1.29}, {0.04, 1.335}, {0.05, 1.36},   {0.06, 1.385}, {0.04, 1.42}, {0, 1.43},
};
static const struct lathe_point QUEEN[] = {
    FOOT(0.40),   {0.19, 0.42},  {0.135, 0.70}, {0.12, 0.95},  {0.21, 0.99},  {0.225, 1.01}, {0.21, 1.03},
    {0.13, 1.06}, {0.14, 1.14},  {0.19, 1.32},  {0.25, 1.47},  {0.245, 1.50}, {0.22, 1.50},  {0.20, 1.48},
    {0.15, 1.49}, {0.07, 1.545}, {0.075, 1.59}, {0.085, 1.62}, {0.055, 1.68}, {0, 1.70},
};
static const struct lathe_point KING[] = {
    FOOT(0.41),   {0.20, 0.44},  {0.145, 0.74}, {0.13, 1.03}, {0.22, 1.07},  {0.235, 1.09},
    {0.22, 1.11}, {0.14, 1.14},  {0.15, 1.22},  {0.20, 1.42}, {0.235, 1.55}, {0.225, 1.585},
    {0.13, 1.63}, {0.06, 1.665}, {0.05, 1.69},  {0, 1.70},
};
static const struct lathe_point PLINTH[] = {
    FOOT(0.38), {0.27, 0.27}, {0.28, 0.295}, {0.26, 0.305}, {0.13, 0.305}, {0, 0.305},
};
static const struct lathe_point COLUMN[] = {
    {0, 0},       {0.3, 0},     {0.50, 0},    {0.52, 0.05}, {0.52, 0.16}, {0.46, 0.20},
    {0.43, 0.24}, {0.46, 0.28}, {0.46, 0.33}, {0.39, 0.38}, {0.36, 0.46}, {0.35, 1.5},
    {0.33, 2.6},  {0.31, 3.5},  {0.31, 3.56}, {0.36, 3.60}, {0.36, 3.65}, {0.32, 3.69},
    {0.34, 3.78}, {0.44, 3.90}, {0.52, 3.95}, {0.52, 4.0},  {0.25, 4.0},  {0, 4.0},
};
static const struct lathe_point BOWL[] = {
    {0, 0},       {0.20, 0},     {0.38, 0},     {0.42, 0.02}, {0.42, 0.06}, {0.44, 0.09},
    {0.62, 0.17}, {0.80, 0.30},  {0.93, 0.47},  {0.98, 0.58}, {0.97, 0.60}, {0.94, 0.60},
    {0.90, 0.50}, {0.77, 0.345}, {0.60, 0.225}, {0.38, 0.15}, {0.20, 0.13}, {0, 0.125},
};

static const struct lathe_point URN[] = {
    {0, 0},       {0.15, 0},     {0.26, 0},    {0.285, 0.02},  {0.285, 0.05}, {0.27, 0.08},
    {0.30, 0.16}, {0.42, 0.36},  {0.49, 0.58}, {0.48, 0.78},   {0.38, 0.96},  {0.25, 1.08},
    {0.20, 1.17}, {0.205, 1.26}, {0.26, 1.33}, {0.285, 1.345}, {0.275, 1.36}, {0.25, 1.345},
    {0.18, 1.26}, {0.175, 1.17}, {0.10, 1.12}, {0, 1.11},
};

void pawn_generate(struct mesh *mesh) {
    lathe_turn_curve(mesh, PAWN, sizeof PAWN / sizeof *PAWN, STEPS, SIDES);
}

void rook_generate(struct mesh *mesh) {
    lathe_turn_curve(mesh, ROOK, sizeof ROOK / sizeof *ROOK, STEPS, SIDES);
}

void bishop_generate(struct mesh *mesh) {
    lathe_turn_curve(mesh, BISHOP, sizeof BISHOP / sizeof *BISHOP, STEPS, SIDES);
}

void queen_generate(struct mesh *mesh) {
    lathe_turn_curve(mesh, QUEEN, sizeof QUEEN / sizeof *QUEEN, STEPS, SIDES);
}

// An arm of the cross, from a to b, wider at its ends.
static void arm(struct mesh *mesh, vec3 a, vec3 b, vec3 side, double half) {
    const vec3 u = vec3_mul(side, 0.045), v = {0, 0, half}, narrow = vec3_mul(side, 0.026);
    const vec3 middle = vec3_mul(vec3_add(a, b), 0.5);
    const struct solids_ring rings[] = {
        {a, u, v, NULL, NULL}, {middle, narrow, v, NULL, NULL}, {b, u, v, NULL, NULL}};
    solids_loft(mesh, rings, 3, 4, 45);
}

void king_generate(struct mesh *mesh) {
    lathe_turn_curve(mesh, KING, sizeof KING / sizeof *KING, STEPS, SIDES);
    arm(mesh, (vec3){0, 1.67, 0}, (vec3){0, 1.95, 0}, (vec3){1, 0, 0}, 0.04);
    arm(mesh, (vec3){-0.11, 1.83, 0}, (vec3){0.11, 1.83, 0}, (vec3){0, 1, 0}, 0.035);
}

void plinth_generate(struct mesh *mesh) {
    lathe_turn_curve(mesh, PLINTH, sizeof PLINTH / sizeof *PLINTH, STEPS, SIDES);
}

void column_generate(struct mesh *mesh) {
    lathe_turn_curve(mesh, COLUMN, sizeof COLUMN / sizeof *COLUMN, 3, 48);
}

void bowl_generate(struct mesh *mesh) {
    lathe_turn_curve(mesh, BOWL, sizeof BOWL / sizeof *BOWL, STEPS, 96);
}

void urn_generate(struct mesh *mesh) {
    lathe_turn_curve(mesh, URN, sizeof URN / sizeof *URN, STEPS, 96);
}

// A torus about y, around the origin, of radius 1 and the half thickness `half`.
static void torus(struct mesh *mesh, double half) {
    enum {
        AROUND = 128,
        ACROSS = 32
    };
    for (int i = 0; i < AROUND; i++)
        for (int k = 0; k < ACROSS; k++) {
            const double turn = 2 * PI * i / AROUND, tube = 2 * PI * k / ACROSS, r = 1 + half * cos(tube);
            mesh_vertex(mesh, (vec3){r * cos(turn), half * sin(tube), r * sin(turn)});
        }
    for (int i = 0; i < AROUND; i++)
        for (int k = 0; k < ACROSS; k++) {
            const int a = i * ACROSS, b = (i + 1) % AROUND * ACROSS, up = (k + 1) % ACROSS;
            mesh_quad(mesh, a + k, a + up, b + up, b + k);
        }
}

void ring_generate(struct mesh *mesh) {
    torus(mesh, 0.2);
}

void hoop_generate(struct mesh *mesh) {
    torus(mesh, 0.05);
}
