// What a file is that is named as a scene and is none: by its first bytes, else by its ending.
//
// Input: its path and its text. Output: what it is and what to do with it, in words. Thread safety: constant
// data.
#ifndef GLINT_APP_WHAT_FILE_H
#define GLINT_APP_WHAT_FILE_H

#include "core/str.h"

struct what_file {
    const char *ending; // NULL: no ending says it
    const char *magic;  // its first bytes; NULL: none says it
    const char *what;   // "a ZIP archive"
    const char *advice; // what to do
};

// false: it may be a scene.
bool what_file(str path, str text, struct what_file *out);

#endif
