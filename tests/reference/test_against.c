// The device's tracer against the reference, which obeys the file: first hits and pictures of whole scenes.
//
// Usage: test_against [WxH] SCENE... ; scenes whose meshes are not here are skipped by name.
//        test_against WxH --generated COUNT FOLDER_WITH_MESHES WORK_FOLDER: scenes with everything that the
//        language has, made by the seeds from 0
#include "tests/pictures/picture_kit.h"

#include "files/output.h"
#include "grammar/ir.h"
#include "grammar/print/ir_print.h"
#include "render/reference_shot.h"
#include "tests/generate/generate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// What must hold.
#define WRONG_HITS_PER_MILLION 20.0
#define FAR_PIXELS_SHARE       0.001
// Secondary hits, lights and numbers of hits that agree: their own silhouettes are among them.
#define WRONG_REST_PER_MILLION 200.0
#define DISTANCE_TOLERANCE     1e-5 // of the distance
#define NORMAL_TOLERANCE       1e-3
// Of small pictures some pixels more: rays that meet the edge of a checker's cell exactly, where rounding
// decides, lie on lines through the picture.
#define FAR_PIXELS_MORE 8
#define SMALL_PIXELS    100000

struct pair {
    uint32_t width, height;
    struct image device, reference;
    struct hit_pixel *device_hits, *reference_hits;
};

struct verdict {
    uint32_t outside, wrong_hits, wrong_outside; // outside: not at silhouettes
    uint32_t wrong_lights, wrong_bounces;        // not at silhouettes, where both see the same
    uint32_t wrong_numbers;                      // distance or normal
    uint32_t far_pixels, not_finite;
    double worst;
    uint32_t x, y; // the first wrong hit outside
};

static bool same_hit(const struct hit_pixel *a, const struct hit_pixel *b) {
    return a->body == b->body && a->triangle == b->triangle;
}

static bool same_numbers(const struct hit_pixel *a, const struct hit_pixel *b) {
    return fabs(a->distance - b->distance) <= DISTANCE_TOLERANCE * b->distance &&
           vec3_length(vec3_sub(a->normal, b->normal)) <= NORMAL_TOLERANCE;
}

// Whether the pixel or one of its neighbours sees another body than the pixel does.
static bool at_silhouette(const struct pair *p, uint32_t x, uint32_t y) {
    uint32_t body = p->reference_hits[(size_t)y * p->width + x].body;
    for (uint32_t j = y ? y - 1 : 0; j <= y + 1 && j < p->height; j++)
        for (uint32_t i = x ? x - 1 : 0; i <= x + 1 && i < p->width; i++)
            if (p->reference_hits[(size_t)j * p->width + i].body != body)
                return true;
    return false;
}

static void compare_hits(const struct pair *p, struct verdict *v) {
    for (uint32_t y = 0; y < p->height; y++)
        for (uint32_t x = 0; x < p->width; x++) {
            const struct hit_pixel *a = &p->device_hits[(size_t)y * p->width + x];
            const struct hit_pixel *b = &p->reference_hits[(size_t)y * p->width + x];
            bool same = same_hit(a, b);
            v->wrong_hits += !same;
            if (at_silhouette(p, x, y))
                continue;
            v->outside++;
            if (!same && v->wrong_outside++ == 0) {
                v->x = x;
                v->y = y;
            }
            // A highlight's tail may be nothing in single precision.
            uint32_t both = a->considered & b->considered;
            v->wrong_lights += same && ((a->lit ^ b->lit) & both) != 0;
            v->wrong_numbers += same && !same_numbers(a, b);
            v->wrong_bounces += same && (a->reflected != b->reflected || a->refracted != b->refracted);
        }
}

// As displayed: bytes that differ by one step are within 1/255.
static bool compare_pictures(const struct pair *p, struct image_display display, struct verdict *v) {
    size_t count = (size_t)p->width * p->height;
    uint8_t *a = malloc(6 * count);
    if (!a)
        return false;
    uint8_t *b = a + 3 * count;
    image_to_bytes(&p->device, display, a);
    image_to_bytes(&p->reference, display, b);
    for (size_t i = 0; i < count; i++) {
        bool is_far = false;
        bool finite = true;
        for (size_t c = 3 * i; c < 3 * i + 3; c++) {
            is_far |= abs(a[c] - b[c]) > 1;
            finite &= isfinite(p->device.rgb[c]) && isfinite(p->reference.rgb[c]);
            v->worst = fmax(v->worst, abs(a[c] - b[c]) / 255.0);
        }
        v->far_pixels += is_far;
        v->not_finite += !finite;
    }
    free(a);
    return true;
}

static bool judge(const struct pair *p, const char *path, struct image_display display) {
    struct verdict v = {0};
    if (!compare_pictures(p, display, &v))
        return false;
    compare_hits(p, &v);
    double count = (double)p->width * p->height;
    double per_million = v.outside ? 1e6 * v.wrong_outside / v.outside : 0;
    double far_most = FAR_PIXELS_SHARE * count + (count < SMALL_PIXELS ? FAR_PIXELS_MORE : 0);
    bool good = v.not_finite == 0 && v.far_pixels <= far_most && per_million <= WRONG_HITS_PER_MILLION;
    double rest = 2 + 1e-6 * WRONG_REST_PER_MILLION * v.outside;
    good = good && v.wrong_lights <= rest && v.wrong_bounces <= rest && v.wrong_numbers <= rest;
    printf("%s %s %ux%u: other hits %u, outside silhouettes %u of %u (%.1f a million); of these other lights "
           "%u, bounces %u, numbers %u; pixels off by more than 1/255: %u (%.4f %%), largest %.3f\n",
           good ? "ok  " : "FAIL", path, p->width, p->height, v.wrong_hits, v.wrong_outside, v.outside,
           per_million, v.wrong_lights, v.wrong_bounces, v.wrong_numbers, v.far_pixels,
           100 * v.far_pixels / count, v.worst);
    if (v.wrong_outside) {
        const struct hit_pixel *a = &p->device_hits[(size_t)v.y * p->width + v.x];
        const struct hit_pixel *b = &p->reference_hits[(size_t)v.y * p->width + v.x];
        printf("     at %u,%u body %d triangle %u at %.9g, the reference body %d triangle %u at %.9g\n", v.x,
               v.y, (int)a->body, a->triangle, a->distance, (int)b->body, b->triangle, b->distance);
    }
    return good;
}

