#include "tools/meshgen/land.h"

#include "core/angle.h"
#include "core/parallel.h"
#include "tools/meshgen/air.h"
#include "tools/meshgen/noise.h"

#include <stdlib.h>

static const double NEAREST_KM = 0.7;
static const double FARTHEST_KM = 17;
static const double FOREST_END_KM = 4.5;

double land_distance(int ring) {
    return NEAREST_KM * pow(FARTHEST_KM / NEAREST_KM, (double)ring / (LAND_RINGS - 1));
}

double land_azimuth(const struct land *land, int column) {
    return 2 * PI * (column + 0.5) / land->columns - PI;
}

// Where forest stands: low, and in patches.
static double forest(double x, double z, double height) {
    double patches = noise_fractal(x * 0.8, z * 0.8, 4, 307);
    return noise_smoothstep(-0.35, 0.1, patches + 0.25) * noise_smoothstep(0.006, 0.02, height) *
           (1 - noise_smoothstep(0.45, 0.85, height + 0.25 * patches));
}

// Firs are cones on a jittered grid; the height of the highest above a point.
static double firs(double x, double z) {
    const double cell = 0.013;
    double highest = 0;
    int32_t i0 = (int32_t)floor(x / cell), j0 = (int32_t)floor(z / cell);
    for (int32_t i = i0 - 1; i <= i0 + 1; i++) {
        for (int32_t j = j0 - 1; j <= j0 + 1; j++) {
            double dx = x - cell * (i + noise_random(i, j, 401)),
                   dz = z - cell * (j + noise_random(i, j, 402));
            double size = 0.6 + 0.6 * noise_random(i, j, 403);
            highest = fmax(highest, 0.030 * size * (1 - hypot(dx, dz) / (0.0085 * size)));
        }
    }
    return highest;
}

static double hills(double x, double z) {
    return 0.5 + noise_fractal(x * 0.55, z * 0.55, 7, 239);
}

static double mountains(double x, double z) {
    double bend = 0.5 * noise_fractal(x * 0.15, z * 0.15, 3, 223);
    double range = 0.55 + 0.65 * noise_fractal(x * 0.07 + 9, z * 0.07, 2, 233);
    return fmax(0.12, range) * noise_ridged(x * 0.155 + bend + 4.3, z * 0.155 - bend + 1.9, 9, 229);
}

static double ground(double x, double z) {
    double shore = noise_fractal(x * 0.33, z * 0.33, 4, 211);
    double reach = hypot(x, z) * (1 + 0.42 * shore);
    double height = -0.05 + 0.075 * noise_smoothstep(1.7, 1.95, reach);
    double hill_share = noise_smoothstep(1.9, 5.0, reach), mountain_share = noise_smoothstep(3.2, 8.5, reach);
    if (hill_share > 0)
        height += 0.34 * hill_share * hills(x, z);
    if (mountain_share > 0)
        height += 3.7 * mountain_share * mountains(x, z);
    return height;
}

static void make_columns(void *context, size_t begin, size_t end) {
    struct land *land = context;
    for (size_t column = begin; column < end; column++) {
        double azimuth = land_azimuth(land, (int)column);
        for (int ring = 0; ring < LAND_RINGS; ring++) {
            double distance = land_distance(ring), x = distance * cos(azimuth), z = distance * sin(azimuth);
            double height = ground(x, z);
            if (distance < FOREST_END_KM && height > 0) {
                double trees = forest(x, z, height);
                if (trees > 0.05)
                    height += fmin(1, 1.5 * trees) * firs(x, z);
            }
            land->heights[column * LAND_RINGS + (size_t)ring] = (float)height;
        }
    }
}

struct land *land_create(int columns) {
    struct land *land = malloc(sizeof *land);
    if (!land)
        return NULL;
    land->columns = columns;
    land->heights = malloc((size_t)columns * LAND_RINGS * sizeof *land->heights);
    if (!land->heights) {
        free(land);
        return NULL;
    }
    parallel_for((size_t)columns, 16, make_columns, land);
    return land;
}

void land_destroy(struct land *land) {
    if (!land)
        return;
    free(land->heights);
    free(land);
}

static double height_at(const struct land *land, int column, int ring) {
    int wrapped = (column + land->columns) % land->columns;
    return land->heights[(size_t)wrapped * LAND_RINGS + (size_t)ring];
}

