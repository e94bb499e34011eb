#include "bench/embree/peer.h"

#include "core/clock.h"
#include "core/parallel.h"
#include "core/srgb.h"
#include "grammar/ir.h"
#include "scene/transform.h"

#include <embree3/rtcore.h>

enum {
    PIECE = 8192,
    WORDS_OF_MESH_TRIANGLE = sizeof(struct mesh_triangle) / sizeof(uint32_t),
};

static const uint32_t rectangle_corners[6] = {0, 1, 2, 0, 2, 3};

// ---- bodies

struct placing {
    const struct mesh *mesh;
    affine3 map;
    float3 *out;
};

static void place_positions(void *context, size_t begin, size_t end) {
    const struct placing *p = context;
    for (size_t i = begin; i < end; i++)
        p->out[i] = float3_of(affine3_apply(p->map, p->mesh->positions[i]));
}

// Embree reads 16 bytes at the last position.
static float3 *position_room(struct peer *peer, size_t count) {
    float3 *room = ARENA_ARRAY(&peer->arena, float3, count + 2);
    room[count] = room[count + 1] = (float3){0, 0, 0};
    return room;
}

// A body before this one that has the same mesh; UINT32_MAX: none.
static uint32_t twin_of(const struct peer *peer, uint32_t number) {
    const struct mesh *mesh = peer->scene->bodies[number].mesh;
    for (uint32_t i = 0; i < number; i++)
        if (mesh && peer->scene->bodies[i].mesh == mesh)
            return i;
    return UINT32_MAX;
}

static void place_mesh(struct peer *peer, struct peer_body *body, const affine3 *map, uint32_t twin) {
    const struct mesh *mesh = body->is->mesh;
    body->corners = mesh->triangles->corners;
    body->stride = WORDS_OF_MESH_TRIANGLE;
    body->instance = peer->instances;
    if (body->instance && twin != UINT32_MAX) {
        body->positions = peer->bodies[twin].positions;
        return;
    }
    static const affine3 same = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}};
    float3 *positions = position_room(peer, mesh->position_count);
    struct placing placing = {mesh, body->instance ? same : *map, positions};
    parallel_for(mesh->position_count, PIECE, place_positions, &placing);
    body->positions = positions;
}

static void place_rectangle(struct peer *peer, struct peer_body *body, const affine3 *map) {
    vec3 first[3], second[3];
    scene_corners(body->is, map, 0, first);
    scene_corners(body->is, map, 1, second);
    float3 *positions = position_room(peer, 4);
    for (int k = 0; k < 3; k++)
        positions[k] = float3_of(first[k]);
    positions[3] = float3_of(second[2]);
    body->positions = positions;
    body->corners = rectangle_corners;
    body->stride = 3;
    body->edge_u = (float)vec3_length(mat3_column(map->linear, 0));
    body->edge_v = (float)vec3_length(mat3_column(map->linear, 1));
}

struct turning {
    const vec3 *from;
    mat3 map;
    float3 *to;
};

static void turn_normals(void *context, size_t begin, size_t end) {
    const struct turning *t = context;
    for (size_t i = begin; i < end; i++)
        t->to[i] = float3_of(vec3_unit(mat3_apply(t->map, t->from[i])));
}

static void smooth_normals(struct peer *peer, struct peer_body *body, uint32_t twin) {
    if (body->instance && twin != UINT32_MAX && peer->bodies[twin].normals &&
        peer->bodies[twin].is->crease_angle == body->is->crease_angle) {
        body->normals = peer->bodies[twin].normals;
        return;
    }
    static const mat3 same = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const struct mesh *mesh = body->is->mesh;
    const size_t count = 3 * (size_t)mesh->triangle_count;
    struct arena scratch;
    arena_init(&scratch, SIZE_MAX);
    float3 *normals = ARENA_ARRAY(&peer->arena, float3, count);
    struct turning turning = {mesh_smooth_normals(mesh, body->is->crease_angle, &scratch),
                              body->instance ? same : transform_for_normals(body->is->object_to_world.linear),
                              normals};
    parallel_for(count, PIECE, turn_normals, &turning);
    body->normals = normals;
    arena_finish(&scratch);
}

static void make_body(struct peer *peer, uint32_t number, vec3 origin) {
    const struct scene_body *from = &peer->scene->bodies[number];
    struct peer_body *body = &peer->bodies[number];
    const affine3 map = transform_relative(from->object_to_world, origin);
    *body = (struct peer_body){.is = from};
    peer->triangles += from->triangle_count;
    if (from->shape == SCENE_SPHERE) {
        body->to_own = (float34){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, float3_of(vec3_neg(map.offset))};
        peer->spheres[peer->sphere_count++] =
            (struct peer_sphere){float3_of(map.offset), (float)from->radius, number};
        return;
    }
    if (from->shape == SCENE_PARALLELOGRAM) {
        place_rectangle(peer, body, &map);
        return;
    }
    if (!from->mesh || !from->mesh->triangle_count)
        return;
    const uint32_t twin = twin_of(peer, number);
    body->to_world = float34_of(map);
    body->to_own = float34_of(transform_inverse(map));
    body->normal_map = float34_of((affine3){transform_for_normals(map.linear), {0, 0, 0}});
    place_mesh(peer, body, &map, twin);
    if (from->smooth)
        smooth_normals(peer, body, twin);
}