static bool take_device(struct picture_kit *kit, struct session *session, struct pair *p) {
    struct shot shot;
    struct render_statistics statistics;
    bool good = shot_open(&shot, session, kit->gpu, 0) == SHOT_OK &&
                shot_take(&shot, &p->device, NULL, &statistics) == SHOT_OK &&
                renderer_hits(shot.renderer, &shot.view.camera, p->device_hits, NULL) == RENDER_DONE;
    shot_close(&shot);
    return good;
}

static bool take_reference(struct session *session, struct pair *p) {
    struct reference_shot shot;
    struct reference_statistics statistics;
    bool good =
        reference_shot_open(&shot, session, 0,
                            (struct reference_shot_options){.as_file = true, .no_cache = true}) == SHOT_OK &&
        reference_shot_take(&shot, &p->reference, NULL, NULL, &statistics) == SHOT_OK &&
        reference_source_hits(&shot.source, &shot.settings, p->reference_hits, NULL) == REFERENCE_DONE;
    reference_shot_close(&shot);
    return good;
}

static bool check_session(struct picture_kit *kit, struct session *session) {
    struct pair p = {.width = (uint32_t)session->image->width, .height = (uint32_t)session->image->height};
    size_t count = (size_t)p.width * p.height;
    p.device_hits = calloc(count, sizeof *p.device_hits);
    p.reference_hits = calloc(count, sizeof *p.reference_hits);
    bool good = p.device_hits && p.reference_hits && image_init(&p.device, p.width, p.height) &&
                image_init(&p.reference, p.width, p.height) && take_device(kit, session, &p) &&
                take_reference(session, &p) && session->sink.errors == 0;
    struct image_display display = image_display_of(session->image);
    if (!good)
        fprintf(stderr, "%.*s: %s\n", STR_ARG(session->options.path), gpu_error(kit->gpu));
    else
        good = judge(&p, session->options.path.ptr, display);
    image_finish(&p.device);
    image_finish(&p.reference);
    free(p.device_hits);
    free(p.reference_hits);
    return good;
}

struct size {
    int32_t width, height; // 0: the scene's
};

static bool check_scene(struct picture_kit *kit, const char *path, struct size size, const char *meshes) {
    struct session session;
    str asset_path = str_from(meshes);
    struct session_options options = {.path = str_from(path),
                                      .asset_paths = &asset_path,
                                      .asset_path_count = meshes ? 1 : 0,
                                      .limits = limits_default(),
                                      .width = size.width,
                                      .height = size.height,
                                      // The reference takes all samples of each pixel.
                                      .error = -1};
    session_load(&session, &options, kit->store);
    bool good = session.state == SESSION_LOADED && session.sink.errors == 0 && check_session(kit, &session);
    if (!good)
        fprintf(stderr, "FAIL %s\n", path);
    session_finish(&session);
    return good;
}

static bool check_named(struct picture_kit *kit, const char *path, struct size size) {
    const char *seed = picture_seed_folder();
    bool needs_seed = strstr(path, "original") || strstr(path, "halfmirror");
    if (!needs_seed || seed)
        return check_scene(kit, path, size, needs_seed ? seed : NULL);
    printf("skip %s: its meshes are not here\n", path);
    return true;
}

static bool check_generated(struct picture_kit *kit, uint64_t seed, struct size size, char **folders) {
    static const str meshes[] = {{"octahedron.obj", sizeof "octahedron.obj" - 1}};
    struct generate_options options = {.seed = seed, .renderable = true, .meshes = {meshes, 1}};
    char path[1024];
    struct arena arena;
    struct strbuf text;
    arena_init(&arena, (size_t)1 << 30);
    strbuf_init(&text);
    ir_write_yaml(generate_scene(&options, &arena), NULL, NULL, (struct ir_write_options){0}, &text);
    snprintf(path, sizeof path, "%s/generated-%llu.yaml", folders[1], (unsigned long long)seed);
    bool good = !text.failed && output_whole(path, text.data, text.len) == 0 &&
                check_scene(kit, path, size, folders[0]);
    strbuf_finish(&text);
    arena_finish(&arena);
    return good;
}

int main(int argc, char **argv) {
    struct picture_kit kit;
    struct size size = {0, 0};
    int failed = 0;
    int first = argc > 1 && sscanf(argv[1], "%dx%d", &size.width, &size.height) == 2 ? 2 : 1;
    if (argc <= first || !picture_kit_open(&kit))
        return argc <= first ? 2 : 77;
    if (strcmp(argv[first], "--generated") == 0 && argc == first + 4)
        for (uint64_t seed = 0; seed < strtoull(argv[first + 1], NULL, 10); seed++)
            failed += !check_generated(&kit, seed, size, argv + first + 2);
    else
        for (int i = first; i < argc; i++)
            failed += !check_named(&kit, argv[i], size);
    uint32_t messages = picture_kit_close(&kit);
    if (messages)
        fprintf(stderr, "%u validation messages\n", messages);
    return failed || messages;
}
