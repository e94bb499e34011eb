#include "scene/media.h"

#include "core/heap.h"
#include "scene/shape.h"

#include <math.h>
#include <stdlib.h>

enum {
    COMPARED_MAX = 100000000, // pairs of boxes
    DIRECTIONS = 8,           // directions tried before a mesh whose edges every ray hits
};

// ---- materials

bool scene_is_medium(const struct scene *scene, const struct scene_body *body) {
    if (!body->closed || !shape_is_there(body))
        return false;
    return scene->materials[scene_medium_material(scene, body)].refraction > 0;
}

uint32_t scene_medium_material(const struct scene *scene, const struct scene_body *body) {
    for (uint32_t i = 0; i < body->group_count; i++)
        if (scene->materials[body->materials[i]].refraction > 0)
            return body->materials[i];
    return body->materials[0];
}

static int compare_number(double a, double b) {
    return a < b ? -1 : a > b;
}

static int compare_color(vec3 a, vec3 b) {
    const int x = compare_number(a.x, b.x), y = compare_number(a.y, b.y);
    return x ? x : y ? y : compare_number(a.z, b.z);
}

// An image is identified by its file, whoever shows it. The order of two images does not matter.
static int compare_image(const struct scene_image *a, const struct scene_image *b) {
    const double own[] = {a->filter, a->wrap, a->u[0], a->u[1], a->u[2], a->v[0], a->v[1], a->v[2]};
    const double other[] = {b->filter, b->wrap, b->u[0], b->u[1], b->u[2], b->v[0], b->v[1], b->v[2]};
    const uintptr_t left = (uintptr_t)a->picture, right = (uintptr_t)b->picture;
    int order = left < right ? -1 : left > right;
    for (size_t i = 0; i < sizeof own / sizeof *own && !order; i++)
        order = compare_number(own[i], other[i]);
    return order;
}

static int compare_images(const struct scene_image *a, const struct scene_image *b) {
    int order = 0;
    for (int i = 0; i < ASSETS_IMAGES && !order; i++)
        order = compare_image(&a[i], &b[i]);
    return order;
}

static int compare_colors(const vec3 a[2], const vec3 b[2]) {
    const int even = compare_color(a[0], b[0]);
    return even ? even : compare_color(a[1], b[1]);
}

// The field of both materials, by its kind.
#define ORDER_NUMBER(name) compare_number(a->name, b->name)
#define ORDER_FLAG(name)   compare_number(a->name, b->name)
#define ORDER_COLOR(name)  compare_color(a->name, b->name)
#define ORDER_COLORS(name) compare_colors(a->name, b->name)
#define ORDER_IMAGES(name) compare_images(a->name, b->name)
#define COMPARE_BESIDE(kind, name)
#define COMPARE_MEDIUM(kind, name)            order = order ? order : ORDER_##kind(name);
#define COMPARE_FIELD(kind, name, share, ...) COMPARE_##share(kind, name)

int scene_compare_media(const struct scene_material *a, const struct scene_material *b) {
    int order = 0;
    SCENE_MATERIAL_FIELDS(COMPARE_FIELD)
    return order;
}

// ---- which scenes need them

struct medium {
    const struct scene_body *body;
    uint32_t number;
    double begin; // along the axis that is swept
};

static int by_place(const void *left, const void *right) {
    const struct medium *a = left, *b = right;
    return compare_number(a->begin, b->begin);
}

static bool do_boxes_overlap(const struct scene_body *a, const struct scene_body *b) {
    return a->lower.x < b->upper.x && b->lower.x < a->upper.x && a->lower.y < b->upper.y &&
           b->lower.y < a->upper.y && a->lower.z < b->upper.z && b->lower.z < a->upper.z;
}

static bool is_ball(const struct scene_body *body) {
    return shape_traits(body->shape).items == SHAPE_BALL;
}

// By the distance from the sphere's centre to the other sphere's centre, or to the nearest point of the
// other's box.
static bool may_overlap(const struct scene_body *a, const struct scene_body *b) {
    if (!do_boxes_overlap(a, b))
        return false;
    if (!is_ball(a) && !is_ball(b))
        return true;
    const struct scene_body *ball = is_ball(a) ? a : b, *other = ball == a ? b : a;
    const vec3 center = ball->object_to_world.offset;
    if (is_ball(other))
        return vec3_length(vec3_sub(center, other->object_to_world.offset)) < ball->radius + other->radius;
    const vec3 nearest = vec3_max(other->lower, vec3_min(other->upper, center));
    return vec3_length(vec3_sub(center, nearest)) < ball->radius;
}

