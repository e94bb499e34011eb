// Embree's builder over a mesh, where Embree is installed. Thread safety: none.
#ifndef GLINT_BENCH_PEER_EMBREE_H
#define GLINT_BENCH_PEER_EMBREE_H

#include "bench/clocks.h"
#include "bench/mesh/mesh.h"

struct peer_embree;

// NULL: this build is without Embree, or it does not start.
struct peer_embree *peer_embree_open(const struct bench_mesh *mesh);
// Builds a tree of the default quality, and forgets it. `taken`: by rtcCommitScene; the mesh is copied
// before.
bool peer_embree_build(struct peer_embree *peer, struct bench_clocks *taken);
void peer_embree_close(struct peer_embree *peer);

#endif
