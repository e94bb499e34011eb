// Real events for a window of an X server, as a user makes them (XTest), and pictures of it.
// Usage: x_events TITLE WORD..., where the words are, in their order:
//   await             until there is a window of that title
//   key K             press and release; down K, up K: one of them. K as Xlib names keys: w, Tab, Escape
//   move X Y          the mouse, to a place of the window
//   press N, release N    a button of the mouse; 4 and 5 are the wheel
//   size W H          what a user does at the window's corner
//   hide, show        what minimising does without a window manager
//   close             what a user does with the window's button
//   dpi N             of the display, as its users set it, for windows that are opened from then on
//   sleep MS
//   shot FILE         the window as PPM
//   color X Y RRGGBB FILE  the same, as soon as that pixel has that colour; exit 1 if it does not get it
//   within 5 s
// Exit: 0; 1 where the window is not there; 2 for a mistake.
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static Display *display;
static Window window;

static void nap(long ms) {
    const struct timespec time = {ms / 1000, ms % 1000 * 1000000};
    nanosleep(&time, NULL);
}

static int number(const char *text) {
    return (int)strtol(text, NULL, 10);
}

static Window find(Window at, const char *title) {
    Window root, parent, *children = NULL, found = None;
    unsigned count = 0;
    char *name = NULL;
    if (XFetchName(display, at, &name) && name && strcmp(name, title) == 0)
        found = at;
    if (name)
        XFree(name);
    if (!found && XQueryTree(display, at, &root, &parent, &children, &count))
        for (unsigned i = 0; i < count && !found; i++)
            found = find(children[i], title);
    if (children)
        XFree(children);
    return found;
}

static int await(const char *title) {
    enum {
        TRIES = 6000
    };
    for (int i = 0; i < TRIES; i++) {
        XWindowAttributes attributes;
        window = find(DefaultRootWindow(display), title);
        if (window && XGetWindowAttributes(display, window, &attributes) &&
            attributes.map_state == IsViewable)
            return 0;
        nap(10);
    }
    fprintf(stderr, "x_events: no window '%s'\n", title);
    return 1;
}

static void key(const char *name, int down) {
    XTestFakeKeyEvent(display, XKeysymToKeycode(display, XStringToKeysym(name)), down, CurrentTime);
}

static void move(int x, int y) {
    int root_x, root_y;
    Window child;
    XTranslateCoordinates(display, window, DefaultRootWindow(display), x, y, &root_x, &root_y, &child);
    XTestFakeMotionEvent(display, -1, root_x, root_y, CurrentTime);
}

static void set_dpi(const char *dpi) {
    char text[64];
    snprintf(text, sizeof text, "Xft.dpi:\t%s\n", dpi);
    XChangeProperty(display, DefaultRootWindow(display), XA_RESOURCE_MANAGER, XA_STRING, 8, PropModeReplace,
                    (const unsigned char *)text, (int)strlen(text));
}

static void close_window(void) {
    XEvent event = {0};
    event.xclient.type = ClientMessage;
    event.xclient.window = window;
    event.xclient.message_type = XInternAtom(display, "WM_PROTOCOLS", False);
    event.xclient.format = 32;
    event.xclient.data.l[0] = (long)XInternAtom(display, "WM_DELETE_WINDOW", False);
    XSendEvent(display, window, False, NoEventMask, &event);
}

static XImage *look(void) {
    XWindowAttributes attributes;
    XGetWindowAttributes(display, window, &attributes);
    return XGetImage(display, window, 0, 0, (unsigned)attributes.width, (unsigned)attributes.height,
                     AllPlanes, ZPixmap);
}

static int write_image(XImage *image, const char *path) {
    FILE *file = fopen(path, "wb");
    if (!file || !image)
        return 1;
    fprintf(file, "P6\n%d %d\n255\n", image->width, image->height);
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x < image->width; x++) {
            const unsigned long pixel = XGetPixel(image, x, y);
            fputc((int)(pixel >> 16 & 255), file);
            fputc((int)(pixel >> 8 & 255), file);
            fputc((int)(pixel & 255), file);
        }
    XDestroyImage(image);
    return fclose(file) != 0;
}

static int shot_of_color(int x, int y, unsigned long color, const char *path) {
    enum {
        TRIES = 1000
    };
    for (int i = 0; i < TRIES; i++) {
        XImage *image = look();
        if (image && x < image->width && y < image->height && (XGetPixel(image, x, y) & 0xffffff) == color)
            return write_image(image, path);
        if (image)
            XDestroyImage(image);
        nap(5);
    }
    return 1;
}

// One word with its arguments; returns how many words it took, 0 for a mistake.
static int run(char **words, int left, const char *title) {
    static const struct {
        const char *name;
        int arguments;
    } known[] = {{"await", 0}, {"key", 1},     {"down", 1}, {"up", 1},   {"move", 2},
                 {"press", 1}, {"release", 1}, {"size", 2}, {"hide", 0}, {"show", 0},
                 {"close", 0}, {"sleep", 1},   {"shot", 1}, {"dpi", 1},  {"color", 4}};
    int is = -1;
    for (int i = 0; i < (int)(sizeof known / sizeof *known); i++)
        if (strcmp(words[0], known[i].name) == 0)
            is = i;
    if (is < 0 || left <= known[is].arguments)
        return 0;
    const char *word = words[0], *one = known[is].arguments ? words[1] : "";
    if (strcmp(word, "await") == 0 && await(title))
        exit(1);
    if (strcmp(word, "key") == 0 || strcmp(word, "down") == 0)
        key(one, True);
    if (strcmp(word, "key") == 0 || strcmp(word, "up") == 0)
        key(one, False);
    if (strcmp(word, "move") == 0)
        move(number(one), number(words[2]));
    if (strcmp(word, "press") == 0 || strcmp(word, "release") == 0)
        XTestFakeButtonEvent(display, (unsigned)number(one), word[0] == 'p', CurrentTime);
    if (strcmp(word, "size") == 0)
        XResizeWindow(display, window, (unsigned)number(one), (unsigned)number(words[2]));
    if (strcmp(word, "hide") == 0)
        XUnmapWindow(display, window);
    if (strcmp(word, "show") == 0)
        XMapWindow(display, window);
    if (strcmp(word, "close") == 0)
        close_window();
    if (strcmp(word, "dpi") == 0)
        set_dpi(one);
    if (strcmp(word, "sleep") == 0)
        nap(number(one));
    XSync(display, False);
    if (strcmp(word, "shot") == 0 && write_image(look(), one))
        exit(1);
    if (strcmp(word, "color") == 0 &&
        shot_of_color(number(one), number(words[2]), strtoul(words[3], NULL, 16), words[4]))
        exit(1);
    return 1 + known[is].arguments;
}

int main(int argc, char **argv) {
    display = XOpenDisplay(NULL);
    if (argc < 3 || !display) {
        fprintf(stderr, "x_events: %s\n", display ? "needs a title and words" : "no display");
        return 2;
    }
    window = find(DefaultRootWindow(display), argv[1]);
    for (int at = 2; at < argc;) {
        const int taken = !window && strcmp(argv[at], "await") != 0 && strcmp(argv[at], "dpi") != 0
                              ? 0
                              : run(argv + at, argc - at, argv[1]);
        if (!taken) {
            fprintf(stderr, "x_events: not understood, or no window: %s\n", argv[at]);
            return window ? 2 : 1;
        }
        at += taken;
    }
    XCloseDisplay(display);
    return 0;
}
