// A font of 5 x 7 dots for printable ASCII, made for glint's windows.
// Thread safety: constants.
#ifndef GLINT_WINDOW_FONT_H
#define GLINT_WINDOW_FONT_H

enum {
    FONT_WIDTH = 5,
    FONT_HEIGHT = 7,
    FONT_FIRST = 32, // of the characters that it has
    FONT_COUNT = 95,
};

// Rows from the top, '#' where there is a dot.
extern const char *const font_dots[FONT_COUNT];

#endif
