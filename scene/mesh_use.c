#include "scene/mesh_use.h"

#include "scene/scene.h"

#include <stdlib.h>

int mesh_use_compare(const void *a, const void *b) {
    const struct mesh_use *x = a, *y = b;
    if (x->mesh != y->mesh)
        return (uintptr_t)x->mesh < (uintptr_t)y->mesh ? -1 : 1;
    return x->body < y->body ? -1 : x->body > y->body;
}

uint32_t mesh_uses(const struct scene *scene, uint32_t triangles_least, struct mesh_use *uses) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->body_count; i++)
        if (scene->bodies[i].mesh && scene->bodies[i].triangle_count >= triangles_least)
            uses[count++] = (struct mesh_use){scene->bodies[i].mesh, i};
    qsort(uses, count, sizeof *uses, mesh_use_compare);
    return count;
}
