// What every pixel's first ray meets, on the device, against closed forms in double and against the same
// traversal on the processor.
// Usage: test_hits [few]: `few` leaves out what is known of other tracers' ways.
#include "device_kit.h"
#include "flat_kit.h"
#include "tests/traverse/traverse.h"
#include "tracer/render/render.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    WIDTH = 161, // no whole number of tiles
    HEIGHT = 115,
    PIXELS = WIDTH * HEIGHT,
    BODIES = 3,
};
#define TAN_HALF_FOV 0.6

static struct view_camera camera_at(vec3 position) {
    return (struct view_camera){.position = position,
                                .right = {1, 0, 0},
                                .up = {0, 1, 0},
                                .forward = {0, 0, -1},
                                .tan_half_fov = TAN_HALF_FOV};
}

static vec3 pixel_direction(double x, double y) {
    return vec3_unit(
        (vec3){(2 * x / WIDTH - 1) * TAN_HALF_FOV * WIDTH / HEIGHT, (1 - 2 * y / HEIGHT) * TAN_HALF_FOV, -1});
}

// The hits of the kit's scene; the caller frees. *unfinished may be NULL where there must be none.
static struct hit_pixel *take(void **state, struct kit *kit, const struct flat_scene *flat, vec3 position,
                              enum render_alternative alternative, uint64_t *unfinished) {
    struct render_settings settings = render_settings_of(&kit->resolved, flat, &kit->limits);
    settings.alternative = alternative;
    settings.width = WIDTH;
    settings.height = HEIGHT;
    struct renderer *renderer = renderer_create(device_kit_need(state, flat->is_double), flat, &settings);
    assert_non_null(renderer);
    struct hit_pixel *hits = calloc(PIXELS, sizeof *hits);
    const struct view_camera camera = camera_at(position);
    assert_int_equal(renderer_hits(renderer, &camera, hits, NULL), RENDER_DONE);
    if (unfinished)
        *unfinished = renderer_hits_unfinished(renderer);
    else
        assert_int_equal(renderer_hits_unfinished(renderer), 0);
    renderer_destroy(renderer);
    return hits;
}

// ---- closed forms: a mirror ball, a glass ball, a floor, in double

enum {
    MIRROR,
    GLASS,
    FLOOR
};

static const vec3 CENTER[2] = {{-1, 0, -4}, {1, 0.1, -4}};
static const double RADIUS[2] = {0.8, 0.7};
static const vec3 CORNER = {-4, -1, -1};
static const double FLOOR_X = 8, FLOOR_Z = 7;
static const vec3 LIGHTS[3] = {{3, 5, 0}, {0, -5, -3}, {-2, 0.5, 1}}; // the second stands below the floor
static const double GLASS_INDEX = 1.5;

struct meeting {
    double t;
    uint32_t body, triangle;
    vec3 normal; // towards the viewer
    bool enters;
};

static void meet_sphere(vec3 origin, vec3 direction, uint32_t body, double after, struct meeting *m) {
    const vec3 f = vec3_sub(origin, CENTER[body]);
    const double b = -vec3_dot(f, direction);
    const vec3 nearest = vec3_add(f, vec3_mul(direction, b));
    const double gap = RADIUS[body] * RADIUS[body] - vec3_dot(nearest, nearest);
    if (gap < 0)
        return;
    const double t = b - sqrt(gap) > after ? b - sqrt(gap) : b + sqrt(gap);
    if (t <= after || t >= m->t)
        return;
    const vec3 out = vec3_unit(vec3_add(f, vec3_mul(direction, t)));
    const bool enters = vec3_dot(out, direction) <= 0;
    *m = (struct meeting){t, body, 0, enters ? out : vec3_neg(out), enters};
}

// The nearest thing behind `after`.
static struct meeting meet(vec3 origin, vec3 direction, double after, double end) {
    struct meeting m = {.t = end, .body = HIT_NONE};
    meet_sphere(origin, direction, MIRROR, after, &m);
    meet_sphere(origin, direction, GLASS, after, &m);
    const double t = (CORNER.y - origin.y) / direction.y;
    const vec3 at = vec3_sub(vec3_add(origin, vec3_mul(direction, t)), CORNER);
    const double u = at.x / FLOOR_X, v = -at.z / FLOOR_Z;
    if (t > after && t < m.t && u >= 0 && u <= 1 && v >= 0 && v <= 1)
        m = (struct meeting){t, FLOOR, u < v, {0, direction.y < 0 ? 1 : -1, 0}, direction.y < 0};
    return m;
}

