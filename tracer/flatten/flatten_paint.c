// Images on surfaces: texels, coordinates of meshes, and how each material shows them (shaders/gpu_scene.h).
#include "core/heap.h"
#include "core/parallel.h"
#include "core/srgb.h"
#include "diag/codes/limit.h"
#include "shaders/features.h"
#include "tracer/flatten/flatten_internal.h"

#include <stdlib.h>
#include <string.h>

enum {
    PIECE_WORDS = 8192,
    PIECE_TRIANGLES = 8192,
    TABLE_WORDS = 256,
    BODIES_PER_WORD = 4,
};

// Kinds of texels: a word holds 2^kind texels.
static const uint32_t kinds[] = {[SCENE_TEXELS_BYTES] = TEXELS_BYTES,
                                 [SCENE_TEXELS_PACKED] = TEXELS_PACKED,
                                 [SCENE_TEXELS_FLOATS] = TEXELS_FLOATS};

// ---- what a material needs

static bool shows(const struct scene_material *m, int which) {
    return m->images[which].texture &&
           (which == ASSETS_DIFFUSE ? m->diffuse_weight : m->specular_weight) != 0;
}

uint64_t flatten_paint_features(const struct scene_material *m) {
    uint64_t features = m->checker && m->soft && m->diffuse_weight != 0 ? FEATURE_FOOTPRINT : 0;
    for (int k = 0; k < ASSETS_IMAGES; k++)
        if (shows(m, k))
            features |= FEATURE_TEXTURES | (m->images[k].filter == IR_FILTER_AUTO ? FEATURE_FOOTPRINT : 0);
    return features;
}

static bool is_any_painted(const struct flattening *f) {
    for (uint32_t i = 0; i < f->scene->material_count; i++)
        if (f->material_used[i] && flatten_paint_features(&f->scene->materials[i]))
            return true;
    return false;
}

// ---- places

static uint64_t level_words(const struct scene_level *level) {
    const uint32_t kind = kinds[level->texels], per_word = UINT32_C(1) << kind;
    return ((uint64_t)level->width * level->height + per_word - 1) >> kind;
}

static void place_texture(const struct scene_texture *t, uint64_t *end, uint64_t *end_of_texels,
                          struct flat_texture *out) {
    out->table = t->is_srgb && t->levels[0].texels == SCENE_TEXELS_BYTES ? *end : 0;
    *end += out->table ? TABLE_WORDS : 0;
    out->levels = *end;
    *end += t->level_count;
    for (uint32_t i = 0; i < t->level_count; i++) {
        out->texels[i] = *end_of_texels;
        *end_of_texels += level_words(&t->levels[i]);
    }
}

static bool has_coordinates(const struct flattening *f, const struct scene_body *body) {
    return body->mesh && body->mesh->textured && scene_body_has_image(f->scene, body);
}

// Bodies that show the same mesh share its coordinates: returns the first such body, or `number` if there is
// none before it.
static uint32_t first_with_mesh(const struct flattening *f, uint32_t number) {
    for (uint32_t i = 0; i < number; i++)
        if (f->scene->bodies[i].mesh == f->scene->bodies[number].mesh && f->coordinates[i])
            return i;
    return number;
}

static uint32_t coordinate_words(const struct flattening *f) {
    return f->out->is_double ? COORDINATE64_WORDS : COORDINATE_WORDS;
}

static void place_coordinates(const struct flattening *f, uint64_t *end) {
    f->out->coordinates_table = (uint32_t)*end;
    *end += ((uint64_t)f->scene->body_count + BODIES_PER_WORD - 1) / BODIES_PER_WORD;
    *end += *end & 1;
    for (uint32_t i = 0; i < f->scene->body_count; i++) {
        const struct scene_body *body = &f->scene->bodies[i];
        if (!has_coordinates(f, body))
            continue;
        const uint32_t first = first_with_mesh(f, i);
        f->coordinates[i] = first < i ? f->coordinates[first] & ~UINT32_C(1) : (uint32_t)*end;
        f->coordinates[i] |= body->mirrored;
        *end += first < i ? 0 : coordinate_words(f) * (uint64_t)body->triangle_count;
        *end += *end & 1;
    }
}

// ---- filling

static uint32_t stored_bytes(const struct scene_texture *t, uint64_t at) {
    const uint8_t *p = (const uint8_t *)t->picture->pixels + 3 * at;
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16;
}

