// Cameras other than a pinhole in perspective (docs/language.md, "Projections" and "Lens").

struct camera_ray {
    REAL3 at;
    REAL3 direction; // unit
};

// The direction in which a fisheye or a panorama looks; (x, y) is the place in the picture, -1..1.
REAL3 fisheye_direction(REAL x, REAL y) {
    REAL3 across = CAMERA(right) * x + CAMERA(up) * y;
    REAL quarters = sqrt(dot3(across, across));
    REAL2 turned = turn_by(quarters);
    // For such a small angle, sine and angle are equal.
    REAL part = quarters > 1.0e-12 ? turned.y / quarters : HALF_PI;
    return unit3(CAMERA(forward) * turned.x + across * part);
}

REAL3 panorama_direction(REAL x, REAL y) {
    REAL2 longitude = turn_by(2.0 * x), latitude = turn_by(y);
    REAL3 level = CAMERA(forward) * longitude.x + CAMERA(right) * longitude.y;
    return unit3(level * latitude.x + CAMERA(up) * latitude.y);
}

// From a point on the lens through the point that the ray through the middle of the lens has in focus. A lens that looks
// ahead lies across the view and focuses on a plane; one that looks all round lies across each ray.
void focus_ray(uvec2 pixel, REAL3 middle, bool ahead, inout camera_ray ray) {
    REAL2 place = disc_point(point_at(point_key(point_root(pixel.x, pixel.y), POINT_LENS))) * REAL(frame.lens_radius);
    REAL3 a, b;
    if (ahead) {
        a = unit3(CAMERA(right));
        b = unit3(CAMERA(up));
    } else {
        frame_around(ray.direction, a, b);
    }
    REAL3 aside = a * place.x + b * place.y;
    ray.at += aside;
    ray.direction = unit3(middle * REAL(frame.focus) - aside);
}

// `ray`: in perspective, from the camera's position.
void through_lens(uvec2 pixel, REAL x, REAL y, inout camera_ray ray) {
    uint projection = frame.projection + OPAQUE_ZERO;
    REAL3 across = CAMERA(right) * x + CAMERA(up) * y, middle = CAMERA(forward) + across;
    if (projection == PROJECTION_ORTHOGRAPHIC) {
        ray.at += across;
        middle = CAMERA(forward);
        ray.direction = middle;
    }
    if (projection == PROJECTION_FISHEYE)
        ray.direction = fisheye_direction(x, y);
    if (projection == PROJECTION_PANORAMA)
        ray.direction = panorama_direction(x, y);
    bool ahead = projection <= PROJECTION_ORTHOGRAPHIC;
    // The middle of the lens is where the pinhole is, and its ray is the same, bit for bit.
    if (frame.lens_radius > float(OPAQUE_ZERO) && frame.point_bits > OPAQUE_ZERO)
        focus_ray(pixel, ahead ? middle : ray.direction, ahead, ray);
}

// `offset`: of the sample inside the pixel. The kernel has set which sample it is (points.glsl).
camera_ray camera_ray_at(uvec2 pixel, vec2 offset) {
    camera_ray ray = camera_ray(CAMERA(position), camera_direction_at(pixel, offset));
    if (HAS_CAMERA && wants(FEATURE_CAMERA)) {
        REAL x = 2.0 * (REAL(pixel.x) + REAL(offset.x)) / REAL(frame.whole_width) - 1.0;
        REAL y = 1.0 - 2.0 * (REAL(pixel.y) + REAL(offset.y)) / REAL(frame.whole_height);
        through_lens(pixel, x, y, ray);
    }
    return ray;
}

camera_ray camera_ray_of(uvec2 pixel) { return camera_ray_at(pixel, vec2(dispatch.offset_x, dispatch.offset_y)); }
