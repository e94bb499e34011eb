// Colours that differ from place to place: images, and checkers that are filtered (docs/language.md,
// "Paint").
//
// The footprint of a pixel is that of a cone around its ray (Amanatides 1984; Akenine-Moeller, Crassin,
// Boksansky, Belcour, Panteleev and Wright 2021, "Improved Shader and Texture Level of Detail Using Ray
// Cones"). How coordinates change across it is found from areas on a triangle, and from differences on a
// sphere, not from derivatives: so nothing here repeats what the device does.
#include "core/angle.h"
#include "reference/reference_internal.h"

#include "grammar/ir.h"
#include "scene/shape.h"

enum {
    TAPS_MAX = 15, // odd
};

// ---- cones

struct cone reference_camera_cone(const struct reference *r, const struct reference_settings *settings,
                                  vec3 direction) {
    const struct view_camera *camera = &r->input.view->camera;
    const uint32_t planned = settings->planned ? settings->planned : settings->samples;
    const uint32_t samples = settings->footprint_of ? settings->footprint_of : planned;
    const double part = 1 / (settings->height * sqrt(samples) * fmax(settings->apart, 1));
    switch (camera->projection) {
    case IR_PROJECTION_ORTHOGRAPHIC:
        return (struct cone){2 * camera->half_height * part, 0};
    case IR_PROJECTION_FISHEYE:
        return (struct cone){0, 2 * camera->half_field * part};
    case IR_PROJECTION_PANORAMA:
        return (struct cone){0, PI * part};
    default:
        return (struct cone){0, 2 * camera->tan_half_fov * vec3_dot(direction, camera->forward) * part};
    }
}

struct cone reference_mirrored_cone(const struct surface *s, struct cone cone) {
    return (struct cone){s->width, cone.spread + 2 * s->bend * s->width};
}

// By Snell's law for a normal that turns: to = eta from + (eta c - c') n.
struct cone reference_bent_cone(const struct surface *s, struct cone cone, vec3 from, vec3 to) {
    if (!s->solid || s->index == 1)
        return (struct cone){s->width, cone.spread};
    const double eta = s->enters ? 1 / s->index : s->index;
    const double along = vec3_dot(to, s->shading) - eta * vec3_dot(from, s->shading);
    return (struct cone){s->width, eta * cone.spread + along * s->bend * s->width};
}

// ---- the footprint

// Where a footprint lies on a surface, and its two axes: the first along the ray's own direction.
struct footprint {
    vec3 axis[2];
};

static struct footprint footprint_of(const struct ray *ray, const struct surface *s) {
    const double width = fabs(s->width);
    const vec3 n = s->geometric, d = vec3_unit(ray->direction);
    const double facing = fmax(-vec3_dot(d, n), 1e-6);
    vec3 along = vec3_add(d, vec3_mul(n, -vec3_dot(d, n)));
    if (vec3_length(along) < 1e-4)
        along = vec3_cross(n, fabs(n.x) < 0.5 ? (vec3){1, 0, 0} : (vec3){0, 1, 0});
    along = vec3_unit(along);
    return (struct footprint){
        {vec3_mul(along, width / facing), vec3_mul(vec3_unit(vec3_cross(n, along)), width)}};
}

// ---- coordinates

struct place {
    double u, v;
};

static vec3 corner_of(const struct primitive *p, int k) {
    return (vec3){p->v[k][0], p->v[k][1], p->v[k][2]};
}

// How the weights of a triangle's corners change along a way in its plane, by the areas that the point spans
// with the edge opposite each corner: so no digits are lost far from the origin. Their sum is 0.
static void weights_along(const struct primitive *p, vec3 way, double by[3]) {
    const vec3 normal =
        vec3_cross(vec3_sub(corner_of(p, 1), corner_of(p, 0)), vec3_sub(corner_of(p, 2), corner_of(p, 0)));
    const double area2 = vec3_dot(normal, normal);
    for (int k = 1; k < 3; k++) {
        const vec3 edge = vec3_sub(corner_of(p, (k + 2) % 3), corner_of(p, (k + 1) % 3));
        by[k] = vec3_dot(vec3_cross(edge, way), normal) / area2;
    }
    by[0] = -by[1] - by[2];
}

