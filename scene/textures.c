// Images on surfaces: their levels, and how coordinates become places in them.
#include "core/heap.h"
#include "core/parallel.h"
#include "core/srgb.h"
#include "grammar/ir.h"
#include "scene/scene_internal.h"
#include "scene/transform.h"

#include <math.h>
#include <string.h>

enum {
    PIECE_ROWS = 16,
};

// ---- pixels

// One value of 21 bits: sixteen after the point, and above them the power of two, from -31 to 0; 0 is 0. So
// the error of a value of 1 or less is below 8e-6 of it, or below 5e-10.
#define PACKED_DIGITS 16
#define PACKED_LEAST  (-31)

static uint32_t packed(double value) {
    int exponent;
    const double part = 2 * frexp(value, &exponent) - 1; // 0..1
    if (!(value > 0) || exponent - 1 < PACKED_LEAST)
        return 0;
    const uint32_t digits = (uint32_t)nearbyint(part * (1 << PACKED_DIGITS));
    return ((uint32_t)(exponent - 1 - PACKED_LEAST) << PACKED_DIGITS) + digits;
}

static double unpacked(uint32_t bits) {
    const uint32_t as_float = (bits << (23 - PACKED_DIGITS)) + ((uint32_t)(127 + PACKED_LEAST) << 23);
    float value;
    memcpy(&value, &as_float, sizeof value);
    return bits ? (double)value : 0;
}

static uint64_t pack(vec3 color) {
    return (uint64_t)packed(color.x) | (uint64_t)packed(color.y) << 21 | (uint64_t)packed(color.z) << 42;
}

static vec3 unpack(uint64_t bits) {
    return (vec3){unpacked(bits & 0x1fffff), unpacked(bits >> 21 & 0x1fffff),
                  unpacked((uint32_t)(bits >> 42))};
}

static vec3 picture_texel(const struct scene_texture *t, size_t at) {
    const struct picture *picture = t->picture;
    double value[3];
    for (size_t k = 0; k < 3; k++) {
        if (picture_is_linear(picture)) {
            value[k] = (double)picture_linear(picture, at, k);
            continue;
        }
        value[k] = (double)picture_stored(picture, at, k) / picture_greatest(picture->depth);
        if (t->is_srgb)
            value[k] = srgb_decode(value[k]);
    }
    return (vec3){value[0], value[1], value[2]};
}

vec3 scene_texel(const struct scene_texture *t, uint32_t level, uint32_t x, uint32_t y) {
    const struct scene_level *l = &t->levels[level];
    const size_t at = (size_t)y * l->width + x;
    if (level == 0)
        return picture_texel(t, at);
    if (l->texels == SCENE_TEXELS_PACKED)
        return unpack(((const uint64_t *)l->pixels)[at]);
    const float *p = (const float *)l->pixels + 3 * at;
    return (vec3){(double)p[0], (double)p[1], (double)p[2]};
}

// ---- levels

// Which part of a level's row or column a pixel of the next level covers: when `size` pixels become `half`,
// each new pixel covers size / half of them, which need not be whole.
struct cover {
    uint32_t first, count; // at most three
    double weight[4];
};

static struct cover cover_of(uint32_t i, uint32_t size, uint32_t half) {
    const double step = (double)size / half;
    const double begin = i * step, end = fmin((i + 1) * step, size);
    struct cover c = {.first = (uint32_t)begin};
    for (uint32_t k = c.first; k < size && k < end && c.count < 4; k++) {
        const double from = fmax(begin, k), to = fmin(end, k + 1.0);
        c.weight[c.count++] = (to - from) / step;
    }
    return c;
}

struct halving {
    const struct scene_texture *texture;
    uint32_t level; // the level being made
    void *pixels;
    double decoded[256]; // decoded stored bytes, as from scene_texel, which would take most of the time
};

// scene_texel of the level before.
static vec3 texel_before(const struct halving *h, uint32_t x, uint32_t y) {
    const struct scene_level *l = &h->texture->levels[h->level - 1];
    if (l->texels != SCENE_TEXELS_BYTES)
        return scene_texel(h->texture, h->level - 1, x, y);
    const uint8_t *p = (const uint8_t *)h->texture->picture->pixels + 3 * ((size_t)y * l->width + x);
    return (vec3){h->decoded[p[0]], h->decoded[p[1]], h->decoded[p[2]]};
}

static void put_texel(const struct halving *h, size_t at, vec3 color) {
    if (h->texture->levels[h->level].texels == SCENE_TEXELS_PACKED) {
        ((uint64_t *)h->pixels)[at] = pack(color);
        return;
    }
    float *to = (float *)h->pixels + 3 * at;
    to[0] = (float)color.x;
    to[1] = (float)color.y;
    to[2] = (float)color.z;
}