static struct hit_pixel expected(vec3 direction) {
    const vec3 origin = {0, 0, 0};
    const double leave = 1e-9;
    struct hit_pixel hit = {.body = HIT_NONE, .reflected = HIT_NONE, .refracted = HIT_NONE};
    const struct meeting m = meet(origin, direction, 0, HUGE_VAL);
    if (m.body == HIT_NONE)
        return hit;
    const vec3 at = vec3_mul(direction, m.t);
    hit.body = m.body;
    hit.triangle = m.triangle;
    hit.distance = m.t;
    hit.normal = m.normal;
    for (int i = 0; i < 3 && m.body != GLASS; i++) {
        const vec3 way = vec3_sub(LIGHTS[i], at), l = vec3_unit(way);
        if (vec3_dot(l, m.normal) <= 0)
            continue;
        hit.considered |= 1u << i;
        if (meet(at, l, leave, vec3_length(way)).body == HIT_NONE)
            hit.lit |= 1u << i;
    }
    const double c = -vec3_dot(direction, m.normal);
    if (m.body == MIRROR)
        hit.reflected = meet(at, vec3_add(direction, vec3_mul(m.normal, 2 * c)), leave, HUGE_VAL).body;
    if (m.body == GLASS) {
        const double eta = 1 / GLASS_INDEX, k = 1 - eta * eta * (1 - c * c);
        const vec3 bent = vec3_add(vec3_mul(direction, eta), vec3_mul(m.normal, eta * c - sqrt(k)));
        hit.refracted = meet(at, vec3_unit(bent), leave, HUGE_VAL).body;
    }
    return hit;
}

static bool same_names(const struct hit_pixel *a, const struct hit_pixel *b) {
    return a->body == b->body && a->triangle == b->triangle && a->considered == b->considered &&
           a->lit == b->lit && a->reflected == b->reflected && a->refracted == b->refracted;
}

// false: what is next to the pixel's centre differs, so that rounding may decide.
static bool is_certain(int x, int y, const struct hit_pixel *wanted) {
    const double step = 1e-3;
    for (int k = 0; k < 4; k++) {
        const struct hit_pixel near =
            expected(pixel_direction(x + 0.5 + (k & 1 ? step : -step), y + 0.5 + (k & 2 ? step : -step)));
        if (!same_names(&near, wanted))
            return false;
    }
    return true;
}

static void make_scene(struct kit *kit) {
    kit_init(kit);
    struct ir_material *mirror = kit_material(kit);
    mirror->albedo = (struct ir_weights){0.5, 0, 0.5, 0};
    struct ir_material *glass = kit_material(kit);
    glass->albedo = (struct ir_weights){0, 0, 0, 0.8};
    glass->refractive_index = GLASS_INDEX;
    for (uint32_t i = 0; i < 2; i++) {
        struct ir_sphere *sphere = kit_sphere(kit);
        sphere->center = CENTER[i];
        sphere->radius = RADIUS[i];
        kit_use_material(&sphere->material, i);
    }
    struct ir_rectangle *ground = kit_rectangle(kit);
    ground->corner = CORNER;
    ground->edge_u = (vec3){FLOOR_X, 0, 0};
    ground->edge_v = (vec3){0, 0, -FLOOR_Z};
    for (int i = 0; i < 3; i++)
        kit_light(kit, LIGHTS[i]);
}

static void compare(const struct hit_pixel *got, const struct hit_pixel *wanted, int x, int y) {
    if (!same_names(got, wanted))
        fail_msg("pixel %d,%d: body %d triangle %u considered %x lit %x reflected %d refracted %d, "
                 "should be %d %u %x %x %d %d",
                 x, y, (int)got->body, got->triangle, got->considered, got->lit, (int)got->reflected,
                 (int)got->refracted, (int)wanted->body, wanted->triangle, wanted->considered, wanted->lit,
                 (int)wanted->reflected, (int)wanted->refracted);
    if (fabs(got->distance - wanted->distance) > 1e-4 * wanted->distance ||
        vec3_length(vec3_sub(got->normal, wanted->normal)) > 2e-3)
        fail_msg("pixel %d,%d: distance %g normal %g %g %g, should be %g and %g %g %g", x, y, got->distance,
                 got->normal.x, got->normal.y, got->normal.z, wanted->distance, wanted->normal.x,
                 wanted->normal.y, wanted->normal.z);
}

