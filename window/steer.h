// What keys and mouse do to a camera: a state, events, and time; no window.
//
// W A S D fly forward, left, back and right, E and Q up and down; dragging with the left button looks around,
// with the right one turns around the pivot: the point that was clicked last. The wheel changes the speed.
// Keys that do something else, and clicks, are returned as actions. Up stays up: nothing rolls the camera.
//
// Units: scene units, seconds, pixels from the upper left corner. Ownership: values. Thread safety: pure.
#ifndef GLINT_WINDOW_STEER_H
#define GLINT_WINDOW_STEER_H

#include "core/vec3.h"

#include <stdbool.h>
#include <stdint.h>

// Where a camera is and looks: right, up and forward are orthonormal.
struct steer_pose {
    vec3 position, right, up, forward;
};

enum steer_kind {
    STEER_KEY,    // key, down
    STEER_BUTTON, // button, down, x, y
    STEER_MOVE,   // x, y
    STEER_WHEEL,  // amount
    STEER_LEAVE,  // the window has lost the keyboard: all keys are up
    STEER_CLOSE,
};

enum {
    STEER_F1 = 1,
    STEER_TAB = 9,
    STEER_ESCAPE = 27,
    STEER_LEFT = 0, // buttons
    STEER_RIGHT = 1,
};

struct steer_event {
    enum steer_kind kind;
    int key; // a capital letter, a digit, or one of the above; 0: any other
    int button;
    bool down;
    double x, y;
    double amount; // of the wheel: notches, away from the user
};

enum steer_do {
    STEER_NOTHING,
    STEER_QUIT,
    STEER_CAMERA,  // number: from 0
    STEER_BACK,    // back to the scene's camera
    STEER_WRITE,   // the picture
    STEER_PRINT,   // the camera as text
    STEER_NEXT,    // next mode of what is shown of each pixel
    STEER_OVERLAY, // on or off
    STEER_KEYS,    // shown or not
    STEER_PICK,    // x, y
};

struct steer_action {
    enum steer_do what;
    uint32_t number;
    double x, y;
};

struct steer {
    struct steer_pose pose;
    vec3 up;      // unit; the camera never rolls away from it
    double speed; // scene units a second
    double pixel; // radians per pixel of dragging
    vec3 pivot;   // the point that dragging turns around
    bool has_pivot;
    uint32_t held; // bits of the keys that fly
    bool is_down[2];
    double x, y;           // of the mouse
    double down_x, down_y; // where the left button went down
    bool is_click;         // the mouse has hardly moved since
    bool has_turned;       // since the last step
};

// `extent`: size of the scene in scene units. The height of the window in pixels and the camera's field in
// radians decide how far a pixel turns.
void steer_begin(struct steer *steer, struct steer_pose pose, vec3 up, double extent);
void steer_resize(struct steer *steer, double height, double field);
// Moves the camera elsewhere.
void steer_place(struct steer *steer, struct steer_pose pose, vec3 up);
struct steer_action steer_event(struct steer *steer, const struct steer_event *event);
// Whether keys that fly are down.
bool steer_is_flying(const struct steer *steer);
// Lets time pass. Returns whether the camera has moved or turned since the last step.
bool steer_step(struct steer *steer, double seconds);

#endif
