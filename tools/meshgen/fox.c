#include "core/angle.h"
#include "tools/meshgen/generators.h"
#include "tools/meshgen/solids.h"

#define COAT  "coat"
#define RUST  "rust"
#define CREAM "cream"
#define DARK  "dark"

enum {
    RINGS_MAX = 8
};

// Right of the fox is -x. Parts that come in pairs are given for +x and mirrored.
static void paired_loft(struct mesh *mesh, const struct solids_ring *rings, int ring_count, int sides,
                        double angle_deg) {
    struct solids_ring mirrored[RINGS_MAX];
    solids_loft(mesh, rings, ring_count, sides, angle_deg);
    for (int i = 0; i < ring_count; i++) {
        mirrored[i] = rings[i];
        mirrored[i].centre.x = -rings[i].centre.x;
        mirrored[i].u.x = -rings[i].u.x;
        mirrored[i].v.x = -rings[i].v.x;
    }
    solids_loft(mesh, mirrored, ring_count, sides, angle_deg);
}

static void add_body(struct mesh *mesh) {
    static const struct solids_ring spine[] = {
        {{0, 0.20, -0.40}, {0, 0, 0}, {0, 0, 0}, COAT, NULL},
        {{0, 0.22, -0.33}, {0.15, 0, 0}, {0, 0.15, -0.09}, COAT, NULL},
        {{0, 0.32, -0.20}, {0.20, 0, 0}, {0, 0.18, -0.14}, COAT, NULL},
        {{0, 0.49, -0.06}, {0.18, 0, 0}, {0, 0.11, -0.17}, COAT, CREAM},
        {{0, 0.64, 0.02}, {0.16, 0, 0}, {0, 0.05, -0.17}, COAT, CREAM},
        {{0, 0.79, 0.04}, {0.125, 0, 0}, {0, 0.03, -0.13}, COAT, CREAM},
        {{0, 0.92, 0.05}, {0.10, 0, 0}, {0, 0.01, -0.10}, COAT, CREAM},
    };
    solids_loft(mesh, spine, 7, 6, 30);
    // The tuft on the chest overlaps the body and hangs forward.
    static const struct solids_ring tuft[] = {
        {{0, 0.82, 0.10}, {0.10, 0, 0}, {0, 0.02, -0.08}, CREAM, NULL},
        {{0, 0.68, 0.13}, {0.11, 0, 0}, {0, 0.02, -0.10}, CREAM, NULL},
        {{0, 0.48, 0.17}, {0, 0, 0}, {0, 0, 0}, CREAM, NULL},
    };
    solids_loft(mesh, tuft, 3, 6, 30);
}

static void add_legs(struct mesh *mesh) {
    static const struct solids_ring fore[] = {
        {{0.095, 0.54, 0.04}, {0.075, 0, 0}, {0, 0, 0.09}, COAT, NULL},
        {{0.090, 0.27, 0.12}, {0.052, 0, 0}, {0, 0, 0.056}, DARK, NULL},
        {{0.085, 0.09, 0.14}, {0.043, 0, 0}, {0, 0, 0.046}, DARK, NULL},
        {{0.085, 0.05, 0.17}, {0.056, 0, 0}, {0, 0, 0.084}, DARK, NULL},
        {{0.085, 0.00, 0.18}, {0.060, 0, 0}, {0, 0, 0.094}, DARK, NULL},
    };
    paired_loft(mesh, fore, 5, 6, 30);
    static const struct solids_ring haunch[] = {
        {{0.08, 0.23, -0.20}, {0, 0.19, 0.06}, {0, -0.06, 0.21}, COAT, NULL},
        {{0.19, 0.21, -0.17}, {0, 0.18, 0.06}, {0, -0.06, 0.20}, COAT, NULL},
        {{0.25, 0.18, -0.14}, {0, 0.10, 0.03}, {0, -0.03, 0.11}, COAT, NULL},
    };
    paired_loft(mesh, haunch, 3, 6, 0);
    static const struct solids_ring foot[] = {
        {{0.19, 0.05, -0.16}, {0.055, 0, 0}, {0, 0.05, 0}, RUST, NULL},
        {{0.20, 0.045, -0.02}, {0.055, 0, 0}, {0, 0.045, 0}, DARK, NULL},
        {{0.21, 0.035, 0.06}, {0.050, 0, 0}, {0, 0.035, 0}, DARK, NULL},
    };
    paired_loft(mesh, foot, 3, 4, 45);
}

