// The background as a light: where a sample looks (docs/language.md, "Light from the background"; scene/sky.h has the table).

struct sky_spot {
    REAL3 l; // unit
    vec3 emission; // as for a light in that direction
};

uint sky_number(uint at) {
    uvec4 word = FETCH(lights, frame.sky_table + (at >> 2u));
#ifdef WEBGPU // SwiftShader's compiler does not end, or dies, where share_at's loop has branches in it
    return word[at & 3u];
#else
    uvec2 two = (at & 2u) != 0u ? word.zw : word.xy;
    return (at & 1u) != 0u ? two.y : two.x;
#endif
}

// The last of `count` shares, `apart` from each other, that begins at or before `place`.
uint share_at(uint first, uint count, uint apart, uint place) {
    uint at = 0u, step = 1u << uint(findMSB(count));
    while (step > OPAQUE_ZERO) {
        uint next = at + step;
#ifdef WEBGPU
        bool inside = next < count, before = sky_number(first + min(next, count - 1u) * apart) <= place;
        at = inside && before ? next : at;
#else
        if (next < count && sky_number(first + min(next, count - 1u) * apart) <= place)
            at = next;
#endif
        step >>= 1u;
    }
    return at;
}

// A share's end minus its begin; 2^32, where the last share ends, is 0.
uint share_width(uint first, uint count, uint apart, uint at) {
    uint end = at + 1u < count ? sky_number(first + min(at + 1u, count - 1u) * apart) : 0u;
    return end - sky_number(first + at * apart);
}
REAL real_width(uint width) { return width == 0u ? REAL(4294967296.0) : REAL(width); }

sky_spot sky_at(uint key) {
    uvec2 place = point_bits_at(key);
    uint row = share_at(0u, frame.sky_rows, 4u, place.y);
    REAL high = real_width(share_width(0u, frame.sky_rows, 4u, row));
    uint first = 4u * frame.sky_rows + row * frame.sky_stride;
    uint column = share_at(first, frame.sky_width, 1u, place.x);
    REAL wide = real_width(share_width(first, frame.sky_width, 1u, column));
    REAL down = REAL(place.y - sky_number(4u * row)) / high, across = REAL(place.x - sky_number(first + column)) / wide;
    REAL begin = REAL(uintBitsToFloat(sky_number(4u * row + 1u))), step = REAL(uintBitsToFloat(sky_number(4u * row + 2u)));
    REAL gap = begin + down * step, sine = sqrt(max(gap * (2.0 - gap), 0.0));
    // Cells begin in the middle of a texel, and the picture's middle is longitude 0.
    REAL2 turned = turn_by(4.0 * ((REAL(column) + 0.5 + across) / REAL(frame.sky_width)) - 2.0) * sine;
    REAL c = BACKGROUND_TURN.x, s = BACKGROUND_TURN.y;
    sky_spot spot;
    spot.l = REAL3(turned.x * c + turned.y * s, step > 0.0 ? 1.0 - gap : gap - 1.0, turned.y * c - turned.x * s);
    // Divided by pi and by the density, which is the cell's share over its solid angle.
    REAL size = 2.0 * abs(step) / REAL(frame.sky_width);
    spot.emission = background(spot.l) * float(size * (4294967296.0 / high) * (4294967296.0 / wide));
    return spot;
}
