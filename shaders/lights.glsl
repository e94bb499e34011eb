// What one light adds to a surface, shadows aside (docs/language.md, "Hit").

struct light_ray {
    vec3 value;     // what the light adds where nothing blocks it
    REAL3 direction; // from `start`; the light is at t = 1, or at infinity
    REAL t_max;
    REAL3 place; // of a light with extent: where it is sampled, with t_max 1
};

#include "light/extent.glsl"
#include "light/ambient.glsl"
#include "light/sky.glsl"

exact_aim aim_at(uint index, light_ray ray) {
    if (HAS_PLACES)
        return exact_aim(ray.direction, ray.t_max < FAR_AWAY && index < frame.light_count, ray.place);
    light_record light = load_light(index);
    bool directional = HAS_DIRECTION_LIGHT && (!HAS_POINT_LIGHT || (light.flags & LIGHT_DIRECTIONAL) != 0u);
    return exact_aim(ray.direction, !directional, light.place);
}

// The share of a spot light's emission that leaves it towards a surface; `l`: unit, from there to the light.
float beam_share(light_record light, REAL3 l) {
    REAL3 off = l + light.axis;
    float share = clamp(float(light.open - 0.5 * dot3(off, off)) * light.rate, 0.0, 1.0);
    return share * share;
}

light_ray lamp_at(uint index, surface s, REAL3 start, REAL3 direction, uint key) {
    light_record light = load_light(index);
    vec3 emission = light.emission;
    bool directional = HAS_DIRECTION_LIGHT && (!HAS_POINT_LIGHT || (light.flags & LIGHT_DIRECTIONAL) != 0u);
    REAL3 way = light.place - s.point;
    REAL distance2 = dot3(way, way);
    REAL3 l = directional ? light.place : way * (1.0 / sqrt(distance2));
    if (HAS_INVERSE_SQUARE)
        emission = (light.flags & LIGHT_INVERSE_SQUARE) != 0u ? emission / float(distance2) : emission;
    light_spot spot = light_spot(light.place, l, 1.0);
    bool sky = is_sky(index);
    if (HAS_SKY_LIGHT && sky) {
        sky_spot seen = sky_at(point_key(key, POINT_SKY));
        emission = seen.emission;
        l = seen.l;
        directional = true;
    }
    if (HAS_SOFT_LIGHT && (light.flags & LIGHT_EXTENT) != 0u && !sky) {
        spot = spot_of(index, light, s.point, l, distance2, key);
        l = spot.l;
        emission *= float(spot.share);
    }
    if (HAS_SPOT)
        emission *= (light.flags & LIGHT_SPOT) != 0u && !sky ? beam_share(light, l) : 1.0;
    REAL facing = dot3(s.shading, l);
    bool lit = facing > 0.0 && dot3(s.geometric, l) > 0.0 && (directional || distance2 > 0.0);
    vec3 diffuse = vec3(0.0), specular = vec3(0.0);
    if (HAS_DIFFUSE)
        diffuse = s.diffuse * float(facing);
    if (HAS_SPECULAR) {
        // r . v = 1 - |r - v|^2 / 2 with v = -direction
        REAL3 gap = s.shading * (2.0 * facing) - l + direction;
        specular = s.specular * highlight(float(0.5 * dot3(gap, gap)), s.exponent);
    }
    vec3 sum = diffuse;
    if (HAS_SPECULAR)
        sum = !HAS_DIFFUSE || !s.has_diffuse ? specular : s.has_specular ? diffuse + specular : diffuse;
    light_ray ray;
    ray.value = lit ? emission * sum : vec3(0.0);
    ray.direction = directional ? light.place : light.place - start;
    ray.t_max = directional ? FAR_AWAY : 1.0;
    if (HAS_PLACES)
        ray.place = spot.place;
    if (HAS_SOFT_LIGHT)
        ray.direction = directional ? spot.l : spot.place - start;
    if (HAS_SKY_LIGHT && sky)
        ray.direction = l;
    return ray;
}

// `key`: the key of the ray that hit the surface; `index`: below light_end().
light_ray light_at(uint index, surface s, REAL3 start, REAL3 direction, uint key) {
    light_ray ray;
    if (HAS_OCCLUSION && index >= frame.light_count && !is_sky(index))
        ray = ambient_ray(s, start, key);
    else
        ray = lamp_at(index, s, start, direction, key);
    return ray;
}

// Adds to the sum over a surface's lights. With many lights `low` keeps what rounding has dropped (Kahan 1965, "Further
// Remarks on Reducing Truncation Errors"): a sum of thousands of floats would be wrong in the fourth digit.
void add_light(vec3 value, inout vec3 sum, inout vec3 low) {
    vec3 added = HAS_MANY_LIGHTS ? value - low : value;
    vec3 before = sum;
    sum = before + added;
    if (HAS_MANY_LIGHTS)
        low = (sum - before) - added;
}
