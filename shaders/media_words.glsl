// How what a path is inside is kept with its other words (path_words.glsl), and that of the refracted rays that wait.

const uint MEDIA_WORD = LOW_WORD + (HAS_MANY_LIGHTS ? 1u : 0u);
const uint SHINE_WORD = MEDIA_WORD + (HAS_MEDIA ? MEDIA_WORDS : 0u);
const uint MEDIA_BRANCH_WORDS = HAS_MEDIA ? MEDIA_WORDS : 0u;

void put_media(uint slot, uint word, media_set inside, vec3 tint) {
    states[state_word(slot, word)] = inside.a;
    states[state_word(slot, word + 1u)] = inside.b;
    states[state_word(slot, word + 2u)] = uvec4(floatBitsToUint(tint), 0u);
}

void get_media(uint slot, uint word, inout path_state p) {
    p.inside = media_set(states[state_word(slot, word)], states[state_word(slot, word + 1u)]);
    p.tint = uintBitsToFloat(states[state_word(slot, word + 2u)].xyz);
}

// Numbers of the kernel's precision, two to a word.
uvec4 two_reals(REAL a, REAL b) { return uvec4(bits_of(a), bits_of(b)); }

void put_shine(uint slot, shining way) {
    ray_start start = way.start;
    states[state_word(slot, SHINE_WORD)] = way.inside.a;
    states[state_word(slot, SHINE_WORD + 1u)] = way.inside.b;
    states[state_word(slot, SHINE_WORD + 2u)] = uvec4(floatBitsToUint(way.left), way.goes_on ? 1u : 0u);
    states[state_word(slot, SHINE_WORD + 3u)] = two_reals(start.at.x, start.at.y);
    states[state_word(slot, SHINE_WORD + 4u)] = two_reals(start.at.z, start.slack);
    states[state_word(slot, SHINE_WORD + 5u)] = two_reals(start.b1, start.b2);
    states[state_word(slot, SHINE_WORD + 6u)] = uvec4(start.left, 0u, 0u, 0u);
}

shining get_shine(uint slot) {
    uvec4 left = states[state_word(slot, SHINE_WORD + 2u)];
    uvec4 c = states[state_word(slot, SHINE_WORD + 3u)], d = states[state_word(slot, SHINE_WORD + 4u)];
    uvec4 e = states[state_word(slot, SHINE_WORD + 5u)];
    ray_start start = ray_start(REAL3(number_of(c.xy), number_of(c.zw), number_of(d.xy)), number_of(d.zw),
                                states[state_word(slot, SHINE_WORD + 6u)].x, number_of(e.xy), number_of(e.zw));
    media_set inside = media_set(states[state_word(slot, SHINE_WORD)], states[state_word(slot, SHINE_WORD + 1u)]);
    return shining(left.w != 0u, start, uintBitsToFloat(left.xyz), inside);
}

void put_path_media(uint slot, path_state p) {
    if (HAS_MEDIA)
        put_media(slot, MEDIA_WORD, p.inside, p.tint);
    if (HAS_CLEAR_SHADOWS)
        put_shine(slot, p.shine);
}

void get_path_media(uint slot, inout path_state p) {
    p.tint = vec3(1.0);
    p.shine.goes_on = false;
    if (HAS_MEDIA)
        get_media(slot, MEDIA_WORD, p);
    if (HAS_CLEAR_SHADOWS)
        p.shine = get_shine(slot);
}
