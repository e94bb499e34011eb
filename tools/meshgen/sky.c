#include "core/angle.h"
#include "core/parallel.h"
#include "tools/meshgen/air.h"
#include "tools/meshgen/generators.h"
#include "tools/meshgen/land.h"
#include "tools/meshgen/noise.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

static const double EYE_KM = 0.022; // above the lake

// Rows are made this much finer than the picture: crests and shores are the sharpest things in it.
enum {
    FINE = 2
};

struct canvas {
    const struct land *land;
    unsigned char *pixels;
    int width, height;
    atomic_bool failed; // memory ended
};

// One column of a view: for each fine row, the ring of the land seen there, or -1.
struct column_view {
    short *rings;
    int rows; // from the zenith (0) to the nadir
};

// What one column needs while it is painted.
struct column {
    const struct canvas *canvas;
    int index;
    double azimuth;
    struct column_view view;   // from the eye
    struct column_view mirror; // from as far below the lake: what the lake mirrors
    vec3 *air;                 // colours of the sky by row, from the zenith to the horizon
    vec3 *ground;              // colours of the land by ring, where known
    bool *ground_known;
};

static double row_elevation(int row, int rows) {
    return PI * (0.5 - (row + 0.5) / rows);
}

// Walks outward and remembers, for every fine row, the nearest ground in it. From an eye below the lake by
// as much as the true one is above it, this gives what the lake mirrors.
static void look_out(const struct land *land, int column, double eye_km, struct column_view view) {
    int top = view.rows; // rows from here down are filled
    for (int row = 0; row < view.rows; row++)
        view.rings[row] = -1;
    for (int ring = 0; ring < LAND_RINGS; ring++) {
        double height = land->heights[(size_t)column * LAND_RINGS + (size_t)ring];
        if (height <= 0)
            continue;
        double elevation = atan2(height - eye_km, land_distance(ring));
        double foot = atan2(-eye_km, land_distance(ring));
        int row = (int)floor((0.5 - elevation / PI) * view.rows + 0.5);
        int lowest = (int)floor((0.5 - foot / PI) * view.rows + 0.5);
        for (int fill = lowest < top ? lowest : top; fill-- > row;)
            view.rings[fill] = (short)ring;
        top = row < top ? row : top;
    }
}

static vec3 direction_at(double azimuth, double elevation) {
    return (vec3){cos(elevation) * cos(azimuth), sin(elevation), cos(elevation) * sin(azimuth)};
}

static vec3 land_seen(const struct column *column, double elevation, int ring) {
    if (!column->ground_known[ring]) {
        column->ground[ring] = land_colour(column->canvas->land, column->index, ring);
        column->ground_known[ring] = true;
    }
    return air_haze(column->ground[ring], direction_at(column->azimuth, elevation), land_distance(ring));
}

// Fresnel's share by Schlick's approximation, the rest from the depth, greener near the shore and the eye.
static vec3 on_water(vec3 mirrored, vec3 direction) {
    const vec3 depth = {0.010, 0.055, 0.075};
    double grazing = 1 + direction.y;
    double share = 0.04 + 0.96 * pow(grazing, 5);
    return air_mix(depth, mirrored, fmin(1, 0.06 + 0.9 * share));
}

// How far ripples throw the mirrored ray up or down, in radians; long crests, seen flatter farther off.
static double ripple(double azimuth, double elevation) {
    double distance = EYE_KM / fmax(1e-4, -tan(elevation)), x = distance * cos(azimuth),
           z = distance * sin(azimuth);
    double fine = noise_fractal(x * 160, z * 160, 3, 601), broad = noise_fractal(x * 9, z * 9, 4, 607);
    double wind = noise_smoothstep(-0.25, 0.5, noise_fractal(x * 2.2, z * 2.2, 3, 613));
    double calm = 1 / (1 + 2 * distance);
    return (0.006 + 0.03 * wind) * calm * fine + 0.006 * broad * calm;
}

static vec3 mirrored_colour(const struct column *column, double up) {
    int fine = (int)floor((0.5 - up / PI) * column->mirror.rows);
    fine = fine < 0 ? 0 : fine >= column->mirror.rows / 2 ? column->mirror.rows / 2 - 1 : fine;
    int ring = column->mirror.rings[fine];
    return ring < 0 ? column->air[fine / FINE] : land_seen(column, up, ring);
}

