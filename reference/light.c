// Where light comes from: lights with their shadows, and the background (docs/language.md, "Hit" and
// "Background").
#include "core/angle.h"
#include "core/float_bits.h"
#include "core/srgb.h"
#include "reference/reference_internal.h"

#include "grammar/ir.h"

// A light below the smallest normal float adds nothing that a picture could hold: tails of highlights.
#define LEAST_LIGHT 0x1p-126

// ---- lights

// max(0, r·v)^e by loss = 1 - r·v, which has the digits that large exponents need; 0^0 = 1.
static double highlight(double loss, double exponent) {
    if (exponent == 0)
        return 1;
    return loss < 1 ? exp(exponent * log1p(-loss)) : 0;
}

// Where a sample takes a light.
struct spot {
    vec3 place;   // relative to the origin; for a light that is not infinitely far away
    vec3 l;       // unit, towards it from the surface
    double share; // of what a light at that point would add
};

// A direction of a cap around the axis: (a, b) is in the unit square, and all directions are equally likely.
static vec3 in_cap(vec3 axis, double gap, double a, double b) {
    double x, y;
    reference_disc(a, b, &x, &y);
    const double below = gap * (x * x + y * y), wide = sqrt(gap * (2 - below));
    return reference_turned(axis, x * wide, y * wide, 1 - below);
}

// How much earlier a ray to a light ends if a body has the same surface: as on the device.
#define SHORTER 0x1p-19

// From inside a sphere, half of it; else its visible cap.
static void on_sphere(struct spot *spot, const struct view_light *light, vec3 point, double a, double b) {
    const double radius = light->radius;
    const vec3 way = vec3_sub(spot->place, point);
    const double distance = vec3_length(way);
    const bool inside = distance <= radius;
    const double sine = inside ? 1 : radius / distance;
    const double gap = sine * sine / (1 + sqrt(1 - sine * sine));
    spot->l = in_cap(spot->l, gap, a, b);
    spot->share = 2 / (2 - gap);
    const double middle = vec3_dot(spot->l, way);
    const double beside = vec3_length(vec3_sub(way, vec3_mul(spot->l, middle)));
    const double reach = inside ? radius - light->before_body : radius + light->before_body;
    const double deep = beside < reach ? sqrt((reach - beside) * (reach + beside)) : 0;
    const double part = light->before_body > 0 ? 1 - SHORTER : 1;
    spot->place = vec3_add(point, vec3_mul(spot->l, part * (inside ? middle + deep : middle - deep)));
}

static void on_panel(struct spot *spot, const struct view_light *light, vec3 point, double a, double b) {
    spot->place = vec3_add(spot->place, vec3_mul(light->outward, light->before_body));
    const double before = vec3_length(vec3_sub(spot->place, point));
    spot->place =
        vec3_add(spot->place, vec3_add(vec3_mul(light->edge_u, a - 0.5), vec3_mul(light->edge_v, b - 0.5)));
    const vec3 way = vec3_sub(spot->place, point);
    const double distance = vec3_length(way);
    spot->l = vec3_unit(way);
    spot->share = fmax(0, -vec3_dot(spot->l, light->outward));
    if (light->inverse_square)
        spot->share *= before / distance * (before / distance);
    if (!(distance > 0))
        spot->share = 0;
}

static struct spot spot_of(const struct reference *r, const struct view_light *light, vec3 point,
                           const struct points *points, uint32_t key) {
    struct spot spot = {.place = reference_stored3(r, vec3_sub(light->position, r->origin)), .share = 1};
    double a, b;
    spot.l = light->directional ? light->to_light : vec3_unit(vec3_sub(spot.place, point));
    if (light->extent == VIEW_POINT)
        return spot;
    points_at(points, key, &a, &b);
    if (light->extent == VIEW_PANEL) {
        on_panel(&spot, light, point, a, b);
    } else if (light->extent == VIEW_SPHERE) {
        on_sphere(&spot, light, point, a, b);
    } else {
        const double gap = 2 * sin(light->half_angle / 2) * sin(light->half_angle / 2);
        spot.l = in_cap(spot.l, gap, a, b);
        spot.share = 2 / (2 - gap);
    }
    return spot;
}

// The share of a spot light's emission that it sends against `l`, the direction to it.
static double beam_share(const struct view_light *light, vec3 l) {
    const vec3 off = vec3_add(l, light->axis);
    const double share = fmin(fmax((light->open - vec3_dot(off, off) / 2) * light->rate, 0), 1);
    return light->spot ? share * share : 1;
}

