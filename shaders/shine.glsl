// Light that shines through what refracts: a shadow ray goes straight on behind each surface that it meets, and keeps a part
// of its light (docs/language.md, "Shadows of glass").

const uint SHINE_RAYS = 500u; // to one light, where nothing else ends them

struct shining {
    bool goes_on; // a surface was met: `start` is behind it
    ray_start start;
    vec3 left; // of the light
    media_set inside;
};

shining shine_from(ray_start start, media_set inside) { return shining(false, start, vec3(1.0), inside); }

bool shines() { return HAS_CLEAR_SHADOWS && wants(FEATURE_CLEAR_SHADOWS); }

// What a surface lets through. By the angle on the thinner side, whichever the ray comes from: as of light that was bent
// on its way in.
float shine_share(surface s, REAL3 direction) {
    float share = s.refraction;
    if (HAS_FRESNEL) {
        REAL low = min(s.index_before, s.index_after), high = max(s.index_before, s.index_after);
        REAL c = -dot3(direction, s.shading);
        c = c <= 0.0 ? -dot3(direction, s.geometric) : c;
        REAL eta = low / high;
        float reflected = fresnel_share(low, high, c, 1.0 - eta * eta * (1.0 - c * c), !s.solid);
        share = s.fresnel ? share * (1.0 - reflected) : share;
    }
    return share;
}

REAL3 shine_direction(shining way, light_record light, light_ray ray) {
    return ray.t_max < FAR_AWAY ? light.place - way.start.at : ray.direction;
}

// A shadow ray met a surface, or came to the light. true: it goes on behind the surface.
bool shine_on(inout shining way, hit_record hit, light_ray ray) {
    bool arrived = hit.item == NO_ITEM, is_point = ray.t_max < FAR_AWAY;
    REAL size = sqrt(dot3(ray.direction, ray.direction));
    if (HAS_ATTENUATION && (!arrived || is_point))
        way.left *= media_left(way.inside, (arrived ? ray.t_max : hit.t) * size);
    if (arrived)
        return false;
    surface s;
    make_surface(hit, way.start.at, ray.direction, s);
    cross_surface(way.inside, hit, s);
    float share = shine_share(s, ray.direction * (1.0 / size));
    way.left *= HAS_MEDIA && s.passes ? 1.0 : share;
    if (HAS_MEDIA)
        way.inside = s.after;
    way.start = leave(s, hit, -s.geometric);
    way.goes_on = largest3(REAL3(way.left)) > 0.0;
    return way.goes_on;
}
