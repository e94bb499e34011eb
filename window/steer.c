#include "window/steer.h"

#include <ctype.h>
#include <math.h>

#define WHEEL_FACTOR 1.25
#define CLICK_PIXELS 3.0
#define HIGHEST_ANGLE                                                                                        \
    1.55 // highest angle of the view over the horizon: at a right angle, left and right would swap
#define SECONDS_MOST 0.25     // of a step: a pause does not fly on
#define SPEED_SHARE  (1 / 3.) // of the scene's extent, a second
#define SPEED_LEAST  1e-9
#define SPEED_MOST   1e12

enum {
    FLY_FORWARD = 1,
    FLY_BACK = 2,
    FLY_LEFT = 4,
    FLY_RIGHT = 8,
    FLY_UP = 16,
    FLY_DOWN = 32,
};

void steer_place(struct steer *steer, struct steer_pose pose, vec3 up) {
    steer->pose = pose;
    steer->up = vec3_unit(up);
}

void steer_begin(struct steer *steer, struct steer_pose pose, vec3 up, double extent) {
    *steer = (struct steer){.speed = extent > 0 ? extent * SPEED_SHARE : 1, .pixel = 0.005};
    steer_place(steer, pose, up);
}

void steer_resize(struct steer *steer, double height, double field) {
    if (height > 0 && field > 0)
        steer->pixel = field / height;
}

// ---- keys

static uint32_t flying_bit(int key) {
    switch (key) {
    case 'W':
        return FLY_FORWARD;
    case 'S':
        return FLY_BACK;
    case 'A':
        return FLY_LEFT;
    case 'D':
        return FLY_RIGHT;
    case 'E':
        return FLY_UP;
    case 'Q':
        return FLY_DOWN;
    default:
        return 0;
    }
}

static struct steer_action action_of(int key) {
    switch (key) {
    case STEER_ESCAPE:
        return (struct steer_action){.what = STEER_QUIT};
    case STEER_F1:
        return (struct steer_action){.what = STEER_KEYS};
    case STEER_TAB:
        return (struct steer_action){.what = STEER_NEXT};
    case 'R':
        return (struct steer_action){.what = STEER_BACK};
    case 'P':
        return (struct steer_action){.what = STEER_WRITE};
    case 'C':
        return (struct steer_action){.what = STEER_PRINT};
    case 'H':
        return (struct steer_action){.what = STEER_OVERLAY};
    default:
        break;
    }
    // 1 to 9 are the first nine cameras, 0 the tenth.
    if (key >= '0' && key <= '9')
        return (struct steer_action){.what = STEER_CAMERA, .number = (uint32_t)(key == '0' ? 9 : key - '1')};
    return (struct steer_action){0};
}

static struct steer_action take_key(struct steer *steer, const struct steer_event *event) {
    const uint32_t bit = flying_bit(event->key);
    if (bit)
        steer->held = event->down ? steer->held | bit : steer->held & ~bit;
    return bit || !event->down ? (struct steer_action){0} : action_of(event->key);
}

// ---- mouse

// Turns `v` about the unit `axis` (Rodrigues' formula).
static vec3 turn(vec3 v, vec3 axis, double angle) {
    const double c = cos(angle), s = sin(angle);
    return vec3_add(vec3_add(vec3_mul(v, c), vec3_mul(vec3_cross(axis, v), s)),
                    vec3_mul(axis, vec3_dot(axis, v) * (1 - c)));
}

static struct steer_pose turned(struct steer_pose pose, vec3 axis, double angle) {
    pose.forward = vec3_unit(turn(pose.forward, axis, angle));
    pose.up = turn(pose.up, axis, angle);
    // Orthonormal again after any number of turns.
    pose.right = vec3_unit(vec3_cross(pose.forward, pose.up));
    pose.up = vec3_cross(pose.right, pose.forward);
    return pose;
}

static vec3 turned_about(vec3 point, vec3 pivot, vec3 axis, double angle) {
    return vec3_add(pivot, turn(vec3_sub(point, pivot), axis, angle));
}

// How far the camera may turn up (below 0: down) before it looks straight up or down; one that does so
// already may turn back.
static double bounded(const struct steer *steer, double angle) {
    const vec3 forward = steer->pose.forward;
    const double now = atan2(vec3_dot(forward, steer->up), vec3_length(vec3_cross(forward, steer->up)));
    return fmin(fmax(now + angle, fmin(-HIGHEST_ANGLE, now)), fmax(HIGHEST_ANGLE, now)) - now;
}