// What the light adds where nothing blocks it.
static vec3 unshadowed(const struct reference *r, const struct view_light *light, const struct spot *spot,
                       const struct surface *s, vec3 direction) {
    const vec3 l = spot->l;
    double facing = vec3_dot(s->shading, l);
    if (!(facing > 0) || !(vec3_dot(s->geometric, l) > 0))
        return (vec3){0, 0, 0};
    vec3 value = vec3_mul(s->diffuse, facing);
    if (!vec3_is_zero(s->specular)) {
        // r·v = 1 - |r - v|² / 2 with v = -direction
        vec3 gap = vec3_add(vec3_sub(vec3_mul(s->shading, 2 * facing), l), direction);
        value = vec3_add(
            value, vec3_mul(s->specular, highlight(0.5 * vec3_dot(gap, gap), s->is->specular_exponent)));
    }
    vec3 emission = vec3_mul(light->emission, spot->share * beam_share(light, l));
    if (light->inverse_square) {
        const vec3 middle = reference_stored3(r, vec3_sub(light->position, r->origin));
        double distance = vec3_length(vec3_sub(middle, s->point));
        emission = vec3_mul(emission, 1 / (distance * distance));
    }
    return vec3_times(emission, value);
}

static struct ray ray_to(const struct reference *r, const struct view_light *light, const struct spot *spot,
                         struct start start) {
    vec3 way = vec3_sub(spot->place, start.at);
    way = reference_rounded3(r, way, vec3_max_abs(way));
    return (struct ray){.start = start,
                        .direction = light->directional ? spot->l : way,
                        .t_max = light->directional ? INFINITY : 1};
}

// What refracting bodies let through to the light: the product of their shares, in the order in which the ray
// hits them. 0: something opaque is between.
static vec3 shining(const struct reference *r, const struct view_light *light, const struct spot *spot,
                    struct start start, struct inside inside, struct lighting *out) {
    vec3 left = {1, 1, 1};
    while (vec3_max_abs(left) > 0) {
        const struct ray ray = ray_to(r, light, spot, start);
        const double length = vec3_length(ray.direction);
        struct intersection hit;
        struct surface s;
        out->shadow_rays++;
        reference_intersect(r, &ray, &hit);
        if (hit.primitive == NO_PRIMITIVE)
            return light->directional ? left : vec3_times(left, reference_left(r, &inside, length));
        reference_surface(r, &ray, &hit, &s);
        reference_cross(r, &inside, &s);
        left = vec3_times(left, reference_left(r, &inside, s.distance * length));
        out->shadow_rays -= s.passes; // it is the same ray that continues
        out->unseen += s.passes;
        if (!s.passes)
            left = vec3_mul(left, reference_shine(&s, vec3_mul(ray.direction, 1 / length)));
        inside = s.after;
        start = reference_leave(r, &s, vec3_neg(s.geometric));
    }
    return left;
}

// The share of the light that comes to the surface.
static vec3 arriving(const struct reference *r, const struct view_light *light, const struct spot *spot,
                     struct start start, const struct inside *inside, struct lighting *out) {
    const struct ir_trace *trace = &r->input.scene->ir->trace;
    if (trace->shadows && trace->transparent_shadows)
        return shining(r, light, spot, start, *inside, out);
    if (!trace->shadows)
        return (vec3){1, 1, 1};
    const struct ray ray = ray_to(r, light, spot, start);
    out->shadow_rays++;
    if (reference_blocks(r, &ray))
        return (vec3){0, 0, 0};
    return light->directional ? (vec3){1, 1, 1} : reference_left(r, inside, vec3_length(ray.direction));
}

// Ambient light that nothing nearby blocks: a ray into the hemisphere, by its cosine (Malley's method).
static vec3 ambient(const struct reference *r, const struct surface *s, const struct inside *inside,
                    const struct points *points, uint32_t key, struct lighting *out) {
    const struct scene *scene = r->input.scene;
    const vec3 value = vec3_times(s->diffuse, scene->ambient);
    if (scene->occlusion == 0 || !scene->ir->trace.shadows || vec3_max_abs(value) < LEAST_LIGHT)
        return value;
    double a, b, x, y;
    points_at(points, point_key(key, POINT_AMBIENT), &a, &b);
    reference_disc(a, b, &x, &y);
    const vec3 l = reference_turned(s->shading, x, y, sqrt(fmax(0, 1 - x * x - y * y)));
    if (!(vec3_dot(l, s->geometric) > 0))
        return (vec3){0, 0, 0};
    const struct view_light nowhere = {.extent = VIEW_POINT};
    const struct spot spot = {.place = vec3_add(s->point, vec3_mul(l, scene->occlusion)), .l = l};
    const struct start start = reference_leave(r, s, s->geometric);
    return vec3_times(value, arriving(r, &nowhere, &spot, start, inside, out));
}

