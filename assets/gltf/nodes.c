// Cameras, lights, and the trees of nodes that place them and meshes.
#include "assets/gltf/gltf_internal.h"
#include "core/angle.h"
#include "diag/codes/file.h"

#include <math.h>

#define SIZE_MOST 1e18 // the largest size that a scene may have

// ---- cameras and lights

static void read_perspective(struct gltf *gltf, json_index camera, struct gltf_camera *out) {
    const json_index node = gltf_get_object(gltf, camera, "perspective");
    if (!node) {
        gltf_missing(gltf, camera, "perspective");
        return;
    }
    if (!gltf_get_number(gltf, node, "yfov", 1e-9, 3.14159265358979, &out->yfov) &&
        !json_get(&gltf->json, node, "yfov"))
        gltf_missing(gltf, node, "yfov");
    gltf_get_number(gltf, node, "aspectRatio", 1e-6, 1e6, &out->aspect);
}

static void read_orthographic(struct gltf *gltf, json_index camera, struct gltf_camera *out) {
    const json_index node = gltf_get_object(gltf, camera, "orthographic");
    double xmag = 0;
    out->is_orthographic = true;
    if (!node) {
        gltf_missing(gltf, camera, "orthographic");
        return;
    }
    if (!gltf_get_number(gltf, node, "ymag", -SIZE_MOST, SIZE_MOST, &out->ymag) &&
        !json_get(&gltf->json, node, "ymag"))
        gltf_missing(gltf, node, "ymag");
    if (gltf_get_number(gltf, node, "xmag", -SIZE_MOST, SIZE_MOST, &xmag) && out->ymag != 0)
        out->aspect = fabs(xmag / out->ymag);
    out->ymag = fabs(out->ymag);
    if (out->ymag == 0)
        gltf_add(gltf, DIAG_GLTF_VALUE, node, "'%s' must have a 'ymag' other than 0", gltf_where(gltf, node));
}

static void read_camera(struct gltf *gltf, json_index node) {
    struct gltf_camera *camera = ARENA_PUSH(gltf->arena, &gltf->cameras);
    str type = STR("");
    *camera = (struct gltf_camera){.node = node, .name = gltf_name(gltf, node), .yfov = 1};
    if (!gltf_get_text(gltf, node, "type", &type) && !json_get(&gltf->json, node, "type"))
        gltf_missing(gltf, node, "type");
    else if (str_equal_cstr(type, "perspective"))
        read_perspective(gltf, node, camera);
    else if (str_equal_cstr(type, "orthographic"))
        read_orthographic(gltf, node, camera);
    else if (type.len)
        gltf_add(gltf, DIAG_GLTF_VALUE, json_get(&gltf->json, node, "type"),
                 "'%s' must be perspective or orthographic",
                 gltf_where(gltf, json_get(&gltf->json, node, "type")));
}

static void read_light(struct gltf *gltf, json_index node) {
    struct gltf_light *light = ARENA_PUSH(gltf->arena, &gltf->lights);
    str type = STR("");
    *light = (struct gltf_light){
        .node = node, .name = gltf_name(gltf, node), .color = {1, 1, 1}, .intensity = 1, .outer = PI / 4};
    gltf_get_numbers(gltf, node, "color", 0, 1e6, 3, light->color);
    gltf_get_number(gltf, node, "intensity", 0, 1e30, &light->intensity);
    const json_index spot = json_get(&gltf->json, node, "spot");
    if (spot) {
        gltf_get_number(gltf, spot, "innerConeAngle", 0, PI / 2, &light->inner);
        gltf_get_number(gltf, spot, "outerConeAngle", 0, PI / 2, &light->outer);
    }
    light->has_range = json_get(&gltf->json, node, "range") != 0;
    const bool has_type = gltf_get_text(gltf, node, "type", &type);
    light->kind = str_equal_cstr(type, "point")         ? GLTF_LIGHT_POINT
                  : str_equal_cstr(type, "directional") ? GLTF_LIGHT_DIRECTIONAL
                                                        : GLTF_LIGHT_SPOT;
    if (!has_type && !json_get(&gltf->json, node, "type"))
        gltf_missing(gltf, node, "type");
    else if (has_type && light->kind == GLTF_LIGHT_SPOT && !str_equal_cstr(type, "spot"))
        gltf_add(gltf, DIAG_GLTF_VALUE, json_get(&gltf->json, node, "type"),
                 "'%s' must be point, directional or spot",
                 gltf_where(gltf, json_get(&gltf->json, node, "type")));
}

void gltf_read_cameras(struct gltf *gltf) {
    json_index list = gltf_get_list(gltf, gltf->json.root, "cameras");
    for (json_index at = 0; list && (at = gltf_next_object(gltf, list, at));)
        read_camera(gltf, at);
    const json_index extension = gltf_extension(gltf, gltf->json.root, "KHR_lights_punctual");
    list = gltf_get_list(gltf, extension, "lights");
    for (json_index at = 0; list && (at = gltf_next_object(gltf, list, at));)
        read_light(gltf, at);
}

