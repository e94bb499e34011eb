#include "window/window.h"

#include "core/heap.h"
#include "core/str.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef GLINT_HAS_GLFW
// The one file beside tracer/gpu that sees Vulkan: GLFW makes the surface.
#define VK_NO_PROTOTYPES
#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>

enum {
    EVENTS_MAX = 256,
    LEAST_WIDTH = 64,
    LEAST_HEIGHT = 48,
    ROOMY_WIDTH = 600, // points; from this width on a dot of text is two points wide
};

// The functions that are used, by their names without the library's own.
#define GLFW_FUNCTIONS(F)                                                                                    \
    F(Init)                                                                                                  \
    F(Terminate)                                                                                             \
    F(SetErrorCallback)                                                                                      \
    F(WindowHint)                                                                                            \
    F(CreateWindow)                                                                                          \
    F(DestroyWindow)                                                                                         \
    F(ShowWindow)                                                                                            \
    F(SetWindowSize)                                                                                         \
    F(SetWindowSizeLimits)                                                                                   \
    F(SetWindowUserPointer)                                                                                  \
    F(GetWindowUserPointer)                                                                                  \
    F(GetWindowSize)                                                                                         \
    F(GetFramebufferSize)                                                                                    \
    F(GetWindowAttrib)                                                                                       \
    F(GetWindowContentScale)                                                                                 \
    F(GetPrimaryMonitor)                                                                                     \
    F(GetMonitorWorkarea)                                                                                    \
    F(SetKeyCallback)                                                                                        \
    F(SetMouseButtonCallback)                                                                                \
    F(SetCursorPosCallback)                                                                                  \
    F(SetScrollCallback)                                                                                     \
    F(SetWindowFocusCallback)                                                                                \
    F(SetWindowCloseCallback)                                                                                \
    F(PollEvents)                                                                                            \
    F(WaitEventsTimeout)                                                                                     \
    F(VulkanSupported)                                                                                       \
    F(GetRequiredInstanceExtensions)                                                                         \
    F(CreateWindowSurface)

struct glfw {
#define MEMBER(name) __typeof__(&glfw##name) name;
    GLFW_FUNCTIONS(MEMBER)
#undef MEMBER
};

struct window {
    struct glfw glfw;
    void *library;
    GLFWwindow *handle;
    struct steer_event events[EVENTS_MAX];
    uint32_t first, count;
    double x, y; // of the mouse, at the last event
    char *error; // where the library's messages go while it is opened; NULL: nowhere
    bool is_begun;
};

// GLFW has no context for it; there is one window in the process.
static struct window *opened;

static void on_error(int code, const char *text) {
    (void)code;
    if (opened && opened->error)
        snprintf(opened->error, WINDOW_ERROR_BYTES, "%.*s", STR_ARG(str_trim(str_from(text))));
}

// ---- events

static struct steer_event *push(GLFWwindow *handle) {
    struct window *window = opened->glfw.GetWindowUserPointer(handle);
    // The oldest ones are dropped: nobody has looked for long.
    if (window->count == EVENTS_MAX) {
        window->first = (window->first + 1) % EVENTS_MAX;
        window->count--;
    }
    struct steer_event *event = &window->events[(window->first + window->count++) % EVENTS_MAX];
    *event = (struct steer_event){0};
    return event;
}

// Keys by their position on a keyboard; letters name positions.
static int key_of(int key) {
    if ((key >= GLFW_KEY_A && key <= GLFW_KEY_Z) || (key >= GLFW_KEY_0 && key <= GLFW_KEY_9))
        return key;
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9)
        return '0' + key - GLFW_KEY_KP_0;
    return key == GLFW_KEY_TAB      ? STEER_TAB
           : key == GLFW_KEY_ESCAPE ? STEER_ESCAPE
           : key == GLFW_KEY_F1     ? STEER_F1
                                    : 0;
}

static void on_key(GLFWwindow *handle, int key, int code, int action, int mods) {
    (void)code;
    (void)mods;
    if (action == GLFW_REPEAT)
        return;
    struct steer_event *event = push(handle);
    event->kind = STEER_KEY;
    event->key = key_of(key);
    event->down = action == GLFW_PRESS;
}

