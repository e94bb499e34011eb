// Images and checkers that are finer than the pixels of the picture, where no filter averages over a pixel.
//
// Rays through a grid over the picture find spheres, rectangles and cones, and each triangle of a mesh counts
// with the pixels that it covers. What lies in front of a body is left out: it covers fine parts and coarse
// ones alike.
#include "core/angle.h"
#include "diag/codes/rule.h"
#include "lint/lint_internal.h"

#include "core/heap.h"
#include "grammar/ir.h"

#include <string.h>

enum {
    COLUMNS = 64,          // of the grid, at most
    TRIANGLES_MOST = 4096, // of a mesh, evenly picked
    WORK_MAX = 20000000,   // rays and triangles
};

// A pixel covers more than this many of an image's pixels, or cells of a checker, along its longer direction.
static const double IMAGE_FINE = 2, CELL_FINE = 1;
// An image that is filtered has more than this many texels per sample, and at least so many in total that it
// matters.
static const double EXCESS = 8, LARGE = 1 << 20;
// Such pixels, without a filter, are at least this share of the pixels that show the material, and of the
// picture.
static const double SHARE_MIN = 0.3, PICTURE_MIN = 0.02;

// What a material shows that is not one plain colour.
struct bare {
    bool filtered;                  // an image whose filter is auto
    const struct ir_texture *image; // NULL: a checker
    const struct picture *picture;  // of the image
    vec3 u, v;                      // of an image: its pixels by surface coordinates (two count)
    double cell;                    // of a checker
};

// Pixels of the picture that show a material: all, and those where it is too fine; and the least that a pixel
// covers along its shorter direction.
struct shown {
    double pixels, fine, least;
};

struct looking {
    struct lint *lint;
    const struct view_camera *camera;
    const struct lint_body *body;
    double aspect;
    double rows;         // of the pixels that filters average over: of samples, with an error the fewest
    struct bare *bare;   // by material
    struct shown *shown; // by material
};

// A place on a body: how its coordinates change with the place in space.
struct spot {
    vec3 point, normal; // the normal of any length
    struct view_sight sight;
    vec3 change[3]; // of u, v and a third; of checkers in scene units
    uint32_t material;
    double pixels; // of the picture that it stands for
};

// ---- what is too fine

static double length_in(const struct bare *bare, const struct spot *s, vec3 axis) {
    const double u = vec3_dot(s->change[0], axis), v = vec3_dot(s->change[1], axis),
                 w = vec3_dot(s->change[2], axis);
    if (bare->image)
        return hypot(bare->u.x * u + bare->u.y * v, bare->v.x * u + bare->v.y * v);
    return fmax(fabs(u), fmax(fabs(v), fabs(w))) / bare->cell;
}

// The axes of a pixel on the surface are those that a filter would use (reference/paint.c).
static void add_spot(struct looking *l, const struct spot *s) {
    const struct bare *bare = &l->bare[s->material];
    const vec3 n = vec3_unit(s->normal), d = s->sight.direction;
    const double facing = fmax(fabs(vec3_dot(d, n)), 1e-6);
    const double width = s->sight.height / l->rows;
    vec3 along = vec3_sub(d, vec3_mul(n, vec3_dot(d, n)));
    if (!(bare->image || bare->cell > 0) || !(width > 0))
        return;
    if (vec3_length(along) < 1e-4)
        along = vec3_cross(n, fabs(n.x) < 0.5 ? (vec3){1, 0, 0} : (vec3){0, 1, 0});
    along = vec3_unit(along);
    const double down = length_in(bare, s, vec3_mul(along, width / facing)),
                 across = length_in(bare, s, vec3_mul(vec3_cross(n, along), width));
    const double longer = fmax(down, across), shorter = fmin(down, across);
    struct shown *shown = &l->shown[s->material];
    shown->least = shown->pixels > 0 ? fmin(shown->least, shorter) : shorter;
    shown->pixels += s->pixels;
    shown->fine += longer > (bare->image ? IMAGE_FINE : CELL_FINE) ? s->pixels : 0;
}

// ---- bodies

static void own_axes(const struct scene_body *body, struct spot *s) {
    const affine3 back = transform_inverse(body->object_to_world);
    const double cells[3] = {body->cells->scale.x, body->cells->scale.y, body->cells->scale.z};
    for (int k = 0; k < 3; k++)
        s->change[k] = vec3_mul(mat3_row(back.linear, k), cells[k]);
}