static struct place sphere_place(vec3 arm) {
    const double around = hypot(arm.x, arm.z);
    return (struct place){0.5 + atan2(arm.z, arm.x) / (2 * PI), 1 - atan2(around, arm.y) / PI};
}

// `at`: in the cone's own axes, from its beginning. An image's inscribed disc covers each end, as seen from
// outside.
static struct place cone_place(const struct scene_body *body, const struct surface *s, vec3 at) {
    switch (reference_face(s)) {
    case REFERENCE_FROM:
        return (struct place){0.5 + at.x / (2 * body->radius), 0.5 + at.z / (2 * body->radius)};
    case REFERENCE_TO:
        return (struct place){0.5 + at.x / (2 * body->radius_to), 0.5 - at.z / (2 * body->radius_to)};
    default:
        return (struct place){0.5 + atan2(at.z, at.x) / (2 * PI), at.y / body->height};
    }
}

// The place in a surface's coordinates (u, v).
static struct place surface_place(const struct scene_body *body, const struct surface *s, const double b[3],
                                  vec3 arm) {
    struct ir_pair at[3];
    switch (body->shape) {
    case SCENE_SPHERE:
        break;
    case SCENE_PARALLELOGRAM:
        return (struct place){s->triangle ? b[1] : b[1] + b[2], s->triangle ? b[1] + b[2] : b[2]};
    case SCENE_MESH:
        scene_coordinates(body, s->triangle, at);
        return (struct place){b[0] * at[0].u + b[1] * at[1].u + b[2] * at[2].u,
                              b[0] * at[0].v + b[1] * at[1].v + b[2] * at[2].v};
    case SCENE_CONE:
        return cone_place(body, s, arm);
    }
    return sphere_place(arm);
}

vec3 reference_checker_place(const struct scene_body *body, const struct surface *s, const double b[3],
                             vec3 arm) {
    const mat3 edges = body->object_to_world.linear;
    vec3 corners[3];
    switch (body->shape) {
    case SCENE_SPHERE:
        break;
    case SCENE_CONE: // a disc shows the cells just inside it
        arm.y += reference_face(s) == REFERENCE_FROM ? body->height * SCENE_CELLS_WITHIN
                 : reference_face(s) == REFERENCE_TO ? body->height * -SCENE_CELLS_WITHIN
                                                     : 0;
        break;
    case SCENE_PARALLELOGRAM:
        return (vec3){
            (s->triangle ? b[1] : b[1] + b[2]) * (vec3_length(mat3_column(edges, 0)) * body->cells->scale.x),
            (s->triangle ? b[1] + b[2] : b[2]) * (vec3_length(mat3_column(edges, 1)) * body->cells->scale.y),
            0};
    case SCENE_MESH:
        for (int k = 0; k < 3; k++)
            corners[k] = vec3_mul(body->mesh->positions[body->mesh->triangles[s->triangle].corners[k]], b[k]);
        return vec3_add(
            vec3_times(vec3_add(vec3_add(corners[0], corners[1]), corners[2]), body->cells->scale),
            body->cells->offset);
    }
    return vec3_times(arm, body->cells->scale);
}

// The place in a checker's coordinates, in cells.
static vec3 checker_cell(const struct scene_body *body, const struct surface *s, const double b[3], vec3 arm,
                         double size) {
    return vec3_mul(reference_checker_place(body, s, b, arm), 1 / size);
}

// ---- differences

// A surface at the hit, and at points beside it.
struct spot {
    const struct reference *r;
    const struct surface *s;
    const struct scene_body *body;
    const struct primitive *primitive;
    vec3 arm;
    double b[3];
};