static void halve_rows(void *context, size_t begin, size_t end) {
    const struct halving *h = context;
    const struct scene_level *to = &h->texture->levels[h->level], *from = to - 1;
    for (uint32_t y = (uint32_t)begin; y < end; y++) {
        const struct cover rows = cover_of(y, from->height, to->height);
        for (uint32_t x = 0; x < to->width; x++) {
            const struct cover columns = cover_of(x, from->width, to->width);
            vec3 sum = {0, 0, 0};
            for (uint32_t j = 0; j < rows.count; j++)
                for (uint32_t i = 0; i < columns.count; i++)
                    sum = vec3_add(sum, vec3_mul(texel_before(h, columns.first + i, rows.first + j),
                                                 rows.weight[j] * columns.weight[i]));
            put_texel(h, (size_t)y * to->width + x, sum);
        }
    }
}

static void make_levels(struct scene_texture *t, struct arena *arena) {
    const bool is_bytes = t->picture->depth == PICTURE_8;
    t->levels[0] = (struct scene_level){.width = t->picture->width,
                                        .height = t->picture->height,
                                        .texels = is_bytes ? SCENE_TEXELS_BYTES : SCENE_TEXELS_FLOATS};
    t->level_count = 1;
    struct halving halving = {.texture = t};
    for (int i = 0; i < 256; i++)
        halving.decoded[i] = t->is_srgb ? srgb_decode(i / 255.0) : i / 255.0;
    while (t->level_count < SCENE_LEVELS_MAX) {
        const struct scene_level *last = &t->levels[t->level_count - 1];
        struct scene_level *next = &t->levels[t->level_count];
        if (last->width == 1 && last->height == 1)
            break;
        *next = (struct scene_level){.width = last->width > 1 ? last->width / 2 : 1,
                                     .height = last->height > 1 ? last->height / 2 : 1,
                                     .texels = is_bytes ? SCENE_TEXELS_PACKED : SCENE_TEXELS_FLOATS};
        const size_t pixel_bytes = is_bytes ? sizeof(uint64_t) : 3 * sizeof(float);
        const size_t bytes = heap_times(heap_times(next->width, next->height), pixel_bytes);
        halving.level = t->level_count;
        halving.pixels = arena_alloc(arena, bytes);
        next->pixels = halving.pixels;
        parallel_for(next->height, PIECE_ROWS, halve_rows, &halving);
        t->level_count++;
    }
}

// ---- materials

static const struct scene_texture *texture_of(struct scene *scene, const struct picture *picture,
                                              struct arena *arena) {
    for (const struct scene_texture *t = scene->textures; t; t = t->next)
        if (t->picture == picture)
            return t;
    struct scene_texture *t = ARENA_NEW(arena, struct scene_texture);
    *t = (struct scene_texture){.next = scene->textures,
                                .number = scene->texture_count++,
                                .picture = picture,
                                .is_srgb = scene->ir->image.transfer == IR_TRANSFER_SRGB &&
                                           !picture_is_linear(picture)};
    make_levels(t, arena);
    scene->textures = t;
    return t;
}

// The image lies between 0 and 1, is made smaller by `repeat`, turned about the middle and moved; this is the
// inverse.
static struct scene_image placed_image(const struct ir_texture *ir) {
    const mat3 turn = mat3_rotation((vec3){0, 0, ir->rotation});
    const double c = turn.m[0][0], s = turn.m[1][0];
    const double du = -0.5 - ir->offset.u, dv = -0.5 - ir->offset.v;
    return (struct scene_image){
        .u = {ir->repeat.u * c, ir->repeat.u * s, ir->repeat.u * (c * du + s * dv + 0.5)},
        .v = {-ir->repeat.v * s, ir->repeat.v * c, ir->repeat.v * (c * dv - s * du + 0.5)},
        .filter = ir->filter,
        .wrap = ir->wrap};
}

static struct scene_image image_of(struct scene *scene, uint32_t material, int which, struct arena *arena) {
    const struct ir_material *ir = &scene->assets->materials[material];
    const struct picture *picture = scene->assets->images[material][which];
    struct scene_image image =
        placed_image(which == ASSETS_DIFFUSE ? &ir->diffuse_color.image : &ir->specular_color.image);
    image.picture = picture;
    if (picture && picture->pixels)
        image.texture = texture_of(scene, picture, arena);
    return image;
}

void scene_build_textures(struct scene *scene, struct arena *arena) {
    if (!scene->assets->images)
        return;
    for (uint32_t i = 0; i < scene->material_count; i++)
        for (int k = 0; k < ASSETS_IMAGES; k++)
            if (scene->assets->images[i][k])
                scene->materials[i].images[k] = image_of(scene, i, k, arena);
}

// ---- coordinates

void scene_coordinates(const struct scene_body *body, uint32_t triangle, struct ir_pair corners[3]) {
    const struct mesh *mesh = body->mesh;
    for (int k = 0; k < 3; k++) {
        const uint32_t at = mesh->textured ? mesh->textured[triangle][k] : IR_NO_INDEX;
        corners[k] = at != IR_NO_INDEX ? mesh->coordinates[at] : (struct ir_pair){0, 0};
    }
}

bool scene_body_has_image(const struct scene *scene, const struct scene_body *body) {
    for (uint32_t i = 0; i < body->group_count; i++)
        for (int k = 0; k < ASSETS_IMAGES; k++)
            if (scene->materials[body->materials[i]].images[k].texture)
                return true;
    return false;
}
