// Embree's scenes: a geometry a body, numbered as bodies are, and one for all spheres; with instances a scene
// a mesh.
#include "bench/embree/peer.h"

#include "core/parallel.h"

#include <embree3/rtcore.h>
#include <stdio.h>

const char *peer_error(const struct peer *peer) {
    switch (rtcGetDeviceError(peer->device)) {
    case RTC_ERROR_NONE:
        return NULL;
    case RTC_ERROR_OUT_OF_MEMORY:
        return "Embree has not enough memory";
    case RTC_ERROR_UNSUPPORTED_CPU:
        return "Embree does not support this processor";
    default:
        return "Embree failed";
    }
}

// `number` is the geometry's.
static void attach(struct peer *peer, RTCScene scene, RTCGeometry geometry, uint32_t number) {
    (void)peer;
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, number);
    rtcReleaseGeometry(geometry);
}

static void add_triangles(struct peer *peer, RTCScene scene, const struct peer_body *body, uint32_t number) {
    const bool is_mesh = body->is->mesh != NULL;
    const size_t positions = is_mesh ? body->is->mesh->position_count : 4;
    RTCGeometry geometry = rtcNewGeometry(peer->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, body->positions, 0,
                               sizeof *body->positions, positions);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, body->corners, 0,
                               body->stride * sizeof *body->corners, body->is->triangle_count);
    attach(peer, scene, geometry, number);
}

static void add_spheres(struct peer *peer) {
    if (!peer->sphere_count)
        return;
    RTCGeometry geometry = rtcNewGeometry(peer->device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    float *to = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                                        4 * sizeof *to, peer->sphere_count);
    for (uint32_t i = 0; to && i < peer->sphere_count; i++, to += 4) {
        const struct peer_sphere *sphere = &peer->spheres[i];
        to[0] = sphere->center.x;
        to[1] = sphere->center.y;
        to[2] = sphere->center.z;
        to[3] = sphere->radius;
    }
    attach(peer, peer->top, geometry, peer->scene->body_count);
}

static RTCScene make_scene(const struct peer *peer) {
    RTCScene scene = rtcNewScene(peer->device);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    rtcSetSceneFlags(scene, peer->robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    return scene;
}

// The body that first shows this mesh has its scene.
static void add_instance(struct peer *peer, RTCScene *scenes, uint32_t number) {
    const struct peer_body *body = &peer->bodies[number];
    uint32_t first = 0;
    while (peer->bodies[first].positions != body->positions)
        first++;
    if (first == number) {
        scenes[number] = make_scene(peer);
        add_triangles(peer, scenes[number], body, 0);
        rtcCommitScene(scenes[number]);
    }
    const float3 *r = body->to_world.rows, offset = body->to_world.offset;
    const float columns[12] = {r[0].x, r[1].x, r[2].x, r[0].y,   r[1].y,   r[2].y,
                               r[0].z, r[1].z, r[2].z, offset.x, offset.y, offset.z};
    RTCGeometry geometry = rtcNewGeometry(peer->device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, scenes[first]);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    attach(peer, peer->top, geometry, number);
}

bool peer_build(struct peer *peer) {
    char config[32];
    snprintf(config, sizeof config, "threads=%u", parallel_processors());
    peer->device = rtcNewDevice(config);
    if (!peer->device)
        return false;
    peer->top = make_scene(peer);
    const uint32_t bodies = peer->scene->body_count;
    RTCScene *scenes = ARENA_ARRAY(&peer->arena, RTCScene, bodies + (size_t)1);
    for (uint32_t i = 0; i <= bodies; i++)
        scenes[i] = NULL;
    for (uint32_t i = 0; i < bodies; i++) {
        const struct peer_body *body = &peer->bodies[i];
        if (body->instance)
            add_instance(peer, scenes, i);
        else if (body->positions)
            add_triangles(peer, peer->top, body, i);
    }
    add_spheres(peer);
    rtcCommitScene(peer->top);
    for (uint32_t i = 0; i < bodies; i++)
        if (scenes[i])
            rtcReleaseScene(scenes[i]);
    return rtcGetDeviceError(peer->device) == RTC_ERROR_NONE;
}