// On a sphere places are moved by an angle small enough that curvature does not show, and large enough that
// their difference keeps its digits.
#define STEP 0x1p-12

static struct spot moved(const struct spot *spot, vec3 axis, double by) {
    struct spot to = *spot;
    to.arm = vec3_mul(vec3_unit(vec3_add(spot->arm, vec3_mul(axis, by))), vec3_length(spot->arm));
    return to;
}

static struct place place_at(const struct spot *spot) {
    return surface_place(spot->body, spot->s, spot->b, spot->arm);
}

// The least distance from a sphere's axis at which differences are taken, for radius 1.
#define NEAREST_AXIS 1e-12

// On a sphere, moves places that are nearer to the axis than that away from it.
static double off_axis(struct spot *spot) {
    const double size = vec3_length(spot->arm), around = hypot(spot->arm.x, spot->arm.z);
    if (around >= NEAREST_AXIS * size)
        return around / size;
    const double x = around > 0 ? spot->arm.x / around : 1, z = around > 0 ? spot->arm.z / around : 0;
    spot->arm.x = x * NEAREST_AXIS * size;
    spot->arm.z = z * NEAREST_AXIS * size;
    return NEAREST_AXIS;
}

// The angle from the pole at +y, or from that at -y: near it, the angle has all its digits.
static double from_pole(vec3 arm, double side) {
    return atan2(hypot(arm.x, arm.z), side * arm.y);
}

// By the difference of two places, the shorter way around, where a pixel covers no longitude twice.
static struct place change_on_sphere(const struct spot *at, vec3 way) {
    const vec3 axis = shape_into_frame(at->body, way);
    struct spot spot = *at;
    const double around = off_axis(&spot), length = vec3_length(axis) / vec3_length(spot.arm);
    const double all = fabs(spot.s->width) / vec3_length(spot.arm) / (2 * PI);
    const double step = STEP * around / length, less = fmin(1, around / all);
    const struct spot before = moved(&spot, axis, -step), after = moved(&spot, axis, step);
    const struct place a = place_at(&before), b = place_at(&after);
    const double u = b.u - a.u - floor(b.u - a.u + 0.5), side = copysign(1, spot.arm.y);
    const double v = side * (from_pole(before.arm, side) - from_pole(after.arm, side)) / PI;
    return (struct place){u * less / (2 * step), v / (2 * step)};
}

// As on a sphere; the other coordinate, and both on a disc, change evenly.
static struct place change_on_cone(const struct spot *spot, vec3 axis) {
    const vec3 way = shape_into_frame(spot->body, axis);
    const double size = vec3_length(way);
    const bool is_side = reference_face(spot->s) == REFERENCE_SIDE;
    struct spot before = *spot, after = *spot;
    double around = hypot(spot->arm.x, spot->arm.z), step = spot->body->height / size;
    if (is_side && !(around >= NEAREST_AXIS * spot->body->height)) {
        before.arm.x = after.arm.x = around = NEAREST_AXIS * spot->body->height;
        before.arm.z = after.arm.z = 0;
    }
    if (is_side)
        step = STEP * around / size;
    before.arm = vec3_sub(before.arm, vec3_mul(way, step));
    after.arm = vec3_add(after.arm, vec3_mul(way, step));
    const struct place a = place_at(&before), b = place_at(&after);
    const double all = fabs(spot->s->width) / (2 * PI), less = is_side ? fmin(1, around / all) : 1;
    const double u = b.u - a.u - (is_side ? floor(b.u - a.u + 0.5) : 0);
    return (struct place){u * less / (2 * step),
                          is_side ? way.y / spot->body->height : (b.v - a.v) / (2 * step)};
}

