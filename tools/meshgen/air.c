#include "tools/meshgen/air.h"

#include "tools/meshgen/noise.h"

// Late afternoon, the sun low at the left of the showcase's camera and a little behind it.
vec3 air_sun_direction(void) {
    return vec3_unit((vec3){-0.82, 0.33, 0.46});
}

vec3 air_sun_colour(void) {
    return (vec3){3.7, 2.5, 1.4};
}

vec3 air_mix(vec3 a, vec3 b, double t) {
    return vec3_add(vec3_mul(a, 1 - t), vec3_mul(b, t));
}

static vec3 add_scaled(vec3 sum, vec3 colour, double scale) {
    return vec3_add(sum, vec3_mul(colour, scale));
}

// From deep blue above through pale blue to a warm horizon, warmest on the sun's side and rose opposite it.
static vec3 clear_sky(vec3 direction, double toward_sun) {
    const vec3 zenith = {0.022, 0.115, 0.37}, middle = {0.11, 0.40, 0.80};
    const vec3 low_sun = {1.15, 0.78, 0.42}, low_far = {1.02, 0.82, 0.62};
    double height = fmax(0, direction.y);
    vec3 low = air_mix(low_far, low_sun, noise_smoothstep(-0.5, 1, toward_sun));
    vec3 sky = air_mix(zenith, middle, exp(-height * 2.6));
    return air_mix(sky, low, 0.95 * exp(-height * 7.5));
}

static vec3 add_glow(vec3 sky, double toward_sun) {
    const vec3 wide = {0.42, 0.22, 0.04}, near = {0.95, 0.60, 0.26}, disc = {30, 25, 18};
    double cosine = fmax(0, toward_sun);
    sky = add_scaled(sky, wide, pow(cosine, 5));
    sky = add_scaled(sky, near, pow(cosine, 60));
    sky = add_scaled(sky, near, 2.5 * pow(cosine, 900));
    return add_scaled(sky, disc, noise_smoothstep(0.99985, 0.99993, toward_sun));
}

// Puffs on a sheet above; (x, y) in units of its height.
static double puff_density(double x, double y) {
    double bend_x = noise_fractal(x * 0.5 + 3.1, y * 0.5, 3, 71),
           bend_y = noise_fractal(x * 0.5, y * 0.5 + 7.7, 3, 83);
    double body = noise_fractal(x + 0.7 * bend_x, y + 0.7 * bend_y, 7, 11);
    double where = noise_fractal(x * 0.23 + 1.7, y * 0.23 - 0.4, 2, 29);
    return noise_smoothstep(0.02, 0.55, body + 0.75 * where - 0.02);
}

// A cloud is bright where its sheet is thin on the way to the sun, and blue grey below its thick parts.
static vec3 add_puffs(vec3 sky, vec3 direction, double toward_sun) {
    const vec3 lit = {1.40, 1.08, 0.80}, shade = {0.42, 0.45, 0.58}, rim = {1.5, 1.05, 0.62};
    vec3 sun = air_sun_direction();
    double scale = 0.62 / (direction.y + 0.075), x = direction.x * scale, y = direction.z * scale;
    double density = puff_density(x, y);
    if (density <= 0)
        return sky;
    double ahead = puff_density(x + 0.22 * sun.x, y + 0.22 * sun.z);
    double light = exp(-1.9 * ahead) * (1 - 0.35 * density);
    vec3 colour = air_mix(shade, lit, noise_smoothstep(0.05, 0.85, light));
    colour = add_scaled(colour, rim, 0.6 * pow(fmax(0, toward_sun), 12) * (1 - density));
    double cover = (1 - exp(-3.2 * density)) * noise_smoothstep(0.015, 0.17, direction.y);
    return air_mix(sky, colour, 0.94 * cover);
}

// High ice clouds, drawn out along the wind.
static vec3 add_streaks(vec3 sky, vec3 direction) {
    const vec3 ice = {1.15, 0.95, 0.80};
    double scale = 1.0 / (direction.y + 0.13), x = direction.x * scale, y = direction.z * scale;
    double along = 0.86 * x + 0.5 * y, across = 0.86 * y - 0.5 * x;
    double bend = noise_fractal(along * 0.6, across * 0.6, 3, 131);
    double wisp = noise_fractal(along * 0.55 + 0.5 * bend, across * 2.3 + 1.1 * bend, 6, 151);
    double cover = noise_smoothstep(0.0, 0.75, wisp + 0.08) * noise_smoothstep(0.04, 0.3, direction.y);
    return air_mix(sky, ice, 0.55 * cover);
}

vec3 air_colour(vec3 direction) {
    if (direction.y < 0)
        direction = vec3_unit((vec3){direction.x, 0, direction.z});
    double toward_sun = vec3_dot(direction, air_sun_direction());
    vec3 sky = add_glow(clear_sky(direction, toward_sun), toward_sun);
    return add_puffs(add_streaks(sky, direction), direction, toward_sun);
}

vec3 air_haze(vec3 colour, vec3 direction, double distance_km) {
    const vec3 far_side = {0.36, 0.44, 0.62}, sun_side = {0.86, 0.60, 0.40};
    double toward_sun = vec3_dot(direction, air_sun_direction());
    vec3 haze = air_mix(far_side, sun_side, noise_smoothstep(-0.2, 1, toward_sun));
    vec3 passed = {exp(-distance_km / 26), exp(-distance_km / 19), exp(-distance_km / 14)};
    return (vec3){haze.x + (colour.x - haze.x) * passed.x, haze.y + (colour.y - haze.y) * passed.y,
                  haze.z + (colour.z - haze.z) * passed.z};
}