// ---- places

static const affine3 identity = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}};

// The rotation of a quaternion x y z w, which is normalized first.
static mat3 rotation_of(const double q[4]) {
    const double n = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (!(n > 0))
        return identity.linear;
    const double s = 2 / n, x = q[0], y = q[1], z = q[2], w = q[3];
    return (mat3){{{1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)},
                   {s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)},
                   {s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)}}};
}

static affine3 place_of(struct gltf *gltf, json_index node) {
    double m[16], t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    affine3 place = identity;
    if (gltf_get_numbers(gltf, node, "matrix", -SIZE_MOST, SIZE_MOST, 16, m)) {
        for (int row = 0; row < 3; row++)
            for (int column = 0; column < 3; column++)
                place.linear.m[row][column] = m[4 * column + row];
        place.offset = (vec3){m[12], m[13], m[14]};
        return place;
    }
    gltf_get_numbers(gltf, node, "translation", -SIZE_MOST, SIZE_MOST, 3, t);
    gltf_get_numbers(gltf, node, "scale", -SIZE_MOST, SIZE_MOST, 3, s);
    if (gltf_get_numbers(gltf, node, "rotation", -1.0001, 1.0001, 4, q) &&
        fabs(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - 1) > 1e-3)
        gltf_add(gltf, DIAG_GLTF_RULE, json_get(&gltf->json, node, "rotation"),
                 "'%s' is not of length 1, and is divided by its length",
                 gltf_where(gltf, json_get(&gltf->json, node, "rotation")));
    place.linear = rotation_of(q);
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++)
            place.linear.m[row][column] *= s[column];
    place.offset = (vec3){t[0], t[1], t[2]};
    return place;
}

// ---- nodes

static void read_node(struct gltf *gltf, json_index node) {
    struct gltf_node *n = ARENA_PUSH(gltf->arena, &gltf->nodes);
    *n = (struct gltf_node){
        .node = node, .name = gltf_name(gltf, node), .light = GLTF_NONE, .parent = GLTF_NONE};
    gltf_get_index(gltf, node, "mesh", gltf->meshes.count, &n->mesh);
    gltf_get_index(gltf, node, "camera", gltf->cameras.count, &n->camera);
    const json_index light = gltf_extension(gltf, node, "KHR_lights_punctual");
    if (light)
        gltf_get_index(gltf, light, "light", gltf->lights.count, &n->light);
    n->local = n->world = place_of(gltf, node);
    if (json_get(&gltf->json, node, "skin"))
        gltf_lose(gltf, GLTF_LOSS_SKIN, node);
}

// The nodes in a list get this parent; a node that already has one is reported and keeps it.
static void adopt(struct gltf *gltf, json_index list, uint32_t parent) {
    for (json_index at = json_at(&gltf->json, list)->first; at; at = json_at(&gltf->json, at)->next) {
        const double number =
            json_kind_of(&gltf->json, at) == JSON_NUMBER ? json_number(&gltf->json, at) : -1;
        if (!(number >= 0 && number < gltf->nodes.count && number == floor(number))) {
            gltf_add(gltf, DIAG_GLTF_VALUE, at, "'%s' must be the number of a node, from 0 to %u",
                     gltf_where(gltf, at), gltf->nodes.count - 1);
            continue;
        }
        struct gltf_node *child = &gltf->nodes.items[(uint32_t)number];
        if (child->parent != GLTF_NONE)
            gltf_add(gltf, DIAG_GLTF_VALUE, at, "nodes[%u] is a child of nodes[%u], and of nodes[%u] too",
                     (uint32_t)number, parent, child->parent);
        else
            child->parent = parent;
    }
}

// Checks that going from parent to parent ends. The mark is the node from which a walk first passed by.
static void check_circles(struct gltf *gltf) {
    uint32_t *mark = ARENA_ARRAY(gltf->arena, uint32_t, (size_t)gltf->nodes.count + 1);
    for (uint32_t i = 0; i < gltf->nodes.count; i++) {
        uint32_t at = i;
        for (; at != GLTF_NONE && mark[at] == 0; at = gltf->nodes.items[at].parent)
            mark[at] = i + 1;
        if (at == GLTF_NONE || mark[at] != i + 1)
            continue;
        gltf_add(gltf, DIAG_GLTF_VALUE, gltf->nodes.items[at].node,
                 "nodes[%u] is a child of itself, by way of its children", at);
        return;
    }
}

// ---- the scene

struct walk {
    uint32_t *first, *next; // children of each node, and the next child of its parent; by node, 1 + the node
};