// How coordinates change along an axis.
static struct place change(const struct spot *spot, vec3 axis) {
    struct ir_pair at[3];
    double by[3];
    if (!(vec3_length(axis) > 0))
        return (struct place){0, 0};
    if (spot->primitive->is_sphere)
        return change_on_sphere(spot, axis);
    if (spot->primitive->is_cone)
        return change_on_cone(spot, axis);
    weights_along(spot->primitive, axis, by);
    if (spot->body->shape != SCENE_MESH)
        return surface_place(spot->body, spot->s, by, spot->arm);
    scene_coordinates(spot->body, spot->s->triangle, at);
    return (struct place){by[1] * (at[1].u - at[0].u) + by[2] * (at[2].u - at[0].u),
                          by[1] * (at[1].v - at[0].v) + by[2] * (at[2].v - at[0].v)};
}

// ---- images

static uint32_t wrapped(double coordinate, int64_t step, uint32_t size, unsigned wrap) {
    if (wrap == IR_WRAP_REPEAT) {
        const double at = fmod(coordinate + (double)step, size);
        return (uint32_t)(at < 0 ? at + size : at) % size;
    }
    return (uint32_t)fmin(fmax(coordinate + (double)step, 0), size - 1.0);
}

static double folded(double x, unsigned wrap) {
    if (wrap == IR_WRAP_REPEAT)
        return x - floor(x);
    if (wrap == IR_WRAP_CLAMP)
        return fmin(fmax(x, 0), 1);
    const double rest = fabs(fmod(x, 2));
    return rest > 1 ? 2 - rest : rest;
}

static vec3 nearest(const struct scene_image *image, struct place at) {
    const struct scene_level *level = &image->texture->levels[0];
    const double u = folded(at.u, image->wrap), v = 1 - folded(at.v, image->wrap);
    return scene_texel(image->texture, 0, (uint32_t)fmin(floor(u * level->width), level->width - 1.0),
                       (uint32_t)fmin(floor(v * level->height), level->height - 1.0));
}

static vec3 bilinear(const struct scene_image *image, uint32_t number, struct place at) {
    const struct scene_level *level = &image->texture->levels[number];
    const double x = folded(at.u, image->wrap) * level->width - 0.5;
    const double y = (1 - folded(at.v, image->wrap)) * level->height - 0.5;
    const double x0 = floor(x), y0 = floor(y);
    vec3 sum = {0, 0, 0};
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 2; i++) {
            const uint32_t column = wrapped(x0, i, level->width, image->wrap);
            const uint32_t row = wrapped(y0, j, level->height, image->wrap);
            const double weight = (i ? x - x0 : 1 - (x - x0)) * (j ? y - y0 : 1 - (y - y0));
            sum = vec3_add(sum, vec3_mul(scene_texel(image->texture, number, column, row), weight));
        }
    return sum;
}

// The level, fractional between two levels, each half as large as the one before. `size`: the footprint's, in
// pixels of the image; between two powers of two the level grows linearly with it.
static double level_of(const struct scene_texture *texture, double size) {
    int exponent;
    const double part = frexp(size, &exponent); // 0.5..1
    const double level = size > 1 ? exponent - 1 + (2 * part - 1) : 0;
    return fmin(level, texture->level_count - 1.0);
}

static vec3 between(const struct scene_image *image, double level, struct place at) {
    const uint32_t below = (uint32_t)level;
    const double share = level - below;
    vec3 color = bilinear(image, below, at);
    if (share > 0)
        color = vec3_add(vec3_mul(color, 1 - share), vec3_mul(bilinear(image, below + 1, at), share));
    return color;
}

static struct place in_image(const struct scene_image *image, struct place p) {
    return (struct place){image->u[0] * p.u + image->u[1] * p.v + image->u[2],
                          image->v[0] * p.u + image->v[1] * p.v + image->v[2]};
}

static struct place change_in_image(const struct scene_image *image, struct place p) {
    return (struct place){image->u[0] * p.u + image->u[1] * p.v, image->v[0] * p.u + image->v[1] * p.v};
}

// ---- taps