// Longitude and latitude, as the sphere's coordinates.
static void sphere_change(const struct bare *bare, const struct scene_body *body, struct spot *s) {
    const mat3 axes = body->object_to_world.linear;
    const double radius = body->radius;
    const vec3 o = shape_into_frame(body, vec3_unit(s->normal));
    const double around2 = fmax(o.x * o.x + o.z * o.z, 1e-12), around = sqrt(around2);
    const vec3 up = {-o.x * o.y, around2, -o.z * o.y};
    if (!bare->image)
        return;
    s->change[0] = vec3_mul(mat3_apply(axes, (vec3){-o.z, 0, o.x}), 1 / (around2 * 2 * PI * radius));
    s->change[1] = vec3_mul(mat3_apply(axes, up), 2 / (around * 2 * PI * radius));
    s->change[2] = (vec3){0, 0, 0};
}

static bool meet_sphere(const struct looking *l, struct view_ray ray, struct spot *s) {
    const struct scene_body *body = l->body->is;
    const vec3 from = vec3_sub(ray.start, body->object_to_world.offset);
    const double b = vec3_dot(from, ray.direction);
    const double root = b * b - (vec3_dot(from, from) - body->radius * body->radius);
    if (!(root > 0) || !(-b - sqrt(root) > 0))
        return false;
    s->normal = vec3_add(from, vec3_mul(ray.direction, -b - sqrt(root)));
    s->point = vec3_add(s->normal, body->object_to_world.offset);
    own_axes(body, s);
    sphere_change(&l->bare[s->material], body, s);
    return true;
}

// As docs/language.md has a cone's coordinates.
static void cone_change(const struct bare *bare, const struct scene_body *body, vec3 from, bool side,
                        bool at_to, struct spot *s) {
    const mat3 *frame = &body->object_to_world.linear;
    const vec3 x = mat3_column(*frame, 0), y = mat3_column(*frame, 1), z = mat3_column(*frame, 2);
    const double a = vec3_dot(x, from), b = vec3_dot(z, from);
    const double around2 = fmax(a * a + b * b, 1e-24 * body->height * body->height);
    const double radius = at_to ? body->radius_to : body->radius;
    own_axes(body, s);
    if (!bare->image)
        return;
    s->change[0] = side ? vec3_mul(vec3_sub(vec3_mul(z, a), vec3_mul(x, b)), 1 / (around2 * 2 * PI))
                        : vec3_mul(x, 0.5 / radius);
    s->change[1] = side ? vec3_mul(y, 1 / body->height) : vec3_mul(z, (at_to ? -0.5 : 0.5) / radius);
    s->change[2] = (vec3){0, 0, 0};
}

static bool meet_cone(const struct looking *l, struct view_ray ray, struct spot *s) {
    const struct scene_body *body = l->body->is;
    const struct shape_cone cone = shape_cone_of(body);
    double t[2];
    bool side[2];
    if (!shape_cone_crossing(&cone, ray.start, ray.direction, t, side) || !(t[0] > 0))
        return false;
    s->point = vec3_add(ray.start, vec3_mul(ray.direction, t[0]));
    const vec3 from = vec3_sub(s->point, cone.from);
    const vec3 across = vec3_unit(vec3_sub(from, vec3_mul(cone.axis, vec3_dot(from, cone.axis))));
    const bool at_to = vec3_dot(ray.direction, cone.axis) < 0;
    s->normal =
        side[0] ? vec3_sub(vec3_mul(across, cone.height), vec3_mul(cone.axis, cone.radius_to - cone.radius))
                : vec3_mul(cone.axis, at_to ? 1 : -1);
    cone_change(&l->bare[s->material], body, from, side[0], at_to, s);
    return true;
}

static bool meet_sheet(const struct looking *l, struct view_ray ray, struct spot *s) {
    const affine3 map = l->body->is->object_to_world;
    const vec3 u = mat3_apply(map.linear, (vec3){1, 0, 0}), v = mat3_apply(map.linear, (vec3){0, 1, 0});
    s->normal = vec3_cross(u, v);
    const double nn = vec3_dot(s->normal, s->normal), down = vec3_dot(s->normal, ray.direction);
    const double t = vec3_dot(s->normal, vec3_sub(map.offset, ray.start)) / down;
    const vec3 q = vec3_sub(vec3_add(ray.start, vec3_mul(ray.direction, t)), map.offset);
    s->change[0] = vec3_mul(vec3_cross(v, s->normal), 1 / nn);
    s->change[1] = vec3_mul(vec3_cross(s->normal, u), 1 / nn);
    s->change[2] = (vec3){0, 0, 0};
    const double a = vec3_dot(s->change[0], q), b = vec3_dot(s->change[1], q);
    s->point = vec3_add(q, map.offset);
    if (!l->bare[s->material].image) { // a checker counts lengths
        s->change[0] = vec3_mul(s->change[0], vec3_length(u));
        s->change[1] = vec3_mul(s->change[1], vec3_length(v));
    }
    return down != 0 && t > 0 && a >= 0 && a <= 1 && b >= 0 && b <= 1;
}