struct filling {
    const struct scene_texture *texture;
    uint32_t level;
    uint64_t first; // word of the level
    struct gpu_word *to;
};

// Texels [begin, end) of a level, in words starting at the first of them.
static void put_texels(const struct filling *fill, uint64_t begin, uint64_t end, struct gpu_word *to) {
    const struct scene_level *level = &fill->texture->levels[fill->level];
    *to = (struct gpu_word){0};
    for (uint64_t at = begin; at < end; at++)
        if (level->texels == SCENE_TEXELS_BYTES)
            gpu_pack_uint(to, 0, (uint32_t)(at - begin), stored_bytes(fill->texture, at));
        else if (level->texels == SCENE_TEXELS_PACKED)
            memcpy((uint64_t *)to + (at - begin), (const uint64_t *)level->pixels + at, sizeof(uint64_t));
        else
            gpu_pack_float3(to, 0,
                            scene_texel(fill->texture, fill->level, (uint32_t)(at % level->width),
                                        (uint32_t)(at / level->width)));
}

static void fill_words(void *context, size_t begin, size_t end) {
    const struct filling *fill = context;
    const struct scene_level *level = &fill->texture->levels[fill->level];
    const uint64_t all = (uint64_t)level->width * level->height;
    const uint32_t kind = kinds[level->texels];
    for (size_t i = begin; i < end; i++) {
        const uint64_t at = (fill->first + i) << kind, next = at + (UINT64_C(1) << kind);
        put_texels(fill, at, next < all ? next : all, fill->to + i);
    }
}

void flat_texels(const struct flat_scene *flat, uint64_t begin, uint64_t end, struct gpu_word *to) {
    for (const struct scene_texture *t = flat->scene->textures; t; t = t->next)
        for (uint32_t i = 0; i < t->level_count; i++) {
            const uint64_t first = flat->texels.textures[t->number].texels[i];
            const uint64_t after = first + level_words(&t->levels[i]);
            const uint64_t from = first > begin ? first : begin, until = after < end ? after : end;
            struct filling fill = {t, i, from - first, to + (from - begin)};
            if (from < until)
                parallel_for((size_t)(until - from), PIECE_WORDS, fill_words, &fill);
        }
}

bool flat_has_texels_of(const struct flat_scene *a, const struct flat_scene *b) {
    const struct scene_texture *s = a->texels.words ? a->scene->textures : NULL,
                               *t = b->texels.words ? b->scene->textures : NULL;
    // The same pictures in the store become the same texels.
    for (; s && t; s = s->next, t = t->next)
        if (s->picture != t->picture || s->is_srgb != t->is_srgb)
            return false;
    return s == t && a->paints.count == b->paints.count && a->texels.words == b->texels.words;
}

// Fills in where an image's texels are, in the array of all.
static void fill_texture(const struct scene_texture *t, const struct flat_texture *placed,
                         struct flat_array *paints) {
    for (uint32_t i = 0; placed->table && i < TABLE_WORDS; i++)
        gpu_pack_float(paints->words + placed->table + i, 0, 0, srgb_decode(i / 255.0));
    for (uint32_t i = 0; i < t->level_count; i++) {
        const struct scene_level *level = &t->levels[i];
        const uint32_t kind = kinds[level->texels];
        paints->words[placed->levels + i] = (struct gpu_word){
            (uint32_t)((paints->count + placed->texels[i]) << kind), level->width, level->height, kind};
    }
}

struct coordinates {
    const struct scene_body *body;
    struct gpu_word *words;
    bool is_double;
};

static void fill_coordinates(void *context, size_t begin, size_t end) {
    const struct coordinates *c = context;
    for (size_t i = begin; i < end; i++) {
        struct ir_pair at[3];
        scene_coordinates(c->body, (uint32_t)i, at);
        for (uint32_t k = 0; k < 3 && c->is_double; k++) {
            gpu_pack_double(c->words + COORDINATE64_WORDS * i, k, GPU_PART_xy, at[k].u);
            gpu_pack_double(c->words + COORDINATE64_WORDS * i, k, GPU_PART_zw, at[k].v);
        }
        for (uint32_t k = 0; k < 3 && !c->is_double; k++) {
            gpu_pack_float(c->words + COORDINATE_WORDS * i, k / 2, 2 * (k % 2), at[k].u);
            gpu_pack_float(c->words + COORDINATE_WORDS * i, k / 2, 2 * (k % 2) + 1, at[k].v);
        }
    }
}