// About the scene's up, then about the camera's right.
static void rotate(struct steer *steer, double about_up, double about_right, bool around_pivot) {
    struct steer_pose *pose = &steer->pose;
    const double angle = bounded(steer, about_right);
    *pose = turned(*pose, steer->up, about_up);
    const vec3 axis = pose->right;
    *pose = turned(*pose, axis, angle);
    if (around_pivot) {
        pose->position = turned_about(pose->position, steer->pivot, steer->up, about_up);
        pose->position = turned_about(pose->position, steer->pivot, axis, angle);
    }
    steer->has_turned = true;
}

static void drag(struct steer *steer, double dx, double dy) {
    const bool orbits = steer->is_down[STEER_RIGHT] && steer->has_pivot;
    if (fabs(steer->x - steer->down_x) + fabs(steer->y - steer->down_y) > CLICK_PIXELS)
        steer->is_click = false;
    // A click is not a drag: the first pixels do nothing.
    if (steer->is_down[STEER_LEFT] && steer->is_click)
        return;
    if (steer->is_down[STEER_LEFT] || steer->is_down[STEER_RIGHT])
        rotate(steer, -dx * steer->pixel, -dy * steer->pixel, orbits);
}

static struct steer_action take_button(struct steer *steer, const struct steer_event *event) {
    if (event->button != STEER_LEFT && event->button != STEER_RIGHT)
        return (struct steer_action){0};
    steer->is_down[event->button] = event->down;
    steer->x = event->x;
    steer->y = event->y;
    if (event->button != STEER_LEFT)
        return (struct steer_action){0};
    if (event->down) {
        steer->is_click = true;
        steer->down_x = event->x;
        steer->down_y = event->y;
        return (struct steer_action){0};
    }
    const bool clicked = steer->is_click;
    steer->is_click = false;
    return clicked ? (struct steer_action){.what = STEER_PICK, .x = event->x, .y = event->y}
                   : (struct steer_action){0};
}

static void take_move(struct steer *steer, const struct steer_event *event) {
    const double dx = event->x - steer->x, dy = event->y - steer->y;
    steer->x = event->x;
    steer->y = event->y;
    drag(steer, dx, dy);
}

// ---- the whole

struct steer_action steer_event(struct steer *steer, const struct steer_event *event) {
    switch (event->kind) {
    case STEER_KEY:
        return take_key(steer, event);
    case STEER_BUTTON:
        return take_button(steer, event);
    case STEER_MOVE:
        take_move(steer, event);
        break;
    case STEER_WHEEL:
        steer->speed = fmin(fmax(steer->speed * pow(WHEEL_FACTOR, event->amount), SPEED_LEAST), SPEED_MOST);
        break;
    case STEER_LEAVE:
        steer->held = 0;
        steer->is_down[STEER_LEFT] = steer->is_down[STEER_RIGHT] = steer->is_click = false;
        break;
    case STEER_CLOSE:
        return (struct steer_action){.what = STEER_QUIT};
    }
    return (struct steer_action){0};
}

bool steer_is_flying(const struct steer *steer) {
    return steer->held != 0;
}

static double along(uint32_t held, uint32_t plus, uint32_t minus) {
    return (held & plus ? 1 : 0) - (held & minus ? 1 : 0);
}

bool steer_step(struct steer *steer, double seconds) {
    struct steer_pose *pose = &steer->pose;
    const uint32_t held = steer->held;
    const bool had_turned = steer->has_turned;
    vec3 way = vec3_mul(pose->forward, along(held, FLY_FORWARD, FLY_BACK));
    way = vec3_add(way, vec3_mul(pose->right, along(held, FLY_RIGHT, FLY_LEFT)));
    way = vec3_add(way, vec3_mul(steer->up, along(held, FLY_UP, FLY_DOWN)));
    steer->has_turned = false;
    if (vec3_is_zero(way) || !(seconds > 0))
        return had_turned;
    const double length = steer->speed * fmin(seconds, SECONDS_MOST);
    pose->position = vec3_add(pose->position, vec3_mul(vec3_unit(way), length));
    return true;
}