// An axis cut into `parts` of the same length, not necessarily a whole number: an odd number of whole parts
// around its middle, and half of the remainder at each end. So nothing jumps as `parts` grows.
struct cut {
    double parts;
    uint32_t count;
};

static struct cut cut_of(double longer, double shorter) {
    const double parts = longer >= TAPS_MAX * shorter ? TAPS_MAX : longer <= shorter ? 1 : longer / shorter;
    return (struct cut){parts, 1 + 2 * (uint32_t)ceil((parts - 1) / 2)};
}

// Where part i begins and ends on the axis, from -1/2 to 1/2.
static void part_of(struct cut cut, uint32_t i, double *begin, double *end) {
    const double half = cut.count / 2.0;
    *begin = fmax((i - half) / cut.parts, -0.5);
    *end = fmin((i + 1 - half) / cut.parts, 0.5);
}

// The axes of an ellipse, the longer one first, from two conjugate radii: turned through its radii r(t) = a
// cos t + b sin t to the longest.
static void axes_of(const struct place radius[2], struct place axis[2]) {
    const struct place a = radius[0], b = radius[1];
    const double t = atan2(2 * (a.u * b.u + a.v * b.v), a.u * a.u + a.v * a.v - b.u * b.u - b.v * b.v) / 2;
    axis[0] = (struct place){a.u * cos(t) + b.u * sin(t), a.v * cos(t) + b.v * sin(t)};
    axis[1] = (struct place){b.u * cos(t) - a.u * sin(t), b.v * cos(t) - a.v * sin(t)};
}

static vec3 filtered(const struct spot *spot, const struct footprint *f, const struct scene_image *image,
                     struct place at, struct reference_texel *texel) {
    const struct scene_level *whole = &image->texture->levels[0];
    struct place radius[2], axis[2];
    for (int k = 0; k < 2; k++) {
        radius[k] = change_in_image(image, change(spot, f->axis[k]));
        radius[k].u *= whole->width;
        radius[k].v *= whole->height;
    }
    axes_of(radius, axis);
    const double longer = hypot(axis[0].u, axis[0].v), shorter = hypot(axis[1].u, axis[1].v);
    const struct cut cut = cut_of(longer, fmax(shorter, 1));
    texel->taps = cut.count;
    texel->level = level_of(image->texture, fmax(longer / TAPS_MAX, shorter));
    vec3 sum = {0, 0, 0};
    for (uint32_t i = 0; i < cut.count; i++) {
        double begin, end;
        part_of(cut, i, &begin, &end);
        const double along = (begin + end) / 2;
        const struct place tap = {at.u + along * axis[0].u / whole->width,
                                  at.v + along * axis[0].v / whole->height};
        sum = vec3_add(sum, vec3_mul(between(image, texel->level, tap), end - begin));
    }
    return sum;
}

static vec3 image_color(const struct spot *spot, const struct footprint *f, const struct scene_image *image,
                        struct reference_texel *texel) {
    const struct place at = place_at(spot), there = in_image(image, at);
    const struct scene_level *level = &image->texture->levels[0];
    *texel = (struct reference_texel){.is_there = true, .u = at.u, .v = at.v, .taps = 1};
    texel->x = (uint32_t)fmin(floor(folded(there.u, image->wrap) * level->width), level->width - 1.0);
    texel->y = (uint32_t)fmin(floor((1 - folded(there.v, image->wrap)) * level->height), level->height - 1.0);
    if (image->filter == IR_FILTER_NEAREST)
        texel->color = nearest(image, there);
    else if (image->filter == IR_FILTER_BILINEAR || !(fabs(spot->s->width) > 0))
        texel->color = bilinear(image, 0, there);
    else
        texel->color = filtered(spot, f, image, there, texel);
    return texel->color;
}

// ---- checkers

