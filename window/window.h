// A window, its events, and the surface that a device shows pictures on. GLFW is loaded only when a window is
// wanted, so glint needs neither it nor a display for anything else.
//
// Errors: NULL, with a line of text. Ownership: window_close frees it, accepts NULL, and is called after the
// screen is closed. Units: pixels of the device, from the upper left corner, whatever the display's scale is.
// Thread safety: one window in the process, on its main thread.
#ifndef GLINT_WINDOW_WINDOW_H
#define GLINT_WINDOW_WINDOW_H

#include "window/steer.h"

#include <stddef.h>

enum {
    WINDOW_ERROR_BYTES = 512
};

struct window;

// Width and height as window_resize has them.
struct window *window_open(const char *title, uint32_t width, uint32_t height,
                           char error[WINDOW_ERROR_BYTES]);
void window_close(struct window *window);
// What gpu_options.screen_extensions must have.
const char *const *window_extensions(struct window *window, uint32_t *count);
// A gpu_make_surface.
bool window_make_surface(void *window, void *instance, void *surface);
// Both 0 while it is minimised.
void window_size(struct window *window, uint32_t *width, uint32_t *height);
// Asks for another size, in points: where the display's scale is 2, a point is two pixels wide. It is at most
// as large as the display, and takes effect when the display grants it.
void window_resize(struct window *window, uint32_t width, uint32_t height);
// Pixels of a dot of text.
uint32_t window_text_scale(struct window *window);
// Checks for events, and waits at most `seconds` for one.
void window_wait(struct window *window, double seconds);
// The next event that came; false: there is none.
bool window_next(struct window *window, struct steer_event *event);

#endif