// ---- what is not a body

static void make_materials(struct peer *peer) {
    peer->materials = ARENA_ARRAY(&peer->arena, struct peer_material, peer->scene->material_count);
    for (uint32_t i = 0; i < peer->scene->material_count; i++) {
        const struct scene_material *from = &peer->scene->materials[i];
        struct peer_material *m = &peer->materials[i];
        *m = (struct peer_material){.checker = from->checker,
                                    .cell = (float)from->cell,
                                    .exponent = (float)from->specular_exponent,
                                    .reflection = (float)from->reflection,
                                    .refraction = (float)from->refraction,
                                    .index = (float)from->refractive_index};
        m->specular = float3_of(vec3_mul(from->specular, from->specular_weight));
        for (int k = 0; k < 2; k++)
            m->diffuse[k] = float3_of(vec3_mul(from->diffuse[k], from->diffuse_weight));
    }
}

static void make_lights(struct peer *peer, const struct view *view, vec3 origin) {
    peer->lights = ARENA_ARRAY(&peer->arena, struct peer_light, view->light_count);
    peer->light_count = view->light_count;
    for (uint32_t i = 0; i < view->light_count; i++) {
        const struct view_light *from = &view->lights[i];
        const vec3 place = from->directional ? from->to_light : vec3_sub(from->position, origin);
        peer->lights[i] = (struct peer_light){from->directional, from->inverse_square, float3_of(place),
                                              float3_of(from->emission)};
    }
}

static void make_background(struct peer *peer) {
    const struct picture *picture = peer->scene->background.picture;
    const bool srgb = peer->scene->ir->image.transfer == IR_TRANSFER_SRGB;
    peer->background = float3_of(peer->scene->background.color);
    if (!picture || picture_is_linear(picture))
        return;
    const uint32_t greatest = picture_greatest(picture->depth);
    peer->decoded = ARENA_ARRAY(&peer->arena, float, greatest + (size_t)1);
    for (uint32_t i = 0; i <= greatest; i++) {
        const double value = (double)i / greatest;
        peer->decoded[i] = (float)(srgb ? srgb_decode(value) : value);
    }
}

static void make_camera(struct peer *peer, const struct peer_wish *wish) {
    const struct view_camera *camera = &wish->view->camera;
    const double aspect = (double)wish->width / wish->height;
    peer->position = float3_of(vec3_sub(camera->position, wish->origin));
    peer->forward = float3_of(camera->forward);
    peer->right = float3_of(vec3_mul(camera->right, camera->tan_half_fov * aspect));
    peer->up = float3_of(vec3_mul(camera->up, camera->tan_half_fov));
}

static void make_parts(struct peer *peer, const struct peer_wish *wish) {
    const struct ir_scene *ir = wish->scene->ir;
    peer->bodies = ARENA_ARRAY(&peer->arena, struct peer_body, wish->scene->body_count);
    peer->spheres = ARENA_ARRAY(&peer->arena, struct peer_sphere, wish->scene->body_count + (size_t)1);
    peer->max_depth = (uint32_t)ir->trace.max_depth;
    peer->min_weight = (float)ir->trace.min_weight;
    peer->shadows = ir->trace.shadows;
    peer->cut_sees_background = ir->trace.depth_limit == IR_DEPTH_BACKGROUND;
    for (uint32_t i = 0; i < wish->scene->body_count; i++)
        make_body(peer, i, wish->origin);
    make_materials(peer);
    make_lights(peer, wish->view, wish->origin);
    make_background(peer);
    make_camera(peer, wish);
}

bool peer_make(struct peer *peer, const struct peer_wish *wish) {
    *peer = (struct peer){.scene = wish->scene, .robust = wish->robust, .instances = wish->instances};
    double start = clock_seconds();
    arena_init(&peer->arena, SIZE_MAX);
    make_parts(peer, wish);
    peer->flatten_seconds = clock_seconds() - start;
    start = clock_seconds();
    const bool good = peer_build(peer);
    peer->build_seconds = clock_seconds() - start;
    return good;
}

void peer_finish(struct peer *peer) {
    if (peer->top)
        rtcReleaseScene(peer->top);
    if (peer->device)
        rtcReleaseDevice(peer->device);
    arena_finish(&peer->arena);
    *peer = (struct peer){0};
}