static void link_children(struct gltf *gltf, struct walk *walk) {
    const uint32_t count = gltf->nodes.count;
    walk->first = ARENA_ARRAY(gltf->arena, uint32_t, (size_t)count + 1);
    walk->next = ARENA_ARRAY(gltf->arena, uint32_t, (size_t)count + 1);
    for (uint32_t i = count; i-- > 0;) {
        const uint32_t parent = gltf->nodes.items[i].parent;
        if (parent == GLTF_NONE)
            continue;
        walk->next[i] = walk->first[parent];
        walk->first[parent] = i + 1;
    }
}

// The node and all below it, each after its parent: down, then to the next child, else up.
static void show(struct gltf *gltf, const struct walk *walk, uint32_t root) {
    for (uint32_t at = root; at != GLTF_NONE;) {
        struct gltf_node *node = &gltf->nodes.items[at];
        if (node->is_shown)
            return;
        node->is_shown = true;
        if (node->parent != GLTF_NONE)
            node->world = affine3_mul(gltf->nodes.items[node->parent].world, node->local);
        gltf->order[gltf->order_count++] = at;
        if (walk->first[at]) {
            at = walk->first[at] - 1;
            continue;
        }
        while (at != root && !walk->next[at])
            at = gltf->nodes.items[at].parent;
        at = at == root ? GLTF_NONE : walk->next[at] - 1;
    }
}

static void show_list(struct gltf *gltf, const struct walk *walk, json_index list) {
    for (json_index at = json_at(&gltf->json, list)->first; at; at = json_at(&gltf->json, at)->next) {
        const double number =
            json_kind_of(&gltf->json, at) == JSON_NUMBER ? json_number(&gltf->json, at) : -1;
        if (!(number >= 0 && number < gltf->nodes.count && number == floor(number)))
            gltf_add(gltf, DIAG_GLTF_VALUE, at, "'%s' must be the number of a node; the file has %u",
                     gltf_where(gltf, at), gltf->nodes.count);
        else if (gltf->nodes.items[(uint32_t)number].parent != GLTF_NONE)
            gltf_add(gltf, DIAG_GLTF_VALUE, at, "'%s' names nodes[%u], which is a child of another node",
                     gltf_where(gltf, at), (uint32_t)number);
        else
            show(gltf, walk, (uint32_t)number);
    }
}

// The default scene; else the first; a file without scenes shows all its nodes.
static void read_scene(struct gltf *gltf) {
    const json_index root = gltf->json.root, scenes = gltf_get_list(gltf, root, "scenes");
    struct walk walk;
    uint32_t index, count = 0;
    link_children(gltf, &walk);
    gltf->order = ARENA_ARRAY(gltf->arena, uint32_t, (size_t)gltf->nodes.count + 1);
    gltf_get_index(gltf, root, "scene", scenes ? json_at(&gltf->json, scenes)->count : 0, &index);
    index = index == GLTF_NONE ? 0 : index;
    for (json_index at = 0; scenes && (at = gltf_next_object(gltf, scenes, at));) {
        const json_index shown = gltf_get_list(gltf, at, "nodes");
        if (count++ == index && shown)
            show_list(gltf, &walk, shown);
        else if (shown && json_at(&gltf->json, shown)->count)
            gltf_lose(gltf, GLTF_LOSS_SCENE, at);
    }
    for (uint32_t i = 0; count == 0 && i < gltf->nodes.count; i++)
        if (gltf->nodes.items[i].parent == GLTF_NONE)
            show(gltf, &walk, i);
}

static void check_sizes(struct gltf *gltf) {
    for (uint32_t i = 0; i < gltf->order_count; i++) {
        const struct gltf_node *node = &gltf->nodes.items[gltf->order[i]];
        double largest = vec3_max_abs(node->world.offset);
        for (int k = 0; k < 3; k++)
            largest = vec3_larger(largest, vec3_max_abs(mat3_column(node->world.linear, k)));
        if (largest <= SIZE_MOST)
            continue;
        gltf_add(gltf, DIAG_GLTF_VALUE, node->node, "'%s' is placed further away or scaled more than 1e18",
                 gltf_where(gltf, node->node));
        return;
    }
}

void gltf_read_nodes(struct gltf *gltf) {
    const json_index list = gltf_get_list(gltf, gltf->json.root, "nodes");
    for (json_index at = 0; list && (at = gltf_next_object(gltf, list, at));)
        read_node(gltf, at);
    uint32_t parent = 0;
    for (json_index at = 0; list && (at = gltf_next_object(gltf, list, at)); parent++) {
        const json_index children = gltf_get_list(gltf, at, "children");
        if (children)
            adopt(gltf, children, parent);
    }
    if (gltf->errors == 0)
        check_circles(gltf);
    if (gltf->errors == 0)
        read_scene(gltf);
    if (gltf->errors == 0)
        check_sizes(gltf);
}
