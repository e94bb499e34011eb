// What a ray that hits nothing sees (docs/language.md, "Background"): with bilinear weights and angles
// computed here, so that devices agree.

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

vec3 background_image(REAL3 d) {
    REAL2 turn = BACKGROUND_TURN;
    REAL x = d.x * turn.x - d.z * turn.y;
    REAL z = d.x * turn.y + d.z * turn.x;
    REAL width = REAL(frame.background_width), height = REAL(frame.background_height);
    REAL u = (0.5 + arctan2(z, x) * (0.5 / REAL_PI)) * width - 0.5;
    REAL v = arctan2(sqrt(x * x + z * z), d.y) * (1.0 / REAL_PI) * height - 0.5;
    REAL u0 = floor(u), v0 = floor(v);
    float fu = float(u - u0), fv = float(v - v0);
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

vec3 background(REAL3 direction) {
    vec3 color = frame.background;
    if (HAS_BACKGROUND_IMAGE && wants(FEATURE_BACKGROUND_IMAGE))
        color = background_image(direction);
    return color;
}