static struct gpu_paint record_of(const struct scene_material *m, int which,
                                  const struct flat_texture *placed) {
    const struct scene_image *image = &m->images[which];
    struct gpu_paint record = {.flags = m->checker && m->soft ? PAINT_SOFT : 0};
    if (!shows(m, which))
        return record;
    const struct flat_texture *at = &placed[image->texture->number];
    record.levels = (uint32_t)at->levels;
    record.level_count = image->texture->level_count;
    record.table = (uint32_t)at->table;
    record.flags |= (image->filter == IR_FILTER_NEAREST ? PAINT_NEAREST : 0) |
                    (image->filter == IR_FILTER_AUTO ? PAINT_AUTO : 0) |
                    (image->wrap == IR_WRAP_CLAMP ? PAINT_CLAMP : 0) |
                    (image->wrap == IR_WRAP_MIRROR ? PAINT_MIRROR : 0);
    record.row_u = (vec3){image->u[0], image->u[1], image->u[2]};
    record.row_v = (vec3){image->v[0], image->v[1], image->v[2]};
    return record;
}

static uint32_t paint_words(const struct flattening *f) {
    return f->out->is_double ? PAINT64_WORDS : PAINT_WORDS;
}

static void fill_records(const struct flattening *f, const struct flat_texture *placed) {
    for (uint32_t i = 0; i < f->scene->material_count; i++)
        for (uint32_t k = 0; k < ASSETS_IMAGES; k++) {
            const struct gpu_paint record = record_of(&f->scene->materials[i], (int)k, placed);
            gpu_pack_paint(&record, f->out->is_double,
                           f->out->paints.words + ((size_t)ASSETS_IMAGES * i + k) * paint_words(f));
        }
}

static enum flatten_fault fill_all(struct flattening *f, struct flat_texture *placed) {
    uint64_t end = (uint64_t)f->scene->material_count * ASSETS_IMAGES * paint_words(f);
    for (const struct scene_texture *t = f->scene->textures; t; t = t->next)
        place_texture(t, &end, &f->out->texels.words, &placed[t->number]);
    place_coordinates(f, &end);
    // Texels have 32-bit numbers.
    if (end + f->out->texels.words > UINT32_MAX >> TEXELS_BYTES) {
        diag_add(f->input->sink, DIAG_LIMIT, SPAN_NONE,
                 "all images together have more than 16 GiB of texels");
        return FLATTEN_REPORTED;
    }
    if (!flat_array_make(&f->out->paints, end))
        return FLATTEN_NO_MEMORY;
    for (const struct scene_texture *t = f->scene->textures; t; t = t->next)
        fill_texture(t, &placed[t->number], &f->out->paints);
    for (uint32_t i = 0; i < f->scene->body_count; i++) {
        const struct scene_body *body = &f->scene->bodies[i];
        gpu_pack_uint(f->out->paints.words + f->out->coordinates_table + i / BODIES_PER_WORD, 0,
                      i % BODIES_PER_WORD, f->coordinates[i]);
        if (!f->coordinates[i] || first_with_mesh(f, i) < i)
            continue;
        struct coordinates coordinates = {body, f->out->paints.words + (f->coordinates[i] & ~UINT32_C(1)),
                                          f->out->is_double};
        parallel_for(body->triangle_count, PIECE_TRIANGLES, fill_coordinates, &coordinates);
    }
    fill_records(f, placed);
    return FLATTEN_DONE;
}

enum flatten_fault flatten_paints(struct flattening *f) {
    f->coordinates = heap_zeroed((size_t)f->scene->body_count + 1, sizeof *f->coordinates);
    if (!f->coordinates)
        return FLATTEN_NO_MEMORY;
    // Kernels have its binding in any case.
    if (!is_any_painted(f))
        return flat_array_make(&f->out->paints, 0) ? FLATTEN_DONE : FLATTEN_NO_MEMORY;
    struct flat_texture *placed = heap_zeroed((size_t)f->scene->texture_count + 1, sizeof *placed);
    f->out->texels.textures = placed;
    return placed ? fill_all(f, placed) : FLATTEN_NO_MEMORY;
}