// The mean over [x - w/2, x + w/2] of a function that is 1 in even cells and -1 in odd ones.
static double wave(double x, double w) {
    const double low = x - w / 2, high = x + w / 2;
    if (floor(low) == floor(high))
        return fmod(floor(x), 2) == 0 ? 1 : -1;
    const double a = low - 2 * floor(low / 2), b = high - 2 * floor(high / 2);
    return ((b < 1 ? b : 2 - b) - (a < 1 ? a : 2 - a)) / w;
}

static vec3 cell_change(const struct spot *spot, vec3 axis, double size) {
    double by[3];
    if (spot->primitive->is_cone)
        return vec3_mul(shape_into_frame(spot->body, axis), 1 / size);
    if (!spot->primitive->is_sphere) {
        weights_along(spot->primitive, axis, by);
        return checker_cell(spot->body, spot->s, by, spot->arm, size);
    }
    if (!(vec3_length(axis) > 0))
        return axis;
    axis = shape_into_frame(spot->body, axis);
    const double step = STEP * vec3_length(spot->arm) / vec3_length(axis);
    const struct spot before = moved(spot, axis, -step), after = moved(spot, axis, step);
    return vec3_mul(vec3_sub(after.arm, before.arm), 1 / (2 * step * size));
}

// The share of odd cells in the footprint, which is cut along its longer axis into as many boxes as the
// shorter axis fits into it.
static double odd_share(const struct spot *spot, const struct footprint *f, double size) {
    const vec3 at = checker_cell(spot->body, spot->s, spot->b, spot->arm, size);
    const bool is_flat = shape_traits(spot->body->shape).is_flat;
    const vec3 axis[2] = {cell_change(spot, f->axis[0], size), cell_change(spot, f->axis[1], size)};
    const int longer = vec3_length(axis[1]) > vec3_length(axis[0]);
    const struct cut cut = cut_of(vec3_length(axis[longer]), vec3_length(axis[!longer]));
    double sum = 0;
    for (uint32_t i = 0; i < cut.count; i++) {
        double begin, end;
        part_of(cut, i, &begin, &end);
        const double share = end - begin;
        const vec3 x = vec3_add(at, vec3_mul(axis[longer], (begin + end) / 2));
        const vec3 w = {fabs(axis[longer].x) * share + fabs(axis[!longer].x),
                        fabs(axis[longer].y) * share + fabs(axis[!longer].y),
                        fabs(axis[longer].z) * share + fabs(axis[!longer].z)};
        sum += wave(x.x, w.x) * wave(x.y, w.y) * (is_flat ? 1 : wave(x.z, w.z)) * share;
    }
    return 0.5 - 0.5 * sum;
}

void reference_paint(const struct reference *r, const struct ray *ray, const double b[3], vec3 arm,
                     struct surface *s) {
    const struct scene_material *m = r->materials[s->material].is;
    const struct footprint f = footprint_of(ray, s);
    const struct spot spot = {.r = r,
                              .s = s,
                              .body = r->bodies[s->body].is,
                              .primitive = &r->primitives[s->primitive],
                              .arm = arm,
                              .b = {b[0], b[1], b[2]}};
    struct reference_texel highlight;
    if (m->checker && m->soft) {
        const double odd = odd_share(&spot, &f, m->cell);
        s->diffuse = vec3_mul(vec3_add(vec3_mul(m->diffuse[0], 1 - odd), vec3_mul(m->diffuse[1], odd)),
                              m->diffuse_weight);
    }
    if (m->images[ASSETS_DIFFUSE].texture)
        s->diffuse =
            vec3_mul(image_color(&spot, &f, &m->images[ASSETS_DIFFUSE], &s->texel), m->diffuse_weight);
    if (!m->images[ASSETS_SPECULAR].texture)
        return;
    s->specular =
        vec3_mul(image_color(&spot, &f, &m->images[ASSETS_SPECULAR], &highlight), m->specular_weight);
    highlight.of_highlight = true;
    if (!s->texel.is_there)
        s->texel = highlight;
}