// ---- the background as a light

// The last of `count` shares that begins at or before `place`, and where it ends.
static uint32_t share_at(const uint32_t *begin, uint32_t count, size_t apart, uint32_t place, double *end) {
    uint32_t low = 0, high = count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (begin[middle * apart] <= place)
            low = middle;
        else
            high = middle;
    }
    *end = high < count ? begin[high * apart] : 0x1p32;
    return low;
}

// Where the sample looks (scene/sky.h); its emission is that of a light in this direction.
static vec3 look_up(const struct reference *r, const struct points *points, uint32_t key, vec3 *l) {
    const struct sky_size size = r->sky;
    const struct scene_background *background = &r->input.scene->background;
    uint32_t a, b;
    double row_end, end;
    points_words(points, point_key(key, POINT_SKY), &a, &b);
    const uint32_t row = share_at(r->sky_numbers, size.rows, SKY_ROW_WORDS, b, &row_end);
    const uint32_t *record = r->sky_numbers + (size_t)SKY_ROW_WORDS * row;
    const uint32_t *cells = r->sky_numbers + (size_t)SKY_ROW_WORDS * size.rows + (size_t)row * size.stride;
    const uint32_t column = share_at(cells, size.width, 1, a, &end);
    const double high = row_end - record[0], wide = end - cells[column];
    const double step = (double)float_of_bits(record[2]),
                 gap = (double)float_of_bits(record[1]) + (b - record[0]) / high * step;
    const double longitude = 2 * PI * ((column + 0.5 + (a - cells[column]) / wide) / size.width - 0.5);
    const double level = sqrt(fmax(0, gap * (2 - gap)));
    const double x = level * cos(longitude), z = level * sin(longitude);
    *l = (vec3){x * background->cosine + z * background->sine, step > 0 ? 1 - gap : gap - 1,
                z * background->cosine - x * background->sine};
    // Divided by pi and by the density: the cell's share over its solid angle.
    const double solid = 2 * PI / size.width * fabs(step);
    return vec3_mul(reference_background(r, *l), solid / PI * (0x1p32 / high) * (0x1p32 / wide));
}

static vec3 from_sky(const struct reference *r, const struct surface *s, vec3 direction,
                     const struct inside *inside, const struct points *points, uint32_t key,
                     struct lighting *out) {
    struct view_light light = {.extent = VIEW_POINT, .directional = true};
    struct spot spot = {.share = 1};
    if (!r->sky.rows)
        return (vec3){0, 0, 0};
    light.emission = look_up(r, points, key, &spot.l);
    const vec3 value = unshadowed(r, &light, &spot, s, direction);
    if (vec3_max_abs(value) < LEAST_LIGHT)
        return (vec3){0, 0, 0};
    const struct start start = reference_leave(r, s, s->geometric);
    return vec3_times(value, arriving(r, &light, &spot, start, inside, out));
}

void reference_light(const struct reference *r, const struct surface *s, vec3 direction,
                     const struct inside *inside, const struct points *points, uint32_t key,
                     struct lighting *out) {
    const struct view *view = r->input.view;
    const struct start start = reference_leave(r, s, s->geometric);
    *out = (struct lighting){0};
    for (uint32_t i = 0; i < view->light_count; i++) {
        const struct view_light *light = &view->lights[i];
        const struct spot spot = spot_of(r, light, s->point, points, point_key(key, POINT_LIGHT + i));
        vec3 value = unshadowed(r, light, &spot, s, direction);
        if (vec3_max_abs(value) < LEAST_LIGHT)
            continue;
        uint32_t bit = i < 32 ? UINT32_C(1) << i : 0;
        out->considered |= bit;
        const vec3 share = arriving(r, light, &spot, start, inside, out);
        if (!(vec3_max_abs(share) > 0))
            continue;
        out->lit |= bit;
        out->sum = vec3_add(out->sum, vec3_times(value, share));
    }
    const vec3 around = ambient(r, s, inside, points, key, out);
    out->sum = vec3_add(out->sum, vec3_add(s->is->emission, around));
    out->sum = vec3_add(out->sum, from_sky(r, s, direction, inside, points, key, out));
}

// ---- background