// The axis along which the bodies are spread most, relative to their own sizes.
static int widest_axis(const struct medium *media, uint32_t count) {
    int best = 0;
    double most = -1;
    for (int axis = 0; axis < 3; axis++) {
        double low = INFINITY, high = -INFINITY, sizes = 0;
        for (uint32_t i = 0; i < count; i++) {
            low = fmin(low, vec3_along(media[i].body->lower, axis));
            high = fmax(high, vec3_along(media[i].body->upper, axis));
            sizes += vec3_along(media[i].body->upper, axis) - vec3_along(media[i].body->lower, axis);
        }
        const double spread = sizes > 0 ? (high - low) / sizes : 0;
        best = spread > most ? axis : best;
        most = fmax(most, spread);
    }
    return best;
}

// A sweep along one axis.
static void find_overlap(struct medium *media, uint32_t count, struct scene_media_reason *out) {
    const int axis = widest_axis(media, count);
    uint64_t compared = 0;
    for (uint32_t i = 0; i < count; i++)
        media[i].begin = vec3_along(media[i].body->lower, axis);
    qsort(media, count, sizeof *media, by_place);
    for (uint32_t i = 0; i < count; i++) {
        const struct medium *a = &media[i];
        for (uint32_t k = i + 1; k < count; k++) {
            const struct medium *b = &media[k];
            if (b->begin >= vec3_along(a->body->upper, axis))
                break;
            if (may_overlap(a->body, b->body)) {
                *out = (struct scene_media_reason){SCENE_MEDIA_OVERLAP, a->number, b->number};
                return;
            }
            if (++compared == COMPARED_MAX) {
                out->need = SCENE_MEDIA_MANY;
                return;
            }
        }
    }
}

bool scene_media_need(const struct scene *scene, struct scene_media_reason *out) {
    *out = (struct scene_media_reason){.need = SCENE_MEDIA_APART};
    uint32_t count = 0;
    struct medium *media = heap_array((size_t)scene->body_count + 1, sizeof *media);
    if (!media)
        return false;
    for (uint32_t i = 0; i < scene->body_count; i++) {
        const struct scene_body *body = &scene->bodies[i];
        if (!scene_is_medium(scene, body))
            continue;
        if (!vec3_is_zero(scene->materials[scene_medium_material(scene, body)].absorption)) {
            *out = (struct scene_media_reason){SCENE_MEDIA_ATTENUATION, i, i};
            break;
        }
        media[count++] = (struct medium){.body = body, .number = i};
    }
    if (out->need == SCENE_MEDIA_APART && count > 1)
        find_overlap(media, count, out);
    free(media);
    return true;
}

// ---- what surrounds a point

static const vec3 ABOVE[DIRECTIONS] = {
    {0.0152137, 0.9996533, 0.0214791},  {0.0734183, 0.9956128, -0.0581937},
    {-0.1173961, 0.9887442, 0.0927413}, {0.2319843, 0.9587711, 0.1641279},
    {-0.3128417, 0.9071863, -0.281343}, {0.4417319, 0.8143377, -0.376429},
    {-0.5613297, 0.7129441, 0.4201837}, {0.6217131, 0.5813921, 0.5249913},
};

vec3 scene_inside_direction(void) {
    return vec3_unit(ABOVE[0]);
}

// A ray from the point to far above, in coordinates sheared so that it runs along +y.
struct upward {
    vec3 point;
    double shear_x, shear_z;
};

static void shear(const struct upward *ray, vec3 corner, double out[3]) {
    const vec3 v = vec3_sub(corner, ray->point);
    out[0] = v.x - ray->shear_x * v.y;
    out[1] = v.y;
    out[2] = v.z - ray->shear_z * v.y;
}

static double edge_of(const double a[3], const double b[3]) {
    return a[0] * b[2] - a[2] * b[0];
}

enum crossing {
    CROSSING_NONE,
    CROSSING_HIT,
    CROSSING_EDGE, // the ray hits an edge: another direction is needed
};

// Triangles that share an edge compute it from the same numbers, so at most one of them is hit (Woop, Benthin
// and Wald 2013).
static enum crossing cross_triangle(const struct upward *ray, const vec3 corners[3], double *height) {
    double p[3][3];
    for (int k = 0; k < 3; k++)
        shear(ray, corners[k], p[k]);
    const double u = edge_of(p[1], p[2]), v = edge_of(p[2], p[0]), w = edge_of(p[0], p[1]);
    if ((u > 0 || v > 0 || w > 0) && (u < 0 || v < 0 || w < 0))
        return CROSSING_NONE;
    const double sum = u + v + w;
    *height = sum != 0 ? (u * p[0][1] + v * p[1][1] + w * p[2][1]) / sum : 0;
    if (u == 0 || v == 0 || w == 0)
        return fmax(p[0][1], fmax(p[1][1], p[2][1])) > 0 ? CROSSING_EDGE : CROSSING_NONE;
    return *height > 0 ? CROSSING_HIT : CROSSING_NONE;
}