static void look_at_shape(struct looking *l,
                          bool (*meet)(const struct looking *l, struct view_ray ray, struct spot *s)) {
    const struct ir_image *image = l->lint->input->image;
    const uint32_t columns = image->width < COLUMNS ? (uint32_t)image->width : COLUMNS;
    const uint32_t rows =
        (uint32_t)fmax(1, fmin(image->height, columns * (double)image->height / image->width));
    for (uint32_t i = 0; i < columns * rows; i++) {
        const double x = 2 * (i % columns + 0.5) / columns - 1, y = 1 - 2 * (i / columns + 0.5) / rows;
        const struct view_ray ray = view_ray_at(l->camera, l->aspect, x, y);
        struct spot s = {.material = l->body->is->materials[0],
                         .pixels = (double)image->width * image->height / (columns * rows)};
        if (meet(l, ray, &s) && view_sight_of(l->camera, l->aspect, s.point, &s.sight))
            add_spot(l, &s);
    }
}

static void look_at_triangle(struct looking *l, uint32_t triangle, double stands_for) {
    const struct scene_body *body = l->body->is;
    struct spot s = {.material = scene_body_material(body, triangle)};
    vec3 c[3];
    struct ir_pair at[3];
    scene_corners(body, &body->object_to_world, triangle, c);
    const vec3 e = vec3_sub(c[1], c[0]), f = vec3_sub(c[2], c[0]);
    s.normal = vec3_cross(e, f);
    s.point = vec3_mul(vec3_add(c[0], vec3_add(c[1], c[2])), 1.0 / 3);
    const double nn = vec3_dot(s.normal, s.normal);
    if (!(nn > 0) || !view_sight_of(l->camera, l->aspect, s.point, &s.sight))
        return;
    own_axes(body, &s);
    if (l->bare[s.material].image) {
        const vec3 b1 = vec3_mul(vec3_cross(f, s.normal), 1 / nn),
                   b2 = vec3_mul(vec3_cross(s.normal, e), 1 / nn);
        scene_coordinates(body, triangle, at);
        s.change[0] = vec3_add(vec3_mul(b1, at[1].u - at[0].u), vec3_mul(b2, at[2].u - at[0].u));
        s.change[1] = vec3_add(vec3_mul(b1, at[1].v - at[0].v), vec3_mul(b2, at[2].v - at[0].v));
    }
    const double rows = l->lint->input->image->height;
    s.pixels = stands_for * fabs(vec3_dot(s.normal, s.sight.direction)) / 2 * s.sight.density * rows * rows;
    add_spot(l, &s);
}

static void look_at(struct looking *l) {
    const uint32_t count = l->body->is->triangle_count;
    switch (l->body->is->shape) {
    case SCENE_SPHERE:
        look_at_shape(l, meet_sphere);
        return;
    case SCENE_PARALLELOGRAM:
        look_at_shape(l, meet_sheet);
        return;
    case SCENE_CONE:
        look_at_shape(l, meet_cone);
        return;
    case SCENE_MESH:
        break;
    }
    const uint32_t step = count / TRIANGLES_MOST + 1;
    for (uint32_t t = 0; l->body->mesh && t < count; t += step)
        look_at_triangle(l, t, step);
}

// ---- materials

// An image without a filter comes before one with. false: one colour.
static bool make_bare(const struct lint *lint, uint32_t material, struct bare *out) {
    const struct ir_material *m = &lint->scene->assets->materials[material];
    const struct scene_material *s = &lint->scene->materials[material];
    const struct ir_texture *images[ASSETS_IMAGES] = {&m->diffuse_color.image, &m->specular_color.image};
    *out = (struct bare){.filtered = true};
    for (int k = 0; lint->scene->assets->images && k < ASSETS_IMAGES && out->filtered; k++) {
        const struct picture *picture = lint->scene->assets->images[material][k];
        if (picture)
            *out = (struct bare){
                .filtered = s->images[k].filter == IR_FILTER_AUTO,
                .image = images[k],
                .picture = picture,
                .u = vec3_mul((vec3){s->images[k].u[0], s->images[k].u[1], 0}, picture->width),
                .v = vec3_mul((vec3){s->images[k].v[0], s->images[k].v[1], 0}, picture->height)};
    }
    if (out->image)
        return true;
    *out = (struct bare){.cell = s->checker && !s->soft ? s->cell : 0};
    return out->cell > 0;
}

static bool shows_any(const struct looking *l, const struct lint_body *body) {
    for (uint32_t g = 0; lint_is_there(body) && g < body->is->group_count; g++) {
        const struct bare *bare = &l->bare[body->is->materials[g]];
        if (bare->image || bare->cell > 0)
            return true;
    }
    return false;
}