static void check_closed_forms(void **state, bool is_double) {
    device_kit_need(state, is_double);
    struct kit kit;
    struct flat_scene flat;
    make_scene(&kit);
    kit.is_double = is_double;
    assert_true(kit_flatten(&kit, &flat));
    struct hit_pixel *hits = take(state, &kit, &flat, (vec3){0, 0, 0}, RENDER_ALTERNATIVE_NONE, NULL);
    int uncertain = 0, seen[BODIES] = {0}, shadows = 0, mirrored = 0, through = 0, nothing = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const struct hit_pixel wanted = expected(pixel_direction(x + 0.5, y + 0.5));
            const struct hit_pixel *got = hits + y * WIDTH + x;
            if (!is_certain(x, y, &wanted)) {
                uncertain++;
                continue;
            }
            compare(got, &wanted, x, y);
            nothing += got->body == HIT_NONE;
            if (got->body < BODIES)
                seen[got->body]++;
            shadows += got->considered != got->lit;
            mirrored += got->reflected != HIT_NONE;
            through += got->refracted != HIT_NONE;
        }
    // Each of what is compared occurs.
    assert_true(nothing && seen[MIRROR] && seen[GLASS] && seen[FLOOR] && shadows && mirrored && through);
    assert_in_range(uncertain, 0, PIXELS / 500);
    free(hits);
    flat_finish(&flat);
    kit_finish(&kit);
}

static void test_closed_forms(void **state) {
    check_closed_forms(state, false);
}

static void test_closed_forms_double(void **state) {
    check_closed_forms(state, true);
}

// ---- a mesh, against the traversal on the processor

static struct hit_pixel traversed(const struct flat_scene *flat, vec3 direction) {
    const struct traverse_scene scene = {flat->triangle_nodes.words, flat->triangles.words};
    const struct traverse_ray ray = {
        {0, 0, 0}, {(float)direction.x, (float)direction.y, (float)direction.z}, 3e38f};
    struct traverse_hit found;
    if (!traverse_closest(&scene, &ray, &found))
        return (struct hit_pixel){.body = HIT_NONE};
    return (struct hit_pixel){.triangle = found.triangle,
                              .distance = ldexp((double)found.distance, -flat->scale_exponent)};
}

static void test_mesh(void **state) {
    device_kit_need(state, false);
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    kit.origin = (vec3){1e3, -2e3, 300};
    struct ir_model *model = kit_model(&kit, kit_icosphere(&kit, 4, 0));
    model->scale = (vec3){40, 30, 50};
    model->rotation = (vec3){10, 20, 30};
    model->translation = (vec3){1e3 + 3, -2e3 + 2, 300 - 120};
    model->smooth = true;
    assert_true(kit_flatten(&kit, &flat));
    struct hit_pixel *hits = take(state, &kit, &flat, kit.origin, RENDER_ALTERNATIVE_NONE, NULL);
    int different = 0, met = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const struct hit_pixel wanted = traversed(&flat, pixel_direction(x + 0.5, y + 0.5));
            const struct hit_pixel *got = hits + y * WIDTH + x;
            different += got->body != wanted.body || got->triangle != wanted.triangle;
            met += got->body == 0;
            if (got->body != 0 || wanted.body != 0)
                continue;
            assert_true(fabs(got->distance - wanted.distance) <= 1e-3 * wanted.distance);
            assert_true(fabs(vec3_length(got->normal) - 1) < 1e-6);
        }
    assert_in_range(met, PIXELS / 10, PIXELS / 2);
    // The directions may differ in their last bit, which decides at edges.
    assert_in_range(different, 0, PIXELS / 500);
    free(hits);
    flat_finish(&flat);
    kit_finish(&kit);
}

// ---- the path of a pixel, told: its rays add up to the picture, bit for bit

static void follow(const struct render_segment *segments, uint32_t count, uint32_t *deepest, uint32_t *cut) {
    for (uint32_t i = 1; i < count; i++) {
        assert_true(segments[i].parent < i);
        assert_int_equal(segments[i].depth, segments[segments[i].parent].depth + 1);
        *deepest = segments[i].depth > *deepest ? segments[i].depth : *deepest;
        *cut += segments[i].cut_weight > 0;
    }
}

