// What a ray sees that hits nothing (docs/language.md, "Background"): own bilinear weights and own angles,
// so that devices agree.

vec3 background_texel(int x, int y) {
#ifdef WEBGPU
    uint at = uint(y) * frame.background_width + uint(x);
    if (dispatch.background_is_float > OPAQUE_ZERO)
        return uintBitsToFloat(FETCH(background, at).xyz);
    return unpackUnorm4x8(FETCH(background, at >> 2u)[at & 3u]).xyz;
#else
    return texelFetch(background_texels, y * int(frame.background_width) + x).xyz;
#endif
}

vec3 background_image(vec3 d) {
    float x = d.x * frame.background_cos - d.z * frame.background_sin;
    float z = d.x * frame.background_sin + d.z * frame.background_cos;
    float width = float(frame.background_width), height = float(frame.background_height);
    float u = (0.5 + arctan2(z, x) * (0.5 / PI)) * width - 0.5;
    float v = arctan2(sqrt(x * x + z * z), d.y) * (1.0 / PI) * height - 0.5;
    float u0 = floor(u), v0 = floor(v);
    float fu = u - u0, fv = v - v0;
    // Clamped as floats first: a conversion out of range is undefined.
    int column = int(clamp(u0, -1.0, width - 1.0));
    int row = int(clamp(v0, -1.0, height - 1.0));
    int left = column < 0 ? int(frame.background_width) - 1 : column;
    int right = column + 1 == int(frame.background_width) ? 0 : column + 1;
    int top = max(row, 0), bottom = min(row + 1, int(frame.background_height) - 1);
    vec3 upper = background_texel(left, top) * (1.0 - fu) + background_texel(right, top) * fu;
    vec3 lower = background_texel(left, bottom) * (1.0 - fu) + background_texel(right, bottom) * fu;
    return (upper * (1.0 - fv) + lower * fv) * frame.background_intensity;
}

vec3 background(vec3 direction) {
    vec3 color = frame.background;
    if (HAS_BACKGROUND_IMAGE && wants(FEATURE_BACKGROUND_IMAGE))
        color = background_image(direction);
    return color;
}