static void report(struct lint *lint, uint32_t material, const struct bare *bare, const struct shown *shown) {
    const struct ir_material *m = &lint->scene->assets->materials[material];
    const int percent = (int)(100 * shown->fine / shown->pixels + 0.5);
    if (bare->image) {
        const span at = ir_place_value(lint->origin, &bare->image->head, &SCHEMA_TEXTURE, "filter");
        diag_add(
            lint->sink, DIAG_TOO_FINE, at,
            "the image of %.*s is finer than the picture: in %d %% of its place there, a pixel covers more "
            "than %g of the image's in a row and shows the colour of one",
            STR_ARG(lint_material_words(lint, m)), percent, IMAGE_FINE);
        diag_help(lint->sink, "write filter: auto, the mean over what a pixel covers");
        diag_fix(lint->sink, false, at, STR("auto"));
        return;
    }
    diag_add(
        lint->sink, DIAG_TOO_FINE,
        ir_place_value(lint->origin, &m->diffuse_color.checker.head, &SCHEMA_CHECKER, "size"),
        "the checker of %.*s is finer than the picture: in %d %% of its place there, a pixel covers more "
        "than a cell and shows the colour of one",
        STR_ARG(lint_material_words(lint, m)), percent);
    diag_help(lint->sink, "write antialias: true in the checker, or larger cells");
}

// For a filtered image: it is larger than it need be, if this holds everywhere and nothing magnifies it.
static void report_oversized(struct lint *lint, uint32_t material, const struct bare *bare, double least) {
    const struct ir_material *m = &lint->scene->assets->materials[material];
    const struct picture *picture = bare->picture;
    const double enough = exp2(floor(log2(least)));
    if (bare->image->head.origin == 0 || (double)picture->width * picture->height < LARGE)
        return;
    diag_add(lint->sink, DIAG_OVERSIZED_IMAGE,
             ir_place_value(lint->origin, &bare->image->head, &SCHEMA_TEXTURE, "file"),
             "the image of %.*s has %u x %u pixels, at least %.3g times more in a row than a picture of %d x "
             "%d shows",
             STR_ARG(lint_material_words(lint, m)), picture->width, picture->height, least,
             lint->input->image->width, lint->input->image->height);
    diag_help(lint->sink, "an image of %.0f x %.0f pixels is enough for this picture",
              ceil(picture->width / enough), ceil(picture->height / enough));
}

static void report_all(struct lint *lint, const struct bare *bare, const struct shown *worst) {
    const double all = (double)lint->input->image->width * lint->input->image->height;
    const bool may_magnify = lint_sends_rays_on(lint);
    for (uint32_t m = 0; m < lint->scene->assets->material_count; m++) {
        const struct shown *w = &worst[m];
        if (bare[m].filtered && !may_magnify && w->pixels > 0 && w->least > EXCESS)
            report_oversized(lint, m, &bare[m], w->least);
        else if (!bare[m].filtered && w->fine > PICTURE_MIN * all && w->fine > SHARE_MIN * w->pixels)
            report(lint, m, &bare[m], w);
    }
}

void lint_too_fine(struct lint *lint) {
    const struct ir_image *image = lint->input->image;
    const uint32_t materials = lint->scene->assets->material_count;
    const int32_t samples =
        image->error > 0 && image->min_samples < image->samples ? image->min_samples : image->samples;
    struct looking l = {.lint = lint, .bare = ARENA_ARRAY(lint->arena, struct bare, materials)};
    bool any = false;
    for (uint32_t m = 0; m < materials; m++)
        any |= make_bare(lint, m, &l.bare[m]);
    struct shown *worst = any ? ARENA_ARRAY(lint->arena, struct shown, materials) : NULL;
    uint64_t work = 0;
    l.shown = any ? ARENA_ARRAY(lint->arena, struct shown, materials) : NULL;
    for (uint32_t c = 0; any && c < lint->view_count && work < WORK_MAX; c++) {
        l.camera = &lint->views[c].camera;
        memset(l.shown, 0, heap_times(materials, sizeof *l.shown));
        work += materials;
        l.aspect = (double)image->width / image->height;
        l.rows = image->height * sqrt(samples);
        for (uint32_t i = 0; i < lint->body_count && work < WORK_MAX; i++) {
            l.body = &lint->bodies[i];
            work++;
            if (!shows_any(&l, l.body))
                continue;
            work += TRIANGLES_MOST;
            look_at(&l);
        }
        for (uint32_t m = 0; m < materials; m++) {
            const struct shown *now = &l.shown[m];
            const double least = worst[m].pixels > 0 ? fmin(worst[m].least, now->least) : now->least;
            if (now->pixels > 0 && now->fine >= worst[m].fine)
                worst[m] = *now;
            worst[m].least = now->pixels > 0 ? least : worst[m].least;
        }
    }
    if (any)
        report_all(lint, l.bare, worst);
}