// From the display's units to pixels.
static void to_pixels(struct window *window, double *x, double *y) {
    int width, height, across, down;
    window->glfw.GetWindowSize(window->handle, &width, &height);
    window->glfw.GetFramebufferSize(window->handle, &across, &down);
    if (width > 0 && height > 0) {
        *x *= (double)across / width;
        *y *= (double)down / height;
    }
}

static void on_button(GLFWwindow *handle, int button, int action, int mods) {
    (void)mods;
    struct steer_event *event = push(handle);
    event->kind = STEER_BUTTON;
    event->button = button;
    event->down = action == GLFW_PRESS;
    // The mouse position at that time: by now it may be elsewhere.
    event->x = opened->x;
    event->y = opened->y;
}

static void on_move(GLFWwindow *handle, double x, double y) {
    struct steer_event *event = push(handle);
    event->kind = STEER_MOVE;
    to_pixels(opened, &x, &y);
    event->x = opened->x = x;
    event->y = opened->y = y;
}

static void on_wheel(GLFWwindow *handle, double x, double y) {
    (void)x;
    struct steer_event *event = push(handle);
    event->kind = STEER_WHEEL;
    event->amount = y;
}

static void on_focus(GLFWwindow *handle, int focused) {
    if (!focused)
        push(handle)->kind = STEER_LEAVE;
}

static void on_close(GLFWwindow *handle) {
    push(handle)->kind = STEER_CLOSE;
}

bool window_next(struct window *window, struct steer_event *event) {
    if (window->count == 0)
        return false;
    *event = window->events[window->first];
    window->first = (window->first + 1) % EVENTS_MAX;
    window->count--;
    return true;
}

void window_wait(struct window *window, double seconds) {
    if (seconds > 0 && window->count == 0)
        window->glfw.WaitEventsTimeout(seconds);
    else
        window->glfw.PollEvents();
}

// ---- beginning and end

