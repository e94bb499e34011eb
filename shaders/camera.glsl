// Which pixel an invocation draws, and its ray (docs/language.md, "Camera").

// Morton order inside a tile, so that the 8 invocations of a lavapipe vector, and the 32 of a GPU's
// subgroup, draw neighbours.
uvec2 morton(uint index) {
    return uvec2((index & 1u) | ((index >> 1u) & 2u) | ((index >> 2u) & 4u),
                 ((index >> 1u) & 1u) | ((index >> 2u) & 2u) | ((index >> 3u) & 4u));
}

// Slots are numbered through the portion, 64 per tile. CPU devices give each thread a contiguous range of
// workgroups, and sky is cheaper than ground, so short runs of tiles are scattered over the picture.
uvec2 pixel_of_slot(uint slot) {
    uint tile = dispatch.tile_begin + slot / TILE_PIXELS;
    uint run = (tile / frame.run_tiles) * frame.run_step % frame.runs;
    uint place = run * frame.run_tiles + tile % frame.run_tiles;
    return uvec2(place % frame.tiles_x, place / frame.tiles_x) * TILE_SIDE + morton(slot % TILE_PIXELS);
}

layout(constant_id = CONSTANT_PART) const bool IS_PART = false;

// The pixel of the whole picture for one of those drawn.
uvec2 pixel_of_whole(uvec2 pixel) { return IS_PART ? pixel + uvec2(frame.first_x, frame.first_y) : pixel; }

// `pixel`: of the whole picture; `offset`: of the sample inside the pixel.
REAL3 camera_direction_at(uvec2 pixel, vec2 offset) {
    REAL x = 2.0 * (REAL(pixel.x) + REAL(offset.x)) / REAL(frame.whole_width) - 1.0;
    REAL y = 1.0 - 2.0 * (REAL(pixel.y) + REAL(offset.y)) / REAL(frame.whole_height);
    return unit3(CAMERA(forward) + CAMERA(right) * x + CAMERA(up) * y);
}

REAL3 camera_direction(uvec2 pixel) { return camera_direction_at(pixel, vec2(dispatch.offset_x, dispatch.offset_y)); }
