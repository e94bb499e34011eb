// Meshes that can be made: the shapes of random lists of points are as good as never sound.
#include "core/angle.h"
#include "grammar/ir.h"
#include "grammar/schema.h"
#include "tests/generate/generate_values.h"

#include <math.h>

enum {
    CORNERS = 4 // of the pyramids that `faces` get
};

static double length(struct generator *g, double least, double greatest) {
    return round(generate_between(g, least, greatest) * 100) / 100;
}

// An element whose short row alone is written.
static struct ir_head short_head(const struct schema_element *schema) {
    return (struct ir_head){.written = UINT64_C(1) << schema_short_row(schema)};
}

static struct ir_outline new_outline(struct generator *g, uint32_t count) {
    struct ir_outline_point *items = ARENA_ARRAY(g->arena, struct ir_outline_point, count);
    for (uint32_t i = 0; i < count; i++)
        items[i].head = short_head(&SCHEMA_OUTLINE_POINT);
    return (struct ir_outline){items, count, count};
}

// Upwards; it may begin and end on the axis.
static void mend_lathe(struct generator *g, struct ir_lathe *lathe) {
    const uint32_t count = 3 + generate_below(g, 6);
    const bool is_closed = generate_chance(g, 50);
    lathe->profile = new_outline(g, count);
    for (uint32_t i = 0; i < count; i++) {
        const bool is_end = is_closed && (i == 0 || i + 1 == count);
        lathe->profile.items[i].at = (struct ir_point){is_end ? 0 : length(g, 0.1, 1.2), 0.25 * i};
    }
    lathe->curve = IR_CURVE_LINEAR; // a curve may cross the axis
    lathe->angle = fmax(lathe->angle, 30);
}

// Around the origin, counter-clockwise, between two distances.
static struct ir_outline star(struct generator *g, uint32_t count, double least, double greatest) {
    struct ir_outline outline = new_outline(g, count);
    for (uint32_t i = 0; i < count; i++) {
        const double turn = 2 * PI * i / count, radius = generate_between(g, least, greatest);
        outline.items[i].at = (struct ir_point){round(cos(turn) * radius * 1000) / 1000,
                                                round(sin(turn) * radius * 1000) / 1000};
    }
    return outline;
}

static void mend_extrude(struct generator *g, struct ir_extrude *extrude) {
    extrude->outline = star(g, 3 + generate_below(g, 8), 0.7, 1.3);
    if (extrude->holes.count > 1)
        extrude->holes.count = 1;
    for (uint32_t i = 0; i < extrude->holes.count; i++)
        extrude->holes.items[i] =
            (struct ir_hole){.head = short_head(&SCHEMA_HOLE), .points = star(g, 4, 0.1, 0.2)};
    extrude->curve = IR_CURVE_LINEAR;
    extrude->height = length(g, 0.1, 2);
    extrude->bevel = fmin(extrude->bevel, 0.01);
}

static void mend_faces(struct generator *g, struct ir_faces *faces) {
    static const int32_t corners[CORNERS][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    faces->vertices =
        (struct ir_vertices){ARENA_ARRAY(g->arena, struct ir_vertex, CORNERS), CORNERS, CORNERS};
    for (uint32_t i = 0; i < CORNERS; i++) {
        faces->vertices.items[i].head = short_head(&SCHEMA_VERTEX);
        faces->vertices.items[i].at = (vec3){i == 1 ? length(g, 0.3, 1) : 0, i == 3 ? length(g, 0.3, 1) : 0,
                                             i == 2 ? length(g, -1, -0.3) : 0};
    }
    faces->faces = (struct ir_faces_list){ARENA_ARRAY(g->arena, struct ir_face, CORNERS), CORNERS, CORNERS};
    for (uint32_t i = 0; i < CORNERS; i++) {
        struct ir_corner *items = ARENA_ARRAY(g->arena, struct ir_corner, 3);
        for (uint32_t k = 0; k < 3; k++)
            items[k] = (struct ir_corner){short_head(&SCHEMA_CORNER), corners[i][k]};
        faces->faces.items[i] = (struct ir_face){short_head(&SCHEMA_FACE), {items, 3, 3}};
    }
    if (faces->uv.count == 0)
        return;
    faces->uv =
        (struct ir_coordinates){ARENA_ARRAY(g->arena, struct ir_coordinate, CORNERS), CORNERS, CORNERS};
    for (uint32_t i = 0; i < CORNERS; i++)
        faces->uv.items[i] =
            (struct ir_coordinate){short_head(&SCHEMA_UV), {length(g, 0, 1), length(g, 0, 1)}};
}

void generate_mend_mesh(struct generator *g, struct ir_mesh *mesh) {
    mesh->tolerance = fmax(mesh->tolerance, 0.01);
    switch ((enum ir_mesh_kind)mesh->kind) {
    case IR_MESH_LATHE:
        mend_lathe(g, &mesh->lathe);
        break;
    case IR_MESH_TORUS:
        mesh->torus.radius = length(g, 0.5, 1);
        mesh->torus.tube = length(g, 0.1, 0.5);
        break;
    case IR_MESH_EXTRUDE:
        mend_extrude(g, &mesh->extrude);
        break;
    case IR_MESH_FACES:
        mend_faces(g, &mesh->faces);
        break;
    case IR_MESH_TEXT:
        break;
    }
}