static void check_log(void **state, bool is_double, int more_lights) {
    enum {
        SEGMENTS = 512
    };
    struct gpu *gpu = device_kit_need(state, is_double);
    struct kit kit;
    struct flat_scene flat;
    make_scene(&kit);
    kit.scene.materials.items[GLASS].albedo.reflection = 0.25;
    kit.scene.trace.max_depth = 5;
    kit.is_double = is_double;
    // Of many lights the sum keeps what rounding drops, in the picture as in what is told.
    for (int i = 0; i < more_lights; i++)
        kit_light(&kit, (vec3){3 * sin(i), 5 + 0.1 * i, 3 * cos(i)})->emission =
            (vec3){0.01, 0.013 / (1 + i), 0.7};
    assert_true(kit_flatten(&kit, &flat));
    struct render_settings settings = render_settings_of(&kit.resolved, &flat, &kit.limits);
    settings.width = WIDTH;
    settings.height = HEIGHT;
    settings.background = (vec3){0.2, 0.7, 0.8};
    const struct view_camera camera = camera_at((vec3){0, 0, 0});
    struct renderer *renderer = renderer_create(gpu, &flat, &settings);
    assert_non_null(renderer);
    float *rgb = calloc(3 * PIXELS, sizeof *rgb);
    struct hit_pixel *hits = calloc(PIXELS, sizeof *hits);
    struct render_segment *segments = calloc(SEGMENTS, sizeof *segments);
    struct render_statistics statistics;
    assert_int_equal(renderer_render(renderer, &camera, rgb, NULL, &statistics), RENDER_DONE);
    assert_int_equal(renderer_hits(renderer, &camera, hits, NULL), RENDER_DONE);
    uint32_t most = 0, deepest = 0, cut = 0;
    for (uint32_t y = 0; y < HEIGHT; y += 9)
        for (uint32_t x = 0; x < WIDTH; x += 7) {
            struct render_log log = {.segments = segments, .capacity = SEGMENTS};
            const struct hit_pixel *hit = hits + y * WIDTH + x;
            assert_int_equal(renderer_log(renderer, &camera, x, y, 0, &log), RENDER_DONE);
            assert_true(log.whole && log.count >= 1);
            assert_memory_equal(log.rgb, rgb + 3 * ((size_t)y * WIDTH + x), sizeof log.rgb);
            assert_int_equal(segments[0].body, hit->body);
            assert_int_equal(segments[0].triangle, hit->triangle);
            assert_int_equal(segments[0].considered, hit->considered);
            assert_int_equal(segments[0].lit, hit->lit);
            follow(segments, log.count, &deepest, &cut);
            most = log.count > most ? log.count : most;
        }
    assert_in_range(most, 8, SEGMENTS);
    assert_int_equal(deepest, 6);
    assert_true(cut);
    struct render_log log = {.segments = segments, .capacity = 2};
    assert_int_equal(renderer_log(renderer, &camera, WIDTH * 5 / 8, HEIGHT / 2, 0, &log), RENDER_DONE);
    assert_true(!log.whole && log.count == 2);
    free(segments);
    free(hits);
    free(rgb);
    renderer_destroy(renderer);
    flat_finish(&flat);
    kit_finish(&kit);
}

static void test_log(void **state) {
    check_log(state, false, 0);
}

static void test_log_many_lights(void **state) {
    check_log(state, false, 100);
}

static void test_log_double(void **state) {
    check_log(state, true, 0);
}

// ---- one ray with more to do than lavapipe lets it: told, not hidden

static void test_unfinished(void **state) {
    device_kit_need(state, false);
    enum {
        LAYERS = 9000
    };
    static const vec3 corners[3] = {{-1000, -1000, -5}, {1000, -1000, -5}, {0, 1000, -5}};
    uint32_t(*faces)[3] = calloc(LAYERS, sizeof *faces);
    for (uint32_t i = 0; i < LAYERS; i++)
        memcpy(faces[i], (uint32_t[3]){0, 1, 2}, sizeof faces[i]);
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    kit_model(&kit, kit_mesh(&kit, corners, 3, (const uint32_t(*)[3])faces, LAYERS, false));
    assert_true(kit_flatten(&kit, &flat));
    uint64_t unfinished = 0;
    struct hit_pixel *hits = take(state, &kit, &flat, (vec3){0, 0, 0}, RENDER_ALTERNATIVE_NONE, &unfinished);
    assert_int_equal(unfinished, PIXELS);
    free(hits);
    flat_finish(&flat);
    kit_finish(&kit);
    free(faces);
}

// ---- other tracers' ways fail as they are known to, and glint's own does not

struct counts {
    int met, dark, lit; // pixels with a body; lights that would add and do not; that do
};

static struct counts count(void **state, struct kit *kit, vec3 position,
                           enum render_alternative alternative) {
    struct flat_scene flat;
    struct counts counts = {0, 0, 0};
    assert_true(kit_flatten(kit, &flat));
    struct hit_pixel *hits = take(state, kit, &flat, position, alternative, NULL);
    for (int i = 0; i < PIXELS; i++) {
        counts.met += hits[i].body != HIT_NONE;
        counts.dark += hits[i].considered != hits[i].lit;
        counts.lit += hits[i].lit != 0;
    }
    free(hits);
    flat_finish(&flat);
    return counts;
}

