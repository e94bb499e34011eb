#include "bench/original/boxes.h"

#include "bench/original/layout.h"
#include "shaders/features.h"
#include "shaders/gpu_scene.h"
#include "shaders/records.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static float number_of(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint32_t bits_of(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static bool is_rectangle(const struct gpu_word *triangle) {
    return triangle[2].w & TRIANGLE_HALF;
}

const char *original_lacks(const struct flat_scene *flat) {
    static const struct {
        uint64_t features;
        const char *name;
    } lacks[] = {
        {FEATURE_SPHERES, "spheres"},
        {FEATURE_CONES, "cylinders and cones"},
        {FEATURE_DIRECTION_LIGHT, "lights with a direction"},
        {FEATURE_INVERSE_SQUARE, "lights with a falloff"},
        {FEATURE_DEPTH_BLACK, "a black depth limit"},
    };
    for (size_t i = 0; i < sizeof lacks / sizeof *lacks; i++)
        if (flat->features & lacks[i].features)
            return lacks[i].name;
    if (!(flat->features & FEATURE_SHADOWS))
        return "scenes without shadows";
    for (uint32_t i = 0; i < flat->triangle_count; i++) {
        const struct gpu_word *triangle = flat->triangles.words + (size_t)i * TRIANGLE_WORDS;
        if ((triangle[2].w & TRIANGLE_CHECKER) && !is_rectangle(triangle))
            return "checkers on models";
    }
    return NULL;
}

// By body, then file order: the number of a triangle is both.
static int compare_numbers(const void *a, const void *b) {
    const struct gpu_word *x = a;
    const struct gpu_word *y = b;
    return x->w < y->w ? -1 : x->w > y->w;
}

static bool make_array(struct flat_array *array, uint64_t words) {
    array->words = calloc(words ? words : 1, sizeof *array->words);
    return array->words;
}

static struct gpu_word difference(struct gpu_word a, struct gpu_word b, uint32_t spare) {
    return (struct gpu_word){bits_of(number_of(a.x) - number_of(b.x)),
                             bits_of(number_of(a.y) - number_of(b.y)),
                             bits_of(number_of(a.z) - number_of(b.z)), spare};
}

// The first half of a rectangle holds corner, corner + u and corner + u + v.
static void add_rectangle(struct original_boxes *out, const struct flat_scene *flat,
                          const struct gpu_word *half) {
    const struct gpu_word *lengths = flat->bodies.words + (size_t)half[1].w * BODY_WORDS + 1;
    struct gpu_word *words = out->rectangles.words + (size_t)out->rectangle_count * RECTANGLE_WORDS;
    words[0] = half[0];
    words[0].w = half[2].w & TRIANGLE_MATERIAL;
    words[1] = difference(half[1], half[0], lengths->x);
    words[2] = difference(half[2], half[1], lengths->y);
    out->rectangle_count++;
    out->rectangles.count += RECTANGLE_WORDS;
}

static void sort_bodies(const struct flat_scene *flat, struct original_boxes *out) {
    for (uint32_t i = 0; i < flat->triangle_count; i++) {
        const struct gpu_word *triangle = flat->triangles.words + (size_t)i * TRIANGLE_WORDS;
        if (!is_rectangle(triangle)) {
            memcpy(out->triangles.words + out->triangles.count, triangle, TRIANGLE_WORDS * sizeof *triangle);
            out->triangles.count += TRIANGLE_WORDS;
            out->triangle_count++;
        } else if (!(triangle[2].w & TRIANGLE_SECOND_HALF)) {
            add_rectangle(out, flat, triangle);
        }
    }
    qsort(out->triangles.words, out->triangle_count, TRIANGLE_WORDS * sizeof(struct gpu_word),
          compare_numbers);
}

static void close_box(struct original_boxes *out, uint32_t first, uint32_t count) {
    float lower[3] = {INFINITY, INFINITY, INFINITY};
    float upper[3] = {-INFINITY, -INFINITY, -INFINITY};
    const struct gpu_word *vertex = out->triangles.words + (size_t)first * TRIANGLE_WORDS;
    for (uint32_t i = 0; i < count * TRIANGLE_WORDS; i++, vertex++) {
        const float at[3] = {number_of(vertex->x), number_of(vertex->y), number_of(vertex->z)};
        for (int axis = 0; axis < 3; axis++) {
            lower[axis] = fminf(lower[axis], at[axis]);
            upper[axis] = fmaxf(upper[axis], at[axis]);
        }
    }
    struct gpu_word *words = out->boxes.words + out->boxes.count;
    words[0] = (struct gpu_word){bits_of(lower[0]), bits_of(lower[1]), bits_of(lower[2]), first};
    words[1] = (struct gpu_word){bits_of(upper[0]), bits_of(upper[1]), bits_of(upper[2]), count};
    out->boxes.count += BOX_WORDS;
    out->box_count++;
}

// A box ends at 64 triangles, and with its model.
static void make_boxes(struct original_boxes *out) {
    const struct gpu_word *words = out->triangles.words;
    for (uint32_t first = 0, i = 1; first < out->triangle_count; i++) {
        const bool ends =
            i == out->triangle_count || i - first == BOX_TRIANGLES ||
            words[(size_t)i * TRIANGLE_WORDS + 1].w != words[(size_t)first * TRIANGLE_WORDS + 1].w;
        if (ends) {
            close_box(out, first, i - first);
            first = i;
        }
    }
}

bool original_boxes_make(const struct flat_scene *flat, struct original_boxes *out) {
    *out = (struct original_boxes){0};
    const uint64_t triangles = flat->triangle_count;
    const uint64_t most_boxes = triangles / BOX_TRIANGLES + flat->body_count + 1;
    if (!make_array(&out->triangles, triangles * TRIANGLE_WORDS) ||
        !make_array(&out->rectangles, (uint64_t)flat->body_count * RECTANGLE_WORDS) ||
        !make_array(&out->boxes, most_boxes * BOX_WORDS))
        return false;
    sort_bodies(flat, out);
    make_boxes(out);
    return true;
}

void original_boxes_finish(struct original_boxes *boxes) {
    free(boxes->boxes.words);
    free(boxes->triangles.words);
    free(boxes->rectangles.words);
    *boxes = (struct original_boxes){0};
}
