#include "assets/made/shell.h"

void shell_begin(struct shell *shell, const struct made_to *to, struct made *out, uint64_t faces,
                 uint64_t corners) {
    struct polygons *p = &out->polygons;
    *shell = (struct shell){to, out};
    *p = (struct polygons){.is_binary = true};
    p->faces.items = ARENA_ARRAY(to->arena, struct polygon_face, faces);
    p->faces.capacity = (uint32_t)faces;
    p->corners.items = ARENA_ARRAY(to->arena, struct polygon_corner, corners);
    p->corners.capacity = (uint32_t)corners;
    *ARENA_PUSH(to->arena, &p->groups) = (struct mesh_group){.name = STR("")};
    out->textured.corners.items = ARENA_ARRAY(to->arena, struct textured_corner, corners);
    out->textured.corners.capacity = (uint32_t)corners;
    out->textured.faces.items = ARENA_ARRAY(to->arena, uint32_t, faces);
    out->textured.faces.capacity = (uint32_t)faces;
}

#define MAKE_ROOM(shell, list)                                                                               \
    do {                                                                                                     \
        if (ARENA_IS_FULL(list))                                                                             \
            (list)->items = arena_regrow((shell)->to->arena, (list)->items, (list)->count,                   \
                                         &(list)->capacity, sizeof *(list)->items);                          \
    } while (0)

// Adding 0 makes 0 of -0.
static vec3 without_minus(vec3 a) {
    return (vec3){a.x + 0.0, a.y + 0.0, a.z + 0.0};
}

uint32_t shell_vertex(struct shell *shell, vec3 at) {
    struct polygons *p = &shell->out->polygons;
    MAKE_ROOM(shell, &p->vertices);
    p->vertices.items[p->vertices.count] = without_minus(at);
    return p->vertices.count++;
}

uint32_t shell_normal(struct shell *shell, vec3 normal) {
    struct polygons *p = &shell->out->polygons;
    MAKE_ROOM(shell, &p->normals);
    p->normals.items[p->normals.count] = without_minus(normal);
    return p->normals.count++;
}

uint32_t shell_coordinate(struct shell *shell, double u, double v) {
    struct textured_faces *t = &shell->out->textured;
    MAKE_ROOM(shell, &t->coordinates);
    t->coordinates.items[t->coordinates.count] = (struct ir_pair){u, v};
    return t->coordinates.count++;
}

uint32_t shell_box_coordinates(struct shell *shell, const struct plane_box *box, const struct ir_pair *points,
                               uint32_t count) {
    const struct ir_pair size = plane_sub(box->upper, box->lower);
    const uint32_t first = shell->out->textured.coordinates.count;
    for (uint32_t i = 0; i < count; i++) {
        const struct ir_pair at = plane_sub(points[i], box->lower);
        shell_coordinate(shell, size.u > 0 ? at.u / size.u : 0, size.v > 0 ? at.v / size.v : 0);
    }
    return first;
}

void shell_face(struct shell *shell, const struct shell_corner *corners, uint32_t count) {
    struct polygons *p = &shell->out->polygons;
    struct textured_faces *t = &shell->out->textured;
    t->faces.items[t->faces.count++] = p->corners.count;
    p->faces.items[p->faces.count] =
        (struct polygon_face){.first = p->corners.count, .line = p->faces.count + 1};
    p->faces.count++;
    for (uint32_t i = 0; i < count; i++) {
        p->corners.items[p->corners.count++] = (struct polygon_corner){corners[i].vertex, corners[i].normal};
        t->corners.items[t->corners.count++] =
            (struct textured_corner){corners[i].vertex, corners[i].coordinate};
    }
    p->triangle_count += count - 2;
}

void shell_end(struct shell *shell) {
    shell->out->textured.vertex_count = shell->out->polygons.vertices.count;
    shell->out->triangle_count = shell->out->polygons.triangle_count;
}
