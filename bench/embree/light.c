// Where light comes from: shaders/lights.glsl and background.glsl in C.
#include "bench/embree/peer.h"

static const float PI_SINGLE = 3.14159265F;

// ---- lights

static float highlight(float loss, float exponent) {
    if (exponent == 0)
        return 1;
    const float power = exponent * log2f(1 - loss);
    return loss < 1 ? exp2f(power > -200 ? power : -200) : 0;
}

float3 peer_light(const struct peer_light *light, const struct peer_surface *s, float3 start,
                  float3 direction, float3 *way, float *far) {
    const float3 to = float3_sub(light->place, s->point);
    const float distance2 = float3_dot(to, to);
    const float3 l = light->directional ? light->place : float3_mul(to, 1 / sqrtf(distance2));
    const float facing = float3_dot(s->shading, l);
    if (!(facing > 0) || !(float3_dot(s->geometric, l) > 0))
        return (float3){0, 0, 0};
    float3 sum = float3_mul(s->diffuse, facing);
    if (!float3_is_zero(s->specular)) {
        const float3 gap = float3_add(float3_sub(float3_mul(s->shading, 2 * facing), l), direction);
        sum = float3_add(sum, float3_mul(s->specular, highlight(0.5F * float3_dot(gap, gap), s->exponent)));
    }
    *way = light->directional ? light->place : float3_sub(light->place, start);
    *far = light->directional ? INFINITY : 1;
    return float3_scale(light->inverse_square ? float3_mul(light->emission, 1 / distance2) : light->emission,
                        sum);
}

// ---- background

// The kernel's own fit of the arc tangent (shaders/math.glsl): libm's would be the slowest part of a miss.
static float arctan_small(float x) {
    const float z = x * x;
    float p = -0.060263052378973F * z + 0.105698288108559F;
    p = p * z - 0.142395326703701F;
    p = p * z + 0.199981830411381F;
    p = p * z - 0.333333068930503F;
    return x + x * (z * p);
}

static float arctan2(float y, float x) {
    const float ax = fabsf(x), ay = fabsf(y);
    const float big = ax > ay ? ax : ay, small = ax > ay ? ay : ax;
    const bool upper = small > 0.414213562F * big;
    const float quotient = big == 0 ? 0 : upper ? (small - big) / (small + big) : small / big;
    float angle = arctan_small(quotient) + (upper ? 0.785398163397448F : 0);
    angle = ay > ax ? 1.5707963267949F - angle : angle;
    angle = x < 0 ? PI_SINGLE - angle : angle;
    return y < 0 ? -angle : angle;
}

static float3 texel(const struct peer *peer, const struct picture *picture, uint32_t column, uint32_t row) {
    const size_t at = (size_t)row * picture->width + column;
    if (picture_is_linear(picture))
        return (float3){picture_linear(picture, at, 0), picture_linear(picture, at, 1),
                        picture_linear(picture, at, 2)};
    return (float3){peer->decoded[picture_stored(picture, at, 0)],
                    peer->decoded[picture_stored(picture, at, 1)],
                    peer->decoded[picture_stored(picture, at, 2)]};
}

static float3 between(float3 a, float3 b, float part) {
    return float3_add(float3_mul(a, 1 - part), float3_mul(b, part));
}

static float3 image(const struct peer *peer, const struct scene_background *background, float3 d) {
    const struct picture *picture = background->picture;
    const float cosine = (float)background->cosine, sine = (float)background->sine;
    const float x = d.x * cosine - d.z * sine, z = d.x * sine + d.z * cosine;
    const float width = (float)picture->width, height = (float)picture->height;
    const float u = (0.5F + arctan2(z, x) * (0.5F / PI_SINGLE)) * width - 0.5F;
    const float v = arctan2(sqrtf(x * x + z * z), d.y) * (1 / PI_SINGLE) * height - 0.5F;
    const float u_floor = floorf(u), v_floor = floorf(v);
    const int column = (int)u_floor, row = (int)v_floor;
    const int columns = (int)picture->width, rows = (int)picture->height;
    const uint32_t left = (uint32_t)(column < 0 ? columns - 1 : column < columns ? column : columns - 1);
    const uint32_t right = column + 1 >= columns ? 0 : (uint32_t)(column + 1);
    const uint32_t top = (uint32_t)(row < 0 ? 0 : row < rows ? row : rows - 1);
    const uint32_t bottom = (uint32_t)(row + 1 < rows ? row + 1 : rows - 1);
    const float3 upper =
        between(texel(peer, picture, left, top), texel(peer, picture, right, top), u - u_floor);
    const float3 lower =
        between(texel(peer, picture, left, bottom), texel(peer, picture, right, bottom), u - u_floor);
    return float3_mul(between(upper, lower, v - v_floor), (float)background->intensity);
}

float3 peer_background(const struct peer *peer, float3 direction) {
    const struct scene_background *background = &peer->scene->background;
    return background->picture ? image(peer, background, direction) : peer->background;
}