// Height at any place; outside the rings it is far below.
static double height_near(const struct land *land, double x, double z) {
    double ring = log(hypot(x, z) / NEAREST_KM) / log(FARTHEST_KM / NEAREST_KM) * (LAND_RINGS - 1);
    double column = (atan2(z, x) + PI) / (2 * PI) * land->columns - 0.5;
    if (ring < 0 || ring >= LAND_RINGS - 1)
        return -1;
    int i = (int)floor(column), j = (int)ring;
    double u = column - i, v = ring - j;
    double before = height_at(land, i, j) * (1 - v) + height_at(land, i, j + 1) * v;
    double after = height_at(land, i + 1, j) * (1 - v) + height_at(land, i + 1, j + 1) * v;
    return before * (1 - u) + after * u;
}

// 1 in full sun, 0 behind a mountain; the edge softens with the way to what casts it.
static double sunlit(const struct land *land, vec3 from) {
    vec3 sun = air_sun_direction();
    double lit = 1, step = 0.03;
    for (double way = 0.03; way < 9 && lit > 0; way += step) {
        vec3 point = vec3_add(from, vec3_mul(sun, way));
        double clear = (point.y - height_near(land, point.x, point.z)) / way;
        lit = fmin(lit, noise_smoothstep(-0.012, 0.03, clear));
        step *= 1.16;
    }
    return lit;
}

static vec3 normal_at(const struct land *land, int column, int ring) {
    int far = ring + 1 < LAND_RINGS ? ring + 1 : ring, near = ring > 0 ? ring - 1 : 0;
    double distance = land_distance(ring), azimuth = land_azimuth(land, column);
    double outward = (height_at(land, column, far) - height_at(land, column, near)) /
                     (land_distance(far) - land_distance(near));
    double round = (height_at(land, column + 1, ring) - height_at(land, column - 1, ring)) /
                   (2 * distance * 2 * PI / land->columns);
    return vec3_unit((vec3){-outward * cos(azimuth) + round * sin(azimuth), 1,
                            -outward * sin(azimuth) - round * cos(azimuth)});
}

// Meadow and forest below, rock above and where it is steep, snow on top where it can lie.
// A fir is steep, but green.
static vec3 cover(vec3 place, double steepness) {
    const vec3 meadow = {0.13, 0.15, 0.035}, fir = {0.026, 0.054, 0.024}, snow = {0.90, 0.91, 0.94};
    const vec3 rock_dark = {0.11, 0.10, 0.095}, rock_light = {0.27, 0.235, 0.20};
    double mottle = noise_fractal(place.x * 3.1, place.z * 3.1, 5, 503);
    vec3 rock = air_mix(rock_dark, rock_light, noise_smoothstep(-0.5, 0.6, mottle));
    double trees = forest(place.x, place.z, place.y);
    vec3 green = air_mix(meadow, fir, trees);
    double bare = noise_smoothstep(0.55, 1.0, place.y + 0.3 * mottle);
    bare = fmax(bare, noise_smoothstep(0.75, 1.2, steepness) * noise_smoothstep(0.15, 0.4, place.y));
    if (hypot(place.x, place.z) < FOREST_END_KM)
        bare *= 1 - noise_smoothstep(0.05, 0.4, trees);
    double white = noise_smoothstep(1.0, 1.5, place.y + 0.4 * mottle) *
                   (1 - noise_smoothstep(0.85, 1.7, steepness - 0.35 * (place.y - 0.9)));
    return air_mix(air_mix(green, rock, bare), snow, white);
}

vec3 land_colour(const struct land *land, int column, int ring) {
    const vec3 sky_light = {0.26, 0.33, 0.50}, bounce = {0.12, 0.10, 0.08};
    double distance = land_distance(ring), azimuth = land_azimuth(land, column);
    vec3 place = {distance * cos(azimuth), height_at(land, column, ring), distance * sin(azimuth)};
    vec3 normal = normal_at(land, column, ring);
    double facing = fmax(0, vec3_dot(normal, air_sun_direction()));
    double sun = facing > 0 ? facing * sunlit(land, place) : 0;
    vec3 light = vec3_add(vec3_mul(sky_light, 0.4 + 0.6 * normal.y), bounce);
    light = vec3_add(light, vec3_mul(air_sun_colour(), sun));
    vec3 albedo = cover(place, sqrt(fmax(0, 1 / (normal.y * normal.y) - 1)));
    return (vec3){albedo.x * light.x, albedo.y * light.y, albedo.z * light.z};
}