static double channel(const struct reference *r, const struct picture *picture, size_t at, size_t c) {
    if (picture_is_linear(picture))
        return (double)picture_linear(picture, at, c);
    return r->decoded[picture_stored(picture, at, c)];
}

static vec3 texel(const struct reference *r, size_t column, size_t row) {
    const struct picture *picture = r->input.scene->background.picture;
    size_t at = row * picture->width + column;
    return (vec3){channel(r, picture, at, 0), channel(r, picture, at, 1), channel(r, picture, at, 2)};
}

static vec3 mixed(vec3 a, vec3 b, double part) {
    return vec3_add(vec3_mul(a, 1 - part), vec3_mul(b, part));
}

static vec3 background_image(const struct reference *r, vec3 d) {
    const struct scene_background *background = &r->input.scene->background;
    const struct picture *picture = background->picture;
    // Rotated by the negative rotation about +y.
    double x = d.x * background->cosine - d.z * background->sine;
    double z = d.x * background->sine + d.z * background->cosine;
    double u = (0.5 + atan2(z, x) / (2 * PI)) * picture->width - 0.5;
    double v = atan2(hypot(x, z), d.y) / PI * picture->height - 0.5;
    double u_floor = floor(u);
    double v_floor = floor(v);
    size_t width = picture->width;
    size_t height = picture->height;
    size_t left = u_floor < 0 ? width - 1 : (size_t)u_floor % width;
    size_t right = (left + 1) % width;
    size_t top = v_floor < 0 ? 0 : (size_t)v_floor < height ? (size_t)v_floor : height - 1;
    size_t bottom = v_floor + 1 < (double)height ? (size_t)(v_floor + 1) : height - 1;
    vec3 upper = mixed(texel(r, left, top), texel(r, right, top), u - u_floor);
    vec3 lower = mixed(texel(r, left, bottom), texel(r, right, bottom), u - u_floor);
    return vec3_mul(mixed(upper, lower, v - v_floor), background->intensity);
}

vec3 reference_background(const struct reference *r, vec3 direction) {
    const struct scene_background *background = &r->input.scene->background;
    if (!background->picture)
        return background->color;
    if (r->input.gradient)
        return vec3_mul(vec3_add(direction, (vec3){1, 1, 1}), 0.5 * background->intensity);
    return background_image(r, direction);
}

static double rgbe_brightest(const struct reference *r, size_t texels) {
    const struct picture *picture = r->input.scene->background.picture;
    double most = 0;
    for (size_t at = 0; at < texels; at++)
        for (size_t c = 0; c < 3; c++)
            most = reference_larger(most, channel(r, picture, at, c));
    return most;
}

// The brightest channel: decoding keeps the order of stored values, and most pictures contain the largest
// one.
static double image_brightest(const struct reference *r) {
    const struct picture *picture = r->input.scene->background.picture;
    const size_t texels = (size_t)picture->width * picture->height;
    if (picture_is_linear(picture))
        return rgbe_brightest(r, texels);
    const size_t greatest = picture_greatest(picture->depth);
    size_t most = 0;
    for (size_t at = 0; at < texels && most < greatest; at++)
        for (size_t c = 0; c < 3; c++) {
            const size_t value = picture_stored(picture, at, c);
            most = value > most ? value : most;
        }
    return r->decoded[most];
}

static void make_sky(struct reference *r) {
    const struct sky_size size = sky_size(r->input.scene);
    bool is_black = false;
    if (!size.rows)
        return;
    r->sky_numbers = ARENA_ARRAY(&r->arena, uint32_t, sky_count(size));
    if (!sky_fill(r->input.scene, size, r->sky_numbers, &is_black))
        arena_raise(&r->arena, ARENA_FAULT_SYSTEM);
    if (!is_black)
        r->sky = size;
}

void reference_make_background(struct reference *r) {
    const struct scene_background *background = &r->input.scene->background;
    const struct picture *picture = background->picture;
    bool srgb = r->input.scene->ir->image.transfer == IR_TRANSFER_SRGB;
    r->background_brightest = reference_brightest(background->color);
    make_sky(r);
    if (!picture || r->input.gradient)
        return;
    if (!picture_is_linear(picture)) {
        size_t greatest = picture_greatest(picture->depth);
        r->decoded = ARENA_ARRAY(&r->arena, double, greatest + 1);
        for (size_t i = 0; i <= greatest; i++) {
            double value = (double)i / (double)greatest;
            r->decoded[i] = srgb ? srgb_decode(value) : value;
        }
    }
    if (!r->input.no_bound)
        r->background_brightest = image_brightest(r) * background->intensity;
}