static bool load(struct window *window, char *error) {
    window->library = dlopen("libglfw.so.3", RTLD_NOW | RTLD_LOCAL);
    bool has_all = window->library != NULL;
    if (!has_all)
        snprintf(error, WINDOW_ERROR_BYTES, "the library GLFW (libglfw.so.3) is not installed");
#define FIND(name)                                                                                           \
    if (has_all) {                                                                                           \
        void *found = dlsym(window->library, "glfw" #name);                                                  \
        memcpy(&window->glfw.name, &found, sizeof found);                                                    \
        has_all = found != NULL;                                                                             \
        if (!found)                                                                                          \
            snprintf(error, WINDOW_ERROR_BYTES, "GLFW is too old: it has no glfw" #name);                    \
    }
    GLFW_FUNCTIONS(FIND)
#undef FIND
    return has_all;
}

static int least(int a, int b) {
    return a < b ? a : b;
}

// As large as the display has room for.
static void fit(const struct glfw *glfw, int *width, int *height) {
    GLFWmonitor *monitor = glfw->GetPrimaryMonitor();
    int x, y, across = 0, down = 0;
    if (monitor)
        glfw->GetMonitorWorkarea(monitor, &x, &y, &across, &down);
    *width = across > 0 ? least(*width, across) : *width;
    *height = down > 0 ? least(*height, down) : *height;
}

// Units of the window's size per point: on X11 these are pixels, elsewhere points.
static double units_per_point(struct window *window) {
    int width = 0, height = 0, across = 0, down = 0;
    float x = 1, y = 1;
    window->glfw.GetWindowSize(window->handle, &width, &height);
    window->glfw.GetFramebufferSize(window->handle, &across, &down);
    window->glfw.GetWindowContentScale(window->handle, &x, &y);
    return height > 0 && down > 0 && y > 0 ? (double)y * height / down : 1;
}

void window_resize(struct window *window, uint32_t width, uint32_t height) {
    const double units = units_per_point(window);
    int across = (int)(width * units + 0.5), down = (int)(height * units + 0.5);
    fit(&window->glfw, &across, &down);
    window->glfw.SetWindowSize(window->handle, across, down);
}

static bool create(struct window *window, const char *title, int width, int height) {
    const struct glfw *glfw = &window->glfw;
    fit(glfw, &width, &height);
    glfw->WindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    // Hidden until it has its size for the display's scale.
    glfw->WindowHint(GLFW_VISIBLE, GLFW_FALSE);
    window->handle = glfw->CreateWindow(width, height, title, NULL, NULL);
    if (!window->handle)
        return false;
    glfw->SetWindowSizeLimits(window->handle, LEAST_WIDTH, LEAST_HEIGHT, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfw->SetWindowUserPointer(window->handle, window);
    glfw->SetKeyCallback(window->handle, on_key);
    glfw->SetMouseButtonCallback(window->handle, on_button);
    glfw->SetCursorPosCallback(window->handle, on_move);
    glfw->SetScrollCallback(window->handle, on_wheel);
    glfw->SetWindowFocusCallback(window->handle, on_focus);
    glfw->SetWindowCloseCallback(window->handle, on_close);
    window_resize(window, (uint32_t)width, (uint32_t)height);
    glfw->ShowWindow(window->handle);
    return true;
}

struct window *window_open(const char *title, uint32_t width, uint32_t height,
                           char error[WINDOW_ERROR_BYTES]) {
    struct window *window = heap_zeroed(1, sizeof *window);
    snprintf(error, WINDOW_ERROR_BYTES, "there is no memory for a window");
    if (!window)
        return NULL;
    opened = window;
    window->error = error;
    bool good = load(window, error);
    if (good) {
        snprintf(error, WINDOW_ERROR_BYTES, "there is no display");
        window->glfw.SetErrorCallback(on_error);
        good = window->is_begun = window->glfw.Init();
    }
    if (good && !window->glfw.VulkanSupported()) {
        snprintf(error, WINDOW_ERROR_BYTES, "GLFW finds no Vulkan");
        good = false;
    }
    good = good && create(window, title, (int)width, (int)height);
    window->error = NULL;
    if (good)
        return window;
    window_close(window);
    return NULL;
}

void window_close(struct window *window) {
    if (!window)
        return;
    if (window->handle)
        window->glfw.DestroyWindow(window->handle);
    if (window->is_begun)
        window->glfw.Terminate();
    // The library stays loaded: what it started may still run.
    opened = NULL;
    free(window);
}

const char *const *window_extensions(struct window *window, uint32_t *count) {
    return window->glfw.GetRequiredInstanceExtensions(count);
}

bool window_make_surface(void *window, void *instance, void *surface) {
    struct window *w = window;
    return w->glfw.CreateWindowSurface((VkInstance)instance, w->handle, NULL, surface) == VK_SUCCESS;
}

void window_size(struct window *window, uint32_t *width, uint32_t *height) {
    int across = 0, down = 0;
    if (!window->glfw.GetWindowAttrib(window->handle, GLFW_ICONIFIED))
        window->glfw.GetFramebufferSize(window->handle, &across, &down);
    *width = (uint32_t)across;
    *height = (uint32_t)down;
}

uint32_t window_text_scale(struct window *window) {
    float x = 1, y = 1;
    uint32_t width, height;
    window->glfw.GetWindowContentScale(window->handle, &x, &y);
    window_size(window, &width, &height);
    const uint32_t scale = y < 1.5f ? 1 : (uint32_t)(y + 0.5f);
    return width < ROOMY_WIDTH * scale ? scale : 2 * scale;
}

#else

struct window *window_open(const char *title, uint32_t width, uint32_t height,
                           char error[WINDOW_ERROR_BYTES]) {
    (void)title, (void)width, (void)height;
    snprintf(error, WINDOW_ERROR_BYTES, "this glint was built without GLFW (libglfw3-dev)");
    return NULL;
}
void window_close(struct window *window) {
    (void)window;
}
const char *const *window_extensions(struct window *window, uint32_t *count) {
    (void)window;
    *count = 0;
    return NULL;
}
bool window_make_surface(void *window, void *instance, void *surface) {
    (void)window, (void)instance, (void)surface;
    return false;
}
void window_size(struct window *window, uint32_t *width, uint32_t *height) {
    (void)window;
    *width = *height = 0;
}
void window_resize(struct window *window, uint32_t width, uint32_t height) {
    (void)window, (void)width, (void)height;
}
uint32_t window_text_scale(struct window *window) {
    (void)window;
    return 1;
}
void window_wait(struct window *window, double seconds) {
    (void)window, (void)seconds;
}
bool window_next(struct window *window, struct steer_event *event) {
    (void)window, (void)event;
    return false;
}
#endif