// Whether the point is inside: an odd number of crossings. *way: to the first of them, along +y. false at an
// edge.
static bool count_crossings(const struct scene_body *body, const struct upward *ray, bool *inside,
                            double *way) {
    *inside = false;
    *way = INFINITY;
    for (uint32_t i = 0; i < body->triangle_count; i++) {
        vec3 corners[3];
        double height;
        scene_corners(body, &body->object_to_world, i, corners);
        const enum crossing crossing = cross_triangle(ray, corners, &height);
        if (crossing == CROSSING_EDGE)
            return false;
        if (crossing == CROSSING_HIT) {
            *inside = !*inside;
            *way = fmin(*way, height);
        }
    }
    return true;
}

static bool is_in_mesh(const struct scene_body *body, vec3 point, double *way) {
    bool inside = false;
    for (int i = 0; i < DIRECTIONS; i++) {
        const vec3 d = ABOVE[i];
        const struct upward ray = {point, d.x / d.y, d.z / d.y};
        if (count_crossings(body, &ray, &inside, way))
            break;
    }
    *way *= vec3_length(ABOVE[0]) / ABOVE[0].y;
    return inside;
}

static bool is_in_sphere(const struct scene_body *body, vec3 point, double *way) {
    const vec3 from = vec3_sub(point, body->object_to_world.offset);
    const double distance = vec3_length(from);
    if (!(distance < body->radius))
        return false;
    const double b = vec3_dot(from, scene_inside_direction());
    *way = sqrt(fmax(b * b + (body->radius - distance) * (body->radius + distance), 0)) - b;
    return true;
}

static bool is_in_cone(const struct scene_body *body, vec3 point, double *way) {
    const struct shape_cone cone = shape_cone_of(body);
    double t[2];
    bool side[2];
    if (!(shape_cone_distance(&cone, point) < 0) ||
        !shape_cone_crossing(&cone, point, scene_inside_direction(), t, side))
        return false;
    *way = fmax(t[1], 0);
    return true;
}

static bool is_in_box(const struct scene_body *body, vec3 p) {
    return p.x >= body->lower.x && p.x <= body->upper.x && p.y >= body->lower.y && p.y <= body->upper.y &&
           p.z >= body->lower.z && p.z <= body->upper.z;
}

// The farther away the ray leaves a body, the earlier it entered it.
static void put(struct scene_inside *out, double ways[SCENE_MEDIA_MOST], uint32_t body, double way) {
    uint32_t at = out->count;
    if (at == SCENE_MEDIA_MOST) {
        out->is_over = true;
        if (way < ways[--at])
            return;
    } else {
        out->count++;
    }
    for (; at > 0 && ways[at - 1] < way; at--) {
        ways[at] = ways[at - 1];
        out->bodies[at] = out->bodies[at - 1];
    }
    ways[at] = way;
    out->bodies[at] = body;
}

static bool may_hold(const struct scene *scene, const struct scene_body *body, vec3 point) {
    return is_in_box(body, point) && scene_is_medium(scene, body);
}

static bool holds(const struct scene_body *body, vec3 point, double *way) {
    switch (body->shape) {
    case SCENE_SPHERE:
        return is_in_sphere(body, point, way);
    case SCENE_PARALLELOGRAM: // has no inside
        break;
    case SCENE_MESH:
        return is_in_mesh(body, point, way);
    case SCENE_CONE:
        return is_in_cone(body, point, way);
    }
    return false;
}

void scene_media_at(const struct scene *scene, vec3 point, struct scene_inside *out) {
    double ways[SCENE_MEDIA_MOST];
    *out = (struct scene_inside){.count = 0};
    for (uint32_t i = 0; i < scene->body_count; i++) {
        double way;
        if (may_hold(scene, &scene->bodies[i], point) && holds(&scene->bodies[i], point, &way))
            put(out, ways, i, way);
    }
}

uint32_t scene_media_crowd(const struct scene *scene, vec3 point) {
    uint32_t boxes = 0, count = 0;
    for (uint32_t i = 0; i < scene->body_count; i++)
        boxes += may_hold(scene, &scene->bodies[i], point);
    for (uint32_t i = 0; boxes > SCENE_MEDIA_MOST && i < scene->body_count; i++) {
        double way;
        count += may_hold(scene, &scene->bodies[i], point) && holds(&scene->bodies[i], point, &way);
    }
    return count > SCENE_MEDIA_MOST ? count : 0;
}
