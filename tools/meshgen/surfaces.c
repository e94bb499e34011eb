// Pictures for surfaces: planks of wood, and a globe of land and sea.
#include "core/angle.h"
#include "core/heap.h"
#include "core/parallel.h"
#include "core/srgb.h"
#include "tools/meshgen/air.h"
#include "tools/meshgen/generators.h"
#include "tools/meshgen/noise.h"

#include <math.h>

// The linear colour at x, y in 0..1, y upwards.
typedef vec3 surface_colour(double x, double y);

struct painting {
    surface_colour *colour;
    unsigned char *pixels;
    int width, height;
};

static unsigned char stored(double linear) {
    return (unsigned char)(255 * srgb_encode(fmin(fmax(linear, 0), 1)) + 0.5);
}

static void paint_rows(void *context, size_t begin, size_t end) {
    const struct painting *p = context;
    for (size_t row = begin; row < end; row++)
        for (int x = 0; x < p->width; x++) {
            const vec3 c = p->colour((x + 0.5) / p->width, 1 - ((double)row + 0.5) / p->height);
            unsigned char *pixel = p->pixels + 3 * (row * (size_t)p->width + (size_t)x);
            pixel[0] = stored(c.x);
            pixel[1] = stored(c.y);
            pixel[2] = stored(c.z);
        }
}

static unsigned char *paint(surface_colour *colour, int width, int height) {
    struct painting p = {colour, heap_array(heap_times(width, height), 3), width, height};
    if (p.pixels)
        parallel_for((size_t)height, 8, paint_rows, &p);
    return p.pixels;
}

// ---- planks

enum {
    PLANKS = 6, // side by side
    LENGTHS = 2 // in each row
};

// Growth rings along a board, from a place across it; `board` tells boards apart.
static vec3 wood(double along, double across, uint32_t board) {
    const double tone = noise_random((int32_t)board, 3, 11);
    const double bend = noise_fractal(along * 3, across * 2, 3, board * 7 + 1);
    const double rings = 0.5 + 0.5 * sin(2 * PI * (across * 7 + 1.5 * bend + tone * 4));
    const double fibre = noise_fractal(along * 6, across * 90, 3, board + 40);
    const double light = 0.75 + 0.3 * tone + 0.12 * fibre;
    return vec3_mul(air_mix((vec3){0.30, 0.135, 0.05}, (vec3){0.50, 0.27, 0.115}, rings), light);
}

// Boards lie across; every other row is moved by half a board, so that the picture repeats.
static vec3 planks_colour(double x, double y) {
    const double row = floor(y * PLANKS), across = y * PLANKS - row;
    const double moved = x * LENGTHS + 0.5 * fmod(row, 2), along = moved - floor(moved);
    const uint32_t board = (uint32_t)row * LENGTHS + (uint32_t)fmod(floor(moved), LENGTHS);
    const double from_side = fmin(across, 1 - across), from_end = fmin(along, 1 - along) * PLANKS / LENGTHS;
    const double gap = fmin(1, fmin(from_side, from_end) / 0.018);
    return vec3_mul(wood(along, across, board), 0.15 + 0.85 * gap * gap * (3 - 2 * gap));
}

unsigned char *planks_generate(int side) {
    return paint(planks_colour, side, side);
}

// ---- a globe

// Height above the sea at a place of the unit sphere, about -1..1: noise of three planes, weighted by where
// each is seen straight on.
static double land_height(vec3 p) {
    const double wx = p.x * p.x * p.x * p.x, wy = p.y * p.y * p.y * p.y, wz = p.z * p.z * p.z * p.z;
    const double a = noise_fractal(p.y * 1.6 + (p.x > 0 ? 9 : 23), p.z * 1.6, 7, 101);
    const double b = noise_fractal(p.x * 1.6 + (p.y > 0 ? 5 : 31), p.z * 1.6, 7, 202);
    const double c = noise_fractal(p.x * 1.6 + (p.z > 0 ? 3 : 17), p.y * 1.6, 7, 303);
    return (wx * a + wy * b + wz * c) / (wx + wy + wz);
}

static vec3 land_tint(double height, double latitude) {
    const vec3 forest = {0.05, 0.13, 0.03}, sand = {0.55, 0.38, 0.18}, rock = {0.22, 0.17, 0.12},
               snow = {0.85, 0.88, 0.9};
    const double dry = fmax(0, 1 - fabs(fabs(latitude) - 0.4) / 0.3);
    const vec3 low = air_mix(forest, sand, dry);
    const vec3 high = air_mix(low, rock, fmin(1, fmax(0, height * 3 - 0.3)));
    return air_mix(high, snow, fmin(1, fmax(0, (fabs(latitude) + 0.6 * height - 1.0) * 6)));
}

static vec3 globe_colour(double x, double y) {
    const double longitude = 2 * PI * (x - 0.5), latitude = PI * (y - 0.5);
    const vec3 p = {cos(latitude) * cos(longitude), sin(latitude), cos(latitude) * sin(longitude)};
    const double height = land_height(p) + 0.02;
    const vec3 deep = {0.006, 0.025, 0.09}, shallow = {0.02, 0.16, 0.22};
    if (height <= 0) {
        const vec3 sea = air_mix(shallow, deep, fmin(1, -height * 9));
        return air_mix(sea, (vec3){0.8, 0.85, 0.9}, fmin(1, fmax(0, (fabs(latitude) - 1.25) * 8)));
    }
    return land_tint(height, latitude);
}

unsigned char *globe_generate(int width, int height) {
    return paint(globe_colour, width, height);
}
