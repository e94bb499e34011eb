#include "bench/embree/peer_embree.h"

#include <stdlib.h>

#ifdef BENCH_EMBREE
#include <embree3/rtcore.h>
#include <string.h>

struct peer_embree {
    const struct bench_mesh *mesh;
    RTCDevice device;
};

struct peer_embree *peer_embree_open(const struct bench_mesh *mesh) {
    struct peer_embree *peer = malloc(sizeof *peer);
    if (!peer)
        return NULL;
    *peer = (struct peer_embree){mesh, rtcNewDevice(NULL)};
    if (peer->device)
        return peer;
    free(peer);
    return NULL;
}

bool peer_embree_build(struct peer_embree *peer, struct bench_clocks *taken) {
    const struct bench_mesh *mesh = peer->mesh;
    RTCScene scene = rtcNewScene(peer->device);
    RTCGeometry geometry = rtcNewGeometry(peer->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void *positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                              3 * sizeof(float), mesh->vertex_count);
    void *corners = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            3 * sizeof(uint32_t), mesh->triangle_count);
    if (positions && corners) {
        memcpy(positions, mesh->positions, 3 * sizeof(float) * mesh->vertex_count);
        memcpy(corners, mesh->corners, 3 * sizeof(uint32_t) * mesh->triangle_count);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        struct bench_clocks start = bench_clocks_now();
        rtcCommitScene(scene);
        *taken = bench_clocks_since(start);
    }
    rtcReleaseGeometry(geometry);
    rtcReleaseScene(scene);
    return positions && corners && rtcGetDeviceError(peer->device) == RTC_ERROR_NONE;
}

void peer_embree_close(struct peer_embree *peer) {
    if (!peer)
        return;
    rtcReleaseDevice(peer->device);
    free(peer);
}

#else

struct peer_embree *peer_embree_open(const struct bench_mesh *mesh) {
    (void)mesh;
    return NULL;
}

bool peer_embree_build(struct peer_embree *peer, struct bench_clocks *taken) {
    (void)peer;
    (void)taken;
    return false;
}

void peer_embree_close(struct peer_embree *peer) {
    (void)peer;
}

#endif