static void test_alternative_small_mesh(void **state) {
    device_kit_need(state, false);
    struct kit kit;
    kit_init(&kit);
    struct ir_model *model = kit_model(&kit, kit_icosphere(&kit, 3, 0));
    model->scale = (vec3){1e-3, 1e-3, 1e-3};
    model->translation = (vec3){0, 0, -4e-3};
    const vec3 eye = {0, 0, 0};
    const int own = count(state, &kit, eye, RENDER_ALTERNATIVE_NONE).met;
    assert_in_range(own, PIXELS / 10, PIXELS / 2);
    assert_int_equal(count(state, &kit, eye, RENDER_ALTERNATIVE_FUSED).met, own);
    assert_int_equal(count(state, &kit, eye, RENDER_ALTERNATIVE_OFFSET_3).met, own);
    // Every triangle is smaller than the cut.
    assert_int_equal(count(state, &kit, eye, RENDER_ALTERNATIVE_MOELLER).met, 0);
    assert_int_equal(count(state, &kit, eye, RENDER_ALTERNATIVE_ORIGINAL).met, 0);
    model->scale = (vec3){1, 1, 1};
    model->translation = (vec3){0, 0, -4};
    assert_in_range(count(state, &kit, eye, RENDER_ALTERNATIVE_MOELLER).met, own - own / 50, own);
    kit_finish(&kit);
}

// A wide sloping plane, lit from above: no point of it lies in shadow.
static void test_alternative_self_hits(void **state) {
    device_kit_need(state, false);
    struct kit kit;
    kit_init(&kit);
    struct ir_rectangle *r = kit_rectangle(&kit);
    r->corner = (vec3){-3001, -1003, 7};
    r->edge_u = (vec3){6007, 503, 11};
    r->edge_v = (vec3){-13, 701, -4001};
    kit_light(&kit, (vec3){100, 5000, 300});
    const vec3 eye = {0, 0, 0};
    const struct counts own = count(state, &kit, eye, RENDER_ALTERNATIVE_NONE);
    assert_in_range(own.lit, PIXELS / 10, PIXELS);
    assert_int_equal(own.dark, 0);
    assert_in_range(count(state, &kit, eye, RENDER_ALTERNATIVE_OFFSET_7).dark, PIXELS / 100, PIXELS);
    assert_in_range(count(state, &kit, eye, RENDER_ALTERNATIVE_OFFSET_DISTANCE).dark, 0, 0);
    kit_finish(&kit);
}

// Between two plates that are nearer to each other than a ray's start is moved: no light from above.
static void test_alternative_leaks(void **state) {
    device_kit_need(state, false);
    struct kit kit;
    kit_init(&kit);
    for (int plate = 0; plate < 2; plate++) {
        struct ir_rectangle *r = kit_rectangle(&kit);
        r->corner = (vec3){-4, plate ? 2.5e-4 : -2.5e-4, 1};
        r->edge_u = (vec3){8, 0, 0};
        r->edge_v = (vec3){0, 0, -8};
    }
    kit_light(&kit, (vec3){0, 5, -2});
    const vec3 eye = {0, 0, 0};
    const struct counts own = count(state, &kit, eye, RENDER_ALTERNATIVE_NONE);
    assert_in_range(own.dark, PIXELS / 3, PIXELS);
    assert_int_equal(own.lit, 0);
    assert_in_range(count(state, &kit, eye, RENDER_ALTERNATIVE_OFFSET_3).lit, PIXELS / 3, PIXELS);
    assert_int_equal(count(state, &kit, eye, RENDER_ALTERNATIVE_OFFSET_7).lit, 0);
    kit_finish(&kit);
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_closed_forms), cmocka_unit_test(test_closed_forms_double),
        cmocka_unit_test(test_log_double),   cmocka_unit_test(test_mesh),
        cmocka_unit_test(test_log),          cmocka_unit_test(test_log_many_lights),
        cmocka_unit_test(test_unfinished),   cmocka_unit_test(device_kit_silent),
    };
    const struct CMUnitTest alternatives[] = {
        cmocka_unit_test(test_alternative_small_mesh),
        cmocka_unit_test(test_alternative_self_hits),
        cmocka_unit_test(test_alternative_leaks),
        cmocka_unit_test(device_kit_silent),
    };
    int failed = cmocka_run_group_tests(tests, device_kit_setup, device_kit_teardown);
    if (argc < 2 || strcmp(argv[1], "few") != 0)
        failed += cmocka_run_group_tests(alternatives, device_kit_setup, device_kit_teardown);
    return failed;
}