static vec3 water_colour(const struct column *column, double elevation) {
    double up = fabs(-elevation + ripple(column->azimuth, elevation));
    vec3 direction = direction_at(column->azimuth, elevation);
    vec3 water = on_water(mirrored_colour(column, up), direction);
    return air_haze(water, direction_at(column->azimuth, 0), 0.6 * EYE_KM / fmax(1e-3, -tan(elevation)));
}

static vec3 colour_at(const struct column *column, int fine) {
    double elevation = row_elevation(fine, column->view.rows);
    int ring = column->view.rings[fine];
    if (ring >= 0)
        return land_seen(column, elevation, ring);
    return elevation < 0 ? water_colour(column, elevation) : column->air[fine / FINE];
}

// A film's shoulder, then sRGB; half a step of noise keeps the gradients from banding.
static unsigned char developed(double x, double noise) {
    double y = x < 0.6 ? x : 0.6 + 0.4 * (1 - exp(-(x - 0.6) / 0.4));
    double encoded = y <= 0.0031308 ? 12.92 * y : 1.055 * pow(y, 1 / 2.4) - 0.055;
    return (unsigned char)fmin(255, fmax(0, floor(255 * encoded + noise)));
}

// Whether the sky shows in any fine row of a row.
static bool opens(struct column_view view, int row) {
    bool open = false;
    for (int fine = 0; fine < FINE; fine++)
        open = open || view.rings[row * FINE + fine] < 0;
    return open;
}

static void paint_air(const struct column *column) {
    int rows = column->canvas->height / 2;
    for (int row = 0; row < rows; row++)
        if (opens(column->view, row) || opens(column->mirror, row))
            column->air[row] = air_colour(direction_at(column->azimuth, row_elevation(row, 2 * rows)));
}

static void paint_column(const struct column *column) {
    const struct canvas *canvas = column->canvas;
    look_out(canvas->land, column->index, EYE_KM, column->view);
    look_out(canvas->land, column->index, -EYE_KM, column->mirror);
    paint_air(column);
    for (int row = 0; row < canvas->height; row++) {
        // Only near the horizon is there anything finer than a row.
        int fine_rows = abs(row - canvas->height / 2) < canvas->height / 8 ? FINE : 1;
        vec3 sum = {0, 0, 0};
        for (int fine = 0; fine < fine_rows; fine++)
            sum = vec3_add(sum, vec3_mul(colour_at(column, row * FINE + fine), 1.0 / fine_rows));
        unsigned char *pixel =
            canvas->pixels + 3 * ((size_t)row * (size_t)canvas->width + (size_t)column->index);
        double noise = 0.25 + 0.5 * noise_random(column->index, row, 701);
        pixel[0] = developed(sum.x, noise);
        pixel[1] = developed(sum.y, noise);
        pixel[2] = developed(sum.z, noise);
    }
}

static void paint_columns(void *context, size_t begin, size_t end) {
    struct canvas *canvas = context;
    int rows = canvas->height * FINE;
    short *rings = malloc(2 * (size_t)rows * sizeof *rings);
    vec3 *colours = malloc(((size_t)canvas->height / 2 + LAND_RINGS) * sizeof *colours);
    bool known[LAND_RINGS];
    if (!rings || !colours) {
        canvas->failed = true;
        end = begin;
    }
    for (size_t i = begin; i < end; i++) {
        struct column column = {
            .canvas = canvas,
            .index = (int)i,
            .azimuth = land_azimuth(canvas->land, (int)i),
            .view = {rings, rows},
            .mirror = {rings + rows, rows},
            .air = colours + LAND_RINGS,
            .ground = colours,
            .ground_known = known,
        };
        memset(known, 0, sizeof known);
        paint_column(&column);
    }
    free(rings);
    free(colours);
}

unsigned char *sky_generate(int width, int height) {
    struct canvas canvas = {.width = width, .height = height, .failed = false};
    struct land *land = land_create(width);
    canvas.pixels = land ? malloc(3 * (size_t)width * (size_t)height) : NULL;
    canvas.land = land;
    if (canvas.pixels)
        parallel_for((size_t)width, 16, paint_columns, &canvas);
    land_destroy(land);
    if (canvas.failed) {
        free(canvas.pixels);
        canvas.pixels = NULL;
    }
    return canvas.pixels;
}