static void add_head(struct mesh *mesh) {
    static const struct solids_ring skull[] = {
        {{0, 0.98, -0.10}, {0.10, 0, 0}, {0, 0.09, 0}, COAT, NULL},
        {{0, 1.00, -0.01}, {0.20, 0, 0}, {0, 0.16, 0}, COAT, NULL},
        {{0, 0.97, 0.10}, {0.25, 0, 0}, {0, 0.18, 0}, COAT, CREAM},
        {{0, 0.935, 0.20}, {0.16, 0, 0}, {0, 0.135, 0}, COAT, CREAM},
        {{0, 0.895, 0.31}, {0.078, 0, 0}, {0, 0.075, 0}, COAT, CREAM},
        {{0, 0.885, 0.42}, {0.036, 0, 0}, {0, 0.042, 0}, COAT, CREAM},
    };
    solids_loft(mesh, skull, 6, 6, 0);
    static const struct solids_ring cheek[] = {
        {{0.14, 0.93, 0.08}, {0, 0.07, 0.03}, {0, -0.03, 0.07}, CREAM, NULL},
        {{0.33, 0.87, 0.04}, {0, 0, 0}, {0, 0, 0}, CREAM, NULL},
    };
    paired_loft(mesh, cheek, 2, 4, 45);
    static const struct solids_ring ear[] = {
        {{0.125, 1.06, 0.02}, {0.085, -0.035, 0}, {0, 0, -0.055}, COAT, DARK},
        {{0.158, 1.24, -0.005}, {0.048, -0.015, 0}, {0, 0, -0.033}, RUST, DARK},
        {{0.185, 1.39, -0.03}, {0, 0, 0}, {0, 0, 0}, RUST, NULL},
    };
    paired_loft(mesh, ear, 3, 4, 45);
    mesh->material = DARK;
    solids_octahedron(mesh, (vec3){0, 0.905, 0.43}, (vec3){0.036, 0.030, 0.028});
    solids_octahedron(mesh, (vec3){0.108, 0.995, 0.215}, (vec3){0.034, 0.030, 0.030});
    solids_octahedron(mesh, (vec3){-0.108, 0.995, 0.215}, (vec3){0.034, 0.030, 0.030});
}

// The tail lies on the ground about the fox's left side; its rings stand across its path.
static void add_tail(struct mesh *mesh) {
    static const struct {
        double x, z, heading_deg, radius;
        const char *material;
    } path[] = {
        {0.02, -0.34, 0, 0.050, COAT},  {0.20, -0.42, 10, 0.090, COAT},  {0.38, -0.36, 60, 0.130, COAT},
        {0.45, -0.18, 90, 0.145, COAT}, {0.44, 0.00, 105, 0.130, CREAM}, {0.37, 0.14, 130, 0.085, CREAM},
        {0.28, 0.22, 0, 0, CREAM},
    };
    struct solids_ring rings[RINGS_MAX];
    for (int i = 0; i < 7; i++) {
        double heading = path[i].heading_deg * PI / 180, radius = path[i].radius;
        vec3 across = {-sin(heading) * radius, 0, cos(heading) * radius};
        double height = i == 0 ? 0.14 : radius * 0.87 + 0.02;
        rings[i] = (struct solids_ring){
            {path[i].x, height, path[i].z}, across, {0, radius, 0}, path[i].material, NULL};
    }
    rings[6].v = (vec3){0, 0, 0};
    rings[6].centre.y = 0.06;
    solids_loft(mesh, rings, 7, 6, 0);
}

void fox_generate(struct mesh *mesh) {
    add_body(mesh);
    add_legs(mesh);
    add_head(mesh);
    add_tail(mesh);
}

void fox_write_mtl(struct strbuf *text) {
    static const struct {
        const char *name;
        const char *diffuse;
    } colours[] = {
        {COAT, "0.90 0.36 0.10"},
        {RUST, "0.55 0.18 0.06"},
        {CREAM, "0.95 0.90 0.82"},
        {DARK, "0.10 0.07 0.07"},
    };
    strbuf_cstr(text, "# colours of fox.obj, made by glint-meshgen\n");
    for (size_t i = 0; i < sizeof colours / sizeof colours[0]; i++)
        strbuf_format(text, "newmtl %s\nKd %s\nKs 0.1 0.1 0.1\nNs 20\n", colours[i].name, colours[i].diffuse);
}
